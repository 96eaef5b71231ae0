//! What contacts remember survives new lists of candidates, and nothing else does.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod common;

use common::*;
use pulvis_contact::noncontact::{JumpIn, Reversible};
use pulvis_contact::{ContactModel, NonContact, WaltonJohnson};
use pulvis_core::{ContactPartner, Domain, Interactions, Setup, Simulation};
use pulvis_math::Vector3;

/// Runs the same system with a skin that is outdated every few steps and with one that holds for long.
fn thin_and_thick(setup: &Setup, steps: usize) -> [Simulation; 2] {
    [0.01, 0.6].map(|skin| {
        let mut simulation = start(setup.clone(), 50.0);
        simulation.set_skin(skin * RADIUS).unwrap();
        advance(&mut simulation, steps);
        simulation
    })
}

fn assert_same(domain: &Domain, [thin, thick]: &[Simulation; 2], tolerance: f64) {
    assert!(thin.rebuilds() > 20 * thick.rebuilds(), "{} {}", thin.rebuilds(), thick.rebuilds());
    let difference = difference(domain, &states(thin), &states(thick));
    assert!(difference < tolerance, "{difference}");
}

#[test]
fn how_often_candidates_are_listed_does_not_matter() {
    // Contacts add up in another order after each renewal; collisions multiply such rounding errors.
    let edge = 10.0 * RADIUS;
    let powder = Setup {
        walls: cube_of_walls(edge),
        background: gravity(9.81),
        ..implosion(35, edge, 8, viscous_luding())
    };
    let both = thin_and_thick(&powder, 3_000);
    assert_same(&powder.domain, &both, 1e-9);
    let [thin, thick] = both.each_ref().map(Simulation::ledger);
    assert!(thin.dissipated_plastic > 0.0 && thin.dissipated_sliding > 0.0);
    for ((name, one), (_, other)) in thin.accounts().into_iter().zip(thick.accounts()) {
        assert!((one - other).abs() < 1e-9 * thin.scale, "{name}: {one} {other}");
    }
}

#[test]
fn what_flies_out_of_one_piece_of_rows_is_met_in_another() {
    // Two chunks below, two above, and a gap between: each chunk knows for itself by how much its gaps can
    // have closed.
    let edge = 24.0 * RADIUS;
    for [up, down] in [[1.5, 0.0], [0.0, 1.5], [0.8, 0.8]] {
        let mut powder = Setup { walls: cube_of_walls(edge), ..implosion(600, edge, 5, viscous_luding()) };
        powder.particles.sort_by(|one, other| one.position.z.total_cmp(&other.position.z));
        powder.particles.drain(256..344);
        for (place, particle) in powder.particles.iter_mut().enumerate() {
            particle.velocity = vector(0.0, 0.0, if place < 256 { up } else { -down });
        }
        let both = thin_and_thick(&powder, 2_500);
        assert_same(&powder.domain, &both, 1e-9);
        let [thin, thick] = both.map(|simulation| simulation.ledger());
        assert!(thin.dissipated_plastic > 0.02 * thin.scale, "{thin:?}");
        assert!((thin.dissipated() / thick.dissipated() - 1.0).abs() < 1e-9);
    }
}

#[test]
fn skins_by_speed_miss_no_contact_when_a_shock_runs_through_a_packing_and_around_a_periodic_box() {
    let edge = 16.0 * RADIUS;
    let domain = Domain::periodic(Vector3::zero(), vector(edge, edge, edge), [true; 3]);
    let mut powder = Setup { domain, ..implosion(250, edge, 6, viscous_luding()) };
    // All at rest, and so with thin skins, but for some fast ones near one face.
    for particle in &mut powder.particles {
        let fast = particle.position.x > 0.9 * edge;
        particle.velocity = if fast { vector(3.0, 0.4, -0.3) } else { Vector3::zero() };
    }
    let mut both = [start(powder.clone(), 50.0), start(powder, 50.0)];
    both[1].set_skin(0.6 * RADIUS).unwrap();
    let initial = states(&both[0]);
    both.iter_mut().for_each(|simulation| advance(simulation, 2_500));
    let [by_speed, same] = &both;
    let difference = difference(&domain, &states(by_speed), &states(same));
    assert!(difference < 1e-9, "{difference}");
    let reached = states(by_speed).into_iter().zip(&initial);
    let reached =
        reached.filter(|(now, then)| then.velocity == Vector3::zero() && now.velocity.norm() > 0.01);
    let count = reached.count();
    assert!(count > 100, "{count}");
    assert!(by_speed.rebuilds() > 10, "{}", by_speed.rebuilds());
}

