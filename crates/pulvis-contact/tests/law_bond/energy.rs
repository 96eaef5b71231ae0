//! What two bonded bodies keep while they tumble, and that no path gains energy.

use super::bodies::{MASS, RADIUS, Z, alone, beside, bond_of, strong};
use pulvis_contact::Linear;
use pulvis_math::Vector3;
use pulvis_testkit::bodies::{Couple, Sphere};
use pulvis_testkit::contact::{Dance, closing_errors, deficits, random_bond, rigid_rotation};
use pulvis_testkit::for_each_case;

#[test]
fn a_bonded_pair_that_turns_as_one_body_keeps_its_springs() {
    let model = alone(bond_of("elastic-brittle", &strong()));
    for axis in [Vector3::new(0.6, 0.8, 0.0), Z, Vector3::new(0.48, 0.64, 0.6)] {
        let turned = |steps| rigid_rotation(&model, 1e-4, axis, 6.0, steps);
        let relative = |after: Vector3, before: Vector3| (after - before).norm() / before.norm();
        let bending = |steps| {
            let turn = turned(steps);
            relative(turn.after.bond_bending, turn.before.bond_bending)
        };
        // The chord that replaces the arc of a step, of 2 mm against a shear of 0.1 mm, stretches the spring as well.
        let shear = |steps| {
            let turn = turned(steps);
            relative(turn.after.bond_shear, turn.before.bond_shear)
        };
        for (deviation, most) in [(&bending as &dyn Fn(u32) -> f64, 1e-4), (&shear, 2e-2)] {
            let [coarse, medium, fine] = [100, 200, 400].map(deviation);
            // Second order in the angle of a step, 0.06 to 0.015: a fourth each time.
            assert!(medium < coarse / 3.5 + 1e-12 && fine < medium / 3.5 + 1e-12, "{coarse} {medium} {fine}");
            assert!(fine < most, "{axis:?}: {fine}");
        }
        let turn = turned(400);
        let lengths = [
            turn.after.bond_bending.norm() / turn.before.bond_bending.norm(),
            turn.after.bond_twist / turn.before.bond_twist,
        ];
        // A rigid rotation neither bends nor twists: round-off of 400 steps.
        assert!(lengths.iter().all(|length| (length - 1.0).abs() < 1e-12), "{axis:?}: {lengths:?}");
    }
}

#[test]
fn a_tumbling_bonded_pair_keeps_momentum_angular_momentum_and_energy() {
    let model = alone(bond_of("elastic-brittle", &strong()));
    let start = || {
        let mut first = Sphere::at_rest(MASS, RADIUS, Z * (1.7 * RADIUS));
        first.velocity = Vector3::new(0.3, -0.1, 0.05);
        first.angular_velocity = Vector3::new(40.0, 10.0, -30.0);
        let mut second = Sphere::at_rest(1.5 * MASS, 0.7 * RADIUS, Vector3::zero());
        second.angular_velocity = Vector3::new(-20.0, 50.0, 15.0);
        Couple::new(&model, first, Some(second))
    };
    let momenta = |pair: &Couple| {
        let bodies = [pair.i, pair.j.unwrap()];
        let linear = bodies.map(|body| body.velocity * body.mass);
        let angular = bodies.map(|body| {
            body.position.cross(body.velocity) * body.mass + body.angular_velocity * body.inertia()
        });
        [linear[0] + linear[1], angular[0] + angular[1]]
    };
    let energy_error = |dt: f64, steps: u64| {
        let mut pair = start();
        let (before, energy) = (momenta(&pair), pair.kinetic_energy() + pair.stored);
        let mut worst = 0.0_f64;
        for _ in 0..steps {
            pair.step(dt);
            worst = worst.max(((pair.kinetic_energy() + pair.stored) / energy - 1.0).abs());
        }
        for (now, before) in momenta(&pair).into_iter().zip(before) {
            // Round-off of so many steps.
            assert!((now - before).norm() < 1e-12 * before.norm(), "{now:?} {before:?}");
        }
        worst
    };
    // Some ten turns of the pair, a thousand periods of the bond.
    let (coarse, fine) = (energy_error(2e-6, 20_000), energy_error(1e-6, 40_000));
    assert!(coarse < 2e-2 && fine < coarse / 3.0, "{coarse} {fine}");
}

