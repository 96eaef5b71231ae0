//! Arrays that look at the columns of the engine itself.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use numpy::ndarray::{ArrayView1, ArrayView2, ShapeBuilder};
use numpy::{PyArray1, PyArray2};
use pulvis_core::{Simulation, Vectors};
use pyo3::prelude::*;

use super::session::Session;

/// Number of views that are alive.
#[derive(Clone, Debug, Default)]
pub struct Alive(Arc<AtomicUsize>);

impl Alive {
    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.load(Ordering::Acquire)
    }
}

/// What keeps the columns where they are: the base of every array that looks at them.
#[pyclass(frozen, module = "pulvis._native")]
pub struct ViewGuard {
    /// The owner of the columns. It changes them only if no guard is left.
    #[allow(dead_code)]
    session: Py<Session>,
    alive: Alive,
}

impl ViewGuard {
    fn new(session: Py<Session>, alive: Alive) -> Self {
        alive.0.fetch_add(1, Ordering::AcqRel);
        Self { session, alive }
    }
}

impl Drop for ViewGuard {
    fn drop(&mut self) {
        self.alive.0.fetch_sub(1, Ordering::AcqRel);
    }
}

/// Vectors of all particles that have a name.
pub fn vectors<'s>(simulation: &'s Simulation, name: &str) -> Option<Vectors<'s>> {
    let particles = simulation.particles();
    Some(match name {
        "position" => particles.positions(),
        "velocity" => particles.velocities(),
        "angular_velocity" => particles.angular_velocities(),
        "force" => particles.forces(),
        "torque" => particles.torques(),
        "applied_force" => return particles.applied_forces(),
        _ => return None,
    })
}

/// Numbers of all particles that have a name, columns of the scenario among them.
pub fn numbers<'s>(simulation: &'s Simulation, name: &str) -> Option<&'s [f64]> {
    let particles = simulation.particles();
    match name {
        "radius" => Some(particles.radii()),
        "mass" => Some(particles.masses()),
        _ => particles.column(name).map(|column| column.values.as_slice()),
    }
}

/// A view, read-only, of the column called `name`; `None` where there is none. The session is `owner`.
pub fn view<'py>(
    owner: &Bound<'py, Session>,
    simulation: &Simulation,
    alive: &Alive,
    name: &str,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let py = owner.py();
    let guard = || Bound::new(py, ViewGuard::new(owner.clone().unbind(), alive.clone()));
    let array = if let Some(vectors) = vectors(simulation, name) {
        let (start, bytes) = vectors.layout();
        let stride = bytes / size_of::<f64>();
        // SAFETY: the address, the number of rows and their distance are those of one allocation, whose components are
        // plain numbers. It neither moves nor changes as long as the guard lives: steps are refused until then, and nothing
        // else changes a session.
        unsafe {
            let view = ArrayView2::from_shape_ptr((vectors.len(), 3).strides((stride, 1)), start);
            PyArray2::borrow_from_array(&view, guard()?.into_any()).into_any()
        }
    } else if let Some(numbers) = numbers(simulation, name) {
        // SAFETY: as above.
        unsafe { PyArray1::borrow_from_array(&ArrayView1::from(numbers), guard()?.into_any()).into_any() }
    } else {
        return Ok(None);
    };
    array.call_method1("setflags", (false,))?;
    Ok(Some(array))
}
