//! Pictures of the particles of a figure's runs, at the ends of stages.

use super::ReproductionError;
use super::results::{Kind, Results};
use super::workplace::Workplace;
use crate::rendering::{FrameChoice, Plan, Quantity, Rendering, ViewPoint};
use pulvis_input::figure::{FigureScenario, FigureSnapshots};

/// A picture of particles.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Which pictures it belongs to: their title.
    pub title: String,
    /// The stage at whose end it was taken.
    pub stage: String,
    /// Name of its file.
    pub file: String,
    /// The file.
    pub png: Vec<u8>,
}

/// Draws all pictures of a figure into the folder of the workplace.
pub(super) fn draw(
    figure: &FigureScenario,
    results: &Results<'_>,
    workplace: &Workplace<'_>,
) -> Result<Vec<Snapshot>, ReproductionError> {
    let mut all = Vec::new();
    for wanted in &figure.snapshots {
        for (&stage, name) in wanted.stages.iter().zip(&wanted.stage_names) {
            all.extend(draw_one(figure, wanted, (stage, name), results, workplace)?);
        }
    }
    Ok(all)
}

fn draw_one(
    figure: &FigureScenario,
    wanted: &FigureSnapshots,
    (stage, name): (usize, &str),
    results: &Results<'_>,
    workplace: &Workplace<'_>,
) -> Result<Option<Snapshot>, ReproductionError> {
    let Some(Kind::Runs(runs)) = results.of(wanted.data).map(|of_data| &of_data.kind) else {
        return Ok(None);
    };
    let Some(run) = runs.iter().find(|run| run.variant == wanted.variant) else { return Ok(None) };
    let data = figure.data.get(wanted.data).map_or("", |data| data.name.as_str());
    let time = run.column("time")?;
    let end = run.rows(Some(stage)).last().map_or(f64::NAN, |row| row.at(time));
    let plan = Plan {
        frames: FrameChoice::Time(end),
        colour: wanted.colour.as_deref().map(Quantity::named),
        // Its names are those that the figure may use.
        view: wanted.view.parse::<ViewPoint>().unwrap_or_default(),
        size: wanted.size,
        // Other figures are computed beside.
        threads: 1,
        ..Plan::default()
    };
    let file = file_name(figure, wanted, name);
    let path = workplace.folder.join(&file);
    let failed = |source| ReproductionError::Snapshot { data: data.to_owned(), source: Box::new(source) };
    let rendering = Rendering::prepare(&run.folder, plan, Some(&path)).map_err(failed)?;
    rendering.write(workplace.stop, &mut || ()).map_err(failed)?;
    let png = std::fs::read(&path)
        .map_err(|error| ReproductionError::TimeSeries { file: path.clone(), reason: error.to_string() })?;
    Ok(Some(Snapshot { title: wanted.title.clone(), stage: name.to_owned(), file, png }))
}

/// Names of the files of all pictures.
pub(super) fn snapshot_files(figure: &FigureScenario) -> Vec<String> {
    let of = |wanted: &FigureSnapshots| {
        let stages = wanted.stage_names.iter().map(|stage| file_name(figure, wanted, stage));
        stages.collect::<Vec<_>>()
    };
    figure.snapshots.iter().flat_map(of).collect()
}

fn file_name(figure: &FigureScenario, wanted: &FigureSnapshots, stage: &str) -> String {
    let data = figure.data.get(wanted.data).map_or("", |data| data.name.as_str());
    format!("{}-{}-{}.png", figure.name, plain(data), plain(stage))
}

/// A name as part of that of a file.
pub(super) fn plain(name: &str) -> String {
    name.chars().map(|letter| if letter.is_alphanumeric() || letter == '.' { letter } else { '-' }).collect()
}
