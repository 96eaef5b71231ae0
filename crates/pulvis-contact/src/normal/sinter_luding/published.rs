//! The published variant: a contact keeps its largest overlap.

use pulvis_math::{Mask, Real};

use super::{Losses, SinterLuding, SinterLudingMemory, State};
use crate::kinematics::NormalMotion;

/// Where a contact with a largest overlap stands.
#[derive(Clone, Copy)]
struct Point<R> {
    overlap_max: R,
    k2: R,
    force: R,
}

impl<R: Real> Point<R> {
    #[inline(always)]
    fn energy(&self) -> R {
        R::splat(0.5) * self.force * self.force / self.k2
    }
}

impl SinterLuding {
    /// Half of the motion with the plastic stiffness of before, then heat at the largest overlap of then, then the other
    /// half.
    #[inline(always)]
    pub(super) fn follow_overlap<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        before: SinterLudingMemory<R>,
        plastic: R,
    ) -> State<R> {
        let zero = R::zero();
        let inverse_limit = self.inverse_limit(&motion.pair);
        let mut overlap_max = before.overlap_max;
        let mut losses = Losses::default();
        let changed = before.plastic_stiffness.gt(zero) & (plastic - before.plastic_stiffness).abs().gt(zero);
        if changed.any() {
            let middle = R::splat(0.5) * (before.depth + motion.depth);
            let mut on_the_way = Losses::default();
            let old = before.plastic_stiffness;
            let moved = self.loaded(old, overlap_max, middle, inverse_limit, &mut on_the_way);
            // What the tensile limit takes from the changed line is part of the change.
            let heated =
                self.point(plastic, moved.overlap_max, middle, inverse_limit, &mut Losses::default());
            on_the_way.thermal = moved.energy() - heated.energy();
            losses = on_the_way.keep_where(changed);
            overlap_max = R::select(changed, heated.overlap_max, overlap_max);
        }
        let end = self.loaded(plastic, overlap_max, motion.depth, inverse_limit, &mut losses);
        State {
            memory: SinterLudingMemory {
                elastic_stiffness: zero,
                rest: zero,
                overlap_max: end.overlap_max,
                ..before
            },
            force: end.force,
            stiffness: end.k2,
            losses,
        }
    }

    /// A contact after a motion to an overlap.
    #[inline(always)]
    fn loaded<R: Real>(
        &self,
        plastic: R,
        overlap_max: R,
        overlap: R,
        inverse_limit: R,
        losses: &mut Losses<R>,
    ) -> Point<R> {
        let one = R::one();
        let loaded = overlap_max.max(overlap.min(one / inverse_limit));
        let after = self.part_lost(plastic, loaded, inverse_limit);
        let lost = R::splat(0.5) * plastic * (after - self.part_lost(plastic, overlap_max, inverse_limit));
        losses.plastic += lost.keep_where(loaded.gt(overlap_max));
        self.point(plastic, loaded, overlap, inverse_limit, losses)
    }

    /// What loading to a largest overlap loses, over k/2.
    #[inline(always)]
    fn part_lost<R: Real>(&self, plastic: R, overlap_max: R, inverse_limit: R) -> R {
        let part = plastic / self.hardened(plastic, overlap_max, inverse_limit);
        overlap_max * overlap_max * (R::one() - part)
    }

    /// What the tensile limit takes from the line of a largest overlap down to no overlap.
    #[inline(always)]
    fn work_of_limit<R: Real>(&self, plastic: R, overlap_max: R, k2: R) -> R {
        let kc = R::splat(self.kc);
        let stretched = (k2 - plastic) * overlap_max;
        R::splat(0.5) * kc * stretched * stretched / (k2 * (k2 + kc))
    }

    /// Where a contact with a largest overlap stands at an overlap, S1 section 2.2.5 with k for k1.
    #[inline(always)]
    fn point<R: Real>(
        &self,
        plastic: R,
        overlap_max: R,
        overlap: R,
        inverse_limit: R,
        losses: &mut Losses<R>,
    ) -> Point<R> {
        let (number, half, kc) = (R::splat, R::splat(0.5), R::splat(self.kc));
        let k2 = self.hardened(plastic, overlap_max, inverse_limit);
        let line = k2 * overlap - (k2 - plastic) * overlap_max;
        let tensile = -(kc * overlap);
        let at_limit = line.lt(tensile);
        if !at_limit.any() {
            return Point { overlap_max, k2, force: line };
        }
        let ratio = (plastic + kc) / (number(self.kp) - plastic).max(number(f64::MIN_POSITIVE));
        let y = overlap * inverse_limit;
        let root = (y * (y + number(4.0) * ratio)).sqrt();
        let shrunk = (half * (y + root) / inverse_limit).min(overlap_max);
        let softer = self.hardened(plastic, shrunk, inverse_limit);
        let lost = self.work_of_limit(plastic, overlap_max, k2) - self.work_of_limit(plastic, shrunk, softer);
        losses.adhesive += lost.keep_where(at_limit);
        Point {
            overlap_max: R::select(at_limit, shrunk, overlap_max),
            k2: R::select(at_limit, softer, k2),
            force: R::select(at_limit, tensile, line),
        }
    }
}
