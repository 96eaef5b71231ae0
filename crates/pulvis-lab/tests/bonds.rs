//! Bonds in collisions, probes and runs.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod protocol_scenarios;

use protocol_scenarios::{Series, run, scenario};
use pulvis_input::Document;
use pulvis_input::collision::CollisionScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_lab::collision::{Observation, Outcome, Regime, Sampling, collide};
use pulvis_lab::probe::{ProbeSample, probe};

/// A sphere with the mass 1e-6 kg that meets a wall, with the bond of contact-laws 10.5 and these keys.
fn collided(speed: &str, method: &str, bond: &str) -> Outcome {
    let text = format!(
        "[collision]\nbodies = \"wall\"\nradius = \"1 mm\"\nmass = \"1e-6 kg\"\nvelocity = \"{speed} m/s\"\n{method}\n\
         [contact.normal]\nlaw = \"linear\"\nk = \"2 kN/m\"\n\
         [contact.bond]\nlaw = \"elastic-brittle\"\nform = \"first-touch\"\nnormal_stiffness = \"1 kN/m\"\n\
         tensile_strength = \"1 mN\"\n{bond}\n"
    );
    let document = Document::from_str("bond.toml", &text).unwrap();
    let scenario = CollisionScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
    let observation = Observation { sampling: Sampling::None, ..Observation::default() };
    collide(&scenario.cases[0], &observation).unwrap().outcome
}

#[test]
fn bonded_spheres_part_with_what_breaking_leaves_them() {
    for contact in ["", "contact_spring = \"off\""] {
        let exact = collided("0.05", "", contact);
        assert_eq!(exact.regime, Regime::Rebound, "{contact}");
        assert!((exact.restitution - 0.7745966692414834).abs() < 1e-10, "{contact}: {exact:?}");
        assert!(exact.energy_error.abs() < 1e-12, "{exact:?}");
        // F_t²/(2 k_n).
        assert!((exact.energy_dissipated / 5e-10 - 1.0).abs() < 1e-10, "{exact:?}");
        let slow = collided("0.0316", "", contact);
        assert_eq!((slow.regime, slow.stop_branch), (Regime::Stick, Some("bonded")), "{contact}");
        assert_eq!(collided("0.0317", "", contact).regime, Regime::Rebound, "{contact}");
        // At the engine's fifty steps in a contact time, a hundred in a period of the bond.
        let engine = collided("0.05", "method = \"engine\"", contact);
        assert!((engine.restitution / exact.restitution - 1.0).abs() < 1e-3, "{contact}: {engine:?}");
        assert!(engine.energy_error.abs() < 1e-3, "{contact}: {engine:?}");
    }
}

fn probed(path: &str, bond: &str) -> Vec<ProbeSample> {
    let text = format!(
        "[probe]\nbodies = \"pair\"\nradius = [\"1 mm\", \"0.6 mm\"]\ndensity = [\"2000 kg/m^3\", \"2000 kg/m^3\"]\n{path}\n\
         [contact.normal]\nlaw = \"linear\"\nk = \"2 kN/m\"\n[contact.bond]\n{bond}\n"
    );
    let document = Document::from_str("bond.toml", &text).unwrap();
    let scenario = ProbeScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
    probe(&scenario).unwrap().remove(0).samples
}

