//! Plane walls and what moves them. One file a motion; the list is in this file.

mod cosine;
mod record;
mod servo;
mod velocity;

pub use cosine::Cosine;
pub use servo::{PressureRamp, Servo};
pub use velocity::Velocity;

use pulvis_math::Vector3;

use crate::contacts::WallMotionNow;
use crate::particles::MaterialIndex;

/// How a wall moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum WallMotion {
    /// It stands still.
    #[default]
    Fixed,
    /// It moves with a given velocity.
    Velocity(Velocity),
    /// It moves forth and back with a cosine profile.
    Cosine(Cosine),
    /// It follows a pressure.
    Servo(Servo),
}

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

/// A length across the sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// A given length [m].
    Given(f64),
    /// The distance between the two walls at these indices in the list of walls.
    Between(usize, usize),
}

/// A plane wall without end.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Name, for people.
    pub name: String,
    /// Place in the list of materials.
    pub material: MaterialIndex,
    /// Unit normal, pointing to the particles.
    pub normal: Vector3,
    /// A point of the plane [m].
    pub point: Vector3,
    /// How it moves.
    pub motion: WallMotion,
    /// The area of its face.
    pub area: FaceArea,
    /// Whether it is there; a removed wall acts on nothing.
    pub present: bool,
}

impl Wall {
    /// A wall that stands still, through `point` [m] with the unit normal `normal` that points to the
    /// particles.
    pub fn fixed(name: &str, material: MaterialIndex, point: Vector3, normal: Vector3) -> Self {
        Self {
            name: name.to_owned(),
            material,
            normal,
            point,
            motion: WallMotion::Fixed,
            area: FaceArea::Unknown,
            present: true,
        }
    }

    /// Place of the plane along its normal [m].
    pub fn offset(&self) -> f64 {
        self.point.dot(self.normal)
    }
}

/// What a wall's motion keeps between steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WallState {
    /// Velocity [m/s].
    pub(crate) velocity: Vector3,
    velocity_mid: Vector3,
    velocity_predicted: Vector3,
    /// Force of the particles on the wall [N].
    pub(crate) force: Vector3,
    /// Work done on the particles so far while the motion was prescribed [J].
    pub(crate) work_prescribed: f64,
    /// Work done on the particles so far under servo control [J].
    pub(crate) work_servo: f64,
    /// Displacement since the motion began, for motions that are given as a function of time [m].
    travelled: Vector3,
    displacement: Vector3,
}

impl WallState {
    /// The wall starts a new motion, with the velocity that the motion begins with. A servo goes on
    /// from the velocity that it has.
    pub(crate) fn start(&mut self, motion: &WallMotion) {
        self.travelled = Vector3::zero();
        match motion {
            WallMotion::Servo(_) => {}
            WallMotion::Velocity(motion) => self.velocity = motion.velocity,
            WallMotion::Fixed | WallMotion::Cosine(_) => self.velocity = Vector3::zero(),
        }
    }

    /// The wall is taken away: it stands still and nothing pushes it.
    pub(crate) fn stop(&mut self) {
        self.velocity = Vector3::zero();
        self.force = Vector3::zero();
    }

    /// Moves the wall over the step from `time` (since the motion began) to `time + time_step` [s].
    pub(crate) fn advance(&mut self, wall: &mut Wall, area: Option<f64>, time: f64, time_step: f64) {
        let end = time + time_step;
        match &wall.motion {
            WallMotion::Fixed => self.prescribe(Vector3::zero(), Vector3::zero(), time_step),
            WallMotion::Velocity(motion) => {
                self.prescribe(self.travelled + motion.velocity * time_step, motion.velocity, time_step);
            }
            WallMotion::Cosine(motion) => {
                self.prescribe(motion.displacement_at(end), motion.velocity_at(end), time_step);
            }
            WallMotion::Servo(servo) => {
                let push = self.force.dot(wall.normal);
                let acceleration =
                    servo.acceleration(push, self.velocity.dot(wall.normal), area.unwrap_or(0.0), time);
                let half_kick = wall.normal * (0.5 * time_step * acceleration);
                self.velocity_mid = self.velocity + half_kick;
                self.velocity_predicted = self.velocity_mid + half_kick;
                self.displacement = self.velocity_mid * time_step;
            }
        }
        wall.point += self.displacement;
    }

    fn prescribe(&mut self, travelled: Vector3, velocity: Vector3, time_step: f64) {
        self.displacement = travelled - self.travelled;
        self.travelled = travelled;
        self.velocity_mid = self.displacement * (1.0 / time_step);
        self.velocity_predicted = velocity;
        self.velocity = velocity;
    }

    /// Takes in the force of the particles at the end of the step, books the work done on them
    /// (trapezoidal rule along the wall's path) and finishes the velocity of a servo.
    pub(crate) fn finish(
        &mut self,
        wall: &Wall,
        force: Vector3,
        area: Option<f64>,
        time: f64,
        time_step: f64,
    ) {
        let work = -0.5 * (self.force + force).dot(self.displacement);
        match wall.motion {
            WallMotion::Servo(_) => self.work_servo += work,
            _ => self.work_prescribed += work,
        }
        self.force = force;
        if let WallMotion::Servo(servo) = &wall.motion {
            let push = force.dot(wall.normal);
            let speed = self.velocity_predicted.dot(wall.normal);
            let acceleration = servo.acceleration(push, speed, area.unwrap_or(0.0), time + time_step);
            self.velocity = self.velocity_mid + wall.normal * (0.5 * time_step * acceleration);
        }
    }

    /// What the contact loop needs to know at the end of the drift.
    pub(crate) fn motion_now(&self, wall: &Wall) -> WallMotionNow {
        WallMotionNow {
            normal: wall.normal,
            offset: wall.offset(),
            velocity_mid: self.velocity_mid,
            velocity: self.velocity_predicted,
        }
    }

    /// The same before the first step: nothing has moved yet.
    pub(crate) fn motion_at_rest(&self, wall: &Wall) -> WallMotionNow {
        let (velocity_mid, velocity) = (self.velocity, self.velocity);
        WallMotionNow { normal: wall.normal, offset: wall.offset(), velocity_mid, velocity }
    }
}
