//! Text in pixels. Each glyph stands at its own bearing and is kerned with its neighbour: the drawing library leaves the
//! bearings out, which sets letters unevenly.

use crate::{IoError, font};
use ab_glyph::{Font, PxScale, PxScaleFont, ScaleFont, point};

/// Em per font size: what the drawing library's SVG writer makes of a size.
pub(super) const EM: f64 = 1.0 / 1.24;

/// Height of a small x over the em in the embedded font.
const X_HEIGHT: f64 = 0.547;

/// Distances of the baseline from the given position \[em\], as the SVG writer has them.
pub(super) const BELOW_TOP: f64 = 0.76;
pub(super) const BELOW_MIDDLE: f64 = 0.5 * X_HEIGHT;
pub(super) const ABOVE_BOTTOM: f64 = 0.5 * X_HEIGHT;

fn scaled(em: f64) -> Result<PxScaleFont<&'static ab_glyph::FontRef<'static>>, IoError> {
    let font = font::embedded()?;
    // The scale is the height from the deepest descender to the highest ascender.
    let units = font.units_per_em().unwrap_or(font.height_unscaled());
    Ok(font.as_scaled(PxScale::from(em as f32 * font.height_unscaled() / units)))
}

/// Width of a text in the unit of `em`.
pub(super) fn width(text: &str, em: f64) -> f64 {
    let Ok(font) = scaled(em) else { return 0.0 };
    let mut width = 0.0;
    let mut previous = None;
    for glyph in text.chars().map(|character| font.glyph_id(character)) {
        width += previous.map_or(0.0, |previous| font.kern(previous, glyph)) + font.h_advance(glyph);
        previous = Some(glyph);
    }
    f64::from(width)
}

/// Calls `draw` with right, down and coverage (0 to 1) for each pixel that a text touches, whose baseline starts at `start`.
pub(super) fn rasterise(
    text: &str,
    em: f64,
    start: (f64, f64),
    mut draw: impl FnMut(i32, i32, f32),
) -> Result<(), IoError> {
    let font = scaled(em)?;
    let mut at = start.0 as f32;
    let mut previous = None;
    for id in text.chars().map(|character| font.glyph_id(character)) {
        at += previous.map_or(0.0, |previous| font.kern(previous, id));
        previous = Some(id);
        let glyph = id.with_scale_and_position(font.scale(), point(at, start.1 as f32));
        if let Some(outline) = font.outline_glyph(glyph) {
            let corner = outline.px_bounds().min;
            outline.draw(|x, y, share| draw(corner.x as i32 + x as i32, corner.y as i32 + y as i32, share));
        }
        at += font.h_advance(id);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Columns that have ink, from a text's start on.
    fn ink(text: &str) -> Vec<bool> {
        let mut columns = vec![false; 200];
        rasterise(text, 60.0, (20.0, 60.0), |x, _, share| columns[x as usize] |= share > 0.5).unwrap();
        columns
    }

    #[test]
    fn letters_stand_where_their_bearings_put_them() {
        // In "tit" the i is as far from the t before it as its left bearing and the t's right bearing say; without bearings
        // it would touch one of them.
        let columns = ink("HHH");
        let edges: Vec<usize> =
            (1..columns.len()).filter(|&x| columns[x] != columns[x - 1] || x == 1).collect();
        let gaps: Vec<usize> = edges[1..].chunks(2).map(|pair| pair[0]).collect();
        assert_eq!(gaps.len(), 3, "three letters with gaps between: {edges:?}");
        assert!((gaps[1] - gaps[0]).abs_diff(gaps[2] - gaps[1]) <= 1, "evenly: {gaps:?}");
        assert!(edges[1] > 20 + 3, "the bearing of H is a tenth of the em: {edges:?}");
    }

    #[test]
    fn a_pair_that_overhangs_is_drawn_together_but_not_into_one() {
        assert!(width("Ta", 100.0) < width("T", 100.0) + width("a", 100.0));
        assert!(ink("Ta").iter().filter(|ink| **ink).count() > ink("T").iter().filter(|ink| **ink).count());
    }
}
