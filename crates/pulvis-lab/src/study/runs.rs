//! Carries out the runs of a study.

use super::budget::Budget;
use super::folder::{self, StudyFolder};
use super::results::{Status, StudyResults, StudyRun};
use super::tables::write_runs;
use super::{Plan, PlannedRun, StudyError, chart, report, tables};
use crate::at_once::at_once;
use crate::protocol::{
    PictureOptions, Progress, RunError, RunOptions, RunState, RunSummary, clear, resume, run, threads_for,
};
use crate::reproduction::{FinishedRun, ReproductionError, measure};
use pulvis_input::study::Study;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// How a study is computed.
pub struct StudyOptions<'o> {
    /// Threads of all runs together.
    pub threads: usize,
    /// Version of the program, for the records of the runs.
    pub version: &'o str,
    /// Pixels to the inch of the pictures.
    pub dpi: u32,
    /// Ends everything when it is set; the same study then goes on.
    pub stop: &'o AtomicBool,
    /// Told of what happens.
    pub tell: &'o (dyn Fn(&Told<'_>) + Sync),
    /// Who computed it, when, on what, after so many seconds.
    pub facts: &'o (dyn Fn(f64) -> Vec<(String, String)> + Sync),
}

/// What a study tells on its way.
#[derive(Clone, Copy, Debug)]
pub enum Told<'t> {
    /// A run has come so far, from 0 to 1.
    Progress {
        /// The number of the run.
        run: usize,
        /// How far.
        fraction: f64,
    },
    /// A run has ended or was there.
    Ended {
        /// The number of the run.
        run: usize,
        /// What came of it.
        result: &'t StudyRun,
    },
}

/// How often the table of runs is written while they go on.
const EVERY: Duration = Duration::from_secs(2);

/// Carries out the runs of a study that are not there, and writes tables, pictures and report.
///
/// # Errors
/// The folder cannot be used, or a file beside the runs cannot be written. Runs that fail are recorded.
pub fn run_study(study: &Study, plan: &Plan, options: &StudyOptions<'_>) -> Result<StudyResults, StudyError> {
    let began = Instant::now();
    let output = StudyFolder::open(&plan.folder, &folder::names(study))?;
    if plan.anew {
        // All at once, so that no old run is taken for a new one if this is interrupted.
        for run in plan.runs.iter().map(|run| output.file("").join(&run.folder)).filter(|run| run.exists()) {
            clear(&run)?;
        }
    }
    let waiting = |run: &PlannedRun| StudyRun {
        point: run.point,
        seed: run.seed,
        folder: run.folder.clone(),
        status: Status::Waiting,
        values: Vec::new(),
        duration: 0.0,
        was_there: false,
    };
    let mut runs: Vec<StudyRun> = plan.runs.iter().map(waiting).collect();
    write_runs(study, &runs, &output)?;
    let budget = Budget::new(options.threads, plan.missing());
    let order = order(study, plan);
    let mut written = (Instant::now(), Ok(()));
    let work = |task: usize| {
        let number = *order.get(task)?;
        Some((number, one_run(study, plan.runs.get(number)?, number, &output.path, &budget, options)))
    };
    at_once(order.len(), options.threads, options.stop, &work, &mut |_, result| {
        let Some((number, result)) = result else { return };
        (options.tell)(&Told::Ended { run: number, result: &result });
        if let Some(slot) = runs.get_mut(number) {
            *slot = result;
        }
        if written.0.elapsed() >= EVERY && written.1.is_ok() {
            written = (Instant::now(), write_runs(study, &runs, &output));
        }
    });
    written.1?;
    let results = StudyResults::new(study, runs);
    write_runs(study, &results.runs, &output)?;
    tables::write_points(study, &results, &output)?;
    chart::write_all(study, &results, &output, options.dpi)?;
    report::report(study, &results, (options.facts)(began.elapsed().as_secs_f64()))?.write(&output.path)?;
    Ok(results)
}

