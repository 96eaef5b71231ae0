//! Two spheres, or a sphere and a fixed plane wall, moved by their contact: a small synchronised
//! velocity-Verlet method, for motions that have a closed form.

use pulvis_contact::{ContactKinematics, ContactModel};
use pulvis_math::Vector3;

use crate::live::{LiveContact, Springs};
use crate::parameters::pair_of;

/// A solid sphere.
#[derive(Clone, Copy, Debug)]
pub struct Sphere {
    /// Mass [kg].
    pub mass: f64,
    /// Radius [m].
    pub radius: f64,
    /// Position of the centre [m].
    pub position: Vector3,
    /// Velocity [m/s].
    pub velocity: Vector3,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector3,
}

impl Sphere {
    /// A sphere at rest.
    pub fn at_rest(mass: f64, radius: f64, position: Vector3) -> Self {
        Self { mass, radius, position, velocity: Vector3::zero(), angular_velocity: Vector3::zero() }
    }

    /// Moment of inertia, 2/5 m a² [kg m^2].
    pub fn inertia(&self) -> f64 {
        0.4 * self.mass * self.radius * self.radius
    }

    fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.velocity.norm_squared()
            + 0.5 * self.inertia() * self.angular_velocity.norm_squared()
    }
}

/// Where a body is and how it moves, now and at the middle of the step that led there.
#[derive(Clone, Copy, Debug, Default)]
pub struct Kinematics {
    /// Position [m].
    pub position: Vector3,
    /// Velocity [m/s].
    pub velocity: Vector3,
    /// Velocity at mid-step [m/s].
    pub velocity_mid: Vector3,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector3,
    /// Angular velocity at mid-step [rad/s].
    pub angular_velocity_mid: Vector3,
}

/// The motion of a sphere of `radius_i` [m] and of a second one, or the plane wall through the origin with
/// the normal z.
pub fn pair_motion(
    radius_i: f64,
    i: &Kinematics,
    second: Option<(f64, &Kinematics)>,
) -> ContactKinematics<f64> {
    let resting = Kinematics::default();
    let (radius_j, j) = second.unwrap_or((0.0, &resting));
    let between = i.position - j.position;
    let (normal, distance, inverse_distance) = match second {
        Some(_) => (between * (1.0 / between.norm()), between.norm(), 1.0 / between.norm()),
        None => (Vector3::new(0.0, 0.0, 1.0), between.z, 0.0),
    };
    ContactKinematics {
        normal,
        overlap: radius_i + radius_j - distance,
        inverse_distance,
        normal_rate: None,
        radius_i,
        radius_j,
        velocity: i.velocity - j.velocity,
        velocity_mid: i.velocity_mid - j.velocity_mid,
        angular_velocity_i: i.angular_velocity,
        angular_velocity_j: j.angular_velocity,
        angular_velocity_i_mid: i.angular_velocity_mid,
        angular_velocity_j_mid: j.angular_velocity_mid,
    }
}

/// Two bodies in motion.
pub struct Couple {
    /// The first sphere.
    pub i: Sphere,
    /// The second sphere; `None`: the plane wall through the origin with the normal z.
    pub j: Option<Sphere>,
    /// Acceleration of gravity [m/s^2].
    pub gravity: Vector3,
    /// Energy that the contact stores [J].
    pub stored: f64,
    /// The part of it that the spring of the normal law holds, which an attraction may have lent [J].
    pub elastic_normal: f64,
    /// Energy that the contact has lost [J].
    pub lost: f64,
    /// Normal force of the last step, repulsion positive [N].
    pub normal_force: f64,
    /// Overlap of the last step [m].
    pub overlap: f64,
    contact: LiveContact,
    rates: [(Vector3, Vector3); 2],
    power: f64,
}

impl Couple {
    /// Bodies with the contact laws of `model` and no past.
    pub fn new(model: &ContactModel, i: Sphere, j: Option<Sphere>) -> Self {
        let pair = pair_of((i.mass, i.radius), j.map(|j| (j.mass, j.radius)));
        let zero = Vector3::zero();
        let mut couple = Self {
            i,
            j,
            gravity: zero,
            stored: 0.0,
            elastic_normal: 0.0,
            lost: 0.0,
            normal_force: 0.0,
            overlap: 0.0,
            contact: LiveContact::new(model, pair),
            rates: [(zero, zero); 2],
            power: 0.0,
        };
        couple.interact(0.0, [zero; 2], [zero; 2]);
        couple
    }

