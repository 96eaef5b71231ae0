//! Stages: what changes when, and until when.

use super::axis::{Axis, BoxFace, Side};
use super::cell::read_cell;
use super::contacts::Contact;
use super::controls::{WallControl, read_control};
use super::groups::{GroupControl, GroupPlan, read_group_controls};
use super::openings::Opening;
use super::particles::no_tables;
use super::programs::{PlannedPrograms, Programs, read_programs};
use super::region::read_region;
use super::switches::{Switch, read_switches};
use super::time::{TimeStep, read_time};
use super::until::{StopRules, read_until};
use super::walls::Wall;
use crate::context::{Location, Reported};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::{Boolean, Text};
use pulvis_boundary::{Background, CellControl, CellMotion, Domain, Region, UpperTriangular, WallMotion};

/// A stage of a run, with everything that holds while it lasts.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// Its name, which no other stage has.
    pub name: String,
    /// When it ends; at least one rule is given.
    pub until: StopRules,
    /// The particles whose centres lie here are taken away at its start.
    pub remove: Option<Region>,
    /// Whether bonds form at its start, where contacts have bonds that form then.
    pub form_bonds: bool,
    /// The walls whose control changes at its start, by index; other walls go on as before.
    pub controls: Vec<(usize, WallControl)>,
    /// The groups whose motion changes at its start, by index; others go on as before.
    pub groups: Vec<(usize, GroupControl)>,
    /// How the periodic cell deforms from its start on; where none is given it goes on as before.
    pub cell: Option<CellMotion>,
    /// One contact for every pair of materials that can meet, in the order of [`super::Scenario::contacts`].
    pub contacts: Vec<Contact>,
    /// Gravity and drag.
    pub background: Background,
    /// How long a time step is.
    pub time: TimeStep,
    /// What changes of contacts, gravity and drag while the stage runs.
    pub programs: Option<Programs>,
}

impl Stage {
    /// The contacts that the stage leaves to the next one.
    pub fn last_contacts(&self) -> &[Contact] {
        self.programs
            .as_ref()
            .and_then(|programs| programs.states.last())
            .map_or(&self.contacts, |last| &last.contacts)
    }

    /// The background that the stage leaves to the next one.
    pub fn last_background(&self) -> Background {
        self.programs
            .as_ref()
            .and_then(|programs| programs.states.last())
            .map_or(self.background, |last| last.background)
    }

    /// All contacts that there are during the stage, those of the start first.
    pub fn all_contacts(&self) -> impl Iterator<Item = &Contact> {
        let later = self.programs.iter().flat_map(|programs| programs.states.iter().skip(1));
        self.contacts.iter().chain(later.flat_map(|state| &state.contacts))
    }
}

/// A stage as it stands in the file, before its switches have been applied.
pub(super) struct PlannedStage {
    pub(super) name: String,
    pub(super) until: StopRules,
    pub(super) remove: Option<Region>,
    /// Where the file says that bonds form at its start.
    pub(super) form_bonds: Option<Location>,
    pub(super) controls: Vec<(usize, WallControl)>,
    pub(super) groups: Vec<(usize, GroupControl)>,
    /// With its place in the file.
    pub(super) cell: Option<(CellMotion, Location)>,
    pub(super) switches: Vec<Switch>,
    pub(super) programs: Option<PlannedPrograms>,
    pub(super) time: TimeStep,
    pub(super) place: Location,
}

/// Reads `[[stages]]`; `time` holds before the first one.
pub(super) fn read_stages(
    root: &mut TableReader<'_>,
    domain: Option<&Domain>,
    walls: &[Wall],
    groups: &[GroupPlan],
    openings: &[Opening],
    time: TimeStep,
) -> Result<Vec<PlannedStage>, Reported> {
    let tables = root.tables("stages")?;
    if tables.is_empty() {
        return Err(root.refuse("stages", no_tables(root, "stages")));
    }
    let mut stages: Vec<PlannedStage> = Vec::new();
    let controls = vec![WallControl::Motion(WallMotion::Fixed); walls.len()];
    let mut now = Now { domain, groups, openings, controls, cell: CellMotion::default(), time };
    let mut failure = None;
    for table in tables {
        match read_stage(table, walls, &mut now, &stages) {
            Ok(stage) => stages.push(stage),
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(stages), Err)
}

/// What the stages before have left behind.
struct Now<'a> {
    domain: Option<&'a Domain>,
    /// The groups of the scenario.
    groups: &'a [GroupPlan],
    /// The inlets and outlets of the scenario.
    openings: &'a [Opening],
    controls: Vec<WallControl>,
    cell: CellMotion,
    time: TimeStep,
}

