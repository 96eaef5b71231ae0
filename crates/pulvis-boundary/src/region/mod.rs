//! Parts of space that particles can be picked from, and that can be observed.

mod share;
#[cfg(test)]
mod tests;

use pulvis_math::Vector3;

use crate::{Cuboid, Domain};

/// A part of space, its boundary included. All of them are convex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// A box with faces along the axes; a component may be infinite.
    Box(Cuboid),
    /// A sphere.
    Sphere {
        /// Centre [m].
        centre: Vector3,
        /// Radius [m].
        radius: f64,
    },
    /// A cylinder with flat ends.
    Cylinder {
        /// The ends of its axis [m].
        ends: [Vector3; 2],
        /// Radius [m].
        radius: f64,
    },
    /// What lies between two planes normal to an axis.
    Layer {
        /// The axis: 0, 1, 2 for x, y, z.
        axis: usize,
        /// Where the planes cross the axis [m].
        lower: f64,
        /// The same of the upper one [m].
        upper: f64,
    },
}

impl Region {
    /// Whether a position [m], or an image of it in a periodic direction, lies in the region. A position that is NaN
    /// lies in no region.
    pub fn contains(&self, position: Vector3, domain: &Domain) -> bool {
        match *self {
            Self::Box(Cuboid { lower, .. }) if domain.is_tilted() => {
                // Images along z and y come with shifts: first the image along them that is not below the box.
                let mut image = position;
                for axis in [2, 1].into_iter().filter(|&axis| lower[axis].is_finite()) {
                    image += domain.shift(axis) * domain.turns(lower[axis] - image[axis], axis).ceil();
                }
                self.contains(image, &Domain { tilts: [0.0; 3], ..*domain })
            }
            Self::Layer { .. } if domain.is_tilted() => {
                let [lower, upper] = self.bounds();
                Self::Box(Cuboid { lower, upper }).contains(position, domain)
            }
            Self::Box(Cuboid { lower, upper }) => {
                (0..3).all(|axis| is_between(position, axis, [lower[axis], upper[axis]], domain))
            }
            Self::Layer { axis, lower, upper } => {
                let is_number = !(position.x.is_nan() || position.y.is_nan() || position.z.is_nan());
                is_number && is_between(position, axis, [lower, upper], domain)
            }
            Self::Sphere { centre, radius } => nearest_image(position - centre, domain).norm() <= radius,
            Self::Cylinder { ends: [start, end], radius } => {
                let (axis, middle) = (end - start, (start + end) * 0.5);
                let apart = nearest_image(position - middle, domain);
                let along = apart.dot(axis) / axis.norm_squared();
                along.abs() <= 0.5 && (apart - axis * along).norm() <= radius
            }
        }
    }

    /// The corners of the block with faces along the axes that just holds the region [m]; infinite where it has no end.
    pub fn bounds(&self) -> [Vector3; 2] {
        match *self {
            Self::Box(Cuboid { lower, upper }) => [lower, upper],
            Self::Sphere { centre, radius } => {
                let half = Vector3::new(radius, radius, radius);
                [centre - half, centre + half]
            }
            Self::Cylinder { ends: [start, end], radius } => {
                let axis = (end - start) * (1.0 / (end - start).norm());
                // Half the extent of a disc normal to the axis.
                let half = |component: f64| radius * (1.0 - component * component).max(0.0).sqrt();
                let half = Vector3::new(half(axis.x), half(axis.y), half(axis.z));
                let corner = |pick: fn(f64, f64) -> f64| {
                    Vector3::new(pick(start.x, end.x), pick(start.y, end.y), pick(start.z, end.z))
                };
                [corner(f64::min) - half, corner(f64::max) + half]
            }
            Self::Layer { axis, lower, upper } => {
                let mut bounds = [f64::NEG_INFINITY, f64::INFINITY].map(|end| Vector3::new(end, end, end));
                *bounds[0].component_mut(axis) = lower;
                *bounds[1].component_mut(axis) = upper;
                bounds
            }
        }
    }

    /// The part of the region in which the centres of spheres of a `radius` [m] lie that lie whole in the region; `None`
    /// where no such sphere fits in. Directions in which the region takes up a whole period have no ends.
    pub fn inset(&self, radius: f64, domain: &Domain) -> Option<Self> {
        let shortened = |axis: usize, lower: f64, upper: f64| {
            if domain.period(axis).is_some_and(|period| upper - lower >= period) {
                return Some([lower, upper]);
            }
            let (lower, upper) = (lower + radius, upper - radius);
            (lower <= upper).then_some([lower, upper])
        };
        match *self {
            Self::Box(Cuboid { mut lower, mut upper }) => {
                for axis in 0..3 {
                    let ends = shortened(axis, lower[axis], upper[axis])?;
                    [*lower.component_mut(axis), *upper.component_mut(axis)] = ends;
                }
                Some(Self::Box(Cuboid { lower, upper }))
            }
            Self::Layer { axis, lower, upper } => {
                let [lower, upper] = shortened(axis, lower, upper)?;
                Some(Self::Layer { axis, lower, upper })
            }
            Self::Sphere { centre, radius: outer } => {
                (outer >= radius).then_some(Self::Sphere { centre, radius: outer - radius })
            }
            Self::Cylinder { ends: [start, end], radius: outer } => {
                let length = (end - start).norm();
                let margin = (end - start) * (radius / length);
                let ends = [start + margin, end - margin];
                let fits = outer >= radius && length >= 2.0 * radius;
                fits.then_some(Self::Cylinder { ends, radius: outer - radius })
            }
        }
    }

    /// Volume [m³], where directions without an end have these `lengths` [m].
    pub fn volume(&self, lengths: [f64; 3]) -> f64 {
        use std::f64::consts::PI;
        match *self {
            Self::Sphere { radius, .. } => 4.0 / 3.0 * PI * radius * radius * radius,
            Self::Cylinder { ends: [start, end], radius } => PI * radius * radius * (end - start).norm(),
            Self::Box(_) | Self::Layer { .. } => {
                let [lower, upper] = self.bounds();
                let edge = |axis: usize| {
                    let edge = upper[axis] - lower[axis];
                    if edge.is_finite() { edge } else { lengths[axis] }
                };
                edge(0) * edge(1) * edge(2)
            }
        }
    }
}

/// Whether an image of a position lies between two planes normal to an axis.
fn is_between(position: Vector3, axis: usize, [lower, upper]: [f64; 2], domain: &Domain) -> bool {
    let along = position[axis];
    let along = match domain.period(axis) {
        // The first image that is not below the lower plane.
        Some(period) if lower.is_finite() => along + ((lower - along) / period).ceil() * period,
        Some(_) => f64::NEG_INFINITY,
        None => along,
    };
    // An infinite region takes in every image, wherever the particle is.
    let is_number = !position[axis].is_nan();
    is_number && (domain.period(axis).is_some() || lower <= along) && along <= upper
}

/// The image of a vector [m] that is nearest to zero.
fn nearest_image(mut apart: Vector3, domain: &Domain) -> Vector3 {
    for axis in [2, 1, 0] {
        apart -= domain.shift(axis) * domain.turns(apart[axis], axis).round();
    }
    apart
}
