#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
#![allow(clippy::disallowed_methods)] // expectations, to some digits

use super::*;
use crate::protocol::prepare;
use pulvis_input::scenario::Scenario;

/// 64 grains of 1 mm in a periodic cube of 5 mm, and what the caller adds.
fn scenario(contact: &str, rest: &str) -> Scenario {
    let text = format!(
        r#"
[domain]
lower = ["0 mm", "0 mm", "0 mm"]
upper = ["5 mm", "5 mm", "5 mm"]
periodic = ["x", "y", "z"]
[materials.grain]
density = "2500 kg/m^3"
[contacts.grain-grain]
{contact}
[[particles]]
material = "grain"
radius = {{ distribution = "fixed", value = "0.5 mm" }}
arrangement = {{ kind = "lattice", lower = ["0 mm", "0 mm", "0 mm"], counts = [4, 4, 4], spacing = "1.25 mm" }}
velocity = {{ standard_deviation = "0.1 m/s" }}
[[stages]]
name = "stage"
until = {{ time = "1 ms" }}
{rest}"#
    );
    Scenario::from_str("regime.toml", &text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn regimes_of(scenario: &Scenario) -> Vec<StageRegime> {
    let prepared = prepare(scenario).unwrap();
    regimes(scenario, &prepared)
}

/// What is read off a loading of 1000 steps.
const READ_OFF: f64 = 2e-3;

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found} instead of {expected}");
}

const CELL: &str = "[stages.cell]\nrate = { xy = \"6.324555 1/s\" }\nstress = { yy = \"1000 Pa\" }\ninertial_number = 1e-2\n";

#[test]
fn softness_and_inertial_number_of_a_sheared_cell_are_those_of_their_definitions() {
    let linear = "normal = { law = \"linear\", k = \"1000 N/m\" }\nsliding = { law = \"spring-slider\", kt = \"200 N/m\", mu = 0.5 }";
    let regimes = regimes_of(&scenario(linear, CELL));
    let [regime] = &regimes[..] else { panic!("{regimes:?}") };
    // p d/k = 1000 Pa · 1 mm/(1000 N/m); γ̇ d √(ρ/p) = 6.324555/s · 1 mm · √(2.5 s²/m²).
    assert_near(regime.contacts[0].softness.unwrap(), 1e-3, READ_OFF, "p*");
    assert_near(regime.inertial_number.unwrap(), 1e-2, 1e-6, "I");
    assert_eq!(regime.contacts[0].bond_number, Some(0.0));
    assert_eq!(regime.contacts[0].plastic_depth, None);
    assert!(regime.frictional && regime.quasi_static_below() == 1e-3);
}

#[test]
fn softness_of_a_hertzian_contact_is_that_of_its_secant() {
    let hertz = "normal = { law = \"hertz\", effective_modulus = \"1 MPa\" }";
    let regimes = regimes_of(&scenario(hertz, CELL));
    // δ = (3 f/(4 E* √R))^(2/3) with f = π d² p/3.6 and R = d/4; p* = p d δ/f.
    let force = PI * 1e-6 * 1000.0 / PHI_Z;
    let overlap = (3.0 * force / (4.0 * 1e6 * 0.25e-3f64.sqrt())).powf(2.0 / 3.0);
    assert_near(regimes[0].contacts[0].softness.unwrap(), 1.0 * overlap / force, READ_OFF, "p*");
}

/// The bound of Rumpf for Luding's law, bulk: σ_t/p = β x/(1 + β + x), with x = η δ/δ_p and δ = f/k1.
#[test]
fn bond_number_of_a_luding_contact_is_its_closed_form() {
    let luding =
        "normal = { law = \"luding\", k1 = \"1000 N/m\", kp = \"5000 N/m\", kc = \"800 N/m\", phi_f = 0.05 }";
    let regime = &regimes_of(&scenario(luding, CELL))[0].contacts[0];
    let (eta, beta) = (4.0, 0.8);
    let plastic_limit = 1.25 * 0.05 * 0.5e-3;
    let depth = PI * 1e-6 * 1000.0 / PHI_Z / 1000.0 / plastic_limit;
    let x = eta * depth;
    assert_near(regime.plastic_depth.unwrap(), depth, READ_OFF, "X");
    // Bo = f_t/(p d²) = (f_t/f) π/(φ Z).
    let expected = beta * x / (1.0 + beta + x) * PI / PHI_Z;
    assert_near(regime.bond_number.unwrap(), expected, 5.0 * READ_OFF, "Bo");
}

/// Johnson, Kendall and Roberts: 3/2 π w R whatever the load was.
#[test]
fn a_contact_of_jkr_is_parted_by_its_pull_off_force() {
    let jkr = "normal = { law = \"jkr\", effective_modulus = \"1 MPa\", work_of_adhesion = \"0.1 J/m^2\" }";
    let regime = &regimes_of(&scenario(jkr, CELL))[0].contacts[0];
    let pull_off = 1.5 * PI * 0.1 * 0.25e-3;
    assert_near(regime.bond_number.unwrap(), pull_off / 1e-3, 5.0 * READ_OFF, "Bo");
    assert!(regime.softness.unwrap() > 0.0);
}

#[test]
fn contacts_of_a_gas_last_a_known_part_of_the_time_between_collisions() {
    let linear = "normal = { law = \"linear\", k = \"1000 N/m\" }";
    let scenario = scenario(linear, "");
    let regimes = regimes_of(&scenario);
    let [regime] = &regimes[..] else { panic!("{regimes:?}") };
    assert_eq!((&regime.pressure, regime.inertial_number), (&None, None));
    // Restated: t_c = π √(m_r/k); 64 grains of π/6 mm³ in 125 mm³; the temperature is that of the velocities drawn.
    let particles = prepare(&scenario).unwrap().particles;
    let mean =
        particles.iter().fold(pulvis_math::Vector3::zero(), |sum, one| sum + one.velocity) * (1.0 / 64.0);
    let temperature =
        particles.iter().map(|one| (one.velocity - mean).norm_squared()).sum::<f64>() / (3.0 * 64.0);
    let phi = 64.0 * PI / 6.0 / 125.0;
    let rate = 24.0 * phi * (1.0 - 0.5 * phi) / (1.0 - phi).powi(3) * (temperature / PI).sqrt() / 1e-3;
    let contact_time = PI * (0.5 * 2500.0 * PI / 6.0 * 1e-9 / 1000.0f64).sqrt();
    assert_near(regime.contacts[0].contact_time_share.unwrap(), contact_time * rate, READ_OFF, "t_c f_E");
}

#[test]
fn a_force_that_no_pair_contact_carries_is_told_as_infinitely_soft() {
    let linear = "normal = { law = \"linear\", k = \"1 N/m\" }";
    let regimes = regimes_of(&scenario(linear, CELL));
    assert_eq!(regimes[0].contacts[0].softness, Some(f64::INFINITY));
    assert_eq!(regimes[0].contacts[0].bond_number, None);
}

#[test]
fn few_particles_are_no_bulk_and_have_no_regime() {
    let text = include_str!("../../../../pulvis-input/tests/good/minimal.toml");
    let minimal = Scenario::from_str("minimal.toml", text).unwrap();
    let prepared = prepare(&minimal).unwrap();
    assert!(prepared.particles.len() < BULK);
    assert_eq!(regimes(&minimal, &prepared), []);
}
