//! The engine against one that knows no lists, chunks, skins and vectors: random systems, compared after a thousand
//! steps.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{slider, vector};
use pulvis_contact::noncontact::{JumpIn, Reversible};
use pulvis_contact::normal::{Hertz, Interpolation, Jkr};
use pulvis_contact::viscosity::{Constant, Tsuji};
use pulvis_contact::{ContactModel, Linear, Luding, Mindlin, NonContact, Viscosity};
use pulvis_core::walls::{Velocity, Wall, WallMotion};
use pulvis_core::{
    Background, ContactPartner, Domain, Interactions, Particle, Setup, Simulation, shortest_contact,
};
use pulvis_math::{Vector3, elementary};
use pulvis_testkit::Draw;
use pulvis_testkit::reference::{Body, Models, Plane, ReferenceEngine, Second};

const STEPS: u64 = 1000;
const EDGE: f64 = 8e-3;
const DENSITY: f64 = 2000.0;

/// Bodies whose radii are 1:10, most of them beside another one with a small gap or overlap, thrown at each other.
fn particles(count: usize, materials: u16, draw: &mut Draw) -> Vec<Particle> {
    let mut placed: Vec<Particle> = Vec::new();
    while placed.len() < count {
        let radius = draw.log_between(1.2e-4, 1.2e-3);
        let mut position = vector(
            draw.between(radius, EDGE - radius),
            draw.between(radius, EDGE - radius),
            draw.between(radius, EDGE - radius),
        );
        if !placed.is_empty() && draw.chance(0.9) {
            let neighbour = *draw.one_of(&placed);
            let distance = (radius + neighbour.radius) * draw.between(0.992, 1.003);
            position = neighbour.position + draw.direction() * distance;
        }
        let inside = |x: f64| (0.999 * radius..EDGE - 0.999 * radius).contains(&x);
        if !position.to_array().into_iter().all(inside) {
            continue;
        }
        let fits = |other: &Particle| {
            let mut between = position - other.position;
            // Free of overlaps also across the borders.
            for axis in [&mut between.x, &mut between.y, &mut between.z] {
                *axis -= EDGE * (*axis / EDGE).round();
            }
            between.norm() > 0.99 * (radius + other.radius)
        };
        if !placed.iter().all(fits) {
            continue;
        }
        let mass = 4.0 / 3.0 * std::f64::consts::PI * DENSITY * elementary::powi(radius, 3);
        // Towards the middle, so that all meet.
        let centre = vector(0.5 * EDGE, 0.5 * EDGE, 0.5 * EDGE);
        placed.push(Particle {
            material: (placed.len() % usize::from(materials)) as u16,
            radius,
            mass,
            position,
            velocity: (centre - position) * 60.0 + draw.vector() * 0.2,
            angular_velocity: draw.vector() * 100.0,
        });
    }
    placed
}

fn luding(kc: f64) -> ContactModel {
    let interpolation = Interpolation::Linear;
    let mut model =
        ContactModel::frictionless(Luding { k1: 100.0, kp: 500.0, kc, phi_f: 0.05, interpolation });
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 2e-4 });
    model.laws.sliding = Some(slider(80.0, 1e-4, 0.4));
    model.laws.rolling = Some(slider(20.0, 1e-5, 0.1));
    model.laws.torsion = Some(slider(20.0, 1e-5, 0.1));
    model
}

fn hertz() -> ContactModel {
    let mut model = ContactModel::frictionless(Hertz { effective_modulus: 1e6 });
    model.laws.viscosity = Viscosity::Tsuji(Tsuji::from_restitution(0.7));
    model.laws.sliding = Some(mindlin().into());
    model
}

fn mindlin() -> Mindlin {
    let rescale = pulvis_contact::friction::Rescale::Energy;
    Mindlin { effective_shear_modulus: 3e5, dashpot: 0.0, coefficient: 0.3, rescale }
}

fn jkr() -> ContactModel {
    let mut model = ContactModel::frictionless(Jkr::new(1e6, 1e-2));
    model.laws.sliding = Some(mindlin().into());
    model
}

fn tailed(attraction: NonContact) -> ContactModel {
    let mut model = ContactModel::frictionless(Linear::new(200.0, 1e-4));
    model.laws.noncontact = attraction;
    model.laws.sliding = Some(slider(60.0, 0.0, 0.2));
    model
}

