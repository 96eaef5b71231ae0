//! What must fail is refused before it runs: particles and walls that are too fast for the time step, walls that are
//! driven through each other, pressures that no contact can carry.

use std::f64::consts::PI;

use pulvis_boundary::Shape;
use pulvis_core::walls::{FaceArea, Wall, WallMotion};
use pulvis_core::{Limits, Particle, TouchingAtOnce};
use pulvis_input::Problem;
use pulvis_input::scenario::{Refusal, Scenario, Stage, StopRules, WallControl};
use pulvis_math::Vector3;

use super::allow::refuse_unless_allowed;
use super::error::PrepareError;
use super::setup::{StagePlan, group_path};

/// Refuses what cannot come to a good end, whatever the particles do.
pub(super) fn check_feasible(
    scenario: &Scenario,
    particles: &[Particle],
    walls: &[Wall],
    plans: &[StagePlan],
) -> Result<(), PrepareError> {
    let smallest = particles.iter().map(|particle| particle.radius).fold(f64::INFINITY, f64::min);
    let course = Course { scenario, smallest, most: Limits::default().displacement };
    course.check_speeds(particles, plans[0].time_step)?;
    let mut walls: Vec<KnownWall> =
        walls.iter().map(|wall| KnownWall { wall: wall.clone(), known: true }).collect();
    for (number, (stage, plan)) in scenario.stages.iter().zip(plans).enumerate() {
        for (place, control) in &stage.controls {
            let Some(motion) = control.motion() else { continue };
            course.check_wall_speed(number, *place, (&motion, &walls[*place].wall), plan.time_step)?;
            if let Some(pressure) = highest_pressure(&motion, &stage.until) {
                course.check_pressure(number, *place, pressure, particles, plan, &walls[*place].wall)?;
            }
        }
        for (index, control) in &stage.groups {
            course.check_group_speed(number, *index, control.motion.highest_speed(), plan.time_step)?;
        }
        start_stage(walls.iter_mut().map(|known| &mut known.wall), stage);
        let duration = exact_duration(&stage.until);
        if let Some(duration) = duration {
            course.check_crossing(number, &walls, duration)?;
        }
        end_stage(&mut walls, duration);
    }
    Ok(())
}

/// A wall, and whether its place is known before the run.
struct KnownWall {
    wall: Wall,
    known: bool,
}

impl KnownWall {
    /// The wall at a time after the start of the stage [s]; `None` where that depends on the particles.
    fn at(&self, time: f64) -> Option<Wall> {
        let motion = self.wall.motion.law();
        let displacement = motion.displacement(Vector3::zero(), 0.0, time);
        (self.known && self.wall.present && !motion.is_pushed())
            .then(|| Wall { point: self.wall.point + displacement, ..self.wall.clone() })
    }
}

/// Controls at the start of a stage: a wall goes on as before, but a motion with an end has come to it.
pub(super) fn start_stage<'w>(walls: impl Iterator<Item = &'w mut Wall>, stage: &Stage) {
    for (place, wall) in walls.enumerate() {
        let control = stage.controls.iter().find(|(wall, _)| *wall == place).map(|(_, control)| control);
        match control {
            Some(control) => {
                wall.motion = control.motion().unwrap_or_default();
                wall.present &= !matches!(control, WallControl::Removed);
            }
            None if wall.motion.law().duration().is_some() => wall.motion = WallMotion::Fixed,
            None => {}
        }
    }
}

/// The time that a stage lasts for certain [s]: other rules may end it before, or keep it from ending.
fn exact_duration(until: &StopRules) -> Option<f64> {
    until.time.filter(|_| !until.are_open_ended())
}

/// Where walls stand after a stage, as far as that is known.
fn end_stage(walls: &mut [KnownWall], duration: Option<f64>) {
    for known in walls {
        match duration.and_then(|duration| known.at(duration)) {
            Some(wall) => known.wall.point = wall.point,
            None => known.known &= known.wall.motion == WallMotion::Fixed,
        }
    }
}

/// What motions are measured by.
struct Course<'a> {
    scenario: &'a Scenario,
    /// The smallest radius [m].
    smallest: f64,
    /// The longest way in a step over it [1].
    most: f64,
}