#[test]
fn the_energy_balance_of_bonded_contacts_closes_at_its_order() {
    for_each_case("energy balance of bonds", 60, |draw| {
        let Some(mut bond) = random_bond(draw) else { panic!("a bond") };
        // Strong enough to hold.
        let numbers = [("normal_stiffness", 1.0), ("tensile_strength", f64::MAX)];
        bond.criterion = bond_of("elastic-brittle", &numbers).criterion;
        // The contact beside it is as stiff as the motion is slow.
        let model = beside(bond, Linear::new(1e3, 0.0));
        let dance = Dance::random(&model, draw);
        let [fine, coarse @ ..] = closing_errors(&model, &dance, [8000, 900, 1000, 1100]);
        let coarse = coarse.into_iter().fold(0.0, f64::max);
        assert!(fine <= coarse / 16.0 + 1e-9, "{coarse} falls to {fine}: {model:?}");
        assert!(fine < 1e-2, "{fine}: {model:?}");
    });
}

#[test]
fn no_path_gains_energy_from_bonds_that_break() {
    for_each_case("passivity of bonds", 100, |draw| {
        let Some(bond) = random_bond(draw) else { panic!("a bond") };
        let model = beside(bond, Linear::new(1e3, 0.0));
        let dance = Dance::random(&model, draw);
        // In the step of an event the books are half-way: first order.
        let [fine, coarse] = deficits(&model, &dance, [16_000, 2000]);
        assert!(fine <= 0.3 * coarse + 1e-4, "{coarse} falls to {fine}: {model:?}");
        assert!(fine < 1e-2, "{fine}: {model:?}");
    });
}

#[test]
fn a_bonded_pair_keeps_its_energy_at_the_automatic_step() {
    for_each_case("automatic step of bonds", 40, |draw| {
        let Some(mut bond) = random_bond(draw) else { panic!("a bond") };
        // Strong enough to hold; of any shape.
        let numbers = [("normal_stiffness", 1.0), ("tensile_strength", f64::MAX)];
        bond.criterion = bond_of("elastic-brittle", &numbers).criterion;
        bond.formation.distance = 0.0;
        let model = beside(bond, Linear::new(1e3, 0.0));
        let (body_i, body_j) =
            ((MASS, RADIUS), (MASS * draw.log_between(0.1, 10.0), RADIUS * draw.log_between(0.5, 2.0)));
        let dt = model.shortest_contact_time(body_i, Some(body_j)) / 50.0;
        // Motions of 1e-6 radii in a step, of all modes.
        let speed = 1e-6 * RADIUS / dt;
        let mut moving = |mut sphere: Sphere| {
            sphere.velocity = draw.vector() * speed;
            sphere.angular_velocity = draw.vector() * (speed / RADIUS);
            sphere
        };
        let first = moving(Sphere::at_rest(body_i.0, body_i.1, Z * (body_i.1 + body_j.1)));
        let second = moving(Sphere::at_rest(body_j.0, body_j.1, Vector3::zero()));
        let mut pair = Couple::new(&model, first, Some(second));
        let energy = pair.kinetic_energy();
        let mut worst = 0.0_f64;
        for _ in 0..2000 {
            pair.step(dt);
            worst = worst.max(((pair.kinetic_energy() + pair.stored + pair.lost) / energy - 1.0).abs());
        }
        // Undamped: velocity-Verlet at 100 steps in the shortest period, (π/50)²/8 = 5e-4. Dashpots as fast as the step allows
        // see velocities that are predicted.
        let most = if bond.springs.has_dashpot() { 2e-2 } else { 1e-3 };
        assert!(worst < most, "{worst}: {model:?}");
    });
}