/// The same model for every pair of materials that the walls or particles are of.
fn alike(model: ContactModel, materials: u16) -> Models {
    (0..materials).flat_map(|one| (one..materials).map(move |other| ((one, other), model))).collect()
}

fn interactions(models: &Models) -> Interactions {
    let mut interactions = Interactions::new(1);
    for (&(one, other), &model) in models {
        interactions.set(one, other, model);
    }
    interactions
}

fn walls() -> Vec<Wall> {
    let wall = |name: &str, point: Vector3, normal: Vector3| Wall::fixed(name, 0, point, normal);
    vec![
        wall("floor", Vector3::zero(), vector(0.0, 0.0, 1.0)),
        wall("lid", vector(0.0, 0.0, EDGE), vector(0.0, 0.0, -1.0)),
        wall("west", Vector3::zero(), vector(1.0, 0.0, 0.0)),
        wall("east", vector(EDGE, 0.0, 0.0), vector(-1.0, 0.0, 0.0)),
    ]
}

/// Both engines at the same state.
struct Twins {
    engine: Simulation,
    reference: ReferenceEngine,
    /// The reference, but begun one unit in the last place aside: what round-off grows to.
    aside: ReferenceEngine,
}

impl Twins {
    fn new(
        particles: Vec<Particle>,
        models: &Models,
        mut walls: Vec<Wall>,
        periodic: [bool; 3],
        threads: usize,
    ) -> Self {
        let gravity = vector(0.0, 0.0, -9.81);
        if let Some(lid) = walls.get_mut(1) {
            lid.motion = WallMotion::Velocity(Velocity { velocity: vector(0.02, 0.0, -0.05) });
        }
        let interactions = interactions(models);
        let time_step = shortest_contact(&particles, &interactions, &walls).unwrap().duration / 40.0;
        let body = |(id, p): (usize, &Particle)| Body {
            id: id as u32,
            material: p.material,
            radius: p.radius,
            mass: p.mass,
            position: p.position,
            velocity: p.velocity,
            angular_velocity: p.angular_velocity,
        };
        let bodies: Vec<Body> = particles.iter().enumerate().map(body).collect();
        let plane = |wall: &Wall| {
            let velocity = match &wall.motion {
                WallMotion::Velocity(motion) => motion.velocity,
                _ => Vector3::zero(),
            };
            Plane {
                material: wall.material,
                point: wall.point,
                normal: wall.plane_normal().unwrap(),
                velocity,
            }
        };
        let planes: Vec<Plane> = walls.iter().map(plane).collect();
        let periods = periodic.map(|periodic| periodic.then_some(EDGE));
        let slow = |bodies| {
            ReferenceEngine::new(bodies, planes.clone(), periods, gravity, time_step, models.clone())
        };
        let mut moved = bodies.clone();
        for body in &mut moved {
            body.position.x = f64::from_bits(body.position.x.to_bits() + 1);
        }
        let domain = Domain::periodic(Vector3::zero(), vector(EDGE, EDGE, EDGE), periodic);
        let background = Background { gravity, ..Background::default() };
        let setup = Setup { particles, interactions, walls, domain, background, time_step };
        let mut engine = Simulation::new(setup).unwrap();
        engine.set_threads(threads).unwrap();
        Self { engine, reference: slow(bodies), aside: slow(moved) }
    }

    fn advance(&mut self, steps: u64) {
        self.engine.advance(steps).unwrap();
        for _ in 0..steps {
            self.reference.step();
            self.aside.step();
        }
    }

