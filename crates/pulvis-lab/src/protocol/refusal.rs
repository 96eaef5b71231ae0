//! What the engine refuses, as a mistake of the scenario.

use pulvis_core::{MaterialIndex, SetupError};
use pulvis_input::Problem;
use pulvis_input::scenario::Scenario;

use super::error::PrepareError;

/// The refusal of the engine at the key that has caused it.
pub(super) fn refuse_setup(scenario: &Scenario, error: &SetupError) -> PrepareError {
    match error {
        SetupError::TimeStep(step) => refuse_time_step(scenario, *step),
        SetupError::ShortPeriod { axis, period, least } => {
            let axis = ["x", "y", "z"][*axis];
            let found =
                format!("the period along {axis} is {period} m; particles would meet two images of others");
            let expected =
                format!("{least} m or more, twice the distance within which neighbours are sought");
            let help = "enlarge the domain, or take smaller particles";
            refused(scenario, &["domain.upper"], found, expected, help)
        }
        SetupError::TooMany { found, most } => {
            let paths = ["particles[0].count", "particles[0].arrangement"];
            let found = format!("there are {found} particles");
            refused(scenario, &paths, found, format!("{most} or fewer"), "take fewer particles")
        }
        SetupError::WallShape { name, reason } => {
            let paths = [format!("walls.{name}.radius"), format!("walls.{name}")];
            let help = "enlarge the cylinder, or take smaller particles";
            refused(
                scenario,
                &paths.each_ref().map(String::as_str),
                reason,
                "a wall that particles can meet",
                help,
            )
        }
        SetupError::BondWithMesh { name } => {
            let path = format!("walls.{name}");
            let found = "the contacts with a mesh may be bonded";
            let expected = "no bond with a mesh: it could not pass on from one part of the mesh to the next";
            refused(scenario, &[&path], found, expected, "take another material for the mesh")
        }
        SetupError::NoModel { one, other } => {
            let name = |index: MaterialIndex| scenario.materials[usize::from(index)].name.as_str();
            let (one, other) = (name(*one), name(*other));
            let found = format!("{one} and {other} can meet and have no contact");
            let help = format!("add [contacts.{one}-{other}.normal]");
            refused(scenario, &["contacts"], found, "a contact for every pair that can meet", &help)
        }
        other => {
            let help = "this should have been found in the file; please report it";
            refused(scenario, &[], other.to_string(), "a system that can be computed", help)
        }
    }
}

fn refuse_time_step(scenario: &Scenario, step: f64) -> PrepareError {
    if step > 0.0 {
        let found = "nothing can meet, so that no contact sets the time step";
        let help = "set it in a table [time], for example step = \"1 us\"";
        return refused(scenario, &["time.step", "time"], found, "a time step", help);
    }
    let paths = ["time.step", "particles[0].radius"];
    let found = format!("the shortest contact has the time step {step} s");
    let help = "are radii, densities and stiffnesses given in the units that were meant?";
    refused(scenario, &paths, found, "a time step greater than zero", help)
}

fn refused(
    scenario: &Scenario,
    paths: &[&str],
    found: impl Into<String>,
    expected: impl Into<String>,
    help: &str,
) -> PrepareError {
    // Every scenario has a stage, so that there always is a line to show.
    let paths: Vec<&str> = paths.iter().copied().chain(["stages[0]"]).collect();
    scenario.mistake(&paths, Problem::rule(found, expected), help).into()
}
