//! The embedded font, shared by plots and pictures.

use crate::IoError;
use plotters::style::{FontStyle, register_font};
use std::sync::OnceLock;

/// Name under which drawing code asks for the font.
pub(crate) const FAMILY: &str = "sans-serif";

/// DejaVu Sans; licence in `assets/README.md`.
static DEJAVU_SANS: &[u8] = include_bytes!("../assets/DejaVuSans.ttf");

/// Makes the font known to the drawing library, once per process.
pub(crate) fn register() -> Result<(), IoError> {
    static READABLE: OnceLock<bool> = OnceLock::new();
    let readable = *READABLE.get_or_init(|| register_font(FAMILY, FontStyle::Normal, DEJAVU_SANS).is_ok());
    if readable { Ok(()) } else { Err(IoError::drawing("the embedded font cannot be read")) }
}
