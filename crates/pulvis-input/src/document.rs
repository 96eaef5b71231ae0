//! One scenario file: loaded, parsed, and read with all its mistakes collected.

use crate::context::{Context, Location, Reported};
use crate::error::{InputError, InputErrors};
use crate::load::read_source;
use crate::overrides::{Replacement, replace};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::scenario::CheckpointReader;
use crate::scenario::start::{StartFrom, read_start};
use crate::setting::set;
use crate::source::Source;
use crate::syntax::syntax_errors;
use crate::value::{Node, Table, Value, join_path, split_path};
use std::path::Path;
use std::sync::Arc;
use toml::de::DeTable;

/// A parsed file in which every key and value knows its place.
#[derive(Clone, Debug)]
pub struct Document {
    source: Arc<Source>,
    root: Table,
    checkpoints: Option<CheckpointReader>,
}

impl Document {
    /// Reads and parses a file.
    ///
    /// # Errors
    /// The file is missing, a folder, no text, empty, or no TOML; all syntax errors are listed.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, InputErrors> {
        Self::parse(read_source(path.as_ref())?)
    }

    /// Parses a text; `name` stands for the file in error messages.
    ///
    /// # Errors
    /// The text is empty or no TOML.
    pub fn from_str(name: &str, text: &str) -> Result<Self, InputErrors> {
        Self::parse(Source::new(name, text))
    }

    fn parse(source: Source) -> Result<Self, InputErrors> {
        let (table, errors) = DeTable::parse_recoverable(&source.text);
        if !errors.is_empty() {
            return Err(InputErrors::new(syntax_errors(&source, &errors)));
        }
        let root = Table::from_toml(table.get_ref());
        if root.entries.is_empty() {
            let place = Some(source.place(&(0..0)));
            return Err(InputError { place, ..InputError::of_file(&source.name, Problem::Empty) }.into());
        }
        Ok(Self { source: Arc::new(source), root, checkpoints: None })
    }

    /// The same file, whose particles may stand in checkpoints.
    #[must_use]
    pub fn with_checkpoint_reader(self, reader: CheckpointReader) -> Self {
        Self { checkpoints: Some(reader), ..self }
    }

    /// The names in the table `materials`, in their order; none where there is no such table.
    pub fn material_names(&self) -> Vec<String> {
        let names = self.root.entries.get("materials").and_then(|entry| match &entry.node.value {
            Value::Table(materials) => Some(materials.in_order()),
            _ => None,
        });
        names.unwrap_or_default().into_iter().map(|(name, _)| name.to_owned()).collect()
    }

    /// The same file with all bare numbers in SI units, whatever the dimension of their keys: what a program has written.
    #[must_use]
    pub fn with_numbers_in_si(mut self) -> Self {
        self.root.entries.values_mut().for_each(|entry| entry.node.count_in_si());
        self
    }

    /// The text and the values.
    pub(crate) fn parts(&self) -> (&Source, &Table) {
        (&self.source, &self.root)
    }

    /// The name of the file, as the user wrote it.
    pub fn name(&self) -> &str {
        &self.source.name
    }

    /// The text of the file, for example to store it beside the results.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Walks the file. `walk` reports mistakes through the reader and goes on as long as it can.
    ///
    /// # Errors
    /// All mistakes that were reported, even if `walk` itself returned a value.
    pub fn read<T>(
        &self,
        walk: impl FnOnce(TableReader<'_>) -> Result<T, Reported>,
    ) -> Result<T, InputErrors> {
        let context = Context::new(&self.source, self.checkpoints);
        let result = walk(TableReader::new(&context, &self.root, String::new(), 0..0));
        match (result, context.into_errors()) {
            (Ok(value), errors) if errors.is_empty() => Ok(value),
            (_, errors) => Err(InputErrors::new(errors)),
        }
    }

    /// A mistake at a place that was remembered while reading, for checks across tables.
    pub fn error_at(&self, location: &Location, problem: Problem) -> InputError {
        location.error(&self.source, problem)
    }

    /// The same file with one value replaced, as a sweep or a stage does it.
    ///
    /// `path` is dotted: `contact.normal.kc`, `stages[0].duration`. The value's place stays that of the
    /// replaced one, so that errors still point into the file.
    ///
    /// # Errors
    /// The path leads nowhere, or to a table or list.
    pub fn with_override(&self, path: &str, value: impl Into<Replacement>) -> Result<Self, InputErrors> {
        let mut root = self.root.clone();
        replace(&mut root, &self.source, path, value.into())?;
        Ok(Self { source: Arc::clone(&self.source), root, checkpoints: self.checkpoints })
    }

    /// The same file with several values replaced, as the command line does it.
    ///
    /// # Errors
    /// As of [`Self::with_override`], or a key stands in `set` twice: nobody knows which value is meant.
    pub fn with_overrides(&self, set: &[(String, Replacement)]) -> Result<Self, InputErrors> {
        let mut document = self.clone();
        let mut paths = Vec::with_capacity(set.len());
        for (path, value) in set {
            document = document.with_override(path, value.clone())?;
            // `a."b"` is the same path as `a.b`.
            let steps = split_path(path);
            if paths.contains(&steps) {
                let problem = Problem::rule("the key is set twice from outside the file", "each key once");
                return Err(InputError { help: None, ..self.mistake(path, problem, "") }.into());
            }
            paths.push(steps);
        }
        Ok(document)
    }

    /// The state that the scenario in the file starts from, if it says so. Paths are relative to `folder`.
    ///
    /// # Errors
    /// `start_from` is not what it can be.
    pub fn start_from(&self, folder: &Path) -> Result<Option<(StartFrom, Location)>, InputErrors> {
        self.read(|mut root| {
            let start = read_start(&mut root, folder);
            // Everything else is read later.
            for key in root.keys() {
                root.value(key);
            }
            root.finish();
            start
        })
    }

    /// The same file with all keys that it lacks taken from `other`, but for `except`. Errors in them point at `place`.
    pub fn with_missing_from(&self, other: &Self, except: &[&str], place: &Location) -> Self {
        let mut root = self.root.clone();
        for (key, entry) in &other.root.entries {
            if except.contains(&key.as_str()) || root.entries.contains_key(key) {
                continue;
            }
            let mut entry = entry.clone();
            entry.move_to(&place.span, self.source.text.len());
            root.entries.insert(key.clone(), entry);
        }
        Self { source: Arc::clone(&self.source), root, checkpoints: self.checkpoints }
    }

    /// The dotted paths of all values that were set from outside the file.
    pub(crate) fn replaced(&self) -> Vec<String> {
        let mut paths = Vec::new();
        collect_replaced(&self.root, "", &mut paths);
        paths
    }

    /// The same file with a value or table set, whether it was there before or not, as a stage does it.
    ///
    /// Tables on the way are made. Setting a key called `law` drops the neighbours that the new law does
    /// not know. Errors will point at the new value.
    pub(crate) fn with_setting(&self, path: &str, value: Replacement) -> Result<Self, Problem> {
        let mut root = self.root.clone();
        set(&mut root, path, value)?;
        Ok(Self { source: Arc::clone(&self.source), root, checkpoints: self.checkpoints })
    }
}

