//! When a stage ends.

use pulvis_boundary::Shape;
use pulvis_core::{CellControl, Simulation, UpperTriangular};
use pulvis_input::scenario::{Crossing, Programs, Scenario, Stage, StopRules, WallMotion};

use super::cell::time_to_strain;
use super::checkpoint::WatchRecord;
use super::ending::Ending;
use super::measure::Measure;
use super::openings::Openings;
use super::programs::elapsed;
use super::setup::{box_walls, extent};
use super::steady::Steady;
use pulvis_core::walls::Extent;

/// Steps between two looks at rules that cost time.
pub(super) const LOOK_EVERY: u64 = 50;

/// The kinetic energy of a sample that breathes passes through zero twice a period, so the ratio to
/// the elastic energy must stay low over this many looks (of [`LOOK_EVERY`] steps: about ten contacts).
const LOOKS_IN_A_ROW: u32 = 10;

/// A sample cannot be found at rest after fewer steps.
pub(super) const LEAST_STEPS_TO_REST: u64 = LOOK_EVERY * LOOKS_IN_A_ROW as u64;

/// What of a state somebody looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look {
    /// What all forces come to.
    Totals,
    /// The energy ledger, too.
    Energies,
    /// Particles, too.
    Particles,
    /// Contacts, too; or the state is about to change.
    Everything,
}

/// Watches over a stage while it runs.
pub(super) struct StageWatch<'a> {
    scenario: &'a Scenario,
    rules: &'a StopRules,
    programs: Option<&'a Programs>,
    start_step: u64,
    start_time: f64,
    /// Extent along each axis at the start of the stage [m].
    start_lengths: [Option<f64>; 3],
    /// Strain of the cell at the start of the stage [1].
    start_strain: [f64; 6],
    calm_looks: u32,
    last_stress: Option<f64>,
    steady: Steady,
}

impl<'a> StageWatch<'a> {
    pub(super) fn new(scenario: &'a Scenario, stage: &'a Stage, simulation: &Simulation) -> Self {
        Self {
            scenario,
            rules: &stage.until,
            programs: stage.programs.as_ref(),
            start_step: simulation.steps(),
            start_time: simulation.time(),
            start_lengths: [0, 1, 2].map(|axis| length(scenario, simulation, axis)),
            start_strain: simulation.cell_strain().to_array(),
            calm_looks: 0,
            last_stress: None,
            steady: Steady::default(),
        }
    }

    /// Goes on watching over a stage of an interrupted run.
    pub(super) fn resume(scenario: &'a Scenario, stage: &'a Stage, record: &WatchRecord) -> Self {
        let WatchRecord {
            start_step,
            start_time,
            start_lengths,
            start_strain,
            calm_looks,
            last_stress,
            steady,
        } = record.clone();
        let (rules, programs) = (&stage.until, stage.programs.as_ref());
        Self {
            scenario,
            rules,
            programs,
            start_step,
            start_time,
            start_lengths,
            start_strain,
            calm_looks,
            last_stress,
            steady,
        }
    }

    /// What the rules have seen so far.
    pub(super) fn record(&self) -> WatchRecord {
        let &Self {
            scenario: _,
            rules: _,
            programs: _,
            start_step,
            start_time,
            start_lengths,
            start_strain,
            calm_looks,
            last_stress,
            ref steady,
        } = self;
        let steady = steady.clone();
        WatchRecord { start_step, start_time, start_lengths, start_strain, calm_looks, last_stress, steady }
    }

    /// Extent along each axis at the start of the stage [m].
    pub(super) fn start_lengths(&self) -> [Option<f64>; 3] {
        self.start_lengths
    }

    /// How far the stage has come, from 0 to 1, where its duration is known.
    pub(super) fn progress(&self, simulation: &Simulation) -> Option<f64> {
        let strained = time_to_strain(self.rules, simulation.cell_motion());
        let duration = self.rules.time.or_else(|| cycles_duration(simulation));
        let duration = duration.into_iter().chain(strained).min_by(f64::total_cmp)?;
        Some(((simulation.time() - self.start_time) / duration).min(1.0))
    }

    /// When the stage began [s].
    pub(super) fn start_time(&self) -> f64 {
        self.start_time
    }

    /// Steps before which the stage certainly does not end, and no look is due.
    pub(super) fn steps_left(&self, simulation: &Simulation, openings: &Openings) -> u64 {
        // What has passed before the stage began ends it at its first step, not at the first look.
        if self.rules.strain.is_some() || self.rules.shear_strain.is_some() || self.has_passed(openings) {
            return 1;
        }
        let look = LOOK_EVERY - (simulation.steps() - self.start_step) % LOOK_EVERY;
        let end = self.rules.time.or_else(|| cycles_duration(simulation));
        let update = self.programs.and_then(|programs| {
            let next = programs.due(elapsed(simulation, self.start_time)) + 1;
            (next <= programs.updates()).then(|| programs.time_of(next))
        });
        let instants = end.into_iter().chain(update);
        instants.fold(look, |look, instant| look.min(whole_steps(self.start_time + instant, simulation)))
    }

