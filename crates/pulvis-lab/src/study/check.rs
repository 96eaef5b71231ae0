//! What can be known of a study before its first run.

use super::{Plan, PlannedRun, StudyError};
use crate::at_once::at_once;
use crate::protocol::{PrepareError, preflight, prepare, stages, start_alike, warnings};
use pulvis_input::Problem;
use pulvis_input::study::Study;
use std::sync::atomic::AtomicBool;

/// What every point is like.
#[derive(Clone, Debug, Default)]
pub struct Checked {
    /// What is valid and yet probably not meant: the text, the first point that it is said of, and how many more there are.
    pub warnings: Vec<(String, String, usize)>,
    /// The size of a run at each point.
    pub forecasts: Vec<Forecast>,
}

/// The size of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forecast {
    /// Number of particles.
    pub particles: usize,
    /// Steps that it takes at least.
    pub least_steps: u64,
    /// Steps of all stages whose duration is known.
    pub steps: u64,
    /// Whether stages may end by other rules than time.
    pub open_ended: bool,
}

/// Prepares the first run of every point, by so many threads.
///
/// # Errors
/// A point that cannot be run, or seeds that change nothing.
pub fn check(study: &Study, plan: &Plan, threads: usize, stop: &AtomicBool) -> Result<Checked, StudyError> {
    refuse_idle_seeds(study, plan)?;
    let firsts: Vec<&PlannedRun> =
        plan.runs.chunk_by(|one, other| one.point == other.point).filter_map(<[_]>::first).collect();
    let mut found: Vec<Option<Look>> = firsts.iter().map(|_| None).collect();
    let work = |number: usize| firsts.get(number).map(|run| look(run));
    at_once(firsts.len(), threads, stop, &work, &mut |number, result| {
        if let Some(slot) = found.get_mut(number) {
            *slot = result;
        }
    });
    let mut checked = Checked::default();
    for (run, result) in firsts.iter().zip(found) {
        let point = study.points.get(run.point).map_or("", |point| point.name.as_str());
        // Left out only where the user has stopped the program.
        let Some(result) = result else { continue };
        let (forecast, warnings) =
            result.map_err(|source| StudyError::Point { point: point.to_owned(), source })?;
        checked.forecasts.push(forecast);
        for text in warnings {
            match checked.warnings.iter_mut().find(|(known, ..)| *known == text) {
                Some((.., further)) => *further += 1,
                None => checked.warnings.push((text, point.to_owned(), 0)),
            }
        }
    }
    Ok(checked)
}

/// The size of a run, and what is to be warned of.
type Look = Result<(Forecast, Vec<String>), PrepareError>;

fn look(run: &PlannedRun) -> Look {
    let prepared = prepare(&run.scenario)?;
    let stages = stages(&run.scenario, &prepared);
    let forecast = Forecast {
        particles: prepared.particles.len(),
        least_steps: stages.iter().map(|stage| stage.least_steps).sum(),
        steps: stages.iter().filter_map(|stage| stage.steps).sum(),
        open_ended: stages.iter().any(|stage| stage.open_ended),
    };
    Ok((forecast, warnings(&run.scenario, &prepared)))
}

/// Refuses several seeds of a scenario that draws no random numbers: means over copies of one run have no error that says
/// anything.
fn refuse_idle_seeds(study: &Study, plan: &Plan) -> Result<(), StudyError> {
    let [one, other, ..] = plan.runs.as_slice() else { return Ok(()) };
    if study.seeds.len() < 2 || !start_alike(&one.scenario, &other.scenario)? {
        return Ok(());
    }
    let found = format!("the seeds {} and {} give the same run", one.seed, other.seed);
    let problem = Problem::rule(found, "one seed, or a scenario that draws random numbers");
    let help =
        "positions, radii and velocities can be random; a scenario with `start_from` draws no more numbers";
    Err(PrepareError::from(study.mistake("study.seeds", problem, help)).into())
}

/// The wall-clock time of a run at the first point on one thread [s]: the least, and the largest that is known. It makes trials.
///
/// # Errors
/// The point cannot be run.
pub fn time_of_first_point(plan: &Plan) -> Result<[f64; 2], StudyError> {
    let Some(first) = plan.runs.first() else { return Ok([0.0; 2]) };
    let mut scenario = first.scenario.clone();
    scenario.output.folder = plan.folder.join(&first.folder);
    Ok(preflight(&scenario)?.seconds())
}