/// The runs seed by seed: an interrupted study then knows something of all its points.
fn order(study: &Study, plan: &Plan) -> Vec<usize> {
    let seeds = study.seeds.len().max(1);
    let mut order: Vec<usize> = (0..plan.runs.len()).collect();
    // What is there needs no time.
    order
        .sort_by_key(|number| (plan.runs.get(*number).is_some_and(|run| !run.is_complete()), number % seeds));
    order
}

fn one_run(
    study: &Study,
    planned: &PlannedRun,
    number: usize,
    output: &Path,
    budget: &Budget,
    options: &StudyOptions<'_>,
) -> StudyRun {
    let began = Instant::now();
    let own = output.join(&planned.folder);
    let mut status = Status::Complete;
    if !planned.is_complete() {
        let threads = budget.take(threads_for(planned.scenario.expected_particles(), options.threads));
        let mut watch = |progress: &Progress| {
            let fraction = fraction(progress);
            (options.tell)(&Told::Progress { run: number, fraction });
        };
        status = match carry_out(planned, &own, threads, options, &mut watch) {
            Ok(summary) if summary.interrupted() => Status::Interrupted,
            Ok(_) => Status::Complete,
            Err(error) => Status::Failed(in_one_line(&error.to_string())),
        };
        budget.give_back(threads);
    }
    let mut values = Vec::new();
    if status == Status::Complete {
        match measure_all(study, planned, &own) {
            Ok(measured) => values = measured,
            Err(error) => status = Status::Failed(in_one_line(&error.to_string())),
        }
    }
    StudyRun {
        point: planned.point,
        seed: planned.seed,
        folder: planned.folder.clone(),
        status,
        values,
        duration: began.elapsed().as_secs_f64(),
        was_there: planned.is_complete(),
    }
}

/// How far a run has come, as if all its stages took the same time.
fn fraction(progress: &Progress) -> f64 {
    let of_stage = if progress.ending.is_some() { 1.0 } else { progress.fraction.unwrap_or(0.0) };
    (progress.number.saturating_sub(1) as f64 + of_stage) / progress.stages.max(1) as f64
}

/// Runs it, or goes on where it was interrupted.
fn carry_out(
    planned: &PlannedRun,
    own: &Path,
    threads: usize,
    options: &StudyOptions<'_>,
    watch: &mut (dyn FnMut(&Progress) + Send),
) -> Result<RunSummary, RunError> {
    let run_options = RunOptions {
        folder: Some(own.to_owned()),
        // What a run has left that was killed before it had written its record.
        force: own.exists(),
        threads: Some(threads),
        instructions: None,
        version: options.version.to_owned(),
        pictures: PictureOptions { dpi: options.dpi, svg: false },
        // They were told before the first run.
        exchange: None,
        warn: |_| {},
    };
    match planned.state {
        RunState::Begun => resume(own, &run_options, options.stop, watch),
        _ => run(&planned.scenario, &run_options, options.stop, watch),
    }
}

/// Every measure of a run that has ended.
fn measure_all(study: &Study, planned: &PlannedRun, own: &Path) -> Result<Vec<f64>, ReproductionError> {
    let measures = study.measures.iter().flat_map(|one| [Some(&one.measure), one.over.as_ref()]);
    let columns = measures.flatten().flat_map(|measure| {
        let within = measure.within.as_ref().map(|within| within.column.as_str());
        [Some(measure.x.as_str()), Some(measure.y.as_str()), within]
    });
    let wanted: Vec<&str> = columns.flatten().collect();
    let finished = FinishedRun::read((0, String::new()), &planned.scenario, own, &wanted)?;
    let value = |one: &pulvis_input::study::StudyMeasure| {
        let value = measure(&one.measure, &finished)?;
        one.over.as_ref().map_or(Ok(value), |over| Ok(value / measure(over, &finished)?))
    };
    study.measures.iter().map(value).collect()
}

/// A message as a table holds it: without where the files are, which the table says.
fn in_one_line(message: &str) -> String {
    let lines = message.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines: Vec<&str> = lines.filter(|line| !line.starts_with("the run has stopped;")).collect();
    lines.join("; ")
}
