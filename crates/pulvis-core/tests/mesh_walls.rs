//! Walls of triangles: no bumps, ridges, boxes, motions, states.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod common;

use std::sync::Arc;

use common::*;
use pulvis_contact::catalogue::Values;
use pulvis_contact::{ContactModel, Linear, bond};
use pulvis_core::walls::{
    Cosine, FaceArea, Mesh, PressureRamp, Rotation, Servo, TriangleMesh, Velocity, Wall, WallMotion,
};
use pulvis_core::{ContactPartner, Domain, Setup, SetupError, Simulation};
use pulvis_math::Vector3;

const GRAVITY: f64 = 9.81;
const UP: Vector3 = Vector3 { x: 0.0, y: 0.0, z: 1.0 };

type Triangles = Vec<[Vector3; 3]>;

fn mesh(triangles: &[[Vector3; 3]]) -> Wall {
    let surface = Arc::new(TriangleMesh::new(triangles).unwrap());
    Wall::of_shape("mesh", 0, Vector3::zero(), Mesh::new(surface, UP))
}

/// A rectangle from `corner`, cut into n × n cells of four triangles whose common points lie anywhere in their cells.
fn sheet(corner: Vector3, [one, other]: [Vector3; 2], n: u32) -> Triangles {
    let at = |i: f64, j: f64| corner + one * (i / f64::from(n)) + other * (j / f64::from(n));
    let mut triangles = Vec::new();
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let middle = |number: u32| 0.3 + 0.4 * (0.618_034 * f64::from(number)).fract();
        let (x, y) = (f64::from(i), f64::from(j));
        let inner = at(x + middle(i + 7 * j), y + middle(3 * i + j));
        let corners = [at(x, y), at(x + 1.0, y), at(x + 1.0, y + 1.0), at(x, y + 1.0)];
        (0..4).for_each(|side| triangles.push([corners[side], corners[(side + 1) % 4], inner]));
    }
    triangles
}

/// A floor of triangles, 40 radii wide.
fn floor_of_triangles() -> Triangles {
    let edge = 40.0 * RADIUS;
    sheet(vector(-0.5 * edge, -0.5 * edge, 0.0), [vector(edge, 0.0, 0.0), vector(0.0, edge, 0.0)], 23)
}

/// The six faces of the cube from 0 to `edge`.
fn box_of_triangles(edge: f64) -> Triangles {
    let axes = [vector(edge, 0.0, 0.0), vector(0.0, edge, 0.0), vector(0.0, 0.0, edge)];
    let mut triangles = Vec::new();
    for axis in 0..3 {
        let sides = [axes[(axis + 1) % 3], axes[(axis + 2) % 3]];
        triangles.extend(sheet(Vector3::zero(), sides, 5));
        triangles.extend(sheet(axes[axis], sides, 5));
    }
    triangles
}

#[test]
fn a_sphere_that_rolls_over_a_floor_of_triangles_feels_no_bump() {
    let run = |wall: Wall| {
        let mut ball = sphere(vector(-9.0, -6.1, 0.999) * RADIUS, vector(0.4, 0.23, -0.02), RADIUS);
        ball.angular_velocity = vector(-100.0, 350.0, 40.0);
        let setup =
            Setup { walls: vec![wall], background: gravity(GRAVITY), ..setup(vec![ball], viscous_luding()) };
        let mut simulation = start(setup, 30.0);
        simulation.advance(5000).unwrap();
        (states(&simulation), simulation.wall_force(0))
    };
    let (on_plane, force) = run(floor());
    let (on_mesh, same) = run(mesh(&floor_of_triangles()));
    let way = (on_plane[0].position - vector(-9.0, -6.1, 1.0) * RADIUS).norm();
    assert!(way > 5.0 * RADIUS && way < 20.0 * RADIUS, "it went {way} m");
    let apart = difference(&Domain::unbounded(), &on_plane, &on_mesh);
    assert!(apart < 1e-9, "{apart}");
    assert!((force - same).norm() < 1e-9 * force.norm(), "{force:?} {same:?}");
}

