//! Parts of space that particles can be picked from.

use pulvis_math::Vector3;

use crate::{Cuboid, Domain};

/// A part of space, its boundary included.
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
            Self::Box(Cuboid { lower, upper }) => (0..3).all(|axis| {
                let along = position[axis];
                let along = match domain.period(axis) {
                    // The first image that is not below the box.
                    Some(period) if lower[axis].is_finite() => {
                        along + ((lower[axis] - along) / period).ceil() * period
                    }
                    Some(_) => f64::NEG_INFINITY,
                    None => along,
                };
                // An infinite box takes in every image, wherever the particle is.
                let is_number = !position[axis].is_nan();
                is_number && (domain.period(axis).is_some() || lower[axis] <= along) && along <= upper[axis]
            }),
            Self::Sphere { centre, radius } => {
                let mut apart = position - centre;
                for axis in [2, 1, 0] {
                    apart -= domain.shift(axis) * domain.turns(apart[axis], axis).round();
                }
                apart.norm() <= radius
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner(x: f64) -> Vector3 {
        Vector3::new(x, x, x)
    }

    #[test]
    fn a_box_and_a_sphere_hold_what_is_in_them() {
        let domain = Domain::unbounded();
        let cube = Region::Box(Cuboid { lower: corner(0.0), upper: corner(1.0) });
        let ball = Region::Sphere { centre: corner(0.0), radius: 1.0 };
        assert!(cube.contains(corner(0.0), &domain) && cube.contains(corner(1.0), &domain));
        assert!(!cube.contains(Vector3::new(0.5, 0.5, 1.0 + 1e-15), &domain));
        assert!(ball.contains(corner(0.577), &domain) && !ball.contains(corner(0.578), &domain));
        let half = Region::Box(Cuboid { lower: corner(f64::NEG_INFINITY), upper: corner(0.0) });
        assert!(half.contains(corner(-1e300), &domain) && !half.contains(corner(1e-9), &domain));
        for region in [cube, ball, half] {
            assert!(!region.contains(Vector3::new(0.0, f64::NAN, 0.0), &domain));
        }
    }

    #[test]
    fn every_image_counts_along_periodic_directions() {
        let domain = Domain::periodic(corner(0.0), corner(1.0), [true, false, false]);
        let slab =
            Region::Box(Cuboid { lower: Vector3::new(0.9, 0.0, 0.0), upper: Vector3::new(1.1, 1.0, 1.0) });
        let at = |x: f64| Vector3::new(x, 0.5, 0.5);
        for inside in [0.95, 0.05, -0.05, 1.05, 2.0, -7.0] {
            assert!(slab.contains(at(inside), &domain), "{inside}");
        }
        assert!(!slab.contains(at(0.5), &domain) && !slab.contains(at(1.5), &domain));
        assert!(!slab.contains(Vector3::new(0.95, -0.5, 0.5), &domain));
        let ball = Region::Sphere { centre: at(0.0), radius: 0.1 };
        assert!(ball.contains(at(0.95), &domain) && !ball.contains(at(0.8), &domain));
        assert!(!ball.contains(Vector3::new(0.0, 1.5, 0.5), &domain));
        let left = Vector3::new(f64::NEG_INFINITY, 0.0, 0.0);
        let unbounded = Region::Box(Cuboid { lower: left, upper: Vector3::new(0.2, 1.0, 1.0) });
        assert!(unbounded.contains(at(0.7), &domain));
    }
}