fn collect_replaced(table: &Table, parent: &str, paths: &mut Vec<String>) {
    for (key, entry) in table.in_order() {
        collect_replaced_below(&entry.node, join_path(parent, key), paths);
    }
}

fn collect_replaced_below(node: &Node, path: String, paths: &mut Vec<String>) {
    match &node.value {
        _ if node.replaced => paths.push(path),
        Value::Table(table) => collect_replaced(table, &path, paths),
        Value::List(items) => {
            for (index, item) in items.iter().enumerate() {
                collect_replaced_below(item, format!("{path}[{index}]"), paths);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::{Dimension, Integer, List, QuantityRule};

    #[test]
    fn bare_numbers_of_a_program_are_in_si_and_errors_show_them() {
        let text = "radius = [1e-3, 2]\ncount = 7\nseed = 9007199254740993\nmass = \"2 g\"\nspeed = -1";
        let document = Document::from_str("<dict>", text).unwrap().with_numbers_in_si();
        let speed = QuantityRule::of(Dimension::VELOCITY).above(0.0);
        let mut read = None;
        let refused = document.read(|mut root| {
            let radii = root.required("radius", List::of(QuantityRule::of(Dimension::LENGTH)))?;
            let mass = root.required("mass", Dimension::MASS)?;
            read = Some((
                radii,
                mass,
                root.required("count", Integer::ANY)?,
                root.required("seed", Integer::ANY)?,
            ));
            root.required("speed", speed)
        });
        // A whole number beyond 2^53 keeps its last digit.
        assert_eq!(read, Some((vec![1e-3, 2.0], 2e-3, 7, 9_007_199_254_740_993)));
        let message = refused.unwrap_err().to_string();
        assert!(message.starts_with("error: <dict>:5:9: speed: -1 m/s is out of range"), "{message}");
        assert!(message.contains("5| speed = -1") && !message.contains("note"), "{message}");
    }
}
