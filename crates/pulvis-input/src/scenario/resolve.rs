//! What holds in every stage: the document is read once more for each that switches something.

use super::contacts::{Contact, MaterialUse};
use super::groups::GroupControl;
use super::programs::{PlannedPrograms, ProgramState, Programs};
use super::stages::{PlannedStage, Stage};
use super::switches::{Switch, switched};
use super::walk::{Changing, Given};
use super::{Inlet, Scenario};
use crate::context::Location;
use crate::document::Document;
use crate::error::InputErrors;
use crate::problem::Problem;
use pulvis_boundary::{CellControl, CellMotion};
use pulvis_contact::bond::Form;
use pulvis_math::Vector3;

/// The stages with everything that holds in them.
pub(super) fn resolve(
    document: &Document,
    scenario: &Scenario,
    used: &MaterialUse,
    planned: Vec<PlannedStage>,
) -> Result<Vec<Stage>, InputErrors> {
    let document = document.clone();
    let mut resolution = Resolution {
        document,
        scenario,
        used,
        cell: Cell::default(),
        prescribed: vec![false; scenario.groups.len()],
    };
    let mut stages: Vec<Stage> = Vec::with_capacity(planned.len());
    for stage in planned {
        let stage = resolution.stage(stage, stages.last())?;
        stages.push(stage);
    }
    Ok(stages)
}

/// Stages one after the other.
struct Resolution<'a> {
    /// The file with everything that stages have switched so far.
    document: Document,
    scenario: &'a Scenario,
    used: &'a MaterialUse,
    cell: Cell,
    /// The groups whose motion is prescribed now.
    prescribed: Vec<bool>,
}

/// What stages have done to the cell so far.
#[derive(Default)]
struct Cell {
    deforms: bool,
    /// Whether it may be sheared.
    is_sheared: bool,
}

impl Cell {
    fn enter(&mut self, motion: Option<&CellMotion>) {
        let Some(motion) = motion else { return };
        self.deforms = motion.moves();
        let [_, _, _, shears @ ..] = &motion.components;
        self.is_sheared |= shears.iter().any(|control| *control != CellControl::Fixed);
    }
}

