//! Reading tables key by key, with every mistake collected.

use crate::context::{Context, Location, Reported};
use crate::problem::Problem;
use crate::scenario::CheckpointReader;
use crate::shape::{Name, Shape};
use crate::similar::similar;
use crate::value::{Table, join_path};
use crate::value_reader::ValueReader;
use std::collections::BTreeMap;
use std::ops::Range;

/// The words under which scenario files name a choice that decides what else belongs into a table.
const SELECTORS: [&str; 6] = ["kind", "shape", "type", "law", "distribution", "control"];

/// A table being read. It remembers the keys that were asked for; [`Self::finish`] refuses the others.
pub struct TableReader<'d> {
    context: &'d Context<'d>,
    table: &'d Table,
    location: Location,
    /// With their numbers: there may be as many as a file has materials.
    asked: BTreeMap<String, usize>,
    /// Unknown keys that have been reported.
    reported: Vec<String>,
}

impl<'d> TableReader<'d> {
    pub(crate) fn new(context: &'d Context<'d>, table: &'d Table, path: String, span: Range<usize>) -> Self {
        let location = Location { span, path, replaced: false };
        context.open(&location);
        Self { context, table, location, asked: BTreeMap::new(), reported: Vec::new() }
    }

    /// What reads checkpoints that the file names.
    pub(crate) fn checkpoint_reader(&self) -> Option<CheckpointReader> {
        self.context.checkpoints
    }

