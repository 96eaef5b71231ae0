//! Polylines: gaps, clipping, thinning and dashes, all in drawing units.

/// A point of the drawing: right and down from the upper left corner \[pt\].
pub(super) type Point = (f64, f64);

/// A rectangle of the drawing \[pt\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Rectangle {
    pub(super) fn width(&self) -> f64 {
        self.right - self.left
    }

    pub(super) fn height(&self) -> f64 {
        self.bottom - self.top
    }

    pub(super) fn contains(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }
}

/// The visible pieces of a line with gaps (`None`), as polylines inside `frame`.
///
/// Points nearer than a third of a unit to the last one kept are left out: a million points draw as fast as a thousand
/// and look the same, since steep neighbours are far apart even when their abscissas are not.
pub(super) fn visible_pieces(
    points: impl Iterator<Item = Option<Point>>,
    frame: Rectangle,
) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut last: Option<Point> = None;
    // End of the piece that may go on; `None` after a gap or a cut.
    let mut open: Option<Point> = None;
    for point in points {
        let (Some(from), Some(to)) = (last, point) else {
            last = point;
            open = None;
            continue;
        };
        if (to.0 - from.0).hypot(to.1 - from.1) < 1.0 / 3.0 {
            continue;
        }
        last = Some(to);
        let Some((start, end)) = clip(from, to, frame) else {
            open = None;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if open == Some(start) => piece.push(end),
            _ => pieces.push(vec![start, end]),
        }
        open = (end == to).then_some(end);
    }
    pieces
}

/// The part of a segment inside the rectangle (Liang and Barsky 1984).
fn clip(from: Point, to: Point, frame: Rectangle) -> Option<(Point, Point)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let sides = [
        (-dx, from.0 - frame.left),
        (dx, frame.right - from.0),
        (-dy, from.1 - frame.top),
        (dy, frame.bottom - from.1),
    ];
    for (speed, room) in sides {
        if speed == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if speed < 0.0 {
            enter = enter.max(room / speed);
        } else {
            leave = leave.min(room / speed);
        }
    }
    let at = |s: f64| (from.0 + s * dx, from.1 + s * dy);
    // The ends themselves stay bitwise what they were, so that pieces can be recognised as joined.
    let start = if enter == 0.0 { from } else { at(enter) };
    let end = if leave == 1.0 { to } else { at(leave) };
    (enter <= leave).then_some((start, end))
}

/// Cuts a polyline into dashes.
pub(super) fn dashes(line: &[Point], on: f64, off: f64) -> Vec<Vec<Point>> {
    let mut pieces = Vec::new();
    let mut current: Vec<Point> = line.first().copied().into_iter().collect();
    let (mut drawing, mut left) = (true, on);
    for pair in line.windows(2) {
        let (mut from, to) = (pair[0], pair[1]);
        let mut length = (to.0 - from.0).hypot(to.1 - from.1);
        while length > left {
            let share = left / length;
            from = (from.0 + share * (to.0 - from.0), from.1 + share * (to.1 - from.1));
            length -= left;
            if drawing {
                extend(&mut current, from);
                pieces.push(std::mem::take(&mut current));
            } else {
                current = vec![from];
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
        left -= length;
        if drawing {
            extend(&mut current, to);
        }
    }
    if drawing && current.len() > 1 {
        pieces.push(current);
    }
    pieces
}

/// Adds a point unless it is the last one again, as happens where a dash ends in a corner.
fn extend(piece: &mut Vec<Point>, point: Point) {
    if piece.last() != Some(&point) {
        piece.push(point);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    const FRAME: Rectangle = Rectangle { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_gap_and_the_frame_cut_a_line() {
        let points =
            [Some((1.0, 1.0)), Some((2.0, 2.0)), None, Some((5.0, 5.0)), Some((15.0, 5.0)), Some((5.0, 7.0))];
        let pieces = visible_pieces(points.into_iter(), FRAME);
        let expected =
            [vec![(1.0, 1.0), (2.0, 2.0)], vec![(5.0, 5.0), (10.0, 5.0)], vec![(10.0, 6.0), (5.0, 7.0)]];
        assert_eq!(pieces, expected);
    }

    #[test]
    fn a_line_that_passes_outside_is_not_drawn() {
        let pieces = visible_pieces([Some((-1.0, 5.0)), Some((5.0, -30.0))].into_iter(), FRAME);
        assert!(pieces.is_empty());
    }

    #[test]
    fn crowded_points_are_thinned() {
        let points = (0..100_000).map(|n| Some((f64::from(n) * 1.0e-4, 5.0)));
        let pieces = visible_pieces(points, FRAME);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].len() < 32);
    }

    #[test]
    fn dashes_cover_their_share_of_the_line() {
        let pieces = dashes(&[(0.0, 0.0), (5.0, 0.0), (5.0, 7.0)], 2.0, 1.0);
        let length: f64 = pieces
            .iter()
            .flat_map(|piece| piece.windows(2))
            .map(|p| (p[1].0 - p[0].0).hypot(p[1].1 - p[0].1))
            .sum();
        assert!((length - 8.0).abs() < 1e-12, "two thirds of 12: {length}");
        assert_eq!(pieces[1], [(3.0, 0.0), (5.0, 0.0)]);
    }
}
