//! What must fail is refused before the run; what fails in it stops it, with all files complete.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod protocol_scenarios;

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use protocol_scenarios::{Series, options, run_with, scenario, tablet};
use pulvis_core::{Alarm, MotionKind};
use pulvis_input::scenario::{Refusal, Scenario};
use pulvis_lab::protocol::{RunError, prepare, warnings};

/// 64 grains of 1 mm in a box of 8.8 mm, and what its only stage does.
fn box_of_grains(stage: &str) -> Scenario {
    scenario(&format!(
        r#"[materials.grain]
density = "2000 kg/m^3"
[contacts.grain-grain]
normal = {{ law = "luding", k1 = "100 N/m", kp = "500 N/m", kc = "100 N/m", phi_f = 0.05 }}
[[particles]]
material = "grain"
radius = {{ distribution = "fixed", value = "1 mm" }}
arrangement = {{ kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [4, 4, 4], spacing = "2.2 mm" }}
velocity = {{ standard_deviation = "0.1 m/s" }}
[box]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["8.8 mm", "8.8 mm", "8.8 mm"]
material = "grain"
[output]
timeseries = {{ steps = 10 }}
[[stages]]
name = "press"
{stage}
"#
    ))
}

/// The alarm that stops the run of a scenario, whose files must be complete.
fn alarm(scenario: &Scenario, folder: &Path) -> Alarm {
    let mut endings = 0;
    let failed = run_with(scenario, &options(folder), &AtomicBool::new(false), &mut |progress| {
        endings += usize::from(progress.ending.is_some());
    });
    let error = failed.expect_err("the run is done");
    assert!(!error.is_bad_input() && endings == 0);
    let text = error.to_string();
    assert!(text.contains("stage `press`, step ") && text.contains("the files in "), "{text}");
    assert!(Series::read(folder).rows.len() > 1, "there are rows, all whole");
    let index = fs::read_to_string(folder.join("series.pvd")).unwrap();
    assert!(index.trim_end().ends_with("</VTKFile>"), "{index}");
    // At the start, and where it was stopped.
    assert_eq!(index.matches("file=\"").count(), 2, "{index}");
    if scenario.output.plots {
        for picture in ["energies.png", "particles.png"] {
            assert!(fs::read(folder.join(picture)).unwrap().ends_with(b"IEND\xaeB`\x82"), "{picture}");
        }
    }
    match error {
        RunError::Step { source, .. } => source.alarm,
        other => panic!("{other}"),
    }
}

fn refused(scenario: &Scenario) -> String {
    prepare(scenario).expect_err("it is accepted").to_string()
}

#[test]
fn a_grain_pressed_through_a_wall_stops_the_run() {
    // A servo of 100 kPa and 1 g falls fast enough to go through the grains.
    let stage = r#"until = { time = "20 ms" }
walls.z-high = { control = "servo", pressure = "1e5 Pa", mass = "1 g", damping = "0 kg/s" }"#;
    let folder = tempfile::tempdir().unwrap();
    let alarm = alarm(&box_of_grains(stage), folder.path());
    assert!(matches!(alarm, Alarm::BehindWall { .. } | Alarm::Overlap { .. }), "{alarm}");
}

#[test]
fn a_piston_that_no_rule_stops_in_time_stops_the_run() {
    let stage = r#"until = { stress = { axis = "z", value = "1e9 Pa", crosses = "upwards" }, time = "0.1 s" }
walls.z-high = { control = "velocity", velocity = ["0 m/s", "0 m/s", "-1 m/s"] }"#;
    let folder = tempfile::tempdir().unwrap();
    let alarm = alarm(&box_of_grains(stage), folder.path());
    assert!(matches!(alarm, Alarm::BehindWall { .. } | Alarm::Overlap { .. }), "{alarm}");
}

