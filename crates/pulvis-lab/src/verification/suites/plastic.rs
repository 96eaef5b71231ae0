//! Laws of plastic contacts with straight branches, and their like.

use pulvis_contact::ContactModel;
use pulvis_contact::catalogue::Values;
use pulvis_input::collision::{Bodies, Sphere};

use super::{Bench, FLAT, INTEGRATED, ROUND_OFF, Suite, Tolerance};
use crate::verification::contact::{Path, normal, normal_by, outcome, restitution, wall};
use crate::verification::data::Row;
use crate::verification::search::{border, lowest};

pub(super) const SUITES: &[Suite] = &[
    ("walton-johnson", walton_johnson),
    ("molerus", molerus),
    ("eepa", eepa),
    ("pasha", pasha),
    ("kempton", kempton),
    ("tabulated", tabulated),
];

/// The place of a kink where the force is least: known as well as the force.
const KINK: Tolerance = Tolerance { relative: 1e-9, reason: "a kink, by the forces beside it" };

/// A law by the keys of its parameters and those of the row.
fn by_row(law: &str, row: &Row, keys: &[(&str, &str)]) -> Option<ContactModel> {
    let numbers: Option<Vec<(&str, f64)>> =
        keys.iter().map(|(key, of_row)| row.get(of_row).map(|number| (*key, number))).collect();
    normal(law, &numbers?)
}

/// The largest overlap [m] of the row's collision, and a contact that is there.
fn pressed(model: &ContactModel, row: &Row, radius: f64) -> Option<(f64, Path)> {
    let largest = outcome(model, wall(row.get("m_r")?, radius), row.get("v")?)?.overlap_max;
    let mut path = Path::at_wall(model, radius);
    path.go(largest);
    Some((largest, path))
}

fn walton_johnson(bench: &mut Bench) {
    const KEYS: &[(&str, &str)] =
        &[("k1", "k1"), ("k2", "k2"), ("f_0", "f0"), ("kappa", "kappa"), ("k_tail", "k_t")];
    let radius = 1e-3;
    bench.rows("walton_johnson", &["D", "d0", "f_po", "e"], INTEGRATED, |row| {
        let model = by_row("walton-johnson", row, KEYS)?;
        let (largest, path) = pressed(&model, row, radius)?;
        match row.quantity {
            "D" => Some(largest),
            "d0" => border(largest, 0.5 * largest, |overlap| path.force(overlap) > 0.0),
            "f_po" => Some(-lowest(0.0, largest, |overlap| path.force(overlap)).1),
            _ => restitution(&model, wall(row.get("m_r")?, radius), row.get("v")?),
        }
    });
    bench.rows("walton_johnson", &["d_t", "d_end"], KINK, |row| {
        let (largest, path) = pressed(&by_row("walton-johnson", row, KEYS)?, row, radius)?;
        let kink = lowest(0.0, largest, |overlap| path.force(overlap)).0;
        if row.quantity == "d_t" {
            return Some(kink);
        }
        border(kink, 0.0, |overlap| path.force(overlap) < 0.0)
    });
}

/// Curves that bend, from the areas under them. Geometrically similar bodies rebound alike at one speed.
fn tabulated(bench: &mut Bench) {
    bench.expect_from(
        "areas under straight pieces: m v²/2 = k δ_1²/2 + k δ_1 t + k' t²/2, e² m v²/2 = F²/(2 k_u)",
    );
    let (knee, soft, hard, unload) = (1e-5, 100.0, 200.0, 400.0);
    let (loading, forces) = ([0.0, knee, 2.0 * knee], [0.0, soft * knee, (soft + hard) * knee]);
    let curves = Values::new()
        .with_numbers("loading_overlap", &loading)
        .with_numbers("loading_force", &forces)
        .with_numbers("unloading_overlap", &[knee, 2.0 * knee])
        .with_numbers("unloading_force", &[0.0, unload * knee]);
    let mass = 1e-6;
    for beyond in [0.0, 0.5 * knee, 7.0 * knee] {
        let load = 0.5 * soft * knee * knee + soft * knee * beyond + 0.5 * hard * beyond * beyond;
        let force = soft * knee + hard * beyond;
        let (speed, expected) = ((2.0 * load / mass).sqrt(), (force * force / (2.0 * unload) / load).sqrt());
        for (size, reference) in [(1.0, None), (1.0, Some(1e-3)), (3.0, Some(1e-3))] {
            let values = match reference {
                Some(radius) => curves.clone().with("reference_radius", radius),
                None => curves.clone(),
            };
            let bodies = wall(size * size * size * mass, size * 1e-3);
            let found = || restitution(&normal_by("tabulated", &values)?, bodies, speed);
            let case = format!("k=100, 200, 400 δ_1=1e-5 t={beyond:e} size={size} R_ref={reference:?}");
            bench.check("e", case, expected, found(), INTEGRATED);
        }
    }
}

