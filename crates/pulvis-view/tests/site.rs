//! The answers of the page's server: the laboratory is `pulvis collide` and `pulvis probe`, and nothing but the run is served.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use pulvis_input::Document;
use pulvis_input::collision::CollisionScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_io::vtk::{Column, ContactFrame, ParticleFrame, SeriesWriter, WallFrame};
use pulvis_lab::collision::{ObliqueOutcome, SweepPoint, sweep};
use pulvis_lab::probe::probe;
use pulvis_math::elementary;
use pulvis_view::{Access, Question, Site, ViewError, Viewer, export};
use serde_json::Value;
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

const PORT: u16 = 8017;

fn experiment(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../experiments").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn question(method: &str, target: &str, body: &str) -> Question {
    Question {
        method: method.to_owned(),
        target: target.to_owned(),
        host: Some(format!("127.0.0.1:{PORT}")),
        body: body.to_owned(),
        ..Question::default()
    }
}

fn laboratory() -> Site {
    Site::new(Access::Loopback { port: PORT }, None).unwrap()
}

fn json(site: &Site, method: &str, target: &str, body: &str) -> Value {
    let answer = site.answer(&question(method, target, body));
    let text = String::from_utf8(answer.body).unwrap();
    assert_eq!(answer.status, 200, "{target}: {text}");
    serde_json::from_str(&text).unwrap()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Text and back again may cost the last bit.
fn close(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    assert!(!found.is_empty());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() <= 4.0 * f64::EPSILON * expected.abs(), "{found} {expected}");
    }
}

#[test]
fn the_laboratory_draws_the_collisions_of_pulvis_collide() {
    let text = experiment("figures/s1-06/restitution.toml");
    let scenario = CollisionScenario::from_document(&Document::from_str("s1.toml", &text).unwrap()).unwrap();
    let points = sweep(&scenario, false).unwrap();
    let of = |value: fn(&SweepPoint) -> f64| points.iter().map(value).collect::<Vec<f64>>();
    let velocity = points[20].case.velocity;
    let answer = json(&laboratory(), "POST", &format!("/api/collide?velocity={velocity:?}"), &text);
    let contact = &answer["contacts"][0];
    close(&numbers(&contact["velocity"]), &of(|point| point.case.velocity));
    close(&numbers(&contact["restitution"]), &of(|point| point.collision.outcome.restitution));
    close(&numbers(&contact["overlap_max"]), &of(|point| point.collision.outcome.overlap_max));
    // The course is that of the collision of the same velocity.
    let outcome = points[20].collision.outcome;
    // Its steps end at the samples too: errors of the exact method, about 1e-12.
    let drawn = contact["course"]["restitution"].as_f64().unwrap();
    assert!((drawn - outcome.restitution).abs() < 1e-10, "{drawn} {}", outcome.restitution);
    let deepest = numbers(&contact["course"]["overlap"]).into_iter().fold(f64::NEG_INFINITY, f64::max);
    assert!((deepest / outcome.overlap_max - 1.0).abs() < 1e-3, "a sixtieth of the contact time apart");
}

#[test]
fn closed_form_and_limits_of_sticking_are_those_of_the_paper() {
    let text = experiment("figures/s1-06/restitution.toml");
    let quick = json(&laboratory(), "POST", "/api/collide?quick=1&velocity=0.1", &text);
    let contact = &quick["contacts"][0];
    assert!(contact["velocity"].as_array().unwrap().is_empty(), "a quick answer has no collisions");
    let [velocities, restitutions] =
        ["velocity", "restitution"].map(|name| numbers(&contact["theory"][name]));
    // S1 (32) with η = 4, β = 1 in units of v_p0: e² = (2 − 4χ)/(2 + 4χ) below χ = 1/2.
    let scale = contact["typical_speed"].as_f64().unwrap();
    let mut below = 0;
    for (velocity, restitution) in velocities.iter().zip(&restitutions) {
        let chi = velocity / scale;
        if chi < 0.49 {
            let exact = ((2.0 - 4.0 * chi) / (2.0 + 4.0 * chi)).sqrt();
            assert!((restitution - exact).abs() < 1e-12, "χ = {chi}: {restitution} {exact}");
            below += 1;
        }
    }
    assert!(below > 100, "{below} points");
    // S1 (40): pairs stick from χ = 1/2 to 2/√3.
    let sticking = json(&laboratory(), "POST", "/api/sticking", &text);
    let ranges = sticking["contacts"][0]["ranges"].as_array().unwrap();
    assert_eq!(ranges.len(), 1);
    let [low, high] = [0, 1].map(|end| ranges[0][end].as_f64().unwrap() / scale);
    assert!((low - 0.5).abs() < 1e-12 && (high - 2.0 / 3.0_f64.sqrt()).abs() < 1e-12, "{low} {high}");
}

