//! Errors of the engine as exceptions of `pulvis.errors`.

use pulvis_input::{InputError, InputErrors};
use pulvis_lab::protocol::{PrepareError, RunError};
use pyo3::prelude::*;

mod python {
    #![allow(missing_docs)]
    pyo3::import_exception!(pulvis.errors, InputError);
    pyo3::import_exception!(pulvis.errors, RunError);
    pyo3::import_exception!(pulvis.errors, ViewError);
    pyo3::import_exception!(pulvis.errors, InternalError);
}

/// All mistakes of an input; file, line and key are those of the first one.
pub fn bad_input(errors: &InputErrors, before: &str) -> PyErr {
    match errors.errors().first() {
        Some(first) => of_input(first, before, &errors.to_string()),
        None => python::InputError::new_err((errors.to_string(),)),
    }
}

/// One mistake of an input, with the text that shall be shown.
fn of_input(error: &InputError, before: &str, text: &str) -> PyErr {
    let line = error.place.as_ref().map(|place| place.line);
    // The heading is that of the command line.
    let text = text.strip_prefix("error: ").unwrap_or(text);
    python::InputError::new_err((format!("{before}{text}"), error.file.clone(), line, error.key.clone()))
}

/// A mistake that concerns no place in an input.
pub fn misuse(text: impl ToString) -> PyErr {
    python::InputError::new_err((text.to_string(),))
}

/// Why a run cannot start.
pub fn of_prepare(error: &PrepareError) -> PyErr {
    match error {
        PrepareError::Input(errors) => bad_input(errors, ""),
        PrepareError::Scenario(one) => of_input(one, "", &one.to_string()),
        other => misuse(other),
    }
}

/// Why a run cannot start, or what stopped it.
pub fn of_run(error: &RunError) -> PyErr {
    match error {
        RunError::Prepare(error) => of_prepare(error),
        other => failed(other),
    }
}

/// Something that went wrong while computing.
pub fn failed(text: impl ToString) -> PyErr {
    python::RunError::new_err((text.to_string(),))
}

/// Steps are refused while arrays look at the columns.
pub fn views_alive(count: usize) -> PyErr {
    let text = format!(
        "{count} view(s) of particle columns are alive, and steps may move the columns; delete the arrays, or take copies"
    );
    python::ViewError::new_err((text,))
}

/// A panic of the engine: a mistake of ours.
pub fn panicked(payload: &(dyn std::any::Any + Send)) -> PyErr {
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| payload.downcast_ref::<&str>().copied()).unwrap_or("no message");
    python::InternalError::new_err((format!("a mistake in Pulvis, please report it: {text}"),))
}
