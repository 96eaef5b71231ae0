//! Scenarios from files, texts and dictionaries.

use std::path::Path;

use pulvis_input::{Document, Replacement, Scenario};
use pulvis_lab::protocol::read_scenario;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyFloat, PyInt, PyString};

use crate::errors;

/// Where a scenario comes from.
#[derive(FromPyObject)]
pub enum Source {
    /// A file.
    #[pyo3(transparent)]
    File(std::path::PathBuf),
    /// A name for messages, a TOML text, and whether its bare numbers are in SI.
    #[pyo3(transparent)]
    Written((String, String, bool)),
}

/// Reads a scenario and replaces values as `--set` does it.
pub fn read(source: &Source, set: &[(String, Bound<'_, PyAny>)]) -> PyResult<Scenario> {
    let set: Vec<(String, Replacement)> =
        set.iter().map(|(path, value)| Ok((path.clone(), replacement(value)?))).collect::<PyResult<_>>()?;
    let document = match source {
        Source::File(path) => Document::load(path),
        Source::Written((name, text, false)) => Document::from_str(name, text),
        Source::Written((name, text, true)) => {
            Document::from_str(name, text).map(Document::with_numbers_in_si)
        }
    };
    let document = document.map_err(|errors| errors::bad_input(&errors, ""))?;
    let path: Option<&Path> = match source {
        Source::File(path) => Some(path),
        Source::Written(_) => None,
    };
    read_scenario(document, path, &set).map_err(|error| errors::of_prepare(&error))
}

/// A Python value in the place of one in the scenario: numbers are in SI, texts are as in the file.
fn replacement(value: &Bound<'_, PyAny>) -> PyResult<Replacement> {
    if value.is_instance_of::<PyBool>() {
        return Ok(Replacement::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyString>() {
        return Ok(Replacement::Text(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() || value.is_instance_of::<PyFloat>() {
        return Ok(Replacement::Si(value.extract()?));
    }
    match value.extract::<f64>() {
        Ok(number) => Ok(Replacement::Si(number)),
        Err(_) => Err(errors::misuse(format!("{value} is no number, text or truth value"))),
    }
}
