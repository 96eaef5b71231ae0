//! The scenario of a probe: one contact, or several to be compared, on a prescribed path.
//!
//! ```
//! use pulvis_input::probe::ProbeScenario;
//! use pulvis_input::Document;
//!
//! let text = r#"
//! [probe]
//! bodies = "wall"
//! radius = "1 um"
//! density = "2000 kg/m^3"
//! overlap = ["-5 nm", "20 nm", "-10 nm"]
//! [contact.normal]
//! law = "jkr"
//! effective_modulus = "1 GPa"
//! work_of_adhesion = "0.1 N/m"
//! "#;
//! let scenario = ProbeScenario::from_document(&Document::from_str("probe.toml", text)?)?;
//! assert_eq!(scenario.path.legs(), 2);
//! # Ok::<(), pulvis_input::InputErrors>(())
//! ```

mod path;

pub use path::ProbePath;

use crate::collision::{Bodies, read_bodies};
use crate::comparison::{LabelledContact, read_compared};
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;
use crate::surroundings::{Surroundings, read_surroundings, read_temperature};
use path::read_path;
use std::path::Path;

/// Contacts of two bodies that are led along one path.
#[derive(Clone, Debug, PartialEq)]
pub struct ProbeScenario {
    /// What the author calls it.
    pub title: Option<String>,
    /// The bodies.
    pub bodies: Bodies,
    /// The path.
    pub path: ProbePath,
    /// What the laws ask for beside the bodies.
    pub surroundings: Surroundings,
    /// The contact, and those that it is compared with.
    pub contacts: Vec<LabelledContact>,
}

impl ProbeScenario {
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
    /// All mistakes in the file.
    pub fn from_document(document: &Document) -> Result<Self, InputErrors> {
        document.read(walk)
    }
}

fn walk(mut root: TableReader<'_>) -> Result<ProbeScenario, Reported> {
    let title = root.optional("title", Text);
    let probe = root.required_table("probe");
    let contacts = read_compared(&mut root);
    let temperature = read_temperature(&mut root);
    root.finish();
    let mut table = probe?;
    let bodies = read_bodies(&mut table);
    let path = read_path(&mut table, bodies.as_ref().ok());
    let surroundings = match &contacts {
        Ok(contacts) => {
            let at_wall = matches!(bodies, Ok(Bodies::Wall(_)));
            let models = contacts.iter().map(|contact| &contact.contact.model);
            read_surroundings(temperature, &mut table, at_wall, models)
        }
        Err(reported) => Err(*reported),
    };
    if let (Ok(bodies), Ok(path), Ok(contacts)) = (&bodies, &path, &contacts) {
        needs_no_time(&table, bodies, path, contacts)?;
    }
    table.finish();
    Ok(ProbeScenario {
        title: title?,
        bodies: bodies?,
        path: path?,
        surroundings: surroundings?,
        contacts: contacts?,
    })
}

/// Refuses a path without times for contacts whose forces depend on them.
fn needs_no_time(
    table: &TableReader<'_>,
    bodies: &Bodies,
    path: &ProbePath,
    contacts: &[LabelledContact],
) -> Result<(), Reported> {
    let timed = |contact: &&LabelledContact| contact.contact.model.depends_on_time(&bodies.pair());
    match contacts.iter().find(timed).filter(|_| path.durations.is_none()) {
        None => Ok(()),
        Some(contact) => {
            let found = format!("the forces of `{}` depend on the rate or on time", contact.label);
            let expected = "a `speed` greater than 0 m/s, or `durations`";
            Err(table.refuse("speed", Problem::rule(found, expected)))
        }
    }
}
