//! Cones, tubes, disks and planes with a hole: rims, rotation, forces and torques.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use common::*;
use pulvis_contact::{ContactModel, Linear};
use pulvis_core::walls::{
    Cone, Cosine, Cylinder, CylinderSide, Disk, PlaneWithHole, Rotation, Tube, Wall, WallMotion, WallShape,
};
use pulvis_core::{ContactPartner, Domain, Setup, SetupError, Simulation};
use pulvis_math::Vector3;

const GRAVITY: f64 = 9.81;
const UP: Vector3 = Vector3 { x: 0.0, y: 0.0, z: 1.0 };

fn wall(shape: impl Into<WallShape>) -> Wall {
    Wall::of_shape("wall", 0, Vector3::zero(), shape)
}

fn rotating(angular_velocity: f64, wall: Wall) -> Wall {
    Wall { motion: WallMotion::Rotation(Rotation { angular_velocity }), ..wall }
}

/// A contact of this stiffness [N/m] without friction.
fn stiff(stiffness: f64) -> ContactModel {
    ContactModel::frictionless(Linear::new(stiffness, 0.0))
}

/// Grains on a wall under gravity.
fn on(wall: Wall, grains: Vec<pulvis_core::Particle>, model: ContactModel, steps: f64) -> Simulation {
    start(Setup { walls: vec![wall], background: gravity(GRAVITY), ..setup(grains, model) }, steps)
}

#[test]
fn a_bead_that_slides_over_a_rim_leaves_it_at_two_thirds_of_its_height_and_keeps_its_energy() {
    // Around an edge without friction the centre of a sphere circles, as that of a point does on a sphere of its radius:
    // from rest at θ0 it leaves where cos θ = 2/3 cos θ0 (a textbook problem). A large hole has the same edge.
    let (large, start_angle) = (50.0 * RADIUS, 0.1_f64);
    let disk = wall(Disk { normal: UP, radius: large });
    let plane = wall(PlaneWithHole { normal: UP, radius: large });
    for (wall, outwards) in [(disk, 1.0), (plane, -1.0)] {
        let (stiffness, mass) = (2e4, sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass);
        let apart = RADIUS - mass * GRAVITY * start_angle.cos() / stiffness;
        let at = vector(large + outwards * apart * start_angle.sin(), 0.0, apart * start_angle.cos());
        let bead = sphere(at, Vector3::zero(), RADIUS);
        let mut simulation = on(wall, vec![bead], stiff(stiffness), 40.0);
        let mut last = start_angle.cos();
        while simulation.wall_force(0) != Vector3::zero() {
            let centre = states(&simulation)[0].position;
            last = centre.z / (centre - vector(large, 0.0, 0.0)).norm();
            simulation.step().unwrap();
            assert!(simulation.time() < 1.0, "it stays");
        }
        // The spring of 3e-4 of the weight per radius swings a little: near the end the force is small.
        assert!((last - 2.0 / 3.0 * start_angle.cos()).abs() < 5e-3, "{last}");
        let ledger = simulation.ledger();
        // Velocity-Verlet with 40 steps a contact.
        assert!(ledger.relative_error().abs() < 1e-6, "{ledger:?}");
        // It falls past the edge, which it does not touch again.
        simulation.advance(200).unwrap();
        assert_eq!(simulation.wall_force(0), Vector3::zero());
    }
}

