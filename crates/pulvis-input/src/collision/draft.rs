//! The collisions of one contact, from what was read.

use super::speed::Speed;
use super::sweep::Sweep;
use super::{Bodies, CollisionCase, Incidence, Method};
use crate::context::Reported;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::surroundings::Surroundings;
use pulvis_contact::ContactModel;

/// A collision whose speed is not yet known.
pub(super) struct Draft {
    pub(super) bodies: Bodies,
    pub(super) incidence: Option<Incidence>,
    pub(super) method: Method,
    pub(super) contact: ContactModel,
    pub(super) contact_number: usize,
    pub(super) surroundings: Surroundings,
}

/// Contact times for which a pair that stuck is followed at most: its motion has long been told by then.
const LONGEST_FOLLOWED: f64 = 1000.0;

impl Draft {
    /// Whether a pair that stuck can be followed for `time` [s].
    pub(super) fn can_follow(&self, table: &TableReader<'_>, time: f64) -> Result<f64, Reported> {
        let (body, partner) = self.bodies.masses_and_radii();
        let contact_time = self.contact.shortest_contact_time(body, partner);
        let most = LONGEST_FOLLOWED * contact_time;
        if time <= most {
            return Ok(time);
        }
        let found = format!(
            "{time} s is more than {LONGEST_FOLLOWED} times the shortest contact, {contact_time:.4e} s"
        );
        Err(table.refuse("time_after_sticking", Problem::rule(found, format!("{most:.4e} s or less"))))
    }

    pub(super) fn cases(
        &self,
        table: &TableReader<'_>,
        speed: Option<&Speed>,
        sweep: &Sweep,
        sweeping: bool,
    ) -> Result<Vec<CollisionCase>, Reported> {
        let swept = sweep.points.first().is_some_and(|point| point.speed.is_some());
        match (speed, swept) {
            (Some(speed), true) => {
                let problem = Problem::rule("given beside a sweep over the speed", "one of the two");
                return Err(table.refuse_at(&speed.location, problem));
            }
            (None, false) => {
                let expected = "a velocity [m/s], or `chi`, `zeta`, or a sweep over one of them".to_owned();
                let problem = Problem::MissingKey { key: "velocity".to_owned(), expected };
                return Err(table.refuse_with_help(
                    "velocity",
                    problem,
                    "add for example `velocity = \"0.1 m/s\"`",
                ));
            }
            _ => {}
        }
        let one = |speed: &Speed, value: Option<f64>| -> Result<CollisionCase, Reported> {
            let velocity = speed.velocity(&self.contact, &self.bodies, self.incidence);
            let velocity = velocity.map_err(|problem| table.refuse_at(&speed.location, problem))?;
            let value = value.unwrap_or(velocity);
            Ok(CollisionCase {
                value,
                velocity,
                incidence: self.incidence,
                bodies: self.bodies,
                contact: self.contact,
                contact_number: self.contact_number,
                method: self.method,
                surroundings: self.surroundings.clone(),
            })
        };
        match speed {
            Some(speed) if sweep.points.is_empty() || !sweeping => Ok(vec![one(speed, None)?]),
            Some(speed) => {
                let base = one(speed, None)?;
                Ok(sweep
                    .points
                    .iter()
                    .map(|point| CollisionCase { value: point.value, ..base.clone() })
                    .collect())
            }
            None => {
                let points = sweep.points.iter();
                points.filter_map(|point| Some(one(point.speed.as_ref()?, Some(point.value)))).collect()
            }
        }
    }
}
