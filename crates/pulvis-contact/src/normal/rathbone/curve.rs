//! Loading and unloading in units of the critical overlap w_c and of the critical force P_c.

use std::f64::consts::PI;

use pulvis_math::elementary::{cos, exp, ln, powf};

/// Largest overlap of the fits over w_c: far beyond, the exponent of unloading would fall below one.
const LAST: f64 = 1e5;

/// Where yielding begins, and the energy stored there. The plastic curve begins beyond, for any of the allowed parameters.
pub(super) const ONSET: (f64, f64) = (1.0, 0.4);

/// Panels of a quadrature reach up to this ratio of overlaps: four points then err by less than 1e-13.
const PANEL: f64 = 1.15;

/// Ratio of overlaps from one look at a curve to the next.
const STRIDE: f64 = 1.1;

/// Nodes and weights of Gauss and Legendre on (−1, 1), the positive half.
const GAUSS: [[f64; 2]; 2] = [
    [0.339_981_043_584_856_26, 0.652_145_154_862_546_1],
    [0.861_136_311_594_052_6, 0.347_854_845_137_453_85],
];

/// The curves of one pair of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Curve {
    /// c = π C S_y/(2 E*), the square root of w_c/R.
    pub(super) critical: f64,
    /// 4/C.
    hardening: f64,
    /// B.
    exponent: f64,
    /// Where the elastic and the plastic curve meet.
    pub(super) meeting: f64,
    /// Where the contact becomes elastic for good.
    pub(super) last: f64,
}

/// A contact that has been loaded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loaded {
    pub(super) force: f64,
    pub(super) residual: f64,
    pub(super) exponent: f64,
    /// Energy lost on the way.
    pub(super) lost: f64,
}

impl Curve {
    /// For a yield strain S_y/E* and Poisson's ratio.
    pub(super) fn new(strain: f64, poisson: f64) -> Self {
        let factor = 1.295 * exp(0.736 * poisson);
        let critical = 0.5 * PI * factor * strain;
        let exponent = 0.14 * exp(23.0 * strain);
        let filled = powf(powf(1.9, exponent) / (critical * critical), 1.0 / (1.0 + exponent));
        let mut curve =
            Self { critical, hardening: 4.0 / factor, exponent, meeting: 0.5, last: filled.min(LAST) };
        // The plastic curve lies above the elastic one at 0.5 and below it at 20, for any of the allowed parameters.
        let (mut low, mut high) = (0.5, 20.0);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if curve.plastic(middle) > elastic(middle) { low = middle } else { high = middle }
        }
        curve.meeting = low;
        curve
    }

    fn plastic(&self, w: f64) -> f64 {
        let radius = (self.critical * (w * powf(w / 1.9, self.exponent)).sqrt()).min(1.0);
        let hardness = 2.84 - 0.92 * (1.0 - cos(PI * radius));
        let yielding = self.hardening * hardness * (1.0 - exp(-powf(w, 5.0 / 9.0) / 25.0));
        exp(-0.25 * powf(w, 5.0 / 12.0)) * elastic(w) + yielding * w
    }

    fn virgin(&self, w: f64) -> f64 {
        if w <= self.meeting { elastic(w) } else { self.plastic(w) }
    }

    /// Work of the plastic curve from one overlap to another.
    fn plastic_work(&self, from: f64, to: f64) -> f64 {
        let panels = (ln(to / from) / ln(PANEL)).ceil().max(1.0);
        let ratio = powf(to / from, 1.0 / panels);
        let (mut start, mut work) = (from, 0.0);
        for panel in 1..=panels as u32 {
            let end = if f64::from(panel) == panels { to } else { start * ratio };
            let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
            for [node, weight] in GAUSS {
                work +=
                    half * weight * (self.plastic(middle - half * node) + self.plastic(middle + half * node));
            }
            start = end;
        }
        work
    }

    /// Loads a contact from its largest overlap, at which it stores an energy, to a larger one.
    pub(super) fn load(&self, (from, stored): (f64, f64), to: f64) -> Loaded {
        let residual = to * residual_part(to);
        let force = self.virgin(to);
        let width = force * (to - residual);
        let elastic_work = |from: f64, to: f64| 0.4 * (elastic(to) * to - elastic(from) * from);
        if to <= self.meeting {
            let kept = width / 2.5;
            return Loaded { force, residual, exponent: 1.5, lost: elastic_work(from, to) + stored - kept };
        }
        let (mut start, mut stored, mut lost) = (from, stored, 0.0);
        if from < self.meeting {
            let kept = elastic(self.meeting) * self.meeting * (1.0 - residual_part(self.meeting)) / 2.5;
            lost = elastic_work(from, self.meeting) + stored - kept;
            (start, stored) = (self.meeting, kept);
        }
        let given = stored + self.plastic_work(start, to);
        let published = 1.5 * powf(to, -0.0331);
        let kept = width / (published + 1.0);
        if kept <= given {
            return Loaded { force, residual, exponent: published, lost: lost + given - kept };
        }
        Loaded { force, residual, exponent: width / given - 1.0, lost }
    }

    /// The overlap at which a virgin contact has taken up an energy and bears a force; at most a tenth more. Zero where it
    /// stays elastic.
    pub(super) fn pressed_by(&self, energy: f64, force: f64) -> f64 {
        let (mut overlap, mut work) = (self.meeting, 0.4 * elastic(self.meeting) * self.meeting);
        while (work < energy || self.virgin(overlap) < force) && overlap < self.last {
            let next = STRIDE * overlap;
            work += self.plastic_work(overlap, next);
            overlap = next;
        }
        if overlap > self.meeting { overlap } else { 0.0 }
    }

    /// The steepest slope of unloading from any overlap beyond the onset up to this one: near a = R it falls again.
    pub(super) fn steepest(&self, up_to: f64) -> f64 {
        let reached = up_to.min(self.last);
        let (mut start, mut steepest) = (ONSET, 0.0_f64);
        while start.0 < reached {
            let end = (STRIDE * start.0).min(reached);
            let Loaded { force, residual, exponent, .. } = self.load(start, end);
            let width = end - residual;
            let part = if end < self.last { 1.0 } else { (up_to - residual) / width };
            let slope = exponent * force / width * powf(part, exponent - 1.0);
            // Between two overlaps it is a little steeper at the most.
            steepest = steepest.max(1.01 * slope);
            start = (end, force * width / (exponent + 1.0));
        }
        steepest
    }
}

fn elastic(w: f64) -> f64 {
    w * w.sqrt()
}

/// δ_r/δ_m.
fn residual_part(w: f64) -> f64 {
    if w <= 1.0 { 0.0 } else { (1.0 - powf(w, -0.28)) * (1.0 - powf(w, -0.69)) }
}
