//! Level 0 of the house: scalars, vectors and physical dimensions.
//!
//! Nothing here knows physics. With the scalar trait [`Real`], one source text of a force law serves
//! a single contact (`f64`) and the vectorised contact loop ([`Simd8`]).
//!
//! ```
//! use pulvis_math::{F64Array, Real};
//!
//! fn spring<R: Real>(stiffness: f64, overlap: R) -> R {
//!     R::splat(stiffness) * overlap.max(R::zero())
//! }
//! assert_eq!(spring(10.0, 0.5), 5.0);
//! assert_eq!(spring(10.0, F64Array([0.5, -1.0])), F64Array([5.0, 0.0]));
//! ```

mod array;
mod dimension;
pub mod elementary;
mod extremes;
mod prefetch;
mod real;
mod simd8;
mod vector;

pub use array::{ArrayMask, F64Array};
pub use dimension::Dimension;
pub use extremes::{max_or_nan, min_or_nan};
pub use prefetch::prefetch;
pub use real::{Mask, Real};
pub use simd8::{InstructionSet, Kernel, Packed4, Pointer, Routine, Simd4, Simd4Pair, Simd8, Task};
pub use vector::Vector3;
