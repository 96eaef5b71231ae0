//! What the contact loop reads of a wall, and the forces that it returns.

use std::ops::{AddAssign, Neg};

use pulvis_boundary::{Edgeless, Surface};
use pulvis_contact::ContactKinematics;
use pulvis_math::{F64Array, Real, Simd8, Vector3, elementary};

use super::{Shape, Wall, WallFeature, WallShape};

/// Eight contacts at a time.
type F64x8 = F64Array<8>;

/// A wall at the time of the positions.
#[derive(Clone, Debug)]
pub(crate) struct WallNow {
    /// Of a shape without edges.
    edgeless: Option<Edgeless>,
    shape: WallShape,
    turned: Turned,
    /// Reference point [m].
    point: Vector3,
    /// Velocity of the reference point at mid-step [m/s].
    velocity_mid: Vector3,
    /// The same at the time of the positions [m/s].
    velocity: Vector3,
    /// Of a shape with an axis.
    turn: Option<Turn>,
}

/// How a wall turns about its axis.
#[derive(Clone, Copy, Debug)]
struct Turn {
    axis: Vector3,
    /// At mid-step and at the time of the positions [rad/s].
    angular_velocity: Vector3,
}

/// How a wall has turned about its axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turned(Option<(Vector3, f64, f64)>);

impl Turned {
    pub(crate) fn of(wall: &Wall) -> Self {
        let axis = wall.shape.axis().filter(|_| wall.angle != 0.0);
        Self(axis.map(|axis| {
            let (sine, cosine) = elementary::sin_cos(wall.angle);
            (axis, sine, cosine)
        }))
    }

    /// From the frame of the shape to that of space.
    pub(crate) fn forwards(self, vector: Vector3) -> Vector3 {
        self.0.map_or(vector, |(axis, sine, cosine)| turned(vector, axis, sine, cosine))
    }

    /// From the frame of space to that of the shape.
    pub(crate) fn backwards(self, vector: Vector3) -> Vector3 {
        self.0.map_or(vector, |(axis, sine, cosine)| turned(vector, axis, -sine, cosine))
    }
}

/// Rodrigues' rotation of a vector about an axis.
fn turned(vector: Vector3, axis: Vector3, sine: f64, cosine: f64) -> Vector3 {
    let along = axis * vector.dot(axis);
    along + (vector - along) * cosine + axis.cross(vector) * sine
}

/// How the normals of features turn as centres move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NormalTurning<R> {
    /// A unit vector across the normal.
    tangent: Vector3<R>,
    /// Turn per length along the tangent, and along normal × tangent [1/m].
    rates: [R; 2],
}

impl<R: Real> NormalTurning<R> {
    #[inline(always)]
    fn normal_rate(&self, normal: Vector3<R>, velocity: Vector3<R>) -> Vector3<R> {
        let other = normal.cross(self.tangent);
        self.tangent * (self.rates[0] * self.tangent.dot(velocity))
            + other * (self.rates[1] * other.dot(velocity))
    }
}

/// What eight spheres see of features.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FeatureSurfaces {
    normal: [F64x8; 3],
    distance: F64x8,
    mean_curvature: F64x8,
    tangent: [F64x8; 3],
    rates: [F64x8; 2],
}

impl FeatureSurfaces {
    #[inline(always)]
    pub(crate) fn load<R: Simd8>(&self) -> (Surface<R>, NormalTurning<R>) {
        let vector = |[x, y, z]: &[F64x8; 3]| Vector3::new(R::load(x), R::load(y), R::load(z));
        let surface = Surface {
            normal: vector(&self.normal),
            distance: R::load(&self.distance),
            mean_curvature: R::load(&self.mean_curvature),
            turning: R::zero(),
        };
        let [one, other] = &self.rates;
        let turning = NormalTurning { tangent: vector(&self.tangent), rates: [R::load(one), R::load(other)] };
        (surface, turning)
    }
}

impl WallNow {
    /// A wall whose reference point has these velocities at mid-step and at the time of the positions [m/s],
    /// and which rotates about its axis, if it has one, with `angular_velocity` [rad/s].
    pub(crate) fn new(wall: &Wall, velocity_mid: Vector3, velocity: Vector3, angular_velocity: f64) -> Self {
        let turn = wall.shape.axis().map(|axis| Turn { axis, angular_velocity: axis * angular_velocity });
        let (edgeless, shape) = (wall.shape.edgeless(), wall.shape.clone());
        Self { edgeless, shape, turned: Turned::of(wall), point: wall.point, velocity_mid, velocity, turn }
    }

    /// Whether a contact can pass from one feature of the wall to another: from one part of a mesh to the next.
    #[inline(always)]
    pub(crate) fn has_many_features(&self) -> bool {
        matches!(self.shape, WallShape::Mesh(_))
    }

    /// The surface of a shape without edges as seen from `centre` [m]; `None` for others.
    #[inline(always)]
    pub(crate) fn surface<R: Real>(&self, centre: Vector3<R>) -> Option<Surface<R>> {
        Some(self.edgeless.as_ref()?.surface(self.point, centre))
    }

    /// A feature of a shape as seen from `centre`, if it is nearer than `limit` [m] and the sphere touches it.
    pub(crate) fn feature(
        &self,
        feature: WallFeature,
        centre: Vector3,
        limit: f64,
    ) -> Option<(Surface<f64>, Option<NormalTurning<f64>>)> {
        if let Some(surface) = self.surface(centre) {
            return Some((surface, None));
        }
        let centre = self.turned.backwards(centre - self.point);
        let seen = self.shape.edged()?.surface_of(feature.index(), centre, limit)?;
        let (normal, tangent) = (self.turned.forwards(seen.normal), self.turned.forwards(seen.tangent));
        let (distance, mean_curvature) = (seen.distance, seen.mean_curvature);
        let surface = Surface { normal, distance, mean_curvature, turning: 0.0 };
        Some((surface, Some(NormalTurning { tangent, rates: seen.turning })))
    }

