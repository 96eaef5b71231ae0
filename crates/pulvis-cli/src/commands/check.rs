//! `pulvis check`: a scenario before it runs.

use std::fmt::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use pulvis_contact::theory::CriticalVelocities;
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{ContactForecast, Preflight, preflight};

use super::words::{bytes, duration};
use crate::failure::{Failure, print};

/// Checks a scenario and says what the run will be like, without running it.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scenario file (TOML)
    file: PathBuf,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let scenario = Scenario::load(&arguments.file).map_err(Failure::bad_input)?;
    let forecast = preflight(&scenario).map_err(Failure::bad_input)?;
    print(&describe(&scenario, &forecast))?;
    Ok(ExitCode::SUCCESS)
}

// Writing to a String cannot fail.
fn describe(scenario: &Scenario, forecast: &Preflight) -> String {
    let mut text = String::new();
    let title = scenario.title.as_deref().unwrap_or("untitled");
    let _ = writeln!(text, "{}: {title}: valid", scenario.source.name);
    let [small, large] = forecast.radii;
    let _ =
        writeln!(text, "particles         {} with radii {small:.4e} to {large:.4e} m", forecast.particles);
    let [light, heavy] = forecast.masses;
    let total = forecast.total_mass;
    let _ = writeln!(text, "masses            {light:.4e} to {heavy:.4e} kg, together {total:.4e} kg");
    let _ = writeln!(text, "walls             {}", walls(scenario));
    for contact in &forecast.contacts {
        describe_contact(&mut text, contact);
    }
    for (number, stage) in forecast.stages.iter().enumerate() {
        let limit = if stage.open_ended { "at most " } else { "" };
        let steps =
            stage.steps.map_or("until its rule holds".to_owned(), |steps| format!("{limit}{steps} steps"));
        let shortest = stage
            .shortest
            .as_ref()
            .map_or(String::new(), |(time, between)| format!(", shortest contact {time:.4e} s ({between})"));
        let heading = if number == 0 { "stages" } else { "" };
        let _ = writeln!(
            text,
            "{heading:<17} {}: time step {:.4e} s, {steps}{shortest}",
            stage.name, stage.time_step
        );
    }
    describe_memory(&mut text, forecast);
    let seconds = forecast.seconds_per_step;
    let open = if forecast.stages.iter().any(|stage| stage.steps.is_none()) {
        ", and stages of open end"
    } else {
        ""
    };
    let _ = writeln!(
        text,
        "time              {} for {} steps at {:.0} steps/s on this machine{open}",
        duration(seconds * forecast.steps() as f64),
        forecast.steps(),
        1.0 / seconds
    );
    let _ = writeln!(text, "output            {}", scenario.output.folder.display());
    text
}

fn describe_memory(text: &mut String, forecast: &Preflight) {
    let of_a_particle = |memory: usize| memory as f64 / forecast.particles.max(1) as f64;
    let _ = writeln!(
        text,
        "memory            {} for {} candidate contacts at the start, {:.0} bytes a particle",
        bytes(forecast.memory),
        forecast.candidates,
        of_a_particle(forecast.memory)
    );
    // What starts as a packing has its contacts already.
    if let Some(packed) = forecast.packed_memory.filter(|&packed| packed > forecast.memory) {
        let _ = writeln!(
            text,
            "{:<17} {} with the contacts of a dense packing, 12 neighbours each: {:.0} bytes a particle",
            "",
            bytes(packed),
            of_a_particle(packed)
        );
    }
}

fn walls(scenario: &Scenario) -> String {
    if scenario.walls.is_empty() {
        return "none".to_owned();
    }
    let names: Vec<_> = scenario.walls.iter().map(|wall| wall.name.as_str()).collect();
    names.join(", ")
}

fn describe_contact(text: &mut String, contact: &ContactForecast) {
    let name = format!("contact {}", contact.between);
    let _ = writeln!(text, "{name:<17} law {}, shortest motion {:.4e} s", contact.law, contact.contact_time);
    if let Some(velocity) = contact.plastic_velocity.filter(|velocity| velocity.is_finite()) {
        let _ = writeln!(text, "{:<17} fully plastic above v_p = {velocity:.4e} m/s", "");
    }
    if let Some(velocities) = &contact.sticking {
        let _ = writeln!(text, "{:<17} {}", "", sticking(velocities));
    }
}

fn sticking(velocities: &CriticalVelocities) -> String {
    match (velocities.low_end, velocities.high_onset, velocities.high_end) {
        (_, None, None) => "pairs never stick".to_owned(),
        (_, None, Some(end)) => format!("sticks below {end:.4e} m/s"),
        (Some(low), Some(onset), Some(end)) if low > 0.0 => {
            format!("sticks below {low:.4e} m/s and from {onset:.4e} to {end:.4e} m/s")
        }
        (_, Some(onset), Some(end)) => format!("sticks from {onset:.4e} to {end:.4e} m/s"),
        (_, Some(onset), None) => format!("sticks above {onset:.4e} m/s"),
    }
}
