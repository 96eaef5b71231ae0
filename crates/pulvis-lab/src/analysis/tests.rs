//! Sums over the grid are those of the sample, and fields are what closed forms say.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_boundary::Domain;
use pulvis_math::Vector3;

use super::sample::{Grain, Link};
use super::*;

fn grain(position: [f64; 3], velocity: [f64; 3]) -> Grain {
    let mut grain = Grain {
        position: position.into(),
        velocity: velocity.into(),
        radius: 0.5,
        mass: 0.0,
        fabric: [1.0, 2.0, 3.0, 0.1, 0.2, 0.3],
    };
    grain.mass = 2.0 * grain.volume();
    grain
}

/// Grains and contacts at odd places, one of them at a wall.
fn sample(domain: Domain) -> Sample {
    let place = |number: usize| {
        let turn = |step: f64| 5.0 * ((number as f64 * step) % 1.0);
        [turn(0.618_034), turn(0.414_214), turn(0.732_051)]
    };
    let particles: Vec<Grain> =
        (0..40).map(|number| grain(place(number), place(number + 40).map(|x| x - 2.5))).collect();
    let contacts = (0..40)
        .map(|number| {
            let first = particles[number].position;
            let branch = Vector3::from(place(number + 80).map(|x| 0.3 * x - 0.7));
            let force = Vector3::from(place(number + 120).map(|x| x - 2.0));
            Link { ends: [first, first - branch], force, at_wall: number % 4 == 0 }
        })
        .collect();
    Sample { time: 0.0, domain, particles, contacts }
}

fn all_fields(sample: &Sample, kernel: Kernel, width: f64, cell: f64) -> Fields {
    let mut extent = Extent::default();
    extent.add(sample);
    let grid = extent.grid(kernel.reach(width), cell, sample.domain).unwrap();
    Fields::new(sample, grid, kernel, width)
}

fn sum<const N: usize>(values: &[[f64; N]], volume: f64) -> [f64; N] {
    let mut sum = [0.0; N];
    values.iter().for_each(|value| sum.iter_mut().zip(value).for_each(|(sum, value)| *sum += value * volume));
    sum
}

fn close(found: &[f64], expected: &[f64]) {
    let size = expected.iter().fold(1.0_f64, |size, value| size.max(value.abs()));
    // Forty times some hundred shares are added up: round-off of 1e-13 of the largest part.
    let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() <= 1e-12 * size);
    assert!(near, "{found:?} {expected:?}");
}

#[test]
fn mass_momentum_virial_wall_forces_and_fabric_are_those_of_the_sample_whatever_the_kernel() {
    let corner = |at: f64| Vector3::new(at, at, at);
    let tilted = Domain { tilts: [1.3, -0.4, 0.9], ..Domain::periodic(corner(0.0), corner(5.0), [true; 3]) };
    let slab = Domain::periodic(corner(0.0), corner(5.0), [true, false, true]);
    for domain in [Domain::unbounded(), slab, tilted] {
        let sample = sample(domain);
        for (kernel, width, cell) in
            [(Kernel::Lucy, 1.1, 0.37), (Kernel::Gaussian, 0.5, 0.4), (Kernel::Lucy, 0.1, 0.9)]
        {
            let fields = all_fields(&sample, kernel, width, cell);
            let volume = fields.grid.volume();
            let mass: f64 = fields.density.iter().sum::<f64>() * volume;
            close(&[mass], &[sample.total_mass()]);
            let momentum =
                sample.particles.iter().fold(Vector3::zero(), |sum, grain| sum + grain.velocity * grain.mass);
            close(&sum(&fields.momentum, volume), &momentum.to_array());
            close(&sum(&fields.contact_stress, volume), &sample.total_virial());
            let at_walls = sample.contacts.iter().filter(|link| link.at_wall);
            let force = at_walls.fold(Vector3::zero(), |sum, link| sum + link.force);
            close(&sum(&fields.wall_force, volume), &force.to_array());
            let solid: f64 = sample.particles.iter().map(Grain::volume).sum();
            close(&[fields.solid_fraction.iter().sum::<f64>() * volume], &[solid]);
            close(
                &sum(&fields.fabric, volume),
                &[1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 3.0].map(|x| x * solid),
            );
            // Kinetic energy: of the flow and of the motion against it.
            let flow: f64 = (0..fields.grid.len())
                .filter(|&cell| fields.density[cell] > 0.0)
                .map(|cell| {
                    fields.density[cell] * Vector3::from(fields.velocity(cell)).norm_squared() * volume
                })
                .sum();
            let rest = sum(&fields.kinetic_stress, volume);
            let energy: f64 =
                sample.particles.iter().map(|grain| grain.mass * grain.velocity.norm_squared()).sum();
            close(&[flow + rest[0] + rest[4] + rest[8]], &[energy]);
        }
    }
}

#[test]
fn profiles_have_the_sums_of_the_grid() {
    let fields = all_fields(&sample(Domain::unbounded()), Kernel::Lucy, 1.0, 0.5);
    for axis in 0..3 {
        let profile = fields.profile(axis);
        assert_eq!(profile.grid.len(), fields.grid.counts[axis]);
        let total = |fields: &Fields| fields.density.iter().sum::<f64>() * fields.grid.volume();
        close(&[total(&profile)], &[total(&fields)]);
        close(
            &sum(&profile.contact_stress, profile.grid.volume()),
            &sum(&fields.contact_stress, fields.grid.volume()),
        );
    }
}

#[test]
fn a_particle_has_the_density_of_the_kernel_and_a_lattice_a_uniform_one() {
    let alone = Sample {
        time: 0.0,
        domain: Domain::unbounded(),
        particles: vec![grain([0.0; 3], [0.0; 3])],
        contacts: Vec::new(),
    };
    for (kernel, width) in [(Kernel::Lucy, 1.0), (Kernel::Gaussian, 0.4)] {
        let fields = all_fields(&alone, kernel, width, 0.1);
        for cell in 0..fields.grid.len() {
            let distance = Vector3::from(fields.grid.middle(cell)).norm();
            let expected = alone.particles[0].mass * kernel.shape(distance, width) / kernel.integral(width);
            // The sum over cells of a tenth of the width is the integral up to less than a thousandth of the peak.
            let peak = alone.particles[0].mass / kernel.integral(width);
            assert!(
                (fields.density[cell] - expected).abs() < 2e-3 * peak,
                "{distance}: {}",
                fields.density[cell]
            );
        }
    }
    // A cubic lattice of constant 1 and a Gaussian wider than it: the first Fourier component is exp(-2 pi^2 w^2) = 3e-9.
    let sites = (0..125).map(|site| [site % 5, site / 5 % 5, site / 25].map(|x| f64::from(x) + 0.5));
    let domain = Domain::periodic(Vector3::zero(), Vector3::new(5.0, 5.0, 5.0), [true; 3]);
    let particles = sites.map(|site| grain(site, [1.0, 0.0, 0.0])).collect();
    let lattice = Sample { time: 0.0, domain, particles, contacts: Vec::new() };
    let fields = all_fields(&lattice, Kernel::Gaussian, 1.0, 0.25);
    let mass = lattice.particles[0].mass;
    // The cut at three widths leaves a step of exp(-4.5), 1 % of the peak, there.
    let uniform = fields.density.iter().all(|density| (density / mass - 1.0).abs() < 1e-2);
    assert!(uniform && fields.density.len() == 8000);
    assert!(fields.kinetic_stress.iter().flatten().all(|stress| stress.abs() < 1e-12));
}