    /// The features of eight contacts with a shape with edges, one contact after the other. Contacts with a feature that
    /// the sphere does not touch, and those beyond the first `occupancy`, are out of the interaction range [m].
    #[inline(never)]
    pub(crate) fn features(
        &self,
        features: [WallFeature; 8],
        centres: [F64x8; 3],
        radii: F64x8,
        range: f64,
        occupancy: usize,
    ) -> FeatureSurfaces {
        let mut seen = FeatureSurfaces::default();
        for (lane, &feature) in features.iter().enumerate() {
            let [x, y, z] = centres.map(|column| column.0[lane]);
            let reach = radii.0[lane] + range;
            // Laws ask how a contact that has just ended lies: no sphere goes farther than a radius in a step.
            let limit = reach + radii.0[lane];
            let touched = self.feature(feature, Vector3::new(x, y, z), limit).filter(|_| lane < occupancy);
            let Some((surface, Some(turning))) = touched else {
                seen.normal[2].0[lane] = 1.0;
                seen.tangent[0].0[lane] = 1.0;
                seen.distance.0[lane] = limit + reach;
                continue;
            };
            for axis in 0..3 {
                seen.normal[axis].0[lane] = surface.normal[axis];
                seen.tangent[axis].0[lane] = turning.tangent[axis];
            }
            seen.distance.0[lane] = surface.distance;
            seen.mean_curvature.0[lane] = surface.mean_curvature;
            seen.rates[0].0[lane] = turning.rates[0];
            seen.rates[1].0[lane] = turning.rates[1];
        }
        seen
    }

    /// Turns the velocities that `motion` holds, those of a sphere at `centre` [m], into those against the wall.
    /// The second body is the point of the surface nearest to the centre, moving as the wall does. Answers with that
    /// point, from the wall's reference point [m], for shapes with an axis.
    #[inline(always)]
    pub(crate) fn move_against<R: Real>(
        &self,
        surface: &Surface<R>,
        turning: Option<NormalTurning<R>>,
        centre: Vector3<R>,
        motion: &mut ContactKinematics<R>,
    ) -> Vector3<R> {
        motion.velocity -= Vector3::splat(self.velocity);
        motion.velocity_mid -= Vector3::splat(self.velocity_mid);
        motion.normal_rate = match (turning, &self.edgeless) {
            (None, Some(shape)) => shape.normal_rate(surface, motion.velocity_mid),
            (None, None) => None,
            (Some(turning), _) => Some(self.normal_rate(surface, &turning, centre, motion.velocity_mid)),
        };
        let Some(turn) = &self.turn else { return Vector3::zero() };
        let arm = centre - surface.normal * surface.distance - Vector3::splat(self.point);
        let velocity = Vector3::<R>::splat(turn.angular_velocity).cross(arm);
        motion.velocity -= velocity;
        motion.velocity_mid -= velocity;
        arm
    }

    /// How fast the normal of a feature turns [1/s]: with the wall, and as the centre moves against it. `velocity` is that
    /// of the centre against the reference point [m/s].
    #[inline(always)]
    fn normal_rate<R: Real>(
        &self,
        surface: &Surface<R>,
        turning: &NormalTurning<R>,
        centre: Vector3<R>,
        velocity: Vector3<R>,
    ) -> Vector3<R> {
        let Some(turn) = &self.turn else { return turning.normal_rate(surface.normal, velocity) };
        let spin = Vector3::<R>::splat(turn.angular_velocity);
        let carried = spin.cross(centre - Vector3::splat(self.point));
        turning.normal_rate(surface.normal, velocity - carried) + spin.cross(surface.normal)
    }

    /// Angular velocity of the wall [rad/s], `None` for shapes without an axis.
    #[inline(always)]
    pub(crate) fn angular_velocity(&self) -> Option<Vector3> {
        self.turn.map(|turn| turn.angular_velocity)
    }

    /// The opposite of the torque on the wall, its part along the axis, about the reference point [N m]: from the
    /// `force` on the sphere [N], which acts at the `arm` that [`move_against`](Self::move_against) gave [m], and
    /// the `torque` on the second body about that point [N m]. Zero for shapes without an axis.
    #[inline(always)]
    pub(crate) fn torque_on_particles<R: Real>(
        &self,
        arm: Vector3<R>,
        force: Vector3<R>,
        torque: Vector3<R>,
    ) -> R {
        match &self.turn {
            Some(turn) => (arm.cross(force) - torque).dot(Vector3::splat(turn.axis)),
            None => R::zero(),
        }
    }
}

/// The force of some contacts, and their torque about the axis of the wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WallForce {
    /// Force [N].
    pub(crate) force: Vector3,
    /// Part along the axis of the torque about the reference point [N m]; zero for walls without an axis.
    pub(crate) torque: f64,
}

impl Default for WallForce {
    fn default() -> Self {
        Self { force: Vector3::zero(), torque: 0.0 }
    }
}

impl AddAssign for WallForce {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.torque += other.torque;
    }
}

impl Neg for WallForce {
    type Output = Self;
    fn neg(self) -> Self {
        Self { force: -self.force, torque: -self.torque }
    }
}