#[test]
fn grains_in_a_box_of_triangles_move_as_between_six_planes() {
    let edge = 9.0 * RADIUS;
    let run = |walls: Vec<Wall>| {
        let mut setup = implosion(20, edge, 4, viscous_luding());
        // Away from the middle, to the walls.
        setup.particles.iter_mut().for_each(|particle| particle.velocity = particle.velocity * -1.0);
        let mut simulation = start(Setup { walls, background: gravity(GRAVITY), ..setup }, 30.0);
        let mut at_walls = Vec::new();
        for _ in 0..20 {
            simulation.advance(100).unwrap();
            at_walls.push(simulation.contact_totals().at_walls);
        }
        (states(&simulation), at_walls)
    };
    let between_planes = run(cube_of_walls(edge));
    let in_mesh = run(vec![mesh(&box_of_triangles(edge))]);
    let apart = difference(&Domain::unbounded(), &between_planes.0, &in_mesh.0);
    // Some collisions make rounding errors of 1e-16 larger.
    assert!(apart < 1e-7, "{apart}");
    assert_eq!(between_planes.1, in_mesh.1);
    assert!(in_mesh.1.iter().sum::<f64>() > 20.0, "{:?}", in_mesh.1);
}

/// A roof that rises with 1:4 up to x = 0 and falls with 1:2, the direction up its first side and the normal there.
fn roof() -> (Wall, Vector3, Vector3) {
    let (length, width) = (20.0 * RADIUS, vector(0.0, 40.0 * RADIUS, 0.0));
    let at = |x: f64, z: f64| vector(x, -20.0 * RADIUS, z);
    let mut roof = sheet(at(-length, -0.25 * length), [vector(length, 0.0, 0.25 * length), width], 7);
    roof.extend(sheet(at(0.0, 0.0), [vector(length, 0.0, -0.5 * length), width], 7));
    let norm = 1.0 / 1.0625_f64.sqrt();
    (mesh(&roof), vector(1.0, 0.0, 0.25) * norm, vector(-0.25, 0.0, 1.0) * norm)
}

#[test]
fn a_bead_that_slides_over_a_ridge_keeps_its_energy() {
    let (roof, along, normal) = roof();
    let (mass, stiffness) = (sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass, 2e4);
    let overlap = mass * GRAVITY * normal.z / stiffness;
    let start_at = along * (-8.0 * RADIUS) + normal * (RADIUS - overlap);
    // So fast that it comes up, with v² = 0.3 g a cos θ there: it stays on the ridge.
    let bead = sphere(start_at, along * 0.1433 + vector(0.0, 0.05, 0.0), RADIUS);
    let model = ContactModel::frictionless(Linear::new(stiffness, 0.0));
    let setup = Setup { walls: vec![roof], background: gravity(GRAVITY), ..setup(vec![bead], model) };
    let mut simulation = start(setup, 40.0);
    let mut crossed = false;
    while states(&simulation)[0].position.x < 8.0 * RADIUS {
        simulation.advance(10).unwrap();
        let mut touching = 0;
        simulation.for_each_contact(&mut |_| touching += 1);
        // One contact on both sides and on the ridge.
        assert_eq!(touching, 1, "{:?}", states(&simulation)[0]);
        crossed |= states(&simulation)[0].position.x > 0.0;
        assert!(simulation.time() < 1.0, "it does not come over");
    }
    assert!(crossed);
    let ledger = simulation.ledger();
    // The contact is computed with 40 steps; no feature adds or takes anything.
    assert!(ledger.relative_error().abs() < 1e-6, "{ledger:?}");
    let now = states(&simulation)[0];
    assert!((now.velocity.y - 0.05).abs() < 1e-12, "nothing pushes along the ridge");
}

