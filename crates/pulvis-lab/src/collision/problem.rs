//! One collision, as both methods see it.

use pulvis_contact::{ContactModel, Pair};
use pulvis_input::Surroundings;
use pulvis_input::collision::{Bodies, CollisionCase, Incidence};
use pulvis_math::elementary;

/// One collision with what follows from its bodies and laws.
pub(super) struct Problem<'c> {
    pub contact: &'c ContactModel,
    pub bodies: &'c Bodies,
    pub pair: Pair,
    pub surroundings: &'c Surroundings,
    /// Relative speed outside the range of all forces [m/s].
    pub velocity: f64,
    /// Its part along the line of centres [m/s].
    pub normal_velocity: f64,
    /// Angle and spins of an oblique collision.
    pub incidence: Option<Incidence>,
    /// Shortest duration of any motion of the contact [s].
    pub shortest_time: f64,
}

impl<'c> Problem<'c> {
    pub fn new(case: &'c CollisionCase) -> Self {
        let (i, j) = case.bodies.masses_and_radii();
        // A law without a steepest slope takes its stiffness from what this collision will bring.
        let mut expecting = case.contact;
        expecting.laws.expected.speed = expecting.laws.expected.speed.max(case.normal_velocity());
        Self {
            contact: &case.contact,
            bodies: &case.bodies,
            pair: case.bodies.pair().with_quantities(case.surroundings.quantities_of(&case.contact)),
            surroundings: &case.surroundings,
            velocity: case.velocity,
            normal_velocity: case.normal_velocity(),
            incidence: case.incidence,
            shortest_time: expecting.shortest_contact_time(i, j),
        }
    }

    /// Whether a dashpot acts along the line of centres, be it the normal law's own or a bond's.
    pub fn is_damped(&self) -> bool {
        let own = self.contact.normal.dashpot(&self.pair, &self.contact.laws.expected);
        let bond = self.contact.laws.bond;
        bond.is_some_and(|bond| bond.springs.has_dashpot())
            || own + self.contact.laws.viscosity.largest_coefficient(&self.pair, self.stiffness_scale()) > 0.0
    }

    /// Kinetic energy of the relative motion [J].
    pub fn kinetic(&self, velocity: f64) -> f64 {
        0.5 * self.pair.reduced_mass() * velocity * velocity
    }

    /// How far beyond touching the contact acts [m].
    pub fn interaction_range(&self) -> f64 {
        self.contact.interaction_range(&self.pair, self.bodies.radii())
    }

    /// Where the bodies begin to feel each other on approach: an attraction that sets in with touch is
    /// not felt before it [m].
    pub fn start_overlap(&self) -> f64 {
        let attraction = &self.contact.laws.noncontact;
        if attraction.acts_on_approach() { 0.0 - attraction.interaction_range(&self.pair) } else { 0.0 }
    }

    /// The stiffness that belongs to the shortest time, m_r (π/t)² [N/m].
    pub fn stiffness_scale(&self) -> f64 {
        self.pair.reduced_mass() * elementary::powi(std::f64::consts::PI / self.shortest_time, 2)
    }
}
