//! Two bodies in the engine, for motions that have a closed form.

use pulvis_contact::noncontact::Reversible;
use pulvis_contact::{ContactModel, NonContact};
use pulvis_core::walls::Wall;
use pulvis_core::{Background, Domain, Interactions, Particle, Setup, Simulation};
use pulvis_math::Vector3;

/// One of two equal solid spheres, or a sphere at a wall; the line of centres lies along x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub mass: f64,
    pub radius: f64,
    /// Whether the partner is a sphere, which then moves the other way.
    pub with_partner: bool,
    /// Overlap at the start [m].
    pub overlap: f64,
    /// Acceleration of gravity, towards the wall [m/s²].
    pub gravity: f64,
    /// Velocity [m/s] and angular velocity [rad/s] of the first sphere.
    pub velocity: Vector3,
    pub angular_velocity: Vector3,
}

impl Start {
    /// The simulation with this contact in steps of `time_step` [s].
    pub fn simulation(&self, model: &ContactModel, time_step: f64) -> Option<Simulation> {
        let mut interactions = Interactions::new(1);
        interactions.set(0, 0, *model);
        let sphere = |x: f64, sign: f64| Particle {
            material: 0,
            radius: self.radius,
            mass: self.mass,
            position: Vector3::new(x, 0.0, 0.0),
            velocity: self.velocity * sign,
            angular_velocity: self.angular_velocity * sign,
        };
        let (mut particles, mut walls) = (vec![sphere(self.radius - self.overlap, 1.0)], Vec::new());
        if self.with_partner {
            particles.push(sphere(-self.radius, -1.0));
        } else {
            walls.push(Wall::fixed("wall", 0, Vector3::zero(), Vector3::new(1.0, 0.0, 0.0)));
        }
        let background =
            Background { gravity: Vector3::new(-self.gravity, 0.0, 0.0), ..Background::default() };
        let domain = Domain::unbounded();
        Simulation::new(Setup { particles, interactions, walls, domain, background, time_step }).ok()
    }
}

/// Velocities and angular velocities of the first sphere, less those of the second.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relative {
    pub velocity: Vector3,
    pub angular_velocity: Vector3,
    /// The sum of both angular velocities, which moves the contact point [rad/s].
    pub common_angular_velocity: Vector3,
}

pub(super) fn relative(simulation: &Simulation) -> Relative {
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let (velocity, turning) = (particles.velocities(), particles.angular_velocities());
    let (first, spin) = (velocity[rows[0]], turning[rows[0]]);
    let (second, other) =
        rows.get(1).map_or((Vector3::zero(), Vector3::zero()), |row| (velocity[*row], turning[*row]));
    Relative {
        velocity: first - second,
        angular_velocity: spin - other,
        common_angular_velocity: spin + other,
    }
}

impl Relative {
    /// Velocity of the contact point along y [m/s].
    pub fn sliding(&self, radius: f64) -> f64 {
        self.velocity.y - radius * self.common_angular_velocity.z
    }
}

/// A linear spring pulled together by a constant attraction, so that it rests at the overlap [m].
pub(super) fn held_together(mut model: ContactModel, stiffness: f64, overlap: f64) -> ContactModel {
    model.laws.noncontact = NonContact::Reversible(Reversible { f_a: stiffness * overlap, kc_a: stiffness });
    model
}

/// Angular frequency [rad/s] of a coordinate, near `expected`, extrapolated to steps of no length: velocity-Verlet is
/// fast by (ω dt)²/24.
pub(super) fn frequency(
    expected: f64,
    start: impl Fn(f64) -> Option<Simulation>,
    coordinate: impl Fn(&Relative) -> f64,
) -> Option<f64> {
    let measured = |steps: f64| {
        let time_step = std::f64::consts::TAU / expected / steps;
        let mut simulation = start(time_step)?;
        let mut crossings = Vec::new();
        let (mut before, mut time) = (coordinate(&relative(&simulation)), 0.0);
        for _ in 0..(30.0 * steps) as u64 {
            simulation.step().ok()?;
            let now = coordinate(&relative(&simulation));
            if before < 0.0 && now >= 0.0 {
                crossings.push(time + time_step * before / (before - now));
            }
            (before, time) = (now, time + time_step);
        }
        let (first, last) = (crossings.first()?, crossings.get(20)?);
        Some(20.0 * std::f64::consts::TAU / (last - first))
    };
    let (coarse, fine) = (measured(100.0)?, measured(200.0)?);
    Some(fine + (fine - coarse) / 3.0)
}
