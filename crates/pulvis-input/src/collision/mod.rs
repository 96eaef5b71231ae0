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
mod draft;
mod family;
mod incidence;
mod speed;
mod sweep;

pub use bodies::{Bodies, Sphere};
pub(crate) use bodies::{read_bodies, unfit_for_numbers};
pub use closed_form::luding_pair;
pub use family::SweepFamily;
pub use incidence::Incidence;
pub use sweep::SweptVariable;

use crate::comparison::{LabelledContact, read_compared};
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Name, Text};
use crate::surroundings::{Surroundings, read_surroundings, read_temperature};
use draft::Draft;
use family::read_family;
use incidence::read_incidence;
use pulvis_contact::ContactModel;
use pulvis_contact::bond::Form;
use pulvis_math::{Dimension, elementary};
use speed::read_speed;
use std::path::Path;
use sweep::{Sweep, read_sweep, refuse_too_many};

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
    /// Angle and spins; `None` where the bodies meet head on without spin.
    pub incidence: Option<Incidence>,
    /// The bodies.
    pub bodies: Bodies,
    /// All laws of their contact.
    pub contact: ContactModel,
    /// Number of the contact among those that the scenario compares.
    pub contact_number: usize,
    /// How it is integrated.
    pub method: Method,
    /// What the laws ask for beside the bodies.
    pub surroundings: Surroundings,
}

impl CollisionCase {
    /// The part of the relative velocity along the line of centres [m/s].
    pub fn normal_velocity(&self) -> f64 {
        self.velocity * self.incidence.map_or(1.0, |incidence| elementary::cos(incidence.angle))
    }
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
    /// The collisions: those of each contact in the order of the sweep, one contact after another.
    pub cases: Vec<CollisionCase>,
    /// What the contacts are called that are compared.
    pub labels: Vec<String>,
    /// The second variable, which differs between the contacts.
    pub family: Option<SweepFamily>,
    /// The file, where a parameter in it is swept; with a second variable, once for each of its values.
    documents: Vec<Document>,
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
        let mut scenario = Self::of_one_variable(document)?;
        let Some(family) = scenario.family.clone() else { return Ok(scenario) };
        scenario.cases.clear();
        scenario.labels.clear();
        scenario.documents.clear();
        for (number, value) in family.values.iter().enumerate() {
            let replaced = document.with_override(&family.path, Replacement::Si(*value))?;
            let one = Self::of_one_variable(&replaced)?;
            scenario
                .cases
                .extend(one.cases.into_iter().map(|case| CollisionCase { contact_number: number, ..case }));
            scenario.labels.push(family.label(*value));
            scenario.documents.push(replaced);
        }
        Ok(scenario)
    }

    /// Reads a scenario without its second variable.
    fn of_one_variable(document: &Document) -> Result<Self, InputErrors> {
        let mut scenario = document.read(|root| walk(root, true))?;
        if let SweptVariable::Key { path, .. } = &scenario.variable {
            let base = std::mem::take(&mut scenario.cases);
            for case in &base {
                scenario.cases.extend(case_at(document, path, case.value, case.contact_number)?);
            }
        }
        scenario.documents.push(document.clone());
        Ok(scenario)
    }

    /// The collision of a contact at any value of a swept parameter, in SI; `None` where no parameter of the file is swept,
    /// or where the file with this value would be refused.
    pub fn case_at(&self, value: f64, contact_number: usize) -> Option<CollisionCase> {
        let SweptVariable::Key { path, .. } = &self.variable else { return None };
        let (document, in_file) = match self.family {
            Some(_) => (self.documents.get(contact_number)?, 0),
            None => (self.documents.first()?, contact_number),
        };
        let case = case_at(document, path, value, in_file).ok().flatten()?;
        Some(CollisionCase { contact_number, ..case })
    }
}

/// The collision of the file and one of its contacts with another value of the parameter at `path`.
fn case_at(
    document: &Document,
    path: &str,
    value: f64,
    contact_number: usize,
) -> Result<Option<CollisionCase>, InputErrors> {
    let replaced = document.with_override(path, Replacement::Si(value))?;
    let mut cases = replaced.read(|root| walk(root, false))?.cases.into_iter();
    let case = cases.find(|case| case.contact_number == contact_number);
    Ok(case.map(|case| CollisionCase { value, ..case }))
}

