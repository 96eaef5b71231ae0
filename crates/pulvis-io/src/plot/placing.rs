//! Where labels hide least.

use super::canvas::text_width;
use super::draw::{Mark, Panel, TICK_FONT};
use super::geometry::{Point, Rectangle, dashes};

/// Distance of the places that stand for a curve \[pt\].
const STEP: f64 = 3.0;

/// Points all along the curves of a panel, and its symbols (which weigh more than the line they hide).
pub(super) fn occupied(panel: &Panel<'_>) -> Vec<Point> {
    let mut places: Vec<Point> = panel.marks().iter().flat_map(Mark::corners).collect();
    for (number, series) in panel.chart.series.iter().enumerate() {
        if series.style.is_unconnected() {
            places.extend(panel.symbols(number).flat_map(|symbol| [symbol; 3]));
            continue;
        }
        for piece in panel.pieces(number) {
            places.extend(dashes(&piece, STEP, STEP).into_iter().flatten());
        }
    }
    places
}

/// How much of what is drawn lies below a label.
pub(super) fn covered(places: &[Point], label: Rectangle) -> usize {
    places.iter().filter(|&&place| label.contains(place)).count()
}

/// Place of the upright label of a marker at abscissa `x` \[pt\]: at the upper or lower end of its line, right or left of
/// it, wherever it hides least; right and above if nothing is in the way.
pub(super) fn marker_label(frame: Rectangle, x: f64, label: &str, places: &[Point]) -> Rectangle {
    let (width, height) = (TICK_FONT + 2.0, text_width(label, TICK_FONT));
    let (above, below) = (frame.top + 8.0, frame.bottom - 8.0 - height);
    let (right, left) = (x + 4.0, x - width - 4.0);
    let candidates = [(right, above), (left, above), (right, below), (left, below)];
    let at = |(left, top): Point| Rectangle { left, top, right: left + width, bottom: top + height };
    let outside = |place: &Rectangle| place.right > frame.right || place.left < frame.left;
    let judged = candidates.map(at).into_iter();
    judged.min_by_key(|place| (outside(place), covered(places, *place))).unwrap_or(at(candidates[0]))
}

/// Points all over a rectangle, so that other labels keep away from it.
pub(super) fn spread(rectangle: Rectangle) -> impl Iterator<Item = Point> {
    let count = |length: f64| (length / STEP).ceil().clamp(1.0, 1000.0) as usize;
    let (columns, rows) = (count(rectangle.width()), count(rectangle.height()));
    (0..columns * rows).map(move |number| {
        let (column, row) = (number % columns, number / columns);
        (rectangle.left + STEP * column as f64, rectangle.top + STEP * row as f64)
    })
}
