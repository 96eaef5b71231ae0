//! What is valid and yet probably not meant.

use pulvis_boundary::WallMotion;
use pulvis_contact::bond::Form;
use pulvis_contact::{ContactModel, Pair};
use pulvis_input::scenario::{Axis, BoxFace, Contact, Crossing, Scenario, Side, Stage, WallControl};
use pulvis_math::Vector3;

use super::check::typical_bodies;
use super::setup::Prepared;

/// Everything that deserves a second look before the run starts.
pub fn warnings(scenario: &Scenario, prepared: &Prepared) -> Vec<String> {
    let mut warnings = overdamped(scenario, prepared);
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
    gravity: bool,
    /// Whether anything has moved by the end of the stages so far.
    moved: bool,
}

impl Driven {
    fn at_start(scenario: &Scenario, prepared: &Prepared) -> Self {
        let moves = |particle: &pulvis_core::Particle| {
            particle.velocity.norm_squared() > 0.0 || particle.angular_velocity.norm_squared() > 0.0
        };
        let mut pushed = false;
        prepared.simulation.for_each_contact(&mut |contact| pushed |= contact.force.norm_squared() > 0.0);
        Self {
            controls: vec![WallControl::Motion(WallMotion::Fixed); scenario.walls.len()],
            gravity: false,
            moved: pushed || prepared.particles.iter().any(moves),
        }
    }

    fn enter(&mut self, stage: &Stage) {
        for (wall, control) in &stage.controls {
            self.controls[*wall] = *control;
        }
        self.gravity = stage.background.gravity.norm_squared() > 0.0;
        self.moved |= self.gravity || self.has_moving_wall();
    }

    fn has_moving_wall(&self) -> bool {
        self.controls.iter().any(|control| !stands_still(control))
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
        let has_cycles = self.controls.iter().any(|control| control.duration().is_some());
        let certain_strain = rules.strain.is_some()
            && self.controls.iter().all(|control| match control {
                WallControl::Motion(motion) => motion.law().constant_velocity().is_some(),
                WallControl::Removed => true,
            });
        !has_cycles && !certain_strain
    }

    fn strain(&self, scenario: &Scenario, axis: Axis) -> Option<String> {
        let fixed = self.along(scenario, axis).iter().all(stands_still);
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

/// Contacts whose dashpots are beyond critical, each once.
fn overdamped(scenario: &Scenario, prepared: &Prepared) -> Vec<String> {
    let mut seen: Vec<&Contact> = Vec::new();
    let mut warnings = Vec::new();
    for stage in &scenario.stages {
        for contact in &stage.contacts {
            if seen.iter().any(|known| known.materials == contact.materials && known.model == contact.model) {
                continue;
            }
            seen.push(contact);
            let Some((body, partner)) = typical_bodies(&prepared.particles, contact.materials) else {
                continue;
            };
            let names = contact.materials.map(|material| scenario.materials[material].name.as_str());
            for (what, ratio) in damping_ratios(&contact.model, body, partner) {
                if ratio > 1.0 {
                    let digits = if ratio < 10.0 { 2 } else { 0 };
                    warnings.push(format!(
                        "contact {} (stage {}): the dashpot {what} is {ratio:.digits$} times the critical one; such a contact creeps, and makes the time step shorter than its springs need",
                        names.join("-"),
                        stage.name
                    ));
                }
            }
        }
    }
    warnings
}

/// The modes of a bond, in the order of its dashpots.
const BOND_MODES: [&str; 4] = [
    "of the bond along it",
    "of the bond across it",
    "of the bond against bending",
    "of the bond against torsion",
];

/// Damping ratios γ/(2 √(k m)) [1] of the contact of two bodies with mass [kg] and radius [m], the second one a
/// wall where `None`, on the stiffest branch of each law.
pub(super) fn damping_ratios(
    model: &ContactModel,
    body: (f64, f64),
    partner: Option<(f64, f64)>,
) -> Vec<(&'static str, f64)> {
    let pair = match partner {
        Some(partner) => Pair::spheres(body.0, partner.0, body.1, partner.1),
        None => Pair::wall(body.0, body.1),
    };
    let laws = &model.laws;
    let stiffness = model.normal.max_stiffness(&pair, &laws.expected);
    let dashpot =
        model.normal.dashpot(&pair, &laws.expected) + laws.viscosity.largest_coefficient(&pair, stiffness);
    let scale = model.scale(&pair);
    let ratio = |dashpot: f64, stiffness: f64, inverse_mass: f64| {
        if dashpot > 0.0 && stiffness > 0.0 { dashpot * (inverse_mass / stiffness).sqrt() / 2.0 } else { 0.0 }
    };
    let normal = ratio(dashpot, stiffness, pair.inverse_reduced_mass());
    // Solid spheres, I = 2/5 m a²: sliding moves mass and inertia, 1/m (1 + 5/2); rolling and torsion turn.
    let inverse_mass = |(mass, _): (f64, f64)| 1.0 / mass;
    let masses = inverse_mass(body) + partner.map_or(0.0, inverse_mass);
    let lever = pair.harmonic_radius();
    let turn = |(mass, radius): (f64, f64)| 2.5 * lever * lever / (mass * radius * radius);
    let turning = turn(body) + partner.map_or(0.0, turn);
    let mut ratios = vec![("along the normal", normal)];
    if let Some(bond) = &laws.bond {
        let radii = [body.1, partner.map_or(0.0, |(_, radius)| radius)];
        let (stiffness, dashpots) = (bond.stiffness_at_touch(radii), bond.dashpots_at_touch(radii));
        let springs = [stiffness.normal, stiffness.shear, stiffness.bending, stiffness.torsion];
        let turning = turning / (lever * lever);
        let inverse_masses = [pair.inverse_reduced_mass(), 3.5 * masses, turning, turning];
        let ratio = |mode: usize| ratio(dashpots[mode], springs[mode], inverse_masses[mode]);
        ratios.extend(BOND_MODES.iter().enumerate().map(|(mode, what)| (*what, ratio(mode))));
    }
    for (what, law, inverse_mass) in [
        ("of sliding", &laws.sliding, 3.5 * masses),
        ("of rolling", &laws.rolling, turning),
        ("of torsion", &laws.torsion, turning),
    ] {
        if let Some(law) = law {
            ratios.push((what, ratio(law.dashpot(), law.max_stiffness(&scale), inverse_mass)));
        }
    }
    ratios
}