    /// What [`ending`](Self::ending) looks at now that one of several ranks does not know by itself.
    pub(super) fn look(&self, simulation: &Simulation) -> Look {
        let looks = (simulation.steps() - self.start_step).is_multiple_of(LOOK_EVERY);
        let StopRules { steady, stress, kinetic_to_elastic, pressure_tolerance, .. } = self.rules;
        match looks {
            true if steady.is_some() => Look::Everything,
            // The stress of a cell is that of particles, too.
            true if stress.is_some() || pressure_tolerance.is_some() => Look::Particles,
            true if kinetic_to_elastic.is_some() => Look::Energies,
            _ => Look::Totals,
        }
    }

    /// Whether the stage, which has this number, ends now. `measure` takes what the rule `steady` looks at.
    pub(super) fn ending(
        &mut self,
        simulation: &Simulation,
        openings: &Openings,
        measure: &Measure,
        number: usize,
    ) -> Option<Ending> {
        // Half a step of tolerance: sums of time steps are not exact.
        let elapsed = simulation.time() - self.start_time + 0.5 * simulation.time_step();
        let cycles = cycles_duration(simulation);
        // A stage that has no rule but a wall's cycles takes their duration for its time.
        if let Some(end) = self.rules.time.or(cycles)
            && elapsed >= end
        {
            return Some(if cycles == Some(end) { Ending::Cycles } else { Ending::Time });
        }
        if self.strain_reached(simulation) || self.shear_reached(simulation) {
            return Some(Ending::Strain);
        }
        if self.has_passed(openings) {
            return Some(Ending::Passed);
        }
        if !(simulation.steps() - self.start_step).is_multiple_of(LOOK_EVERY) {
            return None;
        }
        if self.stress_reached(simulation) {
            return Some(Ending::Stress);
        }
        if self.is_steady(simulation, openings, measure, number) {
            return Some(Ending::Steady);
        }
        let calm = self.is_calm(simulation, elapsed);
        self.calm_looks = if calm { self.calm_looks + 1 } else { 0 };
        (self.calm_looks >= LOOKS_IN_A_ROW).then_some(Ending::AtRest)
    }

    fn is_steady(
        &mut self,
        simulation: &Simulation,
        openings: &Openings,
        measure: &Measure,
        number: usize,
    ) -> bool {
        let Some(rule) = &self.rules.steady else { return false };
        let row = measure.row(self.scenario, simulation, openings, number + 1, self.start_lengths);
        // That there is such a column has been checked before the run.
        let value = measure.column(&rule.column).map_or(f64::NAN, |column| row[column]);
        self.steady.look(rule, simulation.time() - self.start_time, value)
    }

    fn is_calm(&self, simulation: &Simulation, elapsed: f64) -> bool {
        let Some(limit) = self.rules.kinetic_to_elastic else { return false };
        if elapsed < self.rules.minimum_time {
            return false;
        }
        if let Some(tolerance) = self.rules.pressure_tolerance
            && !pressures_reached(simulation, tolerance)
        {
            return false;
        }
        let ledger = simulation.ledger();
        // Without a contact the ratio means nothing: only what does not move at all is at rest then. That a sample has
        // flown apart is no rest; it stops the run.
        ledger.kinetic() <= limit * ledger.elastic()
    }

    fn has_passed(&self, openings: &Openings) -> bool {
        self.rules.passed.is_some_and(|rule| openings.has_passed(rule.opening, rule.amount))
    }

    fn strain_reached(&self, simulation: &Simulation) -> bool {
        let Some(rule) = &self.rules.strain else { return false };
        let axis = rule.axis.index();
        let (Some(start), Some(now)) = (self.start_lengths[axis], length(self.scenario, simulation, axis))
        else {
            return false;
        };
        let strain = now / start - 1.0;
        if rule.value > 0.0 { strain >= rule.value } else { strain <= rule.value }
    }

    fn shear_reached(&self, simulation: &Simulation) -> bool {
        let Some(rule) = &self.rules.shear_strain else { return false };
        let strain = simulation.cell_strain().to_array()[rule.component] - self.start_strain[rule.component];
        if rule.value > 0.0 { strain >= rule.value } else { strain <= rule.value }
    }

