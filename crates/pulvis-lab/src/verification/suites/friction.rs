//! Resistance against sliding, rolling and torsion.

use pulvis_contact::ContactModel;
use pulvis_contact::catalogue::Role;
use pulvis_math::Vector3;

use super::{Bench, ROUND_OFF, Suite, TEN_DIGITS, Tolerance};
use crate::verification::contact::{Path, normal, resisted, resisted_by, values};
use crate::verification::data::Row;
use crate::verification::motion::{Start, frequency, held_together, relative};
use crate::verification::search::border;

pub(super) const SUITES: &[Suite] = &[
    ("spring-slider", spring_slider),
    ("mindlin", mindlin),
    ("thornton-yin", thornton_yin),
    ("walton-1993", walton),
    ("constant-torque", constant_torque),
    ("elastic-plastic", elastic_plastic),
    ("marshall", marshall),
];

const MASS: f64 = 1e-3;
const RADIUS: f64 = 1e-2;
/// Of the contacts that oscillate [m]: 1e-7 of the radius, which the formulas neglect.
const OVERLAP: f64 = 1e-9;

const EXTRAPOLATED: Tolerance =
    Tolerance { relative: 2e-6, reason: "next order of the step, overlap/radius" };

fn at_rest(with_partner: bool) -> Start {
    Start {
        mass: MASS,
        radius: RADIUS,
        with_partner,
        overlap: OVERLAP,
        gravity: 0.0,
        velocity: Vector3::zero(),
        angular_velocity: Vector3::zero(),
    }
}

/// A contact that hangs together at [`OVERLAP`] with a normal stiffness [N/m].
fn hanging(stiffness: f64) -> Option<ContactModel> {
    Some(held_together(normal("linear", &[("k", stiffness)])?, stiffness, OVERLAP))
}

fn spring_slider(bench: &mut Bench) {
    bench.rows("luding_friction", &["omega_t"], EXTRAPOLATED, |row| {
        let numbers = [("kt", row.get("k_t")?), ("mu", 1e6)];
        let model = resisted(hanging(1e3)?, Role::Sliding, "spring-slider", &numbers)?;
        let start = at_rest(row.get("m2")?.is_finite());
        let start = Start { velocity: Vector3::new(0.0, 1e-7, 0.0), ..start };
        frequency(row.value, |dt| start.simulation(&model, dt), |now| now.sliding(RADIUS))
    });
    bench.rows("luding_friction", &["omega_r"], EXTRAPOLATED, |row| {
        let numbers = [("kr", row.get("k_r")?), ("mu_r", 1e6)];
        let model = resisted(hanging(1e3)?, Role::Rolling, "spring-slider", &numbers)?;
        let start = at_rest(row.get("m2")?.is_finite());
        let start = Start { angular_velocity: Vector3::new(0.0, 0.0, 1e-6), ..start };
        frequency(row.value, |dt| start.simulation(&model, dt), |now| now.angular_velocity.z)
    });
    bench.expect_from("L √(k_o (1/I_i + 1/I_j)), Luding, Granular Matter 10, 235 (2008)");
    let found = || {
        let model = resisted(hanging(1e3)?, Role::Torsion, "spring-slider", &[("ko", 1e3), ("mu_o", 1e6)])?;
        let start = Start { angular_velocity: Vector3::new(1e-6, 0.0, 0.0), ..at_rest(true) };
        frequency(2236.0, |dt| start.simulation(&model, dt), |now| now.angular_velocity.x)
    };
    bench.check("omega_o", "k_o=1e3 m=1e-3 a=1e-2", 2236.06797749979, found(), EXTRAPOLATED);
    let ends = Tolerance { relative: 1e-3, reason: "the step in which the contact ends" };
    bench.rows("luding_friction", &["tangential_restitution_stick"], ends, |row| {
        rebound(row.get("kt_over_k")?)
    });
    let rolls = Tolerance { relative: 2e-5, reason: "length of the friction spring, steps of the engine" };
    bench.rows("luding_friction", &["t_slide_to_roll", "v_roll"], rolls, sliding_sphere);
    bench.rows("luding_friction", &["f_C"], TEN_DIGITS, coulomb_limit);
}

