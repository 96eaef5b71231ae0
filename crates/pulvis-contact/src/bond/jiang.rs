//! Bonds that break by an envelope of normal force, shear force and moment, after Jiang et al.

use pulvis_math::{Dimension, Mask, Real};

use super::memory::COLUMNS;
use super::parameters::with_common;
use super::{BondLoads, BreakingCriterion};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};

/// The bond breaks where shear force and moment leave an ellipse whose axes depend on the normal force.
///
/// ```text
/// R_s = f_s x (ln((R_nc + R_nt)/x))^n_s,   R_r = f_r a12 x (ln((R_nc + R_nt)/x))^n_r,   x = F_n + R_nt
/// intact while −R_nt < F_n < R_nc and (F_s/R_s)² + (M/R_r)² < 1
/// ```
///
/// M is the moment of bending and torsion together, and a12 the harmonic mean of the radii: the publications treat plane
/// systems. The envelope is closed at both ends of F_n.
///
/// # Source
/// M. J. Jiang et al., Mech. Mater. 55 (2012) and Granular Matter 15 (2013); the envelope is as other texts give it and could
/// not be confirmed against the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jiang {
    /// Tensile strength R_nt [N].
    pub tensile: f64,
    /// Compressive strength R_nc [N].
    pub compressive: f64,
    /// Factor f_s [1] and exponent n_s [1] of the shear strength.
    pub shear: [f64; 2],
    /// Factor f_r [1] and exponent n_r [1] of the moment strength.
    pub moment: [f64; 2],
}

impl Law for Jiang {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Bond,
        name: "jiang",
        summary: "elastic bond that breaks by an envelope of normal force, shear force and moment",
        equations: "\
springs as of `elastic-brittle`;  F_n = k_n (δ − δ_b),  F_s = k_s |ξ_s|,  M² = (k_b θ)² + (k_o φ)²
breaks unless −R_nt < F_n < R_nc and (F_s/R_s)² + (M/R_r)² < 1
R_s = f_s x (ln((R_nc + R_nt)/x))^n_s                x = F_n + R_nt
R_r = f_r a12 x (ln((R_nc + R_nt)/x))^n_r            a12: harmonic mean of the radii",
        source: "Jiang et al., Mech. Mater. 55 (2012); Granular Matter 15 (2013). The envelope could not be confirmed against the original; torsion as part of the moment and the length a12 are choices of this program (certainty C)",
        parameters: with_common![
            Parameter::number(
                "tensile_strength",
                "R_nt",
                Dimension::FORCE,
                Range::Positive,
                "tensile strength"
            ),
            Parameter::number(
                "compressive_strength",
                "R_nc",
                Dimension::FORCE,
                Range::Positive,
                "compressive strength, much larger than the tensile one",
            ),
            Parameter::number(
                "shear_factor",
                "f_s",
                Dimension::NONE,
                Range::Positive,
                "factor of the shear strength, about 1"
            ),
            Parameter::number(
                "shear_exponent",
                "n_s",
                Dimension::NONE,
                Range::Positive,
                "exponent of the shear strength, about 0.6"
            ),
            Parameter::number(
                "moment_factor",
                "f_r",
                Dimension::NONE,
                Range::Positive,
                "factor of the moment strength"
            ),
            Parameter::number(
                "moment_exponent",
                "n_r",
                Dimension::NONE,
                Range::Positive,
                "exponent of the moment strength"
            ),
        ],
        particle_quantities: &[],
        memory: COLUMNS,
        closed_form: "shear strength at two normal forces (law_bond)",
        example: "law = \"jiang\"\nnormal_stiffness = \"1e3 N/m\"\nshear_stiffness = \"500 N/m\"\nbending_stiffness = \"1e-4 J\"\ntensile_strength = \"1e-3 N\"\ncompressive_strength = \"1e-2 N\"\nshear_factor = 1.38\nshear_exponent = 0.59\nmoment_factor = 0.8\nmoment_exponent = 0.6",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self {
            tensile: values.number("tensile_strength")?,
            compressive: values.number("compressive_strength")?,
            shear: [values.number("shear_factor")?, values.number("shear_exponent")?],
            moment: [values.number("moment_factor")?, values.number("moment_exponent")?],
        })
    }
}

impl Jiang {
    /// R_s [N] and R_r over a12 [N] at a normal force [N] within the strengths.
    #[inline(always)]
    fn strengths<R: Real>(&self, normal: R) -> [R; 2] {
        let x = normal + R::splat(self.tensile);
        let ratio = R::splat(self.compressive + self.tensile) / x;
        let logarithm = ratio.ln();
        // No closure: these are not inlined by force.
        let ([shear, shear_exponent], [moment, moment_exponent]) = (self.shear, self.moment);
        [
            R::splat(shear) * x * logarithm.powf(shear_exponent),
            R::splat(moment) * x * logarithm.powf(moment_exponent),
        ]
    }
}

impl BreakingCriterion for Jiang {
    #[inline(always)]
    fn exceeded<R: Real>(&self, loads: &BondLoads<R>) -> R::Mask {
        let within = loads.normal.gt(R::splat(-self.tensile)) & loads.normal.lt(R::splat(self.compressive));
        let moment = loads.moment();
        let loaded = within & (loads.shear + moment).gt(R::zero());
        let mut holds = within;
        if loaded.any() {
            // Where the bond is not within its strengths, anything between them.
            let [shear, turning] = self.strengths(R::select(within, loads.normal, R::zero()));
            let (part, turn) = (loads.shear / shear, moment / (turning * loads.harmonic_radius));
            holds = within & (part * part + turn * turn).lt(R::one());
        }
        !holds
    }

    fn tensile_force(&self, _section_radius: f64) -> f64 {
        self.tensile
    }
}