/// The values of the adhesion of a map [N/m], and the file with them as a second variable.
fn map_file(more: &str) -> (&'static str, String) {
    let values = "10,33,100,1000";
    let text = experiment("figures/s1-06/restitution.toml").replace("points = 40", "points = 9");
    let family = format!(
        "[collision.family]\nvariable = \"contact.normal.kc\"\nvalues = [{values}]\n\n[contact.normal]"
    );
    (values, text.replace("[contact.normal]", &family) + more)
}

/// The file without its second variable.
fn without_family(text: &str) -> String {
    let (head, tail) = text.split_once("[collision.family]").unwrap();
    format!("{head}[contact.normal]{}", tail.split_once("[contact.normal]").unwrap().1)
}

#[test]
fn the_sticking_map_holds_the_closed_forms_of_pulvis_collide() {
    let (values, text) = map_file("");
    let scenario = CollisionScenario::from_document(&Document::from_str("map.toml", &text).unwrap()).unwrap();
    let expected: Vec<f64> =
        sweep(&scenario, false).unwrap().iter().map(|point| point.theory.unwrap().restitution).collect();
    // A closed form gives all of the map, however coarse it may be.
    let target = format!("/api/map?parameter=contact.normal.kc&values={values}&stride=4&row_stride=2");
    let map = json(&laboratory(), "POST", &target, &without_family(&text));
    assert_eq!(map["from"], "closed form");
    let found: Vec<f64> = map["restitution"].as_array().unwrap().iter().flat_map(numbers).collect();
    close(&found, &expected);
    assert!(found.contains(&0.0) && found.iter().any(|value| *value > 0.9), "{found:?}");
    // S1 (34) and (37) with η = 4 in units of v_p: no sticking below β* = 1/3, which 33 N/m does not reach.
    let scale = scenario.cases[0].velocity / 0.003;
    let line = |symbol: &str| {
        let lines = map["limits"].as_array().unwrap();
        let line = lines.iter().find(|line| line["symbol"] == symbol).unwrap();
        [numbers(&line["value"]), numbers(&line["velocity"])]
    };
    for (symbol, chi) in [
        ("v_c^(b)", (|beta| (1.0 + beta) / (4.0 * beta)) as fn(f64) -> f64),
        ("v_c^(c)", |beta| (4.0 * (1.0 + beta) / (5.0 + beta)).sqrt()),
    ] {
        let [values, velocities] = line(symbol);
        assert_eq!(values, [100.0, 1000.0]);
        let expected: Vec<f64> = values.iter().map(|kc| scale * chi(kc / 100.0)).collect();
        for (found, expected) in velocities.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-12, "{symbol}: {found} {expected}");
        }
    }
    assert_eq!(line("v_p")[0], [10.0, 33.0, 100.0, 1000.0]);
}

#[test]
fn a_sticking_map_without_closed_form_is_refined_to_the_collisions_of_pulvis_collide() {
    let (values, text) = map_file("[contact.viscosity]\nlaw = \"constant\"\ngamma_0 = \"1e-3 kg/s\"\n");
    let scenario = CollisionScenario::from_document(&Document::from_str("map.toml", &text).unwrap()).unwrap();
    let expected: Vec<f64> =
        sweep(&scenario, false).unwrap().iter().map(|point| point.collision.outcome.restitution).collect();
    let ask = |values: &str, grid: &str| {
        let target = format!("/api/map?parameter=contact.normal.kc&values={values}&{grid}");
        json(&laboratory(), "POST", &target, &without_family(&text))
    };
    let coarse = ask(values, "stride=4&row_stride=2");
    assert_eq!((&coarse["from"], &coarse["limits"]), (&Value::from("collisions"), &serde_json::json!([])));
    let computed = |map: &Value, row: usize| -> Vec<(usize, f64)> {
        let cells = map["restitution"][row].as_array().cloned().unwrap_or_default();
        cells.iter().enumerate().filter_map(|(column, cell)| Some((column, cell.as_f64()?))).collect()
    };
    assert!(computed(&coarse, 1).is_empty() && computed(&coarse, 3).is_empty());
    let fine = ask("10,100", "stride=1&known=4");
    for (place, row) in [0, 2].into_iter().enumerate() {
        let mut both = [computed(&coarse, row), computed(&fine, place)].concat();
        both.sort_by_key(|(column, _)| *column);
        let (columns, found): (Vec<usize>, Vec<f64>) = both.into_iter().unzip();
        assert_eq!(columns, [0, 1, 2, 3, 4, 5, 6, 7, 8], "each collision once");
        close(&found, &expected[9 * row..9 * row + 9]);
    }
}

