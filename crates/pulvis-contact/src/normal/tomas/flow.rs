//! Plastic flow of the contact: where it is pulled off afterwards, and what is lost.

use std::f64::consts::PI;

use pulvis_math::Real;

use super::TomasMemory;
use crate::functions::cbrt;

/// The line of flow, in units of the overlap h_f at which it begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flow {
    /// p_f [Pa].
    pub(super) yield_pressure: f64,
    /// h_f/r [1].
    strain: f64,
    /// κ_p = p_vdw/p_f [1].
    kappa: f64,
    /// 1 where the published line jumps at h_f, 0 where it is continuous.
    pub(super) jump: f64,
    /// The largest F_H0/r of a contact of the radius zero [N/m] …
    pub(super) limit_at_zero: f64,
    /// … and its growth with the radius [N/m²].
    pub(super) limit_growth: f64,
}

/// One contact.
pub(super) struct Contact<R> {
    /// Effective radius r [m].
    pub(super) radius: R,
    /// F_H0 [N].
    pub(super) permanent: R,
    /// h_f [m].
    pub(super) begins: R,
}

/// What flow leads to.
pub(super) struct Flowed<R> {
    /// h_A [m].
    pub(super) pull_off_overlap: R,
    /// Energy lost by the flow [J].
    pub(super) lost: R,
}

impl Flow {
    pub(super) fn new(
        modulus: f64,
        [yield_pressure, vdw_pressure]: [f64; 2],
        [distance, cutoff]: [f64; 2],
        jumps: bool,
    ) -> Self {
        let strain = PI * yield_pressure / modulus;
        let jump = if jumps { 1.0 } else { 0.0 };
        let kappa = vdw_pressure / yield_pressure;
        let strain = strain * strain;
        let end = distance / (distance + cutoff);
        let half = 0.5 * PI * vdw_pressure * distance * (1.0 - end * end);
        let flow = Self { yield_pressure, strain, kappa, jump, limit_at_zero: half, limit_growth: 0.0 };
        // Yielding loses energy as long as F_U + π r p_vdw (h_U − h_A + a_0/2) >= 0 at h_f, and beyond, too;
        // a_0/2 is that of a cutoff without end.
        let height = flow.root(1.0, 1.0);
        let force = 2.0 / 3.0 + kappa * (height * height - jump);
        Self { limit_growth: PI * yield_pressure * strain * force, ..flow }
    }

    /// h_f [m].
    #[inline(always)]
    pub(super) fn yield_overlap<R: Real>(&self, radius: R) -> R {
        R::splat(self.strain) * radius
    }

    /// A lower bound of the slope of the line of flow [N/m].
    pub(super) fn least_slope(&self, radius: f64, vdw_pressure: f64) -> f64 {
        PI * radius * (2.0 / 3.0 * self.yield_pressure - vdw_pressure)
    }

    /// τ = √((h_U − h_A)/h_f) for η = h_U/h_f and its cube root: the root of (2/3) τ³ + κ_p τ² = η − η^(2/3)/3 (+ κ_p).
    ///
    /// Two steps of Halley's method from the expansion for large τ: round-off.
    #[inline(always)]
    pub(super) fn root<R: Real>(&self, eta: R, cube_root: R) -> R {
        let number = R::splat;
        let kappa = self.kappa;
        let third = number(1.0 / 3.0);
        let target = eta - third * cube_root * cube_root + number(kappa * (1.0 - self.jump));
        let c = cbrt(number(1.5) * (target - number(kappa * kappa * kappa / 6.0)));
        let mut root = c - number(0.5 * kappa) + number(0.25 * kappa * kappa) / c;
        for _ in 0..2 {
            let value = (number(2.0 / 3.0) * root + number(kappa)) * root * root - target;
            let slope = number(2.0) * root * (root + number(kappa));
            let bend = number(4.0) * root + number(2.0 * kappa);
            let twice = number(2.0) * slope;
            root -= twice * value / (twice * slope - value * bend);
        }
        root
    }

    /// Work of the flow minus the energy held at its end, but for a constant, over π r p_f h_f².
    #[inline(always)]
    fn potential<R: Real>(&self, eta: R, cube_root: R, root: R, adhesion: R, tail: R) -> R {
        let number = R::splat;
        let square = root * root;
        let pull_off = eta - square;
        let work = number(0.5 * (1.0 - self.kappa)) * eta * eta - number(0.2) * eta * cube_root * cube_root
            + number(self.kappa * (1.0 - self.jump)) * eta;
        let attraction = pull_off * (number(self.kappa) * (square + tail) - adhesion);
        work + attraction - number(4.0 / 15.0) * square * square * root
    }

    /// The flow of `contact` to an overlap from what it remembers.
    #[inline(always)]
    pub(super) fn to<R: Real>(
        &self,
        contact: &Contact<R>,
        overlap: R,
        before: &TomasMemory<R>,
        distance: f64,
        cutoff: f64,
    ) -> Flowed<R> {
        let (number, one) = (R::splat, R::one());
        let inverse = one / contact.begins;
        let unit = number(PI * self.yield_pressure) * contact.radius * contact.begins;
        let end = distance / (distance + cutoff);
        let tail = number(0.5 * distance * (1.0 - end * end)) * inverse;
        let adhesion = contact.permanent / unit;
        // Lanes that do not flow are computed at h_f.
        let eta = (overlap * inverse).max(one);
        let cube_root = cbrt(eta);
        let root = self.root(eta, cube_root);
        let after = self.potential(eta, cube_root, root, adhesion, tail);
        let had_flowed = before.yield_overlap.gt(R::zero());
        let eta_before = R::select(had_flowed, before.yield_overlap * inverse, one);
        let height = (before.yield_overlap - before.pull_off_overlap) * inverse;
        let root_before = R::select(had_flowed, height, one).max(R::zero()).sqrt();
        let earlier = self.potential(eta_before, cbrt(eta_before), root_before, adhesion, tail);
        Flowed {
            pull_off_overlap: (overlap - contact.begins * root * root).max(R::zero()),
            lost: unit * contact.begins * (after - earlier),
        }
    }
}
