//! How many particle-steps a second the contact loop does: a compressed cubic lattice of 8000 spheres,
//! jittered, in a periodic box, with the Luding law and friction.
//!
//! `cargo run --release -p pulvis-core --example throughput [law] [steps]`, where the law is `full`
//! (sliding, rolling, torsion), `sliding`, `luding` (frictionless) or `linear`.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::time::Instant;

use pulvis_contact::normal::Interpolation;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Friction, Linear, Luding, SpringSlider};
use pulvis_core::{Background, Domain, Interactions, Particle, Setup, Simulation, shortest_contact};
use pulvis_math::{Vector3, elementary};
use pulvis_packing::{Lattice, gaussian_vector, random_stream};

const SIDE: usize = 20;
const RADIUS: f64 = 0.5e-3;

fn slider(stiffness: f64, coefficient: f64) -> Friction {
    let (dynamic_coefficient, static_coefficient) = (coefficient, coefficient);
    SpringSlider { stiffness, dashpot: 4e-4, dynamic_coefficient, static_coefficient }.into()
}

fn model(law: &str) -> ContactModel {
    if law == "linear" {
        return ContactModel::frictionless(Linear::new(500.0, 2e-3));
    }
    let interpolation = Interpolation::Linear;
    let mut model =
        ContactModel::frictionless(Luding { k1: 100.0, kp: 500.0, kc: 100.0, phi_f: 0.05, interpolation });
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 2e-3 });
    if law != "luding" {
        model.laws.sliding = Some(slider(100.0, 0.5));
    }
    if law == "full" {
        model.laws.rolling = Some(slider(50.0, 0.1));
        model.laws.torsion = Some(slider(50.0, 0.1));
    }
    model
}

fn setup(law: &str) -> Setup {
    // Neighbours on the axes overlap by two percent of the diameter, a little less or more by jitter.
    let spacing = 1.96 * RADIUS;
    let edge = SIDE as f64 * spacing;
    let mut random = random_stream(1);
    let lattice = Lattice { lower: Vector3::zero(), counts: [SIDE; 3], spacing, jitter: 0.01 };
    let mass = 4.0 / 3.0 * std::f64::consts::PI * 2500.0 * elementary::powi(RADIUS, 3);
    let particles: Vec<Particle> = lattice
        .positions(&mut random)
        .into_iter()
        .map(|position| Particle {
            material: 0,
            radius: RADIUS,
            mass,
            position,
            velocity: gaussian_vector(&mut random) * 0.05,
            angular_velocity: gaussian_vector(&mut random) * 100.0,
        })
        .collect();
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, model(law));
    let time_step =
        shortest_contact(&particles, &interactions, &[]).map_or(1e-6, |shortest| shortest.duration / 50.0);
    let domain = Domain::periodic(Vector3::zero(), Vector3::new(edge, edge, edge), [true; 3]);
    Setup { particles, interactions, walls: Vec::new(), domain, background: Background::default(), time_step }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let law = arguments.next().unwrap_or_else(|| "sliding".to_owned());
    let steps: u32 = arguments.next().map_or(Ok(1000), |given| given.parse())?;
    let mut simulation = Simulation::new(setup(&law))?;
    for _ in 0..steps / 10 {
        simulation.step()?;
    }
    let (mut acting, before) = (0, simulation.rebuilds());
    simulation.for_each_contact(&mut |_| acting += 1);
    let clock = Instant::now();
    for _ in 0..steps {
        simulation.step()?;
    }
    let seconds = clock.elapsed().as_secs_f64();
    let particle_steps = simulation.particles().len() as f64 * f64::from(steps);
    println!(
        "{law}: {:.3e} particle-steps/s, {:.3e} contact-steps/s; {} particles, {acting} contacts, {} candidates, {} rebuilds in {steps} steps",
        particle_steps / seconds,
        f64::from(acting) * f64::from(steps) / seconds,
        simulation.particles().len(),
        simulation.candidates(),
        simulation.rebuilds() - before,
    );
    println!("relative closing error {:.1e}", simulation.ledger().relative_error());
    Ok(())
}
