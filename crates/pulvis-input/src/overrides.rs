//! Values set from outside the file: by a sweep, a stage or the command line.

use crate::error::{InputError, InputErrors};
use crate::problem::Problem;
use crate::similar::similar;
use crate::source::Source;
use crate::value::{Node, Step, Table, Value, join_path, split_path};
use std::ops::Range;

/// A value that takes the place of one in the file.
#[derive(Clone, Debug, PartialEq)]
pub enum Replacement {
    /// A number in SI, whatever the dimension of the key: what a program computes.
    Si(f64),
    /// A text, as if it stood in quotes in the file: `5 mm`, `linear`.
    Text(String),
    /// A bare number, as if it stood in the file.
    Number(f64),
    /// A whole number.
    Integer(i64),
    /// True or false.
    Boolean(bool),
    /// Another value of the same file, with its place: see [`crate::ValueReader::replacement`].
    Copied(Copied),
}

/// A value of a file, with its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Copied(pub(crate) Node);

impl Replacement {
    /// What a user typed after `key=`: a number or `true` as such, everything else as a text.
    pub fn parse(text: &str) -> Self {
        let text = text.trim();
        let quoted = text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
        match (quoted, text) {
            (Some(inner), _) => Self::Text(inner.to_owned()),
            (None, "true") => Self::Boolean(true),
            (None, "false") => Self::Boolean(false),
            (None, text) => match (text.parse(), text.parse()) {
                (Ok(integer), _) => Self::Integer(integer),
                (_, Ok(number)) => Self::Number(number),
                _ => Self::Text(text.to_owned()),
            },
        }
    }

    /// Puts the value in the place of another one.
    pub(crate) fn apply(self, node: &mut Node) {
        node.value = match self {
            Self::Si(value) => Value::Si(value),
            Self::Text(text) => Value::Text(text),
            Self::Number(value) => Value::Number(value.to_string()),
            Self::Integer(value) => Value::Integer(value.to_string()),
            Self::Boolean(boolean) => Value::Boolean(boolean),
            Self::Copied(Copied(other)) => {
                *node = other;
                return;
            }
        };
        node.replaced = true;
    }
}

impl std::fmt::Display for Replacement {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Si(value) | Self::Number(value) => write!(formatter, "{value}"),
            Self::Text(text) => write!(formatter, "\"{text}\""),
            Self::Integer(value) => write!(formatter, "{value}"),
            Self::Boolean(value) => write!(formatter, "{value}"),
            Self::Copied(_) => formatter.write_str("a value of the file"),
        }
    }
}

impl From<&str> for Replacement {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

/// Replaces the value at `path`.
pub(crate) fn replace(
    root: &mut Table,
    source: &Source,
    path: &str,
    value: Replacement,
) -> Result<(), InputErrors> {
    let unreadable = || InputError::of_file(&source.name, Problem::UnreadablePath { path: path.to_owned() });
    let steps = split_path(path).ok_or_else(unreadable)?;
    let Some((Step::Key(first), rest)) = steps.split_first() else {
        return Err(unreadable().into());
    };
    let lost = |lost: Lost| {
        let (way, place, problem) = *lost;
        InputError {
            place: place.map(|span| source.place(&span)),
            key: way,
            ..InputError::of_file(&source.name, problem)
        }
    };
    let mut way = String::new();
    let mut node = enter(root, first, &mut way, None).map_err(lost)?;
    for step in rest {
        node = descend(node, step, &mut way).map_err(lost)?;
    }
    let found = match node.value {
        Value::Table(_) => Some("a table"),
        Value::List(_) => Some("a list"),
        _ => None,
    };
    if let Some(found) = found {
        return Err(lost(Box::new((way, Some(node.span.clone()), Problem::NotReplaceable { found }))).into());
    }
    value.apply(node);
    Ok(())
}

/// Where the path was lost: the way so far, its place, and why.
type Lost = Box<(String, Option<Range<usize>>, Problem)>;

fn enter<'t>(
    table: &'t mut Table,
    key: &str,
    way: &mut String,
    place: Option<Range<usize>>,
) -> Result<&'t mut Node, Lost> {
    if !table.entries.contains_key(key) {
        let known = table.entries.keys().map(String::as_str);
        let problem = Problem::NothingToReplace {
            key: key.to_owned(),
            similar: similar(key, known).map(str::to_owned),
        };
        return Err(Box::new((way.clone(), place, problem)));
    }
    *way = join_path(way, key);
    match table.entries.get_mut(key) {
        Some(entry) => Ok(&mut entry.node),
        None => Err(Box::new((
            way.clone(),
            place,
            Problem::NothingToReplace { key: key.to_owned(), similar: None },
        ))),
    }
}

fn descend<'t>(node: &'t mut Node, step: &Step, way: &mut String) -> Result<&'t mut Node, Lost> {
    let place = Some(node.span.clone());
    match (&mut node.value, step) {
        (Value::Table(table), Step::Key(key)) => enter(table, key, way, place),
        (Value::List(items), Step::Index(index)) if *index < items.len() => {
            way.push_str(&format!("[{index}]"));
            let missing = Problem::NothingToReplace { key: index.to_string(), similar: None };
            items.get_mut(*index).ok_or_else(|| Box::new((way.clone(), place, missing)))
        }
        (_, step) => {
            let key = match step {
                Step::Key(key) => key.clone(),
                Step::Index(index) => format!("[{index}]"),
            };
            Err(Box::new((way.clone(), place, Problem::NothingToReplace { key, similar: None })))
        }
    }
}
