//! From the scene to the picture.
//!
//! Coordinates of the camera are metres to the right, down and forward of the eye. A ray is `origin + depth direction`, where
//! the direction's forward part is 1, so that the depth of a point on it is its forward coordinate.

use super::furniture;
use super::scene::Scene;
use super::selection::Selection;
use super::vector::Vector;
use super::view::Projection;

/// A sphere or tube that would be thinner is drawn with this radius \[pixel\].
const SMALLEST: f64 = 1.0;

/// Distance of the eye from the middle of the scene, in half diagonals of the scene: what lies in front looks a third
/// larger than what lies behind.
const DISTANCE: f64 = 5.0;

/// A straight line of sight.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ray {
    pub(super) origin: Vector,
    pub(super) direction: Vector,
}

impl Ray {
    pub(super) fn at(&self, depth: f64) -> Vector {
        self.origin.plus(self.direction.times(depth))
    }
}

/// A fitted view.
#[derive(Clone, Debug)]
pub(super) struct Camera {
    axes: [Vector; 3],
    /// The middle of the scene \[m\], `distance` in front of the eye.
    target: Vector,
    distance: f64,
    projection: Projection,
    /// Pixels per metre in the plane of the target.
    pub(super) scale: f64,
    /// The pixel of the target.
    offset: [f64; 2],
    /// Least and largest depth of the scene \[m\].
    pub(super) depths: [f64; 2],
}

impl Camera {
    /// Fits the limits of the scene, or the chosen spheres and all outlines, into the part of the picture that the furniture
    /// leaves free.
    pub(super) fn fit(scene: &Scene<'_>, selection: &Selection) -> Self {
        let points = fitted(scene, selection);
        let axes = scene.view.axes();
        let [low, high] = box_of(&points);
        let target = low.plus(high).times(0.5);
        let half_diagonal = 0.5 * high.minus(low).norm();
        let distance = DISTANCE * half_diagonal.max(f64::MIN_POSITIVE);
        let projection = scene.projection;
        let mut camera =
            Self { axes, target, distance, projection, scale: 1.0, offset: [0.0; 2], depths: [0.0; 2] };
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &(point, radius) in &points {
            let centre = camera.to_camera(point);
            let [x, y] = camera.spans(centre, radius);
            let depth = [centre.0[2] - radius, centre.0[2] + radius];
            for (axis, [from, to]) in [x, y, depth].into_iter().enumerate() {
                low[axis] = low[axis].min(from);
                high[axis] = high[axis].max(to);
            }
        }
        let [left, top, width, height] = furniture::free_area(scene, selection);
        let span = |axis: usize| (high[axis] - low[axis]).max(f64::MIN_POSITIVE);
        camera.scale = (width / span(0)).min(height / span(1)).clamp(1.0e-200, 1.0e200);
        let middle = |axis: usize| 0.5 * (low[axis] + high[axis]) * camera.scale;
        camera.offset = [left + 0.5 * width - middle(0), top + 0.5 * height - middle(1)];
        camera.depths = [low[2], high[2]];
        camera
    }

    /// Where the eye is \[m\]; `None` for parallel lines of sight.
    pub(super) fn eye(&self) -> Option<Vector> {
        let back = self.forward().times(-self.distance);
        (self.projection == Projection::Perspective).then(|| self.target.plus(back))
    }

    /// Unit vector into the scene.
    pub(super) fn forward(&self) -> Vector {
        self.axes[2]
    }

    /// A point of the scene in coordinates of the camera.
    pub(super) fn to_camera(&self, point: Vector) -> Vector {
        let [right, down, forward] = self.axes;
        let from = point.minus(self.target);
        Vector([right.dot(from), down.dot(from), forward.dot(from) + self.distance])
    }

