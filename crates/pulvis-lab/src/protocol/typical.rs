//! Two bodies that stand for all between two materials.

use pulvis_contact::{Pair, Partner};
use pulvis_core::Particle;
use pulvis_input::scenario::Scenario;
use pulvis_math::{elementary, min_or_nan};

/// Mass [kg] and radius [m] of a particle.
pub(super) type Body = (f64, f64);

/// A particle of the mean radius of its material, and what it meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TypicalBodies {
    /// The particle.
    pub(super) body: Body,
    /// A particle of the mean radius of the other material, or where no particle has it, its most hollow wall.
    pub(super) partner: Partner,
}

impl TypicalBodies {
    /// Those of two materials; `None` without particles of either.
    pub(super) fn of(scenario: &Scenario, particles: &[Particle], materials: [usize; 2]) -> Option<Self> {
        let wall = |material: usize, (_, radius): Body| {
            let curvatures = scenario.walls.iter().filter(|wall| wall.material == material);
            let least = curvatures.map(|wall| wall.shape.least_mean_curvature_for(radius)).reduce(min_or_nan);
            Partner::Wall { mean_curvature: least.unwrap_or(0.0) }
        };
        match materials.map(|material| mean_body(particles, material)) {
            [Some(body), Some((mass, radius))] => {
                Some(Self { body, partner: Partner::Sphere { mass, radius } })
            }
            [Some(body), None] => Some(Self { body, partner: wall(materials[1], body) }),
            [None, Some(body)] => Some(Self { body, partner: wall(materials[0], body) }),
            [None, None] => None,
        }
    }

    /// The constants of the pair.
    pub(super) fn pair(&self) -> Pair {
        self.partner.pair_with(self.body)
    }

    /// The second particle, if it is one.
    pub(super) fn second(&self) -> Option<Body> {
        match self.partner {
            Partner::Sphere { mass, radius } => Some((mass, radius)),
            Partner::Wall { .. } => None,
        }
    }

    /// Whether the particle meets a wall that is no plane.
    pub(super) fn is_curved(&self) -> bool {
        matches!(self.partner, Partner::Wall { mean_curvature } if mean_curvature != 0.0)
    }
}

/// A particle of the mean radius of a material.
fn mean_body(particles: &[Particle], material: usize) -> Option<Body> {
    let of_material = || particles.iter().filter(|particle| usize::from(particle.material) == material);
    let count = of_material().count();
    let first = of_material().next()?;
    let radius = of_material().map(|particle| particle.radius).sum::<f64>() / count as f64;
    Some((first.mass * elementary::powi(radius / first.radius, 3), radius))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_math::Vector3;

    use super::*;

    #[test]
    fn a_particle_meets_the_most_hollow_wall_of_a_material() {
        let text = include_str!("../../../pulvis-input/tests/good/drum.toml");
        let drum = Scenario::from_str("drum.toml", text).unwrap();
        let particle = |radius: f64| Particle {
            material: 0,
            radius,
            mass: 1e-6,
            position: Vector3::zero(),
            velocity: Vector3::zero(),
            angular_velocity: Vector3::zero(),
        };
        let particles = [particle(0.4e-3), particle(0.6e-3)];
        let bodies = TypicalBodies::of(&drum, &particles, [0, 1]).unwrap();
        // A drum of 2 cm, hollow in one direction, beside a roller and a plane.
        let expected = 0.5 * (1.0 / 0.5e-3 - 0.5 / 2e-2);
        assert!((bodies.pair().inverse_harmonic_radius() / expected - 1.0).abs() < 1e-12, "{bodies:?}");
        assert!(bodies.is_curved() && bodies.second().is_none());
        // The other way round it is the same.
        assert_eq!(TypicalBodies::of(&drum, &particles, [1, 0]), Some(bodies));
        let alike = TypicalBodies::of(&drum, &particles, [0, 0]).unwrap();
        assert!(!alike.is_curved() && alike.second().is_some());
        assert_eq!(TypicalBodies::of(&drum, &[], [0, 1]), None);
    }
}
