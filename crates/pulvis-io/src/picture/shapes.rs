//! Spheres and tubes as lines of sight meet them, in coordinates of the camera.

use super::camera::{Camera, Ray};
use super::vector::Vector;

/// What can be seen.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    Ball {
        centre: Vector,
        radius: f64,
    },
    /// A tube with round ends.
    Tube {
        from: Vector,
        /// From one end to the other \[m\].
        axis: Vector,
        radius: f64,
    },
}

impl Shape {
    /// Where a ray enters: its depth \[m\].
    pub(super) fn depth(&self, ray: &Ray) -> Option<f64> {
        match *self {
            Self::Ball { centre, radius } => enter_ball(ray, centre, radius),
            Self::Tube { from, axis, radius } => enter_tube(ray, from, axis, radius),
        }
    }

    /// Direction of the surface at a point on it.
    pub(super) fn normal(&self, point: Vector) -> Vector {
        match *self {
            Self::Ball { centre, radius } => point.minus(centre).times(1.0 / radius),
            Self::Tube { from, axis, radius } => {
                let along = (point.minus(from).dot(axis) / axis.dot(axis)).clamp(0.0, 1.0);
                point.minus(from.plus(axis.times(along))).times(1.0 / radius)
            }
        }
    }

    /// Left, right, top and bottom in the picture \[pixel\].
    pub(super) fn bounds(&self, camera: &Camera) -> [[f64; 2]; 2] {
        match *self {
            Self::Ball { centre, radius } => camera.bounds(centre, radius),
            Self::Tube { from, axis, radius } => {
                let [one, other] = [from, from.plus(axis)].map(|end| camera.bounds(end, radius));
                [0, 1].map(|side| [one[side][0].min(other[side][0]), one[side][1].max(other[side][1])])
            }
        }
    }

    /// A depth that no part of it is nearer than \[m\].
    pub(super) fn nearest(&self) -> f64 {
        match *self {
            Self::Ball { centre, radius } => centre.0[2] - radius,
            Self::Tube { from, axis, radius } => from.0[2].min(from.0[2] + axis.0[2]) - radius,
        }
    }
}

fn enter_ball(ray: &Ray, centre: Vector, radius: f64) -> Option<f64> {
    let offset = ray.origin.minus(centre);
    let square = ray.direction.dot(ray.direction);
    let closest = -offset.dot(ray.direction) / square;
    // From the point that is closest to the centre: the textbook form loses digits for far, small spheres.
    let aside = offset.plus(ray.direction.times(closest));
    let half_chord = radius * radius - aside.dot(aside);
    (half_chord >= 0.0).then(|| closest - (half_chord / square).sqrt())
}

fn enter_tube(ray: &Ray, from: Vector, axis: Vector, radius: f64) -> Option<f64> {
    // Across the axis the tube is a circle.
    let length = axis.dot(axis);
    let offset = ray.origin.minus(from);
    let across = |vector: Vector| vector.minus(axis.times(vector.dot(axis) / length));
    let direction = across(ray.direction);
    let square = direction.dot(direction);
    if square > 0.0 {
        let start = across(offset);
        let closest = -start.dot(direction) / square;
        let aside = start.plus(direction.times(closest));
        let half_chord = radius * radius - aside.dot(aside);
        if half_chord < 0.0 {
            return None;
        }
        let depth = closest - (half_chord / square).sqrt();
        let along = offset.plus(ray.direction.times(depth)).dot(axis) / length;
        if (0.0..=1.0).contains(&along) {
            return Some(depth);
        }
    }
    let ends = [from, from.plus(axis)].map(|end| enter_ball(ray, end, radius));
    ends.into_iter().flatten().reduce(f64::min)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn ray(direction: [f64; 3]) -> Ray {
        Ray { origin: Vector([0.0; 3]), direction: Vector(direction) }
    }

    #[test]
    fn a_ray_enters_where_the_surface_is_and_the_normal_points_out() {
        let ball = Shape::Ball { centre: Vector([1.0, 0.0, 10.0]), radius: 2.0 };
        let tube =
            Shape::Tube { from: Vector([-3.0, 0.5, 8.0]), axis: Vector([5.0, 1.0, 4.0]), radius: 0.75 };
        let mut hits = [0, 0];
        for (shape, hits) in [ball, tube].iter().zip(&mut hits) {
            for step in 0..400 {
                let angle = f64::from(step) * 0.7;
                let ray =
                    ray([0.002 * f64::from(step) * angle.cos(), 0.0015 * f64::from(step) * angle.sin(), 1.0]);
                let Some(depth) = shape.depth(&ray) else { continue };
                *hits += 1;
                let normal = shape.normal(ray.at(depth));
                assert!((normal.norm() - 1.0).abs() < 1e-9, "{normal:?}");
                assert!(normal.dot(ray.direction) < 1e-6, "entered from outside");
                assert!(depth >= shape.nearest());
            }
        }
        assert!(hits.iter().all(|&hits| hits > 30), "{hits:?}");
    }

    #[test]
    fn a_tube_seen_along_its_axis_is_its_round_end() {
        let tube = Shape::Tube { from: Vector([0.0, 0.0, 5.0]), axis: Vector([0.0, 0.0, 3.0]), radius: 1.0 };
        assert!((tube.depth(&ray([0.0, 0.0, 1.0])).unwrap() - 4.0).abs() < 1e-12);
        assert!(tube.depth(&ray([0.3, 0.0, 1.0])).is_none());
    }
}
