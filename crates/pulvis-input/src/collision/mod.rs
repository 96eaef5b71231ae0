//! The scenario of a collision experiment: two bodies, one contact, and a sweep over one variable.
//!
//! ```
//! use pulvis_input::collision::CollisionScenario;
//! use pulvis_input::Document;
//!
//! let text = r#"
//! [collision]
//! bodies = "wall"
//! radius = "1.1 mm"
//! density = "2000 kg/m^3"
//! [collision.sweep]
//! variable = "chi"
//! values = [0.1, 0.34, 0.69]
//! [contact.normal]
//! law = "luding"
//! k1 = "100 N/m"
//! kp = "500 N/m"
//! kc = "100 N/m"
//! phi_f = 0.05
//! "#;
//! let scenario = CollisionScenario::from_document(&Document::from_str("wall.toml", text)?)?;
//! assert_eq!(scenario.cases.len(), 3);
//! # Ok::<(), pulvis_input::InputErrors>(())
//! ```

mod bodies;
mod closed_form;
mod speed;
mod sweep;

pub use bodies::{Bodies, Sphere};
pub(crate) use bodies::{read_bodies, unfit_for_numbers};
pub use closed_form::luding_pair;
pub use sweep::SweptVariable;

use crate::contact::read_contact;
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Name, Text};
use pulvis_contact::ContactModel;
use pulvis_math::Dimension;
use speed::{Speed, read_speed};
use std::path::Path;
use sweep::{Sweep, read_sweep};

/// How a collision is integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// With error control, stopping at every change of branch.
    Exact,
    /// As the engine does it, with steps of one length.
    Engine {
        /// Number of steps in the shortest contact time of the pair [1].
        steps_per_contact: f64,
    },
}

/// One collision.
#[derive(Clone, Debug, PartialEq)]
pub struct CollisionCase {
    /// The value of the swept variable, in SI.
    pub value: f64,
    /// Relative speed outside the range of all forces [m/s].
    pub velocity: f64,
    /// The bodies.
    pub bodies: Bodies,
    /// All laws of their contact.
    pub contact: ContactModel,
    /// How it is integrated.
    pub method: Method,
}

/// A collision experiment: one or more collisions that differ in one variable.
#[derive(Clone, Debug)]
pub struct CollisionScenario {
    /// What the author calls it.
    pub title: Option<String>,
    /// What differs between the cases.
    pub variable: SweptVariable,
    /// Whether the values are spaced by equal ratios.
    pub logarithmic: bool,
    /// How long a pair that stuck is followed [s].
    pub time_after_sticking: f64,
    /// The collisions, in the order of the sweep.
    pub cases: Vec<CollisionCase>,
    /// The file, where a parameter in it is swept.
    document: Option<Document>,
}

impl CollisionScenario {
    /// Reads a scenario file after replacing values, as `--set key=value` does.
    ///
    /// # Errors
    /// All mistakes in the file, or a replacement that leads nowhere.
    pub fn load(path: impl AsRef<Path>, set: &[(String, Replacement)]) -> Result<Self, InputErrors> {
        Self::from_document(&Document::load(path)?.with_overrides(set)?)
    }

    /// Reads a parsed scenario.
    ///
    /// # Errors
    /// All mistakes; of a swept parameter, those of the first value that is refused.
    pub fn from_document(document: &Document) -> Result<Self, InputErrors> {
        let mut scenario = document.read(|root| walk(root, true))?;
        if let SweptVariable::Key { path, .. } = &scenario.variable {
            let base = std::mem::take(&mut scenario.cases);
            for value in base.iter().map(|case| case.value) {
                scenario.cases.extend(case_at(document, path, value)?);
            }
            scenario.document = Some(document.clone());
        }
        Ok(scenario)
    }

    /// The collision at any value of a swept parameter, in SI; `None` where no parameter of the file is swept, or where
    /// the file with this value would be refused.
    pub fn case_at(&self, value: f64) -> Option<CollisionCase> {
        match (&self.variable, &self.document) {
            (SweptVariable::Key { path, .. }, Some(document)) => {
                case_at(document, path, value).ok().flatten()
            }
            _ => None,
        }
    }
}