#[test]
fn a_probed_bond_gives_its_forces_and_breaks_where_its_strength_says() {
    let springs = "law = \"elastic-brittle\"\nnormal_stiffness = \"1 kN/m\"\nshear_stiffness = \"500 N/m\"\n\
                   bending_stiffness = \"1e-4 J\"\ntorsion_stiffness = \"2e-4 J\"\ntensile_strength = \"1 N\"\n\
                   shear_strength = \"1 mN\"\ncontact_spring = \"off\"";
    // Shear breaks it at 2 um. Rolling and twisting are arcs: angles times a12 = 0.75 mm.
    let path = "overlap = [\"0 m\", \"-1 um\", \"-1 um\", \"-1 um\", \"-1 um\", \"1 um\"]\n\
                shear = [\"0 m\", \"0 m\", \"0 m\", \"0 m\", \"3 um\", \"3 um\"]\n\
                roll = [\"0 m\", \"0 m\", \"1 um\", \"1 um\", \"1 um\", \"1 um\"]\n\
                twist = [\"0 m\", \"0 m\", \"0 m\", \"1 um\", \"1 um\", \"1 um\"]";
    let samples = probed(path, springs);
    let at = |leg: f64| samples.iter().find(|sample| sample.leg == leg).unwrap();
    let near = |one: f64, other: f64| assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    near(at(1.0).force, -1e-3);
    near(at(2.0).roll_torque, 1e-4 * 1e-6 / 0.75e-3);
    near(at(3.0).twist_torque, 2e-4 * 1e-6 / 0.75e-3);
    assert_eq!((at(3.0).branch, at(4.0).branch), ("bonded", "none"));
    let broken = samples.iter().find(|sample| sample.leg > 3.0 && sample.branch != "bonded").unwrap();
    assert!((2e-6..2.02e-6).contains(&broken.shear), "{broken:?}");
    let before = samples.iter().rfind(|sample| sample.branch == "bonded").unwrap();
    near(before.shear_force, 500.0 * before.shear);
    // What it stored is lost, and the work has paid for it.
    let stored = 0.5 * (1e3 * 1e-12 + 500.0 * 4e-12 + (1e-4 + 2e-4) * (1e-6_f64 / 0.75e-3).powi(2));
    near(at(4.0).dissipated, stored);
    let last = samples.last().unwrap();
    assert!((last.work / (last.stored_energy + last.dissipated) - 1.0).abs() < 1e-2, "{last:?}");
    // The contact is an ordinary one after breaking at a distance.
    near(last.force, 2e-3);
}

#[test]
fn an_agglomerate_is_bonded_thrown_and_breaks() {
    let text = "\
[materials.grain]
density = \"2000 kg/m^3\"
[materials.plate]
[contacts.grain-grain.normal]
law = \"kempton\"
k1 = \"1 kN/m\"
k2 = \"2 kN/m\"
cohesion_density = \"1e4 Pa\"
[contacts.grain-grain.bond]
law = \"elastic-brittle\"
normal_stiffness = \"1 kN/m\"
tensile_strength = \"2 mN\"
distance = \"10 um\"
[contacts.grain-plate.normal]
law = \"linear\"
k = \"1 kN/m\"
[[particles]]
material = \"grain\"
radius = { distribution = \"fixed\", value = \"0.5 mm\" }
arrangement = { kind = \"lattice\", lower = [\"0 mm\", \"0 mm\", \"0.1 mm\"], counts = [3, 3, 3], spacing = \"1.005 mm\" }
velocity = { mean = [\"0.05 m/s\", \"0 m/s\", \"-0.5 m/s\"] }
[walls.floor]
material = \"plate\"
kind = \"plane\"
point = [\"0 mm\", \"0 mm\", \"0 mm\"]
normal = [0, 0, 1]
[[stages]]
name = \"throw\"
form_bonds = true
until = { time = \"2 ms\" }
[output]
timeseries = { steps = 20 }
vtk = true
plots = false
";
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario(text), folder.path());
    let series = Series::read(folder.path());
    let (bonds, broken) = (series.column("bonds"), series.column("broken_bonds"));
    assert_eq!((bonds[0], broken[0]), (54.0, 0.0));
    assert!(bonds.iter().zip(&broken).all(|(intact, broken)| intact + broken == 54.0));
    assert!(*broken.last().unwrap() > 0.0, "none broke");
    assert!(broken.windows(2).all(|pair| pair[0] <= pair[1]));
    assert!(series.column("elastic_bond").iter().any(|&energy| energy > 0.0));
    assert!(*series.column("dissipated_fracture").last().unwrap() > 0.0);
    assert!(summary.energy_error_max < 5e-3, "{:e}", summary.energy_error_max);
}
