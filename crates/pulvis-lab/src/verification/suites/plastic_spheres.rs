//! Elastic-plastic spheres.

use pulvis_contact::ContactModel;
use pulvis_contact::catalogue::Values;
use pulvis_math::elementary;

use super::{Bench, FLAT, INTEGRATED, ROUND_OFF, Suite, Tolerance};
use crate::verification::contact::{Path, normal, normal_by, outcome, restitution, values, wall};
use crate::verification::data::Row;
use crate::verification::search::{border, lowest};

pub(super) const SUITES: &[Suite] =
    &[("thornton-ning", thornton_ning), ("tomas", tomas), ("rathbone", rathbone)];

/// An expected value that was found by quadrature or a root.
const QUADRATURE: Tolerance = Tolerance { relative: 1e-9, reason: "quadrature of the expected value" };

const SLOPE: Tolerance = Tolerance { relative: 1e-6, reason: "difference quotient" };

fn by_thornton_ning(row: &Row, variant: &str) -> Option<ContactModel> {
    let numbers = values(&[
        ("effective_modulus", row.get("E")?),
        ("yield_pressure", row.get("p_y")?),
        ("work_of_adhesion", row.get("work_of_adhesion").unwrap_or(0.0)),
    ]);
    normal_by("thornton-ning", &numbers.with_choice("variant", variant))
}

/// The overlap at which a virgin contact begins to yield [m].
fn yields(path: &Path, radius: f64) -> Option<f64> {
    let elastic = path.branch(1e-9 * radius);
    border(1e-9 * radius, 0.3 * radius, |overlap| path.branch(overlap) == elastic)
}

fn thornton_ning(bench: &mut Bench) {
    bench.rows("thornton_ning", &["d_max", "F_max", "F_pulloff", "R_p", "d_p", "e"], QUADRATURE, |row| {
        let (model, radius) = (by_thornton_ning(row, "closed")?, row.get("R")?);
        let bodies = wall(row.get("m_r")?, radius);
        let outcome = outcome(&model, bodies, row.get("v")?)?;
        let largest = outcome.overlap_max;
        let mut path = Path::at_wall(&model, radius);
        path.go(largest);
        let pull_off = || lowest(0.0, largest, |overlap| path.force(overlap)).1;
        // δ = δ_p + a²/R_p − √(2 π Γ a/E*), at two points of unloading.
        let ratio = 2.0 * std::f64::consts::PI * row.get("work_of_adhesion")? / row.get("E")?;
        let [(a, x), (b, y)] = [largest, 0.8 * largest].map(|overlap| {
            let area = path.normal(overlap).contact_radius;
            (area * area, overlap + (ratio * area).sqrt())
        });
        let curvature = (x - y) / (a - b);
        match row.quantity {
            "d_max" => Some(largest),
            "F_max" => Some(path.force(largest)),
            "F_pulloff" => Some(pull_off()),
            "R_p" => Some(1.0 / curvature),
            "d_p" => Some(x - a * curvature),
            _ => Some(outcome.restitution),
        }
    });
    bench.rows("thornton_ning", &["a_yield"], FLAT, |row| {
        let radius = row.get("R")?;
        let path = Path::at_wall(&by_thornton_ning(row, "closed")?, radius);
        Some(path.normal(yields(&path, radius)?).contact_radius)
    });
    bench.rows("thornton_ning", &["slope_published", "slope_closed"], SLOPE, |row| {
        let variant = if row.quantity == "slope_closed" { "closed" } else { "published" };
        let (radius, modulus, adhesion) = (row.get("R")?, row.get("E")?, row.get("work_of_adhesion")?);
        let path = Path::at_wall(&by_thornton_ning(row, variant)?, radius);
        let area = 1.5 * path.normal(yields(&path, radius)?).contact_radius;
        let overlap = area * area / radius - (2.0 * std::f64::consts::PI * adhesion * area / modulus).sqrt();
        let step = 1e-4 * overlap;
        Some((path.force(overlap + step) - path.force(overlap - step)) / (2.0 * step))
    });
    let (modulus, radius, pressure, mass) = (1e9, 1e-4, 1e7, 8.377580409572782e-9);
    bench.rows("thornton_no_adhesion", &["e"], INTEGRATED, |row| {
        let numbers = values(&[("effective_modulus", modulus), ("yield_pressure", pressure)]);
        let model = normal_by("thornton-ning", &numbers.with("work_of_adhesion", 0.0))?;
        let velocity = 0.011034553175933454 / row.get("vy_over_v")?;
        restitution(&model, wall(mass, radius), velocity)
    });
    bench.rows("thornton_no_adhesion", &["v_yield"], QUADRATURE, |row| {
        let radius = row.get("R")?;
        let mut path = Path::at_wall(&by_thornton_ning(row, "closed")?, radius);
        let overlap = yields(&path, radius)?;
        path.go(overlap);
        Some((2.0 * path.stored / row.get("m_r")?).sqrt())
    });
}

