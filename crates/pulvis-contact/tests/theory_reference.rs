//! The closed forms against values that an independent program integrated exactly, branch by branch, with 30
//! digits.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::collections::BTreeMap;

use pulvis_contact::theory::{
    Branch, CollisionState, Interpolation, LudingPair, LudingParameters, NonContact, Regime, Stage,
    asymptotes, tuning,
};

const REFERENCE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/luding_reference.csv");

/// One row of the file.
struct Row {
    cells: BTreeMap<String, String>,
}

impl Row {
    fn text(&self, name: &str) -> &str {
        &self.cells[name]
    }

    fn number(&self, name: &str) -> f64 {
        self.text(name).parse().unwrap_or_else(|_| panic!("{name} of row {}", self.text("row_id")))
    }

    /// The pair of the row; all pairs of the file are of two equal spheres.
    fn pair(&self) -> LudingPair {
        let (a1, a2) = (self.number("a1"), self.number("a2"));
        let (m1, m2) = (self.number("m1"), self.number("m2"));
        let interpolation = match self.text("interp") {
            "linear" => Interpolation::Linear,
            "sqrt" => Interpolation::SquareRoot,
            other => panic!("unknown interpolation {other}"),
        };
        let noncontact = match self.text("noncontact") {
            "none" => NonContact::None,
            "reversible" => NonContact::Reversible,
            "irreversible" => NonContact::JumpIn,
            other => panic!("unknown non-contact rule {other}"),
        };
        let parameters = LudingParameters::new(
            self.number("k1"),
            self.number("kp"),
            self.number("kc"),
            self.number("phi_f"),
            m1 * m2 / (m1 + m2),
            2.0 * a1 * a2 / (a1 + a2),
        )
        .with_interpolation(interpolation)
        .with_adhesion(noncontact, self.number("fa"), self.number("kca"));
        LudingPair::new(parameters).unwrap()
    }

    fn state(&self, pair: &LudingPair) -> CollisionState {
        let p = pair.parameters();
        let time = self.number("x") * (p.reduced_mass / p.k1).sqrt();
        let state = pair.trajectory(self.number("v_inf")).at(time).unwrap();
        let branch = match state.branch {
            Branch::Loading => "branch=k1",
            Branch::Unloading => "branch=k2",
            Branch::Tensile => "branch=kc",
        };
        assert!(self.text("note").ends_with(branch), "row {}: {state:?}", self.text("row_id"));
        state
    }
}

fn code(regime: Regime) -> f64 {
    match regime {
        Regime::Rebound => 0.0,
        Regime::Stick(Stage::Unloading) => 1.0,
        Regime::Stick(Stage::Tensile) => 2.0,
        Regime::Stick(Stage::NonContact) => 3.0,
    }
}

/// The value of the closed form for a row; `None` for quantities that no closed form gives.
fn closed_form(row: &Row) -> Option<f64> {
    let pair = row.pair();
    let p = pair.parameters();
    let velocity = row.number("v_inf");
    let dp = pair.dp();
    let chi = pair.chi(velocity);
    let initial = 0.5 * p.reduced_mass * velocity * velocity;
    let result = pair.restitution(velocity);
    let history = result.history;
    let critical = pair.critical_velocities();
    Some(match row.text("quantity") {
        "e" => result.value,
        "e_n" => result.contact,
        "e_approx" => asymptotes::low_velocity(pair.eta(), chi),
        "outcome_code" => code(result.regime),
        "delta_max_over_dp" => result.overlap_max / dp,
        "delta_turn_over_dp" => result.overlap_end / dp,
        "delta_0_over_dp" => pair.delta_0(history) / dp,
        "delta_min_over_dp" => pair.delta_min(history) / dp,
        "k2_over_k1" => pair.k2(history) / p.k1,
        "W_hys_over_Ei" => pair.loop_area(history) / initial,
        "t_contact" => pair.contact_duration(velocity)?,
        "v_crit_a" => critical.low_end?,
        "v_crit_b" => critical.high_onset?,
        "v_crit_c" => critical.high_end?,
        "kp_new" => tuning::tuned_limit_stiffness(p.k1, p.kp, row.number("x")),
        "k2(0.6 dp_old)/k1" => tuned_stiffness(&pair, row.number("x")),
        "dln(e)/dln(chi)" if p.interpolation == Interpolation::SquareRoot => {
            asymptotes::local_exponent_square_root(pair.eta(), pair.beta(), chi)
        }
        "dln(e)/dln(chi)" => asymptotes::local_exponent(pair.eta(), pair.beta(), chi),
        "delta_over_dp" => row.state(&pair).overlap / dp,
        "f_total_over_k1dp" => row.state(&pair).hysteretic_force / (p.k1 * dp),
        "E_kin_over_Ei" => row.state(&pair).kinetic_energy / initial,
        "E_pot_over_Ei" => row.state(&pair).potential_energy / initial,
        "E_avail_over_Ei" => row.state(&pair).available_energy / initial,
        _ => return None,
    })
}

