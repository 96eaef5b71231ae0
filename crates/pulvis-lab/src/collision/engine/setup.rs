//! The simulation of a collision before its first step.

use crate::collision::oblique::RelativeMotion;
use crate::collision::problem::Problem;
use pulvis_core::walls::Wall;
use pulvis_core::{Background, Domain, Interactions, Particle, Setup};
use pulvis_input::collision::{Bodies, Sphere};
use pulvis_math::Vector3;

/// The bodies on their way, `phase` of a step before they come within reach, their centre of mass at rest.
pub(super) fn setup(problem: &Problem<'_>, time_step: f64, phase: f64) -> Setup {
    let along = |x: f64| Vector3::new(x, 0.0, 0.0);
    let still = RelativeMotion { velocity: along(-problem.velocity), angular_velocities: [along(0.0); 2] };
    let motion = problem.incidence.as_ref();
    let motion = motion.map_or(still, |incidence| RelativeMotion::before(problem.velocity, incidence));
    let flight = phase * problem.normal_velocity * time_step;
    let start = Vector3::new(flight - problem.start_overlap(), -motion.velocity.y * (phase * time_step), 0.0);
    let particle = |sphere: &Sphere, position: Vector3, velocity: Vector3, body: usize| Particle {
        material: 0,
        radius: sphere.radius,
        mass: sphere.mass,
        position,
        velocity,
        angular_velocity: motion.angular_velocities[body],
    };
    let mut interactions = Interactions::new(1);
    interactions.set(0, 0, *problem.contact);
    let (particles, walls) = match problem.bodies {
        Bodies::Pair([i, j]) => {
            let mass = i.mass + j.mass;
            let share = |other: &Sphere| {
                let Vector3 { x, y, z } = motion.velocity * other.mass;
                Vector3::new(x / mass, y / mass, z / mass)
            };
            let first = particle(i, along(i.radius) + start, share(j), 0);
            let second = particle(j, along(-j.radius), along(0.0) - share(i), 1);
            (vec![first, second], vec![])
        }
        Bodies::Wall(sphere) => {
            let wall = Wall::fixed("wall", 0, along(0.0), along(1.0));
            (vec![particle(sphere, along(sphere.radius) + start, motion.velocity, 0)], vec![wall])
        }
    };
    Setup {
        particles,
        interactions,
        walls,
        domain: Domain::unbounded(),
        background: Background::default(),
        time_step,
    }
}
