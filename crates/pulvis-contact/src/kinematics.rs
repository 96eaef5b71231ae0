//! How two bodies in contact lie and move.

use pulvis_math::{Real, Vector3};

use crate::pair::Pair;

/// How two bodies i and j lie and move. Velocities come twice: at the time of the positions, which
/// dashpots see, and at the middle of the step that led there, which springs follow.
#[derive(Clone, Copy, Debug)]
pub struct ContactKinematics<R> {
    /// Unit vector from j to i; of a wall, the normal that points to the body.
    pub normal: Vector3<R>,
    /// Overlap δ, negative at a distance [m].
    pub overlap: R,
    /// 1/distance of the centres: with the velocity across the normal, how fast the normal turns. Zero for
    /// walls [1/m].
    pub inverse_distance: R,
    /// How fast the normal turns, at mid-step, where that does not follow from the relative velocity: at a curved
    /// wall, which may rotate and may be curved in one direction only [1/s]. `None` for spheres and planes.
    pub normal_rate: Option<Vector3<R>>,
    /// Radius of i [m].
    pub radius_i: R,
    /// Radius of j; zero for a wall, whose point nearest to i is the second body [m].
    pub radius_j: R,
    /// Velocity of i minus velocity of j [m/s].
    pub velocity: Vector3<R>,
    /// The same at mid-step [m/s].
    pub velocity_mid: Vector3<R>,
    /// Angular velocity of i [rad/s].
    pub angular_velocity_i: Vector3<R>,
    /// Angular velocity of j [rad/s].
    pub angular_velocity_j: Vector3<R>,
    /// Angular velocity of i at mid-step [rad/s].
    pub angular_velocity_i_mid: Vector3<R>,
    /// Angular velocity of j at mid-step [rad/s].
    pub angular_velocity_j_mid: Vector3<R>,
}

/// What a contact is computed from.
#[derive(Clone, Copy, Debug)]
pub struct ContactInputs<'a, R> {
    /// Constants of the two bodies.
    pub pair: &'a Pair<R>,
    /// How they lie and move.
    pub motion: &'a ContactKinematics<R>,
    /// The step that led there [s].
    pub time_step: f64,
    /// Temperature in the middle of that step [K].
    pub temperature: f64,
}

/// The temperature of contacts whose laws do not ask for one [K].
pub const ROOM_TEMPERATURE: f64 = 293.15;

/// What a normal law sees of a contact: the motion along the line of centres.
#[derive(Clone, Copy, Debug)]
pub struct NormalMotion<R: Real> {
    /// Constants of the two bodies.
    pub pair: Pair<R>,
    /// Radius of i [m].
    pub radius_i: R,
    /// Radius of j; zero for a wall [m].
    pub radius_j: R,
    /// Overlap δ, negative at a distance [m].
    pub overlap: R,
    /// Whether the bodies overlap, δ > 0.
    pub touching: R::Mask,
    /// Overlap of bodies that touch, zero for others [m].
    pub depth: R,
    /// Closing rate dδ/dt at the time of the positions [m/s].
    pub closing_rate: R,
    /// How much δ has grown in the step that led here, from the velocity that moved the bodies [m].
    pub growth: R,
    /// Length of that step [s]; zero where the contact is looked at without a step.
    pub time_step: f64,
    /// Temperature in the middle of that step [K].
    pub temperature: f64,
}

impl<R: Real> NormalMotion<R> {
    /// The normal part of a motion after a step of `time_step` [s], with the `temperature` [K] in its middle.
    #[inline(always)]
    pub fn new(pair: &Pair<R>, kinematics: &ContactKinematics<R>, time_step: f64, temperature: f64) -> Self {
        let touching = kinematics.overlap.gt(R::zero());
        Self {
            pair: *pair,
            radius_i: kinematics.radius_i,
            radius_j: kinematics.radius_j,
            overlap: kinematics.overlap,
            touching,
            depth: kinematics.overlap.keep_where(touching),
            closing_rate: -kinematics.velocity.dot(kinematics.normal),
            growth: kinematics.velocity_mid.dot(kinematics.normal) * R::splat(-time_step),
            time_step,
            temperature,
        }
    }

    /// A contact at rest at an overlap [m]. The pair does not know both radii: taken are two spheres of the harmonic mean
    /// radius; for others see [`between`](Self::between).
    #[inline(always)]
    pub fn at_rest(pair: &Pair<R>, overlap: R) -> Self {
        let touching = overlap.gt(R::zero());
        let zero = R::zero();
        let radius = pair.harmonic_radius();
        Self {
            pair: *pair,
            radius_i: radius,
            radius_j: radius,
            overlap,
            touching,
            depth: overlap.keep_where(touching),
            closing_rate: zero,
            growth: zero,
            time_step: 0.0,
            temperature: ROOM_TEMPERATURE,
        }
    }

    /// The same motion between spheres of these radii [m]; zero for the second one is a wall.
    #[must_use]
    pub fn between(self, radius_i: R, radius_j: R) -> Self {
        Self { radius_i, radius_j, ..self }
    }

    /// Whether the bodies overlapped before the step; in a first look, whether they do now.
    #[inline(always)]
    pub fn touched_before(&self) -> R::Mask {
        self.overlap.gt(self.growth)
    }
}