    fn stress_reached(&mut self, simulation: &Simulation) -> bool {
        let Some(rule) = &self.rules.stress else { return false };
        let axis = rule.axis.index();
        let stress = cell_stress(simulation, axis).or_else(|| wall_stress(self.scenario, simulation, axis));
        let Some(stress) = stress else { return false };
        let before = self.last_stress.replace(stress);
        let side = |stress: f64| match rule.crosses {
            Crossing::Upwards => stress >= rule.value,
            Crossing::Downwards => stress <= rule.value,
        };
        before.is_some_and(|before| side(stress) && !side(before))
    }
}

/// Whether the stress on every servo wall is within a share of the pressure at the end of its ramp.
fn pressures_reached(simulation: &Simulation, tolerance: f64) -> bool {
    let walls = simulation.walls();
    let present = walls.iter().enumerate().filter(|(_, wall)| wall.present);
    let mut pistons = present.filter_map(|(place, wall)| match wall.motion {
        WallMotion::Servo(servo) => Some((place, wall, servo.pressure.to)),
        _ => None,
    });
    let is_near = |stress: f64, target: f64| (stress - target).abs() <= tolerance * target.abs();
    if !cell_follows(simulation, is_near) {
        return false;
    }
    pistons.all(|(place, wall, pressure)| {
        let stress = wall.shape.direction_of_push().zip(wall.area.of(walls));
        let stress = stress.map(|(normal, area)| -simulation.wall_force(place).dot(normal) / area);
        stress.is_some_and(|stress| is_near(stress, pressure))
    })
}

/// Whether all stresses that the cell follows are near those at the end of their ramps.
fn cell_follows(simulation: &Simulation, is_near: impl Fn(f64, f64) -> bool) -> bool {
    let motion = simulation.cell_motion();
    if motion.targets().next().is_none() {
        return true;
    }
    let (sums, volume) = (simulation.stress_times_volume(), simulation.domain().extent.volume());
    let stress = |[row, column]: [usize; 2]| sums[row][column] / volume;
    let mut components = motion.components.iter().zip(UpperTriangular::INDICES);
    let mean = (stress([0, 0]) + stress([1, 1]) + stress([2, 2])) / 3.0;
    components.all(|(control, indices)| match control {
        CellControl::Stress(ramp) => is_near(stress(indices), ramp.to),
        CellControl::Fixed | CellControl::Rate(_) => true,
    }) && motion.isotropic.is_none_or(|ramp| is_near(mean, ramp.to))
}

/// The stress of the cell along a periodic direction, compression positive [Pa].
fn cell_stress(simulation: &Simulation, axis: usize) -> Option<f64> {
    simulation.domain().period(axis)?;
    Some(simulation.stress_times_volume()[axis][axis] / simulation.domain().extent.volume())
}

/// Steps that end before `time` [s] for certain, with two to spare for rounding.
pub(super) fn whole_steps(time: f64, simulation: &Simulation) -> u64 {
    // A cast of a negative number is zero.
    ((time - simulation.time()) / simulation.time_step() - 2.0) as u64
}

/// Duration of the longest motion with an end that is under way [s].
fn cycles_duration(simulation: &Simulation) -> Option<f64> {
    let present = simulation.walls().iter().filter(|wall| wall.present);
    let walls = present.filter_map(|wall| wall.motion.law().duration());
    let groups = simulation.groups().iter().filter_map(|group| group.motion().duration());
    walls.chain(groups).max_by(f64::total_cmp)
}

/// Extent of the sample along an axis now [m].
pub(super) fn length(scenario: &Scenario, simulation: &Simulation, axis: usize) -> Option<f64> {
    if let Some(period) = simulation.domain().period(axis) {
        return Some(period);
    }
    match extent(scenario, axis)? {
        Extent::Given(length) => Some(length),
        Extent::Between(low, high) => {
            let walls = simulation.walls();
            Some((walls[high].point - walls[low].point)[axis])
        }
    }
}

/// Mean compressive force of the two box walls of an axis now [N].
pub(super) fn wall_force(scenario: &Scenario, simulation: &Simulation, axis: usize) -> Option<f64> {
    let [low, high] = box_walls(scenario, axis);
    let forces: Vec<f64> = [low, high]
        .into_iter()
        .flatten()
        .filter(|&place| simulation.walls()[place].present)
        .filter_map(|place| {
            let normal = simulation.walls()[place].plane_normal()?;
            Some(-simulation.wall_force(place).dot(normal))
        })
        .collect();
    if forces.is_empty() { None } else { Some(forces.iter().sum::<f64>() / forces.len() as f64) }
}

/// Mean compressive stress of the two box walls of an axis now [Pa].
pub(super) fn wall_stress(scenario: &Scenario, simulation: &Simulation, axis: usize) -> Option<f64> {
    let place = box_walls(scenario, axis).into_iter().flatten().next()?;
    Some(wall_force(scenario, simulation, axis)? / simulation.wall_area(place)?)
}
