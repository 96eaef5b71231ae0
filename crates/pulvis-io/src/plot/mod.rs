//! Charts of curves as PNG or SVG, meant to be good enough for a paper, and as text in a terminal.
//!
//! A [`Chart`] is one pair of axes with any number of [`Series`]; a [`Figure`] stacks charts in one picture. Colours come
//! from a palette that colour-blind readers can tell apart, and points of different series also differ in shape. Ranges
//! follow the data, the legend takes the emptiest corner.
//!
//! Points that are not finite (or not positive on a logarithmic axis) are gaps in their line; infinities are marked by
//! arrows at the edge, and notes above the panel tell what cannot be shown, of which curve, and from where on. A panel
//! without a finite value says so. A curve is dashed where it hides an earlier one. A power of ten that an axis leaves
//! out becomes the prefix of its unit. In all texts `k_{p}` stands for a k with a lowered p,
//! `k^{a}` for one with a raised a.
//!
//! ```
//! use pulvis_io::plot::{Chart, Figure, Series};
//!
//! # fn main() -> Result<(), pulvis_io::IoError> {
//! # let scratch = tempfile::tempdir().expect("a temporary folder");
//! # let folder = scratch.path();
//! let velocity = (1..=60).map(|n| 0.01 * f64::from(n));
//! let restitution = Chart::new("Restitution")
//!     .x_label("impact velocity [m/s]")
//!     .y_label("coefficient of restitution [-]")
//!     .log_x()
//!     .series(Series::line("theory", velocity.map(|v| (v, 0.8 / (1.0 + v)))))
//!     .series(Series::points("simulation", [(0.01, 0.79), (0.1, 0.73), (0.5, 0.53)]))
//!     .marker(0.2, "sticking limit");
//! restitution.write(&folder.join("restitution.svg"))?;
//!
//! let force = Chart::new("Force").zero_line().series(Series::dashed("loading", [(0.0, 0.0), (1.0, 2.0)]));
//! Figure::new().panel(restitution).panel(force).write(&folder.join("both.png"))?;
//! # Ok(())
//! # }
//! ```

pub(crate) mod axis;
mod bounds;
pub(crate) mod canvas;
mod chart;
mod coincidence;
mod draw;
mod figure;
mod geometry;
mod labels;
mod legend;
mod placing;
pub(crate) mod raster;
pub(crate) mod script;
mod terminal;
mod text;
pub(crate) mod unit;
mod unlocated;
mod vector;

pub use chart::{Axis, Chart, Series, SeriesStyle};
pub use figure::{FORMATS, Figure, PlotFormat};
pub use unit::amount;
