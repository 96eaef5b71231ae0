//! Synchronised velocity-Verlet, one piece of rows at a time.

use std::ops::Range;

use pulvis_math::{Kernel, Octet, Quad, Row};

use crate::background::Background;
use crate::particles::{Load, Particles};
use crate::shared::Shared;

/// The columns that the integrator works on; see [`Particles`] for what the quads hold.
#[derive(Clone, Copy)]
pub(crate) struct Columns<'a> {
    place: Shared<'a, Quad>,
    velocity: Shared<'a, Quad>,
    spin: Shared<'a, Quad>,
    velocity_predicted: Shared<'a, Quad>,
    spin_predicted: Shared<'a, Quad>,
    pub(crate) loads: Shared<'a, Load>,
    mass: &'a [f64],
}

impl<'a> Columns<'a> {
    /// The columns of the particles.
    pub(crate) fn of(particles: &'a mut Particles) -> Self {
        Self {
            place: Shared::new(&mut particles.place),
            velocity: Shared::new(&mut particles.velocity),
            spin: Shared::new(&mut particles.spin),
            velocity_predicted: Shared::new(&mut particles.velocity_predicted),
            spin_predicted: Shared::new(&mut particles.spin_predicted),
            loads: Shared::new(&mut particles.loads),
            mass: &particles.mass,
        }
    }

    /// What the contact loop reads of them.
    pub(crate) fn moving(&self) -> crate::contacts::Moving<'a> {
        crate::contacts::Moving {
            place: self.place,
            velocity_mid: self.velocity,
            velocity: self.velocity_predicted,
            spin_mid: self.spin,
            spin: self.spin_predicted,
        }
    }
}

/// 1/I over 1/(m a²) of a solid sphere, I = 2/5 m a².
const INVERSE_INERTIA: f64 = 2.5;

/// The ends of a step for some rows: the second half kick of one step if `FINISH`, the first half kick and
/// the drift of the next one if `BEGIN`; both in one go while the rows are at hand.
///
/// Predicted velocities are those at the end of the step if forces stay as they are: what dashpots see,
/// at the same instant as the positions.
pub(crate) struct Kicks<'a, const FINISH: bool, const BEGIN: bool> {
    columns: Columns<'a>,
    rows: Range<usize>,
    loads: &'a mut [Load],
    background: &'a Background,
    step: Step,
}

/// What steps of all rows have in common.
#[derive(Clone, Copy)]
pub(crate) struct Step {
    /// Duration [s].
    pub(crate) time_step: f64,
    /// Whether anybody looks at predicted spins.
    pub(crate) predicts_spins: bool,
}

/// What comes out of the [`Kicks`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kicked {
    /// Power that the drag takes [W].
    pub(crate) power: f64,
    /// The highest speed of the drift [m/s]; infinite where one is no number.
    pub(crate) fastest: f64,
}

impl<'a, const FINISH: bool, const BEGIN: bool> Kicks<'a, FINISH, BEGIN> {
    /// For the rows with the `loads` on them: those of the contacts, to which the second half kick adds
    /// the `background`.
    ///
    /// # Safety
    /// Nobody else uses these rows until the kernel has run.
    pub(crate) unsafe fn new(
        columns: Columns<'a>,
        rows: Range<usize>,
        loads: &'a mut [Load],
        background: &'a Background,
        step: Step,
    ) -> Self {
        Self { columns, rows, loads, background, step }
    }
}

impl<const FINISH: bool, const BEGIN: bool> Kernel for Kicks<'_, FINISH, BEGIN> {
    type Output = Kicked;

    #[inline(always)]
    fn run<R: Octet>(self) -> Kicked {
        let Self { columns, rows, loads, background, step: Step { time_step, predicts_spins } } = self;
        let loads = &mut loads[..rows.len()];
        let mass = &columns.mass[rows.clone()];
        // SAFETY: as `new` demands.
        let (place, velocity, spin, velocity_predicted, spin_predicted) = unsafe {
            (
                columns.place.range_mut(rows.clone()),
                columns.velocity.range_mut(rows.clone()),
                columns.spin.range_mut(rows.clone()),
                columns.velocity_predicted.range_mut(rows.clone()),
                columns.spin_predicted.range_mut(rows.clone()),
            )
        };
        let half = 0.5 * time_step;
        let step = R::Row::splat(time_step);
        let gravity = R::Row::load(&Quad::new(background.gravity, 0.0));
        let mut kicked = Kicked::default();
        for row in 0..rows.len() {
            let (inverse_mass, inverse_radius) = (velocity[row].scalar, spin[row].scalar);
            let inverse_inertia = INVERSE_INERTIA * inverse_mass * inverse_radius * inverse_radius;
            let (mut push, mut turn) = (R::Row::load(&loads[row].force), R::Row::load(&loads[row].torque));
            if FINISH {
                push = push.plus(gravity.times(R::Row::splat(mass[row])));
                if background.has_drag() {
                    let (velocity, spin) = (velocity_predicted[row].vector, spin_predicted[row].vector);
                    let drag = background.drag_on(velocity, spin, place[row].scalar);
                    kicked.power += drag.power;
                    push = push.minus(R::Row::load(&Quad::new(drag.force, 0.0)));
                    turn = turn.minus(R::Row::load(&Quad::new(drag.torque, 0.0)));
                }
                if !BEGIN {
                    push.store(&mut loads[row].force);
                    turn.store(&mut loads[row].torque);
                }
            }
            let kick = push.times(R::Row::splat(half * inverse_mass));
            let turning = turn.times(R::Row::splat(half * inverse_inertia));
            let (velocity_before, spin_before) = (R::Row::load(&velocity[row]), R::Row::load(&spin[row]));
            let (mut velocity_now, mut spin_now) = (velocity_before.plus(kick), spin_before.plus(turning));
            if FINISH && BEGIN {
                velocity_now = velocity_now.plus(kick);
                spin_now = spin_now.plus(turning);
            }
            velocity_now.with_scalar_of(velocity_before).store(&mut velocity[row]);
            spin_now.with_scalar_of(spin_before).store(&mut spin[row]);
            if BEGIN {
                velocity_now.plus(kick).with_scalar_of(spin_before).store(&mut velocity_predicted[row]);
                if predicts_spins {
                    spin_now.plus(turning).with_scalar_of(spin_before).store(&mut spin_predicted[row]);
                }
                let before = R::Row::load(&place[row]);
                let after = before.plus(velocity_now.times(step)).with_scalar_of(before);
                after.store(&mut place[row]);
                let mut drift = Quad::default();
                velocity_now.store(&mut drift);
                let speed = drift.vector.norm_squared();
                // Not `>`: a NaN must not be passed over.
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