#[test]
fn a_ball_that_rolls_over_a_ridge_takes_its_friction_spring_and_its_plastic_overlap_along() {
    let mass = sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass;
    let mut sticking = ContactModel::frictionless(Linear::new(2e3, 0.0));
    sticking.laws.sliding = Some(slider(2.0, 0.0, 10.0));
    let mut plastic = luding();
    (plastic.laws.sliding, plastic.laws.rolling, plastic.laws.torsion) = (None, None, None);
    // Rolling, v² falls by 10/7 g h; sliding, by 2 g h. Up there, v² = 0.3 g a cos θ is left.
    for (model, stiffness, speed, rolls) in [(sticking, 2e3, 0.1225, true), (plastic, 100.0, 0.1433, false)] {
        let (roof, along, normal) = roof();
        let overlap = mass * GRAVITY * normal.z / stiffness;
        let at = along * (-8.0 * RADIUS) + normal * (RADIUS - overlap);
        let mut ball = sphere(at, along * speed, RADIUS);
        if rolls {
            ball.angular_velocity = normal.cross(along) * (speed / RADIUS);
        }
        let setup = Setup { walls: vec![roof], background: gravity(GRAVITY), ..setup(vec![ball], model) };
        let mut simulation = start(setup, 40.0);
        let (mut before, mut largest, mut steps) = (0.0_f64, 0.0_f64, 0);
        while states(&simulation)[0].position.x < 3.0 * RADIUS {
            simulation.step().unwrap();
            let mut size = 0.0_f64;
            simulation.for_each_contact(&mut |contact| {
                size += contact.memory.iter().map(|value| value * value).sum::<f64>();
            });
            let now = size.sqrt();
            largest = largest.max(now);
            // A spring swings with 2300 rad/s, half a per cent in a step; a plastic overlap never becomes smaller.
            if rolls && states(&simulation)[0].position.x > -2.0 * RADIUS {
                assert!((now - before).abs() < 0.02 * largest, "{before} {now} {:?}", states(&simulation)[0]);
            } else if !rolls {
                assert!(now >= before, "{before} {now} {:?}", states(&simulation)[0]);
            }
            before = now;
            steps += 1;
            assert!(simulation.time() < 1.0, "it does not come over");
        }
        assert!(steps > 100 && before > 0.0);
        assert!(simulation.ledger().relative_error().abs() < 1e-5, "{:?}", simulation.ledger());
    }
}

#[test]
fn a_bead_on_a_rotating_blade_flies_out_as_the_exponential_function() {
    // In the frame of the blade s'' = Ω² s, whatever the bead's distance from the blade: s = s0 exp Ω t with s' = Ω s0 at
    // first. The Coriolis force 2 m Ω s' presses it on; the centrifugal force, m Ω² a across the blade, is smaller.
    let (turning, start_at, stiffness) = (40.0_f64, 3.0 * RADIUS, 2e4);
    let (length, height) = (60.0 * RADIUS, 8.0 * RADIUS);
    let corner = vector(-0.5 * length, 0.0, -0.5 * height);
    let mut blade = mesh(&sheet(corner, [vector(length, 0.0, 0.0), UP * height], 9));
    blade.motion = WallMotion::Rotation(Rotation { angular_velocity: turning });
    let spin = UP * turning;
    let mut bead = sphere(vector(start_at, RADIUS, 0.0), Vector3::zero(), RADIUS);
    bead.velocity = spin.cross(bead.position) + vector(turning * start_at, 0.0, 0.0);
    let model = ContactModel::frictionless(Linear::new(stiffness, 0.0));
    let mut simulation = start(Setup { walls: vec![blade], ..setup(vec![bead], model) }, 40.0);
    let (kinetic, end) = (simulation.ledger().kinetic(), 1.5 / turning);
    simulation.advance((end / simulation.time_step()) as u64).unwrap();
    let time = simulation.time();
    let (sine, cosine) = (turning * time).sin_cos();
    let now = states(&simulation)[0];
    let along = now.position.dot(vector(cosine, sine, 0.0));
    let expected = start_at * (turning * time).exp();
    // The bead gives way by up to 2 m Ω² s/k, a thousandth of its radius.
    assert!((along / expected - 1.0).abs() < 1e-4, "{along} {expected}");
    assert!(now.position.z.abs() < 1e-15 && simulation.walls()[0].angle > 1.4);
    let ledger = simulation.ledger();
    assert!((ledger.work_walls / (ledger.kinetic() - kinetic) - 1.0).abs() < 1e-3, "{ledger:?}");
    assert!(ledger.relative_error().abs() < 1e-3, "{ledger:?}");
    assert!(simulation.rebuilds() > 0);
    // Torque and force on the wall are the opposites of those on the bead.
    let mut torque = 0.0_f64;
    simulation.for_each_contact(&mut |contact| torque += contact.centre_second.cross(contact.force).z);
    assert!((simulation.wall_torque(0) + torque).abs() < 1e-6 * torque.abs(), "{torque}");
}

