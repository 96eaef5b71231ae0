//! Cylinders as walls: rolling, rotation, torque, work, lists of candidates.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_contact::viscosity::{Constant, Viscosity};
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::walls::{Cylinder, CylinderSide, Rotation, Velocity, Wall, WallMotion};
use pulvis_core::{ContactPartner, Domain, Setup, SetupError, Simulation};
use pulvis_math::Vector3;
use pulvis_packing::{gaussian_vector, random_stream};

const STIFFNESS: f64 = 1000.0;
const GRAVITY: f64 = 9.81;
/// Axes of drums: horizontal, gravity is along −z.
const AXIS: Vector3 = Vector3 { x: 0.0, y: 1.0, z: 0.0 };

fn cylinder(name: &str, radius: f64, side: CylinderSide) -> Wall {
    Wall::of_shape(name, 0, Vector3::zero(), Cylinder { axis: AXIS, radius, side })
}

fn rotating(angular_velocity: f64, wall: Wall) -> Wall {
    Wall { motion: WallMotion::Rotation(Rotation { angular_velocity }), ..wall }
}

/// Springs that do not slip, with a tangential dashpot [kg/s].
fn sticking(dashpot: f64) -> ContactModel {
    let mut model = ContactModel::frictionless(Linear::new(STIFFNESS, 0.0));
    model.laws.sliding = Some(slider(300.0, dashpot, 10.0));
    model
}

/// A point at `angle` from the lowest one, at a distance from the axis.
fn at_angle(angle: f64, from_axis: f64) -> Vector3 {
    vector(from_axis * angle.sin(), 0.0, -from_axis * angle.cos())
}

#[test]
fn a_sphere_that_rolls_in_a_trough_swings_with_five_sevenths_of_g() {
    let trough = 10.0 * RADIUS;
    let start_angle = 0.05;
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let overlap = mass * GRAVITY / STIFFNESS;
    let from_axis = trough - RADIUS + overlap;
    let released = sphere(at_angle(start_angle, from_axis), Vector3::zero(), RADIUS);
    let walls = vec![cylinder("trough", trough, CylinderSide::Inside)];
    let setup = Setup { walls, background: gravity(GRAVITY), ..setup(vec![released], sticking(2e-3)) };
    let mut simulation = start(setup, 40.0);
    let mut crossings = Vec::new();
    let mut before = states(&simulation)[0].position.x;
    while crossings.len() < 3 {
        simulation.step().unwrap();
        let now = states(&simulation)[0].position.x;
        if (now < 0.0) != (before < 0.0) {
            crossings.push(simulation.time() - simulation.time_step() * now / (now - before));
        }
        before = now;
        assert!(simulation.time() < 1.0, "it does not swing");
    }
    let period = crossings[2] - crossings[0];
    // The contact point is a − δ/2 from the centre, which circles about the axis at Rc − a + δ. A pendulum's period
    // grows with the amplitude by θ²/16.
    let lever = RADIUS / (RADIUS - 0.5 * overlap);
    let square = GRAVITY / (from_axis * (1.0 + 0.4 * lever * lever));
    let expected = std::f64::consts::TAU / square.sqrt() * (1.0 + start_angle * start_angle / 16.0);
    // The spring gives way by ω²m/k_t = 7e-6 of the way; the dashpot damps that and nothing else.
    assert!((period / expected - 1.0).abs() < 3e-5, "{period} {expected}");
    let ledger = simulation.ledger();
    assert!(ledger.relative_error().abs() < 1e-6, "{ledger:?}");
    assert_eq!(ledger.work_walls, 0.0);
}

#[test]
fn a_frictionless_bead_falls_through_a_quarter_of_a_circle() {
    let bowl = 6.0 * RADIUS;
    let from_axis = bowl - RADIUS;
    let bead = sphere(vector(from_axis, 0.0, 0.0), Vector3::zero(), RADIUS);
    let weight = bead.mass * GRAVITY;
    let walls = vec![cylinder("bowl", bowl, CylinderSide::Inside)];
    let setup = Setup { walls, background: gravity(GRAVITY), ..setup(vec![bead], elastic()) };
    let mut simulation = start(setup, 50.0);
    while states(&simulation)[0].position.x > 0.0 {
        simulation.step().unwrap();
        assert!(simulation.time() < 1.0, "it does not fall");
    }
    let state = states(&simulation)[0];
    // Energy: v² = 2 g r. Force at the lowest point: m g + m v²/r.
    let overlap = from_axis.mul_add(-1.0, -state.position.z);
    let drop = -state.position.z;
    let speed = state.velocity.norm();
    // The spring holds (3mg)²/2k of mgr: 1.5 δ/r = 1e-5.
    assert!((speed * speed / (2.0 * GRAVITY * drop) - 1.0).abs() < 3e-5, "{speed}");
    let force = -simulation.wall_force(0).z;
    // What swings across the path has an amplitude of about the static overlap times t_c/T.
    assert!((force / (3.0 * weight) - 1.0).abs() < 1e-2, "{force}");
    assert!((overlap / (3.0 * weight / STIFFNESS) - 1.0).abs() < 1e-2, "{overlap}");
    assert!(simulation.ledger().relative_error().abs() < 1e-6);
    // No friction, no torque on the bead or about the axis.
    assert_eq!(state.angular_velocity, Vector3::zero());
    assert!(simulation.wall_torque(0).abs() < 1e-12 * force * bowl);
}

