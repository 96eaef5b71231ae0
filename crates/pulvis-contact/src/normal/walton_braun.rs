//! The latching spring of Walton and Braun.

use pulvis_math::{Dimension, Real};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Plastic loading along k1, un- and re-loading along k2, no attraction.
///
/// ```text
/// f = k1 δ                      while the largest overlap D grows
/// f = k2 (δ − δ_0) ≥ 0          un- and re-loading, force-free overlap δ_0 = (1 − k1/k2) D
/// ```
///
/// The coefficient of restitution is √(k1/k2) at any speed. Between δ_0 and touching the bodies are free of force; the
/// contact remembers D until δ ≤ 0.
///
/// # Source
/// O. R. Walton, R. L. Braun, J. Rheol. 30, 949 (1986); Singh, Magnanimo & Luding, arXiv:1503.03720, eq. (6).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaltonBraun {
    /// Stiffness of plastic loading k1 [N/m].
    pub k1: f64,
    /// Un- and re-loading stiffness k2 [N/m].
    pub k2: f64,
}

/// Stiffness of plastic loading.
pub(super) const K1: Parameter = Parameter::number(
    "k1",
    "k₁",
    Dimension::STIFFNESS,
    Range::Positive,
    "stiffness of plastic (virgin) loading",
);
/// Stiffness of un- and re-loading.
pub(super) const K2: Parameter = Parameter::number(
    "k2",
    "k₂",
    Dimension::STIFFNESS,
    Range::Positive,
    "un- and re-loading stiffness, at least k1",
);

impl Law for WaltonBraun {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "walton-braun",
        summary: "plastic contact with one stiffness for loading and one for unloading",
        equations: "\
f = k1 δ                    while the largest overlap D grows
f = max(k2 (δ − δ_0), 0)    un-/re-loading,  δ_0 = (1 − k1/k2) D
e = √(k1/k2)                restitution at any speed",
        source: "Walton & Braun, J. Rheol. 30, 949 (1986); Singh, Magnanimo & Luding, arXiv:1503.03720, eq. 6",
        parameters: &[K1, K2],
        particle_quantities: &[],
        memory: &["overlap_max [m]"],
        closed_form: "restitution and duration in pulvis_contact::theory::walton_braun",
        example: "law = \"walton-braun\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Self { k1: values.number("k1")?, k2: values.number("k2")? }.checked()
    }
}

impl WaltonBraun {
    fn checked(self) -> Result<Self, InvalidParameter> {
        if self.k2 < self.k1 {
            return Err(InvalidParameter::Inconsistent {
                name: "k2",
                found: format!("{} N/m", self.k2),
                expected: format!("k2 >= k1 = {} N/m", self.k1),
                reason: "a contact unloads at least as stiffly as it was loaded, otherwise it creates energy",
            });
        }
        Ok(self)
    }
}

/// The line of un- and re-loading of a contact that was pressed to `loaded`: k2 (δ − δ_0), written so that it meets the
/// line of loading without round-off.
#[inline(always)]
pub(super) fn unloading_line<R: Real>(k1: f64, k2: R, overlap: R, loaded: R) -> R {
    k2 * (overlap - loaded) + R::splat(k1) * loaded
}

/// The branch of a latching spring that was pressed to `loaded` and stands on the unloading `line` [N].
pub(super) fn branch(overlap: f64, loaded: f64, line: f64, k2: f64) -> (u8, &'static str) {
    if overlap <= 0.0 {
        (0, "open")
    } else if overlap >= loaded {
        (1, "k1")
    } else if line > 4.0 * f64::EPSILON * k2 * (overlap + loaded) {
        (2, "k2")
    } else {
        (3, "free")
    }
}

impl NormalLaw for WaltonBraun {
    /// The largest overlap.
    type Memory<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NormalResponse<R> {
        let (depth, before) = (motion.depth, memory[0]);
        let loaded = before.max(depth);
        let line = unloading_line(self.k1, R::splat(self.k2), depth, loaded);
        let force = line.max(R::zero()).keep_where(motion.touching);
        // Between the lines of loading and unloading lies ½ k1 D δ_0.
        let loss = R::splat(0.5 * self.k1 * (1.0 - self.k1 / self.k2));
        memory[0] = loaded.keep_where(motion.touching);
        NormalResponse {
            dissipated_plastic: loss * (loaded - before) * (loaded + before),
            ..NormalResponse::elastic(
                motion,
                force,
                force * force * R::splat(0.5 / self.k2),
                R::splat(self.k2).keep_where(force.gt(R::zero())),
            )
        }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        let line = unloading_line(self.k1, self.k2, overlap, memory[0]);
        branch(overlap, memory[0], line, self.k2)
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.k2
    }

    fn remembered_overlap(&self, memory: &[f64; 1]) -> Option<f64> {
        Some(memory[0])
    }
}
