//! A figure of a paper that can be reproduced: its folder, what is computed, what is drawn and what is checked.
//!
//! The folder holds `figure.toml`, the scenarios of `pulvis collide`, `pulvis probe` and `pulvis run` that it names, and tables
//! of reference values. Notes that several figures share, on misprints and on decisions where a paper leaves a choice, stand
//! in `notes.toml` of the folder above.

mod axis;
mod check;
mod data;
mod expression;
pub(crate) mod feature;
mod formula;
mod notes;
mod of_run;
mod panel;
mod quantity;
mod reference;
mod runs;
mod series;
pub(crate) mod settings;
mod snapshots;

pub use axis::FigureAxis;
pub use check::{Against, FigureCheck};
pub use data::{Experiment, FigureData};
pub use expression::Expression;
pub use feature::{Feature, Fit, Measure, Source, Value, Within};
pub use formula::Formula;
pub use notes::Note;
pub use of_run::OfRun;
pub use panel::{FigurePanel, Guide};
pub use quantity::{
    Family, OF_COLLISIONS, OF_COURSES, OF_FEATURES, OF_PATHS, OF_RUNS, Quantity, Scale, limited_pair,
};
pub use reference::ReferenceTable;
pub use runs::{PlannedRun, Runs};
pub use series::{Approximation, FigureSeries, Show};
pub use settings::{Settings, Variant};
pub use snapshots::FigureSnapshots;

use crate::context::Reported;
use crate::document::Document;
use crate::error::{InputError, InputErrors};
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::{Boolean, Integer, Text};
use check::read_checks;
use data::read_data;
use feature::read_features;
use notes::read_notes;
use panel::read_panels;
use settings::read_variants;
use snapshots::read_snapshots;
use std::cell::RefCell;
use std::path::Path;

/// The file that makes a folder a figure.
pub const FIGURE_FILE: &str = "figure.toml";

/// A figure as its folder describes it.
#[derive(Clone, Debug)]
pub struct FigureScenario {
    /// The name of its folder.
    pub name: String,
    /// What it shows, in one line.
    pub title: String,
    /// The printed figures that it reproduces.
    pub reproduces: Vec<String>,
    /// Its caption.
    pub caption: String,
    /// What the paper says that its figure shows, and what was compared.
    pub compared: String,
    /// Misprints and decisions that touch it.
    pub notes: Vec<Note>,
    /// Whether it takes long, so that it is left out unless asked for.
    pub is_long: bool,
    /// Charts beside one another.
    pub columns: usize,
    /// The ways in which runs are computed, at least one.
    pub variants: Vec<Variant>,
    /// What is computed.
    pub data: Vec<FigureData>,
    /// What is drawn.
    pub panels: Vec<FigurePanel>,
    /// Pictures of particles.
    pub snapshots: Vec<FigureSnapshots>,
    /// What is checked.
    pub checks: Vec<FigureCheck>,
    /// What is seen in its runs.
    pub features: Vec<Feature>,
}

/// What the parts of a figure's file share while it is read.
struct Surroundings<'f> {
    folder: &'f Path,
    /// Mistakes in the scenarios that the figure names.
    elsewhere: RefCell<Vec<InputError>>,
}

impl FigureScenario {
    /// Reads the figure in a folder, with the scenarios and tables that it names.
    ///
    /// # Errors
    /// All mistakes in its file, in its scenarios, or in `notes.toml` of the folder above.
    pub fn load(folder: impl AsRef<Path>) -> Result<Self, InputErrors> {
        let folder = folder.as_ref();
        let document = Document::load(folder.join(FIGURE_FILE))?;
        let around = Surroundings { folder, elsewhere: RefCell::default() };
        let read = document.read(|root| walk(root, &around));
        let mut mistakes = around.elsewhere.into_inner();
        match read {
            Ok(figure) if mistakes.is_empty() => Ok(figure),
            Ok(_) => Err(InputErrors::in_order(mistakes)),
            // The scenario's own mistakes come first: those of the figure may follow from them.
            Err(errors) => {
                mistakes.extend(errors.into_errors());
                Err(InputErrors::in_order(mistakes))
            }
        }
    }
}

fn walk(mut root: TableReader<'_>, around: &Surroundings<'_>) -> Result<FigureScenario, Reported> {
    let title = root.required("title", Text);
    let reproduces = root.or("reproduces", List::of(Text), Vec::new());
    let caption = root.required("caption", Text);
    let compared = root.required("compared", Text);
    let notes = read_notes(&mut root, around);
    let is_long = root.or("long", Boolean, false);
    let columns = root.or("columns", Integer::between(1, 3), 1);
    let variants = read_variants(&mut root);
    let data = match &variants {
        Ok(variants) => read_data(&mut root, variants, around),
        Err(reported) => root.value("data").map_or(Err(*reported), |_| Err(*reported)),
    };
    let variant_list = variants.as_deref().unwrap_or_default();
    let (panels, snapshots, checks, features) = match &data {
        Ok(data) => {
            let features = read_features(&mut root, data);
            let seen = features.as_deref().map_err(|reported| *reported);
            (
                read_panels(&mut root, (data, variant_list, seen), around),
                read_snapshots(&mut root, data, variant_list),
                read_checks(&mut root, data, around),
                features,
            )
        }
        // Without the data nobody knows what can be drawn.
        Err(reported) => {
            let _ = ["panels", "snapshots", "checks", "features"].map(|key| root.value(key).is_some());
            (Err(*reported), Err(*reported), Err(*reported), Err(*reported))
        }
    };
    if let (Ok(data), Ok(panels), Ok(checks)) = (&data, &panels, &checks) {
        can_be_measured(&root, data, panels, checks)?;
    }
    root.finish();
    let name = around.folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(FigureScenario {
        name,
        title: title?,
        reproduces: reproduces?,
        caption: one_paragraph(&caption?),
        compared: one_paragraph(&compared?),
        notes: notes?,
        is_long: is_long?,
        columns: usize::try_from(columns?).unwrap_or(1),
        data: data?,
        panels: panels?,
        snapshots: snapshots?,
        checks: checks?,
        features: features?,
        variants: variants?,
    })
}

/// Refuses units of the plastic limit for contacts that have none.
fn can_be_measured(
    root: &TableReader<'_>,
    data: &[FigureData],
    panels: &[FigurePanel],
    checks: &[FigureCheck],
) -> Result<(), Reported> {
    let has_unit = |number: usize, scale: Scale| {
        let of_limit = !matches!(scale, Scale::Si | Scale::ImpactEnergy);
        !of_limit || data.get(number).is_some_and(|data| data.reference_pair().is_some())
    };
    let drawn = panels.iter().flat_map(|panel| {
        panel
            .series
            .iter()
            .flat_map(|series| [panel.x.scale, panel.y.scale].map(|scale| (series.data, scale)))
    });
    let drawn = drawn.map(|used| ("panels", used));
    let checked = checks.iter().map(|check| ("checks", (check.data, check.scale)));
    match drawn.chain(checked).find(|(_, (number, scale))| !has_unit(*number, *scale)) {
        None => Ok(()),
        Some((key, (number, _))) => {
            let name = data.get(number).map_or("", |data| data.name.as_str());
            let found = format!("the first contact of `{name}` has no plastic limit to measure by");
            Err(root.refuse(key, Problem::rule(found, "no `per`, or `luding` with kp > k1")))
        }
    }
}

/// A text that was broken into lines for the eye.
pub(crate) fn one_paragraph(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
