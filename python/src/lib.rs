//! The compiled part of the Python package `pulvis`: laws, collisions, probes, simulations and runs, as plain functions
//! and one class. What users see is written in Python around it (`python/pulvis`).

mod catalogue;
mod collision;
mod columns;
mod edit;
mod errors;
mod interrupt;
mod parallel;
mod probe;
mod run;
mod scenario;
mod session;
mod views;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_function(wrap_pyfunction!(catalogue::catalogue, module)?)?;
    module.add_function(wrap_pyfunction!(catalogue::check_law, module)?)?;
    module.add_function(wrap_pyfunction!(collision::collide, module)?)?;
    module.add_function(wrap_pyfunction!(probe::probe, module)?)?;
    module.add_function(wrap_pyfunction!(run::run, module)?)?;
    module.add_class::<session::Session>()
}
