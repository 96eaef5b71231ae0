//! From the scene to the picture: an orthographic projection that shows everything.

use super::selection::Selection;
use super::{SphereScene, View, furniture};

pub(super) type Vector = [f64; 3];

/// Coordinates of the picture: right and down \[pixel\], and depth away from the eye in the same unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Projected {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) depth: f64,
}

/// A sphere that would be smaller is drawn as a dot of this radius \[pixel\].
const SMALLEST: f64 = 1.0;

/// An orthographic projection.
#[derive(Clone, Debug)]
pub(super) struct Camera {
    right: Vector,
    down: Vector,
    forward: Vector,
    /// Pixels per metre.
    pub(super) scale: f64,
    offset: [f64; 2],
    /// Least and largest depth of the scene \[pixel\].
    pub(super) depths: [f64; 2],
}

impl Camera {
    /// Fits the chosen spheres and all outlines into the part of the picture that the furniture leaves free.
    pub(super) fn fit(scene: &SphereScene<'_>, selection: &Selection) -> Self {
        let [right, down, forward] = axes(scene.view);
        let mut camera = Self { right, down, forward, scale: 1.0, offset: [0.0; 2], depths: [0.0; 2] };
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        let mut include = |point: Projected, radius: f64| {
            for (axis, value) in [point.x, point.y, point.depth].into_iter().enumerate() {
                low[axis] = low[axis].min(value - radius);
                high[axis] = high[axis].max(value + radius);
            }
        };
        for (_, centre, radius) in shown(scene, selection) {
            include(camera.project(centre), radius);
        }
        for end in scene.edges().into_iter().flatten() {
            include(camera.project(end), 0.0);
        }
        if low[0] > high[0] {
            (low, high) = ([-1.0; 3], [1.0; 3]);
        }
        let [left, top, width, height] = furniture::free_area(scene, selection);
        let span = |axis: usize| (high[axis] - low[axis]).max(f64::MIN_POSITIVE);
        camera.scale = (width / span(0)).min(height / span(1)).clamp(1.0e-200, 1.0e200);
        let middle = |axis: usize| 0.5 * (low[axis] + high[axis]) * camera.scale;
        camera.offset = [left + 0.5 * width - middle(0), top + 0.5 * height - middle(1)];
        camera.depths = [low[2] * camera.scale, high[2] * camera.scale];
        camera
    }

    /// Radius of a sphere in the picture \[pixel\].
    pub(super) fn radius(&self, radius: f64) -> f64 {
        (radius * self.scale).max(SMALLEST)
    }

    /// Whether a sphere is drawn larger than it is.
    pub(super) fn enlarges(&self, radius: f64) -> bool {
        radius * self.scale < SMALLEST
    }

    /// A point of the scene in the picture.
    pub(super) fn project(&self, point: Vector) -> Projected {
        Projected {
            x: dot(self.right, point) * self.scale + self.offset[0],
            y: dot(self.down, point) * self.scale + self.offset[1],
            depth: dot(self.forward, point) * self.scale,
        }
    }
}

/// Number, centre and radius of the spheres that are shown.
pub(super) fn shown<'a>(
    scene: &SphereScene<'a>,
    selection: &'a Selection,
) -> impl Iterator<Item = (usize, Vector, f64)> + use<'a> {
    let spheres = scene.centres.iter().zip(scene.radii).zip(&selection.shown).enumerate();
    spheres
        .filter(|(_, (_, shown))| **shown)
        .map(|(number, ((&centre, &radius), _))| (number, centre, radius))
}

/// Unit vectors to the right, down and forward; useless input falls back to what is nearest to sense.
fn axes(view: View) -> [Vector; 3] {
    let forward = unit(view.direction).unwrap_or([0.0, 1.0, 0.0]);
    // Looking along `up`: any other upright will do; y is what plan views use.
    let candidates = [view.up, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let right = candidates.into_iter().find_map(|up| unit(cross(forward, unit(up)?)));
    let right = right.unwrap_or([1.0, 0.0, 0.0]);
    [right, cross(forward, right), forward]
}

pub(super) fn unit(vector: Vector) -> Option<Vector> {
    let length = dot(vector, vector).sqrt();
    (length.is_finite() && length > 1.0e-6).then(|| vector.map(|x| x / length))
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_view_has_x_to_the_right_and_z_up() {
        assert_eq!(axes(View::FRONT), [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
        assert_eq!(axes(View::TOP), [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    }
}