/// A ball between an inner and an outer ring that rotate, squeezed by some percent of its radius.
fn bearing(inner: f64, outer: f64, model: ContactModel) -> (Setup, [f64; 2]) {
    let (squeeze, small) = (0.01 * RADIUS, 4.0 * RADIUS);
    let large = small + 2.0 * (RADIUS - squeeze);
    let ball = sphere(vector(0.5 * (small + large), 0.0, 0.0), Vector3::zero(), RADIUS);
    let walls = vec![
        rotating(inner, cylinder("inner", small, CylinderSide::Outside)),
        rotating(outer, cylinder("outer", large, CylinderSide::Inside)),
    ];
    // The contact points lie half an overlap behind the surfaces.
    (Setup { walls, ..setup(vec![ball], model) }, [small - 0.5 * squeeze, large + 0.5 * squeeze])
}

/// Angular momentum about the axis [kg m²/s].
fn angular_momentum(simulation: &Simulation) -> f64 {
    let state = states(simulation)[0];
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let of_angular_velocity = state.angular_velocity * (0.4 * mass * RADIUS * RADIUS);
    (state.position.cross(state.velocity) * mass + of_angular_velocity).dot(AXIS)
}

#[test]
fn rings_that_rotate_drive_the_ball_between_them_as_a_bearing_does() {
    let mut model = sticking(5e-3);
    model.laws.viscosity = Viscosity::Constant(Constant { gamma_0: 5e-3 });
    model.laws.rolling = Some(slider(50.0, 1e-4, 1e-3));
    for (inner, outer) in [(3.0, 0.0), (0.0, 2.0), (-4.0, 2.5)] {
        let mut without_rolling = model;
        without_rolling.laws.rolling = None;
        let (setup, radii) = bearing(inner, outer, without_rolling);
        let mut simulation = start(setup, 40.0);
        let worst = advance_watching(&mut simulation, 40_000, 50);
        let (state, ledger) = (states(&simulation)[0], simulation.ledger());
        // No slip at either ring: the ball rolls at the mean speed of the two surfaces and rotates with half of
        // their difference, over the contact points' distance from its centre.
        let speeds = [inner * radii[0], outer * radii[1]];
        let around = AXIS.cross(state.position) * (1.0 / state.position.norm());
        let speed = state.velocity.dot(around);
        let expected = 0.5 * (speeds[0] + speeds[1]);
        // The centrifugal force shifts the ball by mv²/2kr, some 1e-7 of its radius.
        let scale = speeds[0].abs() + speeds[1].abs();
        assert!((speed - expected).abs() < 1e-5 * scale, "{speed} {expected}");
        let rotation = state.angular_velocity.dot(AXIS);
        let expected = 0.5 * (speeds[1] - speeds[0]) / (0.5 * (radii[1] - radii[0]));
        assert!((rotation / expected - 1.0).abs() < 1e-5, "{rotation} {expected}");
        // Steady: the rings do no more work, and all of it went into motion, heat and springs.
        let torques = [0, 1].map(|ring| simulation.wall_torque(ring));
        let spun_up = angular_momentum(&simulation).abs() / simulation.time();
        assert!(torques.iter().all(|torque| torque.abs() < 1e-3 * spun_up), "{torques:?} {spun_up}");
        assert!(ledger.work_walls > ledger.kinetic() && ledger.dissipated() > 0.0, "{ledger:?}");
        assert!(worst < 1e-3, "{worst}");
    }
}

#[test]
fn what_the_rings_lose_of_angular_momentum_the_ball_gains() {
    let mut model = viscous_luding();
    model.laws.rolling = Some(slider(50.0, 2e-4, 0.1));
    let (setup, _) = bearing(5.0, -2.0, model);
    let mut simulation = start(setup, 40.0);
    let torque = |simulation: &Simulation| simulation.wall_torque(0) + simulation.wall_torque(1);
    let (mut given, mut most) = (0.0_f64, 0.0_f64);
    for _ in 0..3000 {
        let before = torque(&simulation);
        simulation.step().unwrap();
        // Velocity-Verlet changes the angular momentum by exactly the trapezoidal rule's integral of the torque.
        given -= 0.5 * simulation.time_step() * (before + torque(&simulation));
        let now = angular_momentum(&simulation);
        most = most.max(now.abs());
        assert!((now - given).abs() <= 1e-10 * most, "{now} {given}");
    }
    assert!(most > 0.0);
}

