//! The tree of a TOML file: every key and value with its place.

use crate::problem::{LONGEST_VALUE, shortened};
use std::collections::BTreeMap;
use std::ops::Range;
use toml::de::{DeInteger, DeTable, DeValue};

/// A value and the bytes of the file that it stands in.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) span: Range<usize>,
    pub(crate) value: Value,
    /// Set from outside the file (sweep, stage, command line); the span is that of the replaced value.
    pub(crate) replaced: bool,
}

/// What a scenario file can hold. Numbers stay text until their unit is known.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Text(String),
    /// Decimal digits of a whole number.
    Integer(String),
    /// Decimal digits, or `inf` and `nan`.
    Number(String),
    /// A number that a program has set, in SI whatever the dimension.
    Si(f64),
    Boolean(bool),
    Date(String),
    List(Vec<Node>),
    Table(Table),
}

/// A table: keys with their own places.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Table {
    pub(crate) entries: BTreeMap<String, Entry>,
}

/// One key of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) key_span: Range<usize>,
    pub(crate) node: Node,
}

impl Table {
    /// The table of a parsed file.
    pub(crate) fn from_toml(table: &DeTable<'_>) -> Self {
        let entries = table.iter().map(|(key, value)| {
            let node = Node::from_toml(value.get_ref(), value.span());
            (key.get_ref().to_string(), Entry { key_span: key.span(), node })
        });
        Self { entries: entries.collect() }
    }

    /// The entries in the order of the file.
    pub(crate) fn in_order(&self) -> Vec<(&str, &Entry)> {
        let mut entries: Vec<_> = self.entries.iter().map(|(key, entry)| (key.as_str(), entry)).collect();
        entries.sort_by_key(|(_, entry)| entry.key_span.start);
        entries
    }
}

impl Entry {
    /// Gives up the places in another file: values stand at `span` from now on, and keys keep their order behind the
    /// `end` of the text.
    pub(crate) fn move_to(&mut self, span: &Range<usize>, end: usize) {
        self.key_span = self.key_span.start + end..self.key_span.end + end;
        self.node.move_to(span, end);
    }
}

impl Node {
    fn move_to(&mut self, span: &Range<usize>, end: usize) {
        self.span = span.clone();
        match &mut self.value {
            Value::Table(table) => table.entries.values_mut().for_each(|entry| entry.move_to(span, end)),
            Value::List(items) => items.iter_mut().for_each(|item| item.move_to(span, end)),
            _ => {}
        }
    }

    /// Takes bare numbers, here and below, as values in SI. A whole number that no double holds stays as it is: it counts
    /// something.
    pub(crate) fn count_in_si(&mut self) {
        match &mut self.value {
            Value::Integer(digits) | Value::Number(digits) => {
                let whole = matches!(digits.parse::<i64>(), Ok(whole) if whole.unsigned_abs() > 1 << 53);
                if let Some(number) = digits.replace('_', "").parse().ok().filter(|_| !whole) {
                    self.value = Value::Si(number);
                }
            }
            Value::Table(table) => table.entries.values_mut().for_each(|entry| entry.node.count_in_si()),
            Value::List(items) => items.iter_mut().for_each(Self::count_in_si),
            Value::Text(_) | Value::Si(_) | Value::Boolean(_) | Value::Date(_) => {}
        }
    }

    fn from_toml(value: &DeValue<'_>, span: Range<usize>) -> Self {
        let value = match value {
            DeValue::String(text) => Value::Text(text.to_string()),
            DeValue::Integer(integer) => Value::Integer(decimal_digits(integer)),
            DeValue::Float(float) => Value::Number(float.as_str().to_owned()),
            DeValue::Boolean(boolean) => Value::Boolean(*boolean),
            DeValue::Datetime(date) => Value::Date(date.to_string()),
            DeValue::Array(items) => {
                Value::List(items.iter().map(|item| Self::from_toml(item.get_ref(), item.span())).collect())
            }
            DeValue::Table(table) => Value::Table(Table::from_toml(table)),
        };
        Self { span, value, replaced: false }
    }

    /// What stands here, as an error names it: texts in quotes, numbers bare.
    pub(crate) fn found(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("the text \"{}\"", shortened(text, LONGEST_VALUE)),
            Value::Integer(digits) | Value::Number(digits) => {
                format!("the number {}", shortened(digits, LONGEST_VALUE))
            }
            Value::Si(value) => format!("the number {value}"),
            Value::Boolean(boolean) => boolean.to_string(),
            Value::Date(date) => format!("the date {date}"),
            Value::List(_) => "a list".to_owned(),
            Value::Table(_) => "a table".to_owned(),
        }
    }
}

/// `0xff` as `255`. What does not fit stays as it is written and is refused when it is read.
fn decimal_digits(integer: &DeInteger<'_>) -> String {
    match (integer.radix(), u128::from_str_radix(integer.as_str(), integer.radix())) {
        (10, _) | (_, Err(_)) => integer.as_str().to_owned(),
        (_, Ok(value)) => value.to_string(),
    }
}

/// A step of a dotted path such as `stages[1].end`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Key(String),
    Index(usize),
}

/// Splits a dotted path; names with dots or blanks stand in quotes: `materials."a b"`.
///
/// `None` where a quote or bracket is not closed or a name is empty.
pub(crate) fn split_path(path: &str) -> Option<Vec<Step>> {
    let mut steps = Vec::new();
    let mut rest = path.trim();
    loop {
        let (name, tail) = match rest.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"')?,
            None => rest.split_at(rest.find(['.', '[']).unwrap_or(rest.len())),
        };
        if name.is_empty() {
            return None;
        }
        steps.push(Step::Key(name.to_owned()));
        rest = tail;
        while let Some(bracket) = rest.strip_prefix('[') {
            let (index, tail) = bracket.split_once(']')?;
            steps.push(Step::Index(index.trim().parse().ok()?));
            rest = tail;
        }
        match rest.strip_prefix('.') {
            Some(tail) => rest = tail,
            None => return rest.is_empty().then_some(steps),
        }
    }
}

/// `contact` and `normal` joined to `contact.normal`; names with blanks or dots are quoted.
pub(crate) fn join_path(parent: &str, key: &str) -> String {
    let plain = !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-'));
    let key = if plain { key.to_owned() } else { format!("\"{key}\"") };
    if parent.is_empty() { key } else { format!("{parent}.{key}") }
}