    /// The line of sight of a place in the picture \[pixel\].
    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let [x, y] = [(x - self.offset[0]) / self.scale, (y - self.offset[1]) / self.scale];
        match self.projection {
            Projection::Parallel => Ray { origin: Vector([x, y, 0.0]), direction: Vector([0.0, 0.0, 1.0]) },
            Projection::Perspective => Ray {
                origin: Vector([0.0; 3]),
                direction: Vector([x / self.distance, y / self.distance, 1.0]),
            },
        }
    }

    /// What a sphere covers to the right and down, in metres of the plane of the target.
    fn spans(&self, centre: Vector, radius: f64) -> [[f64; 2]; 2] {
        let Vector([x, y, depth]) = centre;
        [x, y].map(|aside| match self.projection {
            Projection::Parallel => [aside - radius, aside + radius],
            Projection::Perspective => {
                // Tangents from the eye, in the plane of the line of sight and this direction.
                let tangent = (aside * aside + depth * depth - radius * radius).max(0.0).sqrt();
                let below = depth * depth - radius * radius;
                [-1.0, 1.0].map(|side| self.distance * (aside * depth + side * radius * tangent) / below)
            }
        })
    }

    /// Left, right, top and bottom of a sphere in the picture \[pixel\].
    pub(super) fn bounds(&self, centre: Vector, radius: f64) -> [[f64; 2]; 2] {
        let [x, y] = self.spans(centre, radius);
        let pixel = |axis: usize, span: [f64; 2]| span.map(|at| at * self.scale + self.offset[axis]);
        [pixel(0, x), pixel(1, y)]
    }

    /// Pixels per metre at a depth.
    pub(super) fn scale_at(&self, depth: f64) -> f64 {
        match self.projection {
            Projection::Parallel => self.scale,
            Projection::Perspective => self.scale * self.distance / depth,
        }
    }

    /// The radius that something is drawn with, large enough to be seen \[m\].
    pub(super) fn visible_radius(&self, radius: f64, depth: f64) -> f64 {
        radius.max(SMALLEST / self.scale_at(depth))
    }

    /// Whether a sphere is drawn larger than it is.
    pub(super) fn enlarges(&self, centre: [f64; 3], radius: f64) -> bool {
        radius * self.scale_at(self.to_camera(Vector(centre)).0[2]) < SMALLEST
    }
}

/// What has to be in the picture: points, each with a radius.
fn fitted(scene: &Scene<'_>, selection: &Selection) -> Vec<(Vector, f64)> {
    if let Some([low, high]) = scene.limits {
        let corner = |number: usize| {
            std::array::from_fn(|axis| if number >> axis & 1 == 0 { low[axis] } else { high[axis] })
        };
        return (0..8).map(|number| (Vector(corner(number)), 0.0)).collect();
    }
    let spheres = shown(scene, selection).map(|(_, centre, radius)| (Vector(centre), radius));
    let edges = scene.all_edges().into_iter().flatten().map(|end| (Vector(end), 0.0));
    let points: Vec<_> = spheres.chain(edges).collect();
    if points.is_empty() { vec![(Vector([0.0; 3]), 1.0)] } else { points }
}

fn box_of(points: &[(Vector, f64)]) -> [Vector; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for (point, radius) in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point.0[axis] - radius);
            high[axis] = high[axis].max(point.0[axis] + radius);
        }
    }
    [Vector(low), Vector(high)]
}

/// Number, centre and radius of the spheres that are shown.
pub(super) fn shown<'a>(
    scene: &Scene<'a>,
    selection: &'a Selection,
) -> impl Iterator<Item = (usize, [f64; 3], f64)> + use<'a> {
    let spheres = scene.centres.iter().zip(scene.radii).zip(&selection.shown).enumerate();
    spheres
        .filter(|(_, (_, shown))| **shown)
        .map(|(number, ((&centre, &radius), _))| (number, centre, radius))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::View;

    #[test]
    fn rays_at_the_border_of_a_sphere_touch_it() {
        let centres = [[0.3, 0.1, -0.2], [-1.0, 2.0, 0.7]];
        let radii = [0.4, 0.2];
        for projection in [Projection::Perspective, Projection::Parallel] {
            let scene = Scene { projection, view: View::OBLIQUE, ..Scene::new(&centres, &radii, &[]) };
            let camera = Camera::fit(&scene, &Selection::of(&scene));
            for (&centre, &radius) in centres.iter().zip(&radii) {
                let centre = camera.to_camera(Vector(centre));
                let [[left, right], [top, bottom]] = camera.bounds(centre, radius);
                // The border in one direction, and anywhere in the other: the nearest ray touches.
                let nearest = |ray: &dyn Fn(f64) -> Ray, [from, to]: [f64; 2]| {
                    let distance = |share: f64| {
                        let ray = ray(from + share * (to - from));
                        let offset = ray.origin.minus(centre);
                        offset.cross(ray.direction).norm() / ray.direction.norm()
                    };
                    (0..=10_000).map(|step| distance(f64::from(step) / 1e4)).fold(f64::INFINITY, f64::min)
                };
                for x in [left, right] {
                    let found = nearest(&|y| camera.ray(x, y), [top, bottom]);
                    assert!((found / radius - 1.0).abs() < 1e-6, "{projection:?}: {found} for {radius}");
                }
                for y in [top, bottom] {
                    let found = nearest(&|x| camera.ray(x, y), [left, right]);
                    assert!((found / radius - 1.0).abs() < 1e-6, "{projection:?}: {found} for {radius}");
                }
            }
        }
    }
}
