//! Contacts by the names of their laws, on a path, or in a collision.

use pulvis_contact::catalogue::{Role, Values};
use pulvis_contact::normal::NormalSource;
use pulvis_contact::{
    ContactKinematics, ContactModel, ContactResponse, Linear, NonContact, Normal, NormalMotion,
    NormalResponse, Pair, ROOM_TEMPERATURE, Viscosity, bond, friction,
};
use pulvis_input::collision::{Bodies, CollisionCase, Method, Sphere};
use pulvis_input::{BodyQuantity, Surroundings};
use pulvis_math::Vector3;

use crate::collision::{Observation, Outcome, collide};

/// The normal law called `name`, if it takes these numbers.
pub(super) fn normal(name: &str, numbers: &[(&str, f64)]) -> Option<ContactModel> {
    normal_by(name, &values(numbers))
}

/// The normal law called `name`, if it takes these values.
pub(super) fn normal_by(name: &str, values: &Values) -> Option<ContactModel> {
    Normal::build(name, values)?.ok().map(ContactModel::frictionless)
}

/// The contact with a dashpot.
pub(super) fn damped(mut model: ContactModel, name: &str, numbers: &[(&str, f64)]) -> Option<ContactModel> {
    model.laws.viscosity = Viscosity::build(name, &values(numbers))?.ok()?;
    Some(model)
}

/// The contact with a law against sliding, rolling or torsion.
pub(super) fn resisted(
    model: ContactModel,
    role: Role,
    name: &str,
    numbers: &[(&str, f64)],
) -> Option<ContactModel> {
    resisted_by(model, role, name, &values(numbers))
}

/// The same with values that are not all numbers.
pub(super) fn resisted_by(
    mut model: ContactModel,
    role: Role,
    name: &str,
    values: &Values,
) -> Option<ContactModel> {
    let law = friction::build(role, name, values)?.ok()?;
    match role {
        Role::Rolling => model.laws.rolling = law,
        Role::Torsion => model.laws.torsion = law,
        _ => model.laws.sliding = law,
    }
    Some(model)
}

/// An attraction beside a spring that is hardly felt.
pub(super) fn attraction(name: &str, numbers: &[(&str, f64)]) -> Option<ContactModel> {
    let mut model = ContactModel::frictionless(Linear::new(f64::MIN_POSITIVE, 0.0));
    model.laws.noncontact = NonContact::build(name, &values(numbers))?.ok()?;
    Some(model)
}

/// A bond that forms by touch, beside a spring that is hardly felt.
pub(super) fn bonded(name: &str, numbers: &[(&str, f64)]) -> Option<ContactModel> {
    let mut model = ContactModel::frictionless(Linear::new(f64::MIN_POSITIVE, 0.0));
    let values = values(numbers).with_choice("form", "first-touch");
    model.laws.bond = bond::build(name, &values)?.ok()?;
    Some(model)
}

pub(super) fn values(numbers: &[(&str, f64)]) -> Values {
    numbers.iter().fold(Values::new(), |values, (name, number)| values.with(name, *number))
}

/// A sphere that meets a wall: the mass [kg] is the reduced one, the radius [m] the effective one.
pub(super) fn wall(mass: f64, radius: f64) -> Bodies {
    Bodies::Wall(Sphere { radius, mass })
}

/// How a collision at the relative speed [m/s] ends.
pub(super) fn outcome(model: &ContactModel, bodies: Bodies, velocity: f64) -> Option<Outcome> {
    by_method(model, bodies, velocity, Method::Exact)
}

/// The same by steps of the engine.
pub(super) fn by_method(
    model: &ContactModel,
    bodies: Bodies,
    velocity: f64,
    method: Method,
) -> Option<Outcome> {
    by_method_with(model, bodies, velocity, method, Surroundings::default())
}

