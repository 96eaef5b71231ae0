//! What differs between the points of a study.

use crate::any_quantity::AnyQuantity;
use crate::context::{Location, Reported};
use crate::decimal::split_number;
use crate::figure::settings::{Settings, read_replacement, refuse_unreadable};
use crate::list::List;
use crate::overrides::Replacement;
use crate::problem::Problem;
use crate::quantity::{QuantityRule, parse_quantity};
use crate::reader::TableReader;
use crate::shape::{Boolean, Text};
use crate::spacing::{RANGE_KEYS, read_range};
use crate::unit::Unit;
use crate::value_reader::ValueReader;
use pulvis_math::Dimension;

/// A variable of a study: one key of the scenario, or several that change together.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyVariable {
    /// How axes and legends call it.
    pub label: String,
    /// The keys that it sets, at least one; the first one is drawn.
    pub keys: Vec<StudyKey>,
    /// Whether its values have names of their own.
    pub is_named: bool,
    /// Whether it is drawn over a logarithmic axis.
    pub logarithmic: bool,
    /// Its values, at least one.
    pub values: Vec<StudyValue>,
    pub(super) location: Location,
}

/// A key of the scenario that a variable sets.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyKey {
    /// Its dotted path.
    pub path: String,
    /// The unit in SI, where all its values are quantities of one dimension: `1` for pure numbers.
    pub unit: Option<String>,
}

/// A value of a variable.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyValue {
    /// As the user wrote or named it.
    pub name: String,
    /// What it sets, key by key.
    pub set: Settings,
    /// The same as numbers in SI, where they are quantities.
    pub numbers: Vec<Option<f64>>,
    pub(super) location: Location,
}

/// A value of a key as it stands in the file.
struct Written {
    replacement: Replacement,
    text: String,
    number: Option<(f64, Dimension)>,
}

/// Reads all `[[study.over]]`.
pub(super) fn read_variables(study: &mut TableReader<'_>) -> Result<Vec<StudyVariable>, Reported> {
    let tables = study.tables("over")?;
    let variables: Vec<_> = tables.into_iter().map(read_variable).collect();
    let variables: Vec<StudyVariable> = variables.into_iter().collect::<Result<_, _>>()?;
    for (index, variable) in variables.iter().enumerate() {
        if variables.iter().take(index).any(|other| other.label == variable.label) {
            let found = format!("two [[study.over]] are called `{}`", variable.label);
            let problem = Problem::rule(found, "a `label` of its own for each");
            return Err(study.refuse_at(&variable.location, problem));
        }
    }
    Ok(variables)
}

fn read_variable(mut table: TableReader<'_>) -> Result<StudyVariable, Reported> {
    let location = table.location("");
    let label = table.optional("label", Text);
    let log = table.optional("log", Boolean);
    let read =
        if table.keys().contains(&"set") { read_together(&mut table) } else { read_one_key(&mut table) };
    let read = read.and_then(|read| refuse_twins(&table, &read.values).map(|()| read));
    table.finish();
    let Read { keys, is_named, spaced_by_ratios, values } = read?;
    let last = |path: &str| path.rsplit('.').next().unwrap_or(path).to_owned();
    let own = keys.first().map(|key| last(&key.path)).unwrap_or_default();
    let (label, logarithmic) = (label?.unwrap_or(own), log?.unwrap_or(spaced_by_ratios));
    Ok(StudyVariable { label, keys, is_named, logarithmic, values, location })
}

struct Read {
    keys: Vec<StudyKey>,
    is_named: bool,
    spaced_by_ratios: bool,
    values: Vec<StudyValue>,
}

