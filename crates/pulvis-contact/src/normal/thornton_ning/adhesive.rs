//! Elastic-perfectly plastic spheres with adhesion, in the units of the adhesive curve: y = √(a/a_sep), forces over
//! F_c/6, energies over F_c s/6, pressures over (E*² Γ/(π² R))^(1/3).

use std::f64::consts::PI;

use pulvis_math::{Mask, Real, elementary};

use super::ThorntonNingMemory;
use super::dry::Dry;
use crate::events;
use crate::functions::cbrt;
use crate::kinematics::NormalMotion;
use crate::normal::NormalResponse;
use crate::normal::adhesive_curve as curve;
use crate::normal::hertz::effective_radius;
use crate::pair::Pair;

/// The least limiting pressure, 2^(1/3): below it adhesion alone makes a contact yield in the moment of its first touch.
const LEAST_PRESSURE: f64 = 1.26;
/// Below this pressure a contact begins to yield while adhesion still pulls it together.
const PULLED: f64 = 1.76;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Adhesive {
    /// Modulus and limiting pressure.
    pub dry: Dry,
    /// Work of adhesion Γ [J/m²].
    adhesion: f64,
    /// a_sep/R^(2/3) = (π Γ/(8 E*))^(1/3) [m^(1/3)].
    separation_scale: f64,
    /// Limiting pressure over its unit, over R^(1/3) [m^(-1/3)].
    pressure_scale: f64,
    published: bool,
}

/// The elastic curve of a contact that has yielded: R_p/R, its cube root, and δ_p.
#[derive(Clone, Copy, Debug)]
struct Unloading<R> {
    stiffer: R,
    scale: R,
    /// δ_p over s.
    start: R,
}

/// The limit of the pressure, and where the contact reached it.
#[derive(Clone, Copy, Debug)]
struct Yield<R> {
    pressure: R,
    /// y at first yield; only the published form needs it while the contact yields.
    at: R,
}

impl Adhesive {
    pub(super) fn new(dry: Dry, adhesion: f64, published: bool) -> Self {
        let separation_scale = elementary::cbrt(PI * adhesion / (8.0 * dry.modulus));
        let unit = elementary::cbrt(dry.modulus * dry.modulus * adhesion / (PI * PI));
        Self { dry, adhesion, separation_scale, pressure_scale: dry.pressure / unit, published }
    }

    /// s = a_sep²/R [m], from the cube root of the effective radius [m^(1/3)].
    #[inline(always)]
    pub(super) fn unit<R: Real>(&self, root: R) -> R {
        R::splat(self.separation_scale * self.separation_scale) * root
    }

    /// The limiting pressure over its unit.
    #[inline(always)]
    fn pressure<R: Real>(&self, root: R) -> R {
        (R::splat(self.pressure_scale) * root).max(R::splat(LEAST_PRESSURE))
    }

    /// Radius of the contact area at an overlap [m], at least twice that at which the neck breaks.
    pub(super) fn contact_radius(&self, radius: f64, overlap: f64) -> f64 {
        let root = elementary::cbrt(radius);
        let y = curve::invert(3.0 + overlap / self.unit(root));
        self.separation_scale * root * root * (y * y).max(2.0)
    }

    /// Force of yielding at y.
    #[inline(always)]
    fn plastic_force<R: Real>(&self, limit: Yield<R>, y: R) -> R {
        let (p, number) = (limit.pressure, R::splat);
        let square = y * y;
        if self.published {
            let at = limit.at * limit.at;
            let first = number(2.0 / 3.0) * curve::force(at * limit.at);
            return first + p * (square - at) * (square + at) - number(4.0) * at * (y - limit.at);
        }
        let r = (p * p + number(8.0) * y).sqrt();
        p * y * (square * y - number(2.0)) - (p * p * p + r * r * r) * number(1.0 / 6.0)
    }

    /// Work of yielding up to y, but for a constant.
    #[inline(always)]
    fn plastic_work<R: Real>(&self, limit: Yield<R>, y: R) -> R {
        let (p, number) = (limit.pressure, R::splat);
        let (square, cube) = (y * y, y * y * y);
        if self.published {
            let (fourth, fifth) = (square * square, square * cube);
            let at = limit.at * limit.at;
            let constant =
                number(2.0 / 3.0) * curve::force(at * limit.at) - p * at * at + number(4.0) * at * limit.at;
            return constant * (fourth - number(4.0) * y)
                + p * (number(0.5) * fourth * fourth - number(0.8) * fifth)
                - number(4.0) * at * (number(0.8) * fifth - number(2.0) * square);
        }
        let r = (p * p + number(8.0) * y).sqrt();
        // r − p without cancellation.
        let t = number(8.0) * y / (r + p);
        // t⁴/512 Σ c_k p^(7−k) t^k/(k + 4) with (1 + x)⁴ (2 + x)³ = Σ c_k x^k: all terms are positive.
        let mut sum = R::zero();
        let mut power = R::one();
        const TERMS: [f64; 8] = [8.0, 44.0, 102.0, 129.0, 96.0, 42.0, 10.0, 1.0];
        for (k, coefficient) in TERMS.into_iter().enumerate() {
            sum = sum * p + number(coefficient / (k as f64 + 4.0)) * power;
            power = power * t;
        }
        let t_squared = t * t;
        let q = t_squared * t_squared * number(1.0 / 512.0) * sum;
        let (r2, p2) = (r * r, p * p);
        // (r⁵ − p⁵)/5.
        let fifths = t * number(0.2) * (r2 * r2 + r2 * r * p + r2 * p2 + r * p2 * p + p2 * p2);
        p * square * (number(0.5) * square * (square * square) - number(2.4) * cube + number(4.0))
            - p2 * p * number(1.0 / 6.0) * y * (cube - number(4.0))
            - (q - fifths) * number(1.0 / 6.0)
    }

