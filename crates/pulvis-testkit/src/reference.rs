//! A slow, obvious engine: every pair in every step, one contact at a time, no lists, no chunks, no skins and no
//! vectors. What the fast engine is held against.
//!
//! It shares with the fast engine the text of the contact laws and nothing else.

use std::collections::BTreeMap;

use pulvis_contact::{ContactKinematics, ContactModel, MemoryLayout, Pair};
use pulvis_math::Vector3;

/// A sphere.
#[derive(Clone, Copy, Debug)]
pub struct Body {
    /// Its name: contacts take the body of the lower id for their first.
    pub id: u32,
    /// Index of its material.
    pub material: u16,
    /// Radius [m].
    pub radius: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Position of the centre, not wrapped [m].
    pub position: Vector3,
    /// Velocity, in the laboratory and not relative to a shear [m/s].
    pub velocity: Vector3,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector3,
}

/// A plane wall that moves with a constant velocity.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// Index of its material.
    pub material: u16,
    /// A point of the plane [m].
    pub point: Vector3,
    /// Unit normal, pointing to the particles.
    pub normal: Vector3,
    /// Velocity [m/s].
    pub velocity: Vector3,
}

/// What a contact is between.
type Bodies = (u32, Second);

/// The second body of a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Second {
    /// A sphere, by its id.
    Sphere(u32),
    /// A wall, by its index.
    Wall(usize),
}

/// Contact models by pair of materials, the smaller index first.
pub type Models = BTreeMap<(u16, u16), ContactModel>;

/// The engine.
#[derive(Clone, Debug)]
pub struct ReferenceEngine {
    /// The spheres, in any order.
    pub bodies: Vec<Body>,
    /// The walls.
    pub planes: Vec<Plane>,
    /// Periods along x, y, z [m].
    pub periods: [Option<f64>; 3],
    /// Acceleration of gravity [m/s²].
    pub gravity: Vector3,
    /// Time step [s].
    pub time_step: f64,
    models: Models,
    /// Velocity of the next image along y, along x [m/s], and how far it has come [m]: Lees and Edwards, J. Phys. C 5, 1921
    /// (1972). It is never brought back by a period.
    image_velocity: f64,
    image_shift: f64,
    memory: BTreeMap<Bodies, (MemoryLayout, Vec<f64>)>,
    forces: BTreeMap<u32, (Vector3, Vector3)>,
    /// Energy that contacts have lost to everything but dashpots [J].
    pub dissipated: f64,
    /// How many contacts have been computed, over all steps.
    pub contacts: u64,
}

/// Velocities of a body at mid-step and at the time of its position.
#[derive(Clone, Copy)]
struct Motion {
    mid: Vector3,
    now: Vector3,
    turning_mid: Vector3,
    turning: Vector3,
}

impl ReferenceEngine {
    /// At the state of the bodies, with virgin contacts.
    pub fn new(
        bodies: Vec<Body>,
        planes: Vec<Plane>,
        periods: [Option<f64>; 3],
        gravity: Vector3,
        time_step: f64,
        models: Models,
    ) -> Self {
        let mut engine = Self {
            bodies,
            planes,
            periods,
            gravity,
            time_step,
            models,
            image_velocity: 0.0,
            image_shift: 0.0,
            memory: BTreeMap::new(),
            forces: BTreeMap::new(),
            dissipated: 0.0,
            contacts: 0,
        };
        engine.evaluate_at_rest();
        engine.dissipated = 0.0;
        engine
    }

    /// Other contact models from now on; contacts keep what the same law remembers.
    pub fn set_models(&mut self, models: Models) {
        self.models = models;
        self.evaluate_at_rest();
    }

    /// Shears from now on: the images along y move along x at this rate times their distance [1/s]. All bodies get the
    /// velocity of the shear at their place, zero at the height `middle` [m].
    pub fn shear(&mut self, rate: f64, middle: f64) {
        self.image_velocity = rate * self.periods[1].unwrap_or(0.0);
        for body in &mut self.bodies {
            body.velocity.x += rate * (body.position.y - middle);
        }
        self.evaluate_at_rest();
    }

    /// Takes bodies away, with their contacts.
    pub fn remove(&mut self, ids: &[u32]) {
        self.bodies.retain(|body| !ids.contains(&body.id));
        let gone = |bodies: &Bodies| {
            ids.contains(&bodies.0) || matches!(bodies.1, Second::Sphere(id) if ids.contains(&id))
        };
        self.memory.retain(|bodies, _| !gone(bodies));
        self.evaluate_at_rest();
    }

    /// The body of an id.
    pub fn body(&self, id: u32) -> Option<&Body> {
        self.bodies.iter().find(|body| body.id == id)
    }

    /// What a contact remembers, if it remembers anything.
    pub fn columns(&self, bodies: Bodies) -> Option<&[f64]> {
        self.memory.get(&bodies).map(|(_, columns)| &columns[..])
    }

    /// One step of synchronised velocity-Verlet.
    pub fn step(&mut self) {
        let dt = self.time_step;
        let mut motions = BTreeMap::new();
        for body in &mut self.bodies {
            let (force, torque) = self.forces[&body.id];
            let kick = (force * (0.5 * dt / body.mass), torque * (0.5 * dt / inertia(body)));
            let (mid, turning_mid) = (body.velocity + kick.0, body.angular_velocity + kick.1);
            body.position += mid * dt;
            let motion = Motion { mid, now: mid + kick.0, turning_mid, turning: turning_mid + kick.1 };
            motions.insert(body.id, motion);
        }
        for plane in &mut self.planes {
            plane.point += plane.velocity * dt;
        }
        self.image_shift += self.image_velocity * dt;
        self.sum_forces(&motions, dt);
        for body in &mut self.bodies {
            let (force, torque) = self.forces[&body.id];
            let Motion { mid, turning_mid, .. } = motions[&body.id];
            body.velocity = mid + force * (0.5 * dt / body.mass);
            body.angular_velocity = turning_mid + torque * (0.5 * dt / inertia(body));
        }
    }

