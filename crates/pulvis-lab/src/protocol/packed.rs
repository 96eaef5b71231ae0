//! Trial packings: what memory and time a sample will take, before there is one.

use pulvis_core::{Domain, Interactions, Particle, Setup, Simulation};
use pulvis_math::{Vector3, elementary};

/// Cubic cells of a trial packing along each axis: not fewer, or a particle would meet its own image, and not
/// more, or the trial would take longer than what it tells is worth.
const CELLS: std::ops::RangeInclusive<usize> = 4..=20;

/// Sites of a face-centred cubic cell over its edge.
const SITES: [[f64; 3]; 4] = [[0.25, 0.25, 0.25], [0.75, 0.75, 0.25], [0.75, 0.25, 0.75], [0.25, 0.75, 0.75]];

/// How close the particles of a trial packing lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Density {
    /// Nobody has a neighbour.
    Loose,
    /// As in a bed that has come to rest or been pressed: six contacts a particle.
    Settled,
    /// The densest: each particle has twelve neighbours, which it touches.
    Dense,
}

impl Density {
    /// Distance of neighbouring sites in diameters.
    const fn distance(self) -> f64 {
        match self {
            Self::Loose => 2.0,
            // An overlap, so that contacts are computed; hardly any force.
            Self::Settled => 1.0 - 5e-5,
            Self::Dense => 1.0,
        }
    }

    /// Part of the sites that are taken. Each has twelve neighbours, so that six of them need a half.
    const fn occupancy(self) -> f64 {
        match self {
            Self::Loose | Self::Dense => 1.0,
            Self::Settled => 0.5,
        }
    }
}

/// A packing of up to `count` particles of the mean radius and mass of `sample`, their materials mixed as they
/// are there; `None` where the engine refuses it. No forces act but those of contacts.
pub(super) fn packing(
    sample: &[Particle],
    count: usize,
    interactions: &Interactions,
    density: Density,
    time_step: f64,
) -> Option<Simulation> {
    if sample.is_empty() {
        return None;
    }
    let mean = |value: fn(&Particle) -> f64| sample.iter().map(value).sum::<f64>() / sample.len() as f64;
    let (radius, mass) = (mean(|particle| particle.radius), mean(|particle| particle.mass));
    let sites = count as f64 / density.occupancy();
    let wanted = elementary::cbrt(sites / SITES.len() as f64).ceil() as usize;
    let cells = wanted.clamp(*CELLS.start(), *CELLS.end());
    let spacing = 8.0_f64.sqrt() * radius * density.distance();
    let mut packed = Vec::with_capacity(SITES.len() * cells.pow(3));
    for (number, position) in sites_of(cells, spacing).enumerate() {
        // An order of the golden ratio would leave gaps in a pattern; this one has none.
        if fraction_of(number) >= density.occupancy() {
            continue;
        }
        // By the golden ratio, neighbours are of all materials even where these are listed in turn.
        let pick = (packed.len() as f64 * 0.618_033_988_749_895).fract() * sample.len() as f64;
        packed.push(Particle {
            material: sample[(pick as usize).min(sample.len() - 1)].material,
            radius,
            mass,
            position,
            velocity: Vector3::zero(),
            angular_velocity: Vector3::zero(),
        });
    }
    let edge = cells as f64 * spacing;
    // Charges do not act over all distances in a periodic box.
    let mut interactions = interactions.clone();
    interactions.set_electrostatics(None);
    let setup = Setup {
        particles: packed,
        interactions,
        walls: Vec::new(),
        domain: Domain::periodic(Vector3::zero(), Vector3::new(edge, edge, edge), [true; 3]),
        background: Default::default(),
        time_step,
    };
    Simulation::new(setup).ok()
}

/// The sites of a face-centred cubic packing of so many cells along each axis.
fn sites_of(cells: usize, spacing: f64) -> impl Iterator<Item = Vector3> {
    (0..cells.pow(3)).flat_map(move |cell| {
        let corner = [cell % cells, cell / cells % cells, cell / (cells * cells)];
        SITES.into_iter().map(move |site| {
            let along = |axis: usize| (corner[axis] as f64 + site[axis]) * spacing;
            Vector3::new(along(0), along(1), along(2))
        })
    })
}

/// A number from 0 to 1 that looks random (the mixing function of SplitMix64).
fn fraction_of(number: usize) -> f64 {
    let mut mixed = (number as u64).wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
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
            let sample = particles(count.min(300));
            let packing = packing(&sample, count, &interactions(model), Density::Dense, 1.0).unwrap();
            assert_eq!(packing.candidates(), 6 * packing.particles().len());
            let second = packing.particles().materials().iter().filter(|&&material| material == 1).count();
            let half = packing.particles().len() as f64 / 2.0;
            assert!((second as f64 / half - 1.0).abs() < 0.02, "{second} of {}", 2.0 * half);
        }
    }

    #[test]
    fn contacts_that_remember_more_take_the_memory_of_what_they_remember() {
        let size = |model| {
            let packing =
                packing(&particles(300), 20_000, &interactions(model), Density::Dense, 1.0).unwrap();
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

    #[test]
    fn a_settled_packing_has_six_contacts_a_particle_and_a_loose_one_has_none() {
        let model = ContactModel::frictionless(Linear::new(100.0, 0.0));
        let trial = |density| packing(&particles(300), 10_000, &interactions(model), density, 1.0).unwrap();
        let settled = trial(Density::Settled);
        let mut touching = 0;
        settled.for_each_contact(&mut |contact| touching += usize::from(contact.overlap > 0.0));
        let contacts = 2.0 * touching as f64 / settled.particles().len() as f64;
        assert!((contacts - 6.0).abs() < 0.3, "{contacts}");
        assert!((settled.particles().len() as f64 / 10_000.0 - 1.0).abs() < 0.25);
        assert_eq!(trial(Density::Loose).candidates(), 0);
    }
}