#[test]
fn an_aggregate_that_flies_through_periodic_boundaries_stays_the_same() {
    let mut model = viscous_luding();
    model.laws.noncontact = NonContact::Reversible(Reversible { f_a: 1e-4, kc_a: 20.0 });
    let mut open = implosion(12, 6.0 * RADIUS, 2, model);
    for particle in &mut open.particles {
        particle.velocity += vector(2.7, 2.1, -1.5);
    }
    let edge = 14.0 * RADIUS;
    let domain = Domain::periodic(Vector3::zero(), vector(edge, edge, edge), [true; 3]);
    let periodic = Setup { domain, ..open.clone() };
    let [mut open, mut periodic] = [open, periodic].map(|setup| start(setup, 50.0));
    advance(&mut open, 4_000);
    advance(&mut periodic, 4_000);
    let flown = states(&open)[0].position - states(&periodic)[0].position;
    assert!(flown.x.abs() > 0.9 * edge && flown.z.abs() > 0.9 * edge, "{flown:?}");
    let difference = difference(&domain, &states(&open), &states(&periodic));
    // Places in the open system are up to some periods away: their rounding errors are larger.
    assert!(difference < 1e-8, "{difference}");
    let (open, periodic) = (open.ledger(), periodic.ledger());
    assert!((open.dissipated() / periodic.dissipated() - 1.0).abs() < 1e-9);
}

/// Two equal spheres, `gap` apart, that close at `speed`.
fn pair(model: ContactModel, gap: f64, speed: f64) -> Setup {
    let place = |x: f64, speed: f64| sphere(vector(x, 0.0, 0.0), vector(speed, 0.0, 0.0), RADIUS);
    setup(vec![place(0.0, 0.5 * speed), place(2.0 * RADIUS + gap, -0.5 * speed)], model)
}

const PULL: f64 = 1e-4;
const SLOPE: f64 = 50.0;

fn jump_in() -> ContactModel {
    let mut model = elastic();
    model.laws.noncontact = NonContact::JumpIn(JumpIn { f_a: PULL, kc_a: SLOPE });
    model
}

fn overlap(simulation: &Simulation) -> f64 {
    let states = states(simulation);
    2.0 * RADIUS - (states[0].position - states[1].position).norm()
}

#[test]
fn a_pair_held_by_attraction_alone_keeps_its_touch_through_new_lists() {
    // Too slow to get away: it swings between contact and the tail of the attraction for ever.
    let setup = pair(
        jump_in(),
        1e-7,
        0.5 * PULL / (0.5 * sphere(Vector3::zero(), Vector3::zero(), RADIUS).mass * SLOPE).sqrt(),
    );
    let mut bound = start(setup, 200.0);
    bound.set_skin(2e-8).unwrap();
    let (mut in_tail, mut swings, mut before) = (0, 0, 0.0);
    for _ in 0..20_000 {
        bound.step().unwrap();
        let now = overlap(&bound);
        in_tail += usize::from(now < 0.0);
        swings += usize::from(before <= 0.0 && now > 0.0);
        before = now;
        assert!(now > -PULL / SLOPE, "{now}");
    }
    assert!(swings > 5 && in_tail > 2_000, "{swings} {in_tail}");
    assert!(bound.rebuilds() > 1_000, "{}", bound.rebuilds());
    // It touched once.
    assert_eq!(bound.ledger().dissipated_adhesive, 0.5 * PULL * (PULL / SLOPE));
    let mut seen = Vec::new();
    bound.for_each_contact(&mut |view| seen.push((view.first, view.second)));
    assert_eq!(seen, [(0, ContactPartner::Particle(1))]);
}

