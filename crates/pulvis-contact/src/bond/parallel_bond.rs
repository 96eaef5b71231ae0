//! Bonds that break by the stress at the edge of their cross-section.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Real};

use super::memory::COLUMNS;
use super::parameters::with_common;
use super::springs::{BondSprings, Section};
use super::{BondLoads, BreakingCriterion};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};

/// The bond breaks where the largest stress in its round cross-section exceeds a strength.
///
/// ```text
/// σ = |M_b| r/I − F_n/A > σ_c,   τ = F_s/A + |M_o| r/J > τ_c
/// ```
///
/// # Source
/// D. O. Potyondy, P. A. Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329 (2004), as public codes write it; not confirmed
/// against the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ParallelBond {
    /// Tensile strength σ_c [Pa].
    pub tensile: f64,
    /// Shear strength τ_c [Pa]; may be infinite.
    pub shear: f64,
}

impl Law for ParallelBond {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Bond,
        name: "parallel-bond",
        summary: "elastic bond with a cross-section that breaks by stress",
        equations: "\
springs as of `elastic-brittle`, as a beam or per area;  F_n = k_n (δ − δ_b),  F_s = k_s |ξ_s|
breaks where |M_b| r/I − F_n/A > σ_c  or  F_s/A + |M_o| r/J > τ_c;   M_b = k_b θ,  M_o = k_o φ
A = π r²,  I = A r²/4,  J = 2 I;  r: bond_radius, or radius_ratio times the smaller radius",
        source: "Potyondy & Cundall, Int. J. Rock Mech. Min. Sci. 41, 1329 (2004), as other texts give it; not confirmed against the original (certainty B)",
        parameters: with_common![
            Parameter::number(
                "tensile_strength",
                "σ_c",
                Dimension::PRESSURE,
                Range::Positive,
                "largest tensile stress; finite, because it bounds how far the bond acts",
            ),
            Parameter::number(
                "shear_strength",
                "τ_c",
                Dimension::PRESSURE,
                Range::Positive,
                "largest shear stress",
            )
            .or(f64::INFINITY)
            .or_infinite(),
        ],
        particle_quantities: &[],
        memory: COLUMNS,
        closed_form: "stress of a bent and of a twisted bond when it breaks (law_bond)",
        example: "law = \"parallel-bond\"\nnormal_stiffness_per_area = \"1e9 Pa/m\"\nshear_stiffness_per_area = \"4e8 Pa/m\"\nradius_ratio = 0.5\ntensile_strength = \"1e3 Pa\"\nshear_strength = \"2e3 Pa\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { tensile: values.number("tensile_strength")?, shear: values.number("shear_strength")? })
    }
}

impl BreakingCriterion for ParallelBond {
    #[inline(always)]
    fn exceeded<R: Real>(&self, loads: &BondLoads<R>) -> R::Mask {
        let radius = loads.section_radius;
        let area = R::splat(PI) * (radius * radius);
        // r/I = 4/(A r), r/J = 2/(A r): both stresses times the area.
        let tension = R::splat(4.0) * loads.bending / radius - loads.normal;
        let shear = loads.shear + R::splat(2.0) * loads.torsion / radius;
        tension.gt(R::splat(self.tensile) * area) | shear.gt(R::splat(self.shear) * area)
    }

    fn tensile_force(&self, section_radius: f64) -> f64 {
        self.tensile * PI * section_radius * section_radius
    }

    fn check_springs(&self, springs: &BondSprings) -> Result<(), InvalidParameter> {
        match springs.section {
            Section::None => Err(InvalidParameter::Missing { name: "bond_radius" }),
            _ => Ok(()),
        }
    }
}
