//! Why a run went wrong: what stopped it, the rows before, the deepest contacts and the forces on the particles concerned.

mod cause;
mod report;
mod views;

use std::fmt;
use std::path::{Path, PathBuf};

use pulvis_core::{ParticleId, Simulation};

pub(super) use cause::likely_cause;
pub(super) use report::{ALARM, AlarmReport};
use views::{deepest_contacts, fastest, forces_on};

use super::checkpoint::{Found, find, scenario_from_text};
use super::error::PrepareError;
use super::folder::RECORD;
use super::start::resumed;
use super::under_way::TIME_SERIES;

/// Rows of the time series that are shown.
const ROWS: usize = 5;

/// Contacts that are shown.
const CONTACTS: usize = 5;

/// The columns of the rows that are shown, where the time series has them.
const COLUMNS: [&str; 9] = [
    "step",
    "time",
    "stage",
    "kinetic",
    "elastic",
    "relative_error",
    "contacts",
    "wall_contacts",
    "overlap_max",
];

/// What can be said of a run from the files in its folder, part by part.
#[derive(Clone, Debug)]
pub struct Explanation {
    /// Headings and texts.
    pub parts: Vec<(String, String)>,
}

impl fmt::Display for Explanation {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, (heading, text)) in self.parts.iter().enumerate() {
            let gap = if number == 0 { "" } else { "\n" };
            write!(out, "{gap}{heading}\n\n{}\n", text.trim_end())?;
        }
        Ok(())
    }
}

/// Explains a run from the files in its folder. Nothing is changed.
///
/// # Errors
/// There is no run, or its checkpoint cannot be used.
pub fn explain(folder: &Path) -> Result<Explanation, PrepareError> {
    let record = folder.join(RECORD);
    if !record.is_file() {
        return Err(PrepareError::NothingToExplain { folder: folder.to_owned() });
    }
    let alarm = AlarmReport::read(&folder.join(ALARM));
    let mut parts = Vec::new();
    match &alarm {
        Some(alarm) => parts.push(("What stopped the run".to_owned(), alarm.text.clone())),
        None => {
            let text = "no alarm has stopped this run".to_owned();
            parts.push(("What stopped the run".to_owned(), text));
        }
    }
    if let Some(rows) = last_rows(&folder.join(TIME_SERIES), alarm.as_ref().map(|alarm| alarm.step)) {
        let before = if alarm.is_some() { " before it" } else { "" };
        parts.push((format!("The last rows of the time series{before}"), rows));
    }
    if let Some(found) = find(folder)? {
        let concerned = alarm.map(|alarm| alarm.particles);
        parts.extend(parts_of_state(found, concerned)?);
    }
    Ok(Explanation { parts })
}

/// The message of the alarm that has stopped the run in a folder, if one has.
pub(super) fn alarm_message(folder: &Path) -> Option<String> {
    let alarm = AlarmReport::read(&folder.join(ALARM))?;
    alarm.text.split("\n\n").next().map(str::to_owned)
}

/// The state of a checkpoint: the deepest contacts, and forces on particles.
fn parts_of_state(
    found: Found,
    concerned: Option<Vec<ParticleId>>,
) -> Result<Vec<(String, String)>, PrepareError> {
    let file = found.path.clone();
    let name = format!("the scenario in {}", file.display());
    let scenario = scenario_from_text(&name, &found.checkpoint.scenario).map_err(PrepareError::from)?;
    let simulation = resumed(&scenario, found)?.simulation;
    let heading = format!(
        "The last state that was kept: step {}, t = {:.6e} s, in {}",
        simulation.steps(),
        simulation.time(),
        file.display()
    );
    Ok(vec![(heading, view(&simulation, &concerned.unwrap_or_default()))])
}

/// The deepest contacts, and forces on the particles `concerned`; on the fastest one where there are none.
fn view(simulation: &Simulation, concerned: &[ParticleId]) -> String {
    let mut text = format!("the deepest contacts\n{}", deepest_contacts(simulation, CONTACTS));
    let present = |id: &&ParticleId| simulation.particles().ids().contains(id);
    let mut shown: Vec<(ParticleId, &str)> = concerned.iter().filter(present).map(|id| (*id, "")).collect();
    if shown.is_empty() {
        shown.extend(fastest(simulation).map(|(id, _)| (id, ", the fastest one")));
    }
    for (id, which) in shown {
        text += &format!("\nforces on particle {id}{which}\n{}", forces_on(simulation, id));
    }
    text
}

/// The last rows of a time series before a step, as a table.
fn last_rows(series: &PathBuf, before: Option<u64>) -> Option<String> {
    let text = std::fs::read_to_string(series).ok()?;
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next()?.split(',').collect();
    let places: Vec<(usize, &str)> = COLUMNS
        .into_iter()
        .filter_map(|column| Some((names.iter().position(|name| *name == column)?, column)))
        .collect();
    let rows: Vec<Vec<f64>> = lines
        .filter_map(|line| line.split(',').map(|field| field.parse().ok()).collect())
        .filter(|row: &Vec<f64>| row.len() == names.len())
        .filter(|row| before.is_none_or(|step| row[0] < step as f64))
        .collect();
    let mut table = pulvis_io::table::Table::new(places.iter().map(|(_, name)| *name));
    for row in &rows[rows.len().saturating_sub(ROWS)..] {
        // Every row has the columns of the table.
        table.push(places.iter().map(|(place, _)| row[*place].into())).ok()?;
    }
    (!rows.is_empty()).then(|| table.to_text(5))
}
