//! Formats of files that this program may have been built without, and the units that their columns are in.

use pulvis_input::Problem;
use pulvis_input::scenario::Scenario;
use pulvis_io::frames;

use super::error::PrepareError;
use super::fields::{CONTACTS, of_particles};
use super::frame::{Selection, memory_units};

/// Refuses files in a format that this program was built without.
pub(super) fn refuse_missing_formats(scenario: &Scenario) -> Result<(), PrepareError> {
    for (index, files) in scenario.output.files.iter().enumerate() {
        let name = files.format.name();
        let known = frames::FORMATS.iter().find(|format| format.name == name);
        if let Some(advice) = known.and_then(|format| format.missing) {
            let found = format!("this program was built without the format {name:?}");
            let problem = Problem::rule(found, "a program that has it, or another format");
            let path = format!("output.files[{index}].format");
            return Err(scenario.mistake(&[&path, "output.files"], problem, advice).into());
        }
    }
    Ok(())
}

/// Names of columns and their units.
type Units = Vec<(String, String)>;

/// The units of all columns that files hold of particles and of contacts.
pub(super) fn units(scenario: &Scenario, selection: &Selection<'_>) -> [Units; 2] {
    let of_particles = of_particles(scenario, selection).into_iter().map(|(name, _, unit)| (name, unit));
    let known = CONTACTS.iter().map(|(name, _, unit)| ((*name).to_owned(), (*unit).to_owned()));
    let of_contacts = known.filter(|(name, _)| name != "memory").chain(memory_units(scenario));
    // What another run has handed down has a unit that nobody knows any more.
    [of_particles.filter(|(_, unit)| unit != "SI").collect(), of_contacts.collect()]
}
