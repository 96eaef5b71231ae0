//! Runs of a figure: scenarios of `pulvis run`, one for each variant, which may start from one another.

use super::settings::{Settings, Variant};
use crate::document::Document;
use crate::error::InputErrors;
use crate::scenario::Scenario;
use std::path::Path;

/// A scenario of `pulvis run` in all its variants.
#[derive(Clone, Debug)]
pub struct Runs {
    /// The data whose last state these runs start from.
    pub after: Option<usize>,
    /// What the figure sets in the scenario.
    pub set: Settings,
    /// One run for each variant that the data is for.
    pub planned: Vec<PlannedRun>,
}

/// One run of a figure.
#[derive(Clone, Debug)]
pub struct PlannedRun {
    /// Number of the variant.
    pub variant: usize,
    /// What is run. Where it starts from another run, `start_from` still is the text of its file.
    pub scenario: Scenario,
}

impl Runs {
    /// The run in a variant.
    pub fn in_variant(&self, variant: usize) -> Option<&PlannedRun> {
        self.planned.iter().find(|run| run.variant == variant)
    }
}

/// Reads a scenario in the chosen variants. What one that starts from another run does not say, it has from the end of that
/// run, whose own plan is `parent`.
pub(super) fn plan(
    document: &Document,
    path: &Path,
    set: &Settings,
    variants: &[(usize, &Variant)],
    parent: Option<&Runs>,
) -> Result<Vec<PlannedRun>, InputErrors> {
    let start = document.start_from(path.parent().unwrap_or(Path::new("")))?;
    let mut planned = Vec::with_capacity(variants.len());
    for &(variant, Variant { name: _, set: of_variant }) in variants {
        let parent = parent.and_then(|parent| parent.in_variant(variant));
        let mut all = set.clone();
        let mut own = document.clone();
        match (&start, parent) {
            (Some((_, place)), Some(parent)) => {
                let last = parent.scenario.stages.len().saturating_sub(1);
                let state = parent.scenario.as_in_stage(last, None).to_resolved_toml("");
                let base = Document::from_str("the run that it starts from", &state)?;
                own = own.with_missing_from(&base, &["title", "start_from", "stages", "output"], place);
            }
            _ => all.extend(of_variant.iter().cloned()),
        }
        let scenario = Scenario::from_document(&own.with_overrides(&all)?, Some(path))?;
        planned.push(PlannedRun { variant, scenario });
    }
    Ok(planned)
}
