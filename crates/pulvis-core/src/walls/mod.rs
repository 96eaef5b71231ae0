//! Walls and their state. Their shapes and what moves them are in `pulvis-boundary`.

mod feature;
mod now;
mod record;

pub(crate) use feature::WallFeature;
pub(crate) use now::{Turned, WallForce, WallNow};
pub(crate) use pulvis_boundary::Shape;
pub use pulvis_boundary::motion::{Cosine, PressureRamp, Push, Rotation, Servo, Velocity};
pub use pulvis_boundary::{
    Cone, Cylinder, CylinderSide, Disk, Mesh, Plane, PlaneWithHole, TriangleMesh, Tube, WallMotion, WallShape,
};

use pulvis_math::Vector3;

use crate::particles::MaterialIndex;

/// The area over which a wall's force is spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FaceArea {
    /// Not known: the wall has a force but no stress.
    Unknown,
    /// A given area [m²].
    Given(f64),
    /// The product of two extents.
    Product([Extent; 2]),
}

impl FaceArea {
    /// The area [m²] among `walls` as they stand, if it is known.
    pub fn of(&self, walls: &[Wall]) -> Option<f64> {
        match self {
            Self::Unknown => None,
            Self::Given(area) => Some(*area),
            Self::Product([one, other]) => Some(one.of(walls)? * other.of(walls)?),
        }
    }
}

/// A length across the sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// A given length [m].
    Given(f64),
    /// The distance between the two walls at these indices in the list of walls.
    Between(usize, usize),
}

impl Extent {
    /// The length [m] among `walls` as they stand, `None` if there are no such walls.
    fn of(&self, walls: &[Wall]) -> Option<f64> {
        match *self {
            Self::Given(length) => Some(length),
            Self::Between(one, other) => {
                let (one, other) = (walls.get(one)?, walls.get(other)?);
                one.plane_normal().map(|normal| (other.point - one.point).dot(normal).abs())
            }
        }
    }
}

/// A wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Name, for people.
    pub name: String,
    /// Index in the list of materials.
    pub material: MaterialIndex,
    /// What its surface looks like.
    pub shape: WallShape,
    /// Its reference point: a point of the plane, of the axis, the middle of a disk or of a first end [m].
    pub point: Vector3,
    /// By how much it has turned about its axis [rad]; stays zero for shapes that look the same after a turn.
    pub angle: f64,
    /// How it moves.
    pub motion: WallMotion,
    /// The area of its face.
    pub area: FaceArea,
    /// Whether it is there; a removed wall acts on nothing.
    pub present: bool,
}

impl Wall {
    /// A plane that stands still, through `point` [m] with the unit normal `normal` that points to the
    /// particles.
    pub fn fixed(name: &str, material: MaterialIndex, point: Vector3, normal: Vector3) -> Self {
        Self::of_shape(name, material, point, Plane { normal })
    }

    /// A wall of any shape that stands still, with its reference point [m].
    pub fn of_shape(
        name: &str,
        material: MaterialIndex,
        point: Vector3,
        shape: impl Into<WallShape>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            material,
            shape: shape.into(),
            point,
            angle: 0.0,
            motion: WallMotion::Fixed,
            area: FaceArea::Unknown,
            present: true,
        }
    }

    /// The unit normal of a plane; other shapes have none.
    pub fn plane_normal(&self) -> Option<Vector3> {
        match self.shape {
            WallShape::Plane(Plane { normal }) => Some(normal),
            _ => None,
        }
    }

    /// The direction in which forces move the wall, towards the particles; zero where none can.
    fn direction_of_push(&self) -> Vector3 {
        self.shape.direction_of_push().unwrap_or(Vector3::zero())
    }

    /// Position along the direction in which a pressure moves it [m]; other shapes have none.
    pub fn position_of_push(&self) -> Option<f64> {
        self.shape.direction_of_push().map(|direction| self.point.dot(direction))
    }

    /// The lines that show a shape with edges, where it is now [m]; others have none.
    pub fn outline(&self) -> Vec<[Vector3; 2]> {
        let turned = Turned::of(self);
        let lines = self.shape.edged().map(|shape| shape.outline()).unwrap_or_default();
        lines.into_iter().map(|line| line.map(|end| self.point + turned.forwards(end))).collect()
    }

    /// Triangles of its shape, where they are now \[m\].
    pub fn place_triangles(&self, triangles: impl Iterator<Item = [Vector3; 3]>) -> Vec<[Vector3; 3]> {
        let turned = Turned::of(self);
        triangles.map(|corners| corners.map(|corner| self.point + turned.forwards(corner))).collect()
    }

    /// Position of a plane along its normal [m]; other shapes have none.
    pub fn offset(&self) -> Option<f64> {
        self.plane_normal().map(|normal| self.point.dot(normal))
    }

    /// Distance of a point from the surface, negative behind it [m]; shapes with edges have no side behind them.
    pub fn distance(&self, from: Vector3) -> f64 {
        match self.shape.edgeless() {
            Some(shape) => shape.surface(self.point, from).distance,
            None => self.shape.distance(Turned::of(self).backwards(from - self.point)),
        }
    }

    /// The distance to a parallel plane that it faces [m], negative where they have passed each other; `None` if they
    /// do not face each other.
    pub fn distance_to_facing(&self, other: &Self) -> Option<f64> {
        // Normals of rotated boxes come with rounding errors.
        let facing = (self.plane_normal()? + other.plane_normal()?).norm() < 1e-9;
        facing.then_some(-self.offset()? - other.offset()?)
    }
}

