//! Temperature and quantities of particles in collisions, probes and runs.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod protocol_scenarios;

use protocol_scenarios::{Series, run, scenario};
use pulvis_input::Document;
use pulvis_input::collision::CollisionScenario;
use pulvis_input::probe::ProbeScenario;
use pulvis_input::scenario::Refusal;
use pulvis_lab::collision::sweep;
use pulvis_lab::probe::probe;
use pulvis_lab::protocol::{Sticking, preflight};

const SINTER: &str = "\
law = \"sinter-luding\"
k1 = \"100 N/m\"
kp = \"500 N/m\"
kc = \"20 N/m\"
phi_f = 0.2
t_melt = \"500 K\"
t_width = \"10 K\"
time_scale = \"1 ms\"
";

/// Restitution of a collision of two spheres of 1 mm.
fn restitution(keys: &str, contact: &str) -> f64 {
    let text = format!("{keys}\n[contact.normal]\n{contact}");
    let document = Document::from_str("collision.toml", &text).unwrap();
    let scenario = CollisionScenario::from_document(&document).unwrap_or_else(|errors| panic!("{errors}"));
    sweep(&scenario, false).unwrap()[0].collision.outcome.restitution
}

const PAIR: &str = "[collision]\nbodies = \"pair\"\nradius = \"1 mm\"\ndensity = \"2500 kg/m^3\"\n";

#[test]
fn a_hot_collision_is_more_plastic_than_a_cold_one() {
    let at = |temperature: &str| {
        let keys =
            format!("temperature = \"{temperature}\"\n{PAIR}velocity = \"5 mm/s\"\nmethod = \"engine\"");
        restitution(&keys, SINTER)
    };
    let (cold, hot) = (at("300 K"), at("520 K"));
    assert!(hot < 0.8 * cold && cold < 1.0, "{cold} {hot}");
}

#[test]
fn charges_are_bound_below_the_speed_that_theory_says_by_both_methods() {
    // v_e √(1/e² − 1) with e = 0.9 and half of 13.1015 mm/s: 3.173 mm/s.
    for method in ["exact", "engine"] {
        let at = |velocity: &str| {
            let keys = format!(
                "{PAIR}charge = [\"10 pC\", \"-10 pC\"]\nvelocity = \"{velocity}\"\nmethod = \"{method}\""
            );
            let contact = "law = \"walton-braun\"\nk1 = \"1 N/m\"\nk2 = \"1.2345679 N/m\"\n\
                           [contact.noncontact]\nlaw = \"coulomb\"\ncutoff = \"2 mm\"\n";
            restitution(&keys, contact)
        };
        assert_eq!(at("3 mm/s"), 0.0, "{method}");
        assert!(at("3.5 mm/s") > 0.1, "{method}");
    }
}

#[test]
fn a_probe_that_holds_a_contact_while_it_melts_sees_its_stiffness_fall() {
    let text = format!(
        "[temperature]\nprogram = [[\"0 s\", \"300 K\"], [\"1 ms\", \"300 K\"], [\"1.001 ms\", \"507 K\"]]\n\
         [probe]\nbodies = \"wall\"\nradius = \"1 mm\"\ndensity = \"2000 kg/m^3\"\n\
         overlap = [\"0 um\", \"20 um\", \"20 um\", \"20 um\"]\ndurations = [\"0.5 ms\", \"0.5 ms\", \"5 ms\"]\n\
         [contact.normal]\n{SINTER}"
    );
    let document = Document::from_str("probe.toml", &text).unwrap();
    let samples = probe(&ProbeScenario::from_document(&document).unwrap()).unwrap().remove(0).samples;
    let at = |leg: f64| samples.iter().find(|sample| sample.leg == leg).unwrap();
    assert!((at(2.0).force / 2e-3 - 1.0).abs() < 1e-12, "{:?}", at(2.0));
    // k_T = 19.78 N/m at 507 K, w = 4.055: after five time scales w/(1 + 5 w) = 0.1906, k = 23.55 N/m.
    let melted = samples.last().unwrap();
    assert!((melted.force / (23.55 * 20e-6) - 1.0).abs() < 2e-3, "{melted:?}");
    // All that was lost went at fixed overlap: what is dissipated and stored is the work.
    assert!(
        (melted.stored_energy + melted.dissipated - melted.work).abs() < 1e-9 * melted.work,
        "{melted:?}"
    );
    assert!(melted.dissipated > 1e-9, "{melted:?}");
}

