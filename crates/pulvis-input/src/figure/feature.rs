//! Features of runs: numbers out of their time series, and the bounds between which they have to lie.

use super::Experiment;
use super::data::{FigureData, chosen};
use super::expression::checked;
use super::formula::{Formula, needed, read_formula};
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::scenario::{Stage, WallControl, WallMotion};
use crate::shape::{Choice, Name, Text};
use pulvis_math::Dimension;

/// What is seen in a run, as a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its short name.
    pub key: String,
    /// What it is, in words.
    pub what: String,
    /// Where it stands on the axis of a panel of features, and in a fit.
    pub at: Option<f64>,
    /// What its number is made of.
    pub source: Source,
    /// The least value; minus infinity where none is asked for.
    pub least: f64,
    /// The largest value.
    pub most: f64,
    /// Where the bounds come from.
    pub why: String,
    /// Why it is known to be missed; then a miss is reported and fails nothing.
    pub known_to_miss: Option<String>,
}

/// What the number of a feature is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Source {
    /// Rows of a run.
    Rows {
        /// The number.
        measure: Box<Measure>,
        /// By what it is divided.
        over: Option<Box<Measure>>,
    },
    /// Features at several places, by a line through them.
    Fit(Fit),
}

/// v = value at zero + slope at^power by least squares, of the values v of features.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Indices of the features, which stand before this one.
    pub of: Vec<usize>,
    /// The power of their places.
    pub power: f64,
    /// Whether the slope is the number, not the value at zero.
    pub is_slope: bool,
}

impl Source {
    /// All that it takes out of rows.
    pub fn measures(&self) -> impl Iterator<Item = &Measure> {
        let (one, other) = match self {
            Self::Rows { measure, over } => (Some(&**measure), over.as_deref()),
            Self::Fit(_) => (None, None),
        };
        one.into_iter().chain(other)
    }
}

/// A number out of rows of a time series.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// Index of the data.
    pub data: usize,
    /// How it is made of the rows.
    pub value: Value,
    /// The column along the horizontal axis, for those values that need one.
    pub x: String,
    /// The column that counts.
    pub y: String,
    /// Rows of one stage only: its index.
    pub stage: Option<usize>,
    /// Part of the cycles of the wall that moves in the stage, in cycles from its start.
    pub cycles: Option<[f64; 2]>,
    /// Rows only in which a column lies between two numbers.
    pub within: Option<Within>,
    /// The closed form that y is divided by, for those values that need one.
    pub formula: Option<Formula>,
}

/// Rows in which a column lies between two numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Within {
    /// The column.
    pub column: String,
    /// The two numbers.
    pub ends: [f64; 2],
}

/// How a number is made of rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// y in the first row.
    First,
    /// y in the last row.
    Last,
    /// The least y.
    Minimum,
    /// The largest y.
    Maximum,
    /// The mean of y.
    Mean,
    /// The last y less the first one.
    Change,
    /// x where y is least.
    WhereMinimum,
    /// x where y is largest.
    WhereMaximum,
    /// x where y is zero for the first time, by a straight line between rows; where it never is, x where it is nearest to zero.
    Zero,
    /// The slope of y over x by least squares.
    Slope,
    /// y of that straight line at x = 0.
    AtZero,
    /// R² of that straight line.
    Straightness,
    /// The largest ∮ y dx of a cycle, over the ranges of x and y in the stage.
    LoopArea,
    /// How much y differs between the ends of cycles, as means over the last tenth of each, over its range in the stage.
    Drift,
    /// The mean of y over the closed form at x.
    OverFormula,
    /// The largest of the ratios of the largest y of a cycle to that of the cycle before.
    Growth,
}