/// What a wall's motion keeps between steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallState {
    /// Velocity [m/s].
    pub(crate) velocity: Vector3,
    velocity_mid: Vector3,
    velocity_predicted: Vector3,
    /// Angular velocity about the axis of the shape [rad/s].
    pub(crate) angular_velocity: f64,
    /// Force and torque of the particles on the wall.
    pub(crate) load: WallForce,
    /// Work done on the particles so far while the motion was prescribed [J].
    pub(crate) work_prescribed: f64,
    /// Work done on the particles so far under servo control [J].
    pub(crate) work_servo: f64,
    /// Displacement since the motion began, for motions that are given as a function of time [m].
    travelled: Vector3,
    /// Displacement in this step [m].
    pub(crate) displacement: Vector3,
    /// The area of the face where the wall stands, if it is known [m²].
    pub(crate) area: Option<f64>,
}

impl WallState {
    /// The wall starts a new motion, with the velocity that the motion begins with. A servo goes on
    /// from the velocity that it has.
    pub(crate) fn start(&mut self, motion: &WallMotion) {
        self.travelled = Vector3::zero();
        let motion = motion.law();
        self.angular_velocity = motion.angular_velocity();
        if !motion.is_pushed() {
            self.velocity = motion.velocity(0.0);
        }
    }

    /// The wall is taken away: it stands still and nothing pushes it.
    pub(crate) fn stop(&mut self) {
        self.velocity = Vector3::zero();
        self.angular_velocity = 0.0;
        self.load = WallForce::default();
    }

    /// Moves the wall over the step from `time` (since the motion began) to `time + time_step` [s].
    pub(crate) fn advance(&mut self, wall: &mut Wall, time: f64, time_step: f64) {
        let motion = wall.motion.law();
        match motion.acceleration(&self.push(wall, self.velocity, time)) {
            None => {
                let travelled = motion.displacement(self.travelled, time, time_step);
                self.prescribe(travelled, motion.velocity(time + time_step), time_step);
            }
            Some(acceleration) => {
                let half_kick = wall.direction_of_push() * (0.5 * time_step * acceleration);
                self.velocity_mid = self.velocity + half_kick;
                self.velocity_predicted = self.velocity_mid + half_kick;
                self.displacement = self.velocity_mid * time_step;
            }
        }
        wall.point += self.displacement;
        if wall.shape.is_turned_by_rotation() {
            wall.angle += self.angular_velocity * time_step;
        }
    }

    fn prescribe(&mut self, travelled: Vector3, velocity: Vector3, time_step: f64) {
        self.displacement = travelled - self.travelled;
        self.travelled = travelled;
        self.velocity_mid = self.displacement * (1.0 / time_step);
        self.velocity_predicted = velocity;
        self.velocity = velocity;
    }

    /// Takes in the force and torque of the particles at the end of the step, books the work done on them
    /// (trapezoidal rule along the wall's path) and finishes the velocity of a servo.
    pub(crate) fn finish(&mut self, wall: &Wall, load: WallForce, time: f64, time_step: f64) {
        let turned = self.angular_velocity * time_step;
        let along = (self.load.force + load.force).dot(self.displacement);
        let work = -0.5 * (along + (self.load.torque + load.torque) * turned);
        self.load = load;
        let push = self.push(wall, self.velocity_predicted, time + time_step);
        match wall.motion.law().acceleration(&push) {
            None => self.work_prescribed += work,
            Some(acceleration) => {
                self.work_servo += work;
                let half_kick = wall.direction_of_push() * (0.5 * time_step * acceleration);
                self.velocity = self.velocity_mid + half_kick;
            }
        }
    }

    /// What acts on the wall at `time` [s] since the motion began, where it has a `velocity` [m/s].
    fn push(&self, wall: &Wall, velocity: Vector3, time: f64) -> Push {
        let normal = wall.direction_of_push();
        let (force, speed) = (self.load.force.dot(normal), velocity.dot(normal));
        Push { force, speed, area: self.area.unwrap_or(0.0), time }
    }

    /// What the contact loop needs to know at the end of the drift.
    pub(crate) fn now(&self, wall: &Wall) -> WallNow {
        WallNow::new(wall, self.velocity_mid, self.velocity_predicted, self.angular_velocity)
    }

    /// The same before the first step: nothing has moved yet.
    pub(crate) fn now_at_rest(&self, wall: &Wall) -> WallNow {
        WallNow::new(wall, self.velocity, self.velocity, self.angular_velocity)
    }
}
