//! Springs: linear, of Luding, of Walton and Braun; their dashpots and attractions.

use pulvis_contact::{ContactModel, Pair};
use pulvis_input::collision::{Bodies, Sphere};

use super::{Bench, INTEGRATED, ROUND_OFF, Suite, TEN_DIGITS};
use crate::verification::contact::{
    Path, attraction, damped, normal, outcome, outcome_with, restitution, wall,
};
use crate::verification::search::border;

pub(super) const SUITES: &[Suite] = &[
    ("linear", linear),
    ("luding", luding),
    ("walton-braun", walton_braun),
    ("walton-braun-variable", walton_braun_variable),
    ("core-shell", core_shell),
    ("constant", constant),
    ("critical", critical),
    ("restitution", given_restitution),
    ("jump-in", jump_in),
    ("reversible", reversible),
];

/// The largest overlap from the area under the force.
fn core_shell(bench: &mut Bench) {
    let (shell, core, mass) = (100.0, 2000.0, 1e-6);
    let spheres = Bodies::Pair([Sphere { radius: 1e-3, mass: 2.0 * mass }; 2]);
    bench.expect_from("conservation of energy: m_r v²/2 = k1 t²/2 + k1 t h + kp h²/2");
    let model = normal("core-shell", &[("k1", shell), ("kp", core)]);
    for (bodies, thickness, both) in
        [(spheres, [1e-5, 3e-5], 4e-5), (wall(mass, 1e-3), [2e-5, 0.0], 2e-5), (spheres, [0.0; 2], 0.0)]
    {
        for velocity in [0.05, 0.5, 2.0] {
            let energy = mass * velocity * velocity;
            let beyond = energy - shell * both * both;
            let pressed = shell * both;
            let expected = if beyond > 0.0 {
                both + (-pressed + (pressed * pressed + core * beyond).sqrt()) / core
            } else {
                (energy / shell).sqrt()
            };
            let found = || {
                let quantity = ("shell_thickness", thickness);
                outcome_with(&model?, bodies, velocity, quantity).map(|outcome| outcome.overlap_max)
            };
            let case = format!("k1=100 kp=2000 m_r=1e-6 t={both:e} v={velocity}");
            bench.check("largest overlap", case, expected, found(), INTEGRATED);
        }
    }
}

fn linear(bench: &mut Bench) {
    bench.rows("linear_spring_dashpot", &["e", "tc", "dmax_over_v"], INTEGRATED, |row| {
        let model = normal("linear", &[("k", row.get("k")?), ("gamma_0", row.get("gamma")?)])?;
        // The motion is linear: any speed will do.
        let outcome = outcome(&model, wall(row.get("m_r")?, 1e-3), 0.1)?;
        match row.quantity {
            "e" => Some(outcome.restitution),
            "tc" => outcome.contact_duration,
            _ => Some(outcome.overlap_max / 0.1),
        }
    });
    bench.rows("linear_spring_dashpot", &["dashpot"], ROUND_OFF, |row| {
        let model = normal("linear", &[("k", row.get("k")?), ("restitution", row.get("e")?)])?;
        Some(model.normal.dashpot(&Pair::wall(row.get("m_r")?, 1e-3), &model.laws.expected))
    });
}

/// A linear spring with a dashpot: the restitution at 0.1 m/s of 5.575e-6 kg.
fn damped_spring(dashpot: &str, numbers: &[(&str, f64)]) -> Option<f64> {
    restitution(&damped(normal("linear", &[("k", 100.0)])?, dashpot, numbers)?, wall(5.575e-6, 1e-3), 0.1)
}

fn constant(bench: &mut Bench) {
    bench.expect_from(
        "exp(-pi h/w), h = gamma/(2 m_r), damped oscillator, evaluated by an independent program",
    );
    for (dashpot, expected) in [(5e-3, 0.7156851186369423), (4e-2, 0.006693878069449554)] {
        let found = damped_spring("constant", &[("gamma_0", dashpot)]);
        let case = format!("k=100 m_r=5.575e-6 gamma={dashpot}");
        bench.check("e of a linear spring", case, expected, found, INTEGRATED);
    }
}

fn given_restitution(bench: &mut Bench) {
    bench.expect_from("what is asked for");
    for e in [0.2, 0.9] {
        let found = damped_spring("restitution", &[("restitution", e), ("stiffness", 100.0)]);
        bench.check("e of a linear spring", format!("k=100 restitution={e}"), e, found, INTEGRATED);
    }
}

