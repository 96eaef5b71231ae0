//! The embedded font, shared by plots and pictures.

use crate::IoError;
use ab_glyph::FontRef;
use std::sync::OnceLock;

/// Name under which SVG files ask for the font.
pub(crate) const FAMILY: &str = "sans-serif";

/// DejaVu Sans; licence in `assets/README.md`.
static DEJAVU_SANS: &[u8] = include_bytes!("../assets/DejaVuSans.ttf");

/// The font, read once per process.
pub(crate) fn embedded() -> Result<&'static FontRef<'static>, IoError> {
    static FONT: OnceLock<Option<FontRef<'static>>> = OnceLock::new();
    let font = FONT.get_or_init(|| FontRef::try_from_slice(DEJAVU_SANS).ok());
    font.as_ref().ok_or_else(|| IoError::drawing("the embedded font cannot be read"))
}
