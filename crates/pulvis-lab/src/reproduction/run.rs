//! Many figures, on all processors.

use super::report::{feature_file, feature_table};
use super::{Reproduction, ReproductionError, Workplace, reproduce};
use crate::at_once::at_once;
use pulvis_input::figure::{Experiment, FigureScenario};
use std::num::NonZero;
use std::time::Instant;

/// A figure that was computed, or why it could not be.
#[derive(Debug)]
pub struct Attempt {
    /// The figure.
    pub figure: FigureScenario,
    /// What came of it.
    pub outcome: Result<Reproduction, ReproductionError>,
    /// Time that it took, pictures included [s].
    pub duration: f64,
}

impl Attempt {
    /// Whether it was computed and fulfils all its checks.
    pub fn passes(&self) -> bool {
        self.outcome.as_ref().is_ok_and(Reproduction::passes)
    }
}

/// Computes figures and writes picture, with `dpi` pixels to the inch, and table of each into the folder of the workplace,
/// which exists. A figure that fails does not stop the others. `done` is told of each figure that is finished. Figures that
/// have not begun when the workplace is stopped are left out.
pub fn run_all(
    figures: Vec<FigureScenario>,
    workplace: &Workplace<'_>,
    dpi: u32,
    done: &mut dyn FnMut(&Attempt),
) -> Vec<Attempt> {
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get).min(figures.len());
    // Runs take longest and keep all processors busy: they come first.
    let mut order: Vec<usize> = (0..figures.len()).collect();
    order.sort_by_key(|number| figures.get(*number).is_some_and(|figure| !has_runs(figure)));
    let mut attempts: Vec<(usize, Attempt)> = Vec::with_capacity(figures.len());
    let work = |task: usize| {
        let number = *order.get(task)?;
        Some((number, attempt(figures.get(number)?, workplace, dpi)))
    };
    at_once(order.len(), threads, workplace.stop, &work, &mut |_, attempted| {
        if let Some((number, attempt)) = attempted
            && !matches!(attempt.outcome, Err(ReproductionError::Interrupted))
        {
            done(&attempt);
            attempts.push((number, attempt));
        }
    });
    attempts.sort_by_key(|(number, _)| *number);
    attempts.into_iter().map(|(_, attempt)| attempt).collect()
}

fn has_runs(figure: &FigureScenario) -> bool {
    figure.data.iter().any(|data| matches!(data.experiment, Experiment::Runs(_)))
}

fn attempt(figure: &FigureScenario, workplace: &Workplace<'_>, dpi: u32) -> Attempt {
    let start = Instant::now();
    let outcome = reproduce(figure, workplace).and_then(|reproduction| {
        let file = |ending: &str| workplace.folder.join(format!("{}.{ending}", figure.name));
        reproduction.picture.clone().dpi(dpi).write(&file("png"))?;
        reproduction.picture.write(&file("svg"))?;
        reproduction.table.write(&file("csv"))?;
        if let Some(features) = feature_table(figure, &reproduction)? {
            features.write(&workplace.folder.join(feature_file(figure)))?;
        }
        Ok(reproduction)
    });
    Attempt { figure: figure.clone(), outcome, duration: start.elapsed().as_secs_f64() }
}
