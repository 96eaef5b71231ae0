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
    /// Where the particles were when the candidates were listed.
    listed: &'a [Quad],
}

impl<'a> Columns<'a> {
    /// The columns of the particles; `listed` has their places of when the candidates were listed.
    pub(crate) fn of(particles: &'a mut Particles, listed: &'a [Quad]) -> Self {
        Self {
            place: Shared::new(&mut particles.place),
            velocity: Shared::new(&mut particles.velocity),
            spin: Shared::new(&mut particles.spin),
            velocity_predicted: Shared::new(&mut particles.velocity_predicted),
            spin_predicted: Shared::new(&mut particles.spin_predicted),
            loads: Shared::new(&mut particles.loads),
            mass: &particles.mass,
            listed,
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

/// First half kick by the `loads` on the rows, and drift over a time step. Predicted velocities are those at the end of the step if
/// forces stay as they are: what dashpots see, at the same instant as the positions.
///
/// Answers with the largest square of the distance of any particle from where it was listed [m²],
/// infinite where a position is no number.
pub(crate) struct KickAndDrift<'a> {
    columns: Columns<'a>,
    rows: Range<usize>,
    loads: &'a [Load],
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

impl<'a> KickAndDrift<'a> {
    /// # Safety
    /// Nobody else uses these rows until the kernel has run.
    pub(crate) unsafe fn new(
        columns: Columns<'a>,
        rows: Range<usize>,
        loads: &'a [Load],
        step: Step,
    ) -> Self {
        Self { columns, rows, loads, step }
    }
}

impl Kernel for KickAndDrift<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<R: Octet>(self) -> f64 {
        let Self { columns, rows, loads, step: Step { time_step, predicts_spins } } = self;
        let loads = &loads[..rows.len()];
        let half = 0.5 * time_step;
        let listed = &columns.listed[rows.clone()];
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
        let step = R::Row::splat(time_step);
        let mut farthest = 0.0;
        for row in 0..rows.len() {
            let (inverse_mass, inverse_radius) = (velocity[row].scalar, spin[row].scalar);
            let inverse_inertia = INVERSE_INERTIA * inverse_mass * inverse_radius * inverse_radius;
            let kick = R::Row::load(&loads[row].force).times(R::Row::splat(half * inverse_mass));
            let turn = R::Row::load(&loads[row].torque).times(R::Row::splat(half * inverse_inertia));
            let (velocity_before, spin_before) = (R::Row::load(&velocity[row]), R::Row::load(&spin[row]));
            let velocity_mid = velocity_before.plus(kick);
            let spin_mid = spin_before.plus(turn);
            velocity_mid.with_scalar_of(velocity_before).store(&mut velocity[row]);
            spin_mid.with_scalar_of(spin_before).store(&mut spin[row]);
            velocity_mid.plus(kick).with_scalar_of(spin_before).store(&mut velocity_predicted[row]);
            if predicts_spins {
                spin_mid.plus(turn).with_scalar_of(spin_before).store(&mut spin_predicted[row]);
            }
            let before = R::Row::load(&place[row]);
            let after = before.plus(velocity_mid.times(step)).with_scalar_of(before);
            after.store(&mut place[row]);
            let mut moved = Quad::default();
            after.minus(R::Row::load(&listed[row])).store(&mut moved);
            let moved = moved.vector.norm_squared();
            // Not `max`: a NaN must not be passed over.
            farthest = if moved <= farthest { farthest } else { moved };
            if farthest.is_nan() {
                farthest = f64::INFINITY;
            }
        }
        farthest
    }
}

/// Adds the background to the `loads` of the contacts on the rows, and does the second half kick over
/// `half` a time step [s]. Answers with the power that the drag takes [W].
pub(crate) struct Kick<'a> {
    columns: Columns<'a>,
    rows: Range<usize>,
    loads: &'a mut [Load],
    background: &'a Background,
    half: f64,
}

impl<'a> Kick<'a> {
    /// # Safety
    /// Nobody else uses these rows until the kernel has run.
    pub(crate) unsafe fn new(
        columns: Columns<'a>,
        rows: Range<usize>,
        loads: &'a mut [Load],
        background: &'a Background,
        half: f64,
    ) -> Self {
        Self { columns, rows, loads, background, half }
    }
}

impl Kernel for Kick<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<R: Octet>(self) -> f64 {
        let Self { columns, rows, loads, background, half } = self;
        let (mass, loads) = (&columns.mass[rows.clone()], &mut loads[..rows.len()]);
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
        let gravity = R::Row::load(&Quad::new(background.gravity, 0.0));
        let mut power = 0.0;
        for row in 0..rows.len() {
            let (inverse_mass, inverse_radius) = (velocity[row].scalar, spin[row].scalar);
            let inverse_inertia = INVERSE_INERTIA * inverse_mass * inverse_radius * inverse_radius;
            let weight = gravity.times(R::Row::splat(mass[row]));
            let mut push = R::Row::load(&loads[row].force).plus(weight);
            let mut turn = R::Row::load(&loads[row].torque);
            if background.has_drag() {
                let (velocity, spin) = (velocity_predicted[row].vector, spin_predicted[row].vector);
                let drag = background.drag_on(velocity, spin, place[row].scalar);
                power += drag.power;
                push = push.minus(R::Row::load(&Quad::new(drag.force, 0.0)));
                turn = turn.minus(R::Row::load(&Quad::new(drag.torque, 0.0)));
            }
            push.store(&mut loads[row].force);
            turn.store(&mut loads[row].torque);
            let (velocity_mid, spin_mid) = (R::Row::load(&velocity[row]), R::Row::load(&spin[row]));
            let kicked = velocity_mid.plus(push.times(R::Row::splat(half * inverse_mass)));
            let turned = spin_mid.plus(turn.times(R::Row::splat(half * inverse_inertia)));
            kicked.with_scalar_of(velocity_mid).store(&mut velocity[row]);
            turned.with_scalar_of(spin_mid).store(&mut spin[row]);
        }
        power
    }
}
