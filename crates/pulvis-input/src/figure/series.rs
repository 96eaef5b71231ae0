//! One curve of a panel.

use super::axis::FigureAxis;
use super::data::{FigureData, chosen, contact};
use super::expression::checked;
use super::feature::Feature;
use super::formula::{Formula, needed, read_formula};
use super::of_run::{OfRun, read_of_run};
use super::quantity::{Family, Quantity};
use super::reference::{ReferenceTable, read_reference};
use super::settings::Variant;
use super::{Experiment, Surroundings};
use crate::collision::CollisionScenario;
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Name, Text};
use pulvis_math::Dimension;

/// A limit of the closed form of the restitution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approximation {
    /// 1 − η χ/2, for χ → 0, S1 section 5.1.
    Slow,
    /// (η χ)^(−1/2), for η χ ≫ 1 without adhesion, S1 (C.2).
    Plastic,
    /// √(1/(η χ) − β), for η χ ≫ 1 and β ≪ 1, S1 (C.3).
    WeakAdhesion,
    /// η^(−1/2) χ^(−1/4), for k2 that grows with √δ_max, S1 (D.2) without its misprint.
    SquareRoot,
}

/// What a curve shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Show {
    /// The closed form.
    Theory,
    /// A limit of the closed form.
    Approximation(Approximation),
    /// The exact method; along a path the one method that there is.
    Exact,
    /// The engine's integrator at the automatic time step.
    Engine,
    /// Those collisions of the engine that end in one way.
    Regime {
        /// Whether those that stick.
        sticks: bool,
    },
    /// The limits of sticking of each contact: closed forms.
    Limits,
    /// The limits of sticking of each contact, searched for by the exact method.
    SearchedLimits,
    /// Values of a table.
    Reference(ReferenceTable),
    /// The time series of a run.
    Run(OfRun),
    /// A closed form, over the times of a run or between the features of a panel.
    Formula(Formula),
    /// Features: their indices.
    Features(Vec<usize>),
}

/// A curve of a panel, or one for each contact or collision that fits.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureSeries {
    /// Index of the data; of none where features are shown.
    pub data: usize,
    /// What it shows.
    pub show: Show,
    /// Of one contact only: its number.
    pub contact: Option<usize>,
    /// Of one collision of a sweep only: its number among those of a contact.
    pub case: Option<usize>,
    /// A quantity on the vertical axis in place of the panel's, of the same unit.
    pub y: Option<Quantity>,
    /// What it is called.
    pub label: Option<String>,
    /// Whether the legend shows it.
    pub in_legend: bool,
}

const SHOWN: [&str; 14] = [
    "theory",
    "slow",
    "plastic",
    "weak-adhesion",
    "square-root",
    "exact",
    "engine",
    "engine-sticks",
    "engine-rebounds",
    "limits",
    "searched-limits",
    "reference",
    "run",
    "formula",
];

/// The family that a piece of data has, if a quantity of the name is in it.
pub(super) fn families(data: &FigureData) -> &'static [Family] {
    match data.experiment {
        Experiment::Collisions(_) => &[Family::Collision, Family::Course],
        Experiment::Probe(_) => &[Family::Path],
        Experiment::Runs(_) => &[Family::Run],
    }
}

/// Reads a curve of a panel.
pub(super) fn read_series(
    mut table: TableReader<'_>,
    (data, variants): (&[FigureData], &[Variant]),
    (family, axis): (Family, Option<&FigureAxis>),
    around: &Surroundings<'_>,
) -> Result<FigureSeries, Reported> {
    let index = chosen(&mut table, data);
    let name = table.required("show", Name(&SHOWN));
    let label = table.optional("label", Text);
    let in_legend = table.or("legend", Boolean, true);
    let (index, name) = match (index, name) {
        (Ok(index), Ok(name)) => (index, name),
        (Err(reported), _) | (_, Err(reported)) => {
            for key in
                ["contact", "at", "file", "y", "variant", "stage", "cycles", "arrows", "thick", "formula"]
            {
                let _ = table.value(key);
            }
            table.finish();
            return Err(reported);
        }
    };
    let one = data.get(index).ok_or_else(|| table.refuse("data", Problem::rule("no such data", "a name")))?;
    if !families(one).contains(&family) {
        let found = format!("`{}` has no such quantities", one.name);
        return Err(table.refuse("data", Problem::rule(found, "data of the kind that the axes show")));
    }
    let contact = contact(&mut table, one);
    let case = read_case(&mut table, one);
    let y = read_y(&mut table, family, axis);
    let formula =
        read_formula(&mut table).and_then(|formula| needed(&table, formula, "show", name == "formula"));
    let show = match name {
        "theory" => Ok(Show::Theory),
        "slow" => Ok(Show::Approximation(Approximation::Slow)),
        "plastic" => Ok(Show::Approximation(Approximation::Plastic)),
        "weak-adhesion" => Ok(Show::Approximation(Approximation::WeakAdhesion)),
        "square-root" => Ok(Show::Approximation(Approximation::SquareRoot)),
        "exact" => Ok(Show::Exact),
        "engine" => Ok(Show::Engine),
        "engine-sticks" => Ok(Show::Regime { sticks: true }),
        "engine-rebounds" => Ok(Show::Regime { sticks: false }),
        "limits" => Ok(Show::Limits),
        "searched-limits" => Ok(Show::SearchedLimits),
        "run" => read_of_run(&mut table, one, variants).map(Show::Run),
        // It is there: `needed` has made sure.
        "formula" => formula.and_then(|formula| {
            formula.map(Show::Formula).ok_or_else(|| table.refuse("", Problem::rule("no formula", "one")))
        }),
        _ => read_reference(&mut table, "file", around).map(Show::Reference),
    };
    let of_run = |show: &Show| matches!(show, Show::Run(_) | Show::Formula(_));
    let of_any = |show: &Show| matches!(show, Show::Reference(_)) && family == Family::Run;
    if matches!(&show, Ok(show) if of_run(show) != (family == Family::Run) && !of_any(show)) {
        let expected =
            if family == Family::Run { "\"run\", \"formula\" or \"reference\"" } else { "another word" };
        let found = if family == Family::Run { "this is the time series of a run" } else { "this is no run" };
        return Err(table.refuse("show", Problem::rule(found, expected)));
    }
    let of_whole =
        matches!(show, Ok(Show::Theory | Show::Approximation(_) | Show::Limits | Show::SearchedLimits));
    let of_whole = of_whole || matches!(show, Ok(Show::Regime { .. }));
    if of_whole && family != Family::Collision {
        let problem = Problem::rule("this is about whole collisions", "\"exact\" or \"engine\"");
        return Err(table.refuse("show", problem));
    }
    if matches!(show, Ok(Show::Engine)) && family == Family::Path {
        let problem = Problem::rule("a prescribed path has one method", "\"exact\"");
        return Err(table.refuse("show", problem));
    }
    table.finish();
    formula?;
    Ok(FigureSeries {
        data: index,
        show: show?,
        contact: contact?,
        case: case?,
        y: y?,
        label: label?,
        in_legend: in_legend?,
    })
}

