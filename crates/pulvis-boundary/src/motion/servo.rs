//! A wall that follows a pressure.

use std::f64::consts::PI;

use pulvis_math::{Dimension, elementary};

use super::{InvalidMotion, Motion, Parameter, Presence, Push, Range};

/// A pressure that goes from one value to another along half a cosine and then stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PressureRamp {
    /// Pressure at the start [Pa].
    pub from: f64,
    /// Pressure from the end of the ramp on [Pa].
    pub to: f64,
    /// Duration of the ramp [s].
    pub duration: f64,
}

impl PressureRamp {
    /// The pressure at `time` [s] after the start [Pa].
    pub fn at(&self, time: f64) -> f64 {
        if time >= self.duration {
            return self.to;
        }
        self.from + (self.to - self.from) * 0.5 * (1.0 - elementary::cos(PI * time / self.duration))
    }
}

/// A wall with a mass that the pressure pushes towards the particles and the particles push back:
/// m X'' = F − p A − γ X' along its normal.
///
/// # Source
/// S. Luding, Granular Matter 10, 235 (2008), pressure-controlled walls; the equation is that of a
/// piston under its load.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Servo {
    /// The pressure to follow.
    pub pressure: PressureRamp,
    /// Mass of the wall [kg].
    pub mass: f64,
    /// Damping of the wall's motion γ [kg/s].
    pub damping: f64,
}

impl Motion for Servo {
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let PressureRamp { from, to, duration } = &mut self.pressure;
        let ramp = Parameter::number("ramp", Dimension::TIME, duration);
        vec![
            Parameter::number("pressure", Dimension::PRESSURE, to),
            Parameter::number("from", Dimension::PRESSURE, from).or(Presence::SameAs("pressure")),
            ramp.within(Range::NonNegative).or(Presence::Optional),
            Parameter::number("mass", Dimension::MASS, &mut self.mass).within(Range::Positive),
            Parameter::number("damping", Dimension::DASHPOT, &mut self.damping).within(Range::NonNegative),
        ]
    }

    fn check(&self) -> Result<(), InvalidMotion> {
        if self.pressure.from != self.pressure.to && self.pressure.duration == 0.0 {
            return Err(InvalidMotion {
                parameter: "from",
                found: "`from` differs from `pressure`, but the ramp takes no time".to_owned(),
                expected: "a `ramp` greater than 0".to_owned(),
            });
        }
        Ok(())
    }

    fn is_pushed(&self) -> bool {
        true
    }

    fn needs_area(&self) -> bool {
        true
    }

    fn pressure(&self, time: f64) -> Option<f64> {
        Some(self.pressure.at(time))
    }

    fn mass_and_damping(&self) -> Option<(f64, f64)> {
        Some((self.mass, self.damping))
    }

    fn acceleration(&self, push: &Push) -> Option<f64> {
        let pressure = self.pressure.at(push.time);
        Some((push.force + pressure * push.area - self.damping * push.speed) / self.mass)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_is_smooth_at_both_ends() {
        let ramp = PressureRamp { from: 1.0, to: 3.0, duration: 2.0 };
        assert_eq!(ramp.at(0.0), 1.0);
        assert!((ramp.at(1.0) - 2.0).abs() < 1e-15);
        assert_eq!(ramp.at(2.5), 3.0);
        assert!(ramp.at(1e-4) - 1.0 < 1e-7 && 3.0 - ramp.at(2.0 - 1e-4) < 1e-7);
    }

    #[test]
    fn a_wall_in_balance_with_its_pressure_does_not_move() {
        let pressure = PressureRamp { from: 10.0, to: 10.0, duration: 0.0 };
        let servo = Servo { pressure, mass: 2.0, damping: 1.0 };
        let push = |force| Push { force, speed: 0.0, area: 0.5, time: 0.0 };
        assert_eq!(servo.acceleration(&push(-5.0)), Some(0.0));
        assert!(servo.acceleration(&push(-4.0)).is_some_and(|acceleration| acceleration > 0.0));
    }
}