impl Value {
    /// All of them, with their names.
    pub const NAMED: [(&'static str, Self); 16] = [
        ("first", Self::First),
        ("last", Self::Last),
        ("minimum", Self::Minimum),
        ("maximum", Self::Maximum),
        ("mean", Self::Mean),
        ("change", Self::Change),
        ("where-minimum", Self::WhereMinimum),
        ("where-maximum", Self::WhereMaximum),
        ("zero", Self::Zero),
        ("slope", Self::Slope),
        ("at-zero", Self::AtZero),
        ("straightness", Self::Straightness),
        ("loop-area", Self::LoopArea),
        ("drift", Self::Drift),
        ("growth", Self::Growth),
        ("over-formula", Self::OverFormula),
    ];

    /// Whether it compares whole cycles.
    pub fn is_of_cycles(self) -> bool {
        matches!(self, Self::LoopArea | Self::Drift | Self::Growth)
    }
}

/// Reads all `[[features]]`.
pub(super) fn read_features(
    root: &mut TableReader<'_>,
    data: &[FigureData],
) -> Result<Vec<Feature>, Reported> {
    let tables = root.tables("features")?;
    let mut features: Vec<Feature> = Vec::new();
    let mut failure = None;
    for table in tables {
        match read_feature(table, data, (&features, failure)) {
            Ok(feature) => features.push(feature),
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(features), Err)
}

fn read_feature(
    mut table: TableReader<'_>,
    data: &[FigureData],
    before: (&[Feature], Option<Reported>),
) -> Result<Feature, Reported> {
    let key = table.required("key", Text);
    let what = table.required("what", Text);
    let why = table.required("why", Text);
    let known_to_miss = table.optional("known_to_miss", Text);
    let least = table.optional("least", Dimension::NONE);
    let most = table.optional("most", Dimension::NONE);
    let at = table.optional("at", Dimension::NONE);
    let fit = table.optional_table("fit").and_then(|fit| fit.map(|fit| read_fit(fit, before)).transpose());
    let source = match fit {
        Ok(Some(fit)) => Ok(Source::Fit(fit)),
        Ok(None) => read_source(&mut table, data),
        Err(reported) => Err(reported),
    };
    let bounds =
        match (least, most) {
            (Ok(None), Ok(None)) => {
                let problem = Problem::rule("a feature that nothing is asked of", "`least`, `most` or both");
                Err(table.refuse("", problem))
            }
            (Ok(Some(least)), Ok(Some(most))) if least > most => Err(table
                .refuse("least", Problem::rule(format!("{least} is above most = {most}"), "least <= most"))),
            (Ok(least), Ok(most)) => Ok([least.unwrap_or(f64::NEG_INFINITY), most.unwrap_or(f64::INFINITY)]),
            (Err(reported), _) | (_, Err(reported)) => Err(reported),
        };
    table.finish();
    let [least, most] = bounds?;
    Ok(Feature {
        key: key?,
        what: what?,
        at: at?,
        source: source?,
        least,
        most,
        why: why?,
        known_to_miss: known_to_miss?,
    })
}

fn read_source(table: &mut TableReader<'_>, data: &[FigureData]) -> Result<Source, Reported> {
    let measure = read_measure(table, data, None);
    let over = table.optional_table("over").and_then(|over| {
        let Some(mut over) = over else { return Ok(None) };
        let read = read_measure(&mut over, data, measure.as_ref().ok());
        over.finish();
        read.map(Some)
    });
    Ok(Source::Rows { measure: Box::new(measure?), over: over?.map(Box::new) })
}

/// Reads a fit through the features `before` that have its key and a place.
fn read_fit(
    mut table: TableReader<'_>,
    (before, failure): (&[Feature], Option<Reported>),
) -> Result<Fit, Reported> {
    let key = table.required("of", Text);
    let power = table.or("power", QuantityRule::of(Dimension::NONE).above(0.0), 1.0);
    let value = table.or("value", Name(&["at-zero", "slope"]), "at-zero");
    let least = table.or("from", Dimension::NONE, f64::NEG_INFINITY);
    let most = table.or("to", Dimension::NONE, f64::INFINITY);
    let (key, least, most) = (key?, least?, most?);
    let fits =
        |feature: &Feature| feature.key == key && feature.at.is_some_and(|at| at >= least && at <= most);
    let of: Vec<usize> =
        before.iter().enumerate().filter(|(_, one)| fits(one)).map(|(number, _)| number).collect();
    if of.len() < 2 {
        // Those that are missing may be the ones with mistakes of their own.
        return Err(failure.unwrap_or_else(|| {
            let found = format!("features `{key}` above with an `at` in the range: {}", of.len());
            table.refuse("of", Problem::rule(found, "two or more"))
        }));
    }
    table.finish();
    Ok(Fit { of, power: power?, is_slope: value? == "slope" })
}

/// Reads a measure of one of the `data`; what it does not say is as in `base`, if there is one.
fn read_measure(
    table: &mut TableReader<'_>,
    data: &[FigureData],
    base: Option<&Measure>,
) -> Result<Measure, Reported> {
    let index = match base {
        Some(base) if table.value("data").is_none() => Ok(base.data),
        _ => chosen(table, data),
    };
    let of = |index: usize| match data.get(index) {
        Some(FigureData { experiment: Experiment::Runs(runs), name, .. }) => {
            let stages = runs.planned.first().map(|run| run.scenario.stages.as_slice()).unwrap_or_default();
            Some(Measured { data: index, name, stages })
        }
        _ => None,
    };
    read_rows(table, index.map(of), base)
}

/// A run that something is measured of.
#[derive(Clone, Copy)]
pub(crate) struct Measured<'r> {
    /// Index of the data.
    pub(crate) data: usize,
    /// What it is called.
    pub(crate) name: &'r str,
    pub(crate) stages: &'r [Stage],
}

/// Reads which number is made of which rows of a run; what is not said is as in `base`, if there is one.
pub(crate) fn read_rows(
    table: &mut TableReader<'_>,
    measured: Result<Option<Measured<'_>>, Reported>,
    base: Option<&Measure>,
) -> Result<Measure, Reported> {
    let (value, y) = match base {
        Some(base) => {
            (table.or("value", Choice(&Value::NAMED), base.value), table.or("y", Text, base.y.clone()))
        }
        None => (table.required("value", Choice(&Value::NAMED)), table.required("y", Text)),
    };
    let y = y.and_then(|y| checked(table, "y", y));
    let x = table.or("x", Text, base.map_or_else(|| "time".to_owned(), |base| base.x.clone()));
    let x = x.and_then(|x| checked(table, "x", x));
    let ends = || List::of(QuantityRule::of(Dimension::NONE)).exactly(2);
    let cycles = table.optional("cycles", ends()).map(|ends| ends.as_deref().and_then(pair));
    let within = table.optional_table("within").and_then(|within| within.map(read_within).transpose());
    let stage = table.optional("stage", Text);
    let formula = read_formula(table);
    let Some(Measured { data: index, name, stages }) = measured? else {
        return Err(table.refuse("data", Problem::rule("no run", "data whose file has [[stages]]")));
    };
    let same_data = base.filter(|base| base.data == index);
    let stage = chosen_stage(table, stage?, stages, same_data.and_then(|base| base.stage))?;
    let value = value?;
    let cycles = cycles?.or(base.and_then(|base| base.cycles));
    if (cycles.is_some() || value.is_of_cycles())
        && !stage.and_then(|stage| stages.get(stage)).is_some_and(goes_through_cycles)
    {
        let found = format!("no wall of `{name}` goes through cycles there");
        let problem = Problem::rule(found, "a `stage` in which a wall moves by control = \"cosine\"");
        return Err(table.refuse(if cycles.is_some() { "cycles" } else { "value" }, problem));
    }
    let within = within?.or(base.and_then(|base| base.within.clone()));
    let formula = formula?.or(base.and_then(|base| base.formula));
    let formula = needed(table, formula, "value", value == Value::OverFormula)?;
    Ok(Measure { data: index, value, x: x?, y: y?, stage, cycles, within, formula })
}

/// The index of the stage that is named; without a name that of the only one, or `default`.
pub(super) fn chosen_stage(
    table: &TableReader<'_>,
    named: Option<String>,
    stages: &[Stage],
    default: Option<usize>,
) -> Result<Option<usize>, Reported> {
    match (named, stages) {
        (None, [_]) => Ok(Some(0)),
        (None, _) => Ok(default),
        (Some(named), stages) => {
            let position = stages.iter().position(|stage| stage.name == named);
            position.map(Some).ok_or_else(|| {
                let known: Vec<&str> = stages.iter().map(|stage| stage.name.as_str()).collect();
                table.refuse("stage", Problem::unknown_choice(&named, &known))
            })
        }
    }
}

/// Whether a wall begins to move by a cosine in a stage.
pub(super) fn goes_through_cycles(stage: &Stage) -> bool {
    let is_cosine = |control: &WallControl| matches!(control, WallControl::Motion(WallMotion::Cosine(_)));
    stage.controls.iter().any(|(_, control)| is_cosine(control))
}

/// A pair of numbers.
pub(super) fn pair(numbers: &[f64]) -> Option<[f64; 2]> {
    numbers.try_into().ok()
}

fn read_within(mut table: TableReader<'_>) -> Result<Within, Reported> {
    let column = table.required("column", Text).and_then(|column| checked(&table, "column", column));
    let from = table.required("from", Dimension::NONE);
    let to = table.required("to", Dimension::NONE);
    table.finish();
    Ok(Within { column: column?, ends: [from?, to?] })
}
