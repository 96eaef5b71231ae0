//! Bonds that break by force or moment, mode by mode.

use pulvis_math::{Dimension, Real};

use super::memory::COLUMNS;
use super::parameters::{MOMENT, with_common};
use super::{BondLoads, BreakingCriterion};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};

/// The bond breaks where the force or moment of any of its springs exceeds the strength of that mode.
///
/// The bonds of Kempton et al. are these with a normal stiffness alone, beside the normal law `kempton`; an extension ε_b
/// at which such a bond breaks is the tensile strength k_n ε_b.
///
/// # Source
/// The generic elastic-brittle bond; D. O. Potyondy, P. A. Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329 (2004) for bonds
/// in discrete element models. Event weights and exact energies are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticBrittle {
    /// Tensile strength F_t [N].
    pub tensile: f64,
    /// Compressive strength F_c [N]; may be infinite.
    pub compressive: f64,
    /// Shear strength F_s [N]; may be infinite.
    pub shear: f64,
    /// Bending strength M_b [N m]; may be infinite.
    pub bending: f64,
    /// Torsion strength M_o [N m]; may be infinite.
    pub torsion: f64,
}

impl Law for ElasticBrittle {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Bond,
        name: "elastic-brittle",
        summary: "elastic bond that breaks by force or moment, mode by mode",
        equations: "\
f   = k_n (δ − δ_b) + γ_n dδ/dt       normal force; δ_b: overlap when the bond formed
F_s = −k_s ξ_s − γ_s v_s              shear; ξ_s, θ, φ turn with the pair at constant length
M_b = −k_b θ − γ_b dθ/dt              bending;  M_o = −k_o φ − γ_o dφ/dt   torsion
breaks where −k_n (δ − δ_b) > F_t, k_n (δ − δ_b) > F_c, k_s |ξ_s| > F_s, k_b |θ| > M_b or k_o |φ| > M_o
beam: k_n = E A/L, k_s = 12 E I/((1 + Φ) L³), k_b = E I/L, k_o = G J/L at mid-length L/2
per area: k_n = K_n A, k_s = K_s A, k_b = K_n I, k_o = K_s J;  A = π r², I = A r²/4, J = 2 I",
        source: "generic; bonds of discrete elements after Potyondy & Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329 (2004), not at hand; with a normal stiffness alone beside the normal law `kempton` it is the bond of Kempton, Pinson, Chew, Zulli & Yu, Powder Technol. 223, 19 (2012), of whose bonds the composition is confirmed, but neither magnitudes nor criterion (certainty C)",
        parameters: with_common![
            Parameter::number(
                "tensile_strength",
                "F_t",
                Dimension::FORCE,
                Range::Positive,
                "largest tensile force; finite, because it bounds how far the bond acts",
            ),
            Parameter::number(
                "compressive_strength",
                "F_c",
                Dimension::FORCE,
                Range::Positive,
                "largest compressive force",
            )
            .or(f64::INFINITY)
            .or_infinite(),
            Parameter::number(
                "shear_strength",
                "F_s",
                Dimension::FORCE,
                Range::Positive,
                "largest shear force"
            )
            .or(f64::INFINITY)
            .or_infinite(),
            Parameter::number(
                "bending_strength",
                "M_b",
                MOMENT,
                Range::Positive,
                "largest bending moment (1 J = 1 N m)"
            )
            .or(f64::INFINITY)
            .or_infinite(),
            Parameter::number(
                "torsion_strength",
                "M_o",
                MOMENT,
                Range::Positive,
                "largest torsion moment (1 J = 1 N m)"
            )
            .or(f64::INFINITY)
            .or_infinite(),
        ],
        particle_quantities: &[],
        memory: COLUMNS,
        closed_form: "frequency and breaking speed of two bonded spheres, stiffness of a cantilever of bonded spheres (law_bond, bonded_beam)",
        example: "law = \"elastic-brittle\"\nnormal_stiffness = \"1e3 N/m\"\nshear_stiffness = \"500 N/m\"\nbending_stiffness = \"1e-4 J\"\ntorsion_stiffness = \"5e-5 J\"\ntensile_strength = \"1e-3 N\"\nshear_strength = \"2e-3 N\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self {
            tensile: values.number("tensile_strength")?,
            compressive: values.number("compressive_strength")?,
            shear: values.number("shear_strength")?,
            bending: values.number("bending_strength")?,
            torsion: values.number("torsion_strength")?,
        })
    }
}

impl BreakingCriterion for ElasticBrittle {
    #[inline(always)]
    fn exceeded<R: Real>(&self, loads: &BondLoads<R>) -> R::Mask {
        (-loads.normal).gt(R::splat(self.tensile))
            | loads.normal.gt(R::splat(self.compressive))
            | loads.shear.gt(R::splat(self.shear))
            | loads.bending.gt(R::splat(self.bending))
            | loads.torsion.gt(R::splat(self.torsion))
    }

    fn tensile_force(&self, _section_radius: f64) -> f64 {
        self.tensile
    }
}
