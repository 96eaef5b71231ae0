//! Synchronised velocity-Verlet, one chunk of rows at a time.

use std::ops::Range;

use pulvis_math::{Kernel, Packed4, Simd4, Simd8};

use crate::particles::{ForceTorque, Particles, SOLID_SPHERE};
use crate::shared::Shared;
use pulvis_boundary::Background;

/// The columns that the integrator works on; see [`Particles`] for what the packed vectors hold.
#[derive(Clone, Copy)]
pub(crate) struct Columns<'a> {
    position: Shared<'a, Packed4>,
    velocity: Shared<'a, Packed4>,
    angular_velocity: Shared<'a, Packed4>,
    velocity_predicted: Shared<'a, Packed4>,
    angular_velocity_predicted: Shared<'a, Packed4>,
    pub(crate) forces_and_torques: Shared<'a, ForceTorque>,
    mass: &'a [f64],
    /// Forces that a program applies; empty where there are none.
    applied: &'a [Packed4],
    /// Forces of all other charges, with energies beside them; empty where there are none.
    electrostatic: &'a [Packed4],
}

impl<'a> Columns<'a> {
    /// The columns of the particles.
    pub(crate) fn of(particles: &'a mut Particles) -> Self {
        Self {
            position: Shared::new(&mut particles.position),
            velocity: Shared::new(&mut particles.velocity),
            angular_velocity: Shared::new(&mut particles.angular_velocity),
            velocity_predicted: Shared::new(&mut particles.velocity_predicted),
            angular_velocity_predicted: Shared::new(&mut particles.angular_velocity_predicted),
            forces_and_torques: Shared::new(&mut particles.forces_and_torques),
            mass: &particles.mass,
            applied: &particles.applied,
            electrostatic: &particles.electrostatic,
        }
    }

    /// What the contact loop reads of them.
    pub(crate) fn moving(&self) -> crate::contacts::KinematicColumns<'a> {
        crate::contacts::KinematicColumns {
            position: self.position,
            velocity_mid: self.velocity,
            velocity: self.velocity_predicted,
            angular_velocity_mid: self.angular_velocity,
            angular_velocity: self.angular_velocity_predicted,
            quantities: &[],
        }
    }
}

/// The second half kick of a step if `FINISH`, and the first half kick and the drift of the next step if `BEGIN`, for some
/// rows. Both together read each row once.
///
/// Predicted velocities are those at the end of the step if forces stay as they are. Dashpots use them, because they belong
/// to the same time as the positions.
pub(crate) struct HalfKicks<'a, const FINISH: bool, const BEGIN: bool> {
    columns: Columns<'a>,
    rows: Range<usize>,
    forces_and_torques: &'a mut [ForceTorque],
    background: &'a Background,
    step: Step,
}

/// The parameters of a step.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    /// Duration [s].
    pub(crate) time_step: f64,
    /// Whether predicted angular velocities are used.
    pub(crate) predicts_angular_velocities: bool,
}

/// The results of [`HalfKicks`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kicked {
    /// Power that the drag takes [W].
    pub(crate) power: f64,
    /// Work that applied forces have done in the kicks: half a step of each with the mid-step velocity, so that over a step
    /// their mean times the displacement is exact [J].
    pub(crate) applied_work: f64,
    /// The maximum speed of the drift [m/s]; infinite if any is NaN.
    pub(crate) fastest: f64,
}

impl<'a, const FINISH: bool, const BEGIN: bool> HalfKicks<'a, FINISH, BEGIN> {
    /// `forces_and_torques` are those of the contacts on these rows; the second half kick adds the `background`.
    ///
    /// # Safety
    /// No other thread uses these rows until the kernel has run.
    pub(crate) unsafe fn new(
        columns: Columns<'a>,
        rows: Range<usize>,
        forces_and_torques: &'a mut [ForceTorque],
        background: &'a Background,
        step: Step,
    ) -> Self {
        Self { columns, rows, forces_and_torques, background, step }
    }
}

