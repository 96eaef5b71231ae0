//! `pulvis check`: a scenario before it runs.

use std::fmt::Write;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use pulvis_contact::catalogue::Role;
use pulvis_contact::theory::CriticalVelocities;
use pulvis_input::NamedLaw;
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{
    ContactForecast, Preflight, StageForecast, Sticking, load_scenario, memory_forecast, preflight,
    size_in_words,
};

use super::allow::Allowed;
use super::regime::describe_regimes;
use super::set::Settings;
use super::words::duration;
use crate::failure::{Failure, print};

/// With more particles, a check takes seconds: the memory is told at once.
const MANY: usize = 1_000_000;

/// Checks scenarios and says what their runs will be like, without running them.
#[derive(Debug, Args)]
pub struct Arguments {
    /// Scenario files (TOML)
    #[arg(required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    set: Settings,
    #[command(flatten)]
    allowed: Allowed,
}

pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let mut refused = Vec::new();
    for (number, file) in arguments.files.iter().enumerate() {
        match check(file, arguments) {
            Ok(text) if number == 0 => print(&text)?,
            Ok(text) => print(&format!("\n{text}"))?,
            Err(failure) => refused.push(failure),
        }
    }
    // All files are looked at before any is to blame.
    let Some(last) = refused.pop() else { return Ok(ExitCode::SUCCESS) };
    for failure in &refused {
        failure.report();
    }
    Err(last)
}

fn check(file: &Path, arguments: &Arguments) -> Result<String, Failure> {
    let mut scenario = load_scenario(file, &arguments.set.pairs).map_err(Failure::bad_input)?;
    arguments.allowed.apply(&mut scenario);
    tell_memory_of_many(&scenario);
    let forecast = preflight(&scenario).map_err(Failure::bad_input)?;
    Ok(describe(&scenario, &forecast))
}

/// Tells what very many particles need before they are made, which takes its time.
fn tell_memory_of_many(scenario: &Scenario) {
    let count = scenario.particle_count();
    let Some(memory) = Some(count).filter(|&count| count > MANY).and_then(|_| memory_forecast(scenario))
    else {
        return;
    };
    let available = memory
        .available
        .map_or(String::new(), |available| format!("; {} are available", size_in_words(available)));
    // Nobody is left to be told if the standard error stream is closed.
    let _ = writeln!(
        std::io::stderr(),
        "{count} particles need about {} at the start and {} in a dense packing{available}",
        size_in_words(memory.start),
        size_in_words(memory.packed)
    );
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
        let heading = if number == 0 { "stages" } else { "" };
        let _ = writeln!(text, "{heading:<17} {}", describe_stage(stage));
    }
    describe_regimes(&mut text, &forecast.regimes);
    describe_memory(&mut text, scenario, forecast);
    let _ = writeln!(text, "time              {}", describe_time(forecast));
    describe_output(&mut text, scenario, forecast);
    for warning in &forecast.warnings {
        let _ = writeln!(text, "warning           {warning}");
    }
    text
}

fn describe_stage(stage: &StageForecast) -> String {
    let limit = if stage.open_ended { "at most " } else { "" };
    let steps =
        stage.steps.map_or("until its rule holds".to_owned(), |steps| format!("{limit}{steps} steps"));
    let shortest = stage
        .shortest
        .as_ref()
        .map_or(String::new(), |(time, between)| format!(", shortest motion {time:.4e} s ({between})"));
    format!("{}: time step {:.4e} s, {steps}{shortest}", stage.name, stage.time_step)
}

fn describe_time(forecast: &Preflight) -> String {
    let [least, most] = forecast.seconds();
    let rate = |steps: u64, seconds: f64| {
        let rate = if steps > 0 { steps as f64 / seconds } else { 0.0 };
        format!("{rate:.0} steps/s on this machine")
    };
    let (least_steps, steps) = (forecast.least_steps(), forecast.steps());
    if !forecast.is_open_ended() {
        return format!("about {} for {steps} steps at {}", duration(most), rate(steps, most));
    }
    let unlimited = forecast.stages.iter().filter(|stage| stage.steps.is_none());
    let unlimited: Vec<String> = unlimited
        .map(|stage| {
            let per_step = stage.seconds_per_step + stage.row_seconds_per_step;
            format!("{} has no limit, {}", stage.name, rate(1, per_step))
        })
        .collect();
    let known = format!(
        "{} to {} for {least_steps} to {steps} steps, as the rules of the stages end them",
        duration(least),
        duration(most)
    );
    match (unlimited.is_empty(), steps) {
        (true, _) => format!("{known}, at {}", rate(steps, most)),
        (false, 0) => unlimited.join("; "),
        (false, _) => format!("{known}; {}", unlimited.join("; ")),
    }
}

