//! Plastic contacts, bare and adhesive, on single pairs: against closed forms and published values.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::catalogue::Values;
use pulvis_contact::normal::{Eepa, Kempton, Molerus};
use pulvis_contact::theory::{WaltonBraunPair, eepa};
use pulvis_contact::{ContactModel, Memory, Normal, NormalLaw, NormalMotion, NormalResponse, Pair};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};

fn assert_printed(found: f64, printed: f64, digits: i32) {
    let allowed = 0.51 * 10_f64.powi(1 - digits);
    assert!((found / printed - 1.0).abs() < allowed, "{found}, printed {printed}");
}

/// A law by its name, unwrapped from the catalogue.
fn built<N: NormalLaw>(name: &str, values: &Values) -> N {
    *N::of(&Normal::build(name, values).unwrap().unwrap()).unwrap()
}

fn refused(name: &str, values: &Values) -> String {
    Normal::build(name, values).unwrap().unwrap_err().to_string()
}

/// One contact at rest at one overlap after the other, and what it has lost.
struct Contact<N: NormalLaw> {
    law: N,
    pair: Pair,
    memory: N::Memory<f64>,
    lost: f64,
}

impl<N: NormalLaw> Contact<N> {
    fn new(law: N, pair: Pair) -> Self {
        Self { law, pair, memory: Default::default(), lost: 0.0 }
    }

    fn go(&mut self, overlap: f64) -> NormalResponse {
        let answer = self.law.respond(&NormalMotion::at_rest(&self.pair, overlap), &mut self.memory);
        self.lost += answer.dissipated_plastic + answer.dissipated_adhesive;
        answer
    }

    /// The work done so far, as the books say.
    fn work(&self, answer: &NormalResponse) -> f64 {
        self.lost + answer.stored_energy + answer.adhesive_potential
    }

    fn columns(&self) -> Vec<f64> {
        let mut columns = vec![0.0; <N::Memory<f64> as Memory<f64>>::COLUMNS];
        self.memory.store(|index, value| columns[index] = value);
        columns
    }
}

/// A wall collision from touch until the force has come back to zero: velocity over that before, and duration [s].
fn rebound(law: &Normal, mass: f64, speed: f64, dt: f64) -> (f64, f64) {
    let radius = 1e-3;
    let mut sphere = Sphere::at_rest(mass, radius, Vector3::new(0.0, 0.0, radius));
    sphere.velocity.z = -speed;
    let mut couple = Couple::new(&ContactModel::frictionless(*law), sphere, None);
    let steps = couple.step_until(dt, 1_000_000, |couple| couple.normal_force == 0.0);
    (couple.i.velocity.z / speed, dt * steps as f64)
}

#[test]
fn walton_and_brauns_springs_rebound_as_their_closed_forms_say() {
    // Published: e, duration [s], k2 [N/m] and force-free overlap [m] at a speed [m/s].
    let constant = |k1, k2, mass| {
        let values = Values::new().with("k1", k1).with("k2", k2);
        (WaltonBraunPair::constant(k1, k2, mass).unwrap(), ("walton-braun", values))
    };
    let variable = |k1, slope, mass| {
        let values = Values::new().with("k1", k1).with("slope", slope);
        (WaltonBraunPair::variable(k1, slope, mass).unwrap(), ("walton-braun-variable", values))
    };
    let cases = [
        (constant(100.0, 400.0, 5.575e-6), 5.575e-6, 0.1, 0.5, 5.563313990019e-4),
        (constant(1e4, 1.5e4, 1e-3), 1e-3, 1.0, 0.816496580927726, 9.023072808872e-4),
        (variable(100.0, 5e4, 5.575e-6), 5.575e-6, 0.1, 0.6771966403347398, 6.220514355458e-4),
        (variable(1e4, 2e3, 1e-3), 1e-3, 1.0, 0.7826711399286465, 8.855051894254e-4),
    ];
    for ((theory, (name, values)), mass, speed, restitution, duration) in cases {
        assert_printed(theory.restitution(speed), restitution, 13);
        assert_printed(theory.contact_duration(speed), duration, 13);
        let law = Normal::build(name, &values).unwrap().unwrap();
        let (found, time) = rebound(&law, mass, speed, duration / 4000.3);
        // Second order, kinks where branches meet: (ω dt)²/24 = 1e-7 and the step of the kink.
        assert!((found - restitution).abs() < 1e-6, "{name}: {found}, expected {restitution}");
        // To within one of the 4000 steps.
        assert!((time / duration - 1.0).abs() < 3e-4, "{name}: {time}, expected {duration}");
    }
    let stiffening = WaltonBraunPair::variable(100.0, 5e4, 5.575e-6).unwrap();
    assert_printed(stiffening.unloading_stiffness(0.1), 218.05718953117594, 14);
    let latching = WaltonBraunPair::constant(100.0, 400.0, 5.575e-6).unwrap();
    assert_printed(latching.force_free_overlap(0.1), 1.7708578429676394e-5, 14);
    assert_printed(latching.overlap_max(0.1), 2.361143790623519e-5, 14);
    assert!(WaltonBraunPair::constant(100.0, 99.0, 1.0).is_err());
    assert!(WaltonBraunPair::variable(100.0, -1.0, 1.0).is_err());
}