#[test]
fn values_that_a_law_does_not_take_leave_their_rows_empty() {
    let text = experiment("figures/s1-06/restitution.toml");
    let map = json(&laboratory(), "POST", "/api/map?parameter=contact.normal.kp&values=50,500", &text);
    assert_eq!(map["allowed"], serde_json::json!([false, true]));
    assert!(map["restitution"][0].is_null() && map["restitution"][1].is_array());
    assert!(map["refused"].as_str().unwrap().contains("kp"), "{}", map["refused"]);
    for (target, told) in [
        ("/api/map?values=1", "`parameter` is missing"),
        ("/api/map?parameter=contact.normal.kp", "`values` is missing"),
        ("/api/map?parameter=contact.normal.kp&values=1,a", "list of numbers"),
        ("/api/map?parameter=contact.normal.kp&values=50", "kp"),
        ("/api/map?parameter=contact.normal.x&values=50", "x"),
    ] {
        let answer = laboratory().answer(&question("POST", target, &text));
        let message = String::from_utf8(answer.body).unwrap();
        assert_eq!(answer.status, 422, "{target}");
        assert!(message.contains(told), "{target}: {message}");
    }
}

fn oblique(point: &SweepPoint) -> ObliqueOutcome {
    point.collision.outcome.oblique.unwrap()
}

/// The tangent of an angle [rad].
fn slope(angle: f64) -> f64 {
    elementary::sin(angle) / elementary::cos(angle)
}

#[test]
fn oblique_collisions_are_those_of_pulvis_collide() {
    let text = experiment("chung-ooi/test-4-aluminium-alloy.toml");
    let scenario = CollisionScenario::from_document(&Document::from_str("oo.toml", &text).unwrap()).unwrap();
    let points = sweep(&scenario, false).unwrap();
    let of = |value: fn(&SweepPoint) -> f64| points.iter().map(value).collect::<Vec<f64>>();
    let angle = points[5].case.incidence.unwrap().angle;
    let answer = json(&laboratory(), "POST", &format!("/api/oblique?angle={angle:?}"), &text);
    let contact = &answer["contacts"][0];
    close(&numbers(&contact["angle"]), &of(|point| point.case.value));
    close(&numbers(&contact["restitution"]), &of(|point| point.collision.outcome.restitution));
    close(&numbers(&contact["tangential"]), &of(|point| oblique(point).restitution_tangential.unwrap()));
    close(&numbers(&contact["contact"]), &of(|point| oblique(point).restitution_contact.unwrap()));
    close(&numbers(&contact["impulse_ratio"]), &of(|point| oblique(point).impulse_ratio));
    // What is before and after is in the ratio −β; before, nothing spins: tan θ.
    let [before, after] = ["before", "after"].map(|name| numbers(&contact[name]));
    for (place, point) in points.iter().enumerate() {
        assert!((before[place] / slope(point.case.value) - 1.0).abs() < 1e-12);
        let beta = oblique(point).restitution_contact.unwrap();
        assert!((after[place] + beta * before[place]).abs() < 1e-12 * before[place]);
        // Sliding throughout, v_t′ = v_t − 7/2 μ (1 + e) v_n; the arm of the friction is shorter than the radius by the overlap, so that
        // of the 5/2 that stand for the spin a part of δ/a at most is missing.
        if point.case.value > 0.7 {
            let outcome = &point.collision.outcome;
            let impulse = 0.092 * (1.0 + outcome.restitution);
            let missing = (after[place] - before[place] + 3.5 * impulse) / (2.5 * impulse);
            assert!(missing > 0.0 && missing < outcome.overlap_max / 2.5e-3, "{missing}");
        }
    }
    // The course is that of the collision under the same angle.
    let (course, expected) = (&contact["course"], &points[5].collision.outcome);
    close(
        &numbers(&serde_json::json!([course["restitution"], course["impulse_ratio"]])),
        &[expected.restitution, oblique(&points[5]).impulse_ratio],
    );
    let forces = ["force", "tangential_force"].map(|name| numbers(&course[name]));
    // It slides throughout: T = μ N of the elastic force, to which the dashpot of e = 0.98 adds or takes less than 3 % while a third
    // of the largest force is there.
    let most = forces[0].iter().copied().fold(0.0, f64::max);
    let loaded: Vec<usize> = (0..forces[0].len()).filter(|place| forces[0][*place] > most / 3.0).collect();
    assert!(loaded.len() > 30, "{}", loaded.len());
    for place in loaded {
        let ratio = forces[1][place].abs() / forces[0][place];
        assert!((ratio / 0.092 - 1.0).abs() < 0.03, "{ratio}");
    }
    let quick = json(&laboratory(), "POST", "/api/oblique?quick=1", &text);
    assert_eq!(quick["contacts"][0]["angle"].as_array().unwrap().len(), 3);
    assert!(quick["contacts"][0]["course"].is_null(), "no angle, no course");
}