#[test]
fn a_mesh_moves_with_a_velocity_a_cosine_or_under_a_pressure_as_a_plane_does() {
    let cosine = Cosine { displacement: UP * (0.2 * RADIUS), period: 5e-2, cycles: 1.0 };
    let pressure = PressureRamp { from: 300.0, to: 300.0, duration: 0.0 };
    let motions = [
        WallMotion::Velocity(Velocity { velocity: vector(0.01, 0.0, 0.01) }),
        WallMotion::Cosine(cosine),
        WallMotion::Servo(Servo { pressure, mass: 1e-4, damping: 0.1 }),
    ];
    for motion in motions {
        let run = |wall: Wall| {
            let area = FaceArea::Given(1e-5);
            let grains = (0..4).map(|number| {
                let (x, y) = (f64::from(number % 2), f64::from(number / 2));
                sphere(vector(2.2 * x, 2.3 * y, 1.0) * RADIUS, vector(0.02 * y, 0.03, 0.0), RADIUS)
            });
            let walls = vec![Wall { motion, area, ..wall }, Wall::fixed("lid", 0, UP * (2.05 * RADIUS), -UP)];
            let setup =
                Setup { walls, background: gravity(GRAVITY), ..setup(grains.collect(), viscous_luding()) };
            let mut simulation = start(setup, 30.0);
            simulation.advance(2000).unwrap();
            (states(&simulation), simulation.walls()[0].point, simulation.wall_force(0))
        };
        let (plane, mesh) = (run(floor()), run(mesh(&floor_of_triangles())));
        assert!(plane.1.norm() > 1e-3 * RADIUS, "{motion:?} {:?}", plane.1);
        assert!((plane.1 - mesh.1).norm() < 1e-9 * RADIUS, "{motion:?} {:?} {:?}", plane.1, mesh.1);
        assert!(difference(&Domain::unbounded(), &plane.0, &mesh.0) < 1e-9, "{motion:?}");
        assert!((plane.2 - mesh.2).norm() < 1e-7 * plane.2.norm(), "{motion:?}");
    }
}

/// A drum along z of 24 sides with two ends and three lifters, and grains in it; gravity is along −x.
fn drum() -> Setup {
    let (radius, half) = (11.0 * RADIUS, 5.0 * RADIUS);
    let at = |side: u32, from_axis: f64, z: f64| {
        let angle = std::f64::consts::TAU * f64::from(side % 24) / 24.0;
        vector(angle.cos() * from_axis, angle.sin() * from_axis, z)
    };
    let mut triangles = Vec::new();
    for side in 0..24 {
        let [a, b] = [side, side + 1].map(|side| at(side, radius, -half));
        let [c, d] = [side + 1, side].map(|side| at(side, radius, half));
        triangles.extend([[a, b, c], [a, c, d]]);
        triangles.extend([[a, b, UP * -half], [c, d, UP * half]]);
        if side % 8 == 0 {
            let [e, f] = [-half, half].map(|z| at(side, 0.7 * radius, z));
            triangles.extend([[a, e, f], [a, f, d]]);
        }
    }
    let mut wall = mesh(&triangles);
    wall.motion = WallMotion::Rotation(Rotation { angular_velocity: 30.0 });
    let mut grains = Vec::new();
    for site in 0..6 * 6 * 6 {
        let [i, j, k] = [site % 6, site / 6 % 6, site / 36].map(|n| (f64::from(n) - 2.5) * 1.45);
        let radius = RADIUS * (0.5 + 0.2 * f64::from(site * 7 % 13) / 12.0);
        grains.push(sphere(vector(i, j, k) * RADIUS, vector(-0.5, 0.03 * k, 0.01 * i), radius));
    }
    let mut setup = Setup { walls: vec![wall], ..setup(grains, viscous_luding()) };
    setup.background.gravity = vector(-GRAVITY, 0.0, 0.0);
    setup
}

