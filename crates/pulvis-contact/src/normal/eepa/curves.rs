//! The curves of the law: unloading, and the adhesive limit.

use std::f64::consts::PI;

use pulvis_math::{Mask, Real, elementary};

use super::{Adhesion, Eepa};
use crate::expected::ExpectedLoading;
use crate::pair::Pair;

/// A point of an unloading curve: the overlap and its power n.
#[derive(Clone, Copy)]
pub(super) struct Strain<R> {
    pub(super) overlap: R,
    pub(super) power: R,
}

impl Eepa {
    /// k_adh of a contact with the plastic overlap of `plastic` [N/m^x].
    #[inline(always)]
    pub(super) fn adhesion_stiffness<R: Real>(&self, pair: &Pair<R>, plastic: Strain<R>) -> R {
        let energy = match self.adhesion {
            Adhesion::Stiffness(stiffness) => return R::splat(stiffness),
            Adhesion::SurfaceEnergy(energy) => energy,
        };
        // √(2 δ_p R), R = a12/2.
        let radius = (plastic.overlap / pair.inverse_harmonic_radius()).sqrt();
        let pull = R::splat(1.5 * PI * energy) * radius;
        let pull = pull.min(R::splat(0.5 * self.k2) * plastic.power);
        let end = plastic.power - pull * R::splat(1.0 / self.k2);
        let end = if self.adhesion_power == self.power {
            end
        } else {
            self.adhesion_power.of(self.power.inverse(end))
        };
        // The power of an overlap near zero may vanish.
        pull / end.max(R::splat(f64::MIN_POSITIVE))
    }

    /// The overlap δ_min at which the unloading curve of `plastic` meets the adhesive limit.
    ///
    /// Of a convex function Newton's method falls monotonically to the root; lanes that have arrived are frozen.
    #[inline(always)]
    pub(super) fn limit_begins<R: Real>(&self, plastic: Strain<R>, adhesion_stiffness: R) -> R {
        let ratio = adhesion_stiffness * R::splat(1.0 / self.k2);
        if self.adhesion_power == self.power {
            return self.power.inverse(plastic.power / (R::one() + ratio));
        }
        let (n, x) = (R::splat(self.power.exponent()), R::splat(self.adhesion_power.exponent()));
        let mut root = plastic.overlap;
        for _ in 0..100 {
            let (line, limit) = (self.power.of(root), ratio * self.adhesion_power.of(root));
            let next = root - root * (line + limit - plastic.power) / (n * line + x * limit);
            let falls = next.lt(root);
            root = R::select(falls, next, root);
            if !falls.any() {
                break;
            }
        }
        root
    }

    /// ∫ k2 (δ^n − δ_p^n) dδ from δ_p on [J].
    #[inline(always)]
    pub(super) fn stored_energy<R: Real>(&self, at: Strain<R>, plastic: Strain<R>) -> R {
        R::splat(self.k2) * self.power.area_above(at.overlap, at.power, plastic.overlap, plastic.power)
    }

    /// What the adhesive limit has lost at its end, where the contact holds the point `at`: work and stored energy.
    #[inline(always)]
    pub(super) fn limit_potential<R: Real>(
        &self,
        at: Strain<R>,
        plastic: Strain<R>,
        adhesion_stiffness: R,
    ) -> R {
        let share = R::splat(1.0 / (self.adhesion_power.exponent() + 1.0));
        let work = share * adhesion_stiffness * self.adhesion_power.of(at.overlap) * at.overlap;
        work + self.stored_energy(at, plastic)
    }

    /// The overlap that the expected loading reaches [m].
    pub(super) fn expected_overlap(&self, pair: &Pair, expected: &ExpectedLoading) -> f64 {
        let n = self.power.exponent();
        let energy = 0.5 * pair.reduced_mass() * expected.speed * expected.speed;
        let of_speed = elementary::powf((n + 1.0) * energy / self.k1, 1.0 / (n + 1.0));
        let of_force = self.power.inverse((expected.force + (n + 1.0) * self.f_0) / self.k1);
        of_speed.max(of_force).max(expected.overlap * 0.5 * pair.harmonic_radius())
    }
}
