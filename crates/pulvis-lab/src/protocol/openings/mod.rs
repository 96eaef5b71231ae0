//! Inlets and outlets of a run: what comes in and leaves while it goes on.

mod check;
mod clock;
mod feed;
mod passage;
mod record;

use pulvis_core::{SetupError, Simulation};
use pulvis_input::scenario::{Amount, Inlet, Outlet, Scenario};
use thiserror::Error;

pub(super) use check::{charges_of, check_openings, sample_of_inlets};
pub(super) use record::OpeningsRecord;

use clock::Clock;
use feed::Feed;
use passage::Passage;

/// All inlets and outlets of a run, with everything that they keep over time.
#[derive(Clone, Debug)]
pub(super) struct Openings {
    feeds: Vec<Feed>,
    drains: Vec<Drain>,
    /// When the present stage began [s].
    stage_start: f64,
}

/// An outlet under way.
#[derive(Clone, Debug)]
struct Drain {
    plan: Outlet,
    /// Whether it is open in the present stage.
    is_open: bool,
    passage: Passage,
}

/// What stops a run at an inlet.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum InletError {
    /// A particle has waited too long for room.
    #[error(
        "inlet `{name}` cannot bring in what it should: a particle of radius {radius:.4e} m has found no room for {delay:.4e} s, longer than `max_delay` = {max_delay:.4e} s; {number} particles ({mass:.4e} kg) have come in and {due} are due; lower the rate, enlarge the region, let particles leave it faster, or raise `max_delay`"
    )]
    Late {
        /// The inlet.
        name: String,
        /// Radius of the particle [m].
        radius: f64,
        /// For how long it has waited [s].
        delay: f64,
        /// For how long it may [s].
        max_delay: f64,
        /// Particles that have come in.
        number: u64,
        /// Their mass [kg].
        mass: f64,
        /// What is due, in words.
        due: String,
    },
    /// The cell was sheared, and the room in it is looked for along straight periods.
    #[error(
        "inlet `{name}` is open in a periodic cell that was sheared, where it cannot tell what is free; open it before the shear"
    )]
    Tilted {
        /// The inlet.
        name: String,
    },
    /// The engine does not take the particles.
    #[error("inlet `{name}`: {source}")]
    Refused {
        /// The inlet.
        name: String,
        /// Why.
        source: SetupError,
    },
}

impl Openings {
    /// Those of a scenario before its first stage. `before` is what openings of the same names have seen in the run that this
    /// one starts from.
    pub(super) fn new(scenario: &Scenario, before: Option<&OpeningsRecord>) -> Self {
        let feeds = (0..scenario.inlets.len()).filter_map(|index| Feed::new(scenario, index)).collect();
        let drain = |plan: &Outlet| Drain {
            plan: plan.clone(),
            is_open: false,
            passage: Passage::new(&plan.size_classes),
        };
        let drains = scenario.outlets.iter().map(drain).collect();
        let mut openings = Self { feeds, drains, stage_start: 0.0 };
        if let Some(record) = before {
            openings.restore(record);
        }
        openings
    }

    /// Begins a stage: what is open in it opens, what is not shuts.
    pub(super) fn enter_stage(&mut self, stage: &str, simulation: &Simulation) {
        self.stage_start = simulation.time();
        for feed in &mut self.feeds {
            feed.enter_stage(stage, simulation.time());
        }
        for drain in &mut self.drains {
            drain.is_open = drain.plan.schedule.takes_in(stage);
            drain.passage.mark();
        }
    }

    /// Steps before which certainly nothing comes in or leaves.
    pub(super) fn steps_left(&self, simulation: &Simulation) -> u64 {
        let feeds = self.feeds.iter().map(|feed| feed.steps_left(simulation));
        let open = self.drains.iter().filter(|drain| drain.is_open);
        let drains = open.map(|drain| drain.plan.steps - simulation.steps() % drain.plan.steps);
        feeds.chain(drains).min().unwrap_or(u64::MAX)
    }

    /// Takes away what leaves in this step, and brings in what comes.
    pub(super) fn act(&mut self, simulation: &mut Simulation) -> Result<(), InletError> {
        for drain in &mut self.drains {
            drain.act(simulation);
        }
        self.feeds.iter_mut().try_for_each(|feed| feed.act(simulation))
    }

    fn passages(&self) -> impl Iterator<Item = &Passage> {
        self.feeds.iter().map(|feed| &feed.passage).chain(self.drains.iter().map(|drain| &drain.passage))
    }

    /// Whether so much has passed an opening, by its place among inlets and then outlets.
    pub(super) fn has_passed(&self, opening: usize, amount: Amount) -> bool {
        self.passages().nth(opening).is_some_and(|passage| passage.holds(amount))
    }

    /// The values of the columns, in the order of [`columns`].
    pub(super) fn values(&self, simulation: &Simulation) -> Vec<f64> {
        let elapsed = simulation.time() - self.stage_start;
        self.passages().flat_map(|passage| passage.values(elapsed)).collect()
    }
}

/// The columns of all inlets, then of all outlets.
pub(super) fn columns(scenario: &Scenario) -> Vec<String> {
    let inlets = scenario.inlets.iter().map(|Inlet { name, size_classes, .. }| (name, size_classes));
    let outlets = scenario.outlets.iter().map(|Outlet { name, size_classes, .. }| (name, size_classes));
    inlets.chain(outlets).flat_map(|(name, classes)| Passage::columns(name, classes.len())).collect()
}

impl Drain {
    fn act(&mut self, simulation: &mut Simulation) {
        let Self { plan, is_open, passage } = self;
        let schedule = &plan.schedule;
        let is_time = (schedule.start..=schedule.stop).contains(&simulation.time());
        if !*is_open || !is_time || !simulation.steps().is_multiple_of(plan.steps) {
            return;
        }
        let (particles, domain) = (simulation.particles(), simulation.domain());
        let positions = particles.positions().iter().enumerate();
        let inside = positions.filter(|(_, position)| plan.zone.contains(*position, domain));
        let mut leaving: Vec<(u32, usize)> = inside.map(|(row, _)| (particles.ids()[row], row)).collect();
        if leaving.is_empty() {
            return;
        }
        // Rows are in the order of cells; sums are taken in that of ids.
        leaving.sort_unstable();
        for (_, row) in &leaving {
            passage.add(&pulvis_core::Particle {
                material: particles.materials()[*row],
                radius: particles.radii()[*row],
                mass: particles.masses()[*row],
                position: particles.positions()[*row],
                velocity: particles.velocities()[*row],
                angular_velocity: particles.angular_velocities()[*row],
            });
        }
        let rows: Vec<usize> = leaving.into_iter().map(|(_, row)| row).collect();
        let mut leaves = vec![false; particles.len()];
        rows.into_iter().for_each(|row| leaves[row] = true);
        simulation.remove_where(|_, row| leaves[row]);
    }
}