/// Reads a curve of a panel that shows features.
pub(super) fn read_feature_series(
    mut table: TableReader<'_>,
    features: &[Feature],
    around: &Surroundings<'_>,
) -> Result<FigureSeries, Reported> {
    let name = table.required("show", Name(&["features", "formula", "reference"]));
    let label = table.optional("label", Text);
    let in_legend = table.or("legend", Boolean, true);
    let key = table.optional("feature", Text);
    let is_formula = name.as_ref().is_ok_and(|name| *name == "formula");
    let formula = read_formula(&mut table).and_then(|formula| needed(&table, formula, "show", is_formula));
    let show = match name? {
        "features" => features_of(&table, key?, features).map(Show::Features),
        // It is there: `needed` has made sure.
        "formula" => formula.and_then(|formula| {
            formula.map(Show::Formula).ok_or_else(|| table.refuse("", Problem::rule("no formula", "one")))
        }),
        _ => read_reference(&mut table, "file", around).map(Show::Reference),
    };
    table.finish();
    Ok(FigureSeries {
        data: usize::MAX,
        show: show?,
        contact: None,
        case: None,
        y: None,
        label: label?,
        in_legend: in_legend?,
    })
}

/// The features with a key that have a place on an axis.
fn features_of(
    table: &TableReader<'_>,
    key: Option<String>,
    features: &[Feature],
) -> Result<Vec<usize>, Reported> {
    let placed = || features.iter().enumerate().filter(|(_, feature)| feature.at.is_some());
    let key = key.unwrap_or_default();
    let found: Vec<usize> = placed().filter(|(_, one)| one.key == key).map(|(number, _)| number).collect();
    if found.is_empty() {
        let mut known: Vec<&str> = placed().map(|(_, feature)| feature.key.as_str()).collect();
        known.dedup();
        return Err(table.refuse("feature", Problem::unknown_choice(&key, &known)));
    }
    Ok(found)
}

/// A quantity on the vertical axis in place of the panel's.
fn read_y(
    table: &mut TableReader<'_>,
    family: Family,
    axis: Option<&FigureAxis>,
) -> Result<Option<Quantity>, Reported> {
    let Some(name) = table.optional("y", Text)? else { return Ok(None) };
    if family == Family::Run && family.find(&name).is_none() {
        return checked(table, "y", name).map(|name| Some(Quantity::of_expression(&name)));
    }
    let same_unit = |quantity: &&Quantity| axis.is_none_or(|axis| quantity.unit == axis.quantity.unit);
    let known: Vec<Quantity> = family.quantities().iter().filter(same_unit).copied().collect();
    let found = known.iter().find(|quantity| quantity.name == name).copied();
    found.map(Some).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|quantity| quantity.name).collect();
        table.refuse("y", Problem::unknown_choice(&name, &names))
    })
}

/// The collision of a sweep whose value is `at`.
pub(super) fn read_case(table: &mut TableReader<'_>, data: &FigureData) -> Result<Option<usize>, Reported> {
    let at = table.optional("at", QuantityRule::of(Dimension::NONE))?;
    let (Some(at), Experiment::Collisions(scenario)) = (at, &data.experiment) else { return Ok(None) };
    let values = values(scenario);
    let near = |value: &f64| (value - at).abs() <= 1e-9 * at.abs();
    values.iter().position(near).map(Some).ok_or_else(|| {
        let found = format!("no collision of `{}` has {} = {at}", data.name, scenario.variable.name());
        table.refuse("at", Problem::rule(found, "one of the values of the sweep"))
    })
}

/// The swept values.
fn values(scenario: &CollisionScenario) -> Vec<f64> {
    let first = scenario.cases.iter().filter(|case| case.contact_number == 0);
    first.map(|case| case.value).collect()
}
