//! Nothing in a cell can tell where its faces are, where its origin is, or which period its tilt has lost.

use super::common::{RADIUS, States, difference_in, setup, sphere, start, states, vector, viscous_luding};
use super::{at_rates, cube, gas, packing, shear};
use pulvis_core::{Domain, Particle, Setup, Simulation, UpperTriangular};
use pulvis_math::Vector3;
use pulvis_testkit::reference::{Body, Models, ReferenceEngine};

/// Two spheres that collide obliquely, turning, in a cell with all its components in motion; shifted by a vector.
fn collision(shift: Vector3, tilts: [f64; 3]) -> Simulation {
    let edge = 12e-3;
    let mut one = sphere(vector(5e-3, 5.5e-3, 6e-3) + shift, vector(0.1, 0.05, 0.0), RADIUS);
    let mut other = sphere(vector(5.7e-3, 6.25e-3, 6.1e-3) + shift, vector(-0.1, -0.1, 0.02), 1.2 * RADIUS);
    one.angular_velocity = vector(100.0, -50.0, 20.0);
    other.angular_velocity = vector(-30.0, 70.0, 150.0);
    let domain = Domain { tilts, ..cube(edge) };
    let mut particles = vec![one, other];
    for particle in &mut particles {
        particle.position = domain.wrapped(particle.position);
    }
    let mut simulation = start(Setup { domain, ..setup(particles, viscous_luding()) }, 50.0);
    let rates = UpperTriangular { xx: -2.0, yy: -3.0, zz: 1.0, xy: 30.0, xz: 5.0, yz: -10.0 };
    simulation.set_cell_motion(at_rates(rates)).unwrap();
    simulation
}

#[test]
fn two_particles_collide_across_every_face_and_edge_as_they_do_inside() {
    let edge = 12e-3;
    let near = |x: f64, y: f64, z: f64| vector(x, y, z) - vector(5.3e-3, 5.9e-3, 6.0e-3);
    let shifts = [near(0.0, 6e-3, 6e-3), near(6e-3, edge, 6e-3), near(6e-3, 6e-3, 0.0), near(0.0, 0.0, edge)];
    for tilts in [[0.0; 3], [0.499 * edge, -0.3 * edge, 0.2 * edge]] {
        let mut inside = collision(Vector3::zero(), tilts);
        let mut outside = shifts.map(|shift| collision(shift, tilts));
        let mut crossed = 0;
        for _ in 0..400 {
            inside.step().unwrap();
            let (contact, states_inside) = (inside.contact_totals().pairs, states(&inside));
            let apart = |states: &States, domain: &Domain| {
                domain.images().nearest(states[0].position - states[1].position)
            };
            for other in &mut outside {
                other.step().unwrap();
                let states = states(other);
                let off = apart(&states_inside, inside.domain()) - apart(&states, other.domain());
                assert!(off.norm() < 1e-11 * RADIUS, "{off:?}");
                for (here, there) in states_inside.iter().zip(&states) {
                    assert!((here.velocity - there.velocity).norm() < 1e-11);
                    assert!((here.angular_velocity - there.angular_velocity).norm() * RADIUS < 1e-11);
                }
                assert_eq!(other.contact_totals().pairs, contact);
                let raw = states[0].position - states[1].position;
                crossed += u32::from(contact > 0.0 && raw.norm() > 4.0 * RADIUS);
            }
        }
        assert!(crossed > 50, "{crossed} steps in contact across a face");
    }
}

/// The engine without lists, in the laboratory: bodies of the same packing, whose velocities are not relative to the flow.
fn reference(simulation: &Simulation) -> ReferenceEngine {
    let particles = simulation.particles();
    let body = |row: usize| Body {
        id: particles.ids()[row],
        material: 0,
        radius: particles.radii()[row],
        mass: particles.masses()[row],
        position: particles.positions()[row],
        velocity: particles.velocities()[row],
        angular_velocity: particles.angular_velocities()[row],
    };
    let models = Models::from([((0, 0), viscous_luding())]);
    let periods = [0, 1, 2].map(|axis| simulation.domain().period(axis));
    let bodies = particles.rows_by_id().into_iter().map(body).collect();
    ReferenceEngine::new(bodies, Vec::new(), periods, Vector3::zero(), simulation.time_step(), models)
}

