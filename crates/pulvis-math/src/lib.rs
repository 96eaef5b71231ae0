//! Level 0 of the house: scalars, vectors and physical dimensions.
//!
//! Nothing here knows physics. The scalar trait [`Real`] lets one text of a force law serve a
//! single contact (`f64`) and the vectorised contact loop ([`Lanes`]).
//!
//! ```
//! use pulvis_math::{Lanes, Real};
//!
//! fn spring<R: Real>(stiffness: f64, overlap: R) -> R {
//!     R::splat(stiffness) * overlap.max(R::zero())
//! }
//! assert_eq!(spring(10.0, 0.5), 5.0);
//! assert_eq!(spring(10.0, Lanes([0.5, -1.0])), Lanes([5.0, 0.0]));
//! ```

mod dimension;
mod lanes;
mod octet;
mod prefetch;
mod real;
mod vector;

pub use dimension::Dimension;
pub use lanes::{LaneMask, Lanes};
pub use octet::{InstructionSet, Kernel, Octet, Quad, Row, Twin};
pub use prefetch::prefetch;
pub use real::{Mask, Real};
pub use vector::Vector3;
