//! The adhesive elasto-plastic law after Pasha et al. against its closed form.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::catalogue::Values;
use pulvis_contact::normal::Pasha;
use pulvis_contact::theory::PashaPair;
use pulvis_contact::{ContactModel, Pair};
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::collisions::collide;
use pulvis_testkit::loading::{Loading, assert_printed, built};

/// Speed, largest overlap, largest force, force-free overlap, pull-off force, overlaps of the pull-off force and of the
/// detachment, and e, of k_e = 1e4, k_p = 2e3, k_cp = 500 N/m, f_ce = 1e-4, f_y = 5e-4 N, m_r = 1e-6 kg.
const PASHA: [[f64; 8]; 2] = [
    [
        0.2,
        4.2866556382549605e-6,
        0.008955533498732144,
        3.391102288381746e-6,
        0.0017911066997464285,
        3.2119916184071033e-6,
        3.132386876196151e-6,
        0.432364420348078,
    ],
    [
        0.02,
        3.0928379466671056e-7,
        0.0010007898115556434,
        2.0920481351114622e-7,
        0.0002001579623111287,
        1.8918901728003335e-7,
        1.8029310784398318e-7,
        0.48317155736704814,
    ],
];

fn pasha_law() -> Pasha {
    let values = Values::new().with("k_e", 1e4).with("k_p", 2e3).with("k_cp", 500.0);
    built("pasha", &values.with("f_ce", 1e-4).with("f_y", 5e-4))
}

fn pasha_theory() -> PashaPair {
    PashaPair::new([1e4, 2e3, 500.0], 1e-4, 5e-4, 1e-6).unwrap()
}

#[test]
fn the_law_after_pasha_has_the_published_points() {
    let theory = pasha_theory();
    assert_printed(theory.sticking_velocity(), 9.493337494797258e-4, 14);
    for [speed, overlap_max, force_max, free, pull_off, pulls, detaches, restitution] in PASHA {
        assert_printed(theory.overlap_max(speed), overlap_max, 14);
        assert_printed(theory.force_max(overlap_max), force_max, 14);
        assert_printed(theory.force_free_overlap(overlap_max), free, 13);
        assert_printed(theory.pull_off_force(overlap_max), pull_off, 13);
        assert_printed(theory.detachment_overlap(overlap_max), detaches, 13);
        assert_printed(theory.restitution(speed), restitution, 13);

        let mut contact = Loading::new(pasha_law(), Pair::wall(1e-6, 1e-4));
        let kinetic = 0.5e-6 * speed * speed;
        let deepest = contact.go(overlap_max);
        let close = |found: f64, expected: f64| {
            assert!((found - expected).abs() < 1e-13 * force_max, "{found}, expected {expected}");
        };
        close(deepest.force, force_max);
        assert!((contact.work(&deepest) / kinetic - 1.0).abs() < 1e-13);
        close(contact.go(free).force, 0.0);
        close(contact.go(pulls).force, -pull_off);
        // Beyond, the attraction falls, reversibly.
        let middle = 0.5 * (pulls + detaches);
        close(contact.go(middle).force, -7.0 / 9.0 * pull_off);
        close(contact.go(detaches + 1e-9 * free).force, -5.0 / 9.0 * pull_off - 1e4 * 1e-9 * free);
        close(contact.go(middle).force, -7.0 / 9.0 * pull_off);
        let before = contact.lost;
        let apart = contact.go(detaches * (1.0 - 1e-9));
        assert_eq!((apart.force, apart.in_contact, apart.stored_energy), (0.0, false, 0.0));
        // Detaching and attaching anew lose nothing.
        close(contact.go(middle).force, -7.0 / 9.0 * pull_off);
        contact.go(0.0);
        assert_eq!(contact.lost, before);
        let found = (1.0 - contact.lost / kinetic).sqrt();
        assert!((found - restitution).abs() < 1e-13, "{found}, expected {restitution}");
        close(contact.go(1e-15).force, -8.0 / 9.0 * 1e-4 + 1e4 * 1e-15);
    }
}

#[test]
fn bodies_after_pasha_rebound_and_stick_as_their_closed_form_says() {
    let (theory, model) = (pasha_theory(), ContactModel::frictionless(pasha_law()));
    let end = -5.0 / 9.0 * 1e-8 * 1.001;
    let period = 2.0 * std::f64::consts::PI * (1e-6_f64 / 1e4).sqrt();
    for speed in [0.02, 0.2] {
        let expected = theory.restitution(speed);
        for (steps, tolerance) in [(100.3, 5e-3), (800.3, 1e-4)] {
            let found = collide(&model, (1e-6, 1e-4), speed, period / steps, end);
            // Second order although the force jumps: its events are weighted.
            let error = (found.restitution - expected).abs();
            assert!(error < tolerance && found.missing < tolerance, "{speed}: {error}, {}", found.missing);
        }
    }
    // Elastic bodies that are slightly faster than the sticking velocity fly apart, slower ones do not.
    let sticking = theory.sticking_velocity();
    let found = collide(&model, (1e-6, 1e-4), 1.05 * sticking, period / 4000.3, end);
    let expected = (1.0 - 1.0_f64 / 1.05 / 1.05).sqrt();
    assert!((found.restitution - expected).abs() < 1e-3, "{} {expected}", found.restitution);
    let mut sphere = Sphere::at_rest(1e-6, 1e-4, Vector3::new(0.0, 0.0, 1e-4));
    sphere.velocity.z = -0.98 * sticking;
    let mut couple = Couple::new(&model, sphere, None);
    for _ in 0..20_000 {
        couple.step(period / 1000.0);
        assert!(couple.overlap > end, "parted");
    }
}