#[test]
fn a_sheared_gas_follows_newtons_equations_in_the_laboratory_beyond_a_remapping_of_the_tilt() {
    let mut simulation = start(gas(40, 0.35, 0.05, viscous_luding()), 40.0);
    let middle = simulation.domain().middle().y;
    let mut reference = reference(&simulation);
    let rate = 0.7 / (1500.0 * simulation.time_step());
    simulation.set_cell_motion(shear(rate)).unwrap();
    reference.shear(rate, middle);
    let mut touched = 0.0;
    for _ in 0..1500 {
        simulation.step().unwrap();
        reference.step();
        touched += simulation.contact_totals().pairs;
    }
    assert!(touched > 1000.0, "{touched} contacts times steps");
    assert!(simulation.domain().tilts[0] < 0.0 && simulation.rebuilds() > 3, "no remapping");
    let particles = simulation.particles();
    for row in particles.rows_by_id() {
        let body = reference.body(particles.ids()[row]).unwrap();
        let relative = body.velocity - vector(rate * (body.position.y - middle), 0.0, 0.0);
        // Collisions amplify rounding errors, some tenfold each.
        assert!((particles.velocities()[row] - relative).norm() < 1e-7, "{relative:?}");
        let turned = particles.angular_velocities()[row] - body.angular_velocity;
        assert!(turned.norm() * RADIUS < 1e-7, "{turned:?}");
        // Lab positions of the engine are images of those of the reference.
        let off = particles.positions()[row] - body.position;
        let images = simulation.domain().edges().inverse().times(off);
        let whole = images.to_array().map(|turns| (turns - turns.round()).abs());
        assert!(whole.into_iter().all(|off| off < 1e-6), "{images:?}");
    }
}

#[test]
fn a_packing_is_the_same_from_any_origin_while_it_is_sheared_and_compressed() {
    let made = packing(60, 0.62, 30.0);
    let motion = at_rates(UpperTriangular { yy: -4.0, xy: 40.0, xz: -20.0, ..UpperTriangular::ZERO });
    let moved_by = |shift: Vector3| {
        let (particles, domain) = (made.particles(), *made.domain());
        let all: Vec<Particle> = particles
            .rows_by_id()
            .into_iter()
            .map(|row| Particle {
                material: 0,
                radius: particles.radii()[row],
                mass: particles.masses()[row],
                position: domain.wrapped(particles.positions()[row] + shift),
                velocity: particles.velocities()[row],
                angular_velocity: particles.angular_velocities()[row],
            })
            .collect();
        let mut simulation = start(Setup { domain, ..setup(all, viscous_luding()) }, 50.0);
        simulation.set_cell_motion(motion).unwrap();
        simulation
    };
    let (mut here, mut there) = (moved_by(Vector3::zero()), moved_by(vector(1.3e-3, -2.1e-3, 0.7e-3)));
    for _ in 0..50 {
        here.advance(1).unwrap();
        there.advance(1).unwrap();
    }
    assert!(here.contact_totals().pairs > 100.0);
    assert_eq!(here.contact_totals().pairs, there.contact_totals().pairs);
    // Between particles, positions differ by the shift that the flow has carried along.
    assert!(difference_in(here.domain(), &states(&here), &states(&there)) < 1e-10);
    for (one, other) in
        here.stress_times_volume().iter().flatten().zip(there.stress_times_volume().iter().flatten())
    {
        let scale = here.stress_times_volume()[0][0].abs();
        assert!((one - other).abs() < 1e-10 * scale, "{one} {other}");
    }
}