/// Tangential velocity of the contact point of two spheres after an oblique impact that sticks, over that before it.
fn rebound(ratio: f64) -> Option<f64> {
    let stiffness = 1e7;
    let numbers = [("kt", ratio * stiffness), ("mu", 1e9)];
    let model = resisted(normal("linear", &[("k", stiffness)])?, Role::Sliding, "spring-slider", &numbers)?;
    let start = Start { velocity: Vector3::new(-5e-4, 5e-6, 0.0), overlap: -1e-12, ..at_rest(true) };
    let time_step = std::f64::consts::PI * (0.5 * MASS / stiffness).sqrt() / 6400.3;
    let mut simulation = start.simulation(&model, time_step)?;
    let before = relative(&simulation).sliding(RADIUS);
    for _ in 0..8000 {
        simulation.step().ok()?;
    }
    Some(relative(&simulation).sliding(RADIUS) / before)
}

/// When a sphere that slides along a plane begins to roll [s], or how fast it is then [m/s].
fn sliding_sphere(row: &Row) -> Option<f64> {
    let (friction, gravity) = (row.get("mu").unwrap_or(0.3), row.get("g").unwrap_or(9.81));
    let (speed, stiffness) = (row.get("v0")?, 2e6);
    let numbers = [("kt", stiffness), ("gamma_t", 5.0), ("mu", friction)];
    let model = resisted(normal("linear", &[("k", stiffness)])?, Role::Sliding, "spring-slider", &numbers)?;
    let start = Start {
        gravity,
        overlap: MASS * gravity / stiffness,
        velocity: Vector3::new(0.0, speed, 0.0),
        ..at_rest(false)
    };
    let time_step = 1e-6;
    let mut simulation = start.simulation(&model, time_step)?;
    let (mut before, mut rolls) = (speed, None);
    for step in 1..1_000_000_u32 {
        simulation.step().ok()?;
        let now = relative(&simulation).sliding(RADIUS);
        if now <= 0.0 {
            rolls = Some(time_step * (f64::from(step) - now / (now - before)));
            break;
        }
        before = now;
    }
    if row.quantity == "t_slide_to_roll" {
        return rolls;
    }
    // The dashpot of friction comes to rest.
    for _ in 0..20_000 {
        simulation.step().ok()?;
    }
    Some(relative(&simulation).velocity.y)
}

/// The force at which a contact of the law of Luding slides whose normal force is that of the row.
fn coulomb_limit(row: &Row) -> Option<f64> {
    let (force, kc, overlap, friction) =
        (row.get("f_n")?, row.get("k_c")?, row.get("delta")?, row.get("mu")?);
    let virgin = force > 0.0;
    let k1 = if virgin { force / overlap } else { 100.0 };
    let numbers = [("k1", k1), ("kp", 10.0 * k1), ("kc", kc), ("phi_f", 0.3)];
    let numbers_of_friction = [("kt", 1e6), ("mu", friction)];
    let model = resisted(normal("luding", &numbers)?, Role::Sliding, "spring-slider", &numbers_of_friction)?;
    let pressed = |largest: f64| {
        let mut path = Path::at_wall(&model, 1.0);
        path.go(largest);
        path
    };
    let largest = if virgin {
        overlap
    } else {
        border(overlap, 100.0 * overlap, |largest| pressed(largest).force(overlap) > force)?
    };
    let mut path = pressed(largest);
    path.go(overlap);
    Some(path.slide(1.0))
}

/// A contact of elastic spheres, sheared.
fn mindlin(bench: &mut Bench) {
    bench.expect_from("8 G* a s and μ F, Mindlin, J. Appl. Mech. 16, 259 (1949)");
    let (modulus, shear, radius, overlap) = (1e8, 3e7, 5e-4_f64, 1e-6);
    let area = (radius * overlap).sqrt();
    let load = 4.0 / 3.0 * modulus * area * overlap;
    let path = || {
        let spheres = normal("hertz", &[("effective_modulus", modulus)])?;
        let numbers = [("effective_shear_modulus", shear), ("mu", 0.5)];
        let mut path = Path::at_wall(&resisted(spheres, Role::Sliding, "mindlin", &numbers)?, radius);
        path.go(overlap);
        Some(path)
    };
    let case = "E=1e8 G=3e7 R=5e-4 delta=1e-6 mu=0.5";
    let way = 1e-3 * load / (8.0 * shear * area);
    bench.check("T, sticking", case, 1e-3 * load, path().map(|mut path| path.slide(way)), ROUND_OFF);
    bench.check("T, sliding", case, 0.5 * load, path().map(|mut path| path.slide(1.0)), ROUND_OFF);
}

