//! What is valid and yet probably not meant.

use pulvis_boundary::{CellControl, CellMotion, GroupMotion, WallMotion};
use pulvis_contact::bond::Form;
use pulvis_input::scenario::{Axis, BoxFace, Crossing, Scenario, Side, Stage, WallControl};
use pulvis_math::Vector3;

use super::allow::allowed;
use super::damping::overdamped;
use super::setup::Prepared;

/// Everything that deserves a second look before the run starts.
pub fn warnings(scenario: &Scenario, prepared: &Prepared) -> Vec<String> {
    let mut warnings: Vec<String> = allowed(scenario).collect();
    warnings.extend(overdamped(scenario, &prepared.sample).iter().map(ToString::to_string));
    warnings.extend(unformed_bonds(scenario));
    let mut driven = Driven::at_start(scenario, prepared);
    for stage in &scenario.stages {
        driven.enter(stage);
        warnings.extend(driven.warnings(scenario, stage).map(|text| format!("stage {}: {text}", stage.name)));
    }
    warnings
}

/// What sets the sample in motion, stage by stage.
struct Driven {
    controls: Vec<WallControl>,
    groups: Vec<GroupMotion>,
    gravity: bool,
    cell: CellMotion,
    /// Whether anything has moved by the end of the stages so far.
    moved: bool,
}

impl Driven {
    fn at_start(scenario: &Scenario, prepared: &Prepared) -> Self {
        let moves = |particle: &pulvis_core::Particle| {
            particle.velocity.norm_squared() > 0.0 || particle.angular_velocity.norm_squared() > 0.0
        };
        let mut pushed = false;
        let simulation = &prepared.simulation;
        simulation.for_each_contact(&mut |contact| pushed |= contact.force.norm_squared() > 0.0);
        let mut by_charges =
            (0..simulation.particles().len()).filter_map(|row| simulation.electrostatic_force(row));
        pushed |= by_charges.any(|force| force.norm_squared() > 0.0);
        Self {
            controls: vec![WallControl::Motion(WallMotion::Fixed); scenario.walls.len()],
            groups: scenario.groups.iter().map(|group| known(prepared, &group.name)).collect(),
            gravity: false,
            cell: *prepared.simulation.cell_motion(),
            moved: pushed || prepared.sample.iter().any(moves),
        }
    }

    fn enter(&mut self, stage: &Stage) {
        for (wall, control) in &stage.controls {
            self.controls[*wall] = *control;
        }
        for (group, control) in &stage.groups {
            self.groups[*group] = control.motion;
        }
        self.gravity = stage.background.gravity.norm_squared() > 0.0;
        self.cell = stage.cell.unwrap_or(self.cell);
        self.moved |= self.gravity || self.has_moving_wall();
    }

    /// Or a group that is led, or a cell that deforms.
    fn has_moving_wall(&self) -> bool {
        self.cell.moves()
            || self.groups.iter().any(GroupMotion::is_led)
            || self.controls.iter().any(|control| !stands_still(control))
    }

    /// The controls of the walls of the box along an axis.
    fn along(&self, scenario: &Scenario, axis: Axis) -> Vec<WallControl> {
        let is_there = |side| {
            let face = BoxFace { axis, side };
            scenario.walls.iter().position(|wall| wall.face == Some(face)).map(|wall| self.controls[wall])
        };
        [Side::Low, Side::High].into_iter().filter_map(is_there).collect()
    }

    fn warnings(&self, scenario: &Scenario, stage: &Stage) -> impl Iterator<Item = String> {
        let rules = &stage.until;
        let idle = (!self.moved).then(|| {
            let rest = "no gravity, no wall that moves, all particles at rest";
            match rules.kinetic_to_elastic {
                Some(_) => format!(
                    "nothing moves ({rest}), so that waiting for rest tells nothing; is gravity missing?"
                ),
                None => format!("nothing moves ({rest})"),
            }
        });
        let undriven = (self.moved && rules.kinetic_to_elastic.is_some() && !self.gravity && !self.has_moving_wall())
            .then(|| "it waits for rest without gravity and without a wall that moves: particles that fly freely have no elastic energy to compare with".to_owned())
            .filter(|_| rules.time.is_none());
        let endless = (rules.time.is_none() && self.needs_time(stage))
            .then(|| "it has no `time`: it goes on for ever if its rule never holds".to_owned());
        let strain = rules.strain.and_then(|rule| self.strain(scenario, rule.axis));
        let stress = rules.stress.and_then(|rule| self.stress(scenario, rule.axis, rule.value, rule.crosses));
        [idle, undriven, strain, stress, endless].into_iter().flatten()
    }

