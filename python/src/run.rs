//! A whole run with its files, as `pulvis run` does it.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use pulvis_lab::protocol::{self, PictureOptions, Progress, RunOptions, RunSummary};
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors;
use crate::interrupt::detached;
use crate::scenario::{Source, read};

/// Tells a warning as Python does. Where warnings are errors, this one is shown and the run goes on.
fn warn(text: &str) {
    Python::attach(|py| {
        let text = std::ffi::CString::new(text.replace('\0', " ")).unwrap_or_default();
        if let Err(error) = PyErr::warn(py, &py.get_type::<PyUserWarning>(), &text, 2) {
            error.write_unraisable(py, None);
        }
    });
}

/// Runs a scenario into a folder, or goes on with the run that is `source` if `resume`. `progress` is called some times a
/// second with a dictionary. Ctrl-C, or an exception in `progress`, ends the run with all files complete and a checkpoint.
#[pyfunction]
#[pyo3(signature = (source, set, output, force, threads, svg, resume, progress))]
#[allow(clippy::too_many_arguments)] // the options of the command, one by one
pub fn run<'py>(
    py: Python<'py>,
    source: Source,
    set: Vec<(String, Bound<'py, PyAny>)>,
    output: Option<PathBuf>,
    force: bool,
    threads: Option<usize>,
    svg: bool,
    resume: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = RunOptions {
        folder: output,
        force,
        threads,
        instructions: None,
        version: env!("CARGO_PKG_VERSION").to_owned(),
        pictures: PictureOptions { svg, ..PictureOptions::default() },
        exchange: None,
        warn,
    };
    let scenario = if resume { None } else { Some(read(&source, &set)?) };
    let stop = AtomicBool::new(false);
    let mut raised: Option<PyErr> = None;
    let mut watch = |now: &Progress| {
        if raised.is_none()
            && let Err(error) = Python::attach(|py| tell(py, progress.as_ref(), now))
        {
            raised = Some(error);
            stop.store(true, Ordering::Relaxed);
        }
    };
    let outcome = detached(py, || match (&scenario, &source) {
        (Some(scenario), _) => Some(protocol::run(scenario, &options, &stop, &mut watch)),
        (None, Source::File(folder)) => Some(protocol::resume(folder, &options, &stop, &mut watch)),
        (None, Source::Written(_)) => None,
    })?;
    let outcome = outcome.ok_or_else(|| errors::misuse("a run is resumed from its folder"))?;
    let summary = outcome.map_err(|error| errors::of_run(&error))?;
    match raised {
        Some(error) => Err(error),
        None => describe(py, &summary),
    }
}

/// Tells how far the run has come, and looks at Ctrl-C.
fn tell(py: Python<'_>, progress: Option<&Py<PyAny>>, now: &Progress) -> PyResult<()> {
    py.check_signals()?;
    let Some(progress) = progress else { return Ok(()) };
    let told = PyDict::new(py);
    told.set_item("stage", &now.stage)?;
    told.set_item("number", now.number)?;
    told.set_item("stages", now.stages)?;
    told.set_item("time", now.time)?;
    told.set_item("steps", now.steps)?;
    told.set_item("steps_per_second", now.steps_per_second)?;
    told.set_item("fraction", now.fraction)?;
    told.set_item("remaining", now.remaining)?;
    told.set_item("energy_error", now.energy_error)?;
    told.set_item("ending", now.ending.map(|ending| ending.text()))?;
    progress.call1(py, (told,)).map(|_| ())
}

fn describe<'py>(py: Python<'py>, summary: &RunSummary) -> PyResult<Bound<'py, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("folder", &summary.folder)?;
    let stages = summary.stages.iter();
    let stages: Vec<_> =
        stages.map(|stage| (stage.name.clone(), stage.ending.text(), stage.time, stage.steps)).collect();
    described.set_item("stages", stages)?;
    described.set_item("particles", summary.particles)?;
    described.set_item("steps", summary.steps)?;
    described.set_item("steps_before", summary.steps_before)?;
    described.set_item("wall_clock", summary.wall_clock)?;
    described.set_item("energy_error", summary.energy_error)?;
    described.set_item("energy_error_max", summary.energy_error_max)?;
    described.set_item("pictures", &summary.pictures)?;
    described.set_item("can_be_resumed", summary.can_be_resumed)?;
    Ok(described)
}
