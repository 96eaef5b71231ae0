//! Scenario files of Pulvis: text with units in, checked SI values out.
//!
//! From the bottom up:
//! - [`unit`], [`quantity`]: `"1.1 mm"` to 0.0011, checked against a [`pulvis_math::Dimension`];
//! - [`document`]: one TOML file whose every key and value remembers its place, and replaced values;
//! - [`reader`], [`shape`]: tables are walked key by key, and *all* mistakes are collected;
//! - [`error`], [`problem`]: where it is wrong, what was found, what was expected, what to do.
//!
//! # Example
//! ```
//! use pulvis_input::{Document, Dimension, QuantityRule};
//!
//! let document = Document::from_str("pair.toml", "radius = \"1.1 mm\"\ndensity = \"2 g/cm3\"")?;
//! let (radius, density) = document.read(|mut table| {
//!     let radius = table.required("radius", QuantityRule::of(Dimension::LENGTH).above(0.0));
//!     let density = table.required("density", Dimension::DENSITY);
//!     table.finish();
//!     Ok((radius?, density?)) // only here, so that one run reports every mistake
//! })?;
//! assert_eq!((radius, density), (1.1e-3, 2000.0));
//! # Ok::<(), pulvis_input::InputErrors>(())
//! ```

mod decimal;
pub mod document;
pub mod error;
mod list;
mod load;
mod overrides;
pub mod problem;
pub mod quantity;
pub mod reader;
mod rule;
pub mod shape;
mod similar;
mod source;
pub mod unit;
mod value;

pub use document::Document;
pub use error::{InputError, InputErrors, Place};
pub use list::{List, Vector};
pub use overrides::Replacement;
pub use problem::Problem;
pub use pulvis_math::Dimension;
pub use quantity::{QuantityError, QuantityRule, parse_quantity};
pub use reader::{Location, Reported, TableReader, ValueReader};
pub use shape::{Boolean, Choice, Integer, Name, Shape, Text};
