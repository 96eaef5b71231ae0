//! Every law of the catalogue in a bed with friction: the ledger closes, and closes better with shorter steps.
//!
//! A small bed runs with the tests. `cargo test --release -p pulvis-core --test beds -- --ignored` runs 1000 grains
//! over 10 000 steps for every law.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stdout)]

mod common;

use common::*;
use pulvis_boundary::Cuboid;
use pulvis_contact::catalogue::{LawEntry, Role};
use pulvis_contact::friction;
use pulvis_contact::{ContactLaws, ContactModel, Linear, NonContact, Normal, Pair, Viscosity};
use pulvis_core::{Domain, NamedColumn, Setup, Simulation};
use pulvis_math::Vector3;
use pulvis_packing::{gaussian_vector, random_positions, random_stream};
use pulvis_testkit::parameters::example;

/// Part of its radius that a grain moves in the shortest contact: overlaps of about a hundredth, by any law.
const MOTION: f64 = 0.025;

/// Steps in the shortest contact that a scenario takes unless told otherwise.
const AUTOMATIC: f64 = 50.0;

/// The steps of a bed, and how many grains it has.
#[derive(Clone, Copy)]
struct Size {
    grains: usize,
    steps: usize,
}

/// What the examples of all laws make, each by its name: normal laws with sliding friction, other laws beside a
/// plain normal law.
fn models() -> Vec<(String, ContactModel)> {
    let roles = Role::ALL.into_iter().flat_map(|role| {
        let entries: Vec<&LawEntry> = match role {
            Role::Normal => Normal::ENTRIES.iter().collect(),
            Role::NonContact => NonContact::ENTRIES.iter().collect(),
            Role::Viscosity => Viscosity::ENTRIES.iter().collect(),
            Role::Sliding | Role::Rolling | Role::Torsion => friction::entries(role),
            Role::Bond | Role::Conventions | Role::Expected => Vec::new(),
        };
        entries
    });
    // Charges act farther than a small box is wide; they have a bed of their own in `surroundings.rs`.
    let fit = roles.filter(|entry| !["none", "coulomb"].contains(&entry.name));
    fit.map(|entry| (label(entry), model(entry))).collect()
}

fn label(entry: &LawEntry) -> String {
    format!("{} {}", entry.role.key(), entry.name)
}

fn model(entry: &LawEntry) -> ContactModel {
    let (name, values) = example(entry);
    let hertz = || Normal::build("hertz", &example(named("hertz")).1).unwrap().unwrap();
    let mut laws = ContactLaws::default();
    let mut normal: Normal = Linear::new(100.0, 0.0).into();
    match entry.role {
        Role::Normal => normal = Normal::build(&name, &values).unwrap().unwrap(),
        Role::NonContact => laws.noncontact = NonContact::build(&name, &values).unwrap().unwrap(),
        Role::Viscosity => {
            normal = hertz();
            laws.viscosity = Viscosity::build(&name, &values).unwrap().unwrap();
        }
        role => {
            normal = hertz();
            let law = friction::build(role, &name, &values).unwrap().unwrap();
            match role {
                Role::Sliding => laws.sliding = law,
                Role::Rolling => laws.rolling = law,
                _ => laws.torsion = law,
            }
        }
    }
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let pair = Pair::spheres(mass, mass, RADIUS, RADIUS);
    // The speed depends on the duration of contacts, which depends little on the speed.
    for _ in 0..3 {
        let duration =
            ContactModel { normal, laws }.shortest_contact_time((mass, RADIUS), Some((mass, RADIUS)));
        laws.expected.speed = 2.0 * MOTION * RADIUS / duration;
    }
    if laws.sliding.is_none() {
        laws.sliding = Some(slider(0.2 * normal.max_stiffness(&pair, &laws.expected), 0.0, 0.3));
    }
    ContactModel { normal, laws }
}

fn named(name: &str) -> &'static LawEntry {
    Normal::ENTRIES.iter().find(|entry| entry.name == name).unwrap()
}

/// Grains at a solid fraction of 0.3 in a periodic cube, which move and turn.
fn bed(grains: usize, model: ContactModel) -> Setup {
    let volume = grains as f64 * sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass / 2500.0;
    let edge = pulvis_math::elementary::powf(volume / 0.3, 1.0 / 3.0);
    let upper = vector(edge, edge, edge);
    let domain = Domain::periodic(Vector3::zero(), upper, [true; 3]);
    let speed = 0.5 * model.laws.expected.speed;
    let mut random = random_stream(5);
    let region = Cuboid { lower: Vector3::zero(), upper };
    let radii: Vec<f64> = (0..grains).map(|grain| RADIUS * (0.8 + 0.2 * (grain % 3) as f64)).collect();
    let places = random_positions(&vec![1.05 * RADIUS; grains], &region, &domain, &[], &mut random).unwrap();
    let particles = places.into_iter().zip(radii).map(|(place, radius)| {
        let mut grain = sphere(place, gaussian_vector(&mut random) * speed, radius.min(RADIUS));
        grain.angular_velocity = gaussian_vector(&mut random) * (speed / RADIUS);
        grain
    });
    Setup { domain, ..setup(particles.collect(), model) }
}

/// The largest relative errors of the ledger in a bed that takes so many steps, `times` as short as the automatic one.
fn error(model: ContactModel, Size { grains, steps }: Size, times: u16) -> f64 {
    let mut setup = bed(grains, model);
    setup.time_step = contact_time(&setup) / (AUTOMATIC * f64::from(times));
    let values = vec![0.01 * RADIUS; grains];
    let shells = NamedColumn { name: "shell_thickness".to_owned(), unit: "m".to_owned(), values };
    let mut simulation = Simulation::with_columns(setup, vec![shells]).unwrap();
    let error = advance_watching(&mut simulation, steps * usize::from(times), 50);
    assert!(simulation.ledger().dissipated_sliding > 0.0, "nothing has met");
    error
}

/// Below, errors are round-off.
const ROUND_OFF: f64 = 1e-12;

/// The ledger closes to a thousandth at the automatic step, and much better at a fourth of it: by the fourth part where
/// forces jump, by a sixteenth where they do not, and half of that for the chance of different collisions.
fn ledgers_close(size: Size) {
    let mut wrong = Vec::new();
    for (label, model) in models() {
        let [coarse, fine] = [1, 4].map(|times| error(model, size, times));
        println!("{label:28} {coarse:.1e} {fine:.1e}");
        if !(coarse < 1e-3 && (fine < 0.5 * coarse || fine < ROUND_OFF)) {
            wrong.push(format!("{label}: {coarse:.1e}, with a fourth of the step {fine:.1e}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_ledger_closes_for_every_law_in_a_small_bed() {
    ledgers_close(Size { grains: 64, steps: 600 });
}

#[test]
#[ignore = "takes minutes; `cargo xtask slow` runs it"]
fn the_ledger_closes_for_every_law_in_a_bed() {
    ledgers_close(Size { grains: 1000, steps: 10_000 });
}
