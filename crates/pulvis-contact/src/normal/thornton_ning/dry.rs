//! Elastic-perfectly plastic spheres without adhesion.

use std::f64::consts::PI;

use pulvis_math::Real;

use super::ThorntonNingMemory;
use crate::kinematics::NormalMotion;
use crate::normal::NormalResponse;
use crate::normal::hertz::effective_radius;
use crate::pair::Pair;

/// With m = a_max/a_y >= 1 the largest radius over that at yield, a_y = π R p_y/(2 E*): R_p/R = 2 m³/(3 m² − 1) and
/// δ_p = (a_y²/R) m² (1 − R/R_p). The force while the contact yields, π p_y a_y² (m² − 1/3), is where unloading begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Dry {
    /// Effective modulus E* [Pa].
    pub modulus: f64,
    /// Limiting pressure p_y [Pa].
    pub pressure: f64,
}

impl Dry {
    /// a_y/R [1].
    fn relative_yield_radius(&self) -> f64 {
        0.5 * PI * self.pressure / self.modulus
    }

    /// Energy lost up to the largest radius, over π p_y a_y⁴/R: the work of loading less what unloading gives back.
    #[inline(always)]
    fn lost<R: Real>(m: R) -> R {
        let number = R::splat;
        let square = m * m;
        let (beyond, triple) = (square - R::one(), number(3.0) * square - R::one());
        let work = number(4.0 / 15.0) + beyond * (number(2.0 / 3.0) + number(0.5) * beyond);
        work - triple * triple / (number(15.0) * m)
    }

    #[inline(always)]
    pub(super) fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut ThorntonNingMemory<R>,
    ) -> NormalResponse<R> {
        let (one, number, depth) = (R::one(), R::splat, motion.depth);
        let radius = number(0.5) / motion.pair.inverse_harmonic_radius();
        let yield_radius = number(self.relative_yield_radius()) * radius;
        let yield_overlap = number(self.relative_yield_radius()) * yield_radius;
        let before = memory.largest_radius.max(one);
        let largest = ((radius * depth).sqrt() / yield_radius).max(before);
        let square = largest * largest;
        // R/R_p.
        let sharper = (number(1.5) * square - number(0.5)) / (square * largest);
        let stretched = (depth - yield_overlap * square * (one - sharper)).max(R::zero());
        let contact_radius = (radius / sharper * stretched).sqrt();
        let stiffness = number(2.0 * self.modulus) * contact_radius;
        let force = number(2.0 / 3.0) * stiffness * stretched;
        let work = number(PI * self.pressure) * (yield_radius * yield_radius) * yield_overlap;
        let plastic = work * (Self::lost(largest) - Self::lost(before));
        let yielded = motion.touching & largest.gt(one);
        memory.largest_radius = largest.keep_where(yielded);
        memory.yield_radius = one.keep_where(yielded);
        NormalResponse {
            contact_radius,
            dissipated_plastic: plastic,
            ..NormalResponse::elastic(motion, force, number(0.4) * force * stretched, stiffness)
        }
    }

    pub(super) fn branch(
        &self,
        pair: &Pair,
        overlap: f64,
        memory: &ThorntonNingMemory<f64>,
    ) -> (u8, &'static str) {
        if overlap <= 0.0 {
            return (0, "open");
        }
        let radius = effective_radius(pair);
        let yield_radius = self.relative_yield_radius() * radius;
        let before = memory.largest_radius.max(1.0);
        // After the response the point lies on its curve to round-off only.
        if (radius * overlap).sqrt() / yield_radius >= before * (1.0 - 8.0 * f64::EPSILON) {
            return (2, "plastic");
        }
        let square = before * before;
        let sharper = (1.5 * square - 0.5) / (square * before);
        let free = self.relative_yield_radius() * yield_radius * square * (1.0 - sharper);
        match memory.largest_radius > 0.0 {
            false => (1, "elastic"),
            true if overlap > free => (3, "unloading"),
            true => (4, "free"),
        }
    }
}
