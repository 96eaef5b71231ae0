//! Walton and Braun's spring with a pull-off force that grows with the consolidation load, after Molerus.

use pulvis_math::{Dimension, Mask, Real};

use super::walton_braun::{K1, K2};
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// Plastic loading along k1, unloading along k2, and a pull-off force that follows from the largest load.
///
/// ```text
/// f    = k1 δ − F_H0                 while the largest overlap D grows
/// f    = k2 (δ − o) − F_H0           un- and re-loading, force-free overlap o = (1 − k1/k2) D
/// f    = −κ k1 D_max − F_H0 = −F_H   plateau, wherever the line lies below it
/// F_H  = (1 + κ) F_H0 + κ F_N        Molerus' pull-off force,  κ = p_vdw/p_f
/// ```
///
/// F_N = k1 D_max − F_H0 is the largest external load: the two expressions of the pull-off force are the same. Re-loading
/// from the plateau follows k2 with o lowered so that the point lies on its line; F_H stays that of the largest load.
/// The bodies part at δ = 0, where the force jumps and what the contact still stores is lost.
///
/// # Source
/// O. Molerus, Powder Technol. 12, 259 (1975) for the pull-off force. Loading, unloading and the plateau are a choice of this
/// program: the publication gives no law of the force over the overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Molerus {
    /// Stiffness of plastic loading k1 [N/m].
    k1: f64,
    /// Un- and re-loading stiffness k2 [N/m].
    k2: f64,
    /// p_vdw/p_f [1].
    kappa: f64,
    /// Pull-off force of a contact without load F_H0 [N].
    f_h0: f64,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MolerusMemory<R> {
    /// Force-free overlap o without F_H0; positive in every contact [m].
    pub force_free_overlap: R,
    /// κ k1 D_max [N].
    pub pull_off_force: R,
}

impl<R: Real> Memory<R> for MolerusMemory<R> {
    const COLUMNS: usize = 2;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { force_free_overlap: column(0), pull_off_force: column(1) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.force_free_overlap);
        column(1, self.pull_off_force);
    }
}

const fn pressure(name: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter {
    Parameter::number(name, symbol, Dimension::PRESSURE, Range::Positive, meaning)
}

impl Law for Molerus {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "molerus",
        summary: "plastic contact whose pull-off force grows with the consolidation load",
        equations: "\
f   = k1 δ − F_H0                   while the largest overlap D grows
f   = k2 (δ − o) − F_H0 ≥ −F_H      un-/re-loading,  o = (1 − k1/k2) D
F_H = (1 + κ) F_H0 + κ F_N          pull-off force,  κ = p_vdw/p_f,  F_N = k1 D_max − F_H0",
        source: "Molerus, Powder Technol. 12, 259 (1975), for the pull-off force, which could not be confirmed against the original; loading, unloading and the plateau at -F_H are choices of this program",
        parameters: &[
            K1,
            K2,
            pressure(
                "vdw_pressure",
                "p_vdw",
                "van der Waals pressure in the flattened contact, 1e7 to 1e8 Pa",
            ),
            pressure("yield_pressure", "p_f", "pressure at which the contact flows, 1e8 to 1e9 Pa"),
            Parameter::number(
                "f_h0",
                "F_H0",
                Dimension::FORCE,
                Range::NonNegative,
                "pull-off force of a contact that was never pressed",
            ),
        ],
        particle_quantities: &[],
        memory: &["force_free_overlap [m]", "pull_off_force [N]"],
        closed_form: "pull-off force after a load (law_plastic)",
        example: "law = \"molerus\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\"\nvdw_pressure = \"3e7 Pa\"\nyield_pressure = \"3e8 Pa\"\nf_h0 = \"1e-6 N\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let (vdw, yields) = (values.number("vdw_pressure")?, values.number("yield_pressure")?);
        if vdw >= yields {
            return Err(InvalidParameter::Inconsistent {
                name: "vdw_pressure",
                found: format!("{vdw} Pa"),
                expected: format!("less than yield_pressure = {yields} Pa"),
                reason: "otherwise adhesion alone makes the contact flow without end",
            });
        }
        let kappa = vdw / yields;
        let (k1, k2) = (values.number("k1")?, values.number("k2")?);
        let least = (1.0 + kappa) * k1;
        if k2 < least {
            return Err(InvalidParameter::Inconsistent {
                name: "k2",
                found: format!("{k2} N/m"),
                expected: format!("at least (1 + vdw_pressure/yield_pressure) k1 = {least} N/m"),
                reason: "otherwise the bodies part before the pull-off force is reached",
            });
        }
        Ok(Self { k1, k2, kappa, f_h0: values.number("f_h0")? })
    }
}

impl Molerus {
    /// Force-free overlap over the largest one, 1 − k1/k2 [1].
    fn plastic_share(&self) -> f64 {
        1.0 - self.k1 / self.k2
    }
}

impl NormalLaw for Molerus {
    type Memory<R: Real> = MolerusMemory<R>;

    const JUMPS: bool = true;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut MolerusMemory<R>) -> NormalResponse<R> {
        let (zero, depth, touching) = (R::zero(), motion.depth, motion.touching);
        let before = memory.force_free_overlap;
        let loaded = before.max(R::splat(self.plastic_share()) * depth);
        let pull_off = memory.pull_off_force.max(R::splat(self.kappa * self.k1) * depth);
        let line = R::splat(self.k2) * (depth - loaded);
        let on_plateau = line.lt(-pull_off);
        let spring = line.max(-pull_off);
        let on_line = depth + pull_off * R::splat(1.0 / self.k2);
        let after = R::select(on_plateau, on_line.min(loaded), loaded);
        // Loading loses ½ k1 D o; on the plateau the line moves by loaded − after.
        let plastic = R::splat(0.5 * self.k1 / self.plastic_share()) * (loaded - before) * (loaded + before);
        let mut adhesive = pull_off * (loaded - after);
        let stored = spring * spring * R::splat(0.5 / self.k2);
        let permanent = R::splat(-self.f_h0).keep_where(touching);
        let pressed = spring.keep_where(touching);
        let parts = before.gt(zero) & !touching;
        if parts.any() {
            adhesive += stored.keep_where(parts);
        }
        let last = spring - R::splat(self.f_h0);
        *memory = MolerusMemory {
            force_free_overlap: after.keep_where(touching),
            pull_off_force: pull_off.keep_where(touching),
        };
        NormalResponse {
            applied_force: pressed + events::while_touching(motion, permanent, last),
            friction_reference: (pressed + pull_off).keep_where(touching),
            adhesive_potential: permanent * depth,
            dissipated_plastic: plastic,
            dissipated_adhesive: adhesive,
            ..NormalResponse::elastic(
                motion,
                pressed + permanent,
                stored.keep_where(touching),
                R::splat(self.k2),
            )
        }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &MolerusMemory<f64>) -> (u8, &'static str) {
        let before = memory.force_free_overlap;
        let line = self.k2 * (overlap - before);
        // After the response the point lies on the plateau to round-off of the line's two terms, not below it.
        let round_off = 8.0 * f64::EPSILON * self.k2 * (overlap.abs() + before);
        if overlap <= 0.0 {
            (0, "open")
        } else if self.plastic_share() * overlap >= before {
            (1, "k1")
        } else if line > -memory.pull_off_force + round_off {
            (2, "k2")
        } else {
            (3, "plateau")
        }
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.k2
    }
}