    /// Whether the rules of a stage without `time` may fail to end it: a strain that walls of given velocity
    /// reach is certain, and was checked with the file.
    fn needs_time(&self, stage: &Stage) -> bool {
        let rules = &stage.until;
        let has_cycles = self.controls.iter().any(|control| control.duration().is_some())
            || self.groups.iter().any(|motion| motion.duration().is_some());
        let at_rate = |component: usize| matches!(self.cell.components[component], CellControl::Rate(_));
        let certain_shear = rules.shear_strain.is_some_and(|rule| at_rate(rule.component));
        let followed = rules
            .strain
            .is_some_and(|rule| self.cell.deforms(rule.axis.index()) && !at_rate(rule.axis.index()));
        let certain_strain = rules.strain.is_some()
            && !followed
            && self.controls.iter().all(|control| match control {
                WallControl::Motion(motion) => motion.law().constant_velocity().is_some(),
                WallControl::Removed => true,
            });
        !has_cycles && !certain_strain && !certain_shear
    }

    fn strain(&self, scenario: &Scenario, axis: Axis) -> Option<String> {
        // That the cell deforms along it has been checked with the file.
        let repeats = scenario.domain.is_some_and(|domain| domain.periodic[axis.index()]);
        let fixed = !repeats && self.along(scenario, axis).iter().all(stands_still);
        let name = axis.name();
        fixed.then(|| format!("the rule `strain` never holds: no wall moves along {name}"))
    }

    fn stress(&self, scenario: &Scenario, axis: Axis, value: f64, crosses: Crossing) -> Option<String> {
        let name = axis.name();
        if !self.moved {
            return Some(format!("the rule `stress` never holds: nothing presses the walls along {name}"));
        }
        let pressures = self.along(scenario, axis).into_iter().filter_map(|control| match control {
            WallControl::Motion(WallMotion::Servo(servo)) => Some([servo.pressure.from, servo.pressure.to]),
            _ => None,
        });
        let [from, to] = pressures.into_iter().next()?;
        let (low, high) = (from.min(to), from.max(to));
        let beyond = match crosses {
            Crossing::Upwards => value > high,
            Crossing::Downwards => value < low,
        };
        beyond.then(|| {
            format!(
                "the rule `stress` holds in overshoots at most: the servo along {name} keeps between {low:e} and {high:e} Pa, the rule waits for {value:e} Pa"
            )
        })
    }
}

/// How a group of the run before moves.
fn known(prepared: &Prepared, name: &str) -> GroupMotion {
    prepared.simulation.group(name).map_or(GroupMotion::Free, |group| *group.motion())
}

/// Whether a wall does not move, or is not there.
fn stands_still(control: &WallControl) -> bool {
    match control {
        WallControl::Motion(motion) => motion.law().constant_velocity() == Some(Vector3::zero()),
        WallControl::Removed => true,
    }
}

/// Contacts whose bonds form at the start of stages, where no stage forms any.
fn unformed_bonds(scenario: &Scenario) -> Vec<String> {
    if scenario.stages.iter().any(|stage| stage.form_bonds) {
        return Vec::new();
    }
    let mut waiting: Vec<[usize; 2]> = Vec::new();
    for contact in scenario.stages.iter().flat_map(|stage| &stage.contacts) {
        let bond = contact.model.laws.bond;
        let waits = bond.is_some_and(|bond| bond.formation.form == Form::StageStart);
        if waits && !waiting.contains(&contact.materials) {
            waiting.push(contact.materials);
        }
    }
    let name = |material: usize| scenario.materials[material].name.as_str();
    let text = |[one, other]: [usize; 2]| {
        let (one, other) = (name(one), name(other));
        format!(
            "contact {one}-{other}: its bonds form at the start of a stage with `form_bonds = true`, and there is none"
        )
    };
    waiting.into_iter().map(text).collect()
}