/// A contact under the normal force of the row, which peels or slides at a very weak limit.
fn peeling(row: &Row) -> Option<Path> {
    const WEAK: f64 = 1e-3;
    let (modulus, shear) = (row.get("Estar")?, row.get("Gstar")?);
    let (load, pull_off, radius) = (row.get("P")?, row.get("Pc")?, row.get("R").unwrap_or(1e-6));
    let adhesion = pull_off / (1.5 * std::f64::consts::PI * radius);
    let spheres = normal("jkr", &[("effective_modulus", modulus), ("work_of_adhesion", adhesion)])?;
    let numbers = [("effective_shear_modulus", shear), ("effective_modulus", modulus), ("mu", WEAK)];
    let mut path = Path::at_wall(&resisted(spheres, Role::Sliding, "thornton-yin", &numbers)?, radius);
    path.go(1e-3 * radius);
    let overlap = border(0.5 * radius, -1e-3 * radius, |overlap| path.force(overlap) > load)?;
    path.go(overlap);
    Some(path)
}

fn thornton_yin(bench: &mut Bench) {
    bench.rows("thornton_yin", &["T_peel"], TEN_DIGITS, |row| {
        let path = peeling(row)?;
        // In one step from rest: the force grows with the way until the contact has peeled and slides.
        let force = |way: f64| path.clone().slide(way);
        let sliding = force(1.0);
        let peels = border(1e-11, 1.0, |way| force(way) > 1.001 * sliding)?;
        Some(force(peels))
    });
    let quotient = Tolerance { relative: 1e-5, reason: "difference quotient along a path of 400 steps" };
    bench.rows("thornton_yin", &["sheared_radius"], quotient, |row| {
        let (path, wanted) = (peeling(row)?, row.get("T")?);
        let force = |way: f64| {
            let mut path = path.clone();
            (0..400).fold(0.0, |_, _| path.slide(way / 400.0))
        };
        let way = border(0.0, 2e-9, |way| force(way) < wanted)?;
        let slope = (force(1.001 * way) - force(0.999 * way)) / (0.002 * way);
        Some(slope / (8.0 * row.get("Gstar")?))
    });
}

fn walton(bench: &mut Bench) {
    let (stiffness, friction, load) = (80.0, 0.5, 3.0);
    let limit = friction * load;
    let path = |variant: &str| {
        let numbers = values(&[("k_0", stiffness), ("mu", friction)]).with_choice("variant", variant);
        let model = resisted_by(normal("linear", &[("k", 1e3)])?, Role::Sliding, "walton-1993", &numbers)?;
        let mut path = Path::at_wall(&model, 1e-2);
        path.go(load / 1e3);
        Some(path)
    };
    bench.expect_from("T/(mu N) = 1 - (1 - (2/3) K0 s/(mu N))^(3/2), Walton, Mech. Mater. 16, 239 (1993)");
    let printed = Tolerance { relative: 2e-7, reason: "printed with seven digits" };
    for variant in ["passive", "published"] {
        for (way, expected) in [(0.5, 0.4556689), (1.5, 1.0)] {
            let found = path(variant).map(|mut path| path.slide(way * limit / stiffness) / limit);
            bench.check("T/(mu N)", format!("{variant}, K0 s/(mu N)={way}"), expected, found, printed);
        }
    }
    bench.expect_from(
        "K0 while the force falls; T* - T = (mu N + T*) (1 - (1 - (2/3) K0 s/(mu N + T*))^(3/2))",
    );
    for (variant, fallen) in [("passive", 0.2), ("published", returned(0.4556689, 0.2))] {
        let found = path(variant).map(|mut path| {
            let turn = path.slide(0.5 * limit / stiffness);
            (turn - path.slide(-0.2 * limit / stiffness)) / limit
        });
        bench.check("fall of T/(mu N)", format!("{variant}, turned at 0.4556689"), fallen, found, printed);
    }
}

