//! What can be asked for.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use pulvis_core::InstructionSet;

use crate::failure::Failure;
use crate::models::{ConventionChoice, LawChoice, model};
use crate::workload::{bed, bidisperse, gas, tablet};
use crate::{kernels, scaling, timing};

/// Times Pulvis on the workloads that other codes were timed on.
#[derive(Debug, Parser)]
#[command(name = "pulvis-bench", version)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    workload: Choice,
}

/// Steps and how they are done.
#[derive(Args, Clone, Debug)]
pub(crate) struct Run {
    /// Timed steps.
    #[arg(long, default_value_t = 400, value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) steps: u64,
    /// Steps before the clock starts; the peers have none.
    #[arg(long, default_value_t = 0)]
    pub(crate) warm_up: u64,
    /// Number of threads.
    #[arg(long, default_value_t = 1)]
    pub(crate) threads: usize,
    /// Number of ranks, which are threads that share no memory; under `mpirun` as many as it starts.
    #[arg(long, default_value_t = 1)]
    pub(crate) ranks: usize,
    /// Whether energies are accounted for.
    #[arg(long, value_enum, default_value_t = Ledger::On)]
    ledger: Ledger,
    /// Instruction set; the widest of this machine where not given.
    #[arg(long)]
    instructions: Option<String>,
    /// Whether laws that have loops of their own are called through pointers, as the others are.
    #[arg(long)]
    pub(crate) pointers: bool,
    /// Skin of the candidate list [m]; the engine's own choice where not given.
    #[arg(long)]
    pub(crate) skin: Option<f64>,
    /// Whose reading of the laws.
    #[arg(long, value_enum, default_value_t = ConventionChoice::Own)]
    conventions: ConventionChoice,
    /// Writes the particles after the last step into this file: x y z r vx vy vz.
    #[arg(long)]
    pub(crate) write: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Ledger {
    On,
    Off,
}

#[derive(Debug, Subcommand)]
enum Choice {
    /// A settled bed on a floor, periodic in x and y.
    Bed {
        /// Particles: x y z r vx vy vz, SI.
        #[arg(long)]
        table: PathBuf,
        #[arg(long, value_enum, default_value_t = LawChoice::Linear)]
        law: LawChoice,
        #[command(flatten)]
        run: Run,
    },
    /// The bed, tilted by 26° until it flows.
    Chute {
        /// Particles: x y z r vx vy vz, SI.
        #[arg(long)]
        table: PathBuf,
        #[arg(long, value_enum, default_value_t = LawChoice::Linear)]
        law: LawChoice,
        #[command(flatten)]
        run: Run,
    },
    /// A granular gas of solid fraction 0.1 in a periodic cube.
    Gas {
        /// Particles: x y z r vx vy vz, SI; made anew where not given.
        #[arg(long)]
        table: Option<PathBuf>,
        /// Number of particles where they are made anew.
        #[arg(long, default_value_t = 100_000)]
        particles: usize,
        #[arg(long, value_enum, default_value_t = LawChoice::Linear)]
        law: LawChoice,
        #[command(flatten)]
        run: Run,
    },
    /// A cubic lattice between six walls, one of which presses it.
    Tablet {
        /// Number of particles, a cube.
        #[arg(long, default_value_t = 216)]
        particles: usize,
        #[arg(long, value_enum, default_value_t = LawChoice::LudingFull)]
        law: LawChoice,
        #[command(flatten)]
        run: Run,
    },
    /// A few large spheres among many small ones in a periodic cube.
    Bidisperse {
        /// Large radius over small radius.
        #[arg(long, default_value_t = 10.0)]
        ratio: f64,
        /// Number of small spheres.
        #[arg(long, default_value_t = 50_000)]
        small: usize,
        /// Number of large spheres per edge of the cube.
        #[arg(long, default_value_t = 2)]
        large_per_edge: usize,
        #[arg(long, value_enum, default_value_t = LawChoice::Luding)]
        law: LawChoice,
        #[command(flatten)]
        run: Run,
    },
    /// Time per contact of each law of the catalogue: plain numbers, and eight lanes for each
    /// instruction set of this machine.
    Kernels {
        /// Only models whose name holds this text.
        #[arg(long, default_value = "")]
        only: String,
    },
    /// How far ranks reach, on paper: surfaces of orders of cells, a model of the time of a step, and the messages of
    /// up to 4096 virtual ranks.
    Scaling(scaling::Options),
}

impl Run {
    /// Whether energies are accounted for.
    pub(crate) fn has_ledger(&self) -> bool {
        self.ledger == Ledger::On
    }

    /// The instruction set asked for, if any.
    pub(crate) fn instructions(&self) -> Result<Option<InstructionSet>, Failure> {
        let Some(name) = &self.instructions else { return Ok(None) };
        let unknown = || Failure::Instructions {
            found: name.clone(),
            expected: InstructionSet::available()
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join(", "),
        };
        InstructionSet::named(name).map(Some).ok_or_else(unknown)
    }
}

impl Arguments {
    /// Does what was asked for.
    pub(crate) fn execute(self) -> Result<(), Failure> {
        match self.workload {
            Choice::Bed { table, law, run } => {
                let model = model(law, bed::DAMPING_RATE, run.conventions)?;
                timing::run("bed", bed::setup(&table, model, 0.0)?, &run)
            }
            Choice::Chute { table, law, run } => {
                let model = model(law, bed::DAMPING_RATE, run.conventions)?;
                timing::run("chute", bed::setup(&table, model, bed::CHUTE_ANGLE)?, &run)
            }
            Choice::Gas { table, particles, law, run } => {
                let model = model(law, gas::DAMPING_RATE, run.conventions)?;
                timing::run("gas", gas::setup(table.as_deref(), particles, model)?, &run)
            }
            Choice::Tablet { particles, law, run } => {
                let model = model(law, bed::DAMPING_RATE, run.conventions)?;
                timing::run("tablet", tablet::setup(particles, model)?, &run)
            }
            Choice::Bidisperse { ratio, small, large_per_edge, law, run } => {
                let model = model(law, bed::DAMPING_RATE, run.conventions)?;
                let plan = bidisperse::Plan { ratio, small, large_per_edge };
                timing::run("bidisperse", bidisperse::setup(&plan, model)?, &run)
            }
            Choice::Kernels { only } => kernels::run(&only),
            Choice::Scaling(options) => {
                scaling::run(&options);
                Ok(())
            }
        }
    }
}
