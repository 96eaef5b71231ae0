//! Elastic-plastic spheres by fits to finite elements, in place of those of Rathbone and others.

use pulvis_math::{Mask, Real};

use self::curve::{Curve, ONSET};
use super::hertz::{effective_radius, expected_overlap};
use super::{NormalLaw, NormalResponse};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

mod curve;
mod entry;

/// Spheres that yield: virgin loading by a fit to finite elements, unloading by another one.
///
/// With w = δ/w_c, w_c = c² R, P_c = (4/3) E* R² c³ and c = π C S_y/(2 E*), C = 1.295 e^(0.736 ν):
///
/// ```text
/// F/P_c = w^(3/2)                                                                            up to w_y
/// F/P_c = e^(−w^(5/12)/4) w^(3/2) + (4 H/(C S_y)) [1 − e^(−w^(5/9)/25)] w                    beyond
/// H/S_y = 2.84 − 0.92 [1 − cos(π a/R)],  a = √(R δ (w/1.9)^B),  B = 0.14 e^(23 S_y/E*)
/// F     = F_m ((δ − δ_r)/(δ_m − δ_r))^n                                                      from the largest overlap δ_m
/// δ_r/δ_m = (1 − w_m^(−0.28)) (1 − w_m^(−0.69)),  n = 1.5 w_m^(−0.0331)                      for w_m > 1
/// ```
///
/// The publication changes from one curve to the other at w = 1.9, where the force jumps (by 0.5 % at ν = 0.3, by 7 % at
/// ν = 0). Here w_y is where the two meet. Its n gives back more than loading has cost near w = 1 and there; here n = 3/2
/// up to w_y, and then so large that no energy comes from nothing, which is the published one from about 1.1 w_y on.
///
/// Beyond a = R, where the fits mean nothing, and beyond w = 1e5 the contact is elastic along its last unloading curve. The
/// contact radius is that of the elastic slope, dF/dδ = 2 E* a.
///
/// # Source
/// R. L. Jackson, I. Green, J. Tribol. 127, 343 (2005) for loading, I. Etsion, Y. Kligerman, Y. Kadin, Int. J. Solids Struct.
/// 42, 3716 (2005) for unloading; neither could be confirmed against the original. They stand in for D. Rathbone, M. Marigo,
/// D. Dini, B. van Wachem, Powder Technol. 282, 2 (2015), whose coefficients were not to be had.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rathbone {
    /// E* [Pa].
    modulus: f64,
    curve: Curve,
}

/// The memory of a contact that has yielded; zero for others.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RathboneMemory<R> {
    /// Largest overlap δ_m [m].
    pub overlap_max: R,
    /// Overlap δ_r at which unloading ends [m].
    pub residual: R,
    /// Exponent n of unloading [1].
    pub exponent: R,
    /// Force F_m at the largest overlap [N].
    pub force_max: R,
}

impl<R: Real> Memory<R> for RathboneMemory<R> {
    const COLUMNS: usize = 4;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        let (overlap_max, residual) = (column(0), column(1));
        Self { overlap_max, residual, exponent: column(2), force_max: column(3) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.overlap_max);
        column(1, self.residual);
        column(2, self.exponent);
        column(3, self.force_max);
    }
}

/// What a contact that has yielded answers.
#[derive(Clone, Copy, Debug, Default)]
struct Yielded {
    force: f64,
    stored: f64,
    stiffness: f64,
    lost: f64,
    memory: RathboneMemory<f64>,
}

impl Rathbone {
    /// w_c [m] and P_c [N] of an effective radius [m].
    fn scales(&self, radius: f64) -> (f64, f64) {
        let c = self.curve.critical;
        (c * c * radius, 4.0 / 3.0 * self.modulus * radius * radius * c * c * c)
    }

    /// The answer at an overlap [m] of a contact that yields or has yielded.
    fn yielded(&self, radius: f64, depth: f64, before: RathboneMemory<f64>) -> Yielded {
        let (overlap, force) = self.scales(radius);
        let mut answer = Yielded { memory: before, ..Yielded::default() };
        let reached = (depth / overlap).min(self.curve.last);
        if reached * overlap > before.overlap_max {
            let start = if before.overlap_max > 0.0 {
                let width = before.overlap_max - before.residual;
                let stored = before.force_max * width / (before.exponent + 1.0) / (force * overlap);
                (before.overlap_max / overlap, stored)
            } else {
                ONSET
            };
            let loaded = self.curve.load(start, reached);
            answer.lost = loaded.lost * force * overlap;
            answer.memory = RathboneMemory {
                overlap_max: reached * overlap,
                residual: loaded.residual * overlap,
                exponent: loaded.exponent,
                force_max: loaded.force * force,
            };
        }
        let RathboneMemory { overlap_max, residual, exponent, force_max } = answer.memory;
        let (width, part) = (overlap_max - residual, (depth - residual) / (overlap_max - residual));
        if part > 0.0 {
            answer.force = force_max * Real::powf(part, exponent);
            answer.stored = answer.force * part * width / (exponent + 1.0);
            answer.stiffness = exponent * answer.force / (part * width);
        }
        answer
    }
}

