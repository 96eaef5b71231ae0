//! The energies of a contact, account by account.

use std::ops::AddAssign;

use pulvis_math::{F64Array, Real, Simd8};

use crate::levels;

macro_rules! contact_energies {
    (
        stored { $($(#[$doc_stored:meta])* $stored:ident,)* }
        dissipated { $($(#[$doc_dissipated:meta])* $dissipated:ident,)* }
    ) => {
        /// Energies that a contact stores now, energies dissipated since the last call, and the present power of its
        /// dashpots.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct ContactEnergies<R = f64> {
            $($(#[$doc_stored])* pub $stored: R,)*
            $($(#[$doc_dissipated])* pub $dissipated: R,)*
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
                let Self { $($dissipated,)* .. } = Self { viscous_power: R::zero(), ..*self };
                let sum = R::zero();
                $(let sum = sum + $dissipated;)*
                sum
            }
        }

        each_account!($($stored,)* $($dissipated,)*);
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
    /// [remembers](crate::ContactLaws::remembers_normal_motion) something (`with_memory`).
    #[inline(always)]
    pub fn add_dissipated<const RESISTANCE: u8>(&mut self, other: &Self, with_memory: bool) {
        self.viscous_power += other.viscous_power;
        if with_memory {
            self.dissipated_plastic += other.dissipated_plastic;
            self.dissipated_adhesive += other.dissipated_adhesive;
        }
        if RESISTANCE >= levels::SLIDING {
            self.dissipated_sliding += other.dissipated_sliding;
        }
        if RESISTANCE >= levels::ALL {
            self.dissipated_rolling += other.dissipated_rolling;
            self.dissipated_torsion += other.dissipated_torsion;
        }
    }
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
        /// Potential of the attraction, zero beyond its range [J].
        adhesive_potential,
    }
    dissipated {
        /// Dissipated by plastic deformation since the last call [J].
        dissipated_plastic,
        /// Dissipated on the adhesive limit branch and by attraction that sets in suddenly, since the last call [J].
        dissipated_adhesive,
        /// Dissipated by sliding since the last call [J].
        dissipated_sliding,
        /// Dissipated by rolling slip since the last call [J].
        dissipated_rolling,
        /// Dissipated by torsion slip since the last call [J].
        dissipated_torsion,
        /// Power of all dashpots now [W].
        viscous_power,
    }
}
