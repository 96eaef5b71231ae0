//! What comes of an oblique collision beside its restitution along the line of centres.
//!
//! Components are along fixed axes: x from j to i along the line of centres when the bodies come within the range of their
//! forces, at a wall its normal; y along the tangential velocity before.

use super::problem::Problem;
use pulvis_core::{Particles, Simulation};
use pulvis_input::collision::{Bodies, Incidence};
use pulvis_math::{Vector3, elementary};

/// The end of an oblique collision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObliqueOutcome {
    /// Tangential velocity of i against j after over before; `None` where there is none before [1].
    pub restitution_tangential: Option<f64>,
    /// Velocity of the contact point along y before and after [m/s].
    pub contact_velocities: [f64; 2],
    /// −1 times the tangential velocity of the contact point after over before, β; −1: no friction, 0: the bodies roll
    /// off each other, 1: reversed; `None` where there is none before [1].
    pub restitution_contact: Option<f64>,
    /// Angle of the relative velocity after, from x towards y [rad].
    pub rebound_angle: f64,
    /// The same of the velocity of the contact point [rad].
    pub rebound_angle_contact: f64,
    /// Tangential impulse against y over the one along x; the coefficient of friction where the contact slides
    /// throughout [1].
    pub impulse_ratio: f64,
    /// Angular velocities of i and j after [rad/s]; zero of a wall.
    pub angular_velocities: [Vector3; 2],
    /// Change of the linear and the angular momentum of a pair over the sum of the magnitudes of its parts: round-off
    /// [1]. `None` at a wall.
    pub momentum_errors: Option<[f64; 2]>,
}

/// The tangential motion at one instant of an oblique collision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ObliqueSample {
    /// Tangential velocity of i against j [m/s].
    pub velocity: f64,
    /// Tangential velocity of the contact point [m/s].
    pub contact_velocity: f64,
    /// Tangential force on i along y [N].
    pub force: f64,
    /// Angular velocities of i and j about z [rad/s].
    pub angular_velocities: [f64; 2],
}

/// Velocity of i against j, and the angular velocities.
#[derive(Clone, Copy, Debug)]
pub(super) struct RelativeMotion {
    pub velocity: Vector3,
    pub angular_velocities: [Vector3; 2],
}

const X: Vector3 = Vector3::new(1.0, 0.0, 0.0);

impl RelativeMotion {
    /// Before the collision.
    pub fn before(velocity: f64, incidence: &Incidence) -> Self {
        let (normal, across) = (elementary::cos(incidence.angle), elementary::sin(incidence.angle));
        Self {
            velocity: Vector3::new(-velocity * normal, velocity * across, 0.0),
            angular_velocities: incidence.spins.map(|[x, y, z]| Vector3::new(x, y, z)),
        }
    }

    /// As the particles move now.
    pub fn now(simulation: &Simulation) -> Self {
        let particles = simulation.particles();
        let rows = particles.rows_by_id();
        let at = |number: usize| {
            let row = rows.get(number).copied();
            let of = |vector: Option<Vector3>| vector.unwrap_or_else(Vector3::zero);
            (
                of(row.map(|row| particles.velocities()[row])),
                of(row.map(|row| particles.angular_velocities()[row])),
            )
        };
        let (one, other) = (at(0), at(1));
        Self { velocity: one.0 - other.0, angular_velocities: [one.1, other.1] }
    }

    /// Velocity of the contact point across x [m/s].
    fn contact_velocity(&self, bodies: &Bodies) -> Vector3 {
        let [i, j] = radii(bodies);
        let surface = self.angular_velocities[0] * i + self.angular_velocities[1] * j;
        self.velocity.tangential_to(X) + X.cross(surface)
    }

    pub fn sample(&self, bodies: &Bodies, force: f64) -> ObliqueSample {
        ObliqueSample {
            velocity: self.velocity.y,
            contact_velocity: self.contact_velocity(bodies).y,
            force,
            angular_velocities: self.angular_velocities.map(|spin| spin.z),
        }
    }
}

fn radii(bodies: &Bodies) -> [f64; 2] {
    match bodies {
        Bodies::Pair([i, j]) => [i.radius, j.radius],
        Bodies::Wall(sphere) => [sphere.radius, 0.0],
    }
}

/// Linear and angular momentum, each with the sum of the magnitudes of its parts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Momenta {
    linear: (Vector3, f64),
    angular: (Vector3, f64),
}

impl Momenta {
    /// Those of all particles about their centre of mass.
    pub fn of(particles: &Particles) -> Self {
        let mut momenta = Self { linear: (Vector3::zero(), 0.0), angular: (Vector3::zero(), 0.0) };
        let centre = particles.centre_of_mass();
        for (row, (mass, radius)) in particles.masses().iter().zip(particles.radii()).enumerate() {
            let linear = particles.velocities()[row] * *mass;
            let orbital = (particles.positions()[row] - centre).cross(linear);
            let spin = particles.angular_velocities()[row] * (0.4 * mass * radius * radius);
            momenta.linear = (momenta.linear.0 + linear, momenta.linear.1 + linear.norm());
            momenta.angular =
                (momenta.angular.0 + orbital + spin, momenta.angular.1 + orbital.norm() + spin.norm());
        }
        momenta
    }

    /// Changes since `before`, over the larger sum of magnitudes.
    fn errors_since(&self, before: &Self) -> [f64; 2] {
        let error = |now: (Vector3, f64), before: (Vector3, f64)| {
            let (change, scale) = ((now.0 - before.0).norm(), now.1.max(before.1));
            if scale > 0.0 { change / scale } else { 0.0 }
        };
        [error(self.linear, before.linear), error(self.angular, before.angular)]
    }
}

/// What the collision has made of the motion before.
pub(super) fn outcome(
    problem: &Problem<'_>,
    incidence: &Incidence,
    simulation: &Simulation,
    momenta: &Momenta,
) -> ObliqueOutcome {
    let bodies = problem.bodies;
    let before = RelativeMotion::before(problem.velocity, incidence);
    let after = RelativeMotion::now(simulation);
    let contact = [before.contact_velocity(bodies), after.contact_velocity(bodies)];
    let square = contact[0].norm_squared();
    // A sine of zero degrees is zero.
    let moves = before.velocity.y != 0.0;
    ObliqueOutcome {
        restitution_tangential: moves.then(|| after.velocity.y / before.velocity.y),
        contact_velocities: contact.map(|velocity| velocity.y),
        restitution_contact: (square > 0.0).then(|| 0.0 - contact[1].dot(contact[0]) / square),
        rebound_angle: elementary::atan2(after.velocity.y, after.velocity.x),
        rebound_angle_contact: elementary::atan2(contact[1].y, after.velocity.x),
        impulse_ratio: (before.velocity.y - after.velocity.y) / (after.velocity.x - before.velocity.x),
        angular_velocities: after.angular_velocities,
        momentum_errors: matches!(bodies, Bodies::Pair(_))
            .then(|| Momenta::of(simulation.particles()).errors_since(momenta)),
    }
}