#[test]
fn a_run_writes_its_temperature_and_the_energies_of_charges_and_heat() {
    let text = format!(
        "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"-9.81 m/s^2\"]\n\
         [temperature]\nprogram = [[\"0 s\", \"300 K\"], [\"20 ms\", \"520 K\"]]\n\
         [materials.grain]\ndensity = \"2000 kg/m^3\"\n\
         [contacts.grain-grain.normal]\n{SINTER}\
         [contacts.grain-grain.noncontact]\nlaw = \"coulomb\"\ncutoff = \"3 mm\"\n\
         [[particles]]\nmaterial = \"grain\"\ncount = 27\n\
         radius = {{ distribution = \"fixed\", value = \"0.4 mm\" }}\n\
         arrangement = {{ kind = \"lattice\", lower = [\"0.5 mm\", \"0.5 mm\", \"0.5 mm\"], counts = [3, 3, 3], spacing = \"0.9 mm\" }}\n\
         columns = {{ charge = \"3 pC\" }}\n\
         [box]\nmaterial = \"grain\"\nlower = [\"0 mm\", \"0 mm\", \"0 mm\"]\nupper = [\"3.5 mm\", \"3.5 mm\", \"5 mm\"]\n\
         [[stages]]\nname = \"heat\"\nuntil = {{ time = \"20 ms\" }}\n[output]\nplots = false\n"
    );
    let folder = tempfile::tempdir().unwrap();
    let summary = run(&scenario(&text), folder.path());
    assert!(summary.energy_error_max < 1e-3, "{}", summary.energy_error_max);
    let series = Series::read(folder.path());
    let temperatures = series.column("temperature");
    assert_eq!(temperatures[0], 300.0);
    assert!((temperatures.last().unwrap() - 520.0).abs() < 0.1, "{temperatures:?}");
    assert!(series.column("electrostatic").iter().all(|&energy| energy > 0.0));
    assert!(*series.column("dissipated_thermal").last().unwrap() > 0.0);
    // What the run says that it used is the same scenario.
    let record = std::fs::read_to_string(folder.path().join("run.toml")).unwrap();
    let again = scenario(&record);
    assert_eq!(again.temperature, scenario(&text).temperature);
}

/// Two opposite charges that fall from rest at 4 mm to 2 mm.
fn falling_charges(time: &str) -> String {
    let grain = |x: &str, charge: &str| {
        format!(
            "[[particles]]\nmaterial = \"grain\"\nradius = {{ distribution = \"fixed\", value = \"0.4 mm\" }}\n\
             arrangement = {{ kind = \"list\", positions = [[\"{x}\", \"0 mm\", \"0 mm\"]] }}\n\
             columns = {{ charge = \"{charge}\" }}\n"
        )
    };
    let grains = [grain("-2 mm", "100 pC"), grain("2 mm", "-100 pC")].concat();
    format!(
        "[materials.grain]\ndensity = \"2000 kg/m^3\"\n\
         [contacts.grain-grain.normal]\nlaw = \"linear\"\nk = \"100 N/m\"\n\
         [electrostatics]\nrelative_permittivity = 2\n{grains}{time}\
         [[stages]]\nname = \"fall\"\nuntil = {{ time = \"{} s\" }}\n[output]\nplots = false\n",
        time_of_fall()
    )
}

/// √(d³ μ/(2 K)) (π/4 + 1/2), K = q²/(4 π ε_0 ε_r) [s].
fn time_of_fall() -> f64 {
    let mass: f64 = 4.0 / 3.0 * std::f64::consts::PI * 2000.0 * 0.4e-3_f64.powi(3);
    let strength = 8.987_551_792_3e9 / 2.0 * 1e-10 * 1e-10;
    (4e-3_f64.powi(3) * 0.5 * mass / (2.0 * strength)).sqrt() * (std::f64::consts::FRAC_PI_4 + 0.5)
}

#[test]
fn charges_over_all_distances_fall_in_their_time_and_write_their_energy() {
    let folder = tempfile::tempdir().unwrap();
    let text = falling_charges("");
    let summary = run(&scenario(&text), folder.path());
    assert!(summary.energy_error_max < 1e-4, "{}", summary.energy_error_max);
    let energies = Series::read(folder.path()).column("electrostatic");
    let at_start = -8.987_551_792_3e9 / 2.0 * 1e-20 / 4e-3;
    assert!((energies[0] / at_start - 1.0).abs() < 1e-12, "{energies:?}");
    // Half the distance: twice the energy. The last step ends up to a step late, within 1e-3 of the time.
    assert!((energies.last().unwrap() / (2.0 * at_start) - 1.0).abs() < 5e-3, "{energies:?}");
    let record = std::fs::read_to_string(folder.path().join("run.toml")).unwrap();
    assert_eq!(scenario(&record).electrostatics, scenario(&text).electrostatics);
}

