//! Stages of the resolved scenario: what each of them changes.

use super::writer::{Writer, key, quantity, text};
use super::{gravity, key_of_law, law_keys, write_time};
use crate::scenario::cell::write_cell;
use crate::scenario::controls::write_control;
use crate::scenario::groups::write_group_control;
use crate::scenario::programs::write_programs;
use crate::scenario::region::write_region;
use crate::scenario::until::write_until;
use crate::scenario::{Background, Contact, Scenario, Stage, TimeStep};
use pulvis_math::Dimension;

/// What held before a stage.
struct Before<'s> {
    contacts: &'s [Contact],
    background: Background,
    time: TimeStep,
}

impl Scenario {
    pub(super) fn write_stages(&self, writer: &mut Writer) {
        let mut before = Before { contacts: &self.contacts, background: self.background, time: self.time };
        let openings: Vec<&str> = self.openings().collect();
        for stage in &self.stages {
            writer.item("stages");
            writer.key("name", text(&stage.name));
            if stage.form_bonds {
                writer.key("form_bonds", true.to_string());
            }
            if let Some(programs) = &stage.programs {
                writer.key("program_updates", programs.updates().to_string());
            }
            writer.table("stages.until");
            write_until(writer, &stage.until, &openings);
            if let Some(region) = &stage.remove {
                writer.table("stages.remove");
                write_region(writer, region);
            }
            for (index, control) in &stage.controls {
                let name = self.walls.get(*index).map_or("", |wall| wall.name.as_str());
                writer.table(&format!("stages.walls.{}", key(name)));
                write_control(writer, control);
            }
            for (index, control) in &stage.groups {
                let name = self.groups.get(*index).map_or("", |group| group.name.as_str());
                writer.table(&format!("stages.groups.{}", key(name)));
                write_group_control(writer, control);
            }
            if let Some(motion) = &stage.cell {
                writer.table("stages.cell");
                write_cell(writer, motion);
            }
            let switches = self.switches(stage, &before);
            if !switches.is_empty() {
                writer.table("stages.set");
            }
            for (path, value) in switches {
                writer.key(&text(&path), value);
            }
            if let Some(programs) = &stage.programs {
                write_programs(writer, programs);
            }
            if stage.time != before.time {
                writer.table("stages.time");
                write_time(writer, stage.time);
            }
            before = Before {
                contacts: stage.last_contacts(),
                background: stage.last_background(),
                time: stage.time,
            };
        }
    }

    /// Paths and values of everything that a stage switches. Laws are set as whole tables.
    fn switches(&self, stage: &Stage, before: &Before<'_>) -> Vec<(String, String)> {
        let mut switches = Vec::new();
        if stage.background.gravity != before.background.gravity {
            switches.push(("gravity".to_owned(), gravity(stage.background.gravity)));
        }
        let drags = |background: &Background| [background.drag, background.rotational_drag];
        let names = ["background.drag", "background.rotational_drag"];
        for ((name, new), old) in names.iter().zip(drags(&stage.background)).zip(drags(&before.background)) {
            if new != old {
                switches.push(((*name).to_owned(), quantity(new, Dimension::DASHPOT)));
            }
        }
        for (contact, old) in stage.contacts.iter().zip(before.contacts) {
            for (law, _) in contact.laws.iter().zip(&old.laws).filter(|(new, old)| new != old) {
                let keys = law_keys(law).into_iter().map(|(name, value)| format!("{name} = {value}"));
                let table = format!("{{ {} }}", keys.collect::<Vec<_>>().join(", "));
                switches.push((key_of_law(contact, law, &self.materials), table));
            }
        }
        switches
    }
}
