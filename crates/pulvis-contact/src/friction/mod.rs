//! Resistance against sliding, rolling and torsion. One file a law; the list is at the end of this
//! file.

use pulvis_math::{Real, Vector3};

use crate::catalogue::{InvalidParameter, LawEntry, Role, Values};

mod none;
mod spring_slider;

pub use spring_slider::SpringSlider;

/// What a friction law answers to a relative motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrictionResponse<T, R = f64> {
    /// Force against the motion [N].
    pub force: T,
    /// Elastic energy of the spring [J].
    pub stored_energy: R,
    /// Energy lost by slipping since the last call [J].
    pub dissipated_slip: R,
    /// Power lost in the dashpot [W].
    pub viscous_power: R,
}

/// The motion that a spring of a contact follows during one time step.
#[derive(Clone, Copy, Debug)]
pub struct SpringMotion<T, R> {
    /// Relative velocity at the time of the force [m/s].
    pub velocity: T,
    /// Relative displacement since the last call, from the velocities that moved the bodies [m].
    pub displacement: T,
    /// Normal force that the Coulomb limit refers to [N]; zero for an open contact.
    pub friction_reference: R,
}

/// How the sliding and rolling springs follow the contact when it turns in space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpringRotation {
    /// Projected into the tangent plane and stretched back to its old length (Luding 2008, eq. 17).
    /// The length is kept, the direction drifts at first order in the step: projection shortens only
    /// the part along the way that the normal turns, stretching lengthens both.
    #[default]
    Rescale,
    /// Projected into the tangent plane only (LIGGGHTS).
    Project,
    /// Turned with the line of centres, and about it with the mean spin of the bodies (YADE): the
    /// spring of a stuck pair that turns as one body turns with it, to second order in the step.
    Twist,
    /// Only the part along the line of centres that the present step brings is removed (MercuryDPM).
    Rate,
}

/// A spring before the step, carried along by the turning contact: `turned` is the change of the
/// normal in the step, `turn_rate_normal` the normal part that the rate form of the spring loses [m],
/// `mean_twist` the mean turn of the bodies about the normal.
#[inline(always)]
pub(crate) fn carried_along<R: Real>(
    rotation: SpringRotation,
    spring: Vector3<R>,
    normal: Vector3<R>,
    turn_rate_normal: R,
    turned: Vector3<R>,
    mean_twist: R,
) -> Vector3<R> {
    match rotation {
        SpringRotation::Rescale => restored(spring, spring, normal),
        SpringRotation::Project => spring.tangential_to(normal),
        SpringRotation::Twist => {
            // Projection loses half the square of the turn along the way of the normal.
            let lost = turned * (R::splat(0.5) * turned.dot(spring));
            restored(spring + lost + normal.cross(spring) * mean_twist, spring, normal)
        }
        SpringRotation::Rate => spring - normal * turn_rate_normal,
    }
}

/// A moved spring, back in the tangent plane and at the length that it had before, whatever moved it.
// A function and not a closure: closures are not inlined by force, and out of line they are compiled
// without the vector instructions of the loop that calls them.
#[inline(always)]
fn restored<R: Real>(moved: Vector3<R>, before: Vector3<R>, normal: Vector3<R>) -> Vector3<R> {
    let projected = moved.tangential_to(normal);
    let remaining = projected.norm_squared();
    let stretched = (before.norm_squared() / remaining).sqrt();
    projected * R::select(remaining.gt(R::zero()), stretched, R::one())
}

macro_rules! friction_laws {
    ($($module:ident),* $(,)?) => {
        /// The descriptions of all laws that can play `role`.
        pub fn entries(role: Role) -> Vec<&'static LawEntry> {
            [$($module::entry(role)),*].into_iter().flatten().collect()
        }

        /// The law called `name` in `role` with the given parameter values; the outer `None` where
        /// there is no such law, the inner one where the law is to have no friction.
        pub fn build(
            role: Role,
            name: &str,
            values: &Values,
        ) -> Option<Result<Option<SpringSlider>, InvalidParameter>> {
            $(if let Some(entry) = $module::entry(role).filter(|entry| entry.name == name) {
                return Some(entry.complete(values).and_then(|values| $module::build(role, &values)));
            })*
            None
        }
    };
}

// The list of friction laws: a new one is its file and its name here.
friction_laws![none, spring_slider];