#[test]
fn a_step_that_does_not_resolve_two_charges_that_touch_is_refused() {
    // At touch ω² = 2 K/(d³ μ), K = 1e-6² C²/(4 π ε_0 ε_r): 8e6/s, far above the 2e4/s of the contact.
    let strong = falling_charges("[time]\nstep = \"2 us\"\n").replace("100 pC", "1 uC");
    let text = preflight(&scenario(&strong)).unwrap_err().to_string();
    assert!(text.contains("two charges that touch") && text.contains("smaller charges"), "{text}");
    let automatic = falling_charges("").replace("100 pC", "1 uC");
    let forecast = preflight(&scenario(&automatic)).unwrap();
    // What rests is moved by the charges: that nothing moves would be wrong.
    assert!(forecast.warnings.is_empty(), "{:?}", forecast.warnings);
    let slope = 2.0 * 8.987_551_792_3e9 / 2.0 * 1e-12 / 0.8e-3_f64.powi(3);
    let mass: f64 = 4.0 / 3.0 * std::f64::consts::PI * 2000.0 * 0.4e-3_f64.powi(3);
    let expected = std::f64::consts::PI * (0.5 * mass / slope).sqrt() / 50.0;
    assert!((forecast.stages[0].time_step / expected - 1.0).abs() < 1e-12, "{:?}", forecast.stages[0]);
}

/// One grain each of two materials; `columns` are those of both.
fn two_grains(contact: &str, columns: [&str; 2]) -> String {
    let group = |name: &str, x: &str, columns: &str| {
        format!(
            "[[particles]]\nmaterial = \"{name}\"\nradius = {{ distribution = \"fixed\", value = \"1 mm\" }}\n\
             arrangement = {{ kind = \"list\", positions = [[\"{x}\", \"0 mm\", \"0 mm\"]] }}\n{columns}\n"
        )
    };
    format!(
        "[materials.one]\ndensity = \"2500 kg/m^3\"\n[materials.other]\ndensity = \"2500 kg/m^3\"\n\
         [contacts.one-other.normal]\nlaw = \"walton-braun\"\nk1 = \"1 N/m\"\nk2 = \"1.2345679 N/m\"\n{contact}\n\
         {}{}[[stages]]\nname = \"rest\"\nuntil = {{ time = \"1 ms\" }}\n",
        group("one", "-2 mm", columns[0]),
        group("other", "2 mm", columns[1])
    )
}

#[test]
fn a_check_finds_the_sticking_speed_with_the_charges_of_the_grains() {
    let contact = "[contacts.one-other.noncontact]\nlaw = \"coulomb\"\ncutoff = \"2 mm\"";
    let sticking = |charges: [&str; 2]| {
        let columns = charges.map(|charge| format!("columns = {{ charge = \"{charge}\" }}"));
        let text = two_grains(contact, [&columns[0], &columns[1]]);
        preflight(&scenario(&text)).unwrap().contacts.remove(0).sticking
    };
    let Sticking::Computed(ranges) = sticking(["10 pC", "-10 pC"]) else { panic!("not computed") };
    // As above, 3.173 mm/s; the attraction also acts while the bodies overlap, by a percent more.
    assert!(ranges.len() == 1 && (ranges[0][1] / 3.173e-3 - 1.0).abs() < 2e-2, "{ranges:?}");
}

#[test]
fn a_check_names_bonds_that_are_overdamped() {
    let warnings = |time: &str| {
        let bond = format!(
            "[contacts.one-other.bond]\nlaw = \"elastic-brittle\"\nform = \"first-touch\"\nnormal_stiffness = \"1e3 N/m\"\n\
             shear_stiffness = \"500 N/m\"\ntensile_strength = \"1e-3 N\"\ndamping_time = \"{time}\""
        );
        let mut scenario = scenario(&two_grains(&bond, [""; 2]));
        scenario.allow(&[Refusal::Overdamped]);
        preflight(&scenario).unwrap().warnings
    };
    // Along the bond τ k/(2 √(k m_r)) = τ √(k/m_r)/2 with m_r = 5.236 mg: 1 at 0.145 ms.
    let of_bonds =
        |time: &str| warnings(time).into_iter().filter(|text| text.contains("of the bond")).count();
    assert_eq!([of_bonds("0.05 ms"), of_bonds("0.4 ms")], [0, 2], "{:?}", warnings("0.4 ms"));
    assert!(warnings("0.4 ms").iter().any(|text| text.contains("of the bond along it is 2.76 times")));
}