    /// The value at `key`, of whatever kind, if the key is there.
    pub fn value(&mut self, key: &str) -> Option<ValueReader<'d>> {
        if !self.asked.contains_key(key) {
            self.asked.insert(key.to_owned(), self.asked.len());
        }
        let node = &self.table.entries.get(key)?.node;
        Some(ValueReader::new(self.context, node, join_path(&self.location.path, key)))
    }

    /// A value that must be there.
    ///
    /// # Errors
    /// It is missing or of another shape; that has been reported.
    pub fn required<S: Shape>(&mut self, key: &str, shape: S) -> Result<S::Output, Reported> {
        match self.value(key) {
            Some(value) => shape.read(&value),
            None => Err(self.missing(key, shape.describe(), shape.example())),
        }
    }

    /// A value that may be left out.
    ///
    /// # Errors
    /// It is of another shape; that has been reported.
    pub fn optional<S: Shape>(&mut self, key: &str, shape: S) -> Result<Option<S::Output>, Reported> {
        self.value(key).map(|value| shape.read(&value)).transpose()
    }

    /// A value with a default.
    ///
    /// # Errors
    /// It is of another shape; that has been reported.
    pub fn or<S: Shape>(&mut self, key: &str, shape: S, default: S::Output) -> Result<S::Output, Reported> {
        Ok(self.optional(key, shape)?.unwrap_or(default))
    }

    /// The name that decides which other keys belong into this table, for example `kind = "lattice"`.
    ///
    /// # Errors
    /// It is missing, none of `names`, or stands under another word; that has been reported with all the
    /// names. The caller should then leave the table: nobody knows which other keys belong into it.
    pub fn selector<'n>(&mut self, key: &str, names: &'n [&'n str]) -> Result<&'n str, Reported> {
        self.check_selector_word(key, names)?;
        self.required(key, Name(names))
    }

    /// As [`Self::selector`], with a name that holds where none is given.
    ///
    /// # Errors
    /// It is none of `names`, or stands under another word.
    pub fn selector_or<'n>(
        &mut self,
        key: &str,
        names: &'n [&'n str],
        default: &'n str,
    ) -> Result<&'n str, Reported> {
        self.check_selector_word(key, names)?;
        self.or(key, Name(names), default)
    }

    /// Refuses `kind = "lattice"` where the key is called otherwise.
    fn check_selector_word(&mut self, key: &str, names: &[&str]) -> Result<(), Reported> {
        let entries = &self.table.entries;
        let found = SELECTORS.iter().find_map(|&word| Some((word, entries.get(word)?)));
        let Some((word, entry)) = found.filter(|_| !entries.contains_key(key)) else { return Ok(()) };
        let path = join_path(&self.location.path, word);
        let location = Location { span: entry.key_span.clone(), path, replaced: false };
        let problem = Problem::UnknownKey { similar: Some(key.to_owned()) };
        let help = format!("`{key}` is {}", Name(names).describe());
        self.reported.push(word.to_owned());
        Err(self.context.report(&location, problem, Some(help)))
    }

    /// A table inside this one that must be there.
    ///
    /// # Errors
    /// It is missing or no table.
    pub fn required_table(&mut self, key: &str) -> Result<TableReader<'d>, Reported> {
        match self.value(key) {
            Some(value) => value.table(),
            None => {
                let header = format!("[{}]", join_path(&self.location.path, key));
                Err(self.missing(key, format!("a table {header}"), None))
            }
        }
    }

    /// A table inside this one that may be left out.
    ///
    /// # Errors
    /// It is no table.
    pub fn optional_table(&mut self, key: &str) -> Result<Option<TableReader<'d>>, Reported> {
        self.value(key).map(|value| value.table()).transpose()
    }

    /// The tables of a list `[[key]]`, none if the key is absent.
    ///
    /// # Errors
    /// It is no list, or an item is no table.
    pub fn tables(&mut self, key: &str) -> Result<Vec<TableReader<'d>>, Reported> {
        let Some(value) = self.value(key) else { return Ok(Vec::new()) };
        let items = value.items(&format!("a list of tables [[{}]]", value.path()))?;
        let tables: Vec<_> = items.iter().map(ValueReader::table).collect();
        tables.into_iter().collect()
    }

    /// The tables `[key.name]` with names of the user's choice, in the order of the file.
    ///
    /// # Errors
    /// The key or something below it is no table.
    pub fn named_tables(&mut self, key: &str) -> Result<Vec<(String, TableReader<'d>)>, Reported> {
        let Some(mut parent) = self.optional_table(key)? else { return Ok(Vec::new()) };
        let names = parent.keys();
        let tables: Vec<_> = names.iter().map(|&name| parent.required_table(name)).collect();
        parent.finish();
        names.into_iter().zip(tables).map(|(name, table)| Ok((name.to_owned(), table?))).collect()
    }

    /// The keys that stand in the file, in its order. They do not count as asked for.
    pub fn keys(&self) -> Vec<&'d str> {
        self.table.in_order().into_iter().map(|(key, _)| key).collect()
    }

    /// The dotted path of this table, empty for the whole file.
    pub fn path(&self) -> &str {
        &self.location.path
    }

    /// The place of the value at `key`, or of this table if the key is absent.
    pub fn location(&self, key: &str) -> Location {
        match self.table.entries.get(key) {
            Some(entry) => Location {
                span: entry.node.span.clone(),
                path: join_path(&self.location.path, key),
                replaced: entry.node.replaced,
            },
            None => self.location.clone(),
        }
    }

    /// Reports a mistake at the value of `key`, or at this table if the key is absent.
    pub fn refuse(&self, key: &str, problem: Problem) -> Reported {
        self.context.report(&self.location(key), problem, None)
    }

    /// As [`Self::refuse`], with advice.
    pub fn refuse_with_help(&self, key: &str, problem: Problem, help: impl Into<String>) -> Reported {
        self.context.report(&self.location(key), problem, Some(help.into()))
    }

    /// Reports a mistake at a remembered place, which may be in another table.
    pub fn refuse_at(&self, location: &Location, problem: Problem) -> Reported {
        self.context.report(location, problem, None)
    }

    fn missing(&self, key: &str, expected: String, example: Option<String>) -> Reported {
        let help = example.map(|value| format!("add for example `{} = {value}`", join_path("", key)));
        self.context.report(&self.location, Problem::MissingKey { key: key.to_owned(), expected }, help)
    }

    /// Closes the table: every key that nobody asked for is reported.
    pub fn finish(self) {
        self.context.close(&self.location);
        let is_known =
            |key: &str| self.asked.contains_key(key) || self.reported.iter().any(|known| known == key);
        let mut asked: Vec<&str> = self.asked.keys().map(String::as_str).collect();
        asked.sort_unstable_by_key(|key| self.asked[*key]);
        let unknown = self.table.in_order().into_iter().filter(|(key, _)| !is_known(key));
        for (key, entry) in unknown {
            // A key that stands here already was not the one that was meant.
            let absent = |known: &&str| !self.table.entries.contains_key(*known);
            let known = asked.iter().copied().filter(absent);
            let problem = Problem::UnknownKey { similar: similar(key, known).map(str::to_owned) };
            let path = join_path(&self.location.path, key);
            let location = Location { span: entry.key_span.clone(), path, replaced: false };
            let help = (!asked.is_empty()).then(|| format!("known keys here: {}", asked.join(", ")));
            self.context.report(&location, problem, help);
        }
    }
}
