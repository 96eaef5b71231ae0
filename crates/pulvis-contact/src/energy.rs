//! The energies of a contact, account by account.

use std::ops::AddAssign;

use pulvis_math::{F64Array, Real, Simd8};

use crate::levels;

macro_rules! contact_energies {
    (
        stored { $($(#[$doc_stored:meta])* $stored:ident,)* }
        dissipated { $($(#[$doc_dissipated:meta])* $dissipated:ident,)* }
        power { $($(#[$doc_power:meta])* $power:ident,)* }
    ) => {
        /// Energies that a contact stores now, energies dissipated since the last call, and the present power of its
        /// dashpots.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct ContactEnergies<R = f64> {
            $($(#[$doc_stored])* pub $stored: R,)*
            $($(#[$doc_dissipated])* pub $dissipated: R,)*
            $($(#[$doc_power])* pub $power: R,)*
        }

        impl<R: Real> ContactEnergies<R> {
            /// Adds the stored energies; dissipated energies stay.
            #[inline(always)]
            pub fn add_stored(&mut self, other: &Self) {
                $(self.$stored += other.$stored;)*
            }

            /// The sum of the stored energies [J].
            pub fn stored(&self) -> R {
                let sum = R::zero();
                $(let sum = sum + self.$stored;)*
                sum
            }

            /// The sum of the energies dissipated since the last call, without the work of dashpots [J].
            pub fn dissipated(&self) -> R {
                let sum = R::zero();
                $(let sum = sum + self.$dissipated;)*
                sum
            }

            /// The same stored energies and powers with the dissipated energies of `other`.
            #[must_use]
            pub fn with_dissipated_of(mut self, other: &Self) -> Self {
                $(self.$dissipated = other.$dissipated;)*
                self
            }

            /// The same stored energies and powers, and the dissipated energies of both.
            #[must_use]
            pub fn plus_dissipated_of(mut self, other: &Self) -> Self {
                $(self.$dissipated += other.$dissipated;)*
                self
            }
        }

        each_account!($($stored,)* $($dissipated,)* $($power,)*);
    };
}

macro_rules! each_account {
    ($($account:ident,)*) => {
        // Not derived: what is derived is not inlined by force.
        impl<R: Real> Default for ContactEnergies<R> {
            #[inline(always)]
            fn default() -> Self {
                Self { $($account: R::zero(),)* }
            }
        }

        impl<R: Real> AddAssign for ContactEnergies<R> {
            #[inline(always)]
            fn add_assign(&mut self, other: Self) {
                $(self.$account += other.$account;)*
            }
        }

        impl<R: Real> ContactEnergies<R> {
            /// The accounts by their names.
            pub fn accounts(&self) -> [(&'static str, R); [$(stringify!($account)),*].len()] {
                [$((stringify!($account), self.$account)),*]
            }

            /// The accounts as `account` knows them by their names, asked in the order of [`accounts`](Self::accounts).
            ///
            /// # Errors
            /// The first of `account`.
            pub fn from_accounts<E>(mut account: impl FnMut(&'static str) -> Result<R, E>) -> Result<Self, E> {
                Ok(Self { $($account: account(stringify!($account))?,)* })
            }

            /// The sum over the lanes, account by account.
            #[inline(always)]
            pub fn sum_lanes(&self) -> ContactEnergies<f64> {
                ContactEnergies { $($account: self.$account.sum_lanes(),)* }
            }

            /// Lane by lane, in memory.
            #[inline(always)]
            pub fn to_array(&self) -> ContactEnergies<F64Array<8>>
            where
                R: Simd8,
            {
                ContactEnergies { $($account: self.$account.to_array(),)* }
            }

            /// Every account where `mask` holds, zero elsewhere.
            #[inline(always)]
            pub fn keep_where(&self, mask: R::Mask) -> Self {
                Self { $($account: self.$account.keep_where(mask),)* }
            }
        }
    };
}

impl<R: Real> ContactEnergies<R> {
    /// Adds the energies dissipated by contacts of a [level](levels) of resistance, and the power of their dashpots; stored
    /// energies stay. Along the normal, a contact dissipates only if it
    /// [remembers](crate::ContactLaws::remembers_normal_motion) something (`with_memory`), and a
    /// [common](crate::ContactModel::is_common) one only plastically and by adhesion.
    #[inline(always)]
    pub fn add_dissipated<const RESISTANCE: u8>(&mut self, other: &Self, with_memory: bool, common: bool) {
        self.viscous_power += other.viscous_power;
        if with_memory {
            self.dissipated_plastic += other.dissipated_plastic;
            self.dissipated_adhesive += other.dissipated_adhesive;
            if !common {
                self.dissipated_capillary += other.dissipated_capillary;
                self.dissipated_fracture += other.dissipated_fracture;
                self.dissipated_thermal += other.dissipated_thermal;
            }
        }
        if RESISTANCE >= levels::SLIDING {
            self.dissipated_sliding += other.dissipated_sliding;
        }
        if RESISTANCE >= levels::ALL {
            self.dissipated_rolling += other.dissipated_rolling;
            self.dissipated_torsion += other.dissipated_torsion;
        }
    }

    /// The sum of the potentials between the bodies, whatever it is that attracts them [J].
    pub fn attraction(&self) -> R {
        self.adhesive_potential + self.capillary + self.electrostatic
    }

    /// Books the `potential` [J] of an attraction, and what it `dissipated` [J] since the last call.
    #[inline(always)]
    pub(crate) fn attract(&mut self, account: AttractionAccount, potential: R, dissipated: R) {
        match account {
            AttractionAccount::Adhesive => {
                self.adhesive_potential += potential;
                self.dissipated_adhesive += dissipated;
            }
            AttractionAccount::Capillary => {
                self.capillary += potential;
                self.dissipated_capillary += dissipated;
            }
            // Charges dissipate nothing.
            AttractionAccount::Electrostatic => self.electrostatic += potential,
        }
    }
}

/// The accounts of an attraction at a distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AttractionAccount {
    /// `adhesive_potential` and `dissipated_adhesive`.
    #[default]
    Adhesive,
    /// `capillary` and `dissipated_capillary`.
    Capillary,
    /// `electrostatic`; nothing is dissipated.
    Electrostatic,
}

contact_energies! {
    stored {
        /// Stored on the elastic branch of the normal law [J].
        elastic_normal,
        /// Stored in the sliding spring [J].
        elastic_sliding,
        /// Stored in the rolling spring [J].
        elastic_rolling,
        /// Stored in the torsion spring [J].
        elastic_torsion,
        /// Stored in the springs of the bond [J].
        elastic_bond,
        /// Potential of the attraction, zero beyond its range [J].
        adhesive_potential,
        /// Potential of liquid bridges, zero where they break [J].
        capillary,
        /// Potential of charges, zero beyond their cutoff [J].
        electrostatic,
    }
    dissipated {
        /// Dissipated by plastic deformation since the last call [J].
        dissipated_plastic,
        /// Dissipated on the adhesive limit branch and by attraction that sets in suddenly, since the last call [J].
        dissipated_adhesive,
        /// Dissipated by liquid bridges that formed, since the last call [J].
        dissipated_capillary,
        /// Dissipated by bonds that broke, since the last call [J].
        dissipated_fracture,
        /// Dissipated because parameters changed with time or temperature, since the last call; negative where the change
        /// did work on the contact [J].
        dissipated_thermal,
        /// Dissipated by sliding since the last call [J].
        dissipated_sliding,
        /// Dissipated by rolling slip since the last call [J].
        dissipated_rolling,
        /// Dissipated by torsion slip since the last call [J].
        dissipated_torsion,
    }
    power {
        /// Power of all dashpots now [W].
        viscous_power,
    }
}
