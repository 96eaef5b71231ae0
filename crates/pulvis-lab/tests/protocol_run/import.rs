//! Particles out of a checkpoint of another run.

use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use pulvis_input::Document;
use pulvis_input::scenario::Scenario;
use pulvis_lab::protocol::{PrepareError, prepare, read_scenario, resume, scenario_from_text};
use pulvis_math::Vector3;

use super::files::{last_table, numbers};
use super::protocol_scenarios::{options, run, run_with, scenario};
use super::resume::files;

/// Grains of two materials and two charges that meet.
const BEFORE: &str = r#"
[materials.soft]
density = "2000 kg/m^3"
[materials.hard]
density = "3000 kg/m^3"
[contacts.soft-soft]
normal = { law = "linear", k = "100 N/m" }
sliding = { law = "spring-slider", kt = "20 N/m", mu = 0.5 }
[contacts.soft-hard]
normal = { law = "linear", k = "150 N/m" }
sliding = { law = "spring-slider", kt = "20 N/m", mu = 0.5 }
[contacts.hard-hard]
normal = { law = "linear", k = "300 N/m" }

[[particles]]
material = "soft"
radius = { distribution = "uniform", minimum = "0.8 mm", maximum = "1 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [2, 2, 2], spacing = "2.2 mm" }
velocity = { standard_deviation = "0.5 m/s" }
columns = { charge = "1 pC" }

[[particles]]
material = "hard"
radius = { distribution = "fixed", value = "1 mm" }
arrangement = { kind = "lattice", lower = ["0 mm", "0 mm", "4.4 mm"], counts = [2, 2, 1], spacing = "2.2 mm" }
velocity = { mean = ["0 m/s", "0 m/s", "-1 m/s"] }
columns = { charge = "-2 pC" }

[[stages]]
name = "meet"
until = { time = "2 ms" }

[output]
plots = false
vtk = false
checkpoints = { stage_ends = true }
[[output.files]]
format = "csv"
name = "a"
"#;

/// A scenario of what stands at a path; the two materials stand in another order.
fn after(path: &Path, further: &str) -> String {
    format!(
        "[materials.hard]\ndensity = \"3000 kg/m^3\"\n[materials.soft]\ndensity = \"2000 kg/m^3\"\n\
         [contacts.soft-soft.normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n[contacts.soft-hard.normal]\nlaw = \"linear\"\nk = \"150 N/m\"\n\
         [contacts.hard-hard.normal]\nlaw = \"linear\"\nk = \"300 N/m\"\n\
         [[particles]]\n[particles.arrangement]\nkind = \"file\"\npath = {path:?}\n{further}\n\
         [[stages]]\nname = \"on\"\nuntil = {{ time = \"2 ms\" }}\n[output]\nplots = false\nvtk = false\n"
    )
}

const WITH_MATERIALS: &str = "materials = true\n[particles.columns]\ncharge = \"0 pC\"";

fn read(text: &str) -> Result<Scenario, PrepareError> {
    read_scenario(Document::from_str("after.toml", text)?, None, &[])
}

fn refusal(text: &str) -> String {
    read(text).map(drop).unwrap_err().to_string()
}

#[test]
fn the_particles_of_a_checkpoint_are_a_start_with_all_that_they_are() {
    let folder = tempfile::tempdir().unwrap();
    run(&scenario(BEFORE), folder.path());
    let last = last_table(folder.path(), "a");
    for (path, further) in [
        (folder.path().join("checkpoint.pulvis"), ""),
        (folder.path().join("checkpoint.stage-1.pulvis"), ""),
        (folder.path().to_owned(), "format = \"checkpoint\"\n"),
    ] {
        let text = after(&path, &format!("{further}{WITH_MATERIALS}"));
        let start = read(&text).unwrap_or_else(|errors| panic!("{errors}"));
        // The record of a run reads the same particles.
        let again = scenario_from_text("run.toml", &start.to_resolved_toml("test")).unwrap();
        assert_eq!(start.particles, again.particles);
        let prepared = prepare(&start).unwrap();
        assert_eq!(prepared.particles.len(), 12);
        type Value = fn(&pulvis_core::Particle) -> Vector3;
        let vectors: [([&str; 3], Value); 3] = [
            (["x", "y", "z"], |particle| particle.position),
            (["vx", "vy", "vz"], |particle| particle.velocity),
            (["omegax", "omegay", "omegaz"], |particle| particle.angular_velocity),
        ];
        for (names, value) in vectors {
            for (axis, name) in names.into_iter().enumerate() {
                let found: Vec<f64> =
                    prepared.particles.iter().map(|particle| value(particle)[axis]).collect();
                assert_eq!(found, numbers(&last, name), "{name}");
            }
        }
        assert!(prepared.particles.iter().any(|particle| particle.angular_velocity.norm() > 0.0));
        let radii: Vec<f64> = prepared.particles.iter().map(|particle| particle.radius).collect();
        assert_eq!(radii, numbers(&last, "radius"));
        // By their names: the numbers are others here.
        let names: Vec<&str> = prepared
            .particles
            .iter()
            .map(|particle| start.materials[usize::from(particle.material)].name.as_str())
            .collect();
        assert_eq!(names, last["material"]);
        let particles = prepared.simulation.particles();
        let charges = &particles.column("charge").unwrap().values;
        let charges: Vec<f64> = particles.rows_by_id().iter().map(|&row| charges[row]).collect();
        assert_eq!(charges, [[1e-12; 8].as_slice(), &[-2e-12; 4]].concat());
    }
}

#[test]
fn a_run_of_particles_of_a_checkpoint_is_resumed_to_the_same_files() {
    let before = tempfile::tempdir().unwrap();
    run(&scenario(BEFORE), before.path());
    let start = read(&after(&before.path().join("checkpoint.pulvis"), WITH_MATERIALS)).unwrap();
    let [whole, stopped] = [(); 2].map(|()| tempfile::tempdir().unwrap());
    run(&start, whole.path());
    let summary = run_with(&start, &options(stopped.path()), &AtomicBool::new(true), &mut |_| {}).unwrap();
    assert!(summary.interrupted());
    resume(stopped.path(), &options(stopped.path()), &AtomicBool::new(false), &mut |_| {}).unwrap();
    assert!(files(stopped.path()) == files(whole.path()));
}

#[test]
fn what_is_no_checkpoint_or_does_not_fit_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    run(&scenario(BEFORE), folder.path());
    let at = |name: &str| folder.path().join(name);
    let sound = fs::read(at("checkpoint.pulvis")).unwrap();
    fs::write(at("cut.pulvis"), &sound[..sound.len() / 2]).unwrap();
    fs::write(at("text.pulvis"), "x,y,z\n0,0,0\n").unwrap();
    fs::create_dir(at("empty")).unwrap();
    let place = "particles[0].arrangement.path: ";
    for (path, words) in [
        ("none.pulvis", "none.pulvis cannot be read: No such file"),
        ("cut.pulvis", "cut.pulvis is damaged or cut off: its checksum is another one"),
        ("text.pulvis", "text.pulvis is no checkpoint of Pulvis; "),
    ] {
        let text = refusal(&after(&at(path), WITH_MATERIALS));
        assert!(text.contains(place) && text.contains(words), "{text}");
        assert!(
            text.contains("checkpoint.pulvis (step ") && text.contains("is whole, name it instead"),
            "{text}"
        );
        assert!(
            text.contains("expected a checkpoint of a run, or the folder of a run that has one"),
            "{text}"
        );
    }
    let empty = format!("format = \"checkpoint\"\n{WITH_MATERIALS}");
    let text = refusal(&after(&at("empty"), &empty));
    assert!(text.contains(place) && text.contains("there is no checkpoint in "), "{text}");
    let sound = at("checkpoint.pulvis");
    let other = "materials = { soft = \"soft\" }\n[particles.columns]\ncharge = \"0 pC\"";
    let text = refusal(&after(&sound, other));
    assert!(
        text.contains("the material of particle 8 is \"hard\"; expected one of soft, as the key"),
        "{text}"
    );
    let text = refusal(&after(&sound, "materials = true\n[particles.columns]\ncharge = \"1 mm\""));
    assert!(text.contains("particles[0].columns: `charge` is in C in the file, and in m here"), "{text}");
    let text = refusal(&after(&sound, "materials = true\nframe = 2"));
    assert!(
        text.contains("a file of the format \"checkpoint\" holds one instant; expected no `frame`"),
        "{text}"
    );
    // Whoever reads scenarios without the engine.
    let text = Scenario::from_str("after.toml", &after(&sound, WITH_MATERIALS)).unwrap_err().to_string();
    assert!(text.contains("checkpoints are for runs and their checks"), "{text}");
}
