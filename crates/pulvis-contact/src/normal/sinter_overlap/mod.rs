//! Contacts whose plastic overlap grows with time, as in sintering.

use pulvis_math::{Mask, Real};

use super::{NormalLaw, NormalResponse};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

mod entry;

/// An elastic contact about a plastic overlap δ_p that grows while it is pressed, and a constant sintering force:
///
/// ```text
/// f   = k2 (δ − δ_p) − σ_s a12          k2 = k1 (1 + s δ_p),  s = (kp/k1 − 1)/(φ_f a12),  δ_p <= φ_f a12
/// f_e <= k1 δ                           plastic loading, δ_p >= δ − 1/s
/// f_e >= −kc δ                          tensile limit, on which δ_p shrinks
/// dδ_p/dt = 2 r f_e/σ_s                 constant,  r f_e/(0.375 σ_s (δ/a12)²) after Parhami and McMeeking
/// ```
///
/// The two lines of loading, k1 δ and kp (δ − φ_f a12), are those of Luding. At fixed overlap growth is exact for steps of
/// any length: (δ − δ_p)/(1 + s δ_p) falls as exp(−μ (1 + s δ) dt), μ = 2 r k1/σ_s or as Parhami and McMeeking have it. What
/// the elastic energy f_e²/(2 k2) loses thereby is booked as plastic: never negative, because of plastic loading.
///
/// The automatic time step resolves μ (1 + s δ) of the largest plastic overlap. After Parhami and McMeeking smaller necks grow
/// faster; those that are small grow at once.
///
/// The sintering force sets in at touch and ends there, with the weights of events; its potential is −σ_s a12 δ.
///
/// # Source
/// Growth: F. Parhami, R. M. McMeeking, Mech. Mater. 27, 111 (1998), in the form of public code; energies and the exact
/// step are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SinterOverlap {
    k1: f64,
    kp: f64,
    kc: f64,
    phi_f: f64,
    sinter_tension: f64,
    rate: f64,
    parhami: bool,
}

/// The contact of one pair, with its scales.
#[derive(Clone, Copy)]
struct Scales<R> {
    /// s [1/m].
    slope: R,
    /// 1/s [m].
    elastic: R,
    /// Largest plastic overlap [m].
    most: R,
    /// 1/a12 [1/m].
    inverse_harmonic: R,
}

/// A plastic overlap, and what was lost on the way there.
#[derive(Clone, Copy)]
struct Reached<R> {
    plastic: R,
    lost_plastic: R,
    lost_adhesive: R,
}

impl SinterOverlap {
    /// 1/s over a12 [1].
    fn elastic_part(&self) -> f64 {
        self.phi_f * self.k1 / (self.kp - self.k1)
    }

    #[inline(always)]
    fn scales<R: Real>(&self, pair: &Pair<R>) -> Scales<R> {
        let inverse_harmonic = pair.inverse_harmonic_radius();
        let harmonic = R::one() / inverse_harmonic;
        Scales {
            slope: R::splat(1.0 / self.elastic_part()) * inverse_harmonic,
            elastic: R::splat(self.elastic_part()) * harmonic,
            most: R::splat(self.phi_f) * harmonic,
            inverse_harmonic,
        }
    }

    /// k2 at a plastic overlap.
    #[inline(always)]
    fn stiffness<R: Real>(&self, scales: &Scales<R>, plastic: R) -> R {
        R::splat(self.k1) * (R::one() + scales.slope * plastic)
    }

    /// Elastic energy at an overlap.
    #[inline(always)]
    fn energy<R: Real>(&self, scales: &Scales<R>, plastic: R, depth: R) -> R {
        let stretched = depth - plastic;
        R::splat(0.5) * self.stiffness(scales, plastic) * stretched * stretched
    }

    /// Elastic energy on the tensile limit.
    #[inline(always)]
    fn stored_on_limit<R: Real>(&self, overlap: R, k2: R) -> R {
        let kc = R::splat(self.kc);
        R::splat(0.5) * kc * kc * overlap * overlap / k2
    }

    /// The contact after a motion to an overlap, however short.
    #[inline(always)]
    fn moved<R: Real>(&self, scales: &Scales<R>, before: R, depth: R) -> Reached<R> {
        let (half, kc) = (R::splat(0.5), R::splat(self.kc));
        let mut reached = Reached { plastic: before, lost_plastic: R::zero(), lost_adhesive: R::zero() };
        let loaded = before.max((depth - scales.elastic).min(scales.most));
        let yields = loaded.gt(before);
        if yields.any() {
            let (from, to) = (before + scales.elastic, loaded + scales.elastic);
            // Work along k1 δ, less what k2/(2 s²) grows by.
            let lost = half * R::splat(self.k1) * (to - from) * (to + from - scales.elastic);
            reached.lost_plastic = lost.keep_where(yields);
            reached.plastic = loaded;
        }
        let k2 = self.stiffness(scales, reached.plastic);
        let at_limit = (k2 * (depth - reached.plastic)).lt(-(kc * depth));
        if at_limit.any() {
            let shrunk = self.on_limit(depth, scales.slope).min(reached.plastic);
            let begins = k2 * reached.plastic / (k2 + kc);
            let work = half * kc * (begins - depth) * (begins + depth);
            let lost = work + self.stored_on_limit(begins, k2)
                - self.stored_on_limit(depth, self.stiffness(scales, shrunk));
            reached.lost_adhesive = lost.keep_where(at_limit);
            reached.plastic = R::select(at_limit, shrunk, reached.plastic);
        }
        reached
    }

