//! The scenario of a run: materials, contacts, particles, walls and stages, checked and in SI.
//!
//! A [`Scenario`] is plain data. Whoever has one may rely on it: every index is valid, every pair of
//! materials that can meet has a contact, every stage has an end. Nothing later checks that again.
//! What needs the particles themselves (do they overlap, is the time step short enough) is left to
//! the run. `docs/scenario.md` describes the file key by key.
//!
//! ```
//! use pulvis_input::scenario::{Arrangement, Scenario};
//!
//! let scenario = Scenario::from_str("gas.toml", r#"
//! [domain]
//! lower = ["0 mm", "0 mm", "0 mm"]
//! upper = ["10 mm", "10 mm", "10 mm"]
//! periodic = ["x", "y", "z"]
//! [materials.glass]
//! density = "2500 kg/m^3"
//! [contacts.glass-glass.normal]
//! law = "linear"
//! k = "1 kN/m"
//! [[particles]]
//! material = "glass"
//! radius = { distribution = "fixed", value = "0.2 mm" }
//! arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [10, 10, 10], spacing = "1 mm" }
//! velocity = { standard_deviation = "1 m/s" }
//! [[stages]]
//! name = "mix"
//! until = { time = "1 ms" }
//! "#)?;
//! assert_eq!(scenario.particles[0].count, 1000);
//! assert!(matches!(scenario.particles[0].arrangement, Arrangement::Lattice(_)));
//! assert_eq!(scenario.stages[0].until.time, Some(1e-3));
//! # Ok::<(), pulvis_input::InputErrors>(())
//! ```

mod allow;
mod arrangement;
mod axis;
mod cell;
mod columns;
mod contacts;
mod controls;
mod domain;
mod electrostatics;
mod groups;
mod import;
mod inlets;
mod limits;
mod listed;
mod materials;
mod mesh_file;
mod observers;
mod openings;
mod outlets;
mod output;
mod output_files;
mod particles;
mod placement;
mod programs;
mod radius;
mod region;
mod resolve;
mod resolved;

mod stages;
pub(crate) mod start;
mod switches;
mod time;
mod until;
mod walk;
mod wall_mesh;
mod wall_shape;
mod walls;

pub use crate::contact::NamedLaw;
pub use allow::Refusal;
pub use arrangement::{Arrangement, Grain};
pub use axis::{Axis, BoxFace, Side};
pub use columns::ParticleColumn;
pub use contacts::Contact;
pub use controls::WallControl;
pub use groups::{GroupControl, GroupPlan};
pub use import::{
    CheckpointParticles, CheckpointReader, FileReading, GrainColumn, PointsError, PointsFormat,
};
pub use inlets::Inlet;
pub use limits::Limits;
pub use materials::Material;
pub use mesh_file::MeshFileError;
pub use observers::{ObservedQuantity, Observer};
pub use openings::Schedule;
pub use outlets::{Outlet, OutletZone};
pub use output::{CheckpointPlan, ClusterRule, Dimensionless, Interval, OutputPlan, Snapshots};
pub use output_files::{
    CONTACT_FIELDS, ContactFields, DEFAULT_CONTACT_FIELDS, DEFAULT_PARTICLE_FIELDS, FileFormat, OutputFiles,
    PARTICLE_FIELDS,
};
pub use particles::{ParticleGroup, VelocityPlan};
pub use programs::{Program, ProgramState, Programs};
pub use pulvis_boundary::motion::{Cosine, PressureRamp, Rotation, Servo, Velocity};
pub use pulvis_boundary::{
    Background, CellControl, CellMotion, Cone, Cuboid, Cylinder, CylinderSide, Disk, Domain, Electrostatics,
    GroupMotion, Mesh, Plane, PlaneWithHole, Region, TemperatureProgram, Tube, UpperTriangular, WallMotion,
    WallShape,
};
pub use pulvis_packing::{Amount, GasVelocities, Growth, Lattice, RadiusDistribution, Structure};
pub use stages::Stage;
pub use start::StartFrom;
pub use time::TimeStep;
pub use until::{Crossing, PassedRule, ShearRule, SteadyRule, StopRules, StrainRule, StressRule};
pub use wall_mesh::MeshSource;
pub use walls::Wall;

