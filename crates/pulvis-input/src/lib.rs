//! Scenario files of Pulvis: text with units in, checked SI values out.
//!
//! From the bottom up:
//! - [`mod@unit`], [`quantity`]: `"1.1 mm"` to 0.0011, checked against a [`pulvis_math::Dimension`];
//! - [`document`]: one TOML file whose every key and value remembers its place; [`overrides`]
//!   replace values;
//! - [`reader`], [`value_reader`], [`shape`], [`list`]: tables are walked key by key, and *all*
//!   mistakes are collected; [`parameters`] does so for the laws of the catalogue;
//! - [`error`], [`problem`]: where it is wrong, what was found, what was expected, what to do;
//! - [`mod@contact`], [`comparison`]: all laws of a contact, and contacts to be compared;
//! - [`scenario`], [`collision`], [`probe`]: the scenario of a run, of a pair collision, and of a contact on a
//!   prescribed path, each checked as a whole; [`figure`]: a figure that is reproduced from such scenarios;
//!   [`study`]: a scenario of a run over seeds and values;
//! - [`schema`]: the same files as JSON schemas, for editors.
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

mod any_quantity;
pub mod collision;
pub mod comparison;
pub mod contact;
pub mod context;
mod decimal;
pub mod document;
pub mod error;
pub mod figure;
pub mod list;
mod load;
pub mod material;
mod mistake;
pub mod overrides;
pub mod parameters;
pub mod probe;
pub mod problem;
pub mod quantity;
pub mod reader;
mod rule;
pub mod scenario;
pub mod schema;
mod setting;
pub mod shape;
mod similar;
mod source;
mod spacing;
pub mod study;
pub mod surroundings;
mod syntax;
pub mod unit;
mod value;
pub mod value_reader;

pub use any_quantity::AnyQuantity;
pub use comparison::LabelledContact;
pub use contact::{NamedContact, NamedLaw, read_contact, read_contact_model};
pub use context::{Location, Reported};
pub use document::Document;
pub use error::{InputError, InputErrors, Place};
pub use list::{List, Vector};
pub use overrides::{Copied, Replacement};
pub use parameters::{read_parameters, refuse_parameter};
pub use problem::Problem;
pub use pulvis_math::Dimension;
pub use quantity::{QuantityError, QuantityRule, parse_quantity};
pub use reader::TableReader;
pub use scenario::Scenario;
pub use shape::{Boolean, Choice, Integer, Name, Shape, Text};
pub use surroundings::{BodyQuantity, Surroundings};
pub use value_reader::ValueReader;