#[test]
fn a_contact_of_walton_and_braun_remembers_its_largest_overlap_until_the_bodies_part() {
    let values = Values::new().with("k1", 100.0).with("k2", 400.0);
    let mut contact = Contact::<pulvis_contact::normal::WaltonBraun>::new(
        built("walton-braun", &values),
        Pair::wall(1e-6, 1e-3),
    );
    assert!((contact.go(4e-6).force / 4e-4 - 1.0).abs() < 1e-15);
    // Force-free at 3 µm; below it nothing, and re-loading follows k2.
    assert_eq!(contact.go(1e-6).force, 0.0);
    // But for round-off of forces of 1e-3 N.
    assert!(contact.go(3e-6).force.abs() < 1e-18);
    assert!((contact.go(3.5e-6).force / 2e-4 - 1.0).abs() < 1e-14);
    assert!((contact.go(8e-6).force / 8e-4 - 1.0).abs() < 1e-15);
    contact.go(0.0);
    assert!((contact.go(1e-6).force / 1e-4 - 1.0).abs() < 1e-15, "parted bodies have forgotten");
}

/// k1, λ_p, n, x, f_0, Δγ, speed; then D, δ_p, δ_min [m], k_adh [SI] and e, with R = 5e-4 m and m_r = 1e-6 kg.
const EEPA: [([f64; 7], [f64; 5]); 3] = [
    (
        [1e6, 0.5, 1.5, 1.5, 0.0, 1.0, 0.1],
        [
            2.7464013582652942e-6,
            1.7301244413691577e-6,
            1.6800879640857165e-6,
            90008.1367605938,
            0.6462293722857434,
        ],
    ),
    (
        [1e6, 0.9, 1.5, 5.0, 1e-4, 10.0, 0.1],
        [2.807067287203909e-6, 2.616663216359911e-6, 2.516349685068587e-6, 2.38924168068622e25, 0.0],
    ),
    (
        [1e3, 0.7, 1.0, 1.0, 0.0, 2.0, 0.2],
        [
            6.324555320336759e-6,
            4.427188724235731e-6,
            4.239059441382402e-6,
            147.93319560213413,
            0.4802010134875105,
        ],
    ),
];

fn eepa_law([k1, lambda_p, n, x, f_0, energy, _]: [f64; 7]) -> Eepa {
    let values = Values::new().with("k1", k1).with("lambda_p", lambda_p).with("exponent", n);
    let values = values.with("adhesion_exponent", x).with("f_0", f_0).with("surface_energy", energy);
    built("eepa", &values)
}

#[test]
fn the_edinburgh_law_has_the_published_points_and_restitution() {
    let mass = 1e-6;
    for (parameters, [overlap_max, plastic_overlap, limit, k_adh, restitution]) in EEPA {
        let [k1, _, n, x, f_0, _, speed] = parameters;
        let mut contact = Contact::new(eepa_law(parameters), Pair::wall(mass, 5e-4));
        let kinetic = 0.5 * mass * speed * speed;
        let deepest = contact.go(overlap_max);
        // The values are rounded to sixteen digits; powers of up to five multiply that.
        let close = |found: f64, expected: f64| {
            assert!((found / expected - 1.0).abs() < 1e-13, "{found}, expected {expected}");
        };
        close(deepest.force, k1 * overlap_max.powf(n) - f_0);
        close(contact.work(&deepest), kinetic);
        close(contact.columns()[0], plastic_overlap);
        close(contact.columns()[1], k_adh);
        // Two hundred times greater forces cancel there.
        let begins = contact.go(limit);
        let pull = k_adh * limit.powf(x);
        assert!((begins.force / (-pull - f_0) - 1.0).abs() < 1e-12, "{}", begins.force);
        assert!(begins.friction_reference < 1e-12 * pull, "{}", begins.friction_reference);
        // Below, the pull falls along the limit.
        close(contact.go(0.5 * limit).force, -k_adh * (0.5 * limit).powf(x) - f_0);
        let apart = contact.go(0.0);
        assert_eq!((apart.force, apart.stored_energy), (0.0, 0.0));
        let found = (1.0 - contact.lost / kinetic).max(0.0).sqrt();
        assert!((found - restitution).abs() < 1e-12, "{found}, expected {restitution}");
    }
}

#[test]
fn without_adhesion_the_edinburgh_law_rebounds_alike_at_any_speed() {
    let cases = [
        (0.5, 1.0, std::f64::consts::FRAC_1_SQRT_2),
        (0.5, 1.5, 0.6670388200256075),
        (0.9, 1.5, 0.2903302414718939),
    ];
    for (lambda_p, n, restitution) in cases {
        // The third has lost two digits: 1 − L^(n+1) and the term that is taken from it are alike.
        let theory = eepa::restitution_without_adhesion(lambda_p, n);
        assert!((theory - restitution).abs() < 1e-14, "{theory}, expected {restitution}");
        for overlap in [1e-8, 1e-6, 1e-4] {
            let law = eepa_law([1e6, lambda_p, n, n, 0.0, 0.0, 0.0]);
            let mut contact = Contact::new(law, Pair::wall(1e-6, 5e-4));
            let answer = contact.go(overlap);
            let work = contact.work(&answer);
            contact.go(-1e-9);
            let found = (1.0 - contact.lost / work).sqrt();
            assert!((found - restitution).abs() < 1e-13, "{found}, expected {restitution}");
        }
    }
}