fn molerus(bench: &mut Bench) {
    bench.rows("molerus", &["F_H"], KINK, |row| {
        let (k1, k2) = (100.0, 400.0);
        let keys = [
            ("k1", k1),
            ("k2", k2),
            ("vdw_pressure", row.get("p_vdw")?),
            ("yield_pressure", row.get("p_f")?),
            ("f_h0", row.get("F_H0")?),
        ];
        let mut path = Path::at_wall(&normal("molerus", &keys)?, 1e-3);
        // F_N is the force from outside, F_N + F_H0 = k1 δ.
        let largest = (row.get("F_N")? + row.get("F_H0")?) / k1;
        path.go(largest);
        Some(-lowest(0.0, largest, |overlap| path.force(overlap)).1)
    });
}

fn eepa(bench: &mut Bench) {
    bench.rows("eepa", &["e_no_adhesion"], INTEGRATED, |row| {
        let exponent = row.get("n")?;
        let keys = [
            ("k1", if exponent == 1.0 { 1e3 } else { 1e6 }),
            ("lambda_p", row.get("lambda_p")?),
            ("exponent", exponent),
            ("adhesion_exponent", exponent),
            ("k_adh", 0.0),
        ];
        restitution(&normal("eepa", &keys)?, wall(1e-6, 5e-4), 0.1)
    });
    let model = |row: &Row| {
        let numbers = [
            ("k1", row.get("k1")?),
            ("lambda_p", row.get("lambda_p")?),
            ("exponent", row.get("n")?),
            ("adhesion_exponent", row.get("x")?),
            // The law's f_0 is the size of the pull.
            ("f_0", 0.0 - row.get("f0")?),
            ("surface_energy", row.get("delta_gamma")?),
        ];
        normal("eepa", &numbers)
    };
    bench.rows("eepa", &["D", "dp", "e"], INTEGRATED, |row| {
        let (model, radius, constant) = (model(row)?, row.get("R")?, row.get("f0")?);
        let (largest, path) = pressed(&model, row, radius)?;
        match row.quantity {
            "D" => Some(largest),
            "dp" => border(largest, 0.5 * largest, |overlap| path.force(overlap) > constant),
            _ => restitution(&model, wall(row.get("m_r")?, radius), row.get("v")?),
        }
    });
    bench.rows("eepa", &["dmin", "k_adh"], KINK, |row| {
        let (largest, path) = pressed(&model(row)?, row, row.get("R")?)?;
        let constant = row.get("f0")?;
        let (place, least) = lowest(0.0, largest, |overlap| path.force(overlap));
        let power = pulvis_math::elementary::powf(place, row.get("x")?);
        Some(if row.quantity == "dmin" { place } else { (constant - least) / power })
    });
    bench.expect_from("(1/2) delta_0 (k1 delta_max + k_adh delta_min), straight branches");
    let (k1, lambda, k_adh, largest) = (1e3, 0.7, 150.0, 6e-6);
    let found = || {
        let keys = [
            ("k1", k1),
            ("lambda_p", lambda),
            ("exponent", 1.0),
            ("adhesion_exponent", 1.0),
            ("k_adh", k_adh),
        ];
        let mut path = Path::at_wall(&normal("eepa", &keys)?, 5e-4);
        path.go(largest);
        path.go(-1e-9);
        Some(path.lost)
    };
    let k2 = k1 / (1.0 - lambda);
    let expected = 0.5 * lambda * largest * (k1 * largest + k_adh * lambda * largest * k2 / (k2 + k_adh));
    bench.check("loop area", "k1=1e3 lambda_p=0.7 n=x=1 k_adh=150 dmax=6e-6", expected, found(), ROUND_OFF);
}

