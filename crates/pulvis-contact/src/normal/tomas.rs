//! Stiff particles with soft contacts, after Tomas: elastic, flowing, adhesive.

use pulvis_math::{Mask, Real, elementary};

use super::hertz::expected_overlap;
use super::{NormalLaw, NormalResponse};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

mod entry;
mod flow;

use flow::Flow;

/// Hertz' contact that flows at a pressure, and whose flattened area adds to the van der Waals force.
///
/// ```text
/// F = (2/3) E_T √(r h³) − F_H0                   elastic, 0 ≤ h ≤ h_f = r (π p_f/E_T)²
/// F = π r (κ_A p_f − p_vdw) h − F_H0             flow, h = h_U;  κ_A = 1 − (h_f/h)^(1/3)/3
/// F = F_A + (2/3) E_T √(r (h − h_A)³) λ          un- and re-loading,  F_A = −π r p_vdw h_A − F_H0
/// F = −F_H0 q² − π r p_vdw h_A q³                apart (h < h_A), q = a_0/(a_0 + h_A − h);  h_A = 0 on approach
/// ```
///
/// with E_T = 2 E*, F_H0 = C_H r/(6 a_0²), and h_A such that the branches meet at h_U. With x = (h − h_A)/(h_U − h_A) and its
/// largest value x_m since the last full unloading, λ = (1 − (1 − x_m)^(3/2))/x_m^(3/2): one when unloading after flow, and
/// the published curve when re-loading after full unloading. Partial reversals are elastic.
///
/// The published line of flow jumps by −π r p_vdw h_f at h_f. `continuous` takes p_vdw (h − h_f) instead of p_vdw h.
///
/// F_H0 of a contact so small that adhesion alone would make it flow is limited to what does not: otherwise flow would
/// create energy. Attraction ends at the cutoff, where it is smaller than F_H0 (a_0/cutoff)².
///
/// # Source
/// J. Tomas, KONA 18, 157 (2000); Part. Sci. Technol. 19, 95 (2001); Granular Matter 6, 75 (2004), not confirmed against the
/// originals. The rule for partial reversals, the cutoff, the limit of F_H0 and the energies are choices of this program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tomas {
    /// E_T = 2 E* [Pa].
    modulus: f64,
    /// p_vdw [Pa].
    vdw_pressure: f64,
    /// C_H/(6 a_0²) [N/m].
    adhesion: f64,
    /// Contact distance a_0 [m].
    distance: f64,
    /// Gap beyond which nothing acts [m].
    cutoff: f64,
    flow: Flow,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TomasMemory<R> {
    /// Largest overlap h_U of a contact that has flowed, otherwise zero [m].
    pub yield_overlap: R,
    /// Overlap h_A at which the pull-off force is reached [m].
    pub pull_off_overlap: R,
    /// Largest h − h_A since the last full unloading [m].
    pub reloaded: R,
}

impl<R: Real> Memory<R> for TomasMemory<R> {
    const COLUMNS: usize = 3;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { yield_overlap: column(0), pull_off_overlap: column(1), reloaded: column(2) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.yield_overlap);
        column(1, self.pull_off_overlap);
        column(2, self.reloaded);
    }
}

/// h_U − h_A of a contact that has flowed; one for others, which do not use it.
#[inline(always)]
fn height<R: Real>(top: R, pull_off: R, flowed: R::Mask) -> R {
    R::select(flowed, top - pull_off, R::one())
}

/// With s = √(1 − x): (1 − (1 − x)^(3/2))/x^(3/2).
#[inline(always)]
fn stiffening<R: Real>(x: R) -> R {
    let s = (R::one() - x).max(R::zero()).sqrt();
    (R::one() + s + s * s) / ((R::one() + s) * x.sqrt())
}

/// What re-loading to x loses, over the work K (h_U − h_A)^(5/2): 0.6 x − 0.4 (1 − (1 − x)^(3/2)), without cancellation.
#[inline(always)]
fn reloading_loss<R: Real>(x: R) -> R {
    let s = (R::one() - x).max(R::zero()).sqrt();
    let share = x / (R::one() + s);
    R::splat(0.2) * share * share * (R::one() + s + s)
}

impl Tomas {
    /// F_H0 [N].
    #[inline(always)]
    fn permanent_force<R: Real>(&self, radius: R) -> R {
        let most = R::splat(self.flow.limit_growth) * radius + R::splat(self.flow.limit_at_zero);
        radius * R::splat(self.adhesion).min(most)
    }

    /// The largest overlap of the expected loading [m].
    fn expected_overlap(&self, pair: &Pair, expected: &ExpectedLoading) -> f64 {
        let radius = 0.5 * pair.harmonic_radius();
        let elastic = expected_overlap(0.5 * self.modulus, pair, expected);
        if elastic < self.flow.yield_overlap(radius) {
            return elastic;
        }
        // The softest flow, at h_f.
        let slope = self.flow.least_slope(radius, self.vdw_pressure);
        let of_force = (expected.force + self.permanent_force(radius)) / slope;
        elastic.max(expected.speed * (pair.reduced_mass() / slope).sqrt()).max(of_force)
    }
}

impl NormalLaw for Tomas {
    type Memory<R: Real> = TomasMemory<R>;