#[test]
fn files_of_oblique_collisions_are_read_and_not_taken_for_head_on_ones() {
    let site = laboratory();
    let text = experiment("chung-ooi/test-4-aluminium-alloy.toml");
    let state = json(&site, "POST", "/api/state", &text);
    assert_eq!(state["oblique"], serde_json::json!({ "velocity": 3.9, "angle": 35.0, "spins": [0.0, 0.0] }));
    let refused = |target: &str, text: &str| {
        let answer = site.answer(&question("POST", target, text));
        assert_eq!(answer.status, 422, "{target}");
        String::from_utf8(answer.body).unwrap()
    };
    assert!(refused("/api/collide", &text).contains("expected head-on collisions"));
    let head_on = experiment("figures/s1-06/restitution.toml");
    assert!(refused("/api/oblique?angle=0.5", &head_on).contains("expected an angle"));
    let tilted = text.replace(
        "angle = \"45 deg\"",
        "angle = \"45 deg\"\nspin_i = [\"1 rad/s\", \"0 rad/s\", \"0 rad/s\"]",
    );
    assert!(refused("/api/state", &tilted).contains("spins about axes within it"));
}

#[test]
fn the_laboratory_draws_the_path_of_pulvis_probe() {
    let text = experiment("figures/s1-02/branches.toml");
    let scenario = ProbeScenario::from_document(&Document::from_str("s1.toml", &text).unwrap()).unwrap();
    let curves = probe(&scenario).unwrap();
    let answer = json(&laboratory(), "POST", "/api/probe", &text);
    let expected = |value: fn(&pulvis_lab::probe::ProbeSample) -> f64| -> Vec<f64> {
        curves[0].samples.iter().map(value).collect()
    };
    close(&numbers(&answer["curves"][0]["overlap"]), &expected(|sample| sample.overlap));
    close(&numbers(&answer["curves"][0]["force"]), &expected(|sample| sample.force));
    close(&numbers(&answer["curves"][0]["dissipated"]), &expected(|sample| sample.dissipated));
}

#[test]
fn every_preset_is_read_and_every_law_can_be_chosen() {
    let site = laboratory();
    let presets = json(&site, "GET", "/api/presets", "");
    assert!(presets.as_array().unwrap().len() >= 10);
    for preset in presets.as_array().unwrap() {
        let state = json(&site, "POST", "/api/state", preset["text"].as_str().unwrap());
        assert!(state["typical_speed"].as_f64().unwrap() > 0.0, "{}", preset["title"]);
        assert!(state["contacts"][0]["laws"]["normal"]["law"].is_string(), "{}", preset["title"]);
    }
    let laws = json(&site, "GET", "/api/laws", "");
    let mut found = 0;
    for law in laws.as_array().unwrap() {
        let parameters = law["parameters"].as_array().unwrap();
        for parameter in parameters.iter().filter(|parameter| parameter["required"] == true) {
            let value = &law["example"][parameter["name"].as_str().unwrap()];
            assert!(!value.is_null(), "{} has no example of {}", law["name"], parameter["name"]);
        }
        found += 1;
    }
    assert!(found > 40, "{found} laws");
    let start = json(&site, "GET", "/api/start?role=normal&law=jkr", "");
    assert_eq!(start["contacts"][0]["laws"]["normal"]["law"], "jkr");
    assert!(start["probe"]["poses"].as_array().unwrap().len() > 2);
}