    /// Asserts that the engine is no farther from the reference than a thousand times what one unit in the last place
    /// has grown to, and than a part in 1e12 of the box and of the speeds there are.
    fn agree(&self, what: &str) {
        let particles = self.engine.particles();
        let rows = particles.rows_by_id();
        assert_eq!(rows.len(), self.reference.bodies.len(), "{what}");
        let (mut apart, mut grown) = ([0.0_f64; 3], [0.0_f64; 3]);
        let wrapped = |difference: Vector3| {
            let along = |axis: usize| match self.reference.periods[axis] {
                Some(period) => difference[axis] - period * (difference[axis] / period).round(),
                None => difference[axis],
            };
            vector(along(0), along(1), along(2)).norm()
        };
        for &row in &rows {
            let id = particles.ids()[row];
            let (one, other) = (self.reference.body(id).unwrap(), self.aside.body(id).unwrap());
            let differences = [
                wrapped(particles.positions()[row] - one.position),
                (particles.velocities()[row] - one.velocity).norm(),
                (particles.angular_velocities()[row] - one.angular_velocity).norm(),
            ];
            let aside = [
                wrapped(other.position - one.position),
                (other.velocity - one.velocity).norm(),
                (other.angular_velocity - one.angular_velocity).norm(),
            ];
            for quantity in 0..3 {
                assert!(
                    differences[quantity].is_finite() && aside[quantity].is_finite(),
                    "{what}: particle {id}"
                );
                apart[quantity] = apart[quantity].max(differences[quantity]);
                grown[quantity] = grown[quantity].max(aside[quantity]);
            }
        }
        let scales = [EDGE, 1.0, 1e3];
        for quantity in 0..3 {
            let allowed = 1e3 * grown[quantity] + 1e-12 * scales[quantity];
            assert!(apart[quantity] <= allowed, "{what}: {apart:?} apart, one unit grew to {grown:?}");
            // A bound that has grown to the size of things would say nothing.
            assert!(
                allowed < 1e-4 * scales[quantity],
                "{what}: one unit in the last place grew to {grown:?}"
            );
        }
        self.engine.for_each_contact(&mut |contact| {
            let second = match contact.second {
                ContactPartner::Particle(id) => Second::Sphere(id),
                ContactPartner::Wall(wall) => Second::Wall(wall),
            };
            let Some(columns) = self.reference.columns((contact.first, second)) else { return };
            for (mine, theirs) in contact.memory.iter().zip(columns) {
                let size = columns.iter().fold(0.0_f64, |size, column| size.max(column.abs()));
                assert!((mine - theirs).abs() <= 1e-4 * size, "{what}: {:?} {columns:?}", contact.memory);
            }
        });
        let contacts = self.reference.contacts;
        assert!(contacts > 5000, "{what}: only {contacts} contacts in all steps");
    }
}

fn random_system(name: &str, model: ContactModel, periodic: [bool; 3], seed: u64) {
    let mut draw = Draw::new(seed);
    for (case, threads) in [1, 3].into_iter().enumerate() {
        let materials = 2;
        let bodies = particles(110, materials, &mut draw);
        let walls = if periodic[0] { walls().into_iter().take(2).collect() } else { walls() };
        let walls = if periodic[2] { Vec::new() } else { walls };
        let models = alike(model, materials);
        let mut twins = Twins::new(bodies, &models, walls, periodic, threads);
        twins.advance(STEPS);
        twins.agree(&format!("{name}, case {case}"));
    }
}

#[test]
fn hysteretic_grains_between_walls_move_as_without_lists() {
    random_system("luding between walls", luding(100.0), [false, true, false], 1);
}

#[test]
fn elastic_grains_in_a_periodic_box_move_as_without_lists() {
    random_system("hertz, periodic", hertz(), [true; 3], 2);
}

#[test]
fn adhesive_elastic_grains_move_as_without_lists() {
    random_system("jkr", jkr(), [true, true, false], 3);
}

#[test]
fn attraction_at_a_distance_reaches_as_far_as_without_lists() {
    let (f_a, kc_a) = (1e-3, 20.0);
    random_system("reversible", tailed(NonContact::Reversible(Reversible { f_a, kc_a })), [true; 3], 4);
    random_system("jump-in", tailed(NonContact::JumpIn(JumpIn { f_a, kc_a })), [true, true, false], 5);
}

#[test]
fn switches_of_laws_and_removal_leave_what_they_leave_without_lists() {
    let mut draw = Draw::new(6);
    for (case, models) in
        [[luding(100.0), luding(20.0)], [hertz(), jkr()], [jkr(), luding(50.0)]].into_iter().enumerate()
    {
        let [first, second] = models.map(|model| alike(model, 2));
        let bodies = particles(100, 2, &mut draw);
        let mut twins = Twins::new(bodies, &first, walls(), [false, true, false], 1 + case % 2);
        twins.advance(400);
        twins.agree(&format!("before the switch, case {case}"));
        twins.engine.set_interactions(interactions(&second)).unwrap();
        twins.reference.set_models(second.clone());
        twins.aside.set_models(second);
        twins.advance(300);
        let gone: Vec<u32> = (0..20).map(|index| 5 * index + case as u32).collect();
        twins.engine.remove(&gone).unwrap();
        twins.reference.remove(&gone);
        twins.aside.remove(&gone);
        twins.advance(300);
        twins.agree(&format!("after switch and removal, case {case}"));
    }
}
