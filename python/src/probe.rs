//! One contact on a prescribed path.

use pulvis_input::Document;
use pulvis_input::probe::ProbeScenario;
use pulvis_lab::probe::result_table;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::interrupt::detached;
use crate::{columns, errors};

/// Leads the contacts of a scenario, a TOML text with numbers in SI, along its path. Answers with the name and the columns
/// of each curve.
#[pyfunction]
pub fn probe<'py>(py: Python<'py>, text: &str) -> PyResult<Vec<(String, Bound<'py, PyDict>)>> {
    let scenario = Document::from_str("<probe>", text)
        .and_then(|document| ProbeScenario::from_document(&document.with_numbers_in_si()))
        .map_err(|errors| errors::bad_input(&errors, ""))?;
    let curves = detached(py, || pulvis_lab::probe::probe(&scenario))?.map_err(errors::failed)?;
    let mut answered = Vec::with_capacity(curves.len());
    for curve in curves {
        let table = result_table(std::slice::from_ref(&curve)).map_err(errors::failed)?;
        answered.push((curve.label, columns::of_table(py, &table)?));
    }
    Ok(answered)
}
