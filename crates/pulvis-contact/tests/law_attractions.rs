//! Attractions that jump at touch, and the liquid bridge, on single pairs, against closed forms and published numbers.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_contact::catalogue::{Law, Values};
use pulvis_contact::noncontact::{Hamaker, LiquidBridge, NonContactLaw, NonContactResponse};
use pulvis_contact::normal::Dmt;
use pulvis_contact::theory::HertzPair;
use pulvis_contact::{ContactLaws, ContactModel, Hertz, NonContact, Normal, NormalMotion, Pair};
use pulvis_testkit::collisions::collide;

/// E* [Pa], R [m] and mass [kg] of a sphere at a wall.
const MODULUS: f64 = 1e9;
const RADIUS: f64 = 1e-6;
const MASS: f64 = 8.377580409572781e-15;

fn dahneke() -> Normal {
    let values = Values::new().with("effective_modulus", MODULUS).with("hamaker", 6.5e-20).with("z0", 4e-10);
    Normal::build("dahneke", &values).unwrap().unwrap()
}

/// The largest error over several phases of the first touch.
fn worst_of_phases(error: impl Fn(f64) -> f64) -> f64 {
    let errors = [0.03, 0.21, 0.37, 0.55, 0.71, 0.93].map(|phase| error(phase).abs());
    errors.into_iter().fold(0.0, |worst, error| if error <= worst { worst } else { error })
}

#[test]
fn a_pull_off_force_at_touch_costs_no_energy_and_no_order_of_the_integration() {
    let duration = |speed: f64| HertzPair::new(MODULUS, RADIUS, MASS).unwrap().contact_duration(speed);
    for normal in [Normal::from(Dmt::new(MODULUS, 0.1)), dahneke()] {
        let model = ContactModel::frictionless(normal);
        for speed in [0.5, 3.0] {
            // An end beyond touch makes the collision begin before it.
            let [coarse, fine] = [100.0, 800.0].map(|steps| {
                worst_of_phases(|phase| {
                    let dt = duration(speed) / (steps + phase);
                    let found = collide(&model, (MASS, RADIUS), speed, dt, -1e-12 * RADIUS);
                    assert!(found.missing < 40.0 / (steps * steps), "{}", found.missing);
                    found.restitution.powi(2) - 1.0
                })
            });
            // Measured for a pull-off of 0.2 F_max: 1.4e-4 with 100 steps; without weights 1.4e-2.
            assert!(coarse < 4e-3 && fine < coarse / 16.0 + 1e-9, "{normal:?}, {speed} m/s: {coarse} {fine}");
        }
    }
}

#[test]
fn van_der_waals_attraction_gives_back_what_it_took() {
    let values = Values::new().with("hamaker", 6.5e-20).with("z0", 4e-10).with("cutoff", 2e-8);
    let hamaker = Hamaker::from_values(&values).unwrap();
    let laws = ContactLaws { noncontact: NonContact::Hamaker(hamaker), ..ContactLaws::default() };
    let model = ContactModel { normal: Hertz { effective_modulus: MODULUS }.into(), laws };
    let stiffness = hamaker.max_stiffness(&Pair::wall(MASS, RADIUS));
    let period = 2.0 * std::f64::consts::PI * (MASS / stiffness).sqrt();
    for speed in [0.1, 0.3, 3.0] {
        let [coarse, fine] = [100.0, 800.0].map(|steps| {
            worst_of_phases(|phase| {
                let dt = period / (steps + phase);
                collide(&model, (MASS, RADIUS), speed, dt, -1.001 * 2e-8).restitution.powi(2) - 1.0
            })
        });
        // 50 steps in the shortest contact time, half a period: of second order with a kink at touch; at 3 m/s the bodies pass z0 within two steps.
        assert!(coarse < 1e-3 && fine < coarse / 12.0 + 1e-10, "{speed} m/s: {coarse} {fine}");
    }
}

fn at(bridge: &LiquidBridge, radius: f64, overlap: f64, memory: &mut [f64; 1]) -> NonContactResponse {
    // A mean radius of R_w at a wall of half of it.
    bridge.respond(&NormalMotion::at_rest(&Pair::wall(1e-6, 0.5 * radius), overlap), memory)
}

