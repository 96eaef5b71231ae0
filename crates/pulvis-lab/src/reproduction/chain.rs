//! Runs of a figure: each starts when the one that it needs has ended; independent ones go on at the same time.

use super::ReproductionError;
use super::series::FinishedRun;
use super::snapshots::plain;
use super::workplace::{RunDone, Workplace};
use crate::protocol::{PictureOptions, RunOptions, RunState, RunSummary, column_names, run, run_state};
use pulvis_input::figure::{Experiment, Expression, Family, FigureScenario, PlannedRun, Runs};
use pulvis_input::scenario::{Scenario, StartFrom};
use std::num::NonZero;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Instant;

/// One run: number of the data and of the variant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Task {
    data: usize,
    variant: usize,
}

/// How far all tasks are.
struct State {
    waiting: Vec<Task>,
    under_way: usize,
    /// Those that have ended, and whether they were there before.
    done: Vec<(Task, bool)>,
    failure: Option<ReproductionError>,
}

/// Carries out all runs of a figure. Their files go into folders below that of the workplace.
pub(super) fn run_chain(figure: &FigureScenario, workplace: &Workplace<'_>) -> Result<(), ReproductionError> {
    check_columns(figure)?;
    let runs = |data: usize| runs_of(figure, data);
    let tasks = (0..figure.data.len())
        .filter_map(|data| Some((data, runs(data)?)))
        .flat_map(|(data, runs)| runs.planned.iter().map(move |run| Task { data, variant: run.variant }));
    let waiting: Vec<Task> = tasks.collect();
    let threads = std::thread::available_parallelism().map_or(1, NonZero::get).min(waiting.len());
    let state = Mutex::new(State { waiting, under_way: 0, done: Vec::new(), failure: None });
    let changed = Condvar::new();
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| work(figure, workplace, &state, &changed));
        }
    });
    let state = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    match state.failure {
        Some(failure) => Err(failure),
        None if !state.waiting.is_empty() => Err(ReproductionError::Interrupted),
        None => Ok(()),
    }
}

/// Refuses columns that the time series will not have, before anything is run.
fn check_columns(figure: &FigureScenario) -> Result<(), ReproductionError> {
    for (data, text) in wanted(figure) {
        // What is no formula was refused when the figure was read.
        let formula = Expression::parse(text).ok();
        for run in runs_of(figure, data).into_iter().flat_map(|runs| &runs.planned) {
            let known = column_names(&run.scenario);
            if known.iter().any(|name| name == text) {
                continue;
            }
            let needed = formula.as_ref().map(Expression::columns).unwrap_or_default();
            if let Some(missing) = needed.iter().find(|column| !known.contains(column)) {
                return Err(ReproductionError::NoColumn {
                    data: figure.data.get(data).map(|data| data.name.clone()).unwrap_or_default(),
                    column: missing.clone(),
                    known: known.join(", "),
                });
            }
        }
    }
    Ok(())
}

/// All columns, and formulas of columns, that a figure takes from its runs, with the number of the data.
fn wanted(figure: &FigureScenario) -> impl Iterator<Item = (usize, &str)> {
    let measures = figure.features.iter().flat_map(|feature| feature.source.measures());
    let measured = measures.flat_map(|measure| {
        let within = measure.within.as_ref().map(|within| within.column.as_str());
        let columns = [Some(measure.x.as_str()), Some(measure.y.as_str()), within];
        columns.into_iter().flatten().map(|column| (measure.data, column))
    });
    let drawn = figure.panels.iter().filter(|panel| panel.family == Family::Run).flat_map(|panel| {
        let x = panel.x.quantity.name;
        panel.series.iter().flat_map(move |series| {
            [x, series.y.unwrap_or(panel.y.quantity).name].map(|column| (series.data, column))
        })
    });
    measured.chain(drawn)
}

fn runs_of(figure: &FigureScenario, data: usize) -> Option<&Runs> {
    match &figure.data.get(data)?.experiment {
        Experiment::Runs(runs) => Some(runs),
        _ => None,
    }
}

/// Takes tasks that can begin until there are none.
fn work(figure: &FigureScenario, workplace: &Workplace<'_>, state: &Mutex<State>, changed: &Condvar) {
    while let Some((task, may_reuse)) = next(figure, workplace, state, changed) {
        let outcome = {
            let _seat = workplace.seats.take();
            carry_out(figure, workplace, task, may_reuse)
        };
        let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
        state.under_way -= 1;
        match outcome {
            Ok(is_reused) => state.done.push((task, is_reused)),
            Err(error) => state.failure = state.failure.take().or(Some(error)),
        }
        changed.notify_all();
    }
    changed.notify_all();
}