#[test]
fn a_mistake_in_a_scenario_is_told_as_the_command_line_tells_it() {
    let text = experiment("figures/s1-06/restitution.toml").replace("k1 = \"100 N/m\"", "k1 = \"100 N\"");
    let answer = laboratory().answer(&question("POST", "/api/collide", &text));
    let message = String::from_utf8(answer.body).unwrap();
    assert_eq!(answer.status, 422);
    assert!(message.contains("k1") && message.contains("scenario.toml"), "{message}");
}

/// A run of two frames with three particles each.
fn run(folder: &Path) {
    let mut series = SeriesWriter::create(folder, "").unwrap();
    for (number, time) in [0.0, 0.5].into_iter().enumerate() {
        let shift = number as f64;
        let positions = [[shift, 0.0, 0.0], [1.0, 2.0, 0.0], [5.0, 0.0, 0.25]];
        let particles = ParticleFrame {
            positions: &positions,
            columns: &[
                Column::integer("id", &[0, 1, 7]),
                Column::scalar("radius", &[0.5; 3]),
                Column::vector("v", &[[3.0, 4.0, 0.0]; 3]),
            ],
        };
        let contacts = ContactFrame {
            ends: &[[positions[0], positions[1]], [positions[2], [5.0, 0.0, 0.0]]],
            columns: &[
                Column::integer("id1", &[0, 7]),
                Column::integer("id2", &[1, -1]),
                Column::scalar("normal_force", &[-2.0, 8.0]),
            ],
        };
        let walls = WallFrame { ends: &[[[0.0; 3], [1.0; 3]]], radii: &[0.0] };
        series.write(time, &particles, &contacts, &walls).unwrap();
    }
    std::fs::write(folder.join("timeseries.csv"), "time,kinetic\n0,1\n0.5,0.25\n").unwrap();
}

#[test]
fn a_run_is_shown_frame_by_frame_and_grows_while_it_is_watched() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path());
    let site = Site::new(Access::Loopback { port: PORT }, Some(folder.path())).unwrap();
    assert_eq!(json(&site, "GET", "/api/run", "")["times"], serde_json::json!([0.0, 0.5]));
    let particle = json(&site, "GET", "/api/particle?number=1&row=2", "");
    assert_eq!(particle["id"], 7);
    assert_eq!(particle["contacts"][0]["wall"], 0);
    let other = json(&site, "GET", "/api/particle?number=1&row=1", "");
    assert_eq!(
        (&other["contacts"][0]["row"], &other["contacts"][0]["wall"]),
        (&Value::from(0), &Value::Null)
    );
    let frame = site.answer(&question("GET", "/api/frame?number=1&column=v", ""));
    assert_eq!((frame.status, &frame.body[..4]), (200, &b"PVP1"[..]));
    for target in
        ["/api/frame?number=2", "/api/frame?number=0&column=w", "/api/particle?number=0&row=3", "/api/frame"]
    {
        assert_eq!(site.answer(&question("GET", target, "")).status, 404, "{target}");
    }
    let series = json(&site, "GET", "/api/series?columns=time,kinetic", "");
    assert_eq!(series["columns"]["kinetic"], serde_json::json!([1.0, 0.25]));
    std::fs::write(folder.path().join("timeseries.csv"), "time,kinetic\n0,1\n0.5,0.25\n1,0.125\n").unwrap();
    assert_eq!(json(&site, "GET", "/api/series?columns=time", "")["rows"], 3);
}