/// How a collision between bodies that have a quantity with these values ends.
pub(super) fn outcome_with(
    model: &ContactModel,
    bodies: Bodies,
    velocity: f64,
    (name, values): (&'static str, [f64; 2]),
) -> Option<Outcome> {
    let quantities = vec![BodyQuantity { name, unit: String::new(), values }];
    let surroundings = Surroundings { quantities, ..Surroundings::default() };
    by_method_with(model, bodies, velocity, Method::Exact, surroundings)
}

fn by_method_with(
    model: &ContactModel,
    bodies: Bodies,
    velocity: f64,
    method: Method,
    surroundings: Surroundings,
) -> Option<Outcome> {
    let case = CollisionCase {
        value: velocity,
        velocity,
        incidence: None,
        bodies,
        contact: *model,
        contact_number: 0,
        method,
        surroundings,
    };
    collide(&case, &Observation::default()).ok().map(|collision| collision.outcome)
}

/// The coefficient of restitution.
pub(super) fn restitution(model: &ContactModel, bodies: Bodies, velocity: f64) -> Option<f64> {
    outcome(model, bodies, velocity).map(|outcome| outcome.restitution)
}

/// A contact on a path of overlaps, at rest at each of them.
#[derive(Clone, Debug)]
pub(super) struct Path {
    model: ContactModel,
    pair: Pair,
    /// Radii of the two bodies, of a wall zero [m].
    radii: [f64; 2],
    columns: Vec<f64>,
    overlap: f64,
    /// Temperature [K].
    pub temperature: f64,
    /// Lost to plastic deformation and adhesion so far [J].
    pub lost: f64,
    /// What the contact stores, attractions included [J].
    pub stored: f64,
}

impl Path {
    fn new(model: &ContactModel, pair: Pair, radii: [f64; 2]) -> Self {
        let columns = vec![0.0; model.memory_layout().columns()];
        let (overlap, temperature) = (-f64::MIN_POSITIVE, ROOM_TEMPERATURE);
        Self { model: *model, pair, radii, columns, overlap, temperature, lost: 0.0, stored: 0.0 }
    }

    /// Between a sphere and a wall: the radius is the effective one [m].
    pub fn at_wall(model: &ContactModel, radius: f64) -> Self {
        Self::new(model, Pair::wall(1.0, radius), [radius, 0.0])
    }

    /// Between two spheres with radii [m].
    pub fn between(model: &ContactModel, first: f64, second: f64) -> Self {
        Self::new(model, Pair::spheres(1.0, 1.0, first, second), [first, second])
    }

    /// The same between bodies that have a quantity with these values; no other.
    pub fn with(mut self, name: &str, values: [f64; 2]) -> Self {
        let quantities = self.model.quantities(|known| if known == name { values } else { [0.0; 2] });
        self.pair = self.pair.with_quantities(quantities);
        self
    }

    /// Goes to an overlap [m] in one step.
    pub fn go(&mut self, overlap: f64) -> ContactResponse<f64> {
        self.go_in(overlap, 0.0)
    }

    /// Goes to an overlap [m] in one step of a duration [s].
    pub fn go_in(&mut self, overlap: f64, duration: f64) -> ContactResponse<f64> {
        self.step(overlap, duration, |_| {})
    }

    /// Slides by a displacement [m] in one step; answers with the size of the tangential force [N].
    pub fn slide(&mut self, displacement: f64) -> f64 {
        self.step(self.overlap, 1.0, |motion| motion.velocity_mid.y = displacement).force.y.abs()
    }

    /// Twists by an angle [rad] in one step; answers with the size of the moment [N m].
    pub fn twist(&mut self, angle: f64) -> f64 {
        self.step(self.overlap, 1.0, |motion| motion.angular_velocity_i_mid.x = angle).torque_i.x.abs()
    }

    fn step(
        &mut self,
        overlap: f64,
        duration: f64,
        adjust: impl FnOnce(&mut ContactKinematics<f64>),
    ) -> ContactResponse<f64> {
        let (along, zero) = (|value: f64| Vector3::new(value, 0.0, 0.0), Vector3::zero());
        let opening = if duration > 0.0 { (self.overlap - overlap) / duration } else { 0.0 };
        let mut motion = ContactKinematics {
            normal: along(1.0),
            overlap,
            inverse_distance: 0.0,
            normal_rate: None,
            radius_i: self.radii[0],
            radius_j: self.radii[1],
            velocity: along(opening),
            velocity_mid: along(opening),
            angular_velocity_i: zero,
            angular_velocity_j: zero,
            angular_velocity_i_mid: zero,
            angular_velocity_j_mid: zero,
        };
        adjust(&mut motion);
        let step = [duration, self.temperature];
        let response = self.model.respond_at(&self.pair, &motion, step, &mut self.columns);
        let energies = &response.energies;
        self.overlap = overlap;
        self.lost += energies.dissipated();
        self.stored = energies.stored();
        response
    }

    /// The force [N] at an overlap [m] to which the contact goes in one step; it stays where it is.
    pub fn force(&self, overlap: f64) -> f64 {
        self.clone().go(overlap).normal_force
    }

    /// What the normal law answers at an overlap [m]; the contact stays where it is.
    pub fn normal(&self, overlap: f64) -> NormalResponse<f64> {
        let mut columns = self.columns.clone();
        let motion = NormalMotion::at_rest(&self.pair, overlap).between(self.radii[0], self.radii[1]);
        self.model.normal.respond(&motion, &mut columns[..])
    }

    /// What the contact remembers under a name (without its unit).
    pub fn column(&self, name: &str) -> Option<f64> {
        self.model.memory_layout().column(name).map(|column| self.columns[column])
    }

    /// The number of the normal law's branch at an overlap [m].
    pub fn branch(&self, overlap: f64) -> u8 {
        self.model.normal.branch(&self.pair, overlap, &self.columns).0
    }
}