#[test]
fn a_ledger_that_does_not_close_stops_the_run() {
    let tolerance = ("[output]", "[limits]\nenergy_error = 1e-6\n\n[output]");
    let every_tenth_step = ("{ interval = \"1 ns\" }", "{ steps = 10 }");
    let scenario = tablet(&[tolerance, every_tenth_step]);
    let folder = tempfile::tempdir().unwrap();
    let alarm = alarm(&scenario, folder.path());
    let Alarm::EnergyError { error, most } = alarm else { panic!("{alarm}") };
    assert!(most == 1e-6 && error > most, "{error}");
    let record = Scenario::load(folder.path().join("run.toml")).unwrap();
    assert_eq!(record.limits, scenario.limits);
    assert_eq!(tablet(&[]).limits.energy_error, 1e-2);
}

/// The small tablet with servo walls of this mass and damping.
fn servo_tablet(mass: &str, damping: &str, time: &str) -> Scenario {
    let of = |key: &str, value: &str| format!("{key} = \"{value}\"");
    tablet(&[
        ("mass = \"5e-11 kg\"", &of("mass", mass)),
        ("damping = \"0.04 kg/s\"", &of("damping", damping)),
        ("time = { steps_per_contact_time = 50 }", &format!("time = {{ {time} }}")),
    ])
}

#[test]
fn the_automatic_step_resolves_a_light_servo_wall_and_a_given_one_is_refused() {
    let auto = "steps_per_contact_time = 50";
    let prepared = prepare(&servo_tablet("1e-12 kg", "0 kg/s", auto)).unwrap();
    let (press, pull) = (&prepared.stages[0], &prepared.stages[2]);
    let shortest = press.shortest.unwrap();
    assert!(matches!(shortest.kind, MotionKind::WallOnContacts { .. }), "{shortest:?}");
    assert!((press.time_step * 50.0 / shortest.duration - 1.0).abs() < 1e-12);
    // 64 contacts of 5e6 N/m at the most, and at least one.
    let [all, one] =
        [64.0, 1.0].map(|contacts: f64| std::f64::consts::PI * (1e-12 / (contacts * 5e6)).sqrt());
    assert!((all..one).contains(&shortest.duration), "{shortest:?}");
    // Without a servo, contacts set the step.
    assert!(matches!(pull.shortest.unwrap().kind, MotionKind::Contact(_)));
    let text = refused(&servo_tablet("1e-12 kg", "0 kg/s", "step = \"5e-11 s\""));
    assert!(text.contains("the mass of the servo wall x-high on up to "), "{text}");
    assert!(text.contains("a heavier wall"), "{text}");
    // Lighter, it is the damping that counts.
    let lighter = prepare(&servo_tablet("1e-16 kg", "0.04 kg/s", auto)).unwrap();
    let shortest = lighter.stages[0].shortest.unwrap();
    assert!(matches!(shortest.kind, MotionKind::WallDamping { .. }), "{shortest:?}");
    let text = refused(&servo_tablet("1e-16 kg", "0.04 kg/s", "step = \"1e-11 s\""));
    assert!(text.contains("the damping of the servo wall x-high"), "{text}");
}

#[test]
fn the_automatic_step_resolves_the_drag_and_a_given_one_is_refused() {
    let drag = ("drag = \"2e-3 kg/s\"", "drag = \"1 kg/s\"");
    let prepared = prepare(&tablet(&[drag])).unwrap();
    let shortest = prepared.stages[0].shortest.unwrap();
    assert_eq!(shortest.kind, MotionKind::Drag);
    let given = ("time = { steps_per_contact_time = 50 }", "time = { step = \"1e-11 s\" }");
    let text = refused(&tablet(&[drag, given]));
    assert!(text.contains("the drag of the background on the lightest particle"), "{text}");
}

#[test]
fn particles_that_are_too_fast_for_the_time_step_are_refused() {
    let text = include_str!("protocol_scenarios/tablet.toml");
    let fast = text.replace("standard_deviation = \"10 m/s\"", "standard_deviation = \"1e5 m/s\"");
    let message = refused(&scenario(&fast));
    assert!(
        message.contains("particles[0].velocity: particle ") && message.contains("radii in a step"),
        "{message}"
    );
}