#[test]
fn a_grain_that_plugs_a_cone_or_a_hole_presses_with_its_weight_over_the_sine() {
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let weight = mass * GRAVITY;
    // A cone of 30° to its axis, tip down; its surface is a sphere's radius away at a/sin 30°.
    let cone =
        wall(Cone { axis: UP, radii: [0.0, 8.0 * RADIUS * 0.5], height: 8.0 * RADIUS * 0.75_f64.sqrt() });
    // A hole whose rim is seen at 60° from the axis.
    let hole = wall(PlaneWithHole { normal: UP, radius: RADIUS * 0.75_f64.sqrt() });
    for (wall, height, sine) in [(cone, 2.0, 0.5), (hole, 0.5, 0.5)] {
        let grain = sphere(UP * (height * RADIUS), Vector3::zero(), RADIUS);
        let mut model = stiff(1e4);
        model.laws.viscosity =
            pulvis_contact::viscosity::Viscosity::Constant(pulvis_contact::viscosity::Constant {
                gamma_0: 0.03,
            });
        let mut simulation = on(wall, vec![grain], model, 40.0);
        simulation.advance(20_000).unwrap();
        let mut forces = Vec::new();
        simulation.for_each_contact(&mut |contact| forces.push((contact.normal_force, contact.force)));
        // N sin θ per contact, two contacts: N = m g/(2 sin θ).
        assert_eq!(forces.len(), 2);
        for (normal_force, _) in &forces {
            assert!((normal_force * 2.0 * sine / weight - 1.0).abs() < 1e-3, "{normal_force} {weight}");
        }
        let sum = forces.iter().fold(Vector3::zero(), |sum, (_, force)| sum + *force);
        assert!((sum - UP * weight).norm() < 1e-3 * weight);
        // What presses on the wall is the opposite.
        assert!((simulation.wall_force(0) + sum).norm() < 1e-12 * weight, "{:?}", simulation.wall_force(0));
        let centre = states(&simulation)[0].position;
        assert!(centre.x.hypot(centre.y) < 1e-12 && (centre.z / RADIUS - height).abs() < 1e-3);
    }
}

#[test]
fn a_bead_circles_in_a_cone_with_the_speed_and_the_force_of_a_conical_pendulum() {
    // Half the angle of the cone is 40°: N sin θ = m g, N cos θ = m v²/ρ.
    let half_angle = 40_f64.to_radians();
    let (sine, cosine, stiffness) = (half_angle.sin(), half_angle.cos(), 5e4);
    let cone = wall(Cone { axis: UP, radii: [0.0, 20.0 * RADIUS * sine], height: 20.0 * RADIUS * cosine });
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let force = mass * GRAVITY / sine;
    let (touches, apart) = (10.0 * RADIUS, RADIUS - force / stiffness);
    let from_axis = touches * sine - apart * cosine;
    let speed = (GRAVITY * from_axis * cosine / sine).sqrt();
    let centre = vector(from_axis, 0.0, touches * cosine + apart * sine);
    let mut simulation =
        on(cone, vec![sphere(centre, vector(0.0, speed, 0.0), RADIUS)], stiff(stiffness), 40.0);
    let period = std::f64::consts::TAU * from_axis / speed;
    while simulation.time() < 2.0 * period {
        simulation.advance(97).unwrap();
        let now = states(&simulation)[0];
        let across = vector(now.position.x, now.position.y, 0.0);
        // 40 steps a contact, with a centripetal acceleration that is off by their square.
        assert!((across.norm() / from_axis - 1.0).abs() < 1e-5, "{now:?}");
        let pressed = simulation.wall_force(0);
        assert!(
            (pressed.norm() / force - 1.0).abs() < 1e-3 && (pressed.z / (mass * GRAVITY) + 1.0).abs() < 1e-3
        );
        assert!(simulation.wall_torque(0).abs() < 1e-12 * force * from_axis);
    }
    assert!(simulation.ledger().relative_error().abs() < 1e-6);
}

