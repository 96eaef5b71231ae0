//! The description of the law.

use pulvis_math::Dimension;

use super::table::MOST_POINTS;
use crate::catalogue::{LawEntry, Parameter, Range, Role};

/// A list of overlaps [m] or forces [N].
const fn curve(
    name: &'static str,
    symbol: &'static str,
    dimension: Dimension,
    meaning: &'static str,
) -> Parameter {
    Parameter::numbers(name, symbol, dimension, Range::NonNegative, (2, MOST_POINTS), meaning)
}

/// See [`Tabulated`](super::Tabulated).
pub(super) const ENTRY: LawEntry = LawEntry {
    role: Role::Normal,
    name: "tabulated",
    summary: "curves of loading and unloading given point by point, from a measurement or a finite element computation",
    equations: "\
f = L(δ)                      while the largest overlap D grows; L straight between its points
f = g(δ − δ_p) ≥ 0            un-/re-loading along the unloading curve g, moved to where loading ended
δ_p = D − g⁻¹(L(D))           plastic part of the overlap;  the energy ∫g dδ is stored, ∫L dδ_p is lost
g' >= L' at the same force    or the curves are refused: a closed path would create energy
f/R*² over δ/R*               is one curve for all effective radii R* if a reference radius is given",
    source: "elastic and plastic element in series: Johnson, Contact Mechanics (1985), section 6.4; similarity: Cheng & Cheng, Mater. Sci. Eng. R 44, 91 (2004)",
    parameters: &[
        curve(
            "loading_overlap",
            "δ_L",
            Dimension::LENGTH,
            "overlaps of the loading curve, from 0 on and growing",
        ),
        curve("loading_force", "f_L", Dimension::FORCE, "its forces, from 0 on and growing"),
        curve(
            "unloading_overlap",
            "δ_U",
            Dimension::LENGTH,
            "overlaps of an unloading curve, growing; only their differences count. Without it loading is elastic",
        )
        .optional(),
        curve("unloading_force", "f_U", Dimension::FORCE, "its forces, from 0 on and growing").optional(),
        Parameter::number(
            "reference_radius",
            "R_ref",
            Dimension::LENGTH,
            Range::Positive,
            "effective radius of the bodies of the curves, of a sphere at a plane its radius; without it bodies of all radii have these curves",
        )
        .optional(),
    ],
    particle_quantities: &[],
    memory: &["overlap_max [m]"],
    closed_form: "restitution from the areas under the curves, √(k1/k2) of straight ones (Walton & Braun 1986)",
    example: "\
law = \"tabulated\"
loading_overlap = [\"0 m\", \"1e-6 m\", \"3e-6 m\", \"6e-6 m\", \"1e-5 m\"]
loading_force = [\"0 N\", \"5e-5 N\", \"2e-4 N\", \"4.7e-4 N\", \"8.7e-4 N\"]
unloading_overlap = [\"7e-6 m\", \"7.5e-6 m\", \"8.5e-6 m\", \"1e-5 m\"]
unloading_force = [\"0 N\", \"6e-5 N\", \"3.1e-4 N\", \"8.7e-4 N\"]",
};
