//! The Edinburgh elasto-plastic adhesive law.

use std::f64::consts::PI;

use pulvis_math::{Mask, Real, elementary};

use super::{NormalLaw, NormalResponse};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::functions::Power;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

mod curves;
mod entry;

use self::curves::Strain;

/// Plastic loading, unloading and adhesion along powers of the overlap.
///
/// ```text
/// f = −f_0 + k1 δ^n                   loading
/// f = −f_0 + k2 (δ^n − δ_p^n)         un- and re-loading, k2 = k1/(1 − λ_p), δ_p = λ_p^(1/n) δ_max
/// f = −f_0 − k_adh δ^x                wherever the line above lies below it
/// ```
///
/// Where a surface energy Δγ is given, k_adh follows from the largest overlap so that the pull at its end δ_min is
/// f_min = (3/2) π Δγ √(2 δ_p R), at most ½ k2 δ_p^n. On the adhesive limit δ_p shrinks so that the point stays on its
/// unloading curve; k_adh stays.
///
/// The publication's k1 and k_adh have units that depend on the exponents. Here k1 δ^n means k1 δ (δ/ℓ)^(n−1) with a
/// reference overlap ℓ, and k_adh likewise: with ℓ = 1 m the numbers are those of SI.
///
/// The constant pull f_0 acts from touch to touch, with a jump; publications write it with the other sign.
///
/// # Source
/// S. C. Thakur, J. P. Morrissey, J. Sun, J. F. Chen, J. Y. Ooi, Granular Matter 16, 383 (2014); J. P. Morrissey, PhD
/// thesis, Edinburgh (2013), for the exponent of the adhesive limit. Energies and the rule on the limit are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eepa {
    /// k1 [N/m^n].
    k1: f64,
    /// k2 [N/m^n].
    k2: f64,
    /// λ_p [1].
    lambda_p: f64,
    /// λ_p^(1/n) [1].
    plastic_share: f64,
    /// n.
    power: Power,
    /// n − 1.
    slope_power: Power,
    /// x.
    adhesion_power: Power,
    /// f_0 [N].
    f_0: f64,
    adhesion: Adhesion,
}

/// What the adhesive limit follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Adhesion {
    /// Δγ [J/m²].
    SurfaceEnergy(f64),
    /// k_adh [N/m^x].
    Stiffness(f64),
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EepaMemory<R> {
    /// Plastic overlap δ_p, positive in every contact [m].
    pub plastic_overlap: R,
    /// k_adh [N/m^x].
    pub adhesion_stiffness: R,
}

impl<R: Real> Memory<R> for EepaMemory<R> {
    const COLUMNS: usize = 2;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { plastic_overlap: column(0), adhesion_stiffness: column(1) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.plastic_overlap);
        column(1, self.adhesion_stiffness);
    }
}

impl NormalLaw for Eepa {
    type Memory<R: Real> = EepaMemory<R>;

