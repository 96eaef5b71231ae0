//! Alarms at the command line: what is told, what is kept, and what an expert may lift.

use crate::place::*;

/// A servo that goes through the grains, with checkpoints on the way.
const CRUSH: [(&str, &str); 2] = [
    (
        r#"until = { time = "1 ms" }"#,
        r#"until = { time = "20 ms" }
walls.z-high = { control = "servo", pressure = "1e5 Pa", mass = "1 g", damping = "0 kg/s" }"#,
    ),
    ("timeseries = { steps = 10 }", "timeseries = { steps = 10 }\ncheckpoints = { steps = 20 }"),
];

#[test]
fn an_alarm_ends_with_its_likely_cause_and_a_checkpoint_and_explain_shows_what_was() {
    let place = Place::new("explain", &CRUSH);
    let run = place.pulvis(&["run", "s.toml", "--output", "out"]);
    assert_eq!(run.status.code(), Some(1), "{}", error(&run));
    let text = error(&run);
    let lines: Vec<&str> = text.lines().collect();
    let first = lines.iter().position(|line| line.starts_with("error: stage `mix`, step ")).unwrap();
    assert!(lines[first].contains("overlap by "), "{text}");
    let cause = "  likely cause: the first contact beyond 30 % overlap was ";
    assert!(
        lines[first + 1].starts_with(cause) && lines[first + 1].contains(" of its contact time: "),
        "{text}"
    );
    let end = lines[first + 2];
    assert!(
        end.starts_with("  the run has stopped; the files in out are complete up to there; its last checkpoint is of step ")
            && end.ends_with("; `pulvis explain out` tells more"),
        "{text}"
    );
    let explained = place.pulvis(&["explain", "out"]);
    assert_eq!(explained.status.code(), Some(0), "{}", error(&explained));
    let told = out(&explained);
    // The message of the run stands first.
    assert!(
        told.starts_with(&format!("What stopped the run\n\n{}\n", &lines[first]["error: ".len()..])),
        "{told}"
    );
    for part in [
        "\nThe last rows of the time series before it\n\nstep  ",
        "\nThe last state that was kept: step ",
        "\nthe deepest contacts\nfirst        second       overlap/radius",
        "\nforces on particle ",
        "\ngravity  ",
    ] {
        assert!(told.contains(part), "no `{part}` in\n{told}");
    }
    // The run goes on from its checkpoint to the same alarm.
    let before = place.read("out/alarm.txt");
    let again = place.pulvis(&["run", "--resume", "out"]);
    assert_eq!(again.status.code(), Some(1));
    assert!(error(&again).contains(lines[first]), "{}", error(&again));
    assert_eq!(step_of(&before), step_of(&place.read("out/alarm.txt")));
}

fn step_of(report: &str) -> &str {
    report.lines().find(|line| line.starts_with("step = ")).unwrap()
}

#[test]
fn explain_tells_of_runs_without_alarm_and_refuses_what_is_no_run() {
    let place = Place::new("explain_sound", &[]);
    assert_eq!(place.pulvis(&["run", "s.toml", "--output", "out"]).status.code(), Some(0));
    let told = out(&place.pulvis(&["explain", "out"]));
    assert!(told.starts_with("What stopped the run\n\nno alarm has stopped this run\n"), "{told}");
    assert!(told.contains("\nforces on particle ") && told.contains(", the fastest one\n"), "{told}");
    let refused = place.pulvis(&["explain", "s.toml"]);
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(error(&refused), "error: s.toml holds no run of Pulvis; name the output folder of a run\n");
}

#[test]
fn a_name_of_no_refusal_is_refused_with_the_list_and_one_of_the_list_is_recorded() {
    let closer = LATTICE.replace("2.2 mm", "1.7 mm");
    let place = Place::new("allow", &[(LATTICE, &closer)]);
    let unknown = place.pulvis(&["run", "s.toml", "--allow", "overlaps"]);
    assert_eq!(unknown.status.code(), Some(2));
    let names = "time-step, overdamped, overlap, speed, pressure, crossing-walls, memory, disk";
    assert!(error(&unknown).contains(names), "{}", error(&unknown));
    let refused = place.pulvis(&["run", "s.toml", "--output", "out"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(error(&refused).contains("lets it pass with `--allow overlap`"), "{}", error(&refused));
    let arguments = ["run", "s.toml", "--output", "out", "--allow", "overlap", "--quiet"];
    let allowed = place.pulvis(&arguments);
    assert_eq!(allowed.status.code(), Some(0), "{}", error(&allowed));
    assert!(error(&allowed).starts_with("warning: allowed by `overlap`: "), "{}", error(&allowed));
    assert!(place.read("out/run.toml").contains("\nallow = [\"overlap\"]\n"));
    // What is recorded can be run again.
    assert_eq!(place.pulvis(&["check", "out/run.toml"]).status.code(), Some(0));
}