fn read_stage(
    mut table: TableReader<'_>,
    walls: &[Wall],
    now: &mut Now<'_>,
    before: &[PlannedStage],
) -> Result<PlannedStage, Reported> {
    let name = table.required("name", Text).and_then(|name| {
        if before.iter().any(|stage| stage.name == name) {
            let found = format!("two stages are called \"{name}\"");
            return Err(table.refuse("name", Problem::rule(found, "another name for each stage")));
        }
        Ok(name)
    });
    let until = read_until(&mut table, now.openings);
    let remove = read_region(&mut table, "remove");
    let form_bonds = read_formation(&mut table);
    let controls = read_controls(&mut table, walls, now);
    let groups = read_group_controls(&mut table, now.groups, now.domain);
    let cell = read_cell_now(&mut table, walls, now);
    let switches = read_switches(&mut table);
    let programs = read_programs(&mut table, until.as_ref().ok());
    let time = read_time(&mut table, now.time);
    if let Ok(time) = time {
        now.time = time;
    }
    let until = match (until, &controls, &groups, &cell) {
        (Ok(until), Ok(controls), Ok(groups), Ok(_)) => {
            let walls_end = controls.iter().filter_map(|(_, control)| control.duration());
            let groups_end = groups.iter().filter_map(|(_, control)| control.motion.duration());
            complete(&table, until, walls_end.chain(groups_end), walls, now)
        }
        (Err(reported), ..) => Err(reported),
        (_, &Err(reported), ..) | (_, _, &Err(reported), _) | (.., &Err(reported)) => Err(reported),
    };
    let place = table.location("");
    table.finish();
    Ok(PlannedStage {
        name: name?,
        until: until?,
        remove: remove?,
        form_bonds: form_bonds?,
        controls: controls?,
        groups: groups?,
        cell: cell?,
        switches: switches?,
        programs: programs?,
        time: time?,
        place,
    })
}

/// Reads `form_bonds`; answers with its place where it is true.
fn read_formation(stage: &mut TableReader<'_>) -> Result<Option<Location>, Reported> {
    let place = stage.location("form_bonds");
    Ok(stage.or("form_bonds", Boolean, false)?.then_some(place))
}

/// Reads `[stages.walls.NAME]`.
fn read_controls(
    stage: &mut TableReader<'_>,
    walls: &[Wall],
    now: &mut Now<'_>,
) -> Result<Vec<(usize, WallControl)>, Reported> {
    let names: Vec<&str> = walls.iter().map(|wall| wall.name.as_str()).collect();
    let mut controls = Vec::new();
    let mut failure = None;
    for (name, table) in stage.named_tables("walls")? {
        let found = walls.iter().zip(&mut now.controls).enumerate().find(|(_, (wall, _))| wall.name == name);
        let read = match found {
            None if names.is_empty() => {
                let found = format!("there is no wall {name}, nor any other");
                Err(table.refuse("", Problem::rule(found, "a [box] or [walls] to control")))
            }
            None => Err(table.refuse("", Problem::unknown_choice(&name, &names))),
            Some((_, (_, WallControl::Removed))) => {
                let found = format!("the wall {name} has been removed by an earlier stage");
                Err(table.refuse("", Problem::rule(found, "a wall that is still there")))
            }
            Some((index, (wall, control))) => read_control(table, wall).map(|new| {
                *control = new;
                controls.push((index, new));
            }),
        };
        failure = read.err().or(failure);
    }
    controls.sort_by_key(|(index, _)| *index);
    failure.map_or(Ok(controls), Err)
}

/// The stop rules, which must be able to end the stage. Where none is given, a cosine motion that begins
/// with the stage ends it.
fn complete(
    table: &TableReader<'_>,
    mut until: StopRules,
    durations: impl Iterator<Item = f64>,
    walls: &[Wall],
    now: &Now<'_>,
) -> Result<StopRules, Reported> {
    if until.is_empty() {
        // A fraction of a cycle may be too short for a number.
        let longest = durations.filter(|duration| *duration > 0.0).reduce(f64::max);
        until.time = Some(longest.ok_or_else(|| {
            let found = "the stage has no end";
            let expected =
                "a rule in [stages.until], for example time = \"1 ms\", or a wall or group that moves by cosine";
            table.refuse("until", Problem::rule(found, expected))
        })?);
        return Ok(until);
    }
    check_shear_rule(table, &until, now)?;
    for (rule, axis) in until.axes() {
        if now.repeats(axis) {
            check_cell_rule(table, rule, axis, now)?;
            continue;
        }
        facing(axis, walls, now).map_err(|missing| {
            let found = format!("`{rule}` needs both walls of the box along {}", axis.name());
            let expected = format!("the wall {missing}, which is not there in this stage");
            table.refuse("until", Problem::rule(found, expected))
        })?;
    }
    let is_servo = |control: &WallControl| matches!(control, WallControl::Motion(WallMotion::Servo(_)));
    let follows = now.cell.targets().next().is_some();
    if until.pressure_tolerance.is_some() && !follows && !now.controls.iter().any(is_servo) {
        let problem = Problem::rule(
            "`pressure_tolerance` and no wall under a pressure",
            "a wall with control = \"servo\", or no `pressure_tolerance`",
        );
        return Err(table.refuse("until", problem));
    }
    reaches_strain(table, &until, walls, now)?;
    Ok(until)
}