    /// The part of the loss of snap-in that is not stored any more though the first yielding is going to give it back.
    ///
    /// Where adhesion pulls a contact into yielding, the work of the curve less what unloading gives back falls at first,
    /// by at most 0.43 of the 15.2 that snap-in has lost. Its slope there is above −16 (1.76 − p)² on less than
    /// 0.4 (1.76 − p) beyond y_y (computed for 1.26 <= p < 1.76 with 30 digits). So much is taken from the stored energy as
    /// the contact yields, and from what snap-off loses: no loss is negative, and their sum is what it is.
    #[inline(always)]
    fn advance<R: Real>(limit: Yield<R>, m: R) -> R {
        let pulled = (R::splat(PULLED) - limit.pressure).max(R::zero());
        R::splat(16.0) * pulled * pulled * (m - limit.at).min(R::splat(0.4) * pulled)
    }

    /// The elastic curve of a contact whose largest radius is at y = m.
    #[inline(always)]
    fn unloading<R: Real>(&self, limit: Yield<R>, m: R) -> Unloading<R> {
        let cube = m * m * m;
        let force = self.plastic_force(limit, m);
        let stiffer = cube * cube / (R::splat(1.5) * force + R::splat(6.0) * cube);
        let start = m * cube * (R::one() - R::one() / stiffer);
        Unloading { stiffer, scale: cbrt(stiffer), start }
    }
}

impl<R: Real> Unloading<R> {
    /// Of a contact that has not yielded.
    fn virgin() -> Self {
        Self { stiffer: R::one(), scale: R::one(), start: R::zero() }
    }

    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self {
            stiffer: R::select(mask, then.stiffer, otherwise.stiffer),
            scale: R::select(mask, then.scale, otherwise.scale),
            start: R::select(mask, then.start, otherwise.start),
        }
    }

    /// Energy at the point y = scale · own of the curve.
    #[inline(always)]
    fn energy(&self, own: R) -> R {
        R::splat(2.0 / 3.0) * self.stiffer * self.scale * curve::energy(own, own * own * own)
    }
}

/// y at first yield, the root of y³ − p y − 2 = 0 for p >= 1.26: five steps of Newton's method from within a fifth.
#[inline(always)]
fn first_yield<R: Real>(p: R) -> R {
    let mut y = p.sqrt() + R::one() / p;
    for _ in 0..5 {
        let square = y * y;
        y -= (square * y - p * y - R::splat(2.0)) / (R::splat(3.0) * square - p);
    }
    y
}

