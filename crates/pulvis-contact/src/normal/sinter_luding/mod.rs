//! The law of Luding with a plastic stiffness that follows the temperature, as in pressure sintering.

use pulvis_math::{Mask, Real, elementary};

use super::{NormalLaw, NormalResponse};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

mod entry;
mod kept_line;
mod published;

/// Piece-wise linear contacts as of [`Luding`](super::Luding) whose k1 relaxes towards a value that falls when the material
/// melts:
///
/// ```text
/// k_T(T) = (k1/2) [1 + tanh((T_m − T)/ΔT)]          at least 1e-6 k1
/// dk/dt  = −(k_T/t_0) (1 − k/k_T)²                  while k > k_T, + while k < k_T
/// ```
///
/// Both are one step, exact at fixed temperature: w = k/k_T − 1 becomes w/(1 + |w| dt/t_0). Every contact begins cold.
///
/// By default a contact keeps its elastic line, slope k2 and force-free overlap, and k(t) moves only the lines of loading,
/// k δ up to δ_p and kp (δ − δ_p) + k δ_p beyond: heating lets what lies above them flow, cooling leaves the force as it
/// is. k2 never falls, neither on −kc δ, and is never below k. Heating so only dissipates (dissipated_thermal >= 0).
///
/// The variant `published` keeps the largest overlap D in its place, so that a loaded contact follows k(t) at once, with a
/// force that grows again when it cools. The change of its energy at fixed overlap is booked as thermal, of either sign:
/// that form creates energy.
///
/// The step of k is exact, whatever its length is against t_0. At the automatic time step, which resolves the collision only,
/// the restitution e² errs by up to 3e-3; the error falls with the step.
///
/// # Source
/// S. Luding, K. Manetsberger, J. Müllers, J. Mech. Phys. Solids 53, 455 (2005), which could not be confirmed against the
/// original: form and constants of k_T and of its rate are as recalled. The kept line and the energies are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SinterLuding {
    /// Plastic stiffness of cold contacts [N/m].
    k1: f64,
    kp: f64,
    kc: f64,
    phi_f: f64,
    melting: f64,
    width: f64,
    time_scale: f64,
    published: bool,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SinterLudingMemory<R> {
    /// Present plastic stiffness k; zero for bodies apart [N/m].
    pub plastic_stiffness: R,
    /// Slope k2 of the kept line; zero in the published variant [N/m].
    pub elastic_stiffness: R,
    /// Force-free overlap of the kept line; zero in the published variant [m].
    pub rest: R,
    /// Largest overlap D in the published variant, otherwise zero [m].
    pub overlap_max: R,
    /// Overlap of the last step [m].
    pub depth: R,
}

impl<R: Real> Memory<R> for SinterLudingMemory<R> {
    const COLUMNS: usize = 5;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        let (plastic_stiffness, elastic_stiffness) = (column(0), column(1));
        let (rest, overlap_max, depth) = (column(2), column(3), column(4));
        Self { plastic_stiffness, elastic_stiffness, rest, overlap_max, depth }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.plastic_stiffness);
        column(1, self.elastic_stiffness);
        column(2, self.rest);
        column(3, self.overlap_max);
        column(4, self.depth);
    }
}

/// What heat and motion have made of a contact.
#[derive(Clone, Copy, Debug)]
struct State<R> {
    memory: SinterLudingMemory<R>,
    force: R,
    /// Elastic stiffness.
    stiffness: R,
    losses: Losses<R>,
}

/// Energies lost in a step [J].
#[derive(Clone, Copy, Debug)]
struct Losses<R> {
    plastic: R,
    adhesive: R,
    thermal: R,
}

// Not derived: what is derived is not inlined by force.
impl<R: Real> Default for Losses<R> {
    #[inline(always)]
    fn default() -> Self {
        Self { plastic: R::zero(), adhesive: R::zero(), thermal: R::zero() }
    }
}

impl<R: Real> Losses<R> {
    #[inline(always)]
    fn keep_where(self, mask: R::Mask) -> Self {
        Self {
            plastic: self.plastic.keep_where(mask),
            adhesive: self.adhesive.keep_where(mask),
            thermal: self.thermal.keep_where(mask),
        }
    }
}

impl SinterLuding {
    /// The plastic stiffness at a temperature [K] after a long time [N/m].
    pub fn settled(&self, temperature: f64) -> f64 {
        // 1 + tanh x = 2/(1 + e^(−2x)).
        let melted = elementary::exp(2.0 * (temperature - self.melting) / self.width);
        self.k1 * (1.0 / (1.0 + melted)).max(1e-6)
    }

