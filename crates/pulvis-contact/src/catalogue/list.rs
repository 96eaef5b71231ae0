//! What every list of laws gives: an enum of them, their descriptions, and building by name.

/// The enum of the laws of one role.
macro_rules! law_list {
    ($(#[$doc:meta])* $role:ident: $($law:ident),*) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum $role {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)*
        }

        impl $role {
            /// The descriptions of all laws of this role.
            pub const ENTRIES: &'static [LawEntry] = &[$($law::ENTRY),*];

            /// The law called `name` with the given parameter values; `None` where there is no such law.
            // Some roles have a law called `None`, so the option is written out.
            pub fn build(
                name: &str,
                values: &Values,
            ) -> ::core::option::Option<Result<Self, InvalidParameter>> {
                $(if name == $law::ENTRY.name {
                    let complete = $law::ENTRY.complete(values);
                    return Some(complete.and_then(|values| $law::from_values(&values)).map(Self::$law));
                })*
                ::core::option::Option::None
            }

            /// The law's description.
            pub fn entry(&self) -> &'static LawEntry {
                match self { $(Self::$law(_) => &<$law as Law>::ENTRY,)* }
            }
        }
    };
}

pub(crate) use law_list;
