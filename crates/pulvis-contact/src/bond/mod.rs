//! Bonds: springs along and about the line of centres that hold two bodies together until they break. One file a
//! criterion of breaking; the list is at the end of this file.
//!
//! A bond is a part of the contact model beside the laws of the contact itself. It resists all six relative motions, in
//! tension and compression, at a distance too. What it remembers stands in columns of the contact's memory. A bond that
//! has broken stays broken.

use pulvis_math::Real;

use crate::catalogue::{InvalidParameter, Law, LawEntry, Values};

mod breaking;
mod elastic_brittle;
mod formation;
mod given;
mod jiang;
mod loads;
mod memory;
mod none;
mod parallel_bond;
mod parameters;
mod respond;
mod springs;
mod step;
mod transport;

pub use elastic_brittle::ElasticBrittle;
pub use formation::{ContactSpring, Form, Formation};
pub use jiang::Jiang;
pub use loads::BondLoads;
pub use memory::{BROKEN, BondMemory, INTACT, STATE};
pub use parallel_bond::ParallelBond;
pub use respond::BondResponse;
pub use springs::{BeamTheory, BondSprings, BondStiffness, Dashpots, Elasticity, Section};

/// When a bond breaks.
pub trait BreakingCriterion: Law {
    /// Whether bonds with these loads break.
    fn exceeded<R: Real>(&self, loads: &BondLoads<R>) -> R::Mask;

    /// The tensile force [N] beyond which the bond breaks whatever else loads it, with a cross-section of this radius
    /// [m], zero where the bond has none.
    fn tensile_force(&self, section_radius: f64) -> f64;

    /// Refuses springs that do not fit the criterion.
    fn check_springs(&self, springs: &BondSprings) -> Result<(), InvalidParameter> {
        springs.fit_forces()
    }
}

/// A bond: springs, when they break, and when they form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bond {
    /// The springs and dashpots.
    pub springs: BondSprings,
    /// When they break.
    pub criterion: Criterion,
    /// When they form.
    pub formation: Formation,
}

impl Bond {
    /// How far beyond touching a bond acts [m] between bodies with these radii [m], zero for a wall: the distance at which
    /// it forms, and the extension at which it breaks at the latest.
    pub fn interaction_range(&self, radii: [f64; 2]) -> f64 {
        let distance = self.formation.distance;
        let stiffness = self.springs.stiffness(radii[0] + radii[1] + distance, springs::smaller(radii));
        distance + self.criterion.tensile_force(stiffness.section_radius) / stiffness.normal
    }

    /// The stiffnesses of a bond between bodies with these radii [m], zero for a wall, that formed as they touched.
    pub fn stiffness_at_touch(&self, radii: [f64; 2]) -> BondStiffness {
        self.springs.stiffness(radii[0] + radii[1], springs::smaller(radii))
    }

    /// The coefficients of the dashpots of such a bond: along it [kg/s], across it [kg/s], of bending and of torsion [N m s].
    pub fn dashpots_at_touch(&self, radii: [f64; 2]) -> [f64; 4] {
        self.springs.dashpots(&self.stiffness_at_touch(radii))
    }

    /// The name and the number of what the bond does at an overlap [m]; zero is the number of a bond that does not act.
    /// The bond's memory begins at the column `start`.
    pub fn branch(&self, radii: [f64; 2], overlap: f64, columns: &[f64], start: usize) -> (u8, &'static str) {
        let memory: BondMemory<f64> = crate::memory::load(columns, start);
        let forms = self.formation.form == Form::FirstTouch && memory.state == 0.0 && overlap > 0.0;
        if memory.state != INTACT && !forms {
            return (0, "unbonded");
        }
        let reference = if forms { 0.0 } else { memory.overlap };
        let stiffness = self.springs.stiffness(radii[0] + radii[1] - reference, springs::smaller(radii));
        let loads = BondLoads {
            normal: stiffness.normal * (overlap - reference),
            shear: stiffness.shear * memory.shear.norm(),
            bending: stiffness.bending * memory.bending.norm(),
            torsion: (stiffness.torsion * memory.twist).abs(),
            section_radius: stiffness.section_radius,
            harmonic_radius: springs::harmonic(radii),
        };
        if self.criterion.exceeded(&loads) { (0, "unbonded") } else { (1, "bonded") }
    }

    /// Whether the contact's own laws are left out while bodies are bonded.
    pub fn hides_contact(&self) -> bool {
        self.formation.contact_spring == ContactSpring::Off
    }
}

macro_rules! bonds {
    ($($law:ident),* $(,)?) => {
        /// Any criterion of breaking of the catalogue.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Criterion {
            $(#[doc = concat!("See [`", stringify!($law), "`].")] $law($law),)*
        }

        impl Criterion {
            /// See [`BreakingCriterion::exceeded`].
            #[inline(always)]
            pub fn exceeded<R: Real>(&self, loads: &BondLoads<R>) -> R::Mask {
                match self { $(Self::$law(law) => law.exceeded(loads),)* }
            }

            /// See [`BreakingCriterion::tensile_force`].
            pub fn tensile_force(&self, section_radius: f64) -> f64 {
                match self { $(Self::$law(law) => law.tensile_force(section_radius),)* }
            }
        }

        impl Bond {
            /// The bond's description.
            pub fn entry(&self) -> &'static LawEntry {
                match self.criterion { $(Criterion::$law(_) => &<$law as Law>::ENTRY,)* }
            }
        }

        /// The descriptions of all bonds, and of none.
        pub fn entries() -> Vec<&'static LawEntry> {
            vec![&none::ENTRY, $(&<$law as Law>::ENTRY),*]
        }

        /// The bond called `name` with the given parameter values; the outer `None` where there is no such bond, the inner
        /// one where bodies are to have no bond.
        pub fn build(name: &str, values: &Values) -> Option<Result<Option<Bond>, InvalidParameter>> {
            if name == none::ENTRY.name {
                return Some(none::ENTRY.complete(values).map(|_| None));
            }
            $(if name == $law::ENTRY.name {
                return Some($law::ENTRY.complete(values).and_then(|values| {
                    let law = $law::from_values(&values)?;
                    let springs = BondSprings::from_values(&values)?;
                    law.check_springs(&springs)?;
                    let formation = Formation::from_values(&values)?;
                    Ok(Some(Bond { springs, criterion: Criterion::$law(law), formation }))
                }));
            })*
            None
        }
    };
}

// The list of criteria: a new one is its file and its name here.
bonds![ElasticBrittle, Jiang, ParallelBond];