impl Course<'_> {
    /// What is wrong with a speed [m/s], if it is too high for the time step [s].
    fn too_fast(&self, what: String, speed: f64, time_step: f64) -> Option<Problem> {
        let Self { smallest, most, .. } = self;
        let radii = speed * time_step / smallest;
        // Not `>`: what is no number is refused as well.
        let fits = radii <= *most;
        (!fits).then(|| {
            let found = format!(
                "{what} {speed:.4e} m/s, {radii:.3} radii of the smallest particle ({smallest:.4e} m) in a time step of {time_step:.4e} s"
            );
            let expected = format!("at most {most} radii in a step, {:.4e} m/s", most * smallest / time_step);
            Problem::rule(found, expected)
        })
    }

    fn check_speeds(&self, particles: &[Particle], time_step: f64) -> Result<(), PrepareError> {
        let speeds = particles.iter().map(|particle| particle.velocity.norm()).enumerate();
        let Some((id, speed)) = speeds.max_by(|(_, one), (_, other)| one.total_cmp(other)) else {
            return Ok(());
        };
        // The last ones stand for those of inlets, two for each.
        let inlets = &self.scenario.inlets;
        let of_inlet = (id + 2 * inlets.len()).checked_sub(particles.len()).map(|number| number / 2);
        let what = match of_inlet {
            Some(number) => format!("inlet {} brings particles in at", inlets[number].name),
            None => format!("particle {id} moves at"),
        };
        let Some(problem) = self.too_fast(what, speed, time_step) else { return Ok(()) };
        let group =
            of_inlet.map_or_else(|| group_path(self.scenario, id), |number| format!("inlets[{number}]"));
        let paths = [format!("{group}.velocity"), format!("{group}.arrangement")];
        let help =
            "lower the speed, or shorten the step, for example by more `steps_per_contact_time` in [time]";
        refuse_unless_allowed(self.scenario, Refusal::Speed, &[&paths[0], &paths[1]], problem, help)
    }

    fn check_wall_speed(
        &self,
        stage: usize,
        place: usize,
        (motion, wall): (&WallMotion, &Wall),
        time_step: f64,
    ) -> Result<(), PrepareError> {
        let (motion, name) = (motion.law(), &self.scenario.walls[place].name);
        let around = motion.angular_velocity().abs() * wall.shape.distance_from_axis();
        let ways = [
            ("velocity", format!("the wall {name} moves at"), motion.highest_speed()),
            ("angular_velocity", format!("the surface of the wall {name} goes round at"), around),
        ];
        for (key, what, speed) in ways {
            if let Some(problem) = self.too_fast(what, speed, time_step) {
                let help = "lower the speed, or shorten the step, for example by more `steps_per_contact_time` in [time]";
                self.refuse(Refusal::Speed, stage, place, key, (problem, help))?;
            }
        }
        Ok(())
    }

    fn check_group_speed(
        &self,
        stage: usize,
        index: usize,
        speed: f64,
        time_step: f64,
    ) -> Result<(), PrepareError> {
        let name = &self.scenario.groups[index].name;
        let Some(problem) = self.too_fast(format!("the group {name} moves at"), speed, time_step) else {
            return Ok(());
        };
        let table = format!("stages[{stage}].groups.{name}");
        let help =
            "lower the speed, or shorten the step, for example by more `steps_per_contact_time` in [time]";
        let paths = [format!("{table}.velocity"), table];
        refuse_unless_allowed(self.scenario, Refusal::Speed, &[&paths[0], &paths[1]], problem, help)
    }

    /// Refuses a pressure that even a face full of the smallest particles carries only pressed in by more than the
    /// largest radius: π a² of the face, a the smallest radius, has one contact, and that no more than its steepest slope.
    fn check_pressure(
        &self,
        stage: usize,
        place: usize,
        pressure: f64,
        particles: &[Particle],
        plan: &StagePlan,
        wall: &Wall,
    ) -> Result<(), PrepareError> {
        let cross_section = PI * self.smallest * self.smallest;
        let mut walls = vec![wall.clone()];
        walls[0].area = FaceArea::Given(cross_section * (1.0 - 1e-9));
        let stiffness = TouchingAtOnce::of(particles, &plan.interactions, &walls, 0, false).stiffness;
        let largest = particles.iter().map(|particle| particle.radius).fold(0.0, f64::max);
        let overlap = pressure * cross_section / stiffness;
        if overlap <= largest || particles.is_empty() {
            return Ok(());
        }
        let name = &self.scenario.walls[place].name;
        let found = format!(
            "{pressure:e} Pa press the particles {overlap:.4e} m deep into the wall {name}, even if they fill its face: more than their radius, {largest:.4e} m"
        );
        let expected = format!(
            "at most {:.4e} Pa with contacts of {stiffness:e} N/m",
            largest * stiffness / cross_section
        );
        let help = "lower the pressure, or stiffen the contact";
        self.refuse(Refusal::Pressure, stage, place, "pressure", (Problem::rule(found, expected), help))
    }

    /// Refuses walls that meet while their motion is prescribed.
    fn check_crossing(&self, stage: usize, walls: &[KnownWall], duration: f64) -> Result<(), PrepareError> {
        const INSTANTS: u32 = 512;
        let pairs = (0..walls.len()).flat_map(|one| (one + 1..walls.len()).map(move |other| [one, other]));
        for [one, other] in pairs {
            for instant in 0..=INSTANTS {
                let time = duration * f64::from(instant) / f64::from(INSTANTS);
                let Some((first, second)) = walls[one].at(time).zip(walls[other].at(time)) else { break };
                let Some(distance) = first.distance_to_facing(&second) else { break };
                if distance <= 0.0 {
                    let found = format!(
                        "the walls {} and {} meet within {time:.4e} s of the stage, which lasts {duration:.4e} s",
                        first.name, second.name
                    );
                    let problem = Problem::rule(found, "space between walls that face each other");
                    let moves = |place: &usize| walls[*place].wall.motion != WallMotion::Fixed;
                    let place = [one, other].into_iter().find(moves).unwrap_or(one);
                    let help = "lower the velocity, shorten the stage, or end it by `strain` or `stress`";
                    return self.refuse(Refusal::CrossingWalls, stage, place, "velocity", (problem, help));
                }
            }
        }
        Ok(())
    }

    /// A mistake of what a stage does with a wall; of the stage, if an earlier one began it.
    fn refuse(
        &self,
        refusal: Refusal,
        stage: usize,
        place: usize,
        key: &str,
        (problem, help): (Problem, &str),
    ) -> Result<(), PrepareError> {
        let table = format!("stages[{stage}].walls.{}", self.scenario.walls[place].name);
        let paths = [format!("{table}.{key}"), table, format!("stages[{stage}].until")];
        refuse_unless_allowed(self.scenario, refusal, &[&paths[0], &paths[1], &paths[2]], problem, help)
    }
}

/// The highest pressure that a motion comes to in the stage [Pa], if it has one: ramps rise or fall all the way.
pub(super) fn highest_pressure(motion: &WallMotion, until: &StopRules) -> Option<f64> {
    let motion = motion.law();
    Some(motion.pressure(0.0)?.max(motion.pressure(until.time.unwrap_or(f64::INFINITY))?))
}