/// The collision of the file with another value of the parameter at `path`.
fn case_at(document: &Document, path: &str, value: f64) -> Result<Option<CollisionCase>, InputErrors> {
    let replaced = document.with_override(path, Replacement::Si(value))?;
    let case = replaced.read(|root| walk(root, false))?.cases.into_iter().next();
    Ok(case.map(|case| CollisionCase { value, ..case }))
}

/// Walks the file. Where a parameter is swept, all cases are those of the file as it stands; each of
/// them has to be read again with its value in place (`sweeping` is then false, one case is given).
fn walk(mut root: TableReader<'_>, sweeping: bool) -> Result<CollisionScenario, Reported> {
    let title = root.optional("title", Text);
    let collision = root.required_table("collision");
    let contact = root.required_table("contact").and_then(|table| read_contact(table, None));
    root.finish();
    let mut table = collision?;
    let bodies = read_bodies(&mut table);
    let method = read_method(&mut table);
    let time = QuantityRule::of(Dimension::TIME).at_least(0.0);
    let time_after_sticking = table.or("time_after_sticking", time, 0.0);
    let speed = read_speed(&mut table);
    let sweep = table.optional_table("sweep");
    // The sweep's own values are judged by the laws, so these have to be right first.
    let sweep = match (sweep, &contact) {
        (Ok(Some(sweep)), Ok(contact)) => read_sweep(sweep, contact),
        (Ok(_), _) => Ok(Sweep::single()),
        (Err(reported), _) => Err(reported),
    };
    let (bodies, method, speed, sweep, contact) = (bodies?, method?, speed?, sweep?, contact?);
    let draft = Draft { bodies, method, contact: contact.model };
    let time_after_sticking = time_after_sticking.and_then(|time| draft.can_follow(&table, time));
    let cases = draft.cases(&table, speed, &sweep, sweeping);
    table.finish();
    Ok(CollisionScenario {
        title: title?,
        variable: sweep.variable,
        logarithmic: sweep.logarithmic,
        time_after_sticking: time_after_sticking?,
        cases: cases?,
        document: None,
    })
}

fn read_method(table: &mut TableReader<'_>) -> Result<Method, Reported> {
    let method = table.or("method", Name(&["exact", "engine"]), "exact");
    let steps = QuantityRule::of(Dimension::NONE).at_least(1.0);
    let steps_per_contact = table.or("steps_per_contact", steps, 50.0);
    let (method, steps_per_contact) = (method?, steps_per_contact?);
    Ok(if method == "engine" { Method::Engine { steps_per_contact } } else { Method::Exact })
}

/// A collision whose speed is not yet known.
struct Draft {
    bodies: Bodies,
    method: Method,
    contact: ContactModel,
}

/// Contact times for which a pair that stuck is followed at most: its motion has long been told by then.
const LONGEST_FOLLOWED: f64 = 1000.0;

impl Draft {
    /// Whether a pair that stuck can be followed for `time` [s].
    fn can_follow(&self, table: &TableReader<'_>, time: f64) -> Result<f64, Reported> {
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

    fn cases(
        &self,
        table: &TableReader<'_>,
        speed: Option<Speed>,
        sweep: &Sweep,
        sweeping: bool,
    ) -> Result<Vec<CollisionCase>, Reported> {
        let swept = sweep.points.first().is_some_and(|point| point.speed.is_some());
        match (&speed, swept) {
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
            let velocity = speed.velocity(&self.contact, &self.bodies);
            let velocity = velocity.map_err(|problem| table.refuse_at(&speed.location, problem))?;
            let value = value.unwrap_or(velocity);
            Ok(CollisionCase {
                value,
                velocity,
                bodies: self.bodies,
                contact: self.contact,
                method: self.method,
            })
        };
        match &speed {
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