fn describe_output(text: &mut String, scenario: &Scenario, forecast: &Preflight) {
    let disk = &forecast.disk;
    let _ = writeln!(text, "output            {}", scenario.output.folder.display());
    let limit = if forecast.is_open_ended() { "up to " } else { "about " };
    let open = if forecast.stages.iter().any(|stage| stage.steps.is_none()) {
        ", and more in stages without a limit"
    } else {
        ""
    };
    let files = match &scenario.output.files[..] {
        [] => String::new(),
        _ => format!(", further files {}", size_in_words(disk.files as u64)),
    };
    let free = disk.free.map_or(String::new(), |free| format!("; {} are free", size_in_words(free)));
    let _ = writeln!(
        text,
        "{:<17} {limit}{}: time series {}, {:.0} frames of {}{files}, checkpoints {}{open}{free}",
        "",
        size_in_words(disk.total() as u64),
        size_in_words(disk.timeseries as u64),
        disk.frames,
        size_in_words(disk.frame as u64),
        size_in_words(disk.checkpoints as u64)
    );
}

fn describe_memory(text: &mut String, scenario: &Scenario, forecast: &Preflight) {
    let of_a_particle = |memory: u64| memory as f64 / forecast.particles.max(1) as f64;
    let start = forecast.memory;
    let _ = writeln!(
        text,
        "memory            {} for {} candidate contacts at the start{}, {:.0} bytes a particle",
        size_in_words(start),
        forecast.candidates,
        if scenario.output.checkpoints.is_some() { " and two states for checkpoints" } else { "" },
        of_a_particle(start)
    );
    // What starts as a packing has its contacts already.
    if let Some(packed) = forecast.packed_memory.filter(|&packed| packed > start) {
        let available = forecast
            .available_memory
            .map_or(String::new(), |available| format!("; {} are available", size_in_words(available)));
        let _ = writeln!(
            text,
            "{:<17} {} with the contacts of a dense packing, 12 neighbours each: {:.0} bytes a particle{available}",
            "",
            size_in_words(packed),
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
    let _ = writeln!(text, "{name:<17} shortest motion {:.4e} s", contact.contact_time);
    let is_said =
        |law: &&NamedLaw| law.name != "none" && !matches!(law.role, Role::Conventions | Role::Expected);
    for law in contact.laws.iter().filter(is_said) {
        let _ = writeln!(text, "{:<17} {} {law}", "", law.role.key());
    }
    let is_damped = !matches!(contact.sticking, Sticking::ClosedForm(_));
    if let Some(velocity) = contact.plastic_velocity.filter(|velocity| velocity.is_finite()) {
        let without = if is_damped { ", dashpot left out" } else { "" };
        let _ = writeln!(text, "{:<17} fully plastic above v_p = {velocity:.4e} m/s{without}", "");
    }
    let _ = match &contact.sticking {
        Sticking::ClosedForm(velocities) => writeln!(text, "{:<17} {}", "", sticking(velocities)),
        Sticking::Computed(ranges) => {
            writeln!(text, "{:<17} {}, head on, by collisions", "", computed_sticking(ranges))
        }
        Sticking::Varied(quantity) => {
            writeln!(text, "{:<17} whether pairs stick depends on their {quantity}, which differs", "")
        }
        Sticking::Unknown => Ok(()),
    };
}

fn computed_sticking(ranges: &[[f64; 2]]) -> String {
    if ranges.is_empty() {
        return "pairs never stick".to_owned();
    }
    let range = |&[low, high]: &[f64; 2]| match (low > 0.0, high.is_finite()) {
        (true, true) => format!("from {low:.4e} to {high:.4e} m/s"),
        (false, true) => format!("below {high:.4e} m/s"),
        (true, false) => format!("above {low:.4e} m/s"),
        (false, false) => "at all speeds".to_owned(),
    };
    format!("sticks {}", ranges.iter().map(range).collect::<Vec<_>>().join(" and "))
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
