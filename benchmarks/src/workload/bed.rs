//! The settled bed on its floor.

use std::path::Path;

use pulvis_contact::ContactModel;
use pulvis_core::walls::Wall;
use pulvis_core::{Background, Domain, Particle, Setup};
use pulvis_math::{Vector3, elementary};

use super::{of_one_material, table};
use crate::failure::Failure;

/// Dashpot coefficient over the reduced mass [1/s].
pub(crate) const DAMPING_RATE: f64 = 4000.0;
/// Tilt of the chute [rad].
pub(crate) const CHUTE_ANGLE: f64 = 26.0 * std::f64::consts::PI / 180.0;
/// Period of the bed along x and y [m]; larger beds are whole numbers of it.
const PERIOD: f64 = 28e-3;
/// Gravity [m/s²].
const GRAVITY: f64 = 9.81;

/// The bed of a table, with gravity tilted by `angle` [rad] towards x.
pub(crate) fn setup(path: &Path, model: ContactModel, angle: f64) -> Result<Setup, Failure> {
    let particles = table::read(path)?;
    let upper = Vector3::new(period(&particles, 0), period(&particles, 1), 0.0);
    let floor = Wall::fixed("floor", 0, Vector3::zero(), Vector3::new(0.0, 0.0, 1.0));
    let gravity = Vector3::new(GRAVITY * elementary::sin(angle), 0.0, -GRAVITY * elementary::cos(angle));
    Ok(Setup {
        walls: vec![floor],
        domain: Domain::periodic(Vector3::zero(), upper, [true, true, false]),
        background: Background { gravity, ..Background::default() },
        ..of_one_material(particles, model)
    })
}

/// The period along an axis [m]: positions may lie outside of it by what moved since they were
/// wrapped, which is far less than half of the bed's own period.
fn period(particles: &[Particle], axis: usize) -> f64 {
    let along = || particles.iter().map(|particle| particle.position[axis]);
    let extent = along().fold(f64::MIN, f64::max) - along().fold(f64::MAX, f64::min);
    (extent / PERIOD).round().max(1.0) * PERIOD
}

#[cfg(test)]
mod tests {
    use super::super::sphere;
    use super::*;

    #[test]
    fn tiled_beds_have_whole_numbers_of_the_bed_as_periods() {
        let at = |x: f64, y: f64| sphere(Vector3::new(x, y, 0.0), 5e-4, Vector3::zero());
        let bed = [at(-1e-4, 1e-3), at(27.9e-3, 110.9e-3)];
        assert_eq!(period(&bed, 0), PERIOD);
        assert_eq!(period(&bed, 1), 4.0 * PERIOD);
    }
}
