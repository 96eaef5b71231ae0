//! Closed forms that the contact laws are verified against.
//!
//! Nothing here knows the laws of this crate, and no law calls anything here: a formula that verified itself
//! would verify nothing. Everything is a pure function of `f64` in SI units.
//!
//! # Sources
//!
//! * **S0**: Singh, Magnanimo & Luding, *Sticking of adhesive particles in elasto-plastic collisions*.
//! * **S1**: Singh, Magnanimo & Luding, *Contact model for sticking of adhesive meso-particles*,
//!   arXiv:1503.03720.
//!
//! Where a printed equation is wrong, the function gives the corrected form and says what was printed.
//!
//! # One idea carries most of it
//!
//! Write `s = (k2 - k1)/k1` for the excess of the unloading stiffness, `b = kc/k1` and `D` for the overlap
//! that the contact remembers. Whatever interpolation yields `k2(D)`, one full loop encloses
//!
//! ```text
//! W = (1/2) k1 D^2 q(s),   q(s) = s (1 + b)/(1 + b + s),
//! ```
//!
//! and the constant adhesive force `f_a` does no net work over a closed loop. So the kinetic energy at the
//! end of the contact is `E_f = E_i - W` in *both* regimes of the papers, and every velocity, threshold and
//! sticking overlap follows from `D`. For `f_a = 0` below the limit this gives `e_n^2 = 1 - q = (1 + b - b
//! s)/(1 + b + s)`, which is S1 (32) with its two terms combined.
//!
//! All formulas hold for `gamma_0 = 0` except those of [`linear`] and the dashpot of [`hertz`]. The elastic spheres of
//! [`hertz`] and [`jkr`] and the pair of [`walton_johnson`] are not of this family.

pub mod asymptotes;
pub mod bond;
mod branches;
pub mod dimensionless;
mod duration;
pub mod eepa;
pub mod energies;
mod error;
mod head_on;
pub mod hertz;
pub mod jkr;
pub mod linear;
mod parameters;
pub mod pasha;
mod restitution;
pub mod sticking;
pub mod thornton_ning;
mod trajectory;
pub mod tuning;
mod velocities;
pub mod walton_braun;
pub mod walton_johnson;

pub use error::TheoryError;
pub use head_on::{HeadOn, head_on};
pub use hertz::HertzPair;
pub use jkr::JkrPair;
pub use linear::LinearSpringDashpot;
pub use parameters::{Interpolation, LudingPair, LudingParameters, NonContact};
pub use pasha::PashaPair;
pub use restitution::{Regime, Restitution, Stage};
pub use thornton_ning::YieldingPair;
pub use trajectory::{Branch, CollisionState, StuckOscillation, Trajectory};
pub use velocities::CriticalVelocities;
pub use walton_braun::WaltonBraunPair;
pub use walton_johnson::WaltonJohnsonPair;