/// Refused with the name of what would let it pass, and let pass with that name.
#[test]
fn what_an_expert_may_lift_is_named_by_its_refusal_and_lifted_by_its_name() {
    let press = |pressure: &str| {
        format!(
            "until = {{ time = \"20 ms\" }}\nwalls.z-high = {{ control = \"servo\", pressure = \"{pressure}\", mass = \"1 g\", damping = \"0 kg/s\" }}"
        )
    };
    let drive = |speed: &str, time: &str| {
        format!(
            "until = {{ time = \"{time}\" }}\nwalls.z-high = {{ control = \"velocity\", velocity = [\"0 m/s\", \"0 m/s\", \"{speed}\"] }}"
        )
    };
    let rest = "until = { time = \"1 ms\" }";
    let dashpot = "[contacts.grain-grain.viscosity]\nlaw = \"constant\"\ngamma_0 = \"10 kg/s\"\n";
    let with = |text: &str, addition: &str| {
        scenario(
            &box_of_grains(text).source.text.replace("[[particles]]", &format!("{addition}[[particles]]")),
        )
    };
    let closer = box_of_grains(rest).source.text.replace("2.2 mm", "1.7 mm");
    for (refusal, scenario) in [
        (Refusal::Pressure, box_of_grains(&press("1 GPa"))),
        (Refusal::Speed, box_of_grains(&drive("-1e3 m/s", "1 us"))),
        (Refusal::CrossingWalls, box_of_grains(&drive("-1 m/s", "20 ms"))),
        (Refusal::TimeStep, with(rest, "[time]\nstep = \"40 us\"\n")),
        (Refusal::Overdamped, with(rest, dashpot)),
        (Refusal::Overlap, scenario(&closer)),
    ] {
        let message = refused(&scenario);
        let advice = format!("; who knows better lets it pass with `--allow {}`", refusal.name());
        assert!(message.contains(&advice), "{message}");
        let mut allowed = scenario.clone();
        allowed.allow(&Refusal::ALL.into_iter().filter(|other| *other != refusal).collect::<Vec<_>>());
        assert!(refused(&allowed).contains(&advice), "no other name lifts it");
        allowed.allow = vec![refusal];
        let prepared = prepare(&allowed).unwrap_or_else(|error| panic!("{error}"));
        let told = warnings(&allowed, &prepared);
        let expected = format!("allowed by `{}`: {}", refusal.name(), refusal.meaning());
        assert!(told.contains(&expected), "{told:?}");
        let again = Scenario::from_str("run.toml", &allowed.to_resolved_toml("1")).unwrap();
        assert_eq!(again.allow, [refusal]);
    }
}

#[test]
fn an_alarm_names_the_first_deep_contact_and_the_step_that_was_too_long_for_it() {
    // A sixth of the shortest contact, which is that of the steepest branch.
    let text = box_of_grains("until = { time = \"20 ms\" }").source.text;
    let text = text.replace("[[particles]]", "[time]\nstep = \"48 us\"\n[[particles]]");
    let mut scenario = scenario(&text.replace("\"0.1 m/s\"", "\"4 m/s\""));
    scenario.allow(&[Refusal::TimeStep, Refusal::Speed]);
    let folder = tempfile::tempdir().unwrap();
    let error = run_with(&scenario, &options(folder.path()), &AtomicBool::new(false), &mut |_| {});
    let text = error.expect_err("the run is done").to_string();
    assert!(text.contains("\n  likely cause: the first contact beyond 30 % overlap was "), "{text}");
    assert!(
        text.contains("; its time step was 1/6 of its contact time: the time step is too long"),
        "{text}"
    );
}

