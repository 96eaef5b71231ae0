//! A wall that follows a pressure.

use pulvis_math::elementary;
use std::f64::consts::PI;

/// A pressure that goes from one value to another along half a cosine and then stays.
#[derive(Clone, Copy, Debug, PartialEq)]
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
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Servo {
    /// The pressure to follow.
    pub pressure: PressureRamp,
    /// Mass of the wall [kg].
    pub mass: f64,
    /// Damping of the wall's motion γ [kg/s].
    pub damping: f64,
}

impl Servo {
    /// Acceleration along the wall's normal [m/s²], when the particles push it with `force` against
    /// its normal, negative along it [N], it moves with `speed` along its normal [m/s] and its face has
    /// `area` [m²].
    pub(crate) fn acceleration(&self, force: f64, speed: f64, area: f64, time: f64) -> f64 {
        (force + self.pressure.at(time) * area - self.damping * speed) / self.mass
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
        assert_eq!(servo.acceleration(-5.0, 0.0, 0.5, 0.0), 0.0);
        assert!(servo.acceleration(-4.0, 0.0, 0.5, 0.0) > 0.0);
    }
}
