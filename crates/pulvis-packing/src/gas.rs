//! Velocities of a gas.

use pulvis_math::Vector3;

use super::{Random, gaussian_vector};

/// Random velocities whose components are Gaussian, as those of a gas in equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GasVelocities {
    /// Standard deviation of each component [m/s].
    pub standard_deviation: f64,
    /// Whether the momenta add up to zero.
    pub zero_momentum: bool,
    /// Whether the temperature is what the standard deviation stands for, not only on the average: Σ m v²/(3 Σ m) =
    /// σ² for velocities relative to the centre of mass.
    pub exact_temperature: bool,
}

impl GasVelocities {
    /// Draws the velocities [m/s] of particles with these masses [kg], in their order. Momenta of a gas without momentum
    /// cancel to round-off. A single particle has no temperature of its own: it keeps its velocity, or rests where
    /// there is no momentum.
    pub fn draw(&self, masses: &[f64], random: &mut Random) -> Vec<Vector3> {
        let Self { standard_deviation, zero_momentum, exact_temperature } = *self;
        if standard_deviation == 0.0 {
            return vec![Vector3::zero(); masses.len()];
        }
        let mut velocities: Vec<Vector3> =
            masses.iter().map(|_| gaussian_vector(random) * standard_deviation).collect();
        if zero_momentum {
            stop(masses, &mut velocities);
        }
        if exact_temperature {
            let centre = mean(masses, &velocities);
            let moving = masses.iter().zip(&velocities);
            let twice_energy: f64 =
                moving.map(|(mass, velocity)| mass * (*velocity - centre).norm_squared()).sum();
            let deviation = (twice_energy / (3.0 * masses.iter().sum::<f64>())).sqrt();
            if deviation > 0.0 {
                let factor = standard_deviation / deviation;
                velocities.iter_mut().for_each(|velocity| *velocity = centre + (*velocity - centre) * factor);
            }
        }
        if zero_momentum {
            // What round-off has left.
            stop(masses, &mut velocities);
        }
        velocities
    }
}

/// Velocity of the centre of mass [m/s].
fn mean(masses: &[f64], velocities: &[Vector3]) -> Vector3 {
    let mut momentum = Vector3::zero();
    masses.iter().zip(velocities).for_each(|(mass, velocity)| momentum += *velocity * *mass);
    momentum * (1.0 / masses.iter().sum::<f64>())
}

/// Takes the velocity of the centre of mass away.
fn stop(masses: &[f64], velocities: &mut [Vector3]) {
    let mean = mean(masses, velocities);
    velocities.iter_mut().for_each(|velocity| *velocity -= mean);
}

#[cfg(test)]
mod tests {
    use super::super::random_stream;
    use super::*;

    const MASSES: [f64; 5] = [1.0, 2.0, 0.5, 8.0, 1e-3];

    /// Velocities of 500 particles of several masses, and these masses.
    fn gas(zero_momentum: bool, exact_temperature: bool) -> (Vec<f64>, Vec<Vector3>) {
        let masses: Vec<f64> = MASSES.iter().copied().cycle().take(500).collect();
        let plan = GasVelocities { standard_deviation: 0.3, zero_momentum, exact_temperature };
        let velocities = plan.draw(&masses, &mut random_stream(7));
        (masses, velocities)
    }

    fn temperature(masses: &[f64], velocities: &[Vector3]) -> f64 {
        let centre = mean(masses, velocities);
        let moving = masses.iter().zip(velocities);
        let twice: f64 = moving.map(|(mass, velocity)| mass * (*velocity - centre).norm_squared()).sum();
        twice / (3.0 * masses.iter().sum::<f64>())
    }

    #[test]
    fn a_gas_without_momentum_has_none_and_exactly_the_temperature_asked_for() {
        for exact in [false, true] {
            let (masses, velocities) = gas(true, exact);
            // Round-off of 500 terms of 0.3 m/s.
            assert!(mean(&masses, &velocities).norm() < 1e-16, "{:?}", mean(&masses, &velocities));
            let ratio = temperature(&masses, &velocities) / 0.09;
            assert_eq!((ratio - 1.0).abs() < 1e-13, exact, "{ratio}");
            assert!((ratio - 1.0).abs() < 0.2, "four standard errors of 500 particles of unlike mass");
        }
    }

    #[test]
    fn without_either_the_velocities_are_those_of_the_stream() {
        let (masses, velocities) = gas(false, false);
        let mut random = random_stream(7);
        assert!(velocities.iter().all(|velocity| *velocity == gaussian_vector(&mut random) * 0.3));
        assert!(mean(&masses, &velocities).norm() > 1e-3);
        let (_, exact) = gas(false, true);
        let moved = mean(&masses, &exact) - mean(&masses, &velocities);
        assert!(moved.norm() < 1e-15, "the centre of mass goes on as it did");
        assert!((temperature(&masses, &exact) / 0.09 - 1.0).abs() < 1e-13);
    }

    #[test]
    fn a_single_particle_rests_where_there_is_no_momentum() {
        let plan = GasVelocities { standard_deviation: 1.0, zero_momentum: true, exact_temperature: true };
        assert_eq!(plan.draw(&[2.0], &mut random_stream(1)), [Vector3::zero()]);
        assert!(plan.draw(&[], &mut random_stream(1)).is_empty());
    }
}