fn critical(bench: &mut Bench) {
    bench.expect_from("exp(-pi zeta/sqrt(1 - zeta^2)), damped oscillator");
    for fraction in [0.05, 0.5] {
        let angle = std::f64::consts::PI * fraction / (1.0 - fraction * fraction).sqrt();
        let found = damped_spring("critical", &[("fraction", fraction)]);
        let expected = pulvis_math::elementary::exp(-angle);
        bench.check("e of a linear spring", format!("zeta={fraction}"), expected, found, INTEGRATED);
    }
}

/// The reference pair of the papers.
struct Reference(Sphere);

impl Reference {
    const K1: f64 = 1e2;
    const KC: f64 = 1e2;
    /// δ_p = kp/(kp − k1) φ_f a12 [m].
    const DP: f64 = 6.875e-5;

    fn new() -> Self {
        let radius = 1.1e-3;
        Self(Sphere { radius, mass: 2000.0 * 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius })
    }

    fn bodies(&self) -> Bodies {
        Bodies::Pair([self.0; 2])
    }

    fn velocity(&self, chi: f64) -> f64 {
        chi * Self::DP * (2.0 * Self::K1 / self.0.mass).sqrt()
    }

    fn model(kc: f64) -> Option<ContactModel> {
        normal("luding", &[("k1", Self::K1), ("kp", 5e2), ("kc", kc), ("phi_f", 0.05)])
    }
}

/// χ, restitution, largest overlap and stop overlap over δ_p, duration [s].
type Printed = (f64, f64, f64, Option<f64>, Option<f64>);

/// Collisions of the reference pair.
const COLLISIONS: [Printed; 6] = [
    (0.1, 0.816496580928, 0.1, None, Some(7.65646891655e-4)),
    (0.34, 0.436435780472, 0.34, None, Some(8.72151018746e-4)),
    (0.69, 0.0, 0.69, Some(0.275709931607), None),
    (1.1, 0.0, 1.08635642127, Some(0.351188458428), None),
    (1.37, 0.538153093478, 1.26409050841, None, Some(7.00393796521e-4)),
    (2.0, 0.816496580928, 1.6, None, Some(5.40273350901e-4)),
];

fn luding(bench: &mut Bench) {
    let pair = Reference::new();
    let source =
        "Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. 32-39, evaluated by an independent program";
    bench.expect_from(source);
    let dp = Reference::DP;
    for (chi, expected, largest, stop, duration) in COLLISIONS {
        let outcome = Reference::model(Reference::KC)
            .and_then(|model| outcome(&model, pair.bodies(), pair.velocity(chi)));
        let case = format!("reference pair, chi={chi}");
        bench.check("e", &*case, expected, outcome.map(|found| found.restitution), TEN_DIGITS);
        bench.check("dmax/dp", &*case, largest, outcome.map(|found| found.overlap_max / dp), TEN_DIGITS);
        if let Some(stop) = stop {
            bench.check("stop/dp", &*case, stop, outcome.map(|found| found.overlap_end / dp), TEN_DIGITS);
        }
        if let Some(duration) = duration {
            let found = outcome.and_then(|found| found.contact_duration);
            bench.check("contact time", &*case, duration, found, TEN_DIGITS);
        }
    }
    let viscous = |kc: f64| {
        let model = damped(Reference::model(kc)?, "constant", &[("gamma_0", 5e-3)])?;
        outcome(&model, pair.bodies(), pair.velocity(1.0))
    };
    let case = "reference pair, chi=1, gamma0=5e-3";
    let damped = viscous(10.0);
    bench.check("e, kc=10", case, 0.158798223041, damped.map(|found| found.restitution), TEN_DIGITS);
    let duration = damped.and_then(|found| found.contact_duration);
    bench.check("contact time, kc=10", case, 1.17466379684e-3, duration, TEN_DIGITS);
    for (kc, stop) in [(100.0 / 3.0, 0.303412984229), (100.0, 0.487333206617)] {
        let found = viscous(kc).map(|found| found.overlap_end / dp);
        bench.check("stop/dp", format!("{case}, kc={kc}"), stop, found, TEN_DIGITS);
    }
    bench.expect_from("(1/2) delta_0 (k1 delta_max + kc delta_min)");
    let found = Reference::model(Reference::KC).map(|model| {
        let mut path = Path::between(&model, pair.0.radius, pair.0.radius);
        path.go(0.6 * dp);
        path.go(-0.1 * dp);
        path.lost
    });
    // k2 = k1 (1 + 4·0.6), δ_0 = (1 − k1/k2) δ_max, δ_min = (k2 − k1)/(k2 + kc) δ_max.
    let (k1, kc, k2, largest) = (Reference::K1, Reference::KC, 3.4 * Reference::K1, 0.6 * dp);
    let (zero, least) = ((1.0 - k1 / k2) * largest, (k2 - k1) / (k2 + kc) * largest);
    let expected = 0.5 * zero * (k1 * largest + kc * least);
    bench.check("loop area", "reference pair, dmax=0.6 dp", expected, found, ROUND_OFF);
}