    /// Both spheres in the order i, j.
    fn spheres(&mut self) -> impl Iterator<Item = &mut Sphere> {
        std::iter::once(&mut self.i).chain(self.j.as_mut())
    }

    /// One step of `dt` [s].
    pub fn step(&mut self, dt: f64) {
        let rates = self.rates;
        let (mut velocities, mut angular_velocities) = ([Vector3::zero(); 2], [Vector3::zero(); 2]);
        for (body, sphere) in self.spheres().enumerate() {
            sphere.velocity += rates[body].0 * (0.5 * dt);
            sphere.angular_velocity += rates[body].1 * (0.5 * dt);
            sphere.position += sphere.velocity * dt;
            (velocities[body], angular_velocities[body]) = (sphere.velocity, sphere.angular_velocity);
            // What dashpots see: the velocity at the end of the step, with the old acceleration.
            sphere.velocity += rates[body].0 * (0.5 * dt);
            sphere.angular_velocity += rates[body].1 * (0.5 * dt);
        }
        self.interact(dt, velocities, angular_velocities);
        let rates = self.rates;
        for (body, sphere) in self.spheres().enumerate() {
            sphere.velocity = velocities[body] + rates[body].0 * (0.5 * dt);
            sphere.angular_velocity = angular_velocities[body] + rates[body].1 * (0.5 * dt);
        }
    }

    /// `count` steps of `dt` [s].
    pub fn steps(&mut self, count: u64, dt: f64) {
        for _ in 0..count {
            self.step(dt);
        }
    }

    fn interact(&mut self, dt: f64, velocities_mid: [Vector3; 2], surface_mid: [Vector3; 2]) {
        let kinematics = |sphere: &Sphere, body: usize| Kinematics {
            position: sphere.position,
            velocity: sphere.velocity,
            velocity_mid: velocities_mid[body],
            angular_velocity: sphere.angular_velocity,
            angular_velocity_mid: surface_mid[body],
        };
        let first = kinematics(&self.i, 0);
        let second = self.j.map(|sphere| (sphere.radius, kinematics(&sphere, 1)));
        let motion = pair_motion(self.i.radius, &first, second.as_ref().map(|(radius, j)| (*radius, j)));
        let answer = self.contact.respond(&motion, dt);
        let (i, j) = (self.i, self.j);
        self.rates[0] = (answer.force * (1.0 / i.mass) + self.gravity, answer.torque_i * (1.0 / i.inertia()));
        if let Some(j) = j {
            self.rates[1] =
                (-answer.force * (1.0 / j.mass) + self.gravity, answer.torque_j * (1.0 / j.inertia()));
        }
        let energies = answer.energies;
        self.stored = energies.stored();
        self.elastic_normal = energies.elastic_normal;
        self.lost += energies.dissipated() + 0.5 * dt * (self.power + energies.viscous_power);
        self.power = energies.viscous_power;
        self.normal_force = answer.normal_force;
        self.overlap = motion.overlap;
    }

    /// The contact with its memory.
    pub fn contact(&self) -> &LiveContact {
        &self.contact
    }

    /// The springs of the contact.
    pub fn springs(&self) -> Springs {
        self.contact.springs()
    }

    /// Kinetic energy of both bodies [J].
    pub fn kinetic_energy(&self) -> f64 {
        self.i.kinetic_energy() + self.j.map_or(0.0, |sphere| sphere.kinetic_energy())
    }

    /// Velocity of body i at the point of contact relative to body j, along the contact plane, with
    /// uncorrected lever arms [m/s].
    pub fn contact_point_velocity(&self) -> Vector3 {
        let (j, velocity_j, radius_j, angular_velocity_j) = match self.j {
            Some(j) => (j.position, j.velocity, j.radius, j.angular_velocity),
            None => (
                Vector3::new(self.i.position.x, self.i.position.y, 0.0),
                Vector3::zero(),
                0.0,
                Vector3::zero(),
            ),
        };
        let between = self.i.position - j;
        let normal = between * (1.0 / between.norm());
        (self.i.velocity - velocity_j).tangential_to(normal)
            + normal.cross(self.i.angular_velocity * self.i.radius + angular_velocity_j * radius_j)
    }

    /// Steps until `done` says so, at most `limit` steps; returns the number of steps.
    pub fn step_until(&mut self, dt: f64, limit: u64, mut done: impl FnMut(&Self) -> bool) -> u64 {
        for step in 1..=limit {
            self.step(dt);
            if done(self) {
                return step;
            }
        }
        panic!("the motion did not come to its end in {limit} steps");
    }
}
