//! How many particle-steps a second the contact loop does, and how long observations take: a compressed cubic lattice of
//! 8000 spheres, or as many as asked for, jittered, in a periodic box, with the Luding law and friction.
//!
//! `cargo run --release -p pulvis-core --example throughput [law] [steps] [side] [threads]`, where the law is `full`
//! (sliding, rolling, torsion), `sliding`, `luding` (frictionless) or `linear`, and `side` the spheres along each axis.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::time::Instant;

use pulvis_contact::normal::Interpolation;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Friction, Linear, Luding, SpringSlider};
use pulvis_core::observation::ObservationPlan;
use pulvis_core::{Background, Domain, Interactions, Particle, Setup, Simulation, shortest_contact};
use pulvis_math::{Vector3, elementary};
use pulvis_packing::{Lattice, Structure, gaussian_vector, random_stream};

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

fn setup(law: &str, side: usize) -> Setup {
    // Neighbours on the axes overlap by two percent of the diameter, a little less or more by jitter.
    let spacing = 1.96 * RADIUS;
    let edge = side as f64 * spacing;
    let mut random = random_stream(1);
    let lattice = Lattice {
        lower: Vector3::zero(),
        counts: [side; 3],
        spacing,
        jitter: 0.01,
        structure: Structure::SimpleCubic,
    };
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
    let side = arguments.next().map_or(Ok(20), |given| given.parse())?;
    let threads = arguments.next().map_or(Ok(1), |given| given.parse())?;
    let mut simulation = Simulation::new(setup(&law, side))?;
    simulation.set_threads(threads)?;
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
    let step = seconds / f64::from(steps);
    let (whole, contacts_only) =
        (ObservationPlan::whole(), ObservationPlan { rattlers: false, ..ObservationPlan::whole() });
    let mut sum = 0.0;
    time("contacts one by one", step, || simulation.for_each_contact(&mut |seen| sum += seen.overlap));
    time("contacts gathered", step, || {
        simulation.gather_contacts(|sum: &mut f64, seen| *sum += seen.overlap);
    });
    time("observation without rattlers", step, || drop(simulation.observe(&contacts_only)));
    time("observation", step, || drop(simulation.observe(&whole)));
    Ok(())
}

/// Tells how long something takes: the median of several times.
fn time(what: &str, step: f64, mut work: impl FnMut()) {
    let mut times: Vec<f64> = (0..15)
        .map(|_| {
            let clock = Instant::now();
            work();
            clock.elapsed().as_secs_f64()
        })
        .collect();
    times.sort_by(f64::total_cmp);
    println!("{what}: {:.3} ms, {:.2} steps", 1e3 * times[7], times[7] / step);
}