#[test]
fn nothing_but_the_run_is_served() {
    let all = tempfile::tempdir().unwrap();
    let folder = all.path().join("run");
    std::fs::create_dir(&folder).unwrap();
    run(&folder);
    std::fs::write(all.path().join("secret.txt"), "secret").unwrap();
    let site = Site::new(Access::Loopback { port: PORT }, Some(&folder)).unwrap();
    assert_eq!(site.answer(&question("GET", "/run/timeseries.csv", "")).status, 200);
    for target in
        ["/run/../secret.txt", "/run/%2e%2e%2fsecret.txt", "/run//etc/passwd", "/../secret.txt", "/run/"]
    {
        assert_eq!(site.answer(&question("GET", target, "")).status, 404, "{target}");
    }
    assert_eq!(site.answer(&question("DELETE", "/run/timeseries.csv", "")).status, 405);
    // An index that names a file elsewhere leads nowhere.
    let index = folder.join("series.pvd");
    let text = std::fs::read_to_string(&index).unwrap().replace("frame_0000.vtm", "../run/frame_0000.vtm");
    std::fs::write(&index, text).unwrap();
    assert_eq!(site.answer(&question("GET", "/api/frame?number=0", "")).status, 404);
    assert_eq!(site.answer(&question("GET", "/api/frame?number=1", "")).status, 200);
}

#[test]
fn what_is_no_run_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let open = |path: &Path| Site::new(Access::Loopback { port: PORT }, Some(path)).unwrap_err().to_string();
    assert!(open(&folder.path().join("nowhere")).contains("expected the folder of a run"));
    assert!(open(folder.path()).contains("no run is in"));
    let file = folder.path().join("run.toml");
    std::fs::write(&file, "").unwrap();
    assert!(open(&file).contains("is a file"));
    assert!(matches!(export(folder.path(), &folder.path().join("a.html")), Err(ViewError::NoFrames(_))));
}

#[test]
fn an_exported_run_holds_its_frames_and_needs_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path());
    let file = folder.path().join("run.html");
    let written = export(folder.path(), &file).unwrap();
    // What cannot be written is no mistake of the question, and leaves nothing half-written.
    let nowhere = export(folder.path(), &folder.path().join("missing/a.html")).unwrap_err();
    assert!(matches!(nowhere, ViewError::Write(_)) && !nowhere.is_bad_input(), "{nowhere}");
    assert_eq!((written.frames, written.frames_of_run, written.one_of), (2, 2, 1));
    let text = std::fs::read_to_string(&file).unwrap();
    assert_eq!(text.len(), written.bytes);
    let data = text.split("id=\"embedded\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["run"]["times"], serde_json::json!([0.0, 0.5]));
    // 9 coordinates of 32 bits: 36 bytes are 48 letters.
    assert_eq!(data["frames"][1]["positions"].as_str().unwrap().len(), 48);
    assert!(!text.contains("src=\"") && !text.contains("rel=\"stylesheet\""));
}

/// What a browser would send, and what comes back.
fn exchange(port: u16, text: &str) -> String {
    let mut stream = TcpStream::connect((Ipv4Addr::LOCALHOST, port)).unwrap();
    stream.write_all(text.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

#[test]
fn over_a_socket_the_page_is_served_and_pages_from_elsewhere_are_not() {
    let viewer = Viewer::listen(None, IpAddr::V4(Ipv4Addr::LOCALHOST), None).unwrap();
    let port: u16 = viewer.url().trim_end_matches('/').rsplit(':').next().unwrap().parse().unwrap();
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| viewer.serve(&stop));
        let get = |host: &str| {
            exchange(port, &format!("GET / HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"))
        };
        let page = get(&format!("127.0.0.1:{port}"));
        let rebound = get(&format!("pulvis.evil.example:{port}"));
        stop.store(true, Ordering::Relaxed);
        assert!(page.starts_with("HTTP/1.1 200") && page.contains("<title>Pulvis</title>"), "{page}");
        assert!(page.contains("Content-Security-Policy: default-src 'self'"), "{page}");
        assert!(!page.to_lowercase().contains("access-control"), "other pages may not read it");
        assert!(rebound.starts_with("HTTP/1.1 403"), "{rebound}");
    });
}

#[test]
fn a_port_that_is_taken_is_refused_if_asked_for_and_passed_over_if_not() {
    let taken = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = taken.local_addr().unwrap().port();
    let error = Viewer::listen(None, IpAddr::V4(Ipv4Addr::LOCALHOST), Some(port)).unwrap_err();
    assert!(error.is_bad_input());
    assert!(error.to_string().contains("is taken; choose another one with --port"), "{error}");
    let one = Viewer::listen(None, IpAddr::V4(Ipv4Addr::LOCALHOST), None).unwrap();
    let other = Viewer::listen(None, IpAddr::V4(Ipv4Addr::LOCALHOST), None).unwrap();
    assert_ne!(one.url(), other.url());
}
