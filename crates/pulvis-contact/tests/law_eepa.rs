//! The Edinburgh elasto-plastic adhesive law against published points and restitution.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::Pair;
use pulvis_contact::catalogue::Values;
use pulvis_contact::normal::Eepa;
use pulvis_contact::theory::eepa;
use pulvis_testkit::loading::{Loading, built};

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
        let mut contact = Loading::new(eepa_law(parameters), Pair::wall(mass, 5e-4));
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
            let mut contact = Loading::new(law, Pair::wall(1e-6, 5e-4));
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
    let mut contact = Loading::new(law, Pair::wall(1e-6, 5e-4));
    assert!((contact.go(1e-6).force / 1e-3 - 1.0).abs() < 1e-14);
    assert!((contact.go(4e-6).force / 8e-3 - 1.0).abs() < 1e-14);
    // On the limit, k_adh ℓ (δ/ℓ)³.
    let force = contact.go(0.5e-6).force;
    assert!((force / (-50.0 * 1e-6 * 0.125) - 1.0).abs() < 1e-13, "{force}");
}