/// `key` with `values`, or with `from`, `to`, `points` and `spacing`.
fn read_one_key(table: &mut TableReader<'_>) -> Result<Read, Reported> {
    let path = table.required("key", Text)?;
    refuse_unreadable(table, "key", &path)?;
    if table.value("values").is_none() && RANGE_KEYS.iter().any(|key| table.keys().contains(key)) {
        return read_steps(table, path);
    }
    let Some(list) = table.value("values") else {
        let expected = "a list of values, or `from`, `to` and `points`".to_owned();
        return Err(table.refuse("", Problem::MissingKey { key: "values".to_owned(), expected }));
    };
    if let Some(key) = RANGE_KEYS.into_iter().find(|key| table.value(key).is_some()) {
        let problem = Problem::rule("given beside `values`", "either `values` or `from`, `to`, `points`");
        return Err(table.refuse(key, problem));
    }
    let items = list.items("a list of values")?;
    if items.is_empty() {
        return Err(list.wrong_type("a list of 1 or more values"));
    }
    let written: Vec<_> = items.iter().map(|item| Ok((written(item)?, item.location()))).collect();
    let written = written.into_iter().collect::<Result<Vec<_>, Reported>>()?;
    let unit = unit_of(written.iter().map(|(value, _)| value.number));
    let value = |(value, location): (Written, Location)| StudyValue {
        name: value.text,
        set: vec![(path.clone(), value.replacement)],
        numbers: vec![value.number.filter(|_| unit.is_some()).map(|(number, _)| number)],
        location,
    };
    let values = written.into_iter().map(value).collect();
    Ok(Read {
        keys: vec![StudyKey { path: path.clone(), unit }],
        is_named: false,
        spaced_by_ratios: false,
        values,
    })
}

/// Equal steps or ratios between two ends.
fn read_steps(table: &mut TableReader<'_>, path: String) -> Result<Read, Reported> {
    let (_, dimension) = table.required("from", AnyQuantity)?;
    let mut spaced_by_ratios = false;
    let numbers = read_range(table, QuantityRule::of(dimension), &mut spaced_by_ratios)?;
    let location = table.location("from");
    let unit = dimension.unit();
    let suffix = if unit == "1" { String::new() } else { format!(" {unit}") };
    let value = |number: f64| StudyValue {
        name: format!("{}{suffix}", rounded(number)),
        set: vec![(path.clone(), Replacement::Si(number))],
        numbers: vec![Some(number)],
        location: location.clone(),
    };
    let values = numbers.into_iter().map(value).collect();
    Ok(Read {
        keys: vec![StudyKey { path: path.clone(), unit: Some(unit) }],
        is_named: false,
        spaced_by_ratios,
        values,
    })
}

/// Six digits of a number, as names show it.
fn rounded(number: f64) -> String {
    let short: f64 = format!("{number:.5e}").parse().unwrap_or(number);
    if short == 0.0 || (1e-4..1e6).contains(&short.abs()) { format!("{short}") } else { format!("{short:e}") }
}

/// `set`: several keys that change together.
fn read_together(table: &mut TableReader<'_>) -> Result<Read, Reported> {
    let names = table.optional("names", List::of(Text));
    let tables = table.tables("set")?;
    let names = names?;
    if tables.is_empty() {
        return Err(
            table.refuse("set", Problem::rule("no values", "a list of tables, each with the same keys"))
        );
    }
    if names.as_ref().is_some_and(|names| names.len() != tables.len()) {
        let found = names.as_ref().map_or(0, Vec::len);
        let expected = format!("a name for each of the {} values", tables.len());
        return Err(table.refuse("names", Problem::WrongLength { found, expected }));
    }
    let rows: Vec<_> = tables.into_iter().map(read_row).collect();
    let rows = rows.into_iter().collect::<Result<Vec<Row>, Reported>>()?;
    let paths = same_keys(table, &rows)?;
    let key = |path: &String| StudyKey {
        path: path.clone(),
        unit: unit_of(rows.iter().map(|(row, _)| number(row, path))),
    };
    let keys: Vec<StudyKey> = paths.iter().map(key).collect();
    let values = rows.into_iter().enumerate().map(|(index, (row, location))| {
        let first =
            row.iter().find(|(path, _)| Some(path) == paths.first()).map(|(_, value)| value.text.clone());
        let name = names.as_ref().and_then(|names| names.get(index).cloned()).or(first).unwrap_or_default();
        let of_key = |key: &StudyKey| number(&row, &key.path).filter(|_| key.unit.is_some());
        let numbers = keys.iter().map(|key| of_key(key).map(|(number, _)| number)).collect();
        let set = row.into_iter().map(|(path, value)| (path, value.replacement)).collect();
        StudyValue { name, set, numbers, location }
    });
    let values = values.collect();
    Ok(Read { keys, is_named: names.is_some(), spaced_by_ratios: false, values })
}

