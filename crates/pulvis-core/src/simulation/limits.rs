//! What stops a simulation: states that cannot be right.
//!
//! Nothing of this costs the contact loop anything. Positions and walls are looked at when a list is made anew, which
//! is before any particle or wall has moved farther than its skin; energies every 64 steps; stiffnesses that no law
//! bounds, which the loop sums up anyway, every step.

use std::f64::consts::PI;

use pulvis_math::Vector3;

use super::Simulation;
use super::errors::{Alarm, StepError};
use crate::ledger::Ledger;
use crate::walls::Shape;

/// Limits of what a simulation may do before [`Simulation::advance`] stops with an [`Alarm`]. NaN and infinity always
/// stop it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Closing error of the energy ledger over the largest energy in motion [1].
    pub energy_error: f64,
    /// Overlap of two particles over the smaller radius, and of a particle and a wall over its radius [1]. One is where
    /// the centre of the smaller particle enters the larger one, or passes the wall: what comes then is no contact.
    pub overlap: f64,
    /// Speed of any particle [m/s].
    pub speed: f64,
    /// Way of any particle and any wall in a time step, over the smallest radius [1]. Longer ones step over contacts.
    pub displacement: f64,
    /// Time steps in the duration π √(m_r/k) of a contact at its present stiffness, at the least [1]. Only contacts of
    /// laws without a steepest slope are looked at: what the others can do is known before they move.
    pub steps_per_contact: f64,
    /// Whether two walls that face each other may pass each other.
    pub walls_may_cross: bool,
}

impl Limits {
    /// No limits: only NaN and infinity stop the simulation. How a simulation starts.
    pub const NONE: Self = Self {
        energy_error: f64::INFINITY,
        overlap: f64::INFINITY,
        speed: f64::INFINITY,
        displacement: f64::INFINITY,
        steps_per_contact: 0.0,
        walls_may_cross: true,
    };
}

impl Default for Limits {
    /// What any sound simulation keeps. At the automatic time step, a fiftieth of the shortest contact, an impact with a
    /// displacement of 0.25 radii a step would go four radii deep (π/50 of the overlap is the way of a step). Ten steps in a
    /// contact are the fewest that a time step may be chosen for (see [`shortest_motion`](crate::shortest_motion)).
    fn default() -> Self {
        Self {
            energy_error: 1e-2,
            overlap: 1.0,
            speed: f64::INFINITY,
            displacement: 0.25,
            steps_per_contact: 10.0,
            walls_may_cross: false,
        }
    }
}

impl Simulation {
    /// Sets what stops the simulation; by default [`Limits::NONE`].
    pub fn set_limits(&mut self, limits: Limits) {
        self.limits = limits;
    }

    /// Checks the present state against NaN, infinity and the limits. [`advance`](Self::advance) does so every so many
    /// steps; whoever reports a state can do so then.
    ///
    /// # Errors
    /// As of `advance`.
    pub fn check_state(&self) -> Result<(), StepError> {
        self.check_movement()?;
        self.check_energy(&self.ledger())
    }

    pub(super) fn alarm(&self, alarm: Alarm) -> StepError {
        StepError { step: self.step, time: self.time, alarm }
    }

    /// Whether particles and walls are where and as fast as they can be.
    pub(super) fn check_movement(&self) -> Result<(), StepError> {
        self.check_finite()?;
        self.check_speeds()?;
        let smallest = self.smallest_radius();
        let (longest, most) = (self.limits.displacement * smallest, self.limits.displacement);
        let fits = |way: f64| way <= longest;
        for (row, velocity) in self.particles.velocity.iter().enumerate() {
            let way = velocity.vector.norm() * self.time_step;
            if !fits(way) {
                let (id, radii) = (self.particles.id[row], way / smallest);
                return Err(self.alarm(Alarm::ParticleTooFast { id, radii, most }));
            }
        }
        for (wall, state) in self.walls.iter().zip(&self.wall_states).filter(|(wall, _)| wall.present) {
            let mut way = state.displacement.norm();
            if wall.shape.is_turned_by_rotation() {
                way += state.angular_velocity.abs() * self.time_step * wall.shape.distance_from_axis();
            }
            if !fits(way) {
                let (wall, radii) = (wall.name.clone(), way / smallest);
                return Err(self.alarm(Alarm::WallTooFast { wall, radii, most }));
            }
        }
        if self.limits.walls_may_cross { Ok(()) } else { self.check_crossing() }
    }