    const JUMPS: bool = true;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut EepaMemory<R>) -> NormalResponse<R> {
        let (zero, depth, touching) = (R::zero(), motion.depth, motion.touching);
        let at = Strain { overlap: depth, power: self.power.of(depth) };
        let before = Strain { overlap: memory.plastic_overlap, power: self.power.of(memory.plastic_overlap) };
        let (mut plastic, mut k_adh) = (before, memory.adhesion_stiffness);
        let (mut lost_plastic, mut lost_adhesive) = (zero, zero);
        let grown = R::splat(self.plastic_share) * depth;
        let loads = grown.gt(before.overlap);
        if loads.any() {
            plastic.overlap = R::select(loads, grown, before.overlap);
            plastic.power = R::select(loads, R::splat(self.lambda_p) * at.power, before.power);
            k_adh = R::select(loads, self.adhesion_stiffness(&motion.pair, plastic), k_adh);
            let n = self.power.exponent();
            let coefficient = self.k2 * self.lambda_p * (1.0 - self.plastic_share) * n / (n + 1.0);
            let share = R::splat(1.0 / (self.lambda_p * self.plastic_share));
            let growth = at.power * at.overlap - before.power * before.overlap * share;
            lost_plastic = (R::splat(coefficient) * growth).keep_where(loads);
        }
        let line = R::splat(self.k2) * (at.power - plastic.power);
        let pull = k_adh * self.adhesion_power.of(depth);
        let on_limit = line.lt(-pull);
        let spring = line.max(-pull).keep_where(touching);
        let mut after = plastic;
        if on_limit.any() {
            let begins = self.limit_begins(plastic, k_adh);
            let begins = Strain { overlap: begins, power: self.power.of(begins) };
            let power = at.power + pull * R::splat(1.0 / self.k2);
            let overlap = self.power.inverse(power).min(plastic.overlap);
            after.overlap = R::select(on_limit, overlap, plastic.overlap);
            after.power = R::select(on_limit, power, plastic.power);
            let lost = self.limit_potential(begins, plastic, k_adh) - self.limit_potential(at, after, k_adh);
            lost_adhesive = lost.keep_where(on_limit);
        }
        let permanent = R::splat(-self.f_0).keep_where(touching);
        let force = spring + permanent;
        let last = R::splat(-self.f_0);
        *memory = EepaMemory {
            plastic_overlap: after.overlap.keep_where(touching),
            adhesion_stiffness: k_adh.keep_where(touching),
        };
        let slope = R::splat(self.k2 * self.power.exponent()) * self.slope_power.of(depth);
        NormalResponse {
            applied_force: spring + events::while_touching(motion, permanent, last),
            friction_reference: (spring + pull).max(zero).keep_where(touching),
            adhesive_potential: permanent * depth,
            dissipated_plastic: lost_plastic,
            dissipated_adhesive: lost_adhesive,
            ..NormalResponse::elastic(
                motion,
                force,
                self.stored_energy(at, after).keep_where(touching),
                slope.keep_where(touching),
            )
        }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &EepaMemory<f64>) -> (u8, &'static str) {
        if overlap <= 0.0 {
            return (0, "open");
        }
        if self.plastic_share * overlap >= memory.plastic_overlap {
            return (1, "k1");
        }
        let (at, plastic) = (self.power.of(overlap), self.power.of(memory.plastic_overlap));
        let pull = memory.adhesion_stiffness * self.adhesion_power.of(overlap);
        // After the response the point lies on the limit to round-off of the terms, not below it.
        let round_off = 16.0 * f64::EPSILON * self.k2 * (at + plastic);
        if self.k2 * (at - plastic) > -pull + round_off { (2, "k2") } else { (3, "limit") }
    }

    /// The steepest of the unloading curve and of the adhesive limit.
    ///
    /// With a surface energy the limit ends at f_min ≤ ½ k2 δ_p^n with δ_min ≥ δ_p/2^(1/n), so that its slope is at most
    /// x 2^(1/n − 1) k2 δ_p^(n−1), also after smaller loads.
    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let (n, x) = (self.power.exponent(), self.adhesion_power.exponent());
        let overlap = self.expected_overlap(pair, expected);
        let unloading = n * self.k2 * self.slope_power.of(overlap);
        let plastic = self.plastic_share * overlap;
        let limit = match self.adhesion {
            Adhesion::SurfaceEnergy(0.0) => 0.0,
            Adhesion::SurfaceEnergy(energy) => {
                // Deeper contacts than this pull less than the bound.
                let deepest = elementary::powf(
                    3.0 * PI * energy * pair.harmonic_radius().sqrt() / self.k2,
                    1.0 / (n - 0.5),
                );
                let slope = self.slope_power.of(plastic.min(deepest));
                x * elementary::powf(2.0, 1.0 / n - 1.0) * self.k2 * slope
            }
            Adhesion::Stiffness(stiffness) => {
                let plastic = Strain { overlap: plastic, power: self.power.of(plastic) };
                let begins = self.limit_begins(plastic, stiffness);
                x * stiffness * elementary::powf(begins, x - 1.0)
            }
        };
        unloading.max(limit)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;
}