impl Adhesive {
    #[inline(always)]
    pub(super) fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut ThorntonNingMemory<R>,
    ) -> NormalResponse<R> {
        let (zero, one, number) = (R::zero(), R::one(), R::splat);
        let recorded = memory.cube_root_radius.gt(zero);
        let was_attached = memory.attached.gt(number(0.5));
        let fresh = motion.overlap.ge(zero) & !recorded;
        let mut root = memory.cube_root_radius;
        if fresh.any() {
            let inverse_radius = number(2.0) * motion.pair.inverse_harmonic_radius();
            root = R::select(fresh, cbrt(one / inverse_radius), root);
        }
        let known = recorded | fresh;
        // Pairs apart shall not divide by zero.
        let root = R::select(known, root, one);
        let unit = self.unit(root);
        let overlap = motion.overlap / unit;
        let yielded = memory.largest_radius.gt(zero);
        let pressure = self.pressure(root);
        let mut limit = Yield { pressure, at: memory.yield_radius };
        let (mut largest, mut before) = (memory.largest_radius, Unloading::virgin());
        let mut advance_before = zero;
        if yielded.any() {
            let m = R::select(yielded, largest, one);
            before = Unloading::select(yielded, self.unloading(limit, m), before);
            advance_before = Self::advance(limit, m).keep_where(yielded);
        }
        let attaches = known & !was_attached & overlap.ge(before.start);
        let held = was_attached | attaches;
        let fourth = largest * largest * (largest * largest);
        let hard = yielded & overlap.gt(fourth - number(4.0) * largest);
        let on_curve = R::select(hard, overlap, (overlap - before.start) / before.scale);
        let e = number(3.0) + on_curve;
        let y = curve::invert(e.max(number(f64::MIN_POSITIVE)));
        let yields = !yielded & (y * y * y - number(2.0)).gt(pressure * y);
        let plastic = held & (hard | yields);
        let attached = held & (plastic | e.gt(zero));

        // Energies over F_c s/6.
        let (mut now, mut own, mut lost, mut advance) = (before, y, zero, advance_before);
        if plastic.any() {
            let first = plastic & !yielded;
            if first.any() {
                limit.at = R::select(first, first_yield(pressure), limit.at);
            }
            let from = R::select(yielded, largest, limit.at);
            now = Unloading::select(plastic, self.unloading(limit, R::select(plastic, y, one)), before);
            own = R::select(plastic, y / now.scale, y);
            let work = self.plastic_work(limit, y) - self.plastic_work(limit, from);
            let stored = now.energy(own) - before.energy(from / before.scale);
            advance = R::select(plastic, Self::advance(limit, y), advance);
            lost = (work - stored + (advance - advance_before)).keep_where(plastic);
            largest = R::select(plastic, y, largest);
        }
        let cube = own * own * own;
        let stiffer_cap = now.stiffer.keep_where(attached);
        let ninth = number(PI / 6.0 * self.adhesion) * (root * root * root);
        let force = ninth * curve::force(cube) * stiffer_cap;
        let (separation_scale, c) = (number(self.separation_scale), now.scale);
        let contact_radius =
            (separation_scale * (root * root) * ((c * c) * (own * own))).keep_where(attached);
        let energy = number(1.5) * ninth * unit;
        let potential = (energy * (now.energy(own) - advance)).keep_where(attached);
        let surface = number(-PI * self.adhesion) * contact_radius * contact_radius;

        let parts = was_attached & !attached;
        let (mut adhesive, mut applied_force) = (zero, force);
        if (attaches | parts).any() {
            let curve_energy = number(2.0 / 3.0) * energy * before.stiffer * before.scale;
            let advance = energy * advance_before;
            adhesive = (curve_energy * number(curve::SNAP_IN) + advance).keep_where(attaches)
                + (curve_energy * number(curve::SNAP_OFF) - advance).keep_where(held & !attached);
            // Bodies that overlapped already, in a first look or under another law, met before this step.
            let meets = attaches & attached & !(fresh & motion.touched_before());
            let sets_in = events::sets_in(motion, before.start * unit, force);
            applied_force = R::select(meets, sets_in, force);
            let separation = (before.start - number(3.0) * before.scale) * unit;
            let last = number(-5.0) * ninth * before.stiffer;
            applied_force = R::select(parts, events::ends(motion, separation, last), applied_force);
        }
        let kept = attached | (largest.gt(zero) & motion.touching);
        *memory = ThorntonNingMemory {
            cube_root_radius: root.keep_where(kept),
            yield_radius: limit.at.keep_where(kept),
            largest_radius: largest.keep_where(kept),
            attached: one.keep_where(attached),
        };
        NormalResponse {
            applied_force,
            in_contact: attached,
            was_in_contact: was_attached | (!recorded & motion.touched_before()),
            friction_reference: ninth * curve::friction_reference(cube) * stiffer_cap,
            contact_radius,
            pull_off_force: number(9.0) * ninth * stiffer_cap,
            adhesive_potential: surface,
            dissipated_plastic: energy * lost,
            dissipated_adhesive: adhesive,
            ..NormalResponse::elastic(
                motion,
                force,
                potential - surface,
                number(2.0 * self.dry.modulus) * contact_radius,
            )
        }
    }

    pub(super) fn branch(
        &self,
        pair: &Pair,
        overlap: f64,
        memory: &ThorntonNingMemory<f64>,
    ) -> (u8, &'static str) {
        const APART: (u8, &str) = (0, "apart");
        let root = elementary::cbrt(effective_radius(pair));
        let (relative, m) = (overlap / self.unit(root), memory.largest_radius);
        let limit = Yield { pressure: self.pressure(root), at: memory.yield_radius };
        let attached = memory.attached > 0.5;
        if m > 0.0 {
            let curve = self.unloading(limit, m);
            let cube = m * m * m;
            // After the response the point lies on its curve to round-off only.
            let round_off = 16.0 * f64::EPSILON * m * (cube + 4.0);
            return match relative {
                relative if relative >= m * (cube - 4.0) - round_off => (2, "plastic"),
                relative if relative >= curve.start => (3, "unloading"),
                relative if attached && relative > curve.start - 3.0 * curve.scale => (3, "unloading"),
                _ => APART,
            };
        }
        if overlap < 0.0 && !(attached && relative > -3.0) {
            return APART;
        }
        let y = curve::invert((3.0 + relative).max(f64::MIN_POSITIVE));
        if y * y * y - 2.0 > limit.pressure * y { (2, "plastic") } else { (1, "elastic") }
    }
}
