//! A step of the flow of a cell: particles are carried along, and the cell does its work.

use pulvis_boundary::UpperTriangular;
use pulvis_math::Vector3;

use super::{Cell, MOST_STRAIN};
use crate::shared::Shared;
use crate::simulation::Simulation;
use crate::simulation::errors::{Alarm, StepError};

/// The flow of the cell over a time step, by the rule of the middle: x₁ − x₀ = dt (c̄ + G (x₀ + x₁)/2) and the like for c.
/// It is symmetric in time and therefore of second order; a free particle in a shear moves exactly, and along a
/// stretched axis the product of length and velocity is exactly constant.
struct FlowStep {
    /// x₁ of x₀, relative to the middle of the cell: F = (1 − G dt/2)⁻¹ (1 + G dt/2).
    deformation: UpperTriangular,
    /// c₁ of c₀: (1 + G dt/2)⁻¹ (1 − G dt/2).
    slowing: UpperTriangular,
    /// What c₀ adds to x₁ [s].
    drift: UpperTriangular,
    time_step: f64,
}

impl FlowStep {
    fn new(rate: &UpperTriangular, time_step: f64) -> Self {
        let half = *rate * (0.5 * time_step);
        let (plus, minus) = (UpperTriangular::IDENTITY + half, UpperTriangular::IDENTITY - half);
        Self {
            deformation: minus.inverse().after(&plus),
            slowing: plus.inverse().after(&minus),
            drift: minus.inverse().after(&plus.inverse()) * time_step,
            time_step,
        }
    }

    /// Of a particle that has been kicked and has drifted as without flow: position relative to the middle of the cell,
    /// velocity, and predicted velocity.
    #[inline(always)]
    fn carry(&self, [drifted, velocity, predicted]: [Vector3; 3]) -> [Vector3; 3] {
        let before = drifted - velocity * self.time_step;
        let after = self.slowing.times(velocity);
        let position = self.deformation.times(before) + self.drift.times(velocity);
        [position, after, after + (predicted - velocity)]
    }
}

impl Simulation {
    /// Deforms the cell over a step, and carries along the particles, which have been kicked and have drifted.
    pub(in crate::simulation) fn deform_cell(&mut self) -> Result<(), StepError> {
        let (time_step, middle) = (self.time_step, self.domain.middle());
        let rate = self.rate_now();
        let strain = rate.bound() * time_step;
        // Not `>`: NaN is no small strain.
        let fits = strain <= MOST_STRAIN;
        if !fits {
            return Err(self.alarm(Alarm::CellTooFast { strain, most: MOST_STRAIN }));
        }
        let flow = FlowStep::new(&rate, time_step);
        self.forget_movement();
        let own = self.contacts.own();
        let chunks = &self.contacts.chunks()[own.clone()];
        let particles = &mut self.particles;
        let positions = Shared::new(&mut particles.position);
        let velocities = Shared::new(&mut particles.velocity);
        let predicted = Shared::new(&mut particles.velocity_predicted);
        // The displacement relative to the flow grows with the flow, by less than this beside the drift.
        let growth = 2.0 * strain;
        let thickest = self.skin.thickest;
        self.pool.for_each(&mut self.outcomes[own], |number, outcome| {
            let rows = chunks[number].rows.clone();
            // SAFETY: chunks have different rows.
            let (positions, velocities, predicted) = unsafe {
                (
                    positions.range_mut(rows.clone()),
                    velocities.range_mut(rows.clone()),
                    predicted.range_mut(rows),
                )
            };
            for ((position, velocity), predicted) in positions.iter_mut().zip(velocities).zip(predicted) {
                let [carried, slowed, expected] =
                    flow.carry([position.vector - middle, velocity.vector, predicted.vector]);
                position.vector = carried + middle;
                (velocity.vector, predicted.vector) = (slowed, expected);
            }
            outcome.moved = outcome.moved.farther(growth * (thickest + outcome.kicked.fastest * time_step));
        });
        self.domain = self.domain.deformed(&flow.deformation);
        self.cell.since_list = flow.deformation.after(&self.cell.since_list);
        self.cell.strain = self.cell.strain + rate * time_step;
        self.cell.rate = rate;
        Ok(())
    }

    /// The velocity gradient of the coming step, by the stress at its beginning [1/s].
    fn rate_now(&self) -> UpperTriangular {
        let Cell { motion, start, content, stress, .. } = &self.cell;
        if motion.targets().next().is_none() {
            return motion.prescribed();
        }
        let volume = self.domain.extent.volume();
        // Of the two shear stresses the one that does work.
        let stress = UpperTriangular::INDICES.map(|[row, column]| stress[row][column] / volume);
        motion.rates(stress, self.time - start, *content)
    }

    /// Takes in the stress at the end of a step, and books the work of the cell by the trapezoidal rule.
    pub(in crate::simulation) fn finish_cell(&mut self) {
        let before = self.cell.stress;
        self.take_stress();
        let now = self.cell.stress;
        let rates = self.cell.rate.to_array();
        let power: f64 = UpperTriangular::INDICES
            .into_iter()
            .zip(rates)
            .map(|([row, column], rate)| rate * (before[row][column] + now[row][column]))
            .sum();
        self.cell.work -= 0.5 * self.time_step * power;
    }

    /// Takes in the present stress.
    pub(in crate::simulation) fn take_stress(&mut self) {
        self.cell.stress = self.stress_times_volume();
    }
}
