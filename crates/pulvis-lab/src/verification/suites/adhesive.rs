//! Adhesive elastic spheres.

use pulvis_contact::ContactModel;

use super::{Bench, FLAT, INTEGRATED, ROUND_OFF, Suite, Tolerance};
use crate::collision::Regime;
use crate::verification::contact::{Path, by_method, normal, normal_by, outcome, restitution, values, wall};
use crate::verification::data::Row;
use crate::verification::search::{border, lowest};
use pulvis_input::collision::Method;

pub(super) const SUITES: &[Suite] =
    &[("jkr", jkr), ("dmt", dmt), ("dahneke", dahneke), ("viscoelastic-jkr", viscoelastic_jkr)];

/// A law of spheres with a modulus and a work of adhesion.
fn spheres(law: &str, row: &Row) -> Option<ContactModel> {
    normal(law, &[("effective_modulus", row.get("E")?), ("work_of_adhesion", row.get("work_of_adhesion")?)])
}

/// An attached contact, and the overlap at which it parts [m].
fn attached(row: &Row) -> Option<(Path, f64)> {
    let radius = row.get("R")?;
    let mut path = Path::at_wall(&spheres("jkr", row)?, radius);
    path.go(1e-3 * radius);
    let parts = border(0.0, -0.1 * radius, |overlap| path.force(overlap) != 0.0)?;
    Some((path, parts))
}

fn jkr(bench: &mut Bench) {
    let exact = Tolerance { relative: 1e-10, reason: "round-off" };
    let quantities = ["F_pulloff", "F_touch", "a_touch", "d_sep", "a_eq", "d_eq", "W_loss", "force"];
    bench.rows("jkr", &quantities, exact, |row| {
        let (path, parts) = attached(row)?;
        let unloaded = || border(0.1 * row.get("R")?, 0.0, |overlap| path.force(overlap) > 0.0);
        match row.quantity {
            "F_pulloff" => Some(lowest(parts, 0.0, |overlap| path.force(overlap)).1),
            "F_touch" => Some(path.force(0.0)),
            "a_touch" => Some(path.normal(0.0).contact_radius),
            "d_sep" => Some(parts),
            "a_eq" => Some(path.normal(unloaded()?).contact_radius),
            "d_eq" => unloaded(),
            "force" => Some(path.force(row.get("delta")?)),
            _ => {
                let mut path = path;
                path.go(2.0 * parts);
                Some(path.lost)
            }
        }
    });
    bench.rows("jkr", &["a_pulloff", "d_pulloff", "F_sep"], FLAT, |row| {
        let (path, parts) = attached(row)?;
        let place = lowest(parts, 0.0, |overlap| path.force(overlap)).0;
        match row.quantity {
            "a_pulloff" => Some(path.normal(place).contact_radius),
            "d_pulloff" => Some(place),
            _ => Some(path.force(parts)),
        }
    });
    bench.rows("jkr", &["e", "v_stick"], INTEGRATED, |row| {
        let (model, bodies) = (spheres("jkr", row)?, wall(row.get("m_r")?, row.get("R")?));
        if let Some(velocity) = row.get("v") {
            return restitution(&model, bodies, velocity);
        }
        // Close to the limit e grows like a root, and so do errors: it is taken from e² of twice the expected speed.
        let speed = 2.0 * row.value;
        let e = restitution(&model, bodies, speed)?;
        Some(speed * (1.0 - e * e).sqrt())
    });
    bench.expect_from("3.6·4^(4/3) and 2.4 times F_c s/9, Johnson, Kendall & Roberts, Proc. R. Soc. Lond. A 324, 301 (1971)");
    let row = "E=1e9 R=1e-6 work_of_adhesion=0.1";
    let parameters = Row { model: "jkr", parameters: row, quantity: "", value: 0.0 };
    let losses = || {
        let (mut path, parts) = attached(&parameters)?;
        let touch = path.lost;
        path.go(2.0 * parts);
        Some((touch, path.lost - touch))
    };
    // F_c s/9 with F_c = (3/2) π Γ R and s = |δ_sep|/3.
    let unit = 1.5 * std::f64::consts::PI * 0.1 * 1e-6 * 3.465_994_308_205_635e-9 / 27.0;
    let snap_in = 3.6 * pulvis_math::elementary::powf(4.0, 4.0 / 3.0) * unit;
    bench.check("loss at snap-in", row, snap_in, losses().map(|found| found.0), exact);
    bench.check("loss at snap-off", row, 2.4 * unit, losses().map(|found| found.1), exact);
}