#[test]
fn no_contact_with_a_drum_of_triangles_is_missed_while_it_rotates_and_no_grain_is_lost() {
    let mut simulation = start(drum(), 25.0);
    let mut seen = 0;
    for _ in 0..150 {
        simulation.advance(41).unwrap();
        let mut listed = std::collections::HashMap::new();
        simulation.for_each_contact(&mut |contact| {
            if contact.second == ContactPartner::Wall(0) {
                let deepest = listed.entry(contact.first).or_insert(0.0_f64);
                *deepest = deepest.max(contact.overlap);
            }
        });
        let particles = simulation.particles();
        for (id, row) in particles.rows_by_id().into_iter().enumerate() {
            let centre = particles.positions()[row];
            assert!(centre.x.hypot(centre.y) < 11.0 * RADIUS && centre.z.abs() < 5.0 * RADIUS, "{centre:?}");
            // The nearest point of all triangles is a contact, and no other is deeper.
            let overlap = particles.radii()[row] - simulation.walls()[0].distance(centre);
            let deepest = listed.get(&(id as u32)).copied().unwrap_or(0.0);
            assert!((overlap.max(0.0) - deepest).abs() < 1e-15, "grain {id}: {overlap} {deepest}");
            seen += usize::from(overlap > 0.0);
        }
    }
    assert!(seen > 500, "only {seen} contacts");
    assert!(simulation.rebuilds() > 5 && simulation.ledger().work_walls > 0.0);
    assert!(simulation.ledger().relative_error().abs() < 1e-2, "{:?}", simulation.ledger());
}

#[test]
fn a_drum_of_triangles_goes_on_from_its_exported_state_bit_by_bit_with_any_number_of_threads() {
    let setup = drum();
    let mut simulation = start(setup.clone(), 25.0);
    simulation.advance(5003).unwrap();
    let state = simulation.export_state();
    let mut imported = Simulation::import_state(setup.interactions, setup.walls, &state).unwrap();
    assert!(imported.walls()[0].angle > 0.0);
    imported.set_threads(3).unwrap();
    simulation.advance(700).unwrap();
    imported.advance(700).unwrap();
    assert_eq!(format!("{:?}", imported.export_state()), format!("{:?}", simulation.export_state()));
    assert!(simulation.ledger().work_walls != 0.0);
}

#[test]
fn bonds_with_a_mesh_are_refused_because_they_could_not_pass_an_edge() {
    let mut model = elastic();
    let values =
        Values::new().with("normal_stiffness", 1e3).with("shear_stiffness", 5e2).with("distance", 1e-8);
    let strengths = ["tensile_strength", "shear_strength"];
    let values = strengths.into_iter().fold(values, |values, name| values.with(name, 1.0));
    model.laws.bond = bond::build("elastic-brittle", &values).unwrap().unwrap();
    let particles = vec![sphere(vector(0.0, 0.0, 1.0), Vector3::zero(), RADIUS)];
    let walls = vec![mesh(&floor_of_triangles())];
    let setup = Setup { walls, time_step: 1e-6, ..setup(particles, model) };
    assert_eq!(Simulation::new(setup).err(), Some(SetupError::BondWithMesh { name: "mesh".to_owned() }));
}
