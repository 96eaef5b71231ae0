//! A wall that moves to and fro smoothly.

use std::f64::consts::TAU;

use pulvis_math::{Dimension, Vector3, elementary};

use super::{InvalidMotion, Motion, Parameter, Presence, Range};

/// Displacement X(t) = A/2 (1 − cos(2 π t/P)) from the place where the motion began: from rest to the
/// amplitude A at half a period and back to rest at P.
///
/// # Source
/// S. Luding, Granular Matter 10, 235 (2008), cosine-shaped wall motion of the tension tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cosine {
    /// Displacement A at half a period [m].
    pub displacement: Vector3,
    /// Period P [s].
    pub period: f64,
    /// Number of periods, after which the wall stands still; a half leaves it displaced by A.
    pub cycles: f64,
}

impl Default for Cosine {
    fn default() -> Self {
        Self { displacement: Vector3::zero(), period: 0.0, cycles: 1.0 }
    }
}

impl Motion for Cosine {
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let cycles = Parameter::number("cycles", Dimension::NONE, &mut self.cycles);
        vec![
            Parameter::vector("displacement", Dimension::LENGTH, &mut self.displacement),
            Parameter::number("period", Dimension::TIME, &mut self.period).within(Range::Positive),
            cycles.within(Range::Positive).or(Presence::Optional),
        ]
    }

    fn check(&self) -> Result<(), InvalidMotion> {
        if self.displacement == Vector3::zero() {
            return Err(InvalidMotion {
                parameter: "displacement",
                found: "the displacement is zero".to_owned(),
                expected: "a motion, or control = \"fixed\"".to_owned(),
            });
        }
        Ok(())
    }

    fn duration(&self) -> Option<f64> {
        Some(self.cycles * self.period)
    }

    fn highest_speed(&self) -> f64 {
        // Half-way to the amplitude, or where it stops before.
        let peak = 0.5 * TAU / self.period * self.displacement.norm();
        if self.cycles >= 0.25 { peak } else { peak * elementary::sin(TAU * self.cycles) }
    }

    fn displacement(&self, _before: Vector3, time: f64, time_step: f64) -> Vector3 {
        self.displacement_at(time + time_step)
    }

    fn velocity(&self, time: f64) -> Vector3 {
        self.velocity_at(time)
    }
}

impl Cosine {
    fn phase(&self, time: f64) -> f64 {
        TAU * (time / self.period).min(self.cycles)
    }

    /// Displacement at `time` [s] after the start [m].
    pub fn displacement_at(&self, time: f64) -> Vector3 {
        self.displacement * (0.5 * (1.0 - elementary::cos(self.phase(time))))
    }

    /// Velocity at `time` [s] after the start [m/s].
    pub fn velocity_at(&self, time: f64) -> Vector3 {
        // At rest, without the sign that a product with zero would have.
        if time <= 0.0 || time >= self.cycles * self.period {
            return Vector3::zero();
        }
        self.displacement * (0.5 * TAU / self.period * elementary::sin(self.phase(time)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wall_reaches_its_amplitude_at_half_a_period_and_comes_back() {
        let motion = Cosine { displacement: Vector3::new(2.0, 0.0, 0.0), period: 4.0, cycles: 2.0 };
        assert_eq!(motion.displacement_at(0.0).x, 0.0);
        assert_eq!(motion.displacement_at(2.0).x, 2.0);
        assert!(motion.displacement_at(4.0).x.abs() < 1e-15);
        assert!(motion.displacement_at(9.0).x.abs() < 1e-15);
        assert!((motion.velocity_at(1.0).x - std::f64::consts::PI / 2.0).abs() < 1e-15);
        assert_eq!(motion.velocity_at(8.0).x, 0.0);
    }
}