#[test]
fn a_particle_beyond_the_speed_and_a_contact_beyond_the_overlap_of_the_scenario_stop_the_run() {
    let limited = |limit: &str| {
        let stage = "until = { time = \"5 ms\" }\nwalls.z-high = { control = \"velocity\", velocity = [\"0 m/s\", \"0 m/s\", \"-1 m/s\"] }";
        let text = box_of_grains(stage).source.text;
        scenario(&text.replace("[output]", &format!("[limits]\n{limit}\n[output]")))
    };
    let folder = tempfile::tempdir().unwrap();
    let found = alarm(&limited("speed = \"0.9 m/s\""), &folder.path().join("speed"));
    assert!(matches!(found, Alarm::BeyondSpeed { most: 0.9, .. }), "{found}");
    let found = alarm(&limited("overlap = 0.005"), &folder.path().join("overlap"));
    assert!(
        matches!(found, Alarm::Overlap { most: 0.005, .. } | Alarm::BehindWall { most: 0.005, .. }),
        "{found}"
    );
}

#[test]
fn a_drum_whose_surface_goes_round_too_fast_is_refused() {
    let text = include_str!("../../../experiments/drum/short.toml");
    let fast = text.replace("angular_velocity = \"4 rad/s\"", "angular_velocity = \"-4e5 rad/s\"");
    let message = refused(&scenario(&fast));
    let found =
        "stages[1].walls.drum.angular_velocity: the surface of the wall drum goes round at 5.6000e3 m/s, ";
    assert!(message.contains(found), "{message}");
}

#[test]
fn walls_that_are_driven_through_each_other_are_refused() {
    for motion in [
        r#"{ control = "velocity", velocity = ["0 m/s", "0 m/s", "-1 m/s"] }"#,
        r#"{ control = "cosine", displacement = ["0 mm", "0 mm", "-9 mm"], period = "40 ms" }"#,
    ] {
        let stage = format!("until = {{ time = \"20 ms\" }}\nwalls.z-high = {motion}");
        let message = refused(&box_of_grains(&stage));
        assert!(message.contains("the walls z-low and z-high meet within "), "{message}");
    }
    // Slower, the same wall stays above the floor.
    let slow = r#"until = { time = "8 ms" }
walls.z-high = { control = "velocity", velocity = ["0 m/s", "0 m/s", "-1 m/s"] }"#;
    prepare(&box_of_grains(slow)).unwrap();
}

#[test]
fn a_motion_that_goes_on_into_the_next_stage_is_followed() {
    let stages = r#"until = { time = "6 ms" }
walls.z-high = { control = "velocity", velocity = ["0 m/s", "0 m/s", "-1 m/s"] }
[[stages]]
name = "on"
until = { time = "6 ms" }"#;
    let message = refused(&box_of_grains(stages));
    assert!(message.contains("stages[1].until: the walls z-low and z-high meet within 2."), "{message}");
}

#[test]
fn a_wall_that_is_too_fast_for_the_time_step_is_refused() {
    let stage = r#"until = { time = "1 us" }
walls.z-high = { control = "velocity", velocity = ["0 m/s", "0 m/s", "-1e3 m/s"] }"#;
    let message = refused(&box_of_grains(stage));
    assert!(
        message.contains("stages[0].walls.z-high.velocity: the wall z-high moves at 1.0000e3 m/s"),
        "{message}"
    );
}

#[test]
fn a_pressure_that_no_contact_can_carry_is_refused() {
    let stage = r#"until = { time = "20 ms" }
walls.z-high = { control = "servo", pressure = "1 GPa", mass = "1 mg", damping = "0 kg/s" }"#;
    let message = refused(&box_of_grains(stage));
    // π a² p/k = 6.28 m with the steepest slope of 500 N/m.
    assert!(
        message.contains("stages[0].walls.z-high.pressure: 1e9 Pa press the particles 6.2832e0 m deep"),
        "{message}"
    );
    assert!(message.contains("expected at most 1.5915e5 Pa"), "{message}");
}
