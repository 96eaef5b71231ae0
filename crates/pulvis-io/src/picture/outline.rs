//! Outlines of walls and cells: the edges that a picture shows of them.

use super::View;
use super::camera::{Vector, cross, unit};

/// Sides of the polygon that stands for a circle: it departs from the circle by a thousandth of the radius.
const SIDES: usize = 72;

/// Coordinates beyond this would overflow in the arithmetic of a picture \[m\].
const LARGEST: f64 = 1.0e100;

/// A box along the axes, shown by its edges: a wall or a periodic cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlineBox {
    /// Lower corner \[m\].
    pub low: [f64; 3],
    /// Upper corner \[m\].
    pub high: [f64; 3],
}

/// A part of a circular cylinder, shown by the circles at its ends and the lines that bound it for the viewer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutlineCylinder {
    /// Middle of the circles at both ends \[m\].
    pub ends: [[f64; 3]; 2],
    /// Radius \[m\].
    pub radius: f64,
}

impl OutlineBox {
    /// The twelve edges; none where the box cannot be drawn.
    pub(super) fn edges(&self) -> Vec<[Vector; 2]> {
        if !self.low.iter().chain(&self.high).all(|x| x.abs() < LARGEST) {
            return Vec::new();
        }
        let corner = |number: usize| {
            std::array::from_fn(|axis| if number >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] })
        };
        let from = |number: usize| {
            let axes = (0..3).filter(move |axis| number >> axis & 1 == 0);
            axes.map(move |axis| [corner(number), corner(number | 1 << axis)])
        };
        (0..8).flat_map(from).collect()
    }
}

impl OutlineCylinder {
    /// The edges as they are seen in this view; none where the cylinder cannot be drawn.
    pub(super) fn edges(&self, view: View) -> Vec<[Vector; 2]> {
        let Self { ends: [low, high], radius } = *self;
        let along: Vector = std::array::from_fn(|axis| high[axis] - low[axis]);
        let fits = low.iter().chain(&high).all(|x| x.abs() < LARGEST) && radius > 0.0 && radius < LARGEST;
        let Some(axis) = unit(along).filter(|_| fits) else { return Vec::new() };
        let aside = [view.direction, [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        // Across the line of sight: there the surface turns away from the viewer.
        let Some(first) = aside.into_iter().find_map(|other| unit(cross(axis, unit(other)?))) else {
            return Vec::new();
        };
        let second = cross(axis, first);
        let on_circle = |centre: Vector, side: usize| -> Vector {
            let angle = std::f64::consts::TAU * side as f64 / SIDES as f64;
            let (sine, cosine) = angle.sin_cos();
            std::array::from_fn(|x| centre[x] + radius * (cosine * first[x] + sine * second[x]))
        };
        let circle = |centre: Vector| {
            (0..SIDES).map(move |side| [on_circle(centre, side), on_circle(centre, side + 1)])
        };
        let lines = [0, SIDES / 2].map(|side| [on_circle(low, side), on_circle(high, side)]);
        circle(low).chain(circle(high)).chain(lines).collect()
    }
}

/// The least and largest coordinates of edges; `None` without edges.
pub(super) fn limits(edges: &[[Vector; 2]]) -> Option<[Vector; 2]> {
    let mut points = edges.iter().flatten();
    let first = *points.next()?;
    Some(points.fold([first, first], |[low, high], point| {
        [std::array::from_fn(|x| low[x].min(point[x])), std::array::from_fn(|x| high[x].max(point[x]))]
    }))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_cylinder_shows_two_circles_and_the_lines_that_bound_it_for_the_viewer() {
        let cylinder = OutlineCylinder { ends: [[0.0, -1.0, 0.0], [0.0, 3.0, 0.0]], radius: 2.0 };
        let along_x = View { direction: [1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };
        let edges = cylinder.edges(along_x);
        assert_eq!(edges.len(), 2 * SIDES + 2);
        for [x, y, z] in edges.iter().flatten() {
            assert!((x.hypot(*z) - 2.0).abs() < 1e-12 && (*y == -1.0 || *y == 3.0));
        }
        // Seen along x, the outline ends at z = ±2.
        for line in &edges[2 * SIDES..] {
            assert!(line.iter().all(|point| (point[2].abs() - 2.0).abs() < 1e-12));
        }
        let [low, high] = limits(&edges).expect("edges");
        for (found, expected) in low.iter().chain(&high).zip([-2.0, -1.0, -2.0, 2.0, 3.0, 2.0]) {
            assert!((found - expected).abs() < 1e-2, "{low:?} {high:?}");
        }
    }

    #[test]
    fn what_cannot_be_drawn_has_no_edges() {
        let ends = [[0.0; 3], [0.0, 0.0, 1.0]];
        for (ends, radius) in [(ends, f64::NAN), (ends, 0.0), ([[0.0; 3]; 2], 1.0), ([[f64::NAN; 3]; 2], 1.0)]
        {
            assert!(OutlineCylinder { ends, radius }.edges(View::OBLIQUE).is_empty());
        }
        assert!(OutlineBox { low: [f64::INFINITY; 3], high: [0.0; 3] }.edges().is_empty());
        let along_the_axis = View { direction: [0.0, 0.0, 1.0], up: [0.0, 1.0, 0.0] };
        assert_eq!(OutlineCylinder { ends, radius: 1.0 }.edges(along_the_axis).len(), 2 * SIDES + 2);
    }
}