#[test]
fn a_ball_on_a_turntable_circles_at_two_sevenths_of_its_speed() {
    // A solid sphere that rolls on a turntable: its centre moves on a circle with 2/7 of the angular velocity of the table
    // (J. A. Burns, Am. J. Phys. 49, 56 (1981)). Here around the axis, so that v = 2/7 Ω × r.
    let (turning, from_axis, stiffness) = (30.0, 6.0 * RADIUS, 1e4);
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let overlap = mass * GRAVITY / stiffness;
    let arm = RADIUS - 0.5 * overlap;
    for shape in [
        WallShape::from(Disk { normal: UP, radius: 12.0 * RADIUS }),
        PlaneWithHole { normal: UP, radius: 2.0 * RADIUS }.into(),
    ] {
        let mut ball = sphere(vector(from_axis, 0.0, RADIUS - overlap), Vector3::zero(), RADIUS);
        let of_table = turning * from_axis;
        ball.velocity = vector(0.0, 2.0 / 7.0 * of_table, 0.0);
        ball.angular_velocity = vector(5.0 / 7.0 * of_table / arm, 0.0, 0.0);
        let mut model = stiff(stiffness);
        model.laws.sliding = Some(slider(5e3, 1e-3, 10.0));
        let mut simulation = on(rotating(turning, wall(shape)), vec![ball], model, 40.0);
        let period = std::f64::consts::TAU / (2.0 / 7.0 * turning);
        let steps = (period / simulation.time_step()).round();
        simulation.advance(steps as u64).unwrap();
        let now = states(&simulation)[0].position;
        // A quarter of a per cent: the spring gives way by the overlap, 3e-4 of the radius, and takes its time to be tense.
        assert!((now - vector(from_axis, 0.0, now.z)).norm() < 0.02 * from_axis, "{now:?}");
        let outwards = simulation.wall_force(0);
        let centripetal = mass * (2.0 / 7.0 * turning).powi(2) * from_axis;
        assert!(
            (outwards.x.hypot(outwards.y) / centripetal - 1.0).abs() < 0.02,
            "{outwards:?} {centripetal}"
        );
    }
}

#[test]
fn a_grain_that_slides_on_a_rotating_disk_brakes_it_with_its_friction_times_the_arm() {
    let (friction, from_axis) = (0.3, 6.0 * RADIUS);
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let stiffness = 1e4;
    let at = vector(0.0, from_axis, RADIUS - mass * GRAVITY / stiffness);
    let mut model = stiff(stiffness);
    model.laws.sliding = Some(slider(5e3, 0.0, friction));
    let disk = rotating(200.0, wall(Disk { normal: UP, radius: 10.0 * RADIUS }));
    let mut simulation = on(disk, vec![sphere(at, Vector3::zero(), RADIUS)], model, 40.0);
    simulation.advance(200).unwrap();
    let expected = friction * mass * GRAVITY * from_axis;
    assert!((simulation.wall_torque(0) / expected + 1.0).abs() < 1e-3, "{}", simulation.wall_torque(0));
    // Newton: the grain feels the opposite of what the wall feels.
    let mut on_grain = Vector3::zero();
    simulation.for_each_contact(&mut |contact| on_grain += contact.force);
    assert!((simulation.wall_force(0) + on_grain).norm() < 1e-6 * mass * GRAVITY);
    let ledger = simulation.ledger();
    // Half of the work of sliding friction is heat at first, all but what moves the grain.
    assert!(ledger.work_walls > 0.0 && ledger.dissipated_sliding > 0.0, "{ledger:?}");
    assert!(ledger.relative_error().abs() < 1e-3, "{ledger:?}");
}

#[test]
fn grains_in_a_tube_move_as_in_a_cylinder_without_ends() {
    let (axis, radius) = (vector(0.0, 1.0, 0.0), 6.0 * RADIUS);
    let run = |wall: Wall| {
        let grains = (0..6).map(|number| {
            let x = (f64::from(number) - 2.5) * 1.3 * RADIUS;
            sphere(vector(x, 0.4 * x, -2.0 * RADIUS), vector(0.05, 0.02, -0.5), RADIUS * 0.6)
        });
        let mut simulation = on(rotating(30.0, wall), grains.collect(), viscous_luding(), 30.0);
        simulation.advance(3000).unwrap();
        (states(&simulation), simulation.wall_torque(0), simulation.contact_totals())
    };
    let endless = run(wall(Cylinder { axis, radius, side: CylinderSide::Inside }));
    let tube = Tube { axis, radius, length: 40.0 * RADIUS };
    let with_ends = run(Wall::of_shape("wall", 0, axis * (-20.0 * RADIUS), tube));
    assert!(endless.1.abs() > 0.0);
    // Rounding errors of 1e-16, which collisions make larger.
    let difference = difference(&Domain::unbounded(), &endless.0, &with_ends.0);
    assert!(difference < 1e-9, "{difference}");
    assert!((endless.1 - with_ends.1).abs() < 1e-8 * endless.1.abs());
}