#[test]
fn a_reference_overlap_scales_the_stiffnesses_of_the_edinburgh_law() {
    let values = Values::new().with("k1", 1e3).with("lambda_p", 0.5).with("k_adh", 50.0);
    let law: Eepa = built("eepa", &values.with("adhesion_exponent", 3.0).with("reference_overlap", 1e-6));
    let mut contact = Contact::new(law, Pair::wall(1e-6, 5e-4));
    assert!((contact.go(1e-6).force / 1e-3 - 1.0).abs() < 1e-14);
    assert!((contact.go(4e-6).force / 8e-3 - 1.0).abs() < 1e-14);
    // On the limit, k_adh ℓ (δ/ℓ)³.
    let force = contact.go(0.5e-6).force;
    assert!((force / (-50.0 * 1e-6 * 0.125) - 1.0).abs() < 1e-13, "{force}");
}

#[test]
fn the_pull_off_force_after_molerus_grows_with_the_load() {
    // F_H0, F_N, p_vdw, p_f and F_H.
    let cases = [([1e-9, 1e-7, 3e7, 3e8], 1.11e-8), ([5e-9, 2e-6, 5e7, 4e8], 2.55625e-7)];
    for ([f_h0, load, vdw, yields], pull_off) in cases {
        let values = Values::new().with("k1", 10.0).with("k2", 40.0).with("f_h0", f_h0);
        let law: Molerus = built("molerus", &values.with("vdw_pressure", vdw).with("yield_pressure", yields));
        let mut contact = Contact::new(law, Pair::wall(1e-14, 1e-6));
        let overlap_max = (load + f_h0) / 10.0;
        assert!((contact.go(overlap_max).force / load - 1.0).abs() < 1e-14);
        for overlap in [0.5, 0.3, 0.01] {
            let force = contact.go(overlap * overlap_max).force;
            assert!((force / -pull_off - 1.0).abs() < 1e-13, "{force}, expected {pull_off}");
        }
        // Re-loaded to less, it pulls as after the largest load.
        contact.go(0.9 * overlap_max);
        assert!((contact.go(0.02 * overlap_max).force / -pull_off - 1.0).abs() < 1e-13);
        let work_before = contact.lost;
        let apart = contact.go(-1e-12);
        assert_eq!((apart.force, apart.stored_energy, apart.adhesive_potential), (0.0, 0.0, 0.0));
        assert!(contact.lost > work_before, "what was stored is lost");
    }
    let values = Values::new().with("k1", 10.0).with("k2", 10.9).with("f_h0", 0.0);
    let values = values.with("vdw_pressure", 3e7).with("yield_pressure", 3e8);
    assert!(refused("molerus", &values).contains("at least (1 + vdw_pressure/yield_pressure) k1 = 11 N/m"));
}

#[test]
fn the_attraction_after_kempton_acts_over_the_area_in_which_the_spheres_intersect() {
    let density = 1e6;
    let values = Values::new().with("k1", 1e-3).with("k2", 1e-3).with("cohesion_density", density);
    let law: Kempton = built("kempton", &values);
    let area = |radius_i: f64, radius_j: f64, overlap: f64| {
        let pair = match radius_j {
            0.0 => Pair::wall(1e-6, radius_i),
            _ => Pair::spheres(1e-6, 1e-6, radius_i, radius_j),
        };
        let motion = NormalMotion::at_rest(&pair, overlap).between(radius_i, radius_j);
        let answer = law.respond(&motion, &mut [0.0]);
        (answer.friction_reference - answer.force) / density
    };
    // R_i, R_j [m] at δ = 1e-5 m and the area [m²].
    let cases = [
        (1e-3, 1e-3, 3.133738671955827e-8),
        (1e-3, 2e-3, 4.178306545070039e-8),
        (1e-3, 0.0, 6.251769380643692e-8),
    ];
    for (radius_i, radius_j, expected) in cases {
        let found = area(radius_i, radius_j, 1e-5);
        // The value itself was computed from differences of lengths, which cancel to 1e-14.
        assert!((found / expected - 1.0).abs() < 1e-13, "{found}, expected {expected}");
        assert!((area(radius_j.max(radius_i), radius_j.min(radius_i), 1e-5) / found - 1.0).abs() < 1e-13);
        // Slight touch: 2 π R δ of the effective radius, to the order δ/R.
        let effective = if radius_j > 0.0 { radius_i * radius_j / (radius_i + radius_j) } else { radius_i };
        let leading = 2.0 * std::f64::consts::PI * effective * 1e-13;
        assert!((area(radius_i, radius_j, 1e-13) / leading - 1.0).abs() < 1e-9);
    }
}