#[test]
fn a_pair_that_got_out_of_reach_has_forgotten_its_touch() {
    // Spheres that meet through both faces of a periodic box: every collision is a new touch, and on
    // approach nothing pulls.
    let mut setup = pair(jump_in(), 0.5 * RADIUS, 0.2);
    setup.domain = Domain::periodic(
        vector(-RADIUS, -5.0 * RADIUS, -5.0 * RADIUS),
        vector(4.0 * RADIUS, 5.0 * RADIUS, 5.0 * RADIUS),
        [true, false, false],
    );
    let mut pair = start(setup, 50.0);
    let once = 0.5 * PULL * (PULL / SLOPE);
    let (mut touches, mut lost) = (0, 0.0);
    for _ in 0..20_000 {
        let before = pair.ledger().dissipated_adhesive;
        pair.step().unwrap();
        let ledger = pair.ledger();
        lost = ledger.dissipated_adhesive;
        if lost > before {
            touches += 1;
            let separation = states(&pair);
            let along = (separation[1].position - separation[0].position).x / RADIUS;
            // Before the jump the pair was free: its force was zero.
            assert!(along.abs() < 3.1, "{along}");
        }
    }
    assert!(touches > 3, "{touches}");
    assert!((lost / (f64::from(touches) * once) - 1.0).abs() < 1e-14);
}

#[test]
fn a_reversible_tail_is_followed_from_the_end_of_its_reach() {
    let mut model = elastic();
    let (f_a, kc_a) = (1e-4, 2.0);
    model.laws.noncontact = NonContact::Reversible(Reversible { f_a, kc_a });
    let interaction_range = f_a / kc_a;
    // At rest just within reach, many skins away from touching.
    let mut pair = start(pair(model, 0.9 * interaction_range, 0.0), 400.0);
    pair.set_skin(0.02 * interaction_range).unwrap();
    let initial = pair.ledger();
    assert!(
        (initial.adhesive / (-0.5 * f_a * 0.1 * interaction_range * 0.1) - 1.0).abs() < 1e-9,
        "{initial:?}"
    );
    let worst = advance_watching(&mut pair, 80_000, 1);
    let ledger = pair.ledger();
    assert_eq!(ledger.dissipated(), 0.0);
    assert!(ledger.scale > 0.0 && pair.rebuilds() > 100, "{}", pair.rebuilds());
    // The slope of the force jumps at touch: (π/400)²/8 = 8e-6 of the energy there, at every swing.
    assert!(worst < 1e-4, "{worst}");
}

#[test]
fn a_wall_remembers_its_contacts_across_periodic_boundaries() {
    // A sphere pressed on a floor slides on its spring through the period and back.
    let mut sphere = sphere(vector(0.2 * RADIUS, 0.0, 0.98 * RADIUS), vector(0.2, 0.0, 0.0), RADIUS);
    sphere.angular_velocity = vector(0.0, 20.0, 5.0);
    let mut model = luding();
    model.laws.sliding = Some(slider(1.0, 0.0, 0.5));
    let open = Setup { walls: vec![floor()], background: gravity(9.81), ..setup(vec![sphere], model) };
    let domain = Domain::periodic(Vector3::zero(), vector(6.0 * RADIUS, 1.0, 1.0), [true, false, false]);
    let periodic = Setup { domain, ..open.clone() };
    let [mut open, mut periodic] = [open, periodic].map(|setup| start(setup, 50.0));
    periodic.set_skin(0.01 * RADIUS).unwrap();
    advance(&mut open, 20_000);
    advance(&mut periodic, 20_000);
    assert!((states(&open)[0].position - states(&periodic)[0].position).norm() > 5.0 * RADIUS);
    let difference = difference(&domain, &states(&open), &states(&periodic));
    assert!(difference < 1e-9, "{difference}");
}

