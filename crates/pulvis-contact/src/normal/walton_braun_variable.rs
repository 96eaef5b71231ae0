//! The latching spring of Walton and Braun whose unloading stiffness grows with the load.

use pulvis_math::{Dimension, Mask, Real};

use super::walton_braun::{K1, branch, unloading_line};
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Plastic loading along k1, un- and re-loading along a k2 that grows with the largest load, no attraction.
///
/// ```text
/// f  = k1 δ                     while the largest overlap D grows
/// f  = k2 (δ − δ_0) ≥ 0         un- and re-loading, δ_0 = (1 − k1/k2) D
/// k2 = k1 + S F_max = k1 (1 + S D)
/// ```
///
/// The restitution falls with the speed, e = √(ω_0/(ω_0 + S v)) with ω_0 = √(k1/m_r). k2 grows without bound, so the
/// time step follows from the loading that is expected.
///
/// # Source
/// O. R. Walton, R. L. Braun, J. Rheol. 30, 949 (1986); Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. (12), (C.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaltonBraunVariable {
    /// Stiffness of plastic loading k1 [N/m].
    pub k1: f64,
    /// Growth of k2 with the largest load, S [1/m].
    pub slope: f64,
}

impl Law for WaltonBraunVariable {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "walton-braun-variable",
        summary: "plastic contact whose unloading stiffness grows with the largest load",
        equations: "\
f  = k1 δ                    while the largest overlap D grows
f  = max(k2 (δ − δ_0), 0)    un-/re-loading,  δ_0 = (1 − k1/k2) D
k2 = k1 + S F_max = k1 (1 + S D)",
        source: "Walton & Braun, J. Rheol. 30, 949 (1986); Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. 12, C.1",
        parameters: &[
            K1,
            Parameter::number(
                "slope",
                "S",
                Dimension::INVERSE_LENGTH,
                Range::NonNegative,
                "growth of the unloading stiffness with the largest load, 0 to about 1e6",
            ),
        ],
        particle_quantities: &[],
        memory: &["overlap_max [m]"],
        closed_form: "restitution and duration in pulvis_contact::theory::walton_braun",
        example: "law = \"walton-braun-variable\"\nk1 = \"100 N/m\"\nslope = \"5e4 1/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { k1: values.number("k1")?, slope: values.number("slope")? })
    }
}

impl WaltonBraunVariable {
    /// k2 of a contact that was pressed to `loaded` [N/m].
    #[inline(always)]
    fn unloading_stiffness<R: Real>(&self, loaded: R) -> R {
        R::splat(self.k1) + R::splat(self.k1 * self.slope) * loaded
    }

    /// ½ k1 D δ_0 = ½ k1 S D³/(1 + S D) at the largest overlaps `after` minus that at `before`: no term is negative.
    #[inline(always)]
    fn plastic_work<R: Real>(&self, before: R, after: R) -> R {
        let (one, slope) = (R::one(), R::splat(self.slope));
        let cubes = after * after + after * before + before * before;
        let numerator = (after - before) * (cubes + slope * after * before * (after + before));
        let denominator = (one + slope * before) * (one + slope * after);
        R::splat(0.5 * self.k1 * self.slope) * numerator / denominator
    }
}

impl NormalLaw for WaltonBraunVariable {
    /// The largest overlap.
    type Memory<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NormalResponse<R> {
        let (depth, before) = (motion.depth, memory[0]);
        let loaded = before.max(depth);
        let k2 = self.unloading_stiffness(loaded);
        let force = unloading_line(self.k1, k2, depth, loaded).max(R::zero()).keep_where(motion.touching);
        let mut plastic = R::zero();
        if loaded.gt(before).any() {
            plastic = self.plastic_work(before, loaded);
        }
        memory[0] = loaded.keep_where(motion.touching);
        NormalResponse {
            dissipated_plastic: plastic,
            ..NormalResponse::elastic(
                motion,
                force,
                R::splat(0.5) * force * force / k2,
                k2.keep_where(force.gt(R::zero())),
            )
        }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        let k2 = self.unloading_stiffness(memory[0]);
        branch(overlap, memory[0], unloading_line(self.k1, k2, overlap, memory[0]), k2)
    }

    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        self.unloading_stiffness(expected_overlap(self.k1, pair, expected))
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    fn remembered_overlap(&self, memory: &[f64; 1]) -> Option<f64> {
        Some(memory[0])
    }
}

/// The overlap to which the expected loading presses a spring of the stiffness `k1` [m].
fn expected_overlap(k1: f64, pair: &Pair, expected: &ExpectedLoading) -> f64 {
    let of_speed = expected.speed * (pair.reduced_mass() / k1).sqrt();
    let of_overlap = expected.overlap * 0.5 * pair.harmonic_radius();
    of_speed.max(expected.force / k1).max(of_overlap)
}