    /// Forces of the present state, without a step having led here.
    fn evaluate_at_rest(&mut self) {
        let still = |body: &Body| Motion {
            mid: body.velocity,
            now: body.velocity,
            turning_mid: body.angular_velocity,
            turning: body.angular_velocity,
        };
        let motions = self.bodies.iter().map(|body| (body.id, still(body))).collect();
        self.sum_forces(&motions, 0.0);
    }

    fn sum_forces(&mut self, motions: &BTreeMap<u32, Motion>, dt: f64) {
        let weight = |body: &Body| (body.id, (self.gravity * body.mass, Vector3::zero()));
        self.forces = self.bodies.iter().map(weight).collect();
        let mut sorted = self.bodies.clone();
        sorted.sort_by_key(|body| body.id);
        for (index, i) in sorted.iter().enumerate() {
            for j in &sorted[index + 1..] {
                self.sphere_contact(i, j, [motions[&i.id], motions[&j.id]], dt);
            }
            for wall in 0..self.planes.len() {
                self.wall_contact(i, wall, motions[&i.id], dt);
            }
        }
    }

    fn sphere_contact(&mut self, i: &Body, j: &Body, [of_i, of_j]: [Motion; 2], dt: f64) {
        let (separation, jump) = self.nearest(i.position - j.position);
        let distance = separation.norm();
        let motion = ContactKinematics {
            normal: separation * (1.0 / distance),
            overlap: i.radius + j.radius - distance,
            inverse_distance: 1.0 / distance,
            normal_rate: None,
            radius_i: i.radius,
            radius_j: j.radius,
            velocity: of_i.now - of_j.now + jump,
            velocity_mid: of_i.mid - of_j.mid + jump,
            angular_velocity_i: of_i.turning,
            angular_velocity_j: of_j.turning,
            angular_velocity_i_mid: of_i.turning_mid,
            angular_velocity_j_mid: of_j.turning_mid,
        };
        let pair = Pair::spheres(i.mass, j.mass, i.radius, j.radius);
        let materials = (i.material, j.material);
        self.respond((i.id, Second::Sphere(j.id)), materials, &pair, &motion, dt);
    }

    fn wall_contact(&mut self, i: &Body, wall: usize, of_i: Motion, dt: f64) {
        let plane = self.planes[wall];
        let motion = ContactKinematics {
            normal: plane.normal,
            overlap: i.radius - (i.position - plane.point).dot(plane.normal),
            inverse_distance: 0.0,
            normal_rate: None,
            radius_i: i.radius,
            radius_j: 0.0,
            velocity: of_i.now - plane.velocity,
            velocity_mid: of_i.mid - plane.velocity,
            angular_velocity_i: of_i.turning,
            angular_velocity_j: Vector3::zero(),
            angular_velocity_i_mid: of_i.turning_mid,
            angular_velocity_j_mid: Vector3::zero(),
        };
        let pair = Pair::wall(i.mass, i.radius);
        self.respond((i.id, Second::Wall(wall)), (i.material, plane.material), &pair, &motion, dt);
    }

    /// Asks the laws of one contact, and adds its forces.
    fn respond(
        &mut self,
        bodies: Bodies,
        (one, other): (u16, u16),
        pair: &Pair,
        motion: &ContactKinematics<f64>,
        dt: f64,
    ) {
        let model = self.models[&(one.min(other), one.max(other))];
        let layout = model.memory_layout();
        let known = self.memory.remove(&bodies);
        if motion.overlap <= -model.interaction_range(pair, [motion.radius_i, motion.radius_j])
            && known.is_none()
        {
            return;
        }
        let mut columns = match known {
            Some((before, columns)) if before == layout => columns,
            Some((before, columns)) => layout.translate(&before, &columns),
            None => vec![0.0; layout.columns()],
        };
        self.contacts += 1;
        let answer = model.respond(pair, motion, dt, &mut columns);
        if columns.iter().any(|&column| column != 0.0) {
            self.memory.insert(bodies, (layout, columns));
        }
        self.dissipated += answer.energies.dissipated();
        self.add(bodies.0, answer.force, answer.torque_i);
        if let Second::Sphere(second) = bodies.1 {
            self.add(second, -answer.force, answer.torque_j);
        }
    }

    fn add(&mut self, id: u32, force: Vector3, torque: Vector3) {
        let sum = self.forces.entry(id).or_default();
        sum.0 += force;
        sum.1 += torque;
    }

    /// The shortest of the vectors that differ from `separation` by whole periods, and what its image adds to the
    /// relative velocity.
    fn nearest(&self, mut separation: Vector3) -> (Vector3, Vector3) {
        let turns = |axis: usize, along: f64| match self.periods[axis] {
            Some(period) => [(along / period).round(), period],
            None => [0.0; 2],
        };
        // Along y first: its images are shifted along x.
        let [rows, period] = turns(1, separation.y);
        separation.y -= rows * period;
        separation.x -= rows * self.image_shift;
        for axis in [0, 2] {
            let [columns, period] = turns(axis, separation[axis]);
            *separation.component_mut(axis) -= columns * period;
        }
        (separation, Vector3::new(-rows * self.image_velocity, 0.0, 0.0))
    }
}

/// Moment of inertia of a solid sphere [kg m²].
fn inertia(body: &Body) -> f64 {
    0.4 * body.mass * body.radius * body.radius
}