impl<const FINISH: bool, const BEGIN: bool> Kernel for HalfKicks<'_, FINISH, BEGIN> {
    type Output = Kicked;

    #[inline(always)]
    fn run<R: Simd8>(self) -> Kicked {
        let Self {
            columns,
            rows,
            forces_and_torques,
            background,
            step: Step { time_step, predicts_angular_velocities },
        } = self;
        let forces_and_torques = &mut forces_and_torques[..rows.len()];
        let mass = &columns.mass[rows.clone()];
        let applied = columns.applied.get(rows.clone());
        let electrostatic = columns.electrostatic.get(rows.clone());
        // SAFETY: as `new` demands.
        let (position, velocity, angular_velocity, velocity_predicted, angular_velocity_predicted) = unsafe {
            (
                columns.position.range_mut(rows.clone()),
                columns.velocity.range_mut(rows.clone()),
                columns.angular_velocity.range_mut(rows.clone()),
                columns.velocity_predicted.range_mut(rows.clone()),
                columns.angular_velocity_predicted.range_mut(rows.clone()),
            )
        };
        let half = 0.5 * time_step;
        let step = R::Simd4::splat(time_step);
        let gravity = R::Simd4::load(&Packed4::new(background.gravity, 0.0));
        let mut kicked = Kicked::default();
        for row in 0..rows.len() {
            let (inverse_mass, inverse_radius) = (velocity[row].scalar, angular_velocity[row].scalar);
            let inverse_inertia = (1.0 / SOLID_SPHERE) * inverse_mass * inverse_radius * inverse_radius;
            let (mut push, mut turn) = (
                R::Simd4::load(&forces_and_torques[row].force),
                R::Simd4::load(&forces_and_torques[row].torque),
            );
            if FINISH {
                push = push.plus(gravity.times(R::Simd4::splat(mass[row])));
                if let Some(applied) = applied {
                    kicked.applied_work += half * applied[row].vector.dot(velocity[row].vector);
                    push = push.plus(R::Simd4::load(&applied[row]));
                }
                if let Some(electrostatic) = electrostatic {
                    push = push.plus(R::Simd4::load(&Packed4::new(electrostatic[row].vector, 0.0)));
                }
                if background.has_drag() {
                    let (velocity, angular_velocity) =
                        (velocity_predicted[row].vector, angular_velocity_predicted[row].vector);
                    let drag = background.drag_on(velocity, angular_velocity, position[row].scalar);
                    kicked.power += drag.power;
                    push = push.minus(R::Simd4::load(&Packed4::new(drag.force, 0.0)));
                    turn = turn.minus(R::Simd4::load(&Packed4::new(drag.torque, 0.0)));
                }
                if !BEGIN {
                    push.store(&mut forces_and_torques[row].force);
                    turn.store(&mut forces_and_torques[row].torque);
                }
            }
            let kick = push.times(R::Simd4::splat(half * inverse_mass));
            let turning = turn.times(R::Simd4::splat(half * inverse_inertia));
            let (velocity_before, angular_velocity_before) =
                (R::Simd4::load(&velocity[row]), R::Simd4::load(&angular_velocity[row]));
            let (mut velocity_now, mut angular_velocity_now) =
                (velocity_before.plus(kick), angular_velocity_before.plus(turning));
            if FINISH && BEGIN {
                velocity_now = velocity_now.plus(kick);
                angular_velocity_now = angular_velocity_now.plus(turning);
            }
            velocity_now.with_scalar_of(velocity_before).store(&mut velocity[row]);
            angular_velocity_now.with_scalar_of(angular_velocity_before).store(&mut angular_velocity[row]);
            if BEGIN {
                velocity_now
                    .plus(kick)
                    .with_scalar_of(angular_velocity_before)
                    .store(&mut velocity_predicted[row]);
                if predicts_angular_velocities {
                    angular_velocity_now
                        .plus(turning)
                        .with_scalar_of(angular_velocity_before)
                        .store(&mut angular_velocity_predicted[row]);
                }
                let before = R::Simd4::load(&position[row]);
                let after = before.plus(velocity_now.times(step)).with_scalar_of(before);
                after.store(&mut position[row]);
                let mut drift = Packed4::default();
                velocity_now.store(&mut drift);
                if let Some(applied) = applied {
                    kicked.applied_work += half * applied[row].vector.dot(drift.vector);
                }
                let speed = drift.vector.norm_squared();
                // Not `>`, which would ignore a NaN.
                let slower = speed <= kicked.fastest;
                if !slower {
                    kicked.fastest = if speed.is_nan() { f64::INFINITY } else { speed };
                }
            }
        }
        kicked.fastest = kicked.fastest.sqrt();
        kicked
    }
}
