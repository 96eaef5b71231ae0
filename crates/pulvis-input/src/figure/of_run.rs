//! What a curve shows of the time series of a run.

use super::Experiment;
use super::data::FigureData;
use super::feature::{chosen_stage, goes_through_cycles, pair};
use super::settings::Variant;
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Text};
use pulvis_math::Dimension;

/// Which part of which runs a curve shows, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct OfRun {
    /// One variant only: its number. Without it each variant has a curve.
    pub variant: Option<usize>,
    /// Rows of one stage only: its index.
    pub stage: Option<usize>,
    /// Part of the cycles of the wall that moves in the stage, in cycles from its start.
    pub cycles: Option<[f64; 2]>,
    /// Where on the curve arrows show its direction, in cycles.
    pub arrows: Vec<f64>,
    /// Whether the line is thick.
    pub thick: bool,
}

/// What a curve of a run shows.
pub(super) fn read_of_run(
    table: &mut TableReader<'_>,
    data: &FigureData,
    variants: &[Variant],
) -> Result<OfRun, Reported> {
    let variant = table.optional("variant", Text);
    let stage = table.optional("stage", Text);
    let number = || QuantityRule::of(Dimension::NONE).at_least(0.0);
    let cycles = table.optional("cycles", List::of(number()).exactly(2));
    let arrows = table.or("arrows", List::of(number()), Vec::new());
    let thick = table.or("thick", Boolean, false);
    let Experiment::Runs(runs) = &data.experiment else {
        return Err(table.refuse("show", Problem::rule("this is no run", "data whose file has [[stages]]")));
    };
    let variant = variant?.map(|name| {
        let known: Vec<usize> = runs.planned.iter().map(|run| run.variant).collect();
        let named = |number: &usize| variants.get(*number).map_or("", |variant| variant.name.as_str());
        let found = known.iter().copied().find(|number| named(number) == name);
        found.ok_or_else(|| {
            let known: Vec<&str> = known.iter().map(named).collect();
            table.refuse("variant", Problem::unknown_choice(&name, &known))
        })
    });
    let stages = runs.planned.first().map(|run| run.scenario.stages.as_slice()).unwrap_or_default();
    let stage = chosen_stage(table, stage?, stages, None)?;
    let (cycles, arrows) = (cycles?.as_deref().and_then(pair), arrows?);
    let moves = stage.and_then(|stage| stages.get(stage)).is_some_and(goes_through_cycles);
    if (cycles.is_some() || !arrows.is_empty()) && !moves {
        let key = if cycles.is_some() { "cycles" } else { "arrows" };
        let found = format!("no wall of `{}` goes through cycles there", data.name);
        let expected = "a `stage` in which a wall moves by control = \"cosine\"";
        return Err(table.refuse(key, Problem::rule(found, expected)));
    }
    Ok(OfRun { variant: variant.transpose()?, stage, cycles, arrows, thick: thick? })
}
