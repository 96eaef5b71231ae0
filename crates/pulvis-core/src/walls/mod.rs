//! Plane walls and their state. What moves them is in `pulvis_boundary::motion`.

mod record;

pub use pulvis_boundary::WallMotion;
pub use pulvis_boundary::motion::{Cosine, PressureRamp, Push, Servo, Velocity};

use pulvis_math::Vector3;

use crate::contacts::WallMotionNow;
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
        if !motion.law().is_pushed() {
            self.velocity = motion.law().velocity(0.0);
        }
    }

    /// The wall is taken away: it stands still and nothing pushes it.
    pub(crate) fn stop(&mut self) {
        self.velocity = Vector3::zero();
        self.force = Vector3::zero();
    }

    /// Moves the wall over the step from `time` (since the motion began) to `time + time_step` [s].
    pub(crate) fn advance(&mut self, wall: &mut Wall, area: Option<f64>, time: f64, time_step: f64) {
        let motion = wall.motion.law();
        match motion.acceleration(&self.push(wall, self.velocity, area, time)) {
            None => {
                let travelled = motion.displacement(self.travelled, time, time_step);
                self.prescribe(travelled, motion.velocity(time + time_step), time_step);
            }
            Some(acceleration) => {
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
        self.force = force;
        let push = self.push(wall, self.velocity_predicted, area, time + time_step);
        match wall.motion.law().acceleration(&push) {
            None => self.work_prescribed += work,
            Some(acceleration) => {
                self.work_servo += work;
                self.velocity = self.velocity_mid + wall.normal * (0.5 * time_step * acceleration);
            }
        }
    }

    /// What acts on the wall at `time` [s] since the motion began, where it has a `velocity` [m/s].
    fn push(&self, wall: &Wall, velocity: Vector3, area: Option<f64>, time: f64) -> Push {
        let (force, speed) = (self.force.dot(wall.normal), velocity.dot(wall.normal));
        Push { force, speed, area: area.unwrap_or(0.0), time }
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