impl Resolution<'_> {
    fn stage(&mut self, planned: PlannedStage, before: Option<&Stage>) -> Result<Stage, InputErrors> {
        let PlannedStage {
            name,
            until,
            remove,
            form_bonds,
            controls,
            groups,
            cell,
            switches,
            programs,
            time,
            place: stage_place,
        } = planned;
        let changing = self.switched(&name, &switches, before)?;
        let (Changing { contacts, background }, programs) = self.with_programs(&name, changing, programs)?;
        if let Some(place) = &form_bonds {
            self.check_bonds(&contacts, place)?;
        }
        self.cell.enter(cell.as_ref().map(|(motion, _)| motion));
        let place = cell.as_ref().map_or(&stage_place, |(_, place)| place);
        if self.cell.deforms && background.gravity != Vector3::zero() {
            let found = "the cell deforms under gravity, but without a bottom it has no height";
            let problem = Problem::rule(found, "no gravity in this stage");
            return Err(self.document.error_at(place, problem).into());
        }
        self.check_groups(&groups, place)?;
        if let Some(inlet) = self.scenario.inlets.iter().find(|inlet| inlet.schedule.takes_in(&name)) {
            self.check_inlet(inlet, place)?;
        }
        let (form_bonds, cell) = (form_bonds.is_some(), cell.map(|(motion, _)| motion));
        Ok(Stage {
            name,
            until,
            remove,
            form_bonds,
            controls,
            groups,
            cell,
            contacts,
            background,
            time,
            programs,
        })
    }

    /// Takes note of the groups that a stage holds or leads, which no cell can deform around.
    fn check_groups(
        &mut self,
        groups: &[(usize, GroupControl)],
        place: &Location,
    ) -> Result<(), InputErrors> {
        for (index, control) in groups {
            self.prescribed[*index] = control.motion.is_prescribed();
        }
        let held = self.prescribed.iter().position(|prescribed| *prescribed && self.cell.deforms);
        let Some(held) = held else { return Ok(()) };
        let name = &self.scenario.groups[held].name;
        let found = format!("the cell deforms, but the motion of the group {name} is prescribed");
        let expected =
            format!("[stages.groups.{name}] with control = \"free\", or a cell that does not deform");
        Err(self.document.error_at(place, Problem::rule(found, expected)).into())
    }

    /// What holds after the switches of a stage.
    fn switched(
        &mut self,
        name: &str,
        switches: &[Switch],
        before: Option<&Stage>,
    ) -> Result<Changing, InputErrors> {
        if switches.is_empty() {
            let scenario = self.scenario;
            return Ok(Changing {
                contacts: before.map_or(&scenario.contacts[..], |stage| stage.last_contacts()).to_vec(),
                background: before.map_or(scenario.background, |stage| stage.last_background()),
            });
        }
        self.document = switched(&self.document, switches)?;
        self.read_changing(&format!("this is what [stages.set] of stage \"{name}\" leads to"))
    }

    /// What holds at the start of a stage with programs, and all that they will come to.
    fn with_programs(
        &mut self,
        name: &str,
        changing: Changing,
        programs: Option<PlannedPrograms>,
    ) -> Result<(Changing, Option<Programs>), InputErrors> {
        let Some(programs) = programs else { return Ok((changing, None)) };
        let help = format!("this is what [stages.programs] of stage \"{name}\" leads to");
        let mut states = Vec::new();
        for settings in std::iter::once(programs.starts.clone()).chain(programs.settings()) {
            self.document = switched(&self.document, &settings)?;
            let Changing { contacts, background } = self.read_changing(&help)?;
            states.push(ProgramState { contacts, background });
        }
        let ProgramState { contacts, background } = states[0].clone();
        Ok((Changing { contacts, background }, Some(Programs { keys: programs.keys, states })))
    }

    /// What stages can switch, as it stands in the document, whose rest has been checked in the first walk.
    fn read_changing(&self, help: &str) -> Result<Changing, InputErrors> {
        let scenario = self.scenario;
        let groups = scenario.particles.iter().map(|group| ("particles", &group.columns[..]));
        let inlets = scenario.inlets.iter().map(|inlet| ("inlets", &inlet.columns[..]));
        let columns: Vec<_> = groups.chain(inlets).collect();
        let given = Given {
            columns: &columns,
            temperature: scenario.temperature.as_ref(),
            has_electrostatics: scenario.electrostatics.is_some(),
        };
        let read = self.document.read(|mut root| {
            let changing = Changing::read(&mut root, &scenario.materials, Some(self.used), Some(given));
            for key in root.keys() {
                root.value(key);
            }
            root.finish();
            changing
        });
        read.map_err(|errors| errors.with_help(help))
    }

    fn check_bonds(&self, contacts: &[Contact], place: &Location) -> Result<(), InputErrors> {
        let forms = |contact: &Contact| {
            contact.model.laws.bond.is_some_and(|bond| bond.formation.form == Form::StageStart)
        };
        if contacts.iter().any(forms) {
            return Ok(());
        }
        let found = "no contact has a bond that forms at the start of a stage";
        let expected = "a table [contacts.A-B.bond] with `form = \"stage-start\"`";
        Err(self.document.error_at(place, Problem::rule(found, expected)).into())
    }

    /// Refuses an inlet that is open while the cell deforms, or after it was sheared.
    fn check_inlet(&self, inlet: &Inlet, place: &Location) -> Result<(), InputErrors> {
        let name = &inlet.name;
        let (found, expected) = if self.cell.deforms {
            let found = format!("the cell deforms while the inlet {name} is open");
            (found, "`stages` in [[inlets]] that name stages in which the cell keeps its shape")
        } else if self.cell.is_sheared {
            let found = format!("the inlet {name} is open in a cell that was sheared");
            (found, "`stages` in [[inlets]] that name stages before the shear")
        } else {
            return Ok(());
        };
        Err(self.document.error_at(place, Problem::rule(found, expected)).into())
    }
}
