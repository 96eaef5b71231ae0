//! Where one looks from, and how.

use super::vector::Vector;

/// Where one looks from. Neither vector needs unit length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Direction of looking, from the eye into the scene.
    pub direction: [f64; 3],
    /// What is up in the picture; only its part across `direction` counts.
    pub up: [f64; 3],
}

/// How far things become pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Projection {
    /// What is farther looks smaller; lengths hold in the middle of the scene.
    #[default]
    Perspective,
    /// The same size at any distance, so that lengths can be compared everywhere.
    Parallel,
}

impl View {
    /// Along +y, z up: a front view.
    pub const FRONT: Self = Self { direction: [0.0, 1.0, 0.0], up: [0.0, 0.0, 1.0] };

    /// Along -x, z up: from the right of the front view.
    pub const SIDE: Self = Self { direction: [-1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };

    /// Along -z, y up: a plan view.
    pub const TOP: Self = Self { direction: [0.0, 0.0, -1.0], up: [0.0, 1.0, 0.0] };

    /// From the front, the right and above, z up.
    pub const OBLIQUE: Self = Self { direction: [-0.5, 1.0, -0.45], up: [0.0, 0.0, 1.0] };

    /// From an eye at these angles \[degree\]: `azimuth` about z, from +x towards +y, and `elevation` above the xy plane.
    /// Beyond the pole the picture stands on its head.
    pub fn from_angles(azimuth: f64, elevation: f64) -> Self {
        let ((sin_a, cos_a), (sin_e, cos_e)) =
            (azimuth.to_radians().sin_cos(), elevation.to_radians().sin_cos());
        Self {
            direction: [-cos_e * cos_a, -cos_e * sin_a, -sin_e],
            up: [-sin_e * cos_a, -sin_e * sin_a, cos_e],
        }
    }

    /// Unit vectors to the right, down and forward; useless input falls back to what is nearest to sense.
    pub(super) fn axes(self) -> [Vector; 3] {
        let forward = Vector(self.direction).unit().unwrap_or(Vector([0.0, 1.0, 0.0]));
        // Looking along `up`: any other upright will do; y is what plan views use.
        let candidates = [self.up, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let right = candidates.into_iter().find_map(|up| forward.cross(Vector(up).unit()?).unit());
        let right = right.unwrap_or(Vector([1.0, 0.0, 0.0]));
        [right, forward.cross(right), forward]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_view_has_x_to_the_right_and_z_up() {
        let vectors = |view: View| view.axes().map(|axis| axis.0);
        assert_eq!(vectors(View::FRONT), [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
        assert_eq!(vectors(View::TOP), [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
        assert_eq!(vectors(View::SIDE), [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]]);
    }

    #[test]
    fn angles_give_the_named_views() {
        for (angles, view) in
            [((-90.0, 0.0), View::FRONT), ((0.0, 0.0), View::SIDE), ((-90.0, 90.0), View::TOP)]
        {
            let found = View::from_angles(angles.0, angles.1);
            for (found, expected) in found.axes().iter().zip(view.axes()) {
                assert!(found.minus(expected).norm() < 1e-12, "{angles:?}: {found:?}");
            }
        }
    }
}