impl Now<'_> {
    /// Whether space repeats along an axis.
    fn repeats(&self, axis: Axis) -> bool {
        self.domain.is_some_and(|domain| domain.periodic[axis.index()])
    }
}

/// Reads `[stages.cell]`, which finds the walls as this stage leaves them.
fn read_cell_now(
    table: &mut TableReader<'_>,
    walls: &[Wall],
    now: &mut Now<'_>,
) -> Result<Option<(CellMotion, Location)>, Reported> {
    let present = walls.iter().zip(&now.controls).find(|(_, control)| **control != WallControl::Removed);
    let present = present.map(|(wall, _)| wall.name.as_str());
    let place = table.location("cell");
    let cell = read_cell(table, now.domain, present)?;
    now.cell = cell.unwrap_or(now.cell);
    Ok(cell.map(|motion| (motion, place)))
}

/// Refuses a rule that looks at the length or the stress of a cell along an axis, where that stays as it is.
fn check_cell_rule(table: &TableReader<'_>, rule: &str, axis: Axis, now: &Now<'_>) -> Result<(), Reported> {
    let moves = if rule == "strain" { now.cell.deforms(axis.index()) } else { now.cell.moves() };
    if moves {
        return Ok(());
    }
    let name = axis.name();
    let found = format!("`{rule}` along {name}, where space repeats and does not deform");
    Err(table
        .refuse("until", Problem::rule(found, format!("{name}{name} in [stages.cell], or another rule"))))
}

/// Refuses a shear strain that nothing leads to, or that its rate leads away from.
fn check_shear_rule(table: &TableReader<'_>, until: &StopRules, now: &Now<'_>) -> Result<(), Reported> {
    let Some(rule) = until.shear_strain else { return Ok(()) };
    let name = UpperTriangular::NAMES[rule.component];
    let found = match now.cell.components[rule.component] {
        CellControl::Stress(_) => return Ok(()),
        CellControl::Rate(rate) if rate * rule.value > 0.0 => return Ok(()),
        CellControl::Rate(rate) => {
            format!("the shear strain {name} never reaches {}: its rate is {rate} 1/s", rule.value)
        }
        CellControl::Fixed => format!("`shear_strain` looks at {name}, which does not deform"),
    };
    let expected = format!("a rate of {name} in [stages.cell] that leads there, or another rule");
    Err(table.refuse("until", Problem::rule(found, expected)))
}

/// The motions of the two box walls of an axis, or the name of one that is not there.
fn facing(axis: Axis, walls: &[Wall], now: &Now<'_>) -> Result<[WallMotion; 2], &'static str> {
    let motion = |side| {
        let face = BoxFace { axis, side };
        let found = walls.iter().zip(&now.controls).find(|(wall, _)| wall.face == Some(face));
        match found {
            Some((_, WallControl::Removed)) | None => Err(face.name()),
            Some((_, WallControl::Motion(motion))) => Ok(*motion),
        }
    };
    Ok([motion(Side::Low)?, motion(Side::High)?])
}

/// Refuses a strain that nothing but the walls' own motion could reach, and that this motion never does.
fn reaches_strain(
    table: &TableReader<'_>,
    until: &StopRules,
    walls: &[Wall],
    now: &Now<'_>,
) -> Result<(), Reported> {
    let only = StopRules { strain: until.strain, ..StopRules::default() };
    let Some(rule) = until.strain.filter(|_| *until == only) else { return Ok(()) };
    if now.repeats(rule.axis) {
        return match now.cell.components[rule.axis.index()] {
            CellControl::Rate(rate) if rate * rule.value <= 0.0 => {
                let name = rule.axis.name();
                let found = format!(
                    "the strain never reaches {}: along {name} the cell deforms at {rate} 1/s",
                    rule.value
                );
                let expected = "a rate of the sign of the strain, or another rule";
                Err(table.refuse("until", Problem::rule(found, expected)))
            }
            _ => Ok(()),
        };
    }
    let Ok([low, high]) = facing(rule.axis, walls, now) else { return Ok(()) };
    let rate = |motion: WallMotion| motion.law().constant_velocity().map(|v| v[rule.axis.index()]);
    if let (Some(low), Some(high)) = (rate(low), rate(high))
        && (high - low) * rule.value <= 0.0
    {
        let found = format!(
            "the strain never reaches {}: along {} the box grows by {} m/s",
            rule.value,
            rule.axis.name(),
            high - low
        );
        return Err(
            table.refuse("until", Problem::rule(found, "walls that move towards it, or another rule"))
        );
    }
    Ok(())
}
