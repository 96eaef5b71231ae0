//! Pictures of particles at the ends of stages.

use super::Experiment;
use super::data::FigureData;
use super::runs::PlannedRun;
use super::settings::Variant;
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::scenario::Snapshots;
use crate::shape::{Integer, Name, Text};

/// Pictures of the particles of one run, beside one another.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureSnapshots {
    /// What they show.
    pub title: String,
    /// Number of the data.
    pub data: usize,
    /// Number of the variant.
    pub variant: usize,
    /// The stages at whose ends they are taken: their indices.
    pub stages: Vec<usize>,
    /// And their names.
    pub stage_names: Vec<String>,
    /// What particles are coloured by, as `pulvis render --color` has it.
    pub colour: Option<String>,
    /// From where: `x`, `y`, `z` or `iso`.
    pub view: &'static str,
    /// Width and height \[pixel\].
    pub size: [u32; 2],
}

/// Sides of a picture \[pixel\].
const SIDES: [i64; 2] = [100, 4000];

/// Reads all `[[snapshots]]`.
pub(super) fn read_snapshots(
    root: &mut TableReader<'_>,
    data: &[FigureData],
    variants: &[Variant],
) -> Result<Vec<FigureSnapshots>, Reported> {
    let tables = root.tables("snapshots")?;
    let all: Vec<_> = tables.into_iter().map(|table| read_one(table, data, variants)).collect();
    all.into_iter().collect()
}

fn read_one(
    mut table: TableReader<'_>,
    data: &[FigureData],
    variants: &[Variant],
) -> Result<FigureSnapshots, Reported> {
    let title = table.required("title", Text);
    let name = table.required("data", Text);
    let variant = table.optional("variant", Text);
    let named = table.required("stages", List::of(Text).at_least(1));
    let colour = table.optional("color", Text);
    let view = table.or("view", Name(&["x", "y", "z", "iso"]), "iso");
    let side = Integer::between(SIDES[0], SIDES[1]);
    let size = table.or("size", List::of(side).exactly(2), vec![600, 600]);
    let run = match (name, variant, named) {
        (Ok(name), Ok(variant), Ok(named)) => {
            find(&table, (data, variants), &name, variant.as_deref(), named)
        }
        (Err(reported), ..) | (_, Err(reported), _) | (.., Err(reported)) => Err(reported),
    };
    table.finish();
    let ChosenRun { data, variant, stages, stage_names } = run?;
    let sides = size?;
    let size = [0, 1].map(|side| sides.get(side).and_then(|side| u32::try_from(*side).ok()).unwrap_or(600));
    Ok(FigureSnapshots {
        title: title?,
        data,
        variant,
        stages,
        stage_names,
        colour: colour?,
        view: view?,
        size,
    })
}

/// A run of the figure, and stages of it.
struct ChosenRun {
    data: usize,
    variant: usize,
    stages: Vec<usize>,
    stage_names: Vec<String>,
}

fn find(
    table: &TableReader<'_>,
    (data, variants): (&[FigureData], &[Variant]),
    name: &str,
    variant: Option<&str>,
    stage_names: Vec<String>,
) -> Result<ChosenRun, Reported> {
    let Some(number) = data.iter().position(|data| data.name == name) else {
        let known: Vec<&str> = data.iter().map(|data| data.name.as_str()).collect();
        return Err(table.refuse("data", Problem::unknown_choice(name, &known)));
    };
    let Some(Experiment::Runs(runs)) = data.get(number).map(|data| &data.experiment) else {
        return Err(table.refuse("data", Problem::rule("no run", "data whose file has [[stages]]")));
    };
    let of_variant = |run: &PlannedRun| variants.get(run.variant).map_or("", |variant| variant.name.as_str());
    let wanted = |run: &&PlannedRun| variant.is_none_or(|wanted| of_variant(run) == wanted);
    let Some(planned) = runs.planned.iter().find(wanted) else {
        let known: Vec<&str> = runs.planned.iter().map(of_variant).collect();
        return Err(table.refuse("variant", Problem::unknown_choice(variant.unwrap_or_default(), &known)));
    };
    if planned.scenario.output.snapshots == Snapshots::Never {
        let found = format!("`{name}` writes no frames");
        return Err(table.refuse("data", Problem::rule(found, "`vtk = true` in [output] of its file")));
    }
    let all: Vec<&str> = planned.scenario.stages.iter().map(|stage| stage.name.as_str()).collect();
    let place = |stage: &String| {
        let position = all.iter().position(|name| name == stage);
        position.ok_or_else(|| table.refuse("stages", Problem::unknown_choice(stage, &all)))
    };
    let stages = stage_names.iter().map(place).collect::<Result<_, _>>()?;
    Ok(ChosenRun { data: number, variant: planned.variant, stages, stage_names })
}
