//! Which part of a straight line lies in a region.

use pulvis_math::Vector3;

use super::Region;
use crate::{Cuboid, Domain};

impl Region {
    /// The share of the line from `from` to `to` [m] that lies in the region, from 0 to 1; images in periodic directions
    /// count as the region does. The line is shorter than every period, and so is the region.
    ///
    /// Over disjoint regions that fill space the shares add up to 1.
    pub fn share_of_line(&self, from: Vector3, to: Vector3, domain: &Domain) -> f64 {
        let along = to - from;
        let images = |from, axis| self.images_along(from, along, axis, domain);
        let mut share = 0.0;
        // Images along z and y may come with shifts along the others.
        for from in images(from, 2) {
            for from in images(from, 1) {
                for from in images(from, 0) {
                    share += self.share_within(from, along);
                }
            }
        }
        share.min(1.0)
    }

    /// The images of a line along an axis that can meet the region, by their starts: the first one that is not below it, and
    /// those that reach across its other side or that of its next image.
    fn images_along(
        &self,
        from: Vector3,
        along: Vector3,
        axis: usize,
        domain: &Domain,
    ) -> impl Iterator<Item = Vector3> {
        let [lower, upper] = self.bounds().map(|corner| corner[axis]);
        let repeats = domain.period(axis).is_some() && lower.is_finite();
        let (shift, base) = (domain.shift(axis), domain.turns(lower - from[axis], axis).ceil());
        let turns = if repeats { [-1.0, 0.0, 1.0].as_slice() } else { &[0.0] };
        turns.iter().filter_map(move |turn| {
            let start = if repeats { from + shift * (base + turn) } else { from };
            let ends = [start[axis], start[axis] + along[axis]];
            let meets = ends[0].min(ends[1]) <= upper && ends[0].max(ends[1]) >= lower;
            (!repeats || meets).then_some(start)
        })
    }

    /// The same of one image.
    fn share_within(&self, from: Vector3, along: Vector3) -> f64 {
        let whole = [0.0, 1.0];
        let [start, end] = match *self {
            Self::Box(Cuboid { lower, upper }) => {
                let slab = |range, axis: usize| {
                    meet(range, between_planes(from[axis], along[axis], [lower[axis], upper[axis]]))
                };
                (0..3).fold(whole, slab)
            }
            Self::Layer { axis, lower, upper } => {
                meet(whole, between_planes(from[axis], along[axis], [lower, upper]))
            }
            Self::Sphere { centre, radius } => meet(whole, within_distance(from - centre, along, radius)),
            Self::Cylinder { ends: [start, end], radius } => {
                let axis = end - start;
                let inverse = 1.0 / axis.norm_squared();
                let apart = from - start;
                let (at, rate) = (apart.dot(axis) * inverse, along.dot(axis) * inverse);
                let slab = meet(whole, between_planes(at, rate, [0.0, 1.0]));
                meet(slab, within_distance(apart - axis * at, along - axis * rate, radius))
            }
        };
        (end - start).max(0.0)
    }
}

/// No part of a line.
const NOTHING: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// What two parts of a line have in common.
fn meet(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [one[0].max(other[0]), one[1].min(other[1])]
}

/// The s for which `at` + s `rate` lies between two values.
fn between_planes(at: f64, rate: f64, [lower, upper]: [f64; 2]) -> [f64; 2] {
    if rate == 0.0 {
        let inside = lower <= at && at <= upper;
        return if inside { [f64::NEG_INFINITY, f64::INFINITY] } else { NOTHING };
    }
    let (one, other) = ((lower - at) / rate, (upper - at) / rate);
    [one.min(other), one.max(other)]
}

/// The s for which `apart` + s `along` is no longer than a radius.
fn within_distance(apart: Vector3, along: Vector3, radius: f64) -> [f64; 2] {
    let (square, half) = (along.norm_squared(), apart.dot(along));
    let excess = apart.norm_squared() - radius * radius;
    if square == 0.0 {
        return if excess <= 0.0 { [f64::NEG_INFINITY, f64::INFINITY] } else { NOTHING };
    }
    let discriminant = half * half - square * excess;
    if discriminant.is_nan() || discriminant < 0.0 {
        return NOTHING;
    }
    let root = discriminant.sqrt();
    [(-half - root) / square, (-half + root) / square]
}
