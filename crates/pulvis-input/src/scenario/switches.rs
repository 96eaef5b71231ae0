//! What a stage switches: `[stages.set]` holds dotted paths of keys and their new values.

use crate::context::{Location, Reported};
use crate::document::Document;
use crate::error::InputErrors;
use crate::overrides::{Copied, Replacement};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::value::{Node, Value};

/// One key that a stage sets.
#[derive(Clone, Debug)]
pub(super) struct Switch {
    path: String,
    value: Replacement,
    place: Location,
}

/// The parts of a scenario that may change while it runs.
const SWITCHABLE: [&str; 3] = ["contacts", "background", "gravity"];

impl Switch {
    pub(super) fn new(path: String, value: Replacement, place: Location) -> Self {
        Self { path, value, place }
    }

    /// The same key set to a number in SI, in the same place of the file.
    pub(super) fn with_number(&self, number: f64) -> Self {
        let value = match &self.value {
            Replacement::Copied(Copied(node)) => {
                Replacement::Copied(Copied(Node { value: Value::Si(number), ..node.clone() }))
            }
            _ => Replacement::Si(number),
        };
        Self { value, ..self.clone() }
    }
}

/// Whether a key may change while a scenario runs.
pub(super) fn is_switchable(path: &str) -> bool {
    SWITCHABLE.contains(&first_part(path))
}

fn first_part(path: &str) -> &str {
    path.split(['.', '[']).next().unwrap_or_default()
}

/// Reads `[stages.set]`.
pub(super) fn read_switches(stage: &mut TableReader<'_>) -> Result<Vec<Switch>, Reported> {
    let Some(table) = stage.optional_table("set")? else { return Ok(Vec::new()) };
    let mut switches = Vec::new();
    let collected = collect(table, "", &mut switches);
    // A new law decides which parameters exist, so it comes before them, in whatever order they stand.
    switches.sort_by_key(|switch| !switch.path.ends_with(".law"));
    collected.map(|()| switches)
}

/// Collects the values of a table. A path may stand in quotes, `"background.drag"`, or without, which
/// makes nested tables of it.
fn collect(mut table: TableReader<'_>, parent: &str, switches: &mut Vec<Switch>) -> Result<(), Reported> {
    let mut failure = None;
    for key in table.keys() {
        let Some(value) = table.value(key) else { continue };
        let path = if parent.is_empty() { key.to_owned() } else { format!("{parent}.{key}") };
        if !is_switchable(&path) {
            let found = format!("a stage cannot set `{path}`");
            let problem = Problem::rule(found, "a path that begins with contacts, background or gravity");
            failure = Some(if first_part(&path) == "time" {
                table.refuse_with_help(key, problem, "time steps are set in [stages.time]")
            } else {
                table.refuse(key, problem)
            });
        } else if value.is_table() && !key.contains('.') {
            let inner = value.table().and_then(|inner| collect(inner, &path, switches));
            failure = inner.err().or(failure);
        } else {
            switches.push(Switch { path, value: value.replacement(), place: value.location() });
        }
    }
    table.finish();
    failure.map_or(Ok(()), Err)
}

/// The document with everything set that a stage sets.
pub(super) fn switched(document: &Document, switches: &[Switch]) -> Result<Document, InputErrors> {
    let mut document = document.clone();
    for Switch { path, value, place } in switches {
        let set = document.with_setting(path, value.clone());
        document = set.map_err(|problem| document.error_at(place, problem))?;
    }
    Ok(document)
}
