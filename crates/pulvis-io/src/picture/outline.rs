//! Outlines of walls and cells: the edges that a picture shows of them.

use super::camera::Camera;
use super::vector::Vector;

/// Sides of the polygon that stands for a circle: it departs from the circle by a thousandth of the radius.
const SIDES: usize = 72;

/// Coordinates beyond this would overflow in the arithmetic of a picture \[m\].
pub(super) const LARGEST: f64 = 1.0e100;

/// A straight line from here to there \[m\].
pub type Edge = [[f64; 3]; 2];

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
    /// The twelve edges; the four of a flat box; none where the box cannot be drawn.
    pub fn edges(&self) -> Vec<Edge> {
        if !self.low.iter().chain(&self.high).all(|x| x.abs() < LARGEST) {
            return Vec::new();
        }
        let corner = |number: usize| {
            std::array::from_fn(|axis| if number >> axis & 1 == 0 { self.low[axis] } else { self.high[axis] })
        };
        let is_flat = |axis: usize| self.low[axis] == self.high[axis];
        let from = |number: usize| {
            let axes = (0..3).filter(move |axis| number >> axis & 1 == 0 && !is_flat(*axis));
            axes.map(move |axis| [corner(number), corner(number | 1 << axis)])
        };
        let is_needed = |number: &usize| (0..3).all(|axis| number >> axis & 1 == 0 || !is_flat(axis));
        (0..8).filter(is_needed).flat_map(from).collect()
    }
}

impl OutlineCylinder {
    /// The circles at its ends; none where the cylinder cannot be drawn.
    pub(super) fn circles(&self) -> Vec<Edge> {
        let Some([axis, _]) = self.axis() else { return Vec::new() };
        let aside = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let Some(first) = aside.into_iter().find_map(|other| {
            let across = axis.cross(Vector(other));
            (across.norm() > 0.1).then(|| across.unit())?
        }) else {
            return Vec::new();
        };
        let second = axis.cross(first);
        let on_circle = |centre: [f64; 3], side: usize| {
            let (sine, cosine) = (std::f64::consts::TAU * side as f64 / SIDES as f64).sin_cos();
            let radial = first.times(cosine).plus(second.times(sine));
            Vector(centre).plus(radial.times(self.radius)).0
        };
        let circle = |centre: [f64; 3]| {
            (0..SIDES).map(move |side| [on_circle(centre, side), on_circle(centre, side + 1)])
        };
        let [low, high] = self.ends;
        circle(low).chain(circle(high)).collect()
    }

    /// The two lines that bound the cylinder for the viewer; none from inside it and along its axis.
    pub(super) fn sides(&self, camera: &Camera) -> Vec<Edge> {
        let Some([axis, from]) = self.axis() else { return Vec::new() };
        // Across the axis, from there to the eye: what the radius is of this distance is 0 for parallel rays.
        let (to_eye, share) = match camera.eye() {
            None => (camera.forward().times(-1.0), 0.0),
            Some(eye) => {
                let across = eye.minus(from).minus(axis.times(eye.minus(from).dot(axis)));
                (across, self.radius / across.norm())
            }
        };
        let across = to_eye.minus(axis.times(to_eye.dot(axis)));
        let Some(towards) = across.unit().filter(|_| share < 1.0 && across.norm() > 1e-6 * to_eye.norm())
        else {
            return Vec::new();
        };
        let aside = axis.cross(towards);
        let radial = |sign: f64| {
            towards.times(share).plus(aside.times(sign * (1.0 - share * share).sqrt())).times(self.radius)
        };
        [1.0, -1.0].map(|sign| self.ends.map(|end| Vector(end).plus(radial(sign)).0)).into()
    }