/// One number of each lane.
#[inline(always)]
fn of<R: Real>(lanes: &[Yielded; 8], value: fn(&Yielded) -> f64) -> R {
    R::from_fn(|lane| value(&lanes[lane]))
}

impl NormalLaw for Rathbone {
    type Memory<R: Real> = RathboneMemory<R>;

    #[inline(always)]
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut RathboneMemory<R>,
    ) -> NormalResponse<R> {
        let number = R::splat;
        let (depth, before) = (motion.depth, *memory);
        let radius = number(0.5) / motion.pair.inverse_harmonic_radius();
        let critical = number(self.curve.critical * self.curve.critical) * radius;
        let mut stiffness = number(2.0 * self.modulus) * (radius * depth).sqrt();
        let mut force = number(2.0 / 3.0) * stiffness * depth;
        let mut stored = number(0.4) * force * depth;
        let mut lost = R::zero();
        let yields = before.overlap_max.max(depth).gt(critical) & motion.touching;
        *memory = RathboneMemory::default();
        if yields.any() {
            // Lane by lane: powers and exponentials have no other way.
            let mut lanes = [Yielded::default(); 8];
            // No closure over vectors: these are not inlined by force.
            for (lane, yielded) in lanes.iter_mut().enumerate().take(R::LANES) {
                if yields.lane(lane) {
                    let past = RathboneMemory {
                        overlap_max: before.overlap_max.lane(lane),
                        residual: before.residual.lane(lane),
                        exponent: before.exponent.lane(lane),
                        force_max: before.force_max.lane(lane),
                    };
                    *yielded = self.yielded(radius.lane(lane), depth.lane(lane), past);
                }
            }
            force = R::select(yields, of(&lanes, |lane| lane.force), force);
            stored = R::select(yields, of(&lanes, |lane| lane.stored), stored);
            stiffness = R::select(yields, of(&lanes, |lane| lane.stiffness), stiffness);
            lost = of(&lanes, |lane| lane.lost);
            *memory = RathboneMemory {
                overlap_max: of(&lanes, |lane| lane.memory.overlap_max),
                residual: of(&lanes, |lane| lane.memory.residual),
                exponent: of(&lanes, |lane| lane.memory.exponent),
                force_max: of(&lanes, |lane| lane.memory.force_max),
            };
        }
        NormalResponse {
            contact_radius: number(0.5 / self.modulus) * stiffness,
            dissipated_plastic: lost,
            ..NormalResponse::elastic(motion, force, stored, stiffness)
        }
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &RathboneMemory<f64>) -> (u8, &'static str) {
        let (critical, _) = self.scales(effective_radius(pair));
        if overlap <= 0.0 {
            (0, "open")
        } else if overlap < memory.overlap_max {
            if overlap > memory.residual { (4, "unloading") } else { (5, "free") }
        } else if overlap <= critical {
            (1, "elastic")
        } else if overlap <= self.curve.meeting * critical {
            (2, "elastic-plastic")
        } else if overlap <= self.curve.last * critical {
            (3, "plastic")
        } else {
            (6, "limit")
        }
    }

    /// The steepest slope of unloading from any overlap up to that to which the spheres are pressed.
    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let radius = effective_radius(pair);
        let (critical, force) = self.scales(radius);
        let energy = 0.5 * expected.speed * expected.speed * pair.reduced_mass();
        let elastic = expected_overlap(self.modulus, pair, expected);
        let pressed = self.curve.pressed_by(energy / (force * critical), expected.force / force);
        let overlap = elastic.max(pressed * critical);
        let hertz = 2.0 * self.modulus * (radius * overlap.min(critical)).sqrt();
        hertz.max(self.curve.steepest(overlap / critical) * force / critical)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    fn expected_contact_radius(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        0.5 * self.max_stiffness(pair, expected) / self.modulus
    }

    fn remembered_overlap(&self, memory: &RathboneMemory<f64>) -> Option<f64> {
        Some(memory.overlap_max)
    }
}