    const JUMPS: bool = true;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut TomasMemory<R>) -> NormalResponse<R> {
        let (number, zero, one) = (R::splat, R::zero(), R::one());
        let overlap = motion.overlap;
        let radius = number(0.5) / motion.pair.inverse_harmonic_radius();
        let root = number(2.0 / 3.0 * self.modulus) * radius.sqrt();
        let permanent = self.permanent_force(radius);
        let vdw = number(std::f64::consts::PI * self.vdw_pressure) * radius;
        let begins = self.flow.yield_overlap(radius);
        let had_flowed = memory.yield_overlap.gt(zero);
        let before = *memory;
        let flows = overlap.gt(R::select(had_flowed, before.yield_overlap, begins));
        let flowed = had_flowed | flows;
        let (mut top, mut pull_off) = (before.yield_overlap, before.pull_off_overlap);
        let (mut plastic, mut jump) = (zero, zero);
        if flows.any() {
            let contact = flow::Contact { radius, permanent, begins };
            let found = self.flow.to(&contact, overlap, &before, self.distance, self.cutoff);
            top = R::select(flows, overlap, top);
            pull_off = R::select(flows, found.pull_off_overlap, pull_off);
            let old = height(before.yield_overlap, before.pull_off_overlap, had_flowed);
            let rest = number(0.2) - reloading_loss((before.reloaded / old).min(one));
            let rest = (root * old * old * old.sqrt() * rest).keep_where(had_flowed);
            plastic = (found.lost + rest).keep_where(flows);
            let first = flows & !had_flowed & motion.growth.gt(zero);
            let step = number(-self.flow.jump) * vdw * begins;
            jump = (events::sets_in(motion, begins, step) - step).keep_where(first);
        }
        let height = height(top, pull_off, flowed);
        let pressed = (overlap - pull_off).max(zero);
        let gap = (pull_off - overlap).max(zero);
        let closed = motion.touching & overlap.ge(pull_off);
        let reloaded = before.reloaded.max(pressed).min(height);
        let reloaded = R::select(flows, height, reloaded).keep_where(flowed & pressed.gt(zero));
        let mut factor = one;
        let partial = flowed & !flows & pressed.gt(zero) & before.reloaded.lt(height);
        if partial.any() {
            let share = R::select(partial, reloaded / height, one);
            factor = stiffening(share);
            let earlier = R::select(partial, before.reloaded / height, zero);
            let lost = reloading_loss(share) - reloading_loss(earlier);
            let grows = partial & reloaded.gt(before.reloaded);
            plastic += (root * height * height * height.sqrt() * lost).keep_where(grows);
        }
        let area = pressed.sqrt();
        let spring = root * pressed * area * factor;
        let (mut near, end) = (one, number(self.distance / (self.distance + self.cutoff)));
        if gap.gt(zero).any() {
            near = number(self.distance) / (number(self.distance) + gap);
        }
        let acts = gap.lt(number(self.cutoff));
        let (square, flattened) = (near * near, vdw * pull_off);
        let pull = permanent * square + flattened * square * near;
        let energy = permanent * (near - end) + number(0.5) * flattened * (square - end * end);
        let potential = -(number(self.distance) * energy) - (permanent + flattened) * pressed;
        let force = (spring - pull).keep_where(acts);
        let remembers = flowed & overlap.gt(number(-self.cutoff));
        *memory = TomasMemory {
            yield_overlap: top.keep_where(remembers),
            pull_off_overlap: pull_off.keep_where(remembers),
            reloaded: reloaded.keep_where(remembers),
        };
        let earlier = overlap - motion.growth;
        NormalResponse {
            applied_force: force + jump,
            in_contact: closed,
            was_in_contact: earlier.gt(zero) & earlier.ge(before.pull_off_overlap),
            friction_reference: spring.keep_where(closed),
            contact_radius: (radius * motion.depth).sqrt().keep_where(closed),
            inverse_overlap_scale: one / begins,
            adhesive_potential: potential.keep_where(acts),
            dissipated_plastic: plastic,
            ..NormalResponse::elastic(
                motion,
                force,
                number(0.4) * spring * pressed,
                number(1.5) * root * area * factor,
            )
        }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.cutoff
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &TomasMemory<f64>) -> (u8, &'static str) {
        let pressed = overlap - memory.pull_off_overlap;
        let flowed = memory.yield_overlap > 0.0;
        if -pressed >= self.cutoff {
            (0, "out of range")
        } else if !flowed && overlap > self.flow.yield_overlap(0.5 * pair.harmonic_radius()) {
            (3, "flow")
        } else if !flowed {
            if overlap > 0.0 { (2, "elastic") } else { (1, "approach") }
        } else if pressed < 0.0 {
            (6, "detachment")
        } else if overlap >= memory.yield_overlap {
            (3, "flow")
        } else if pressed < memory.reloaded {
            (4, "unloading")
        } else {
            (5, "re-loading")
        }
    }

    /// The steepest of re-loading, √(h_U − h_A) times E_T √r and half as much again, of the attraction at contact and of the
    /// flow, which is never steeper than π r p_f.
    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let radius = 0.5 * pair.harmonic_radius();
        let vdw = std::f64::consts::PI * radius * self.vdw_pressure;
        let permanent = self.permanent_force(radius);
        let begins = self.flow.yield_overlap(radius);
        let overlap = self.expected_overlap(pair, expected);
        let mut pull_off = 0.0;
        if overlap > begins {
            let root = self.flow.root(overlap / begins, elementary::cbrt(overlap / begins));
            pull_off = overlap - begins * root * root;
        }
        let contact = 1.5 * self.modulus * (radius * (overlap - pull_off)).sqrt();
        let attraction = (2.0 * permanent + 3.0 * vdw * pull_off) / self.distance;
        contact.max(attraction).max(std::f64::consts::PI * radius * self.flow.yield_pressure)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    fn remembered_overlap(&self, memory: &TomasMemory<f64>) -> Option<f64> {
        Some(memory.yield_overlap)
    }
}