fn number(row: &[(String, Written)], path: &str) -> Option<(f64, Dimension)> {
    row.iter().find(|(own, _)| own == path).and_then(|(_, value)| value.number)
}

/// The keys of the first value, which all others must have too.
fn same_keys(table: &TableReader<'_>, rows: &[Row]) -> Result<Vec<String>, Reported> {
    let keys = |(row, _): &Row| row.iter().map(|(path, _)| path.clone()).collect::<Vec<String>>();
    let paths = rows.first().map(keys).unwrap_or_default();
    for row in rows {
        let own = keys(row);
        if own.len() != paths.len() || !paths.iter().all(|path| own.contains(path)) || paths.is_empty() {
            let found = format!("the keys {}", own.join(", "));
            let expected = format!("those of the first value: {}", paths.join(", "));
            return Err(table.refuse_at(&row.1, Problem::rule(found, expected)));
        }
    }
    Ok(paths)
}

type Row = (Vec<(String, Written)>, Location);

fn read_row(mut table: TableReader<'_>) -> Result<Row, Reported> {
    let location = table.location("");
    let keys = table.keys();
    let read: Vec<_> = keys
        .into_iter()
        .filter_map(|key| {
            let value = table.value(key)?;
            let read = refuse_unreadable(&table, key, key).and_then(|()| written(&value));
            Some(read.map(|written| (key.to_owned(), written)))
        })
        .collect();
    table.finish();
    Ok((read.into_iter().collect::<Result<_, Reported>>()?, location))
}

/// The unit of numbers of one dimension; none where one is no number.
fn unit_of(mut numbers: impl Iterator<Item = Option<(f64, Dimension)>>) -> Option<String> {
    let (_, dimension) = numbers.next()??;
    let same = |number: Option<(f64, Dimension)>| number.is_some_and(|(_, own)| own == dimension);
    numbers.all(same).then(|| dimension.unit())
}

fn written(value: &ValueReader<'_>) -> Result<Written, Reported> {
    let replacement = read_replacement(value)?;
    let (text, number) = match &replacement {
        Replacement::Text(text) => (text.clone(), quantity(text)),
        Replacement::Number(number) => (number.to_string(), Some((*number, Dimension::NONE))),
        #[allow(clippy::cast_precision_loss)] // for a picture
        Replacement::Integer(number) => (number.to_string(), Some((*number as f64, Dimension::NONE))),
        other => (other.to_string(), None),
    };
    Ok(Written { replacement, text, number })
}

/// A text as a number in SI, if it is a quantity.
fn quantity(text: &str) -> Option<(f64, Dimension)> {
    let (_, unit) = split_number(text.trim())?;
    let dimension = Unit::parse(unit).ok()?.dimension;
    let number = parse_quantity(text, QuantityRule::of(dimension)).ok()?;
    Some((number, dimension))
}

/// Refuses two values that folders could not tell apart.
fn refuse_twins(table: &TableReader<'_>, values: &[StudyValue]) -> Result<(), Reported> {
    let names: Vec<String> = values.iter().map(|value| plain(&value.name).to_lowercase()).collect();
    for (index, (name, value)) in names.iter().zip(values).enumerate() {
        if names.iter().take(index).any(|other| other == name) {
            let found = format!(
                "the value {} stands there twice, or differs from another one in signs that names of folders do not have",
                value.name
            );
            return Err(table.refuse_at(
                &value.location,
                Problem::rule(found, "values that differ in letters or digits"),
            ));
        }
    }
    Ok(())
}

/// A text as a part of the name of a folder: letters, digits, points, signs; all else becomes one hyphen.
pub(super) fn plain(text: &str) -> String {
    let mut name = String::new();
    for letter in text.trim().chars() {
        if letter.is_alphanumeric() || matches!(letter, '.' | '+' | '-' | '_') {
            name.push(letter);
        } else if !name.ends_with('-') {
            name.push('-');
        }
    }
    name.trim_matches('.').to_owned()
}
