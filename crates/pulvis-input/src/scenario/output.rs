//! What a run writes, how often, and where.

use super::output_files::{OutputFiles, Sample, read_output_files};
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Integer, Name, Text};
use crate::value_reader::ValueReader;
use pulvis_math::Dimension;
use std::path::{Component, Path, PathBuf};

/// What a run writes.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputPlan {
    /// The folder of all files, relative to the current folder.
    pub folder: PathBuf,
    /// How often the time series gets a row.
    pub timeseries: Interval,
    /// When particles and contacts are written.
    pub snapshots: Snapshots,
    /// Further files of particles and contacts.
    pub files: Vec<OutputFiles>,
    /// Whether plots are drawn.
    pub plots: bool,
    /// Whether the time series tells which particles hang together, and what joins them.
    pub clusters: ClusterRule,
    /// When the state is written, so that the run can be resumed; `None`: never.
    pub checkpoints: Option<CheckpointPlan>,
    /// The scales of the dimensionless columns, if these are wanted.
    pub dimensionless: Option<Dimensionless>,
}

/// What joins particles to groups in the time series.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ClusterRule {
    /// Nothing: the time series does not tell groups.
    #[default]
    Never,
    /// Contacts that act.
    Acting,
    /// Contacts that act and whose bodies are not on their way apart: see `ContactView::is_bound` of the engine.
    Bound,
}

/// How often something happens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Interval {
    /// After this many time steps, at least 1.
    Steps(u64),
    /// After this time [s].
    Time(f64),
}

/// When the state of a run is written. It always is when the run ends, whatever ends it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CheckpointPlan {
    /// After this wall-clock time [s]; may be infinite.
    pub wall_clock: f64,
    /// Regularly in simulated time or steps.
    pub every: Option<Interval>,
    /// Whether the state at the end of each stage is kept, in a file of its own.
    pub stage_ends: bool,
}

impl Default for CheckpointPlan {
    /// Every ten minutes.
    fn default() -> Self {
        Self { wall_clock: 600.0, every: None, stage_ends: false }
    }
}

/// When particles and contacts are written for ParaView.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Snapshots {
    /// Never.
    Never,
    /// At the end of each stage.
    StageEnds,
    /// Regularly, and at the end of each stage.
    Every(Interval),
}

/// Scales of D = (L − L0)/length and F* = F/(stiffness length), and when L0 is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensionless {
    /// Length scale [m].
    pub length: f64,
    /// Stiffness scale [N/m].
    pub stiffness: f64,
    /// Index of the stage at whose end L is taken for L0; until then, and where there is none, L0 is
    /// the length at the start of the run.
    pub reference_stage: Option<usize>,
}

/// Rows of the time series are written after this many steps where nothing is said.
const DEFAULT_STEPS: u64 = 100;

/// Reads `[output]`; `source` is the scenario file, whose name the folder takes where it has none, and
/// `sample` is what regions and columns of further files may refer to, and `stages` are the names of the stages, if these
/// could be read.
pub(super) fn read_output(
    root: &mut TableReader<'_>,
    source: &Path,
    sample: &Sample<'_>,
    stages: Option<&[&str]>,
) -> Result<OutputPlan, Reported> {
    let stem = source.file_stem().map_or_else(|| "scenario".into(), |stem| stem.to_string_lossy());
    let default = OutputPlan {
        folder: PathBuf::from(format!("{stem}-run")),
        timeseries: Interval::Steps(DEFAULT_STEPS),
        snapshots: Snapshots::StageEnds,
        files: Vec::new(),
        plots: true,
        clusters: ClusterRule::Never,
        checkpoints: Some(CheckpointPlan::default()),
        dimensionless: None,
    };
    if root.value("output").is_some_and(|value| matches!(value.raw(), crate::value::Value::List(_))) {
        let problem = Problem::rule("[[output]] is a list of tables", "one table [output]");
        return Err(root.refuse_with_help(
            "output",
            problem,
            "write [[output.files]] for each further format",
        ));
    }
    let Some(mut table) = root.optional_table("output")? else { return Ok(default) };
    let folder = table.optional("folder", Text).and_then(|folder| match folder {
        Some(text) if leaves(&text) => {
            let problem = Problem::rule(
                format!("the folder {text:?} is not below the current one"),
                "a relative path without `..`",
            );
            let help =
                "a file is not to write anywhere: name other places on the command line, `--output DIR`";
            Err(table.refuse_with_help("folder", problem, help))
        }
        folder => Ok(folder),
    });
    let timeseries = table.value("timeseries").map(|value| read_interval(&value)).transpose();
    let snapshots = table.value("vtk").map(|value| read_snapshots(&value)).transpose();
    let files = read_output_files(&mut table, sample);
    let plots = table.or("plots", Boolean, default.plots);
    let clusters = table.or("clusters", ClusterShape, default.clusters);
    let checkpoints = table.value("checkpoints").map(|value| read_checkpoints(&value)).transpose();
    let dimensionless = table.optional_table("dimensionless").and_then(|scales| match scales {
        Some(scales) => read_dimensionless(scales, stages).map(Some),
        None => Ok(None),
    });
    table.finish();
    Ok(OutputPlan {
        folder: folder?.map_or(default.folder, PathBuf::from),
        timeseries: timeseries?.unwrap_or(default.timeseries),
        snapshots: snapshots?.unwrap_or(default.snapshots),
        files: files?,
        plots: plots?,
        clusters: clusters?,
        checkpoints: checkpoints?.unwrap_or(default.checkpoints),
        dimensionless: dimensionless?,
    })
}