fn pasha(bench: &mut Bench) {
    let keys = [("k_e", "k_e"), ("k_p", "k_p"), ("k_cp", "k_cp"), ("f_ce", "f_ce"), ("f_y", "f_y")];
    let radius = 1e-3;
    bench.rows("pasha", &["al_max", "f_max", "al_p", "f_cp", "e"], INTEGRATED, |row| {
        let model = by_row("pasha", row, &keys)?;
        let (largest, path) = pressed(&model, row, radius)?;
        match row.quantity {
            "al_max" => Some(largest),
            "f_max" => Some(path.force(largest)),
            "al_p" => border(largest, 0.6 * largest, |overlap| path.force(overlap) > 0.0),
            "f_cp" => Some(-lowest(0.0, largest, |overlap| path.force(overlap)).1),
            _ => restitution(&model, wall(row.get("m_r")?, radius), row.get("v")?),
        }
    });
    bench.rows("pasha", &["al_cp", "al_fp"], KINK, |row| {
        let (largest, path) = pressed(&by_row("pasha", row, &keys)?, row, radius)?;
        let kink = lowest(0.0, largest, |overlap| path.force(overlap)).0;
        if row.quantity == "al_cp" {
            return Some(kink);
        }
        border(kink, 0.0, |overlap| path.force(overlap) != 0.0)
    });
    bench.rows("pasha", &["v_stick_elastic"], FLAT, |row| {
        let numbers = [
            ("k_e", row.get("k_e")?),
            ("k_p", 2e3),
            ("k_cp", 500.0),
            ("f_ce", row.get("f_ce")?),
            ("f_y", 5e-4),
        ];
        let model = normal("pasha", &numbers)?;
        // From e² of twice the expected speed, which stays below yield.
        let speed = 2.0 * row.value;
        let e = restitution(&model, wall(row.get("m_r")?, radius), speed)?;
        Some(speed * (1.0 - e * e).sqrt())
    });
}

fn kempton(bench: &mut Bench) {
    bench.rows("kempton_sjkr", &["area"], ROUND_OFF, |row| {
        // A spring that is hardly felt, and one joule per cubic metre.
        let model = normal("kempton", &[("k1", 1e-30), ("k2", 2e-30), ("cohesion_density", 1.0)])?;
        let (first, second) = (row.get("R1")?, row.get("R2")?);
        let path = if second.is_finite() {
            Path::between(&model, first, second)
        } else {
            Path::at_wall(&model, first)
        };
        Some(-path.force(row.get("delta")?))
    });
    bench.expect_from("conservation of energy: (1/2) m_r v^2 at the largest overlap, and e = 1");
    let (stiffness, density, mass, radius, velocity) = (1e3, 5e4, 1e-6, 1e-3, 0.1);
    let bodies = Bodies::Pair([Sphere { radius, mass: 2.0 * mass }; 2]);
    let found = normal("kempton", &[("k1", stiffness), ("k2", stiffness), ("cohesion_density", density)])
        .and_then(|model| outcome(&model, bodies, velocity));
    // Equal spheres: ∫ A dδ = (π/4) δ² (2 a − δ/3).
    let energy = found.map(|outcome| {
        let square = outcome.overlap_max * outcome.overlap_max;
        let integral = 0.25 * std::f64::consts::PI * square * (2.0 * radius - outcome.overlap_max / 3.0);
        0.5 * stiffness * square - density * integral
    });
    let case = "k1=k2=1e3 c=5e4 a=1e-3 m_r=1e-6 v=0.1";
    bench.check("energy at dmax", case, 0.5 * mass * velocity * velocity, energy, INTEGRATED);
    bench.check("e", case, 1.0, found.map(|outcome| outcome.restitution), INTEGRATED);
}