#[test]
fn a_sphere_that_rolls_and_spins_along_a_helix_keeps_its_energy_to_second_order() {
    // Between two rings at rest: it touches the outside of a cylinder and the inside of another.
    let error = |steps_per_contact: f64| {
        let mut model = sticking(0.0);
        model.laws.rolling = Some(slider(80.0, 0.0, 10.0));
        model.laws.torsion = Some(slider(80.0, 0.0, 10.0));
        let (mut setup, _) = bearing(0.0, 0.0, model);
        for wall in &mut setup.walls {
            wall.motion = WallMotion::Fixed;
        }
        setup.particles[0].velocity = vector(0.0, 0.05, 0.08);
        setup.particles[0].angular_velocity = vector(120.0, -40.0, 60.0);
        let mut simulation = start(setup, steps_per_contact);
        let steps = (40.0 * steps_per_contact) as usize;
        advance_watching(&mut simulation, steps, 1)
    };
    let (coarse, fine) = (error(40.0), error(80.0));
    assert!(coarse < 1e-3, "{coarse}");
    let order = (coarse / fine).log2();
    assert!((1.7..2.5).contains(&order), "{coarse} {fine}: order {order}");
}

#[test]
fn a_sphere_that_sticks_to_a_drum_is_carried_around_without_work() {
    // At the speed of the drum, pressed on by its own centrifugal force: nothing slides, whatever the angle.
    let (drum, turning) = (8.0 * RADIUS, 60.0);
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    // m Ω² (R − a + δ) = k δ.
    let overlap = mass * turning * turning * (drum - RADIUS) / (STIFFNESS - mass * turning * turning);
    let from_axis = drum - RADIUS + overlap;
    let mut carried = sphere(vector(from_axis, 0.0, 0.0), Vector3::zero(), RADIUS);
    carried.velocity = (AXIS * turning).cross(carried.position);
    carried.angular_velocity = AXIS * turning;
    let mut model = sticking(1e-4);
    model.laws.rolling = Some(slider(80.0, 1e-4, 1.0));
    let walls = vec![rotating(turning, cylinder("drum", drum, CylinderSide::Inside))];
    let mut simulation = start(Setup { walls, ..setup(vec![carried], model) }, 50.0);
    let kinetic = simulation.ledger().kinetic();
    let turns = 2.0;
    let steps = (turns * std::f64::consts::TAU / turning / simulation.time_step()) as usize;
    advance(&mut simulation, steps);
    let (state, ledger) = (states(&simulation)[0], simulation.ledger());
    // Two turns in 90 000 steps: the step turns the velocity by Ω dt = 1.4e-4.
    let relative = state.velocity - (AXIS * turning).cross(state.position);
    assert!(relative.norm() < 1e-6 * state.velocity.norm(), "{relative:?}");
    assert!(ledger.work_walls.abs() < 1e-6 * kinetic, "{ledger:?}");
    assert!(ledger.dissipated_sliding.abs() < 1e-9 * kinetic, "{ledger:?}");
}

const DRUM: f64 = 14.0 * RADIUS;
const POST: f64 = 2.0 * RADIUS;

/// Grains that fall about in a drum with a post in it, along whose axis space is periodic.
fn drum() -> Setup {
    let (spacing, layers) = (2.7 * RADIUS, 3);
    let length = f64::from(layers) * spacing;
    let domain = Domain::periodic(Vector3::zero(), vector(1.0, length, 1.0), [false, true, false]);
    let mut random = random_stream(3);
    let mut particles = Vec::new();
    for site in 0..11 * 11 * layers {
        let [i, j, layer] = [site % 11 - 5, site / 11 % 11 - 5, site / 121].map(f64::from);
        let place = vector(i, layer, j) * spacing;
        let from_axis = place.x.hypot(place.z);
        if from_axis > POST + 1.4 * RADIUS && from_axis < DRUM - 1.4 * RADIUS {
            let radius = RADIUS * (0.7 + 0.6 * f64::from(site * 7 % 13) / 12.0);
            let mut grain = sphere(place, gaussian_vector(&mut random) * 0.1, radius);
            grain.angular_velocity = gaussian_vector(&mut random) * 100.0;
            particles.push(grain);
        }
    }
    let walls = vec![
        rotating(40.0, cylinder("drum", DRUM, CylinderSide::Inside)),
        rotating(-25.0, cylinder("post", POST, CylinderSide::Outside)),
    ];
    Setup { domain, walls, background: gravity(GRAVITY), ..setup(particles, viscous_luding()) }
}