    /// Unit vector along the axis, and the first end; `None` where the cylinder cannot be drawn.
    fn axis(&self) -> Option<[Vector; 2]> {
        let Self { ends: [low, high], radius } = *self;
        let fits = low.iter().chain(&high).all(|x| x.abs() < LARGEST) && radius > 0.0 && radius < LARGEST;
        let axis = Vector(high).minus(Vector(low)).unit()?;
        fits.then_some([axis, Vector(low)])
    }
}

/// The least and largest coordinates of edges; `None` without edges.
pub(super) fn limits(edges: &[Edge]) -> Option<[[f64; 3]; 2]> {
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
    use crate::picture::selection::Selection;
    use crate::picture::{Projection, Scene, View};

    #[test]
    fn a_cylinder_shows_two_circles_and_the_lines_that_bound_it_for_the_viewer() {
        let cylinder = OutlineCylinder { ends: [[0.0, -1.0, 0.0], [0.0, 3.0, 0.0]], radius: 2.0 };
        let circles = cylinder.circles();
        assert_eq!(circles.len(), 2 * SIDES);
        for [x, y, z] in circles.iter().flatten() {
            assert!((x.hypot(*z) - 2.0).abs() < 1e-12 && (*y == -1.0 || *y == 3.0));
        }
        let [low, high] = limits(&circles).expect("edges");
        for (found, expected) in low.iter().chain(&high).zip([-2.0, -1.0, -2.0, 2.0, 3.0, 2.0]) {
            assert!((found - expected).abs() < 1e-2, "{low:?} {high:?}");
        }
    }

    #[test]
    fn the_sides_of_a_cylinder_are_where_lines_of_sight_touch_it() {
        let cylinder = OutlineCylinder { ends: [[0.0, -1.0, 0.0], [0.0, 3.0, 0.0]], radius: 2.0 };
        for projection in [Projection::Perspective, Projection::Parallel] {
            let scene = Scene { cylinders: &[cylinder], projection, ..Scene::new(&[], &[], &[]) };
            let camera = Camera::fit(&scene, &Selection::of(&scene));
            let sides = cylinder.sides(&camera);
            assert_eq!(sides.len(), 2);
            for [x, y, z] in sides.iter().flatten() {
                assert!((x.hypot(*z) - 2.0).abs() < 1e-12 && (*y == -1.0 || *y == 3.0));
                let normal = Vector([x / 2.0, 0.0, z / 2.0]);
                let sight = match camera.eye() {
                    Some(eye) => Vector([*x, *y, *z]).minus(eye),
                    None => camera.forward(),
                };
                assert!(normal.dot(sight).abs() < 1e-9, "{projection:?}");
            }
        }
        let along = Scene {
            view: View { direction: [0.0, 1.0, 0.0], up: [0.0, 0.0, 1.0] },
            cylinders: &[cylinder],
            ..Scene::new(&[], &[], &[])
        };
        assert!(cylinder.sides(&Camera::fit(&along, &Selection::of(&along))).is_empty());
    }

    #[test]
    fn what_cannot_be_drawn_has_no_edges() {
        let ends = [[0.0; 3], [0.0, 0.0, 1.0]];
        for (ends, radius) in [(ends, f64::NAN), (ends, 0.0), ([[0.0; 3]; 2], 1.0), ([[f64::NAN; 3]; 2], 1.0)]
        {
            assert!(OutlineCylinder { ends, radius }.circles().is_empty());
        }
        assert!(OutlineBox { low: [f64::INFINITY; 3], high: [0.0; 3] }.edges().is_empty());
        assert!(OutlineBox { low: [1.0; 3], high: [1.0; 3] }.edges().is_empty());
    }

    #[test]
    fn a_box_has_twelve_edges_and_a_flat_one_four() {
        for (high, count) in [([1.0, 2.0, 3.0], 12), ([1.0, 0.0, 3.0], 4), ([0.0, 0.0, 3.0], 1)] {
            let edges = OutlineBox { low: [0.0; 3], high }.edges();
            assert_eq!(edges.len(), count);
            assert!(edges.iter().all(|[from, to]| from != to));
        }
    }
}