use crate::document::Document;
use crate::error::{InputError, InputErrors};
use crate::overrides::Replacement;
use crate::problem::Problem;
use std::path::{Path, PathBuf};

/// Everything that a run needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Where it comes from.
    pub source: ScenarioSource,
    /// What the author calls it.
    pub title: Option<String>,
    /// The state of another run that this one starts from; the particles then are those of that run, whatever their
    /// groups say.
    pub start_from: Option<StartFrom>,
    /// Seed of all random numbers.
    pub seed: u64,
    /// The periodic directions, if there are any; then at least one is.
    pub domain: Option<Domain>,
    /// The materials, in the order of the file.
    pub materials: Vec<Material>,
    /// One contact for every pair of materials that can meet, before the first stage.
    pub contacts: Vec<Contact>,
    /// Gravity and drag, before the first stage.
    pub background: Background,
    /// Temperature over time, from the start of the first stage on; where it is given.
    pub temperature: Option<TemperatureProgram>,
    /// The medium through which charges act over all distances, if they do.
    pub electrostatics: Option<Electrostatics>,
    /// The groups of particles; at least one, unless there are inlets.
    pub particles: Vec<ParticleGroup>,
    /// Where particles come in during the run.
    pub inlets: Vec<Inlet>,
    /// Where particles leave during the run.
    pub outlets: Vec<Outlet>,
    /// Lower and upper corner of the box, if there is one; its walls are among [`Self::walls`].
    pub enclosure: Option<Cuboid>,
    /// All plane walls; those of the box come first. At the start all of them are fixed.
    pub walls: Vec<Wall>,
    /// Groups of particles that stages hold, lead or set free.
    pub groups: Vec<GroupPlan>,
    /// How long a time step is, before the first stage.
    pub time: TimeStep,
    /// The stages, at least one.
    pub stages: Vec<Stage>,
    /// The refusals that the author has lifted, in their order, each once.
    pub allow: Vec<Refusal>,
    /// What stops the run.
    pub limits: Limits,
    /// What is measured of the sample and its parts.
    pub observers: Vec<Observer>,
    /// What is written.
    pub output: OutputPlan,
}

/// Where a scenario comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ScenarioSource {
    /// The file as the user named it.
    pub name: String,
    /// The path of the file; `None` for a text that came from elsewhere.
    pub path: Option<PathBuf>,
    /// The whole text.
    pub text: String,
    /// Dotted paths of the values that were set from outside the file, whose text stands in it otherwise.
    pub replaced: Vec<String>,
}