/// These rows hold the tuned parameters; the untuned pair is the reference pair with phi_f divided by the
/// ratio.
fn tuned_stiffness(tuned: &LudingPair, ratio: f64) -> f64 {
    let phi_f = tuned.parameters().phi_f / ratio;
    let reference = LudingPair::new(LudingParameters { kp: 500.0, phi_f, ..*tuned.parameters() }).unwrap();
    let again = reference.tuned(tuned.parameters().phi_f).unwrap();
    assert!((again.parameters().kp / tuned.parameters().kp - 1.0).abs() < 1e-14);
    again.k2(0.6 * reference.dp()) / tuned.parameters().k1
}

/// Allowed deviation: 1e-12, absolute for these quantities of order one, relative where they are small or
/// have a unit.
///
/// The inputs are rounded to 1e-16, and some hundred roundings follow. Two quantities amplify that by their
/// own nature: `e` is the root of a small difference close to a threshold (`de = d(e^2)/(2 e)`), and a force
/// or energy that passes through zero carries the round-off of its scale, which is 1.
fn tolerance(quantity: &str, value: f64) -> f64 {
    match quantity {
        "e" | "e_n" => 1e-12 * value + 1e-15 / value.max(1e-3),
        "delta_over_dp" | "f_total_over_k1dp" | "E_kin_over_Ei" | "E_pot_over_Ei" | "E_avail_over_Ei" => {
            1e-13
        }
        _ => 1e-12 * value.abs(),
    }
}

/// Rows that must have been checked, so that the test cannot pass by skipping.
const CHECKED: [(&str, usize); 22] = [
    ("E_avail_over_Ei", 48),
    ("E_kin_over_Ei", 48),
    ("E_pot_over_Ei", 48),
    ("W_hys_over_Ei", 4),
    ("delta_0_over_dp", 4),
    ("delta_max_over_dp", 76),
    ("delta_min_over_dp", 4),
    ("delta_over_dp", 106),
    ("delta_turn_over_dp", 21),
    ("dln(e)/dln(chi)", 20),
    ("e", 482),
    ("e_approx", 4),
    ("e_n", 88),
    ("f_total_over_k1dp", 106),
    ("k2(0.6 dp_old)/k1", 12),
    ("k2_over_k1", 4),
    ("kp_new", 12),
    ("outcome_code", 228),
    ("t_contact", 18),
    ("v_crit_a", 6),
    ("v_crit_b", 7),
    ("v_crit_c", 7),
];

/// Rows that no closed form covers: the viscous collisions, and the quasi-static loop of Fig. 10, which is
/// the law itself.
const LEFT: [(&str, usize); 7] = [
    ("delta_max_over_dp", 3),
    ("delta_over_dp", 67),
    ("delta_turn_over_dp", 2),
    ("e", 3),
    ("f_over_k1dp_ref", 40),
    ("f_total_over_k1dp", 67),
    ("t_contact", 1),
];

#[test]
fn every_inviscid_row_that_a_closed_form_covers_is_met_to_round_off() {
    let mut reader = csv::Reader::from_path(REFERENCE).unwrap();
    let names = reader.headers().unwrap().clone();
    let mut checked = BTreeMap::<String, usize>::new();
    let mut left = BTreeMap::<String, usize>::new();
    let mut failures = Vec::new();
    for record in reader.records() {
        let record = record.unwrap();
        let cells = names.iter().map(str::to_owned).zip(record.iter().map(str::to_owned)).collect();
        let row = Row { cells };
        let quantity = row.text("quantity").to_owned();
        let closed = if row.number("gamma0") == 0.0 { closed_form(&row) } else { None };
        let Some(closed) = closed else {
            *left.entry(quantity).or_default() += 1;
            continue;
        };
        let value = row.number("value");
        if (closed - value).abs() > tolerance(&quantity, value) || closed.is_nan() {
            failures.push(format!("{} {quantity}: {closed:e} for {value:e}", row.text("row_id")));
        }
        *checked.entry(quantity).or_default() += 1;
    }
    assert!(failures.is_empty(), "{} rows differ:\n{}", failures.len(), failures.join("\n"));
    assert_eq!(checked, counts(&CHECKED), "rows checked");
    assert_eq!(left, counts(&LEFT), "rows left to the laws");
}

fn counts(table: &[(&str, usize)]) -> BTreeMap<String, usize> {
    table.iter().map(|&(quantity, count)| (quantity.to_owned(), count)).collect()
}
