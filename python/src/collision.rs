//! Pair collisions, many at a time.

use numpy::PyReadonlyArray2;
use pulvis_input::collision::{CollisionCase, CollisionScenario};
use pulvis_input::{Document, InputErrors, Replacement};
use pulvis_lab::collision::{
    CollisionError, Observation, Sampling, SweepPoint, closed_form, result_table, sampling_interval,
    trajectory_table,
};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::{columns, errors, parallel};

/// The key that changes nothing but the speed.
const VELOCITY: &str = "collision.velocity";

/// Why one of many collisions has no result.
enum Refused {
    Input(InputErrors),
    Collision(CollisionError),
}

/// Computes the collision of a scenario, a TOML text with numbers in SI, for every column of `values`, whose rows are put
/// into the scenario at the `paths`. Answers with the columns of the table of results, and with `record` with those of each
/// trajectory.
#[pyfunction]
#[pyo3(signature = (text, paths, values, record = false, threads = None))]
pub fn collide<'py>(
    py: Python<'py>,
    text: &str,
    paths: Vec<String>,
    values: PyReadonlyArray2<'py, f64>,
    record: bool,
    threads: Option<usize>,
) -> PyResult<(Bound<'py, PyDict>, Bound<'py, PyList>)> {
    let document = Document::from_str("<collide>", text).map_err(|errors| errors::bad_input(&errors, ""))?;
    let document = document.with_numbers_in_si();
    let values = values.as_array().to_owned();
    let count = values.ncols();
    let of_element = |index: usize| values.column(index).to_vec();
    let mut scenario =
        scenario_of(&document, &paths, &of_element(0)).map_err(|errors| errors::bad_input(&errors, ""))?;
    let [base] = &scenario.cases[..] else {
        return Err(errors::misuse("a sweep, a family or contacts that are compared: give arrays instead"));
    };
    let (base, after) = (base.clone(), if record { scenario.time_after_sticking } else { 0.0 });
    // Speeds alone need no second look at the laws; one that is no speed is left to the reader's own words.
    let plain = paths.iter().all(|path| path == VELOCITY) && values.iter().all(|&v| v.is_finite() && v > 0.0);
    let work = |index: usize| {
        let case = match (plain, values.get((0, index))) {
            (true, Some(&velocity)) => CollisionCase { velocity, value: velocity, ..base.clone() },
            (true, None) => base.clone(),
            (false, _) => {
                let one = scenario_of(&document, &paths, &of_element(index)).map_err(Refused::Input)?;
                one.cases.into_iter().next().unwrap_or_else(|| base.clone())
            }
        };
        point(case, record, after).map_err(Refused::Collision)
    };
    let points = parallel::map(py, count, parallel::threads(threads), work)?;
    let points = points.map_err(|(index, refused)| {
        let before = if count > 1 { format!("element {index}: ") } else { String::new() };
        match refused {
            Refused::Input(errors) => errors::bad_input(&errors, &before),
            Refused::Collision(error) => errors::failed(format!("{before}{error}")),
        }
    })?;
    scenario.cases = points.iter().map(|point| point.case.clone()).collect();
    let table = result_table(&scenario, &points, false).map_err(errors::failed)?;
    let courses = PyList::empty(py);
    for point in points.iter().filter(|_| record) {
        let course = trajectory_table(&point.collision.course).map_err(errors::failed)?;
        courses.append(columns::of_table(py, &course)?)?;
    }
    Ok((columns::of_table(py, &table)?, courses))
}

/// The scenario with one value at each path.
fn scenario_of(
    document: &Document,
    paths: &[String],
    values: &[f64],
) -> Result<CollisionScenario, InputErrors> {
    let mut replaced = document.clone();
    for (path, value) in paths.iter().zip(values) {
        replaced = replaced.with_override(path, Replacement::Si(*value))?;
    }
    CollisionScenario::from_document(&replaced)
}

/// One collision, as the command computes it.
fn point(case: CollisionCase, record: bool, after: f64) -> Result<SweepPoint, CollisionError> {
    let sampling = if record { Sampling::Every(sampling_interval(&case)) } else { Sampling::None };
    let observation = Observation { sampling, time_after_sticking: after, ..Observation::default() };
    let collision = pulvis_lab::collision::collide(&case, &observation)?;
    let theory = closed_form(&case);
    Ok(SweepPoint { case, collision, theory })
}