/// V [m³], R_w [m], σ [N/m], θ [rad], S [m], f(S) [N], S_c [m], work to rupture [J].
const BRIDGES: [[f64; 8]; 2] = [
    [1e-12, 1e-3, 0.072, 0.0, 0.0, -0.0004523893421169302, 1.0000000000000005e-4, 1.0141008872882001e-08],
    [1e-12, 1e-3, 0.072, 0.35, 1e-5, -0.00026861674213803153, 1.1750000000000006e-4, 9.744965139050108e-09],
];

#[test]
fn a_liquid_bridge_has_the_published_force_rupture_distance_and_work() {
    for [volume, radius, tension, angle, distance, force, rupture, work] in BRIDGES {
        let bridge = LiquidBridge::new(volume, tension, angle);
        let mut memory = [0.0];
        assert_eq!(at(&bridge, radius, -distance - 1e-9, &mut memory), NonContactResponse::default());
        let formed = at(&bridge, radius, 0.0, &mut memory);
        // The published work is a quadrature.
        assert!((formed.dissipated / work - 1.0).abs() < 1e-11, "{} {work}", formed.dissipated);
        assert!((formed.potential / -work - 1.0).abs() < 1e-11, "{} {work}", formed.potential);
        let found = at(&bridge, radius, -distance, &mut memory).force;
        assert!((found / force - 1.0).abs() < 1e-14, "{found} {force}");
        let range = bridge.interaction_range(&Pair::wall(1.0, 1.0));
        assert!((range / rupture - 1.0).abs() < 1e-14, "{range} {rupture}");
        assert!(at(&bridge, radius, -0.999_999 * range, &mut memory).force < 0.0);
        let broken = at(&bridge, radius, -1.000_001 * range, &mut memory);
        assert_eq!((broken, memory), (NonContactResponse::default(), [0.0]));
        assert_eq!(at(&bridge, radius, -0.5 * range, &mut memory).force, 0.0, "a broken bridge stays broken");
    }
}

#[test]
fn the_mean_radius_of_unequal_spheres_is_the_harmonic_one() {
    let bridge = LiquidBridge::new(1e-12, 0.072, 0.0);
    let force = |pair: &Pair| bridge.respond(&NormalMotion::at_rest(pair, -1e-5), &mut [1.0]).force;
    let unequal = force(&Pair::spheres(1.0, 1.0, 1e-3, 3e-3));
    let equal = force(&Pair::spheres(1.0, 1.0, 1.5e-3, 1.5e-3));
    assert!((unequal / equal - 1.0).abs() < 1e-15, "{unequal} {equal}");
}

#[test]
fn bodies_with_a_bridge_lose_the_work_to_break_it_and_stick_below() {
    let [volume, radius, tension, angle, _, _, rupture, work] = BRIDGES[1];
    // R_w of a sphere at a wall is its diameter.
    let (mass, radius) = (1e-6, 0.5 * radius);
    let bridge = LiquidBridge::new(volume, tension, angle);
    let laws = ContactLaws { noncontact: NonContact::LiquidBridge(bridge), ..ContactLaws::default() };
    let model = ContactModel { normal: Hertz { effective_modulus: 1e7 }.into(), laws };
    let sticking = (2.0 * work / mass).sqrt();
    for ratio in [1.05, 1.5, 5.0] {
        let speed = ratio * sticking;
        let duration = HertzPair::new(1e7, radius, mass).unwrap().contact_duration(speed);
        let expected = 1.0 - 1.0 / (ratio * ratio);
        let [coarse, fine] = [50.0, 400.0].map(|steps| {
            worst_of_phases(|phase| {
                let dt = duration / (steps + phase);
                collide(&model, (mass, radius), speed, dt, -1.0001 * rupture).restitution.powi(2) - expected
            })
        });
        // Formation and rupture are weighted by the part of the step in which the force acts: second order.
        assert!(coarse < 2e-2 && fine < coarse / 12.0 + 1e-8, "{ratio}: {coarse} {fine}");
    }
}

fn shared(share: f64, angle: f64) -> LiquidBridge {
    LiquidBridge::shared(share, 0.072, angle)
}

/// The pair with so much liquid on both bodies [m³].
fn wetted(pair: Pair, liquid: [f64; 2]) -> Pair {
    let mut quantities = *pair.quantities();
    quantities.attraction[0] = liquid;
    pair.with_quantities(quantities)
}