#[test]
fn a_disk_can_shake_in_any_direction_and_be_taken_away() {
    let shaken = vector(0.3 * RADIUS, -0.2 * RADIUS, 0.5 * RADIUS);
    let cosine = Cosine { displacement: shaken, period: 2e-3, cycles: 1.0 };
    let disk = Wall { motion: WallMotion::Cosine(cosine), ..wall(Disk { normal: UP, radius: 9.0 * RADIUS }) };
    let grain = sphere(UP * RADIUS, Vector3::zero(), RADIUS);
    let mut simulation = on(disk, vec![grain], viscous_luding(), 40.0);
    let steps = (1e-3 / simulation.time_step()).round() as u64;
    simulation.advance(steps).unwrap();
    // Half a period: where it is farthest.
    assert!(
        (simulation.walls()[0].point - shaken).norm() < 1e-6 * RADIUS,
        "{:?}",
        simulation.walls()[0].point
    );
    assert!(simulation.ledger().relative_error().abs() < 1e-2);
    simulation.set_wall_present(0, false);
    let before = states(&simulation)[0];
    let fall = 500.0 * simulation.time_step();
    simulation.advance(500).unwrap();
    let after = states(&simulation)[0];
    let expected = before.position + before.velocity * fall - UP * (0.5 * GRAVITY * fall * fall);
    assert!((after.position - expected).norm() < 1e-9 * RADIUS, "it falls freely: {after:?} {expected:?}");
}

#[test]
fn a_hopper_goes_on_from_its_exported_state_bit_by_bit_with_any_number_of_threads() {
    let mut particles = Vec::new();
    for site in 0..400 {
        let [i, j, k] = [site % 8, site / 8 % 8, site / 64].map(|n| f64::from(n) - 3.5);
        let at = vector(i * 1.3, j * 1.3, 12.0 + k * 1.2) * RADIUS;
        particles.push(sphere(
            at,
            vector(0.01 * j, -0.01 * i, -1.0),
            RADIUS * (0.5 + 0.004 * f64::from(site % 20)),
        ));
    }
    let at = |height: f64, shape: WallShape| Wall::of_shape("wall", 0, UP * (height * RADIUS), shape);
    let cone = Cone { axis: UP, radii: [3.0 * RADIUS, 10.0 * RADIUS], height: 7.0 * RADIUS };
    let walls = vec![
        rotating(20.0, at(0.0, cone.into())),
        at(7.0, Tube { axis: UP, radius: 10.0 * RADIUS, length: 12.0 * RADIUS }.into()),
        rotating(-50.0, at(-2.0, PlaneWithHole { normal: UP, radius: 2.0 * RADIUS }.into())),
        at(-6.0, Disk { normal: UP, radius: 9.0 * RADIUS }.into()),
    ];
    let setup = Setup { walls, background: gravity(GRAVITY), ..setup(particles, viscous_luding()) };
    let mut simulation = start(setup.clone(), 25.0);
    simulation.advance(3001).unwrap();
    let state = simulation.export_state();
    let mut imported = Simulation::import_state(setup.interactions, setup.walls, &state).unwrap();
    imported.set_threads(3).unwrap();
    simulation.advance(500).unwrap();
    imported.advance(500).unwrap();
    assert_eq!(format!("{:?}", imported.export_state()), format!("{:?}", simulation.export_state()));
    let mut at_walls = [0; 4];
    simulation.for_each_contact(&mut |contact| {
        if let ContactPartner::Wall(wall) = contact.second {
            at_walls[wall] += 1;
        }
    });
    assert!(at_walls[0] > 20, "{at_walls:?}");
    assert!(simulation.ledger().relative_error().abs() < 1e-2);
}

#[test]
fn walls_with_edges_stand_in_open_space_only() {
    let domain = Domain::periodic(Vector3::zero(), vector(1.0, 1.0, 1.0), [false, false, true]);
    let particles = vec![sphere(vector(0.5, 0.5, 0.5), Vector3::zero(), RADIUS)];
    let walls = vec![wall(Disk { normal: UP, radius: 0.1 })];
    let setup = Setup { walls, domain, time_step: 1e-6, ..setup(particles, elastic()) };
    assert_eq!(Simulation::new(setup).err(), Some(SetupError::WallAcrossPeriod { wall: 0, axis: 2 }));
}