impl Scenario {
    /// Reads and checks a scenario file.
    ///
    /// # Errors
    /// All mistakes of the file, and of the files that it names.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, InputErrors> {
        let path = path.as_ref();
        Self::from_document(&Document::load(path)?, Some(path))
    }

    /// As [`Self::load`] after replacing values, as `--set key=value` does.
    ///
    /// # Errors
    /// All mistakes, or a replacement that leads nowhere or stands there twice.
    pub fn load_with(path: impl AsRef<Path>, set: &[(String, Replacement)]) -> Result<Self, InputErrors> {
        let path = path.as_ref();
        Self::from_document(&Document::load(path)?.with_overrides(set)?, Some(path))
    }

    /// Reads and checks a text; `name` stands for the file in messages, and files that the scenario
    /// names are looked for in the current folder.
    ///
    /// # Errors
    /// All mistakes.
    pub fn from_str(name: &str, text: &str) -> Result<Self, InputErrors> {
        Self::from_document(&Document::from_str(name, text)?, None)
    }

    /// Reads and checks a parsed file, for example one in which values were replaced. `path` is where
    /// it stands.
    ///
    /// # Errors
    /// All mistakes.
    pub fn from_document(document: &Document, path: Option<&Path>) -> Result<Self, InputErrors> {
        walk::scenario(document, path)
    }

    /// A mistake that shows only after reading, at the first of several dotted `paths` that stands in
    /// the file, or at what there is of the last one.
    pub fn mistake(&self, paths: &[&str], problem: Problem, help: impl Into<String>) -> InputError {
        // The text was parsed before, so that the fallback is never needed.
        match Document::from_str(&self.source.name, &self.source.text) {
            Err(_) => InputError::of_file(&self.source.name, problem),
            Ok(document) => {
                let path = paths.iter().find(|path| document.has(path)).or(paths.last()).unwrap_or(&"");
                let mistake = document.mistake(path, problem, help);
                let replaced = self.source.replaced.contains(&mistake.key);
                InputError { replaced, ..mistake }
            }
        }
    }

    /// The scenario as it holds in one of its stages, without stages: contacts, background and time step are what earlier
    /// stages and this one have made of them. Programs of the stage stand at an update, or have come to their end where `update` is
    /// `None`. `index` is that of a stage.
    pub fn as_in_stage(&self, index: usize, update: Option<usize>) -> Self {
        let mut scenario = Self { stages: Vec::new(), ..self.clone() };
        if let Some(stage) = self.stages.get(index) {
            // The names of stages mean nothing elsewhere: what is open stays open, what is shut stays shut.
            let inlets = scenario.inlets.iter_mut().map(|inlet| &mut inlet.schedule);
            for schedule in inlets.chain(scenario.outlets.iter_mut().map(|outlet| &mut outlet.schedule)) {
                schedule.stages = (!schedule.takes_in(&stage.name)).then(Vec::new);
            }
            scenario.time = stage.time;
            let programs = stage.programs.as_ref().zip(update);
            match programs.and_then(|(programs, update)| programs.states.get(update)) {
                Some(state) => {
                    (scenario.contacts, scenario.background) = (state.contacts.clone(), state.background);
                }
                None => {
                    scenario.contacts = stage.last_contacts().to_vec();
                    scenario.background = stage.last_background();
                }
            }
        }
        scenario
    }

    /// Lifts refusals beside those that the file lifts.
    pub fn allow(&mut self, refusals: &[Refusal]) {
        self.allow.extend(refusals);
        self.allow.sort_unstable();
        self.allow.dedup();
    }

    /// Whether the author has lifted a refusal.
    pub fn allows(&self, refusal: Refusal) -> bool {
        self.allow.contains(&refusal)
    }

    /// The index of a material.
    pub fn material(&self, name: &str) -> Option<usize> {
        self.materials.iter().position(|material| material.name == name)
    }

    /// The index of a wall.
    pub fn wall(&self, name: &str) -> Option<usize> {
        self.walls.iter().position(|wall| wall.name == name)
    }

    /// The further quantities of all particles, as the first group or the first inlet has them.
    pub fn columns(&self) -> &[ParticleColumn] {
        let group = self.particles.first().map(|group| &group.columns[..]);
        group.or(self.inlets.first().map(|inlet| &inlet.columns[..])).unwrap_or_default()
    }

    /// The further quantities of all groups and inlets of a material.
    pub fn columns_of(&self, material: usize) -> impl Iterator<Item = &ParticleColumn> {
        let groups = self.particles.iter().filter(move |group| group.count_of(material) > 0);
        let inlets = self.inlets.iter().filter(move |inlet| inlet.material == material);
        groups.flat_map(|group| &group.columns).chain(inlets.flat_map(|inlet| &inlet.columns))
    }

    /// The number of particles of all groups, and of those that inlets with a total number bring.
    pub fn expected_particles(&self) -> usize {
        let brought = self.inlets.iter().map(|inlet| match inlet.total {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a whole number up to 1e10
            Some(Amount::Number(number)) => number as usize,
            _ => 0,
        });
        self.particle_count() + brought.sum::<usize>()
    }

    /// The names of inlets, then those of outlets.
    pub fn openings(&self) -> impl Iterator<Item = &str> {
        let inlets = self.inlets.iter().map(|inlet| inlet.name.as_str());
        inlets.chain(self.outlets.iter().map(|outlet| outlet.name.as_str()))
    }

    /// The number of particles of all groups.
    pub fn particle_count(&self) -> usize {
        self.particles.iter().map(|group| group.count).sum()
    }
}