fn by_tomas(row: &Row) -> Option<ContactModel> {
    let variant = row.model.strip_prefix("tomas_")?;
    let numbers: Values = values(&[
        ("effective_modulus", row.get("E")?),
        ("yield_pressure", row.get("p_f")?),
        ("vdw_pressure", row.get("p_vdw")?),
        ("hamaker", row.get("C_H")?),
        ("a0", 0.336e-9),
    ]);
    normal_by("tomas", &numbers.with_choice("variant", variant))
}

fn tomas(bench: &mut Bench) {
    for model in ["tomas_published", "tomas_continuous"] {
        bench.rows(
            model,
            &["F_H0", "F_load", "F_pulloff", "F_unload_mid", "F_reload_mid", "F_detach_half_nm"],
            QUADRATURE,
            |row| {
                let (path, largest) = (Path::at_wall(&by_tomas(row)?, row.get("r")?), row.get("h_U")?);
                if row.quantity == "F_H0" {
                    return Some(-path.force(0.0));
                }
                let mut path = path;
                let load = path.go(largest).normal_force;
                let (area, pull_off) = lowest(0.0, largest, |overlap| path.force(overlap));
                let middle = 0.5 * (area + largest);
                match row.quantity {
                    "F_load" => Some(load),
                    "F_pulloff" => Some(pull_off),
                    "F_unload_mid" => Some(path.force(middle)),
                    "F_detach_half_nm" => Some(path.force(area - 0.5e-9)),
                    _ => {
                        path.go(area - 1e-9 * area);
                        Some(path.force(middle))
                    }
                }
            },
        );
        bench.rows(model, &["h_A"], FLAT, |row| {
            let (mut path, largest) = (Path::at_wall(&by_tomas(row)?, row.get("r")?), row.get("h_U")?);
            path.go(largest);
            Some(lowest(0.0, largest, |overlap| path.force(overlap)).0)
        });
        bench.rows(model, &["h_f"], ROUND_OFF, |row| {
            let radius = row.get("r")?;
            yields(&Path::at_wall(&by_tomas(row)?, radius), radius)
        });
    }
}

fn rathbone(bench: &mut Bench) {
    let model = |modulus: f64, stress: f64, poisson: f64| {
        let numbers = [("effective_modulus", modulus), ("yield_stress", stress), ("poisson_ratio", poisson)];
        normal("rathbone", &numbers)
    };
    bench.rows("fe_jackson_green", &["force"], ROUND_OFF, |row| {
        let model = model(row.get("E")?, row.get("S_y")?, row.get("nu")?)?;
        Some(Path::at_wall(&model, row.get("R")?).force(row.get("omega")?))
    });
    bench.rows("fe_ekk_unload", &["residual_ratio", "exponent"], QUADRATURE, |row| {
        let (modulus, stress, poisson, radius) = (2.2e11, 1e9, 0.3, 1e-2);
        let critical =
            std::f64::consts::PI * 1.295 * elementary::exp(0.736 * poisson) * stress / (2.0 * modulus);
        let largest = row.get("wmax_over_wc")? * critical * critical * radius;
        let mut path = Path::at_wall(&model(modulus, stress, poisson)?, radius);
        let top = path.go(largest).normal_force;
        let free = border(largest, 0.0, |overlap| path.force(overlap) > 0.0)?;
        if row.quantity == "residual_ratio" {
            return Some(free / largest);
        }
        let half = path.force(0.5 * (free + largest));
        Some(elementary::ln(top / half) / std::f64::consts::LN_2)
    });
}
