//! The default variant: a contact keeps its elastic line.

use pulvis_math::{Mask, Real};

use super::{Losses, SinterLuding, SinterLudingMemory, State};
use crate::kinematics::NormalMotion;

/// The elastic line of a contact: its slope k2 and its force-free overlap.
#[derive(Clone, Copy)]
struct Line<R> {
    slope: R,
    rest: R,
}

impl<R: Real> Line<R> {
    #[inline(always)]
    fn force(&self, overlap: R) -> R {
        self.slope * (overlap - self.rest)
    }

    #[inline(always)]
    fn select(mask: R::Mask, then: Self, otherwise: Self) -> Self {
        Self {
            slope: R::select(mask, then.slope, otherwise.slope),
            rest: R::select(mask, then.rest, otherwise.rest),
        }
    }
}

impl SinterLuding {
    /// Half of the motion with the plastic stiffness of before, then heat, then the other half.
    #[inline(always)]
    pub(super) fn follow_line<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        before: SinterLudingMemory<R>,
        plastic: R,
    ) -> State<R> {
        let (zero, depth) = (R::zero(), motion.depth);
        let inverse_limit = self.inverse_limit(&motion.pair);
        let begins = before.elastic_stiffness.le(zero);
        let mut line =
            Line { slope: R::select(begins, R::splat(self.k1), before.elastic_stiffness), rest: before.rest };
        let mut losses = Losses::default();
        let changed = !begins & (plastic - before.plastic_stiffness).abs().gt(zero);
        if changed.any() {
            let middle = R::splat(0.5) * (before.depth + depth);
            let mut on_the_way = Losses::default();
            let moved =
                self.moved(line, begins, before.plastic_stiffness, middle, inverse_limit, &mut on_the_way);
            let heated = self.heated(moved, plastic, middle, inverse_limit, &mut on_the_way);
            losses = on_the_way.keep_where(changed);
            line = Line::select(changed, heated, line);
        }
        line = self.moved(line, begins, plastic, depth, inverse_limit, &mut losses);
        State {
            memory: SinterLudingMemory {
                elastic_stiffness: line.slope,
                rest: line.rest,
                overlap_max: zero,
                ..before
            },
            force: line.force(depth),
            stiffness: line.slope,
            losses,
        }
    }

    /// The line at another plastic stiffness and the same overlap: what lies above the lines of loading flows, and no line is
    /// softer than they are.
    #[inline(always)]
    fn heated<R: Real>(
        &self,
        line: Line<R>,
        plastic: R,
        overlap: R,
        inverse_limit: R,
        losses: &mut Losses<R>,
    ) -> Line<R> {
        let (half, one) = (R::splat(0.5), R::one());
        let reached = overlap.min(one / inverse_limit);
        let force = line.force(overlap);
        let top = plastic * reached + R::splat(self.kp) * (overlap - reached);
        let (stiffer, flows) = (line.slope.max(plastic), force.gt(top));
        let hardened = stiffer.max(self.hardened(plastic, overlap, inverse_limit));
        let slope = R::select(flows, hardened, stiffer);
        let stiffens = slope.gt(line.slope);
        let kept = line.slope / slope;
        let rest = R::select(
            flows,
            reached * (one - plastic / slope),
            R::select(stiffens, overlap * (one - kept) + line.rest * kept, line.rest),
        );
        let flow = R::select(flows, top, force);
        let lost = half * (force * force / line.slope - flow * flow / slope);
        losses.thermal += lost.keep_where(flows | stiffens);
        Line { slope, rest }
    }

    /// The line after a motion to an overlap, where a contact `begins` the first one.
    #[inline(always)]
    fn moved<R: Real>(
        &self,
        line: Line<R>,
        begins: R::Mask,
        plastic: R,
        overlap: R,
        inverse_limit: R,
        losses: &mut Losses<R>,
    ) -> Line<R> {
        let (zero, half, one, kc) = (R::zero(), R::splat(0.5), R::one(), R::splat(self.kc));
        let mut line = line;
        // The limit is infinite where kp = k1.
        let reached = overlap.min(one / inverse_limit);
        // A contact that begins lies on the line of loading itself, where to compare forces is to compare round-off.
        let virgin = begins | (line.rest.le(zero) & line.slope.le(plastic));
        let yields = line.force(reached).gt(plastic * reached) | virgin;
        if yields.any() {
            let steeper = line.slope - plastic;
            let meets = line.slope * line.rest / R::select(steeper.gt(zero), steeper, one);
            let slope = line.slope.max(self.hardened(plastic, reached, inverse_limit));
            let spring = |overlap: R, slope: R| overlap * overlap * (one - plastic / slope);
            let lost = half * plastic * (spring(reached, slope) - spring(meets, line.slope));
            losses.plastic += lost.keep_where(yields);
            let loaded = Line { slope, rest: reached * (one - plastic / slope) };
            line = Line::select(yields, loaded, line);
        }
        let at_limit = line.force(overlap).lt(-(kc * overlap));
        if at_limit.any() {
            let (meets, both) = (line.slope * line.rest / (line.slope + kc), one + kc / line.slope);
            let lost = half * kc * both * (meets - overlap) * (meets + overlap);
            losses.adhesive += lost.keep_where(at_limit);
            line.rest = R::select(at_limit, overlap * both, line.rest);
        }
        line
    }
}