/// A task whose start is there, and whether a run that is there may be taken for it; waits for one while others are under
/// way. None if there will be none.
fn next(
    figure: &FigureScenario,
    workplace: &Workplace<'_>,
    state: &Mutex<State>,
    changed: &Condvar,
) -> Option<(Task, bool)> {
    let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
    loop {
        if state.failure.is_some() || workplace.stop.load(Ordering::Relaxed) {
            return None;
        }
        let start = |task: &Task| match runs_of(figure, task.data).and_then(|runs| runs.after) {
            Some(data) => {
                let before = Task { data, ..*task };
                // A new start makes all that comes of it new.
                state.done.iter().find(|(done, _)| *done == before).map(|(_, is_reused)| *is_reused)
            }
            None => Some(true),
        };
        let ready = state.waiting.iter().enumerate().find_map(|(place, task)| Some((place, start(task)?)));
        if let Some((place, may_reuse)) = ready {
            state.under_way += 1;
            return Some((state.waiting.remove(place), may_reuse && workplace.reuse));
        }
        if state.under_way == 0 || state.waiting.is_empty() {
            return None;
        }
        state = changed.wait(state).unwrap_or_else(PoisonError::into_inner);
    }
}

fn carry_out(
    figure: &FigureScenario,
    workplace: &Workplace<'_>,
    task: Task,
    may_reuse: bool,
) -> Result<bool, ReproductionError> {
    let nothing = || ReproductionError::Interrupted;
    let runs = runs_of(figure, task.data).ok_or_else(nothing)?;
    let planned = runs.in_variant(task.variant).ok_or_else(nothing)?;
    let mut scenario: Scenario = planned.scenario.clone();
    if let Some(before) = runs.after {
        let path = folder(figure, workplace, Task { data: before, ..task });
        scenario.start_from = Some(StartFrom { path, stage: None });
    }
    let own = folder(figure, workplace, task);
    let data = figure.data.get(task.data).map_or("", |data| data.name.as_str());
    let start = Instant::now();
    let is_reused = may_reuse
        && run_state(&scenario, workplace.version, &own).is_ok_and(|state| state == RunState::Complete);
    if !is_reused {
        let options = RunOptions {
            folder: Some(own.clone()),
            force: true,
            // Independent runs fill the processors.
            threads: Some(1),
            instructions: None,
            version: workplace.version.to_owned(),
            pictures: PictureOptions::default(),
            exchange: None,
            warn: |_| {},
        };
        let failed = |source| ReproductionError::Run { data: data.to_owned(), source: Box::new(source) };
        if let Some(parent) = own.parent() {
            let made = std::fs::create_dir_all(parent);
            made.map_err(|error| ReproductionError::Folder { folder: parent.to_owned(), source: error })?;
        }
        let summary: RunSummary = run(&scenario, &options, workplace.stop, &mut |_| {}).map_err(failed)?;
        if summary.interrupted() {
            return Err(ReproductionError::Interrupted);
        }
    }
    (workplace.tell)(&RunDone {
        figure: figure.name.clone(),
        data: data.to_owned(),
        variant: figure.variants.get(task.variant).map(|variant| variant.name.clone()).unwrap_or_default(),
        duration: start.elapsed().as_secs_f64(),
        is_reused,
    });
    Ok(is_reused)
}

/// Where a run writes.
fn folder(figure: &FigureScenario, workplace: &Workplace<'_>, task: Task) -> PathBuf {
    let data: String = figure.data.get(task.data).map_or_else(String::new, |data| plain(&data.name));
    let variant: String =
        figure.variants.get(task.variant).map_or_else(String::new, |variant| plain(&variant.name));
    let folder = workplace.folder.join("runs").join(&figure.name);
    if variant.is_empty() { folder.join(data) } else { folder.join(variant).join(data) }
}

/// Reads the time series of all runs of a piece of data.
pub(super) fn finished<'f>(
    figure: &'f FigureScenario,
    data: usize,
    runs: &'f Runs,
    workplace: &Workplace<'_>,
) -> Result<Vec<FinishedRun<'f>>, ReproductionError> {
    let wanted: Vec<&str> =
        wanted(figure).filter(|(number, _)| *number == data).map(|(_, text)| text).collect();
    let read = |run: &'f PlannedRun| {
        let folder = folder(figure, workplace, Task { data, variant: run.variant });
        let name = figure.variants.get(run.variant).map(|variant| variant.name.clone()).unwrap_or_default();
        FinishedRun::read((run.variant, name), &run.scenario, &folder, &wanted)
    };
    runs.planned.iter().map(read).collect()
}