/// Walks the file. Where a parameter is swept, all cases are those of the file as it stands; each of
/// them has to be read again with its value in place (`sweeping` is then false, one case of each contact is given).
fn walk(mut root: TableReader<'_>, sweeping: bool) -> Result<CollisionScenario, Reported> {
    let title = root.optional("title", Text);
    let collision = root.required_table("collision");
    let contacts = read_compared(&mut root).and_then(|contacts| without_stages(&root, contacts));
    let temperature = read_temperature(&mut root);
    root.finish();
    let mut table = collision?;
    let bodies = read_bodies(&mut table);
    let at_wall = matches!(bodies, Ok(Bodies::Wall(_)));
    let surroundings = match &contacts {
        Ok(contacts) => {
            let models = contacts.iter().map(|contact| &contact.contact.model);
            read_surroundings(temperature, &mut table, at_wall, models)
        }
        Err(reported) => Err(*reported),
    };
    let incidence = read_incidence(&mut table, at_wall);
    let method = read_method(&mut table, matches!(incidence, Ok(Some(_))));
    let time = QuantityRule::of(Dimension::TIME).at_least(0.0);
    let time_after_sticking = table.or("time_after_sticking", time, 0.0);
    let speed = read_speed(&mut table);
    let sweep = table.optional_table("sweep");
    // The sweep's own values are judged by the laws, so these have to be right first.
    let sweep = match (sweep, &contacts) {
        (Ok(Some(sweep)), Ok(contacts)) => read_sweep(sweep, contacts),
        (Ok(_), _) => Ok(Sweep::single()),
        (Err(reported), _) => Err(reported),
    };
    let family = match (table.optional_table("family"), &contacts) {
        (Ok(Some(family)), Ok(contacts)) => read_family(family, contacts).map(Some),
        (Ok(_), _) => Ok(None),
        (Err(reported), _) => Err(reported),
    };
    let method = match (method, &contacts) {
        (Ok(Method::Exact), Ok(contacts))
            if contacts.iter().any(|contact| contact.contact.model.normal.depends_on_time()) =>
        {
            Err(needs_steps(&table))
        }
        (method, _) => method,
    };
    let (bodies, incidence, method, speed) = (bodies?, incidence?, method?, speed?);
    let (sweep, contacts, surroundings) = (sweep?, contacts?, surroundings?);
    if let Ok(Some(family)) = &family
        && family.path == sweep.variable.name()
    {
        let found = format!("`{}` is the first variable too", family.path);
        return Err(table.refuse("family", Problem::rule(found, "another one")));
    }
    let second = family.as_ref().map_or(1, |family| family.as_ref().map_or(1, |family| family.values.len()));
    refuse_too_many(&table, &sweep, contacts.len().saturating_mul(second))?;
    let mut cases = Ok(Vec::new());
    let mut time_after_sticking = time_after_sticking;
    for (contact_number, LabelledContact { contact, .. }) in contacts.iter().enumerate() {
        let (contact, surroundings) = (surroundings.bound(&contact.model), surroundings.clone());
        let draft = Draft { bodies, incidence, method, contact, contact_number, surroundings };
        time_after_sticking = time_after_sticking.and_then(|time| draft.can_follow(&table, time));
        cases = cases.and_then(|mut all: Vec<_>| {
            all.extend(draft.cases(&table, speed.as_ref(), &sweep, sweeping)?);
            Ok(all)
        });
    }
    table.finish();
    Ok(CollisionScenario {
        title: title?,
        variable: sweep.variable,
        logarithmic: sweep.logarithmic,
        time_after_sticking: time_after_sticking?,
        cases: cases?,
        labels: contacts.into_iter().map(|contact| contact.label).collect(),
        family: family?,
        documents: Vec::new(),
    })
}

/// Refuses bonds that form at the start of a stage: a collision has none.
fn without_stages(
    root: &TableReader<'_>,
    contacts: Vec<LabelledContact>,
) -> Result<Vec<LabelledContact>, Reported> {
    let awaits_stage = |contact: &LabelledContact| {
        contact.contact.model.laws.bond.is_some_and(|bond| bond.formation.form == Form::StageStart)
    };
    if !contacts.iter().any(awaits_stage) {
        return Ok(contacts);
    }
    let found = "a bond forms at the start of a stage, and a collision has no stages";
    Err(root.refuse("contact", Problem::rule(found, "`form = \"first-touch\"` in [contact.bond]")))
}

/// Reports that a law whose memory changes with time cannot be followed from branch to branch.
fn needs_steps(table: &TableReader<'_>) -> Reported {
    let found = "\"exact\" follows laws that depend on the overlap, and this one relaxes with time";
    table.refuse("method", Problem::rule(found, "`method = \"engine\"`"))
}

/// Steps of an oblique collision in the shortest contact time, unless told otherwise: errors of 1e-6.
const OBLIQUE_STEPS: f64 = 2000.0;

fn read_method(table: &mut TableReader<'_>, oblique: bool) -> Result<Method, Reported> {
    let method = table.optional("method", Name(&["exact", "engine"]));
    let steps = QuantityRule::of(Dimension::NONE).at_least(1.0);
    let steps = table.or("steps_per_contact", steps, if oblique { OBLIQUE_STEPS } else { 50.0 });
    let (method, steps_per_contact) = (method?, steps?);
    if oblique && method == Some("exact") {
        let problem =
            Problem::rule("given beside an angle or a spin", "\"engine\", the default of oblique collisions");
        return Err(table.refuse("method", problem));
    }
    let engine = oblique || method == Some("engine");
    Ok(if engine { Method::Engine { steps_per_contact } } else { Method::Exact })
}
