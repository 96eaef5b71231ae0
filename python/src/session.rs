//! A simulation in the hands of Python.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyReadonlyArray1, PyReadonlyArray2};
use pulvis_core::ContactPartner;
use pulvis_lab::protocol::{Session as Stages, StageResult};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::interrupt::{Chunks, detached};
use crate::scenario::{Source, read};
use crate::views::{self, Alive};
use crate::{columns, edit, errors};

/// Name, end, time and steps of a stage that has ended.
type Ended = (String, &'static str, f64, u64);

/// The stages of a scenario, step by step.
#[pyclass(module = "pulvis._native")]
pub struct Session {
    pub(crate) stages: Stages,
    pub(crate) alive: Alive,
}

impl Session {
    /// Refuses changes of columns that arrays look at.
    fn free(&self) -> PyResult<()> {
        match self.alive.count() {
            0 => Ok(()),
            count => Err(errors::views_alive(count)),
        }
    }

    /// The rows of particles in the order of their ids.
    fn rows(&self) -> Vec<usize> {
        self.stages.simulation().particles().rows_by_id()
    }
}

fn ended(result: &StageResult) -> Ended {
    (result.name.clone(), result.ending.text(), result.time, result.steps)
}

#[pymethods]
impl Session {
    #[new]
    #[pyo3(signature = (source, set, threads = None))]
    fn new(
        py: Python<'_>,
        source: Source,
        set: Vec<(String, Bound<'_, PyAny>)>,
        threads: Option<usize>,
    ) -> PyResult<Self> {
        let scenario = read(&source, &set)?;
        let mut stages = detached(py, || Stages::new(scenario))?.map_err(|error| errors::of_run(&error))?;
        if threads.is_some() {
            stages.set_threads(threads).map_err(|error| errors::of_run(&error))?;
        }
        Ok(Self { stages, alive: Alive::default() })
    }

    /// Goes on from a checkpoint.
    #[staticmethod]
    #[pyo3(signature = (path, threads = None))]
    fn resume(py: Python<'_>, path: PathBuf, threads: Option<usize>) -> PyResult<Self> {
        let mut stages = detached(py, || Stages::resume(&path))?.map_err(|error| errors::of_run(&error))?;
        if threads.is_some() {
            stages.set_threads(threads).map_err(|error| errors::of_run(&error))?;
        }
        Ok(Self { stages, alive: Alive::default() })
    }

    /// Writes a checkpoint.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let written = detached(py, || self.stages.checkpoint(&path, env!("CARGO_PKG_VERSION")))?;
        written.map_err(|error| errors::of_run(&error))
    }

    /// Writes the present instant into a folder in a format of runs.
    fn write_instant(
        &mut self,
        py: Python<'_>,
        folder: PathBuf,
        format: &str,
        contacts: bool,
    ) -> PyResult<()> {
        let stages = &mut self.stages;
        let written = detached(py, || stages.write_instant(&folder, format, contacts))?;
        written.map_err(|error| errors::of_run(&error))
    }

    /// Draws the particles into a file.
    fn write_picture(&self, py: Python<'_>, path: PathBuf, dots_per_inch: u32) -> PyResult<()> {
        let written = detached(py, || self.stages.write_picture(&path, dots_per_inch))?;
        written.map_err(|error| errors::of_run(&error))
    }

    /// Sets vectors of all particles by id; `applied_force` with none takes the forces away.
    fn set_vectors(&mut self, name: &str, vectors: PyReadonlyArray2<'_, f64>) -> PyResult<bool> {
        self.free()?;
        edit::set_vectors(&mut self.stages, name, &vectors)
    }

    /// Sets a quantity of all particles by id.
    #[pyo3(signature = (name, unit, values))]
    fn set_column(
        &mut self,
        name: &str,
        unit: Option<&str>,
        values: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<()> {
        self.free()?;
        let values = values.as_array().to_vec();
        self.stages.set_column(name, unit, values).map_err(errors::misuse)
    }

    /// Moves a wall in another way from now on.
    fn set_wall_motion(
        &mut self,
        wall: usize,
        motion: &str,
        parameters: Vec<(String, edit::Value)>,
    ) -> PyResult<()> {
        self.free()?;
        edit::set_wall_motion(&mut self.stages, wall, motion, parameters)
    }

    /// Takes a wall away or puts it back.
    fn set_wall_present(&mut self, wall: usize, present: bool) -> PyResult<()> {
        self.free()?;
        self.stages.set_wall_present(wall, present).map_err(errors::misuse)
    }

    /// Bytes that columns, contacts and lists take.
    #[getter]
    fn memory_size(&self) -> usize {
        self.stages.simulation().memory_size()
    }

    /// Takes steps, with `one_stage` up to the end of the present stage at most. Answers with the number of steps taken and
    /// the stages that have ended. Ctrl-C ends it between two steps.
    fn advance(&mut self, py: Python<'_>, steps: u64, one_stage: bool) -> PyResult<(u64, Vec<Ended>)> {
        self.free()?;
        let (mut taken, mut all_ended) = (0, Vec::new());
        let mut chunks = Chunks::new();
        while taken < steps {
            let chunk = chunks.next(steps - taken);
            let stages = &mut self.stages;
            let advance = detached(py, || stages.advance(chunk, one_stage))?;
            let advance = advance.map_err(|error| errors::of_run(&error))?;
            chunks.took(chunk);
            taken += advance.steps;
            let stops = advance.steps < chunk || (one_stage && !advance.ended.is_empty());
            all_ended.extend(advance.ended.iter().map(ended));
            if stops {
                break;
            }
            py.check_signals()?;
        }
        Ok((taken, all_ended))
    }

    /// A copy of a column of particles, by id; `None` where there is no such column.
    fn column<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let (simulation, rows) = (self.stages.simulation(), self.rows());
        let particles = simulation.particles();
        if let Some(vectors) = views::vectors(simulation, name) {
            let array = columns::vectors(py, rows.iter().map(|&row| vectors[row].to_array()))?;
            return Ok(Some(array.into_any()));
        }
        if let Some(numbers) = views::numbers(simulation, name) {
            return Ok(Some(PyArray1::from_iter(py, rows.iter().map(|&row| numbers[row])).into_any()));
        }
        Ok(match name {
            "id" => Some(PyArray1::from_iter(py, rows.iter().map(|&row| particles.ids()[row])).into_any()),
            "material" => {
                Some(PyArray1::from_iter(py, rows.iter().map(|&row| particles.materials()[row])).into_any())
            }
            // None are applied.
            "applied_force" => Some(columns::vectors(py, rows.iter().map(|_| [0.0; 3]))?.into_any()),
            _ => None,
        })
    }

    /// A read-only view of a column of particles without a copy, by row; `None` where there is no such column.
    fn view<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let session = slf.borrow();
        views::view(slf, session.stages.simulation(), &session.alive, name)
    }

    /// Number of views that are alive.
    fn views(&self) -> usize {
        self.alive.count()
    }

    /// The ids of the particles in the order of the rows.
    fn row_ids<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        PyArray1::from_slice(py, self.stages.simulation().particles().ids())
    }

    /// The names of all columns of particles.
    fn column_names(&self) -> Vec<String> {
        let own = [
            "id",
            "material",
            "radius",
            "mass",
            "position",
            "velocity",
            "angular_velocity",
            "force",
            "torque",
        ];
        let simulation = self.stages.simulation();
        let applied = simulation.has_applied_forces().then_some("applied_force");
        let further = simulation.particles().columns().iter().map(|column| column.name.clone());
        own.into_iter().chain(applied).map(str::to_owned).chain(further).collect()
    }

    /// The columns of all contacts that act.
    fn contacts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (mut ids, mut centres): ([Vec<i64>; 2], [Vec<[f64; 3]>; 2]) = Default::default();
        let (mut force, mut normal_force, mut overlap) = (Vec::new(), Vec::new(), Vec::new());
        let mut stored_energy = Vec::new();
        // Contacts of other laws remember other things: what one does not know is NaN.
        let mut memory: Vec<(&'static str, Vec<f64>)> = Vec::new();
        self.stages.simulation().for_each_contact(&mut |contact| {
            ids[0].push(i64::from(contact.first));
            ids[1].push(match contact.second {
                ContactPartner::Particle(id) => i64::from(id),
                ContactPartner::Wall(place) => -1 - place as i64,
            });
            centres[0].push(contact.centre_first.to_array());
            centres[1].push(contact.centre_second.to_array());
            force.push(contact.force.to_array());
            normal_force.push(contact.normal_force);
            overlap.push(contact.overlap);
            stored_energy.push(contact.stored_energy);
            for (name, &value) in contact.layout.names().zip(contact.memory) {
                let name = name.split(' ').next().unwrap_or(name);
                let index = memory.iter().position(|(known, _)| *known == name).unwrap_or_else(|| {
                    memory.push((name, Vec::new()));
                    memory.len() - 1
                });
                memory[index].1.resize(overlap.len() - 1, f64::NAN);
                memory[index].1.push(value);
            }
        });
        let ([id1, id2], [centre1, centre2]) = (ids, centres);
        let columns = PyDict::new(py);
        columns.set_item("id1", PyArray1::from_vec(py, id1))?;
        columns.set_item("id2", PyArray1::from_vec(py, id2))?;
        columns.set_item("centre1", columns::vectors(py, centre1.into_iter())?)?;
        columns.set_item("centre2", columns::vectors(py, centre2.into_iter())?)?;
        columns.set_item("force", columns::vectors(py, force.into_iter())?)?;
        columns.set_item("normal_force", PyArray1::from_vec(py, normal_force))?;
        let count = overlap.len();
        columns.set_item("overlap", PyArray1::from_vec(py, overlap))?;
        columns.set_item("stored_energy", PyArray1::from_vec(py, stored_energy))?;
        for (name, mut values) in memory {
            values.resize(count, f64::NAN);
            columns.set_item(name, PyArray1::from_vec(py, values))?;
        }
        Ok(columns)
    }

    /// What is known of each wall.
    fn walls<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let simulation = self.stages.simulation();
        let walls = PyList::empty(py);
        for (index, (wall, plan)) in simulation.walls().iter().zip(&self.stages.scenario().walls).enumerate()
        {
            let described = PyDict::new(py);
            described.set_item("name", &plan.name)?;
            described.set_item("present", wall.present)?;
            described.set_item("motion", wall.motion.name())?;
            described.set_item("point", PyArray1::from_slice(py, &wall.point.to_array()))?;
            let normal = wall.plane_normal().map(|normal| PyArray1::from_slice(py, &normal.to_array()));
            described.set_item("normal", normal)?;
            let velocity = simulation.wall_velocity(index).to_array();
            described.set_item("velocity", PyArray1::from_slice(py, &velocity))?;
            described
                .set_item("force", PyArray1::from_slice(py, &simulation.wall_force(index).to_array()))?;
            described.set_item("torque", simulation.wall_torque(index))?;
            described.set_item("area", simulation.wall_area(index))?;
            walls.append(described)?;
        }
        Ok(walls)
    }

    /// The accounts of the energy ledger [J], their sums and the closing error.
    fn ledger<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let ledger = self.stages.simulation().ledger();
        let accounts = PyDict::new(py);
        for (name, value) in ledger.accounts() {
            accounts.set_item(name, value)?;
        }
        accounts.set_item("kinetic", ledger.kinetic())?;
        accounts.set_item("elastic", ledger.elastic())?;
        accounts.set_item("dissipated", ledger.dissipated())?;
        accounts.set_item("closing_error", ledger.closing_error())?;
        accounts.set_item("relative_error", ledger.relative_error())?;
        Ok(accounts)
    }

    /// The names of the columns of the time series.
    fn row_names(&self) -> Vec<String> {
        self.stages.columns().to_vec()
    }

    /// One row of the time series: the present state.
    fn row<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.stages.row())
    }

    /// Components of the stress of all contacts times the volume [J].
    fn virial<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        columns::vectors(py, self.stages.simulation().contact_totals().virial.into_iter())
    }

    #[getter]
    fn time(&self) -> f64 {
        self.stages.simulation().time()
    }

    #[getter]
    fn time_step(&self) -> f64 {
        self.stages.simulation().time_step()
    }

    #[getter]
    fn steps(&self) -> u64 {
        self.stages.simulation().steps()
    }

    #[getter]
    fn particle_count(&self) -> usize {
        self.stages.simulation().particles().len()
    }

    #[getter]
    fn threads(&self) -> usize {
        self.stages.simulation().threads()
    }

    #[setter]
    fn set_threads(&mut self, threads: usize) -> PyResult<()> {
        self.stages.set_threads(Some(threads)).map_err(|error| errors::of_run(&error))
    }

    /// Name of the present stage; of the last one after its end.
    #[getter]
    fn stage(&self) -> String {
        self.stages.scenario().stages[self.stages.stage()].name.clone()
    }

    #[getter]
    fn stage_names(&self) -> Vec<String> {
        self.stages.scenario().stages.iter().map(|stage| stage.name.clone()).collect()
    }

    #[getter]
    fn material_names(&self) -> Vec<String> {
        self.stages.scenario().materials.iter().map(|material| material.name.clone()).collect()
    }

    #[getter]
    fn is_over(&self) -> bool {
        self.stages.is_over()
    }

    #[getter]
    fn title(&self) -> Option<String> {
        self.stages.scenario().title.clone()
    }

    /// The stages that have ended.
    #[getter]
    fn results(&self) -> Vec<Ended> {
        self.stages.results().iter().map(ended).collect()
    }

    /// What is valid and yet probably not meant.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.stages.warnings().to_vec()
    }

    /// The scenario with all defaults filled in and in SI units, as `run.toml` holds it.
    fn to_toml(&self) -> String {
        self.stages.scenario().to_resolved_toml(env!("CARGO_PKG_VERSION"))
    }
}
