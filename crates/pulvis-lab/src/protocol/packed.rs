//! The memory that a dense packing takes, before there is one.

use pulvis_core::{Domain, Interactions, Particle, Setup, Simulation};
use pulvis_math::{Vector3, elementary};

use super::setup::StagePlan;

/// Cubic cells of the trial packing along each axis: not fewer, or a particle would meet its own image,
/// and not more, or the trial would take longer than what it tells is worth.
const CELLS: std::ops::RangeInclusive<usize> = 4..=12;

/// Sites of a face-centred cubic cell over its edge.
const SITES: [[f64; 3]; 4] = [[0.25, 0.25, 0.25], [0.75, 0.75, 0.25], [0.75, 0.25, 0.75], [0.25, 0.75, 0.75]];

/// Memory [byte] that `particles` would take in a dense packing, each with twelve neighbours, in the stage
/// whose contacts remember most; `None` where no stage can be tried.
///
/// It is measured on a face-centred cubic packing of particles of the mean radius, so that it is that of
/// the engine's own data.
pub(super) fn packed_memory(particles: &[Particle], stages: &[StagePlan]) -> Option<usize> {
    let mut tried: Vec<&Interactions> = Vec::new();
    for stage in stages {
        if !tried.contains(&&stage.interactions) {
            tried.push(&stage.interactions);
        }
    }
    let packings = tried.into_iter().filter_map(|interactions| packing(particles, interactions));
    let of_a_particle = |packing: Simulation| packing.memory_size() as f64 / packing.particles().len() as f64;
    let most = packings.map(of_a_particle).max_by(f64::total_cmp)?;
    Some((most * particles.len() as f64).round() as usize)
}

/// A packing of touching particles of the mean radius, their materials mixed as they are among
/// `particles`.
fn packing(particles: &[Particle], interactions: &Interactions) -> Option<Simulation> {
    let count = particles.len();
    if count == 0 {
        return None;
    }
    let mean = |value: fn(&Particle) -> f64| particles.iter().map(value).sum::<f64>() / count as f64;
    let (radius, mass) = (mean(|particle| particle.radius), mean(|particle| particle.mass));
    let wanted = elementary::cbrt(count as f64 / SITES.len() as f64).ceil() as usize;
    let cells = wanted.clamp(*CELLS.start(), *CELLS.end());
    let spacing = 8.0_f64.sqrt() * radius;
    let mut packed = Vec::with_capacity(SITES.len() * cells.pow(3));
    for cell in 0..cells.pow(3) {
        let corner = [cell % cells, cell / cells % cells, cell / (cells * cells)];
        for site in SITES {
            let along = |axis: usize| (corner[axis] as f64 + site[axis]) * spacing;
            // By the golden ratio, neighbours are of all materials even where these are listed in turn.
            let pick = (packed.len() as f64 * 0.618_033_988_749_895).fract() * count as f64;
            packed.push(Particle {
                material: particles[(pick as usize).min(count - 1)].material,
                radius,
                mass,
                position: Vector3::new(along(0), along(1), along(2)),
                velocity: Vector3::zero(),
                angular_velocity: Vector3::zero(),
            });
        }
    }
    let edge = cells as f64 * spacing;
    let setup = Setup {
        particles: packed,
        interactions: interactions.clone(),
        walls: Vec::new(),
        domain: Domain::periodic(Vector3::zero(), Vector3::new(edge, edge, edge), [true; 3]),
        background: Default::default(),
        // No step is made.
        time_step: 1.0,
    };
    Simulation::new(setup).ok()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use pulvis_contact::{ContactModel, Linear, SpringSlider};

    use super::*;

    fn particles(count: usize) -> Vec<Particle> {
        let radius = |place: usize| if place.is_multiple_of(2) { 1e-3 } else { 2e-3 };
        let particle = |place: usize| Particle {
            material: u16::from(place >= count / 2),
            radius: radius(place),
            mass: 1e-6,
            position: Vector3::zero(),
            velocity: Vector3::zero(),
            angular_velocity: Vector3::zero(),
        };
        (0..count).map(particle).collect()
    }

    fn interactions(model: ContactModel) -> Interactions {
        let mut interactions = Interactions::new(2);
        for (one, other) in [(0, 0), (0, 1), (1, 1)] {
            interactions.set(one, other, model);
        }
        interactions
    }

    #[test]
    fn every_particle_of_the_packing_has_twelve_neighbours_and_both_materials_are_there() {
        let model = ContactModel::frictionless(Linear::new(100.0, 0.0));
        for count in [2, 300, 100_000] {
            let packing = packing(&particles(count), &interactions(model)).unwrap();
            assert_eq!(packing.candidates(), 6 * packing.particles().len());
            let second = packing.particles().materials().iter().filter(|&&material| material == 1).count();
            let half = packing.particles().len() as f64 / 2.0;
            assert!((second as f64 / half - 1.0).abs() < 0.02, "{second} of {}", 2.0 * half);
        }
    }

    #[test]
    fn contacts_that_remember_more_take_the_memory_of_what_they_remember() {
        let size = |model| {
            let packing = packing(&particles(20_000), &interactions(model)).unwrap();
            packing.memory_size() as f64 / packing.particles().len() as f64
        };
        let plain = ContactModel::frictionless(Linear::new(100.0, 0.0));
        let mut sliding = plain;
        sliding.laws.sliding = Some(
            SpringSlider { stiffness: 10.0, dashpot: 0.0, dynamic_coefficient: 0.5, static_coefficient: 0.5 }
                .into(),
        );
        // Six contacts a particle, three numbers of eight bytes each; blocks of eight are not all full.
        let more = size(sliding) - size(plain);
        assert!((144.0..160.0).contains(&more), "{more}");
    }
}