#[test]
fn no_contact_with_a_cylinder_is_missed_and_none_is_invented() {
    let mut simulation = start(drum(), 30.0);
    // The drum moves as well: downwards, then it rotates again.
    let down = vector(0.02, 0.3, -0.05);
    simulation.set_wall_motion(0, WallMotion::Velocity(Velocity { velocity: down })).unwrap();
    let mut seen = 0;
    for round in 0..300 {
        simulation.advance(37).unwrap();
        if round == 75 {
            let rotation = WallMotion::Rotation(Rotation { angular_velocity: 40.0 });
            simulation.set_wall_motion(0, rotation).unwrap();
        }
        let mut listed = Vec::new();
        simulation.for_each_contact(&mut |contact| {
            if let ContactPartner::Wall(wall) = contact.second
                && contact.overlap > 0.0
            {
                listed.push((contact.first, wall, contact.overlap));
            }
        });
        listed.sort_by_key(|&(id, wall, _)| (id, wall));
        let particles = simulation.particles();
        let rows = particles.rows_by_id();
        let mut expected = Vec::new();
        for (id, &row) in rows.iter().enumerate() {
            for (number, wall) in simulation.walls().iter().enumerate() {
                let from_point = particles.positions()[row] - wall.point;
                let from_axis = from_point.x.hypot(from_point.z);
                let overlap = match number {
                    0 => particles.radii()[row] - (DRUM - from_axis),
                    _ => particles.radii()[row] - (from_axis - POST),
                };
                if overlap > 0.0 {
                    expected.push((id as u32, number, overlap));
                }
            }
        }
        // An overlap of rounding errors may count as none.
        let certain = |all: &[(u32, usize, f64)]| -> Vec<(u32, usize)> {
            all.iter().filter(|(.., overlap)| *overlap > 1e-12).map(|&(id, wall, _)| (id, wall)).collect()
        };
        assert_eq!(certain(&listed), certain(&expected), "round {round}");
        seen += expected.len();
    }
    assert!(simulation.rebuilds() > 5, "{}", simulation.rebuilds());
    assert!(seen > 500, "only {seen} contacts with walls");
    let ledger = simulation.ledger();
    assert!(ledger.work_walls != 0.0 && ledger.relative_error().abs() < 1e-2, "{ledger:?}");
}

#[test]
fn a_drum_that_rotates_goes_on_from_its_exported_state_bit_by_bit() {
    let setup = drum();
    let mut simulation = start(setup.clone(), 30.0);
    simulation.advance(4001).unwrap();
    let state = simulation.export_state();
    let mut imported = Simulation::import_state(setup.interactions, setup.walls, &state).unwrap();
    assert_eq!(imported.wall_angular_velocity(0), 40.0);
    assert!(imported.wall_torque(0).abs() > 0.0);
    simulation.advance(500).unwrap();
    imported.advance(500).unwrap();
    assert_eq!(format!("{:?}", imported.export_state()), format!("{:?}", simulation.export_state()));
}

#[test]
fn a_drum_that_rotates_in_place_asks_for_no_new_list() {
    let walls = vec![rotating(500.0, cylinder("drum", DRUM, CylinderSide::Inside))];
    let resting = sphere(Vector3::zero(), Vector3::zero(), RADIUS);
    let mut simulation = start(Setup { walls, ..setup(vec![resting], elastic()) }, 20.0);
    simulation.advance(20_000).unwrap();
    assert_eq!(simulation.rebuilds(), 0);
}

#[test]
fn walls_that_cannot_be_are_refused() {
    let refused = |walls: Vec<Wall>, domain: Domain| {
        let particles = vec![sphere(Vector3::zero(), Vector3::zero(), RADIUS)];
        let setup = Setup { walls, domain, time_step: 1e-6, ..setup(particles, elastic()) };
        Simulation::new(setup).err()
    };
    let drum = cylinder("drum", 10.0 * RADIUS, CylinderSide::Inside);
    let open = Domain::unbounded();
    let periodic = |periodic| {
        let edge = 30.0 * RADIUS;
        Domain::periodic(Vector3::zero(), vector(edge, edge, edge), periodic)
    };
    assert_eq!(refused(vec![drum.clone()], open), None);
    assert_eq!(refused(vec![drum.clone()], periodic([false, true, false])), None);
    assert_eq!(
        refused(vec![drum.clone()], periodic([true, true, false])),
        Some(SetupError::WallAcrossPeriod { wall: 0, axis: 0 })
    );
    assert_eq!(refused(vec![rotating(1.0, floor())], open), Some(SetupError::RotationNeedsAxis { wall: 0 }));
    let narrow = cylinder("tube", RADIUS, CylinderSide::Inside);
    assert!(matches!(refused(vec![narrow], open), Some(SetupError::WallShape { .. })));
    assert_eq!(refused(vec![drum; 1025], open), Some(SetupError::TooManyWalls { found: 1025, most: 1024 }));
}