#[test]
fn a_bridge_from_the_liquid_of_two_bodies_has_the_volume_that_they_share() {
    // Caps of equal spheres: φ = (2 − √3)/4 = 0.066987298; 1e-11 and 4.928203230e-12 m³ make one of 1e-12 m³.
    let share = (2.0 - 3.0_f64.sqrt()) / 4.0;
    let liquid = [1e-11, 1e-12 / share - 1e-11];
    assert!((liquid[1] - 4.928203230275509e-12).abs() < 1e-26, "{liquid:?}");
    let pair = |liquid: [f64; 2]| wetted(Pair::spheres(1e-6, 1e-6, 1e-3, 1e-3), liquid);
    for [volume, radius, _, angle, distance, force, rupture, work] in BRIDGES {
        assert_eq!([volume, radius], [1e-12, 1e-3]);
        let bridge = shared(share, angle);
        let at = |overlap: f64, memory: &mut [f64; 1]| {
            bridge.respond(&NormalMotion::at_rest(&pair(liquid), overlap), memory)
        };
        let mut memory = [0.0];
        let formed = at(0.0, &mut memory);
        // The published work is a quadrature.
        assert!((formed.dissipated / work - 1.0).abs() < 1e-11, "{} {work}", formed.dissipated);
        let found = at(-distance, &mut memory).force;
        assert!((found / force - 1.0).abs() < 1e-14, "{found} {force}");
        assert!(at(-0.999_999 * rupture, &mut memory).force < 0.0);
        assert_eq!((at(-1.000_001 * rupture, &mut memory), memory), (NonContactResponse::default(), [0.0]));
        let range = bridge.interaction_range(&pair(liquid));
        assert!(range >= rupture * (1.0 - 1e-15), "{range} {rupture}");
    }
}

#[test]
fn dry_bodies_have_no_bridge_and_a_wall_gives_no_liquid() {
    let bridge = shared(0.1, 0.0);
    let spheres = Pair::spheres(1e-6, 1e-6, 1e-3, 1e-3);
    let mut memory = [0.0];
    let dry = bridge.respond(&NormalMotion::at_rest(&wetted(spheres, [0.0; 2]), 1e-6), &mut memory);
    assert_eq!((dry, memory), (NonContactResponse::default(), [0.0]));
    // One wet body is enough, and the bridge is that of as much liquid in the middle between both.
    let force = |pair: Pair| bridge.respond(&NormalMotion::at_rest(&pair, -1e-5), &mut [1.0]).force;
    assert!(force(wetted(spheres, [2e-12, 0.0])) < 0.0);
    assert_eq!(force(wetted(spheres, [2e-12, 0.0])), force(wetted(spheres, [1e-12, 1e-12])));
    let wall = bridge
        .respond(&NormalMotion::at_rest(&wetted(Pair::wall(1e-6, 1e-3), [2e-12, 0.0]), -1e-5), &mut [1.0]);
    let fixed = LiquidBridge::new(2e-13, 0.072, 0.0);
    let of_volume = fixed.respond(&NormalMotion::at_rest(&Pair::wall(1e-6, 1e-3), -1e-5), &mut [1.0]);
    assert!((wall.force / of_volume.force - 1.0).abs() < 1e-14, "{} {}", wall.force, of_volume.force);
}

#[test]
fn range_and_stiffness_of_bridges_cover_all_liquid_that_there_is() {
    let bounded = shared(0.1, 0.2).bounded_by(&|name| {
        assert_eq!(name, "liquid");
        [0.0, 1e-12, 3e-11].into_iter().collect()
    });
    let pair = Pair::spheres(1e-6, 1e-6, 1e-3, 1e-3);
    let (range, stiffness) = (bounded.interaction_range(&pair), bounded.max_stiffness(&pair));
    for liquid in [[1e-12, 0.0], [1e-12, 1e-12], [3e-11, 1e-12], [3e-11, 3e-11]] {
        let own = LiquidBridge::new(0.1 * (liquid[0] + liquid[1]), 0.072, 0.2);
        assert!(own.interaction_range(&pair) <= range * (1.0 + 1e-15), "{liquid:?}");
        assert!(own.max_stiffness(&pair) <= stiffness * (1.0 + 1e-15), "{liquid:?}");
    }
}
