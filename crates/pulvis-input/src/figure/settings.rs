//! Values that a figure sets in its scenarios, and the variants in which it runs them.

use crate::context::Reported;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;
use crate::value::{Value, split_path};
use crate::value_reader::ValueReader;

/// Keys of a scenario and the values that take the place of its own.
pub type Settings = Vec<(String, Replacement)>;

/// One way to run all scenarios of a figure: another seed, another time step.
#[derive(Clone, Debug, PartialEq)]
pub struct Variant {
    /// What it is called; empty where there is only one.
    pub name: String,
    /// What it sets in the runs that do not start from another one.
    pub set: Settings,
}

/// Reads all `[[variants]]`; without any there is one that sets nothing.
pub(super) fn read_variants(root: &mut TableReader<'_>) -> Result<Vec<Variant>, Reported> {
    let tables = root.tables("variants")?;
    if tables.is_empty() {
        return Ok(vec![Variant { name: String::new(), set: Vec::new() }]);
    }
    let mut all: Vec<Result<Variant, Reported>> = Vec::new();
    for mut table in tables {
        let name = table.required("name", Text);
        let set = read_settings(&mut table);
        let twice = name.as_ref().is_ok_and(|name| all.iter().flatten().any(|other| other.name == *name));
        let twice = twice.then(|| {
            table
                .refuse("name", Problem::rule("two [[variants]] are called so", "a name of its own for each"))
        });
        table.finish();
        all.push(match (name, set, twice) {
            (Ok(name), Ok(set), None) => Ok(Variant { name, set }),
            (Err(reported), ..) | (_, Err(reported), _) | (.., Some(reported)) => Err(reported),
        });
    }
    all.into_iter().collect()
}

/// A text, a number or a truth value that takes the place of one in a scenario.
pub(crate) fn read_replacement(value: &ValueReader<'_>) -> Result<Replacement, Reported> {
    match value.raw() {
        Value::Text(text) => Ok(Replacement::Text(text.clone())),
        Value::Boolean(boolean) => Ok(Replacement::Boolean(*boolean)),
        Value::Integer(digits) | Value::Number(digits) => Ok(Replacement::parse(digits)),
        _ => Err(value.wrong_type(
            "a text, a number or true or false; list items have paths of their own, \
             \"stages[0].walls.x-high.displacement[0]\"",
        )),
    }
}

/// Refuses what is no path of keys, which stands at `place` of a table.
pub(crate) fn refuse_unreadable(table: &TableReader<'_>, place: &str, path: &str) -> Result<(), Reported> {
    match split_path(path) {
        Some(_) => Ok(()),
        None => Err(table.refuse(place, Problem::UnreadablePath { path: path.to_owned() })),
    }
}

/// Reads `set`: a table of dotted paths and texts, numbers or truth values.
pub(crate) fn read_settings(table: &mut TableReader<'_>) -> Result<Settings, Reported> {
    let Some(mut set) = table.optional_table("set")? else { return Ok(Vec::new()) };
    let mut settings = Vec::new();
    let mut failure = None;
    for key in set.keys() {
        let Some(value) = set.value(key) else { continue };
        match refuse_unreadable(&set, key, key).and_then(|()| read_replacement(&value)) {
            Ok(replacement) => settings.push((key.to_owned(), replacement)),
            Err(reported) => failure = Some(reported),
        }
    }
    set.finish();
    failure.map_or(Ok(settings), Err)
}