/// The spring of Walton and Braun in a collision, unloaded: largest and force-free overlap [m], path at the largest one.
fn unloaded(model: &ContactModel, mass: f64, velocity: f64) -> Option<(f64, f64, Path)> {
    let largest = outcome(model, wall(mass, 1e-3), velocity)?.overlap_max;
    let mut path = Path::at_wall(model, 1e-3);
    path.go(largest);
    let free = border(largest, 0.0, |overlap| path.force(overlap) > 0.0)?;
    Some((largest, free, path))
}

fn walton_braun(bench: &mut Bench) {
    let model = |row: &crate::verification::data::Row| {
        normal("walton-braun", &[("k1", row.get("k1")?), ("k2", row.get("k2")?)])
    };
    bench.rows("walton_braun_constant", &["e", "dmax", "d0"], INTEGRATED, |row| {
        let (model, mass, velocity) = (model(row)?, row.get("m_r")?, row.get("v")?);
        match row.quantity {
            "e" => restitution(&model, wall(mass, 1e-3), velocity),
            "dmax" => Some(unloaded(&model, mass, velocity)?.0),
            _ => Some(unloaded(&model, mass, velocity)?.1),
        }
    });
    bench.rows("walton_braun_constant", &["t"], INTEGRATED, |row| {
        // The contact ends at δ = 0; from the force-free overlap on the bodies fly freely.
        let (model, mass, velocity) = (model(row)?, row.get("m_r")?, row.get("v")?);
        let outcome = outcome(&model, wall(mass, 1e-3), velocity)?;
        let free = unloaded(&model, mass, velocity)?.1;
        Some(outcome.contact_duration? - free / (outcome.restitution * velocity))
    });
}

fn walton_braun_variable(bench: &mut Bench) {
    let model = |row: &crate::verification::data::Row| {
        normal("walton-braun-variable", &[("k1", row.get("k1")?), ("slope", row.get("S")?)])
    };
    bench.rows("walton_braun_variable", &["e", "k2", "t"], INTEGRATED, |row| {
        let (model, mass, velocity) = (model(row)?, row.get("m_r")?, row.get("v")?);
        let outcome = outcome(&model, wall(mass, 1e-3), velocity)?;
        let (largest, free, path) = unloaded(&model, mass, velocity)?;
        match row.quantity {
            "e" => Some(outcome.restitution),
            "k2" => Some(path.force(largest) / (largest - free)),
            _ => Some(outcome.contact_duration? - free / (outcome.restitution * velocity)),
        }
    });
}

/// The reference pair with an attraction, `elastic` or with the law of Luding, at a speed [m/s].
fn attracted(elastic: bool, law: &str, [force, slope]: [f64; 2], velocity: f64) -> Option<f64> {
    let mut model =
        if elastic { normal("linear", &[("k", Reference::K1)])? } else { Reference::model(Reference::KC)? };
    model.laws.noncontact = attraction(law, &[("f_a", force), ("kc_a", slope)])?.laws.noncontact;
    restitution(&model, Reference::new().bodies(), velocity)
}

fn jump_in(bench: &mut Bench) {
    bench.expect_from("Singh, Magnanimo & Luding, Sticking of adhesive particles, Fig. 5, evaluated by an independent program");
    for (elastic, velocity, expected) in [
        (true, 2.5e-5, 0.531551703704),
        (true, 1e-4, 0.977322465135),
        (false, 2.5e-5, 0.528298335972),
        (false, 1e-4, 0.976002231271),
    ] {
        let found = attracted(elastic, "jump-in", [5e-7, 100.0], velocity);
        let contact = if elastic { "linear" } else { "luding" };
        bench.check("e", format!("{contact}, f_a=5e-7 kc_a=100 v={velocity}"), expected, found, TEN_DIGITS);
    }
}

fn reversible(bench: &mut Bench) {
    bench.expect_from(
        "Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. 14, 17, 18, evaluated by an independent program",
    );
    for (velocity, expected) in [(0.01, 0.657454765945), (0.05, 0.586480213639)] {
        let found = attracted(false, "reversible", [1e-4, 50.0], velocity);
        bench.check("e", format!("luding, f_a=1e-4 kc_a=50 v={velocity}"), expected, found, TEN_DIGITS);
    }
    bench.expect_from("conservation of energy");
    let found = attracted(true, "reversible", [1e-4, 50.0], 0.01);
    bench.check("e", "linear, f_a=1e-4 kc_a=50 v=0.01", 1.0, found, INTEGRATED);
}