/// Whether a path leads out of the current folder.
fn leaves(path: &str) -> bool {
    let stays = |part: Component<'_>| matches!(part, Component::Normal(_) | Component::CurDir);
    !Path::new(path).components().all(stays)
}

fn read_snapshots(value: &ValueReader<'_>) -> Result<Snapshots, Reported> {
    if value.is_table() {
        return read_interval(value).map(Snapshots::Every);
    }
    let wanted = value.read(VtkShape)?;
    Ok(if wanted { Snapshots::StageEnds } else { Snapshots::Never })
}

fn read_checkpoints(value: &ValueReader<'_>) -> Result<Option<CheckpointPlan>, Reported> {
    let default = CheckpointPlan::default();
    if !value.is_table() {
        return Ok(value.read(CheckpointShape)?.then_some(default));
    }
    let mut table = value.table()?;
    let rule = QuantityRule::of(Dimension::TIME).above(0.0).or_infinite();
    let wall_clock = table.or("wall_clock", rule, default.wall_clock);
    let every = read_either(&mut table);
    let stage_ends = table.or("stage_ends", Boolean, default.stage_ends);
    table.finish();
    Ok(Some(CheckpointPlan { wall_clock: wall_clock?, every: every?, stage_ends: stage_ends? }))
}

/// `true`, `false` or a table, as the message names it.
struct CheckpointShape;

impl crate::shape::Shape for CheckpointShape {
    type Output = bool;

    fn describe(&self) -> String {
        "true (every 10 minutes), false or { wall_clock = \"10 min\", interval = \"1 ms\", stage_ends = true }"
            .to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<bool, Reported> {
        match value.raw() {
            crate::value::Value::Boolean(wanted) => Ok(*wanted),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}

/// `true`, `false` or `"bound"`, as the message names it.
struct ClusterShape;

impl crate::shape::Shape for ClusterShape {
    type Output = ClusterRule;

    fn describe(&self) -> String {
        "false, true or \"bound\"".to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<ClusterRule, Reported> {
        match value.raw() {
            crate::value::Value::Boolean(true) => Ok(ClusterRule::Acting),
            crate::value::Value::Boolean(false) => Ok(ClusterRule::Never),
            crate::value::Value::Text(word) if word == "bound" => Ok(ClusterRule::Bound),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}

/// `true`, `false` or a table, as the message names it.
struct VtkShape;

impl crate::shape::Shape for VtkShape {
    type Output = bool;

    fn describe(&self) -> String {
        "false, true (at the end of each stage) or { interval = \"1 us\" }".to_owned()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<bool, Reported> {
        match value.raw() {
            crate::value::Value::Boolean(wanted) => Ok(*wanted),
            _ => Err(value.wrong_type(&self.describe())),
        }
    }
}

fn read_interval(value: &ValueReader<'_>) -> Result<Interval, Reported> {
    let mut table = value.table()?;
    let result = read_either(&mut table).and_then(|interval| {
        interval.ok_or_else(|| {
            let expected = "{ steps = 100 } or { interval = \"1 us\" }";
            table.refuse("", Problem::rule("the table is empty", expected))
        })
    });
    table.finish();
    result
}

/// `steps` or `interval`, if one of them is given.
pub(super) fn read_either(table: &mut TableReader<'_>) -> Result<Option<Interval>, Reported> {
    let steps = table.optional("steps", Integer::at_least(1));
    let interval = table.optional("interval", QuantityRule::of(Dimension::TIME).above(0.0));
    match (steps?, interval?) {
        (Some(_), Some(_)) => {
            Err(table.refuse("interval", Problem::rule("given beside `steps`", "only one of them")))
        }
        (steps, interval) => {
            Ok(steps.map(|steps| Interval::Steps(steps.unsigned_abs())).or(interval.map(Interval::Time)))
        }
    }
}

fn read_dimensionless(
    mut table: TableReader<'_>,
    stages: Option<&[&str]>,
) -> Result<Dimensionless, Reported> {
    let length = table.required("length", QuantityRule::of(Dimension::LENGTH).above(0.0));
    let stiffness = table.required("stiffness", QuantityRule::of(Dimension::STIFFNESS).above(0.0));
    let reference = match stages {
        Some(stages) => table.optional("reference_stage", Name(stages)),
        None => table.optional("reference_stage", Text).map(|_| None),
    };
    table.finish();
    let place = |name: &str| stages.and_then(|stages| stages.iter().position(|stage| *stage == name));
    let reference_stage = reference?.and_then(place);
    Ok(Dimensionless { length: length?, stiffness: stiffness?, reference_stage })
}
