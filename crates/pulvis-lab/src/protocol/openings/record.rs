//! What a checkpoint keeps of inlets and outlets.

use pulvis_input::scenario::Amount;
use pulvis_math::Vector3;
use pulvis_packing::InletState;
use serde::{Deserialize, Serialize};

use super::{Clock, Drain, Feed, Openings, Passage};

/// All of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(in crate::protocol) struct OpeningsRecord {
    stage_start: f64,
    inlets: Vec<InletRecord>,
    outlets: Vec<OutletRecord>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct InletRecord {
    name: String,
    word_position: u128,
    next_radius: Option<f64>,
    number: u64,
    mass: f64,
    open_before: f64,
    opened: Option<f64>,
    looks: u64,
    timing: Timing,
    passage: PassageRecord,
}

/// What the clock of an inlet, and what it owes by it, are counted in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Timing {
    /// Whether the rate is one of mass.
    by_mass: bool,
    rate: f64,
    interval: f64,
    start: f64,
    stop: f64,
}

impl Timing {
    fn of(feed: &Feed) -> Self {
        let (rate, schedule) = (feed.plan.rate, &feed.plan.schedule);
        Self {
            by_mass: matches!(rate, Amount::Mass(_)),
            rate: rate.value(),
            interval: feed.interval,
            start: schedule.start,
            stop: schedule.stop,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct OutletRecord {
    name: String,
    is_open: bool,
    passage: PassageRecord,
}

/// What has passed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct PassageRecord {
    number: u64,
    mass: f64,
    momentum: [f64; 3],
    kinetic: f64,
    mass_before_stage: f64,
    classes: Vec<(u64, f64)>,
}

impl Openings {
    pub(in crate::protocol) fn record(&self) -> OpeningsRecord {
        let Self { feeds, drains, stage_start } = self;
        OpeningsRecord {
            stage_start: *stage_start,
            inlets: feeds.iter().map(inlet_record).collect(),
            outlets: drains.iter().map(outlet_record).collect(),
        }
    }

    /// Goes on where a record was taken; openings of other names begin anew.
    pub(super) fn restore(&mut self, record: &OpeningsRecord) {
        let OpeningsRecord { stage_start, inlets, outlets } = record;
        self.stage_start = *stage_start;
        for feed in &mut self.feeds {
            let Some(known) = inlets.iter().find(|known| known.name == feed.plan.name) else { continue };
            let InletRecord {
                name: _,
                word_position,
                next_radius,
                number,
                mass,
                open_before,
                opened,
                looks,
                timing,
                passage,
            } = known;
            let (smallest, largest) = feed.plan.radius.limits();
            feed.inlet.set_state(&InletState {
                word_position: *word_position,
                next_radius: next_radius.filter(|radius| (smallest..=largest).contains(radius)),
                number: *number,
                mass: *mass,
            });
            feed.clock = if *timing == Timing::of(feed) {
                Clock { open_before: *open_before, opened: *opened, looks: *looks }
            } else {
                // A branch with another rate owes nothing for the time before: as if it had run at this one until it had
                // brought in what it has.
                Clock { open_before: feed.inlet.supplied() / feed.plan.rate.value(), ..Clock::SHUT }
            };
            restore_passage(&mut feed.passage, passage);
        }
        for drain in &mut self.drains {
            let Some(known) = outlets.iter().find(|known| known.name == drain.plan.name) else { continue };
            let OutletRecord { name: _, is_open, passage } = known;
            drain.is_open = *is_open;
            restore_passage(&mut drain.passage, passage);
        }
    }
}

fn inlet_record(feed: &Feed) -> InletRecord {
    let Clock { open_before, opened, looks } = &feed.clock;
    let InletState { word_position, next_radius, number, mass } = feed.inlet.state();
    InletRecord {
        name: feed.plan.name.clone(),
        word_position,
        next_radius,
        number,
        mass,
        open_before: *open_before,
        opened: *opened,
        looks: *looks,
        timing: Timing::of(feed),
        passage: passage_record(&feed.passage),
    }
}

fn outlet_record(drain: &Drain) -> OutletRecord {
    let Drain { plan, is_open, passage } = drain;
    OutletRecord { name: plan.name.clone(), is_open: *is_open, passage: passage_record(passage) }
}

fn passage_record(passage: &Passage) -> PassageRecord {
    // The radii between classes are those of the scenario.
    let Passage { number, mass, momentum, kinetic, mass_before_stage, classes, bounds: _ } = passage;
    PassageRecord {
        number: *number,
        mass: *mass,
        momentum: momentum.to_array(),
        kinetic: *kinetic,
        mass_before_stage: *mass_before_stage,
        classes: classes.clone(),
    }
}

fn restore_passage(passage: &mut Passage, record: &PassageRecord) {
    let PassageRecord { number, mass, momentum, kinetic, mass_before_stage, classes } = record;
    (passage.number, passage.mass, passage.kinetic) = (*number, *mass, *kinetic);
    (passage.momentum, passage.mass_before_stage) = (Vector3::from(*momentum), *mass_before_stage);
    // Another division into classes begins anew.
    if passage.classes.len() == classes.len() {
        passage.classes.clone_from(classes);
    }
}
