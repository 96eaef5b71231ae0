//! A run that is watched from another shell: its status, its log lines, its curves.

use std::fs;

use crate::place::*;

/// A run that goes on until it is stopped.
const LONG: [(&str, &str); 2] = [("\"1 ms\"", "\"10000 s\""), ("steps = 10", "steps = 1000")];

fn field<'t>(json: &'t str, key: &str) -> &'t str {
    let (_, rest) = json.split_once(&format!("\"{key}\": ")).unwrap_or_else(|| panic!("no {key} in {json}"));
    rest.split(['\n']).next().unwrap().trim_end_matches(',')
}

#[test]
#[cfg(unix)]
fn the_status_of_a_run_tells_whether_it_lives_how_far_it_is_and_how_it_ended() {
    let place = Place::new("status", &LONG);
    let none = place.pulvis(&["status", "."]);
    assert_eq!(none.status.code(), Some(2));
    assert_eq!(error(&none), "error: . holds no run of Pulvis; name the output folder of a run\n");
    let mut run = Ended(place.command(&["run", "s.toml", "--output", "out", "--quiet"]).spawn().unwrap());
    wait_for_rows(&place.0.join("out/timeseries.csv"));
    // The first sign of life with numbers comes after a fifth of a second.
    let told = || out(&place.pulvis(&["status", "out", "--json"]));
    let began = std::time::Instant::now();
    while told().contains("\"progress\": null") {
        assert!(began.elapsed().as_secs() < 60, "no progress after a minute");
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    let json = told();
    assert_eq!(field(&json, "state"), "\"running\"");
    assert_eq!(field(&json, "process"), run.0.id().to_string());
    assert_eq!((field(&json, "stage"), field(&json, "particles")), ("\"mix\"", "27"));
    let number = |key: &str| field(&json, key).parse::<f64>().unwrap();
    assert!(number("step") > 0.0 && number("steps_per_second") > 0.0 && number("fraction") < 0.1, "{json}");
    let rate = number("particle_steps_per_second") / number("steps_per_second");
    assert!((rate - 27.0).abs() < 1e-9, "{rate}");
    let text = out(&place.pulvis(&["status", "out"]));
    let first = format!("out: running (process {})\nstage         [1/1] mix, ", run.0.id());
    assert!(text.starts_with(&first), "{text}");
    assert!(text.contains("\nestimate      ") && text.contains(" particle-steps/s\n"), "{text}");
    // Whoever asks does not stop the run, and a second run is still refused.
    assert_eq!(place.pulvis(&["run", "s.toml", "--output", "out", "--force"]).status.code(), Some(2));
    run.0.kill().unwrap();
    run.0.wait().unwrap();
    assert_eq!(field(&told(), "state"), "\"killed\"");
    let text = out(&place.pulvis(&["status", "out"]));
    assert!(text.starts_with("out: killed: its process has ended without a word\n"), "{text}");
    assert!(!text.contains("estimate") && text.ends_with("go on with `pulvis run --resume out`\n"), "{text}");
}

#[test]
fn a_run_that_has_ended_says_so_and_several_are_told_as_a_list() {
    let place = Place::new("status_ended", &[]);
    for folder in ["one", "two"] {
        assert_eq!(place.pulvis(&["run", "s.toml", "--output", folder, "-q"]).status.code(), Some(0));
    }
    let text = out(&place.pulvis(&["status", "one"]));
    assert!(
        text.starts_with("one: complete\nstage         [1/1] mix, time over\ntime          1.00"),
        "{text}"
    );
    let list = out(&place.pulvis(&["status", "--json", "one", "two"]));
    assert!(
        list.starts_with("[\n{\n  \"folder\": \"one\",") && list.contains("\"folder\": \"two\""),
        "{list}"
    );
    // A folder of a version that wrote no sign of life: its checkpoint and its alarm tell.
    fs::remove_file(place.0.join("one/status.json")).unwrap();
    assert!(out(&place.pulvis(&["status", "one"])).starts_with("one: complete\n"));
}

#[test]
fn progress_is_told_in_json_for_programs_and_not_at_all_if_so_asked() {
    let place = Place::new("progress", &[]);
    let told = place.pulvis(&["run", "s.toml", "--output", "a", "--progress", "json"]);
    let lines: Vec<String> = error(&told).lines().map(str::to_owned).collect();
    let last = lines.last().unwrap();
    assert!(
        last.starts_with("{\"stage\":\"mix\",\"number\":1,\"stages\":1,\"time\":")
            && last.ends_with("\"ending\":\"time over\"}"),
        "{last}"
    );
    for (folder, arguments) in [("b", &["--quiet"][..]), ("c", &["--progress", "none"])] {
        let run = place.pulvis(&[&["run", "s.toml", "--output", folder], arguments].concat());
        assert_eq!((run.status.code(), error(&run).as_str()), (Some(0), ""));
    }
    let both = place.pulvis(&["run", "s.toml", "--progress", "json", "--quiet"]);
    assert_eq!(both.status.code(), Some(2));
}

#[test]
fn curves_of_a_run_are_drawn_in_the_terminal_or_into_a_picture() {
    let place = Place::new("plot", &[]);
    assert_eq!(place.pulvis(&["run", "s.toml", "--output", "out", "-q"]).status.code(), Some(0));
    let text = out(&place.pulvis(&["plot", "out", "kinetic", "elastic", "overlap_max"]));
    // Energies share a chart, the overlap has one of its own; without a terminal there are letters and no colours.
    assert!(
        text.contains("a kinetic   b elastic\n") && text.contains("J]\n") && !text.contains('\x1b'),
        "{text}"
    );
    assert!(text.contains("overlap_max [µm]\n") && text.matches("time [").count() == 2, "{text}");
    let ratio = out(&place.pulvis(&["plot", "out", "elastic / kinetic", "--stage", "mix", "--x", "step"]));
    assert!(ratio.starts_with("elastic / kinetic") && ratio.contains("step"), "{ratio}");
    let list = out(&place.pulvis(&["plot", "out", "--list"]));
    assert!(list.contains("kinetic                    J      kinetic energy\n"), "{list}");
    // Half a line at the end is that of a run that goes on.
    let series = place.0.join("out/timeseries.csv");
    fs::write(&series, place.read("out/timeseries.csv") + "12,3.").unwrap();
    let picture = place.pulvis(&["plot", "out", "--output", "e.svg"]);
    assert_eq!((picture.status.code(), out(&picture)), (Some(0), "e.svg\n".to_owned()));
    assert!(place.read("e.svg").contains("dissipated"));
    let refused = |arguments: &[&str]| {
        let run = place.pulvis(arguments);
        assert_eq!(run.status.code(), Some(2));
        error(&run)
    };
    let unknown = refused(&["plot", "out", "kinetics"]);
    assert!(
        unknown.starts_with("error: out/timeseries.csv: found \"kinetics\"; ")
            && unknown.contains("\"kinetic\""),
        "{unknown}"
    );
    assert!(refused(&["plot", "out", "kinetic +"]).contains("`kinetic +` "));
    assert!(
        refused(&["plot", "out", "--stage", "3"])
            .contains("there is no stage 3; expected a number from 1 to 1, or one of: mix")
    );
    assert!(refused(&["plot", "none"]).contains("none holds no run of Pulvis"));
    assert!(refused(&["plot", "out", "--output", "e.svg"]).contains("--force"));
}

#[test]
fn shells_manuals_and_editors_get_what_the_command_line_knows() {
    let place = Place::new("shells", &[]);
    for (shell, part) in
        [("bash", "complete -F _pulvis"), ("zsh", "#compdef pulvis"), ("fish", "complete -c pulvis")]
    {
        let script = out(&place.pulvis(&["completions", shell]));
        assert!(script.contains(part) && script.contains("resume"), "{shell}");
    }
    let page = out(&place.pulvis(&["man", "run"]));
    assert!(page.contains(".TH pulvis-run 1") && page.contains("\\-\\-resume"), "{page}");
    assert!(out(&place.pulvis(&["man"])).contains(".TH pulvis 1"));
    assert_eq!(place.pulvis(&["man", "walk"]).status.code(), Some(2));
    assert_eq!(place.pulvis(&["man", "--directory", "."]).status.code(), Some(0));
    assert!(place.read("pulvis-study.1").starts_with(".ie"));
    for kind in ["scenario", "collision", "probe", "study"] {
        let schema = out(&place.pulvis(&["schema", kind]));
        assert!(
            schema.starts_with("{\n") && schema.contains("http://json-schema.org/draft-07/schema#"),
            "{kind}"
        );
    }
}

#[test]
fn fields_on_a_grid_have_the_mass_and_the_virial_of_the_run() {
    let closer = LATTICE.replace("2.2 mm", "1.95 mm");
    let place = Place::new("analyze", &[(LATTICE, &closer), ("\"1 ms\"", "\"0.2 ms\"")]);
    assert_eq!(place.pulvis(&["run", "s.toml", "--output", "out", "-q"]).status.code(), Some(0));
    let done = place.pulvis(&["analyze", "out", "--profile", "z", "--kernel", "gaussian", "--width", "1 mm"]);
    assert_eq!(done.status.code(), Some(0), "{}", error(&done));
    assert!(out(&done).starts_with("gaussian kernel of width 1.0000e-3 m on "), "{}", out(&done));
    let columns = |file: &str| -> Vec<(String, Vec<f64>)> {
        let text = place.read(file);
        let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let names = lines.next().unwrap();
        let rows: Vec<Vec<f64>> =
            lines.map(|row| row.iter().map(|cell| cell.parse().unwrap()).collect()).collect();
        let column =
            |(place, name): (usize, &&str)| ((*name).to_owned(), rows.iter().map(|row| row[place]).collect());
        names.iter().enumerate().map(column).collect()
    };
    let find = |columns: &[(String, Vec<f64>)], name: &str| -> Vec<f64> {
        columns.iter().find(|(known, _)| known == name).unwrap_or_else(|| panic!("no {name}")).1.clone()
    };
    let fields = columns("out/analysis/fields_0001.csv");
    let volume: f64 = ["x", "y", "z"]
        .map(|axis| {
            let mut places = find(&fields, axis);
            places.sort_by(f64::total_cmp);
            places.dedup();
            (places.last().unwrap() - places[0]) / (places.len() - 1) as f64
        })
        .iter()
        .product();
    let total = |columns: &[(String, Vec<f64>)], name: &str| find(columns, name).iter().sum::<f64>() * volume;
    let mass = 27.0 * 2000.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    assert!((total(&fields, "density") / mass - 1.0).abs() < 1e-12);
    // The engine sums the stress in its contact loops.
    let series = columns("out/timeseries.csv");
    let last = |name: &str| *find(&series, name).last().unwrap();
    let virial = last("stress_zz") * last("length_x") * last("length_y") * last("length_z");
    assert!(last("contacts") > 5.0 && virial != 0.0);
    // Contacts act with predicted velocities there, and with those of the state here; this law has no dashpot.
    assert!((total(&fields, "contact_stress_zz") / virial - 1.0).abs() < 1e-6, "{virial}");
    let profile = columns("out/analysis/profile_z_0001.csv");
    let across = find(&fields, "x").len() as f64 / find(&profile, "z").len() as f64;
    assert!((total(&profile, "density") * across / mass - 1.0).abs() < 1e-12);
    let again = place.pulvis(&["analyze", "out"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(error(&again).starts_with("error: out/analysis is not empty; "), "{}", error(&again));
    // The results do not hinder a run that replaces the one they are of.
    assert_eq!(place.pulvis(&["run", "s.toml", "--output", "out", "--force", "-q"]).status.code(), Some(0));
    assert!(place.0.join("out/analysis/fields_0001.vti").exists());
}