    /// The plastic overlap for which −kc δ lies on the elastic line: k1 (1 + s δ_p)(δ_p − δ) = kc δ.
    #[inline(always)]
    fn on_limit<R: Real>(&self, depth: R, slope: R) -> R {
        let ratio = R::splat(1.0 + self.kc / self.k1);
        let rest = R::one() - slope * depth;
        let root = (rest * rest + R::splat(4.0) * slope * depth * ratio).sqrt();
        R::splat(2.0) * depth * ratio / (rest + root)
    }

    /// The plastic overlap after growth at fixed overlap over a step [s].
    #[inline(always)]
    fn grown<R: Real>(&self, scales: &Scales<R>, plastic: R, depth: R, time_step: f64) -> R {
        let one = R::one();
        let neck = depth * scales.inverse_harmonic;
        let per_neck = if self.parhami { one / (R::splat(0.75) * neck * neck) } else { one };
        let power = R::splat(-2.0 * self.rate * self.k1 / self.sinter_tension * time_step) * per_neck;
        let power = power * (one + scales.slope * depth);
        let decay = power.exp();
        let left = (depth - plastic) / (one + scales.slope * plastic) * decay;
        // Round-off must not make it shrink.
        ((depth - left) / (one + scales.slope * left)).max(plastic).min(scales.most)
    }
}

impl NormalLaw for SinterOverlap {
    /// The plastic overlap δ_p.
    type Memory<R: Real> = [R; 1];

    const JUMPS: bool = true;

    const DEPENDS_ON_TIME: bool = true;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NormalResponse<R> {
        let (number, depth) = (R::splat, motion.depth);
        let scales = self.scales(&motion.pair);
        let mut start = memory[0];
        let (mut lost_plastic, mut lost_adhesive) = (R::zero(), R::zero());
        if motion.time_step > 0.0 {
            // Growth in the middle of the step: the trapezoidal work of the force then is that of both halves.
            let middle = (motion.overlap - number(0.5) * motion.growth).max(R::zero());
            let half_way = self.moved(&scales, start, middle);
            let pressed = middle.gt(half_way.plastic) & half_way.plastic.lt(scales.most);
            if pressed.any() {
                let grown = self.grown(&scales, half_way.plastic, middle, motion.time_step);
                // What the contact yields in the step, in its first half and as much again in the second one, it need not
                // grow: it does the larger one of both, not both.
                let yielded = (half_way.plastic - start).max(R::zero());
                let outgrows = (grown - half_way.plastic).gt(yielded + yielded);
                let grown = R::select(outgrows, grown - yielded, half_way.plastic);
                let fall =
                    self.energy(&scales, half_way.plastic, middle) - self.energy(&scales, grown, middle);
                lost_plastic = (half_way.lost_plastic + fall).keep_where(pressed);
                lost_adhesive = half_way.lost_adhesive.keep_where(pressed);
                start = R::select(pressed, grown, start);
            }
        }
        let end = self.moved(&scales, start, depth);
        lost_plastic += end.lost_plastic;
        lost_adhesive += end.lost_adhesive;
        let touching = motion.touching;
        let plastic = end.plastic.keep_where(touching);
        memory[0] = plastic;
        // The rest of the tensile limit is zero at touch: only the sintering force jumps there.
        let k2 = self.stiffness(&scales, plastic);
        let repulsion = k2 * (depth - plastic);
        let sintering = number(-self.sinter_tension) / scales.inverse_harmonic;
        let force = (repulsion + sintering).keep_where(touching);
        NormalResponse {
            applied_force: events::while_touching(motion, force, sintering),
            friction_reference: (repulsion + number(self.kc) * depth).max(R::zero()),
            hardening: plastic / scales.most,
            adhesive_potential: sintering * depth,
            dissipated_plastic: lost_plastic,
            dissipated_adhesive: lost_adhesive,
            ..NormalResponse::elastic(motion, force, self.energy(&scales, plastic, depth), k2)
        }
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        let (harmonic, plastic) = (pair.harmonic_radius(), memory[0]);
        let (elastic, most) = (self.elastic_part() * harmonic, self.phi_f * harmonic);
        let k2 = self.k1 * (1.0 + plastic / elastic);
        // After the response the point lies on its line to round-off only.
        let round_off = 8.0 * f64::EPSILON * (overlap + plastic);
        if overlap <= 0.0 {
            (0, "open")
        } else if k2 * (overlap - plastic) <= -self.kc * overlap + k2 * round_off {
            (3, "adhesive limit")
        } else if overlap >= most + elastic {
            (4, "limit")
        } else if overlap >= plastic + elastic - round_off {
            (1, "plastic")
        } else {
            (2, "elastic")
        }
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.kp.max(self.kc)
    }

    /// μ (1 + s δ) at the largest plastic overlap.
    fn relaxation_rate(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        let constant = 2.0 * self.rate * self.kp / self.sinter_tension;
        if self.parhami { constant / (0.75 * self.phi_f * self.phi_f) } else { constant }
    }
}