fn dmt(bench: &mut Bench) {
    bench.rows("dmt", &["force", "pull_off"], ROUND_OFF, |row| {
        let path = Path::at_wall(&spheres("dmt", row)?, row.get("R")?);
        Some(path.force(row.get("delta").unwrap_or(f64::MIN_POSITIVE)))
    });
    bench.expect_from("conservation of energy");
    let parameters = "E=1e9 R=1e-6 work_of_adhesion=0.1 m_r=1e-14 v=2";
    let row = Row { model: "dmt", parameters, quantity: "", value: 0.0 };
    let found = spheres("dmt", &row).and_then(|model| restitution(&model, wall(1e-14, 1e-6), 2.0));
    bench.check("e", parameters, 1.0, found, INTEGRATED);
}

fn dahneke(bench: &mut Bench) {
    bench.rows("dahneke", &["force_flattening2", "pull_off_undeformed"], ROUND_OFF, |row| {
        let model = normal(
            "dahneke",
            &[
                ("effective_modulus", row.get("E")?),
                ("hamaker", row.get("A_H")?),
                ("z0", row.get("z0")?),
                ("flattening", 2.0),
            ],
        )?;
        Some(Path::at_wall(&model, row.get("R")?).force(row.get("delta").unwrap_or(f64::MIN_POSITIVE)))
    });
}

fn viscoelastic_jkr(bench: &mut Bench) {
    let collision =
        |variant: &str, numbers: &[(&str, f64)], mass: f64, radius: f64, velocity: f64, method| {
            let model = normal_by("viscoelastic-jkr", &values(numbers).with_choice("variant", variant))?;
            by_method(&model, wall(mass, radius), velocity, method)
        };
    let engine = Method::Engine { steps_per_contact: 40_000.0 };
    let slow =
        Tolerance { relative: 3e-4, reason: "the rate diverges at separation: first order in the step" };
    bench.rows("brilliantov2007", &["e"], slow, |row| {
        let numbers = [
            ("effective_modulus", row.get("E")?),
            ("work_of_adhesion", row.get("work_of_adhesion")?),
            ("dissipative_time", row.get("A")?),
        ];
        let velocity = row.get("v")?;
        let found = collision("published", &numbers, row.get("m_r")?, row.get("R")?, velocity, engine)?;
        Some(found.restitution)
    });
    bench.expect_from("the passive form, integrated by an independent program");
    let printed = Tolerance { relative: 2e-5, reason: "printed with six digits; steps of the engine" };
    let numbers = [("effective_modulus", 1e9), ("work_of_adhesion", 0.05), ("dissipative_time", 5e-10)];
    let (mass, radius) = (8.377580409572781e-15, 1e-6);
    for (velocity, expected) in [(0.5, 0.449332), (3.0, 0.860075), (10.0, 0.845730)] {
        let found =
            collision("passive", &numbers, mass, radius, velocity, engine).map(|found| found.restitution);
        bench.check("e, passive", format!("E=1e9 R=1e-6 A=5e-10 v={velocity}"), expected, found, printed);
    }
    let sticks = collision("passive", &numbers, mass, radius, 0.4, engine);
    let found = sticks.map(|found| if found.regime == Regime::Stick { 0.0 } else { found.restitution });
    bench.check("e, passive", "E=1e9 R=1e-6 A=5e-10 v=0.4", 0.0, found, ROUND_OFF);
    bench.expect_from("the law of JKR, for no dissipation");
    let elastic = [("effective_modulus", 1e9), ("work_of_adhesion", 0.05), ("dissipative_time", 0.0)];
    let expected = normal("jkr", &elastic[..2]).and_then(|model| outcome(&model, wall(mass, radius), 3.0));
    let found = collision("passive", &elastic, mass, radius, 3.0, Method::Exact);
    let expected = expected.map_or(f64::NAN, |found| found.restitution);
    bench.check("e, A=0", "E=1e9 R=1e-6 v=3", expected, found.map(|found| found.restitution), INTEGRATED);
}
