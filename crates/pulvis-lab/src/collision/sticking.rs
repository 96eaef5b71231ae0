//! The speeds at which pairs stick, found by collisions: for contacts that no closed form covers.

use super::outcome::{Observation, Regime};
use super::problem::Problem;
use super::{CollisionError, collide};
use pulvis_contact::ContactModel;
use pulvis_input::Surroundings;
use pulvis_input::collision::{Bodies, CollisionCase, Method, luding_pair};
use pulvis_math::elementary;

/// Speeds tried in each decade. Ranges that are narrower than a step between two may be missed.
const PER_DECADE: i32 = 10;

/// Decades below and above the speed of the contact that are tried.
const DECADES: [i32; 2] = [-3, 2];

/// Steps after which a collision of the search is given up: those of strongly damped pairs would go on for
/// minutes.
const MOST_STEPS: u64 = 20_000;

/// The relative speed that loads a contact to this part of the radius is the scale of contacts that have
/// no plastic limit.
const TYPICAL_OVERLAP: f64 = 0.05;

/// Relative speeds [m/s] from the lower to the upper one of each range in which two bodies that meet head on
/// stick. A lower end of zero and an infinite upper end stand for the ends of the search, which goes over
/// five decades.
///
/// Found by exact collisions and bisection to 1e-4, dashpots included; the speeds are those with which bodies come into
/// each other's reach. Laws find the temperature and the quantities that they read among the `surroundings`.
///
/// # Errors
/// A collision cannot be computed, or takes too long: the pair is overdamped.
pub fn sticking_ranges(
    bodies: Bodies,
    contact: &ContactModel,
    surroundings: &Surroundings,
) -> Result<Vec<[f64; 2]>, CollisionError> {
    let search = Search { bodies, contact, surroundings };
    let scale = search.typical_speed();
    let [first, last] = DECADES.map(|decade| decade * PER_DECADE);
    let speed = |number: i32| scale * elementary::powf(10.0, f64::from(number) / f64::from(PER_DECADE));
    let mut ranges: Vec<[f64; 2]> = Vec::new();
    let mut before = search.sticks(speed(first))?;
    if before {
        ranges.push([0.0, f64::INFINITY]);
    }
    for number in first + 1..=last {
        let now = search.sticks(speed(number))?;
        if now != before {
            let change = search.change(speed(number - 1), speed(number), now)?;
            match ranges.last_mut().filter(|_| !now) {
                Some(range) => range[1] = change,
                None => ranges.push([change, f64::INFINITY]),
            }
        }
        before = now;
    }
    Ok(ranges)
}

/// The relative speed that reaches the plastic limit of a contact, or loads it to a twentieth of the radius where it has none:
/// around it a contact shows what it does [m/s].
pub fn typical_speed(bodies: Bodies, contact: &ContactModel, surroundings: &Surroundings) -> f64 {
    Search { bodies, contact, surroundings }.typical_speed()
}

struct Search<'c> {
    bodies: Bodies,
    contact: &'c ContactModel,
    surroundings: &'c Surroundings,
}

impl Search<'_> {
    fn case(&self, velocity: f64) -> CollisionCase {
        let (bodies, contact) = (self.bodies, *self.contact);
        CollisionCase {
            value: velocity,
            velocity,
            incidence: None,
            bodies,
            contact,
            contact_number: 0,
            method: Method::Exact,
            surroundings: self.surroundings.clone(),
        }
    }

    /// The speed that reaches the plastic limit, or one that makes a small overlap [m/s].
    fn typical_speed(&self) -> f64 {
        let case = self.case(1.0);
        let problem = Problem::new(&case);
        let elastic =
            TYPICAL_OVERLAP * problem.pair.harmonic_radius() * std::f64::consts::PI / problem.shortest_time;
        let plastic = luding_pair(self.contact, &problem.pair).map(|pair| pair.v_p0());
        plastic.filter(|speed| *speed > 0.0 && speed.is_finite()).unwrap_or(elastic)
    }

    fn sticks(&self, velocity: f64) -> Result<bool, CollisionError> {
        let observation = Observation { most_steps: Some(MOST_STEPS), ..Observation::default() };
        Ok(collide(&self.case(velocity), &observation)?.outcome.regime == Regime::Stick)
    }

    /// The speed between two at which the pair begins (`sticks_above`) or ceases to stick.
    fn change(&self, mut low: f64, mut high: f64, sticks_above: bool) -> Result<f64, CollisionError> {
        while high > low * (1.0 + 1e-4) {
            let middle = (low * high).sqrt();
            if self.sticks(middle)? == sticks_above {
                high = middle;
            } else {
                low = middle;
            }
        }
        Ok((low * high).sqrt())
    }
}
