//! Reading tables key by key, with every mistake collected.

use crate::error::InputError;
use crate::problem::Problem;
use crate::shape::Shape;
use crate::similar::similar;
use crate::source::Source;
use crate::value::{Node, Table, Value, join_path};
use std::cell::RefCell;
use std::ops::Range;

/// Proof that a mistake has been recorded. It can only be had by reporting one, so that a value
/// cannot get lost without a message.
#[derive(Clone, Copy, Debug)]
pub struct Reported(());

/// The place of a value or table, kept for checks that need more than one table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Location {
    span: Range<usize>,
    /// Dotted path of the key.
    pub path: String,
    replaced: bool,
}

impl Location {
    pub(crate) fn error(&self, source: &Source, problem: Problem) -> InputError {
        InputError {
            place: Some(source.place(&self.span)),
            key: self.path.clone(),
            replaced: self.replaced,
            ..InputError::of_file(&source.name, problem)
        }
    }
}

/// What all readers of one walk share.
pub(crate) struct Context<'d> {
    source: &'d Source,
    errors: RefCell<Vec<InputError>>,
    open: RefCell<Vec<Location>>,
}

impl<'d> Context<'d> {
    pub(crate) fn new(source: &'d Source) -> Self {
        Self { source, errors: RefCell::default(), open: RefCell::default() }
    }

    fn report(&self, location: &Location, problem: Problem, help: Option<String>) -> Reported {
        self.errors.borrow_mut().push(InputError { help, ..location.error(self.source, problem) });
        Reported(())
    }

    /// All mistakes. A table left open is one only if nothing else is wrong: readers stop at mistakes.
    pub(crate) fn into_errors(self) -> Vec<InputError> {
        let mut errors = self.errors.into_inner();
        if errors.is_empty() {
            let unchecked = |location: &Location| location.error(self.source, Problem::Unchecked);
            errors.extend(self.open.borrow().iter().map(unchecked));
        }
        errors
    }
}

/// A table being read. It remembers the keys that were asked for; [`Self::finish`] refuses the others.
pub struct TableReader<'d> {
    context: &'d Context<'d>,
    table: &'d Table,
    location: Location,
    asked: Vec<String>,
}

impl<'d> TableReader<'d> {
    pub(crate) fn new(context: &'d Context<'d>, table: &'d Table, path: String, span: Range<usize>) -> Self {
        let location = Location { span, path, replaced: false };
        context.open.borrow_mut().push(location.clone());
        Self { context, table, location, asked: Vec::new() }
    }

    /// The value at `key`, of whatever kind, if the key is there.
    pub fn value(&mut self, key: &str) -> Option<ValueReader<'d>> {
        if !self.asked.iter().any(|asked| asked == key) {
            self.asked.push(key.to_owned());
        }
        let node = &self.table.entries.get(key)?.node;
        Some(ValueReader { context: self.context, node, path: join_path(&self.location.path, key) })
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
        let items = value.items(&format!("a list of tables [[{}]]", value.path))?;
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
        self.context.open.borrow_mut().retain(|open| *open != self.location);
        let unknown =
            self.table.in_order().into_iter().filter(|(key, _)| !self.asked.iter().any(|a| a == key));
        for (key, entry) in unknown {
            let known = self.asked.iter().map(String::as_str);
            let problem = Problem::UnknownKey { similar: similar(key, known).map(str::to_owned) };
            let path = join_path(&self.location.path, key);
            let location = Location { span: entry.key_span.clone(), path, replaced: false };
            let help =
                (!self.asked.is_empty()).then(|| format!("known keys here: {}", self.asked.join(", ")));
            self.context.report(&location, problem, help);
        }
    }
}

/// One value being read.
pub struct ValueReader<'d> {
    context: &'d Context<'d>,
    node: &'d Node,
    path: String,
}

impl<'d> ValueReader<'d> {
    pub(crate) fn raw(&self) -> &'d Value {
        &self.node.value
    }

    /// Reads the value in a given shape.
    ///
    /// # Errors
    /// It is of another shape; that has been reported.
    pub fn read<S: Shape>(&self, shape: S) -> Result<S::Output, Reported> {
        shape.read(self)
    }

    /// Whether this is a table, for keys that hold either a value or a table.
    pub fn is_table(&self) -> bool {
        matches!(self.node.value, Value::Table(_))
    }

    /// Whether this is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.node.value, Value::List(_))
    }

    /// The text, if this is one.
    pub fn text(&self) -> Option<&'d str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Reads the value as a table.
    ///
    /// # Errors
    /// It is none; that has been reported.
    pub fn table(&self) -> Result<TableReader<'d>, Reported> {
        match &self.node.value {
            Value::Table(table) => {
                Ok(TableReader::new(self.context, table, self.path.clone(), self.node.span.clone()))
            }
            _ => Err(self.wrong_type("a table")),
        }
    }

    /// The items of a list; `expected` says what the list should hold.
    ///
    /// # Errors
    /// It is no list; that has been reported.
    pub fn items(&self, expected: &str) -> Result<Vec<ValueReader<'d>>, Reported> {
        let Value::List(items) = &self.node.value else { return Err(self.wrong_type(expected)) };
        let reader = |(index, node): (usize, &'d Node)| ValueReader {
            context: self.context,
            node,
            path: format!("{}[{index}]", self.path),
        };
        Ok(items.iter().enumerate().map(reader).collect())
    }

    /// The place of this value.
    pub fn location(&self) -> Location {
        Location { span: self.node.span.clone(), path: self.path.clone(), replaced: self.node.replaced }
    }

    /// Reports a mistake at this value.
    pub fn refuse(&self, problem: Problem) -> Reported {
        self.context.report(&self.location(), problem, None)
    }

    /// Reports that this value is of another kind than expected.
    pub fn wrong_type(&self, expected: &str) -> Reported {
        self.refuse(Problem::WrongType { found: self.node.found(), expected: expected.to_owned() })
    }
}
