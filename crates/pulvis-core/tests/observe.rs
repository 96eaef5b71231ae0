//! What the loops add up of the contacts is what a look at every contact gives.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::{
    RADIUS, advance, cube_of_walls, elastic, gravity, implosion, luding, setup, sphere, start, vector,
    viscous_luding,
};
use pulvis_contact::theory::JkrPair;
use pulvis_contact::{ContactModel, Jkr, Normal};
use pulvis_core::{Binding, ContactPartner, ContactTotals, ContactView, Simulation};

/// The totals by a look at one contact after the other.
fn looked_at(simulation: &Simulation) -> ContactTotals {
    let mut totals = ContactTotals::default();
    simulation.for_each_contact(&mut |contact| {
        let touching = f64::from(u8::from(contact.overlap > 0.0));
        match contact.second {
            ContactPartner::Particle(_) => totals.pairs += touching,
            ContactPartner::Wall(_) => totals.at_walls += touching,
        }
        totals.overlap_max = totals.overlap_max.max(contact.overlap);
        let branch = contact.centre_first - contact.centre_second;
        for row in 0..3 {
            for column in 0..3 {
                totals.virial[row][column] += contact.force[row] * branch[column];
            }
        }
    });
    totals
}

#[test]
fn sums_over_contacts_are_those_of_a_look_at_every_contact_for_any_number_of_threads() {
    let edge = 9e-3;
    let mut setup = implosion(400, edge, 3, viscous_luding());
    setup.walls = cube_of_walls(edge);
    setup.background = gravity(981.0);
    let mut all = Vec::new();
    for threads in [1, 2, 3] {
        let mut simulation = start(setup.clone(), 40.0);
        simulation.set_threads(threads).unwrap();
        advance(&mut simulation, 1500);
        let (totals, expected) = (simulation.contact_totals(), looked_at(&simulation));
        assert!(expected.pairs > 50.0 && expected.at_walls > 5.0, "{expected:?}");
        assert_eq!((totals.pairs, totals.at_walls), (expected.pairs, expected.at_walls));
        assert!((totals.overlap_max / expected.overlap_max - 1.0).abs() < 1e-12);
        let size = (0..3).map(|axis| expected.virial[axis][axis].abs()).sum::<f64>();
        for row in 0..3 {
            for column in 0..3 {
                let difference = totals.virial[row][column] - expected.virial[row][column];
                // The look takes the dashpots' velocities at the end of the step, the loop those predicted for it.
                assert!(difference.abs() < 1e-3 * size, "{totals:?} {expected:?}");
            }
        }
        all.push(totals);
    }
    assert!(all.iter().all(|totals| *totals == all[0]), "{all:?}");
}

#[test]
fn vectors_stand_where_their_layout_says() {
    let simulation = start(implosion(50, 9e-3, 3, viscous_luding()), 40.0);
    let particles = simulation.particles();
    let all = [
        particles.positions(),
        particles.velocities(),
        particles.angular_velocities(),
        particles.forces(),
        particles.torques(),
    ];
    for vectors in all {
        let (first, bytes) = vectors.layout();
        for row in 0..vectors.len() {
            let expected: *const f64 = &vectors[row].x;
            assert_eq!(first.wrapping_byte_add(row * bytes), expected);
            assert_eq!(expected.wrapping_add(2), &raw const vectors[row].z);
        }
    }
}

/// What holds each contact of two equal spheres, at this overlap, with a dashpot; the second moves away at `speed`.
fn bindings(model: ContactModel, overlap: f64, speed: f64) -> Vec<Binding> {
    let first = sphere(vector(0.0, 0.0, 0.0), vector(0.0, 0.0, 0.0), RADIUS);
    let second = sphere(vector(2.0 * RADIUS - overlap, 0.0, 0.0), vector(speed, 0.0, 0.0), RADIUS);
    let mut simulation = start(setup(vec![first, second], model), 100.0);
    // The first force makes the contact one that acts.
    simulation.step().unwrap();
    let see = |seen: &mut Vec<Binding>, _: &ContactView<'_>, binding: &Binding| seen.push(*binding);
    simulation.gather_bindings(see).into_iter().flatten().collect()
}

#[test]
fn an_adhesive_pair_is_bound_until_it_moves_with_the_energy_that_breaks_its_contact() {
    // From equilibrium to separation, by quadrature of the law: 11.6946 (Γ⁵ R⁴/E*²)^(1/3).
    let (modulus, adhesion) = (1e8, 0.1);
    let theory = JkrPair::new(modulus, adhesion, 0.5 * RADIUS).unwrap();
    let rest = theory.overlap(theory.unloaded_radius());
    let ratio = adhesion.powi(5) * (0.5 * RADIUS).powi(4) / (modulus * modulus);
    let expected = 11.6946 * ratio.cbrt();
    let model = || ContactModel::frictionless(Jkr::new(modulus, adhesion));
    let [still] = bindings(model(), rest, 0.0)[..] else { panic!("one contact") };
    assert!((still.work_to_part / expected - 1.0).abs() < 2e-3, "{still:?} {expected:e}");
    let mass = sphere(vector(0.0, 0.0, 0.0), vector(0.0, 0.0, 0.0), RADIUS).mass;
    // The reduced mass is half of it.
    let escape = (4.0 * expected / mass).sqrt();
    for (share, bound) in [(0.95, true), (1.05, false)] {
        let [moving] = bindings(model(), rest, share * escape)[..] else { panic!("one contact") };
        assert_eq!(moving.is_bound(), bound, "{share}: {moving:?}");
    }
}

#[test]
fn elastic_grains_are_never_bound() {
    let [pressed] = bindings(elastic(), 1e-5, 0.0)[..] else { panic!("one contact") };
    assert!(pressed.work_to_part == 0.0 && !pressed.is_bound(), "{pressed:?}");
}

#[test]
fn a_luding_contact_is_held_by_its_adhesive_triangle() {
    // Virgin loading to δ_max below the plastic limit: k2 = k1 + (kp − k1) δ_max/δ_p, δ_0 = (1 − k1/k2) δ_max, and on the way
    // out the branch −kc δ is met at δ_min = (k2 − k1)/(k2 + kc) δ_max. What is left beyond δ_0 is kc δ_min δ_0/2, less what the
    // compressed contact gives back, k1² δ_max²/(2 k2).
    let Normal::Luding(law) = luding().normal else { panic!("a Luding contact") };
    let limit = law.kp / (law.kp - law.k1) * law.phi_f * RADIUS;
    let deepest = 0.6 * limit;
    let stiffness = law.k1 + (law.kp - law.k1) * deepest / limit;
    let (rest, least) =
        ((1.0 - law.k1 / stiffness) * deepest, (stiffness - law.k1) / (stiffness + law.kc) * deepest);
    let held = 0.5 * law.kc * least * rest;
    let driven = 0.5 * (law.k1 * deepest).powi(2) / stiffness;
    let [seen] = bindings(luding(), deepest, 0.0)[..] else { panic!("one contact") };
    let expected = held - driven;
    assert!(expected > 0.0 && (seen.work_to_part / expected - 1.0).abs() < 2e-2, "{seen:?} {expected:e}");
}