/// By how much T/(μ N) falls from `turn` on the way back by `way`, in μ N/K₀, by the published rule.
fn returned(turn: f64, way: f64) -> f64 {
    let range = 1.0 + turn;
    let left = 1.0 - 2.0 / 3.0 * way / range;
    range * (1.0 - left * left.sqrt())
}

fn constant_torque(bench: &mut Bench) {
    bench.expect_from("dv/dt = -M/(a m (1 + 2/5)), M = mu_r N L, L = 2 a at a wall: rigid body");
    let (coefficient, gravity, speed, stiffness) = (0.01, 9.81, 1.0, 2e6);
    let (steps, time_step) = (100_000, 1e-6);
    let found = || {
        let numbers = [("kt", stiffness), ("gamma_t", 5.0), ("mu", 0.5)];
        let model =
            resisted(normal("linear", &[("k", stiffness)])?, Role::Sliding, "spring-slider", &numbers)?;
        let model = resisted(model, Role::Rolling, "constant-torque", &[("mu_r", coefficient)])?;
        let start = Start {
            gravity,
            overlap: MASS * gravity / stiffness,
            velocity: Vector3::new(0.0, speed, 0.0),
            angular_velocity: Vector3::new(0.0, 0.0, speed / RADIUS),
            ..at_rest(false)
        };
        let mut simulation = start.simulation(&model, time_step)?;
        for _ in 0..steps {
            simulation.step().ok()?;
        }
        Some(relative(&simulation).velocity.y)
    };
    let expected = speed - coefficient * 2.0 * gravity / 1.4 * f64::from(steps) * time_step;
    let tolerance = Tolerance { relative: 1e-6, reason: "length of the friction spring, overlap" };
    bench.check("v after 0.1 s", "mu_r=0.01 v=1 g=9.81", expected, found(), tolerance);
}

fn elastic_plastic(bench: &mut Bench) {
    bench.expect_from(
        "L √(k_r (1/I_i + 1/I_j)), k_r = (9/4) k_n mu_r^2, Ai et al., Powder Technol. 206, 269 (2011)",
    );
    let (stiffness, coefficient) = (2e3, 0.4);
    let inertia = 0.4 * MASS * RADIUS * RADIUS;
    let expected = RADIUS * (2.0 * 2.25 * stiffness * coefficient * coefficient / inertia).sqrt();
    let found = || {
        let numbers = [("mu_r", coefficient)];
        let model = resisted(hanging(stiffness)?, Role::Rolling, "elastic-plastic", &numbers)?;
        let start = Start { angular_velocity: Vector3::new(0.0, 0.0, 1e-6), ..at_rest(true) };
        frequency(expected, |dt| start.simulation(&model, dt), |now| now.angular_velocity.z)
    };
    bench.check("omega_r", "k_n=2e3 mu_r=0.4 m=1e-3 a=1e-2", expected, found(), EXTRAPOLATED);
}

fn marshall(bench: &mut Bench) {
    bench.expect_from("4 G* a^3 phi and (2/3) a mu F, Marshall, J. Comput. Phys. 228, 1541 (2009)");
    let (modulus, shear, radius, overlap, friction) = (1e8, 3e7, 5e-4_f64, 1e-6, 0.5);
    let area = (radius * overlap).sqrt();
    let load = 4.0 / 3.0 * modulus * area * overlap;
    let path = || {
        let spheres = normal("hertz", &[("effective_modulus", modulus)])?;
        let numbers = [("effective_shear_modulus", shear), ("mu", friction)];
        let mut path = Path::at_wall(&resisted(spheres, Role::Torsion, "marshall", &numbers)?, radius);
        path.go(overlap);
        Some(path)
    };
    let case = "E=1e8 G=3e7 R=5e-4 delta=1e-6 mu=0.5";
    let expected = 4.0 * shear * area * area * area * 1e-5;
    bench.check("M, phi=1e-5", case, expected, path().map(|mut path| path.twist(1e-5)), ROUND_OFF);
    let sliding = 2.0 / 3.0 * area * friction * load;
    bench.check("M, sliding", case, sliding, path().map(|mut path| path.twist(10.0)), ROUND_OFF);
}