    /// The plastic stiffness after a step; that of a contact that begins is the cold one, from the touch on.
    #[inline(always)]
    fn relaxed<R: Real>(&self, motion: &NormalMotion<R>, before: R) -> R {
        let (number, one) = (R::splat, R::one());
        let begins = before.le(R::zero());
        let now = R::select(begins, number(self.k1), before);
        if motion.time_step <= 0.0 {
            return now;
        }
        let settled = self.settled(motion.temperature);
        // Exactly zero where it has settled.
        let away = (now - number(settled)) * number(1.0 / settled);
        let whole = number(motion.time_step / self.time_scale);
        let mut elapsed = whole;
        if begins.any() {
            let part = (motion.depth / motion.growth).min(one);
            let met = motion.growth.gt(R::zero());
            elapsed = R::select(begins, (whole * part).keep_where(met), whole);
        }
        number(settled) * (one + away / (one + away.abs() * elapsed))
    }

    /// 1/δ_p of cold contacts, zero where kp = k1 [1/m].
    #[inline(always)]
    fn inverse_limit<R: Real>(&self, pair: &Pair<R>) -> R {
        R::splat((self.kp - self.k1) / (self.kp * self.phi_f)) * pair.inverse_harmonic_radius()
    }

    /// k2 of a contact that is loaded to an overlap, up to δ_p.
    #[inline(always)]
    fn hardened<R: Real>(&self, plastic: R, overlap: R, inverse_limit: R) -> R {
        plastic + (R::splat(self.kp) - plastic) * (overlap * inverse_limit).min(R::one())
    }
}

impl NormalLaw for SinterLuding {
    type Memory<R: Real> = SinterLudingMemory<R>;

    const DEPENDS_ON_TIME: bool = true;

    const NEEDS_TEMPERATURE: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut SinterLudingMemory<R>,
    ) -> NormalResponse<R> {
        let plastic = self.relaxed(motion, memory.plastic_stiffness);
        let state = if self.published {
            self.follow_overlap(motion, *memory, plastic)
        } else {
            self.follow_line(motion, *memory, plastic)
        };
        let (zero, touching) = (R::zero(), motion.touching);
        let SinterLudingMemory { elastic_stiffness, rest, overlap_max, .. } = state.memory;
        *memory = SinterLudingMemory {
            plastic_stiffness: plastic.keep_where(touching),
            elastic_stiffness: elastic_stiffness.keep_where(touching),
            rest: rest.keep_where(touching),
            overlap_max: overlap_max.keep_where(touching),
            depth: motion.depth,
        };
        let force = state.force.keep_where(touching);
        let stored_energy = R::splat(0.5) * force * force / state.stiffness;
        let room = R::splat(self.kp) - plastic;
        let hardens = room.gt(zero);
        let hardening = (state.stiffness - plastic) / R::select(hardens, room, R::one());
        let inverse_limit = self.inverse_limit(&motion.pair);
        let limited = inverse_limit.gt(zero);
        NormalResponse {
            friction_reference: (force + R::splat(self.kc) * motion.depth).max(zero),
            hardening: R::select(hardens, hardening.max(zero), R::one()),
            inverse_overlap_scale: R::select(limited, inverse_limit, motion.pair.inverse_harmonic_radius()),
            dissipated_plastic: state.losses.plastic,
            dissipated_adhesive: state.losses.adhesive,
            dissipated_thermal: state.losses.thermal,
            ..NormalResponse::elastic(motion, force, stored_energy, state.stiffness)
        }
    }

    fn is_passive(&self) -> bool {
        !self.published
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &SinterLudingMemory<f64>) -> (u8, &'static str) {
        let plastic = if memory.plastic_stiffness > 0.0 { memory.plastic_stiffness } else { self.k1 };
        let inverse_limit = self.inverse_limit(pair);
        let loaded = (overlap * inverse_limit).min(1.0);
        let (k2, line) = if self.published {
            let overlap_max =
                memory.overlap_max.max(if inverse_limit > 0.0 { loaded / inverse_limit } else { overlap });
            let k2 = self.hardened(plastic, overlap_max, inverse_limit);
            (k2, k2 * overlap - (k2 - plastic) * overlap_max)
        } else {
            let k2 = memory.elastic_stiffness.max(plastic);
            (k2, k2 * (overlap - memory.rest))
        };
        // After the response the point lies on its line to round-off only.
        let round_off = 16.0 * f64::EPSILON * k2 * (overlap + memory.rest + memory.overlap_max);
        if overlap <= 0.0 {
            (0, "open")
        } else if line <= round_off - self.kc * overlap {
            (3, "adhesive limit")
        } else if loaded >= 1.0 {
            (4, "limit")
        } else if line >= plastic * overlap - round_off {
            (1, "plastic")
        } else {
            (2, "elastic")
        }
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.kp.max(self.kc)
    }
}
