//! A block of space.

use pulvis_math::Vector3;

/// A block of space with faces along the axes; upper is above lower in every direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Lower corner [m].
    pub lower: Vector3,
    /// Upper corner [m].
    pub upper: Vector3,
}

impl Cuboid {
    /// The lengths of the edges [m].
    pub fn size(&self) -> Vector3 {
        self.upper - self.lower
    }

    /// Volume [m³].
    pub fn volume(&self) -> f64 {
        let size = self.size();
        size.x * size.y * size.z
    }

    /// The eight corners [m].
    pub fn corners(&self) -> [Vector3; 8] {
        std::array::from_fn(|number| {
            let at = |bit: usize, axis: usize| {
                if number & bit == 0 { self.lower[axis] } else { self.upper[axis] }
            };
            Vector3::new(at(1, 0), at(2, 1), at(4, 2))
        })
    }
}