    /// Whether no particle is faster than the limit.
    pub(super) fn check_speeds(&self) -> Result<(), StepError> {
        let most = self.limits.speed;
        if most == f64::INFINITY {
            return Ok(());
        }
        let speeds = self.particles.velocity.iter().map(|velocity| velocity.vector.norm()).enumerate();
        match speeds.max_by(|(_, one), (_, other)| one.total_cmp(other)) {
            Some((row, speed)) if speed > most => {
                Err(self.alarm(Alarm::BeyondSpeed { id: self.particles.id[row], speed, most }))
            }
            _ => Ok(()),
        }
    }

    /// Whether all positions and velocities are numbers whose squares are numbers.
    fn check_finite(&self) -> Result<(), StepError> {
        let particles = &self.particles;
        // Kinetic energy needs the square of a velocity.
        let has_square: fn(Vector3) -> bool = |velocity| velocity.norm_squared().is_finite();
        for (quantity, column, is_sound) in [
            ("position", &particles.position, Vector3::is_finite as fn(Vector3) -> bool),
            ("velocity", &particles.velocity, has_square),
            ("angular velocity", &particles.angular_velocity, has_square),
        ] {
            if let Some(row) = column.iter().position(|packed| !is_sound(packed.vector)) {
                return Err(self.alarm(Alarm::ParticleLost { id: particles.id[row], quantity }));
            }
        }
        for (wall, state) in self.walls.iter().zip(&self.wall_states) {
            let sound = [("position", wall.point.is_finite()), ("velocity", has_square(state.velocity))];
            if let Some((quantity, _)) = sound.into_iter().find(|(_, is_sound)| !is_sound) {
                return Err(self.alarm(Alarm::WallLost { wall: wall.name.clone(), quantity }));
            }
        }
        Ok(())
    }

    fn check_crossing(&self) -> Result<(), StepError> {
        let present = || self.walls.iter().filter(|wall| wall.present);
        for (number, wall) in present().enumerate() {
            for opposite in present().skip(number + 1) {
                if let Some(distance) = wall.distance_to_facing(opposite)
                    && distance < 0.0
                {
                    let depth = -distance;
                    let (wall, opposite) = (wall.name.clone(), opposite.name.clone());
                    return Err(self.alarm(Alarm::WallsCrossed { wall, opposite, depth }));
                }
            }
        }
        Ok(())
    }

    /// Whether the time step resolves the stiffest contact of the last pass, where its law does not bound that.
    pub(super) fn check_stiffness(&self) -> Result<(), StepError> {
        let frequency = self.pass.rate_squared.sqrt();
        let (steps, least) = (PI / (frequency * self.time_step), self.limits.steps_per_contact);
        // Not `<`: NaN resolves nothing.
        let resolved = steps >= least;
        if resolved { Ok(()) } else { Err(self.alarm(Alarm::TooStiff { steps, least })) }
    }

    /// Whether the energies are numbers and balance.
    pub(super) fn check_energy(&self, ledger: &Ledger) -> Result<(), StepError> {
        let accounts = ledger.accounts();
        // Contacts keep no accounts without a ledger.
        let kept =
            |name: &str| self.accounting || ["kinetic_translation", "kinetic_rotation"].contains(&name);
        if let Some((account, _)) = accounts.iter().find(|(name, value)| kept(name) && !value.is_finite()) {
            // A particle or a wall says more than an account.
            self.check_finite()?;
            return Err(self.alarm(Alarm::EnergyNotFinite { account }));
        }
        let (error, most) = (ledger.relative_error().abs(), self.limits.energy_error);
        // Not `>`: NaN is no small error.
        let closes = error <= most;
        if self.accounting && !closes {
            return Err(self.alarm(Alarm::EnergyError { error, most }));
        }
        Ok(())
    }
}