/// A contact whose normal law keeps three columns and acts up to 2.25 µm beyond touching.
fn three_columns(k_tail: f64) -> ContactModel {
    let law = WaltonJohnson { k1: 100.0, k2: 400.0, f_0: 1e-4, kappa: 0.05, k_tail };
    ContactModel { normal: law.into(), ..luding() }
}

/// The memory of every contact, by its bodies, and how many contacts are held beyond touching.
fn memories(simulation: &Simulation) -> (Vec<(String, Vec<f64>)>, usize) {
    let (mut all, mut apart) = (Vec::new(), 0);
    simulation.for_each_contact(&mut |view| {
        all.push((format!("{:?} {:?}", view.first, view.second), view.memory.to_vec()));
        apart += usize::from(view.overlap < 0.0);
    });
    all.sort_by(|(one, _), (other, _)| one.cmp(other));
    (all, apart)
}

#[test]
fn a_memory_of_several_columns_does_not_depend_on_how_often_neighbours_are_listed() {
    let edge = 10.0 * RADIUS;
    let powder = Setup {
        walls: cube_of_walls(edge),
        background: gravity(9.81),
        ..implosion(35, edge, 8, three_columns(50.0))
    };
    let both = [0.01, 0.6].map(|skin| {
        let mut simulation = start(powder.clone(), 50.0);
        simulation.set_skin(skin * RADIUS).unwrap();
        let mut held_apart = 0;
        for _ in 0..3_000 {
            simulation.step().unwrap();
            held_apart += memories(&simulation).1;
        }
        // The law's range beyond touching is made use of.
        assert!(held_apart > 20, "{held_apart}");
        simulation
    });
    assert_same(&powder.domain, &both, 1e-9);
    let [thin, thick] = both.each_ref().map(|simulation| memories(simulation).0);
    assert!(thin.len() > 10, "{}", thin.len());
    for ((bodies, one), (others, two)) in thin.iter().zip(&thick) {
        assert_eq!(bodies, others);
        for (one, two) in one.iter().zip(two) {
            // Columns of metres and newtons, of a largest size of 1e-5 and 1e-3.
            assert!((one - two).abs() < 1e-12, "{bodies}: {one} {two}");
        }
    }
    let [thin, thick] = both.map(|simulation| simulation.ledger());
    assert!(thin.dissipated_plastic > 0.0 && thin.dissipated_adhesive > 0.0);
    for ((name, one), (_, other)) in thin.accounts().into_iter().zip(thick.accounts()) {
        assert!((one - other).abs() < 1e-9 * thin.scale, "{name}: {one} {other}");
    }
}

#[test]
fn a_switch_of_laws_keeps_the_columns_of_the_same_law_and_no_others() {
    let switched_to = |model: ContactModel| {
        let mut interactions = Interactions::new(1);
        interactions.set(0, 0, model);
        interactions
    };
    let pressed = 1e-5;
    let mut pair = start(pair(three_columns(50.0), -pressed, 0.0), 50.0);
    while overlap(&pair) > 0.95 * pressed {
        pair.step().unwrap();
    }
    let memory = |simulation: &Simulation| memories(simulation).0[0].1[..3].to_vec();
    let before = memory(&pair);
    // Force-free overlap (1 − k1/k2) D, pull-off force f_0 + κ k1 D, attached.
    let expected = [0.75 * pressed, 1e-4 + 5.0 * pressed, 1.0];
    for (found, expected) in before.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < 1e-9, "{before:?}");
    }
    // The same law with other parameters takes its memory over.
    pair.set_interactions(switched_to(three_columns(80.0))).unwrap();
    assert_eq!(memory(&pair), before);
    // Another one knows nothing of it, and what it kept itself is gone with it.
    pair.set_interactions(switched_to(elastic())).unwrap();
    pair.set_interactions(switched_to(three_columns(50.0))).unwrap();
    let met = overlap(&pair);
    pair.step().unwrap();
    let after = memory(&pair);
    assert!((after[0] / (0.75 * met) - 1.0).abs() < 1e-9, "{after:?} at {met}");
    assert!(after[0] < 0.97 * before[0], "{before:?} {after:?}");
}
