//! The law of Johnson, Kendall and Roberts for adhesive elastic spheres.

use std::f64::consts::PI;

use pulvis_math::{Mask, Real, elementary};

use super::adhesive_curve as curve;
use super::dmt::WORK_OF_ADHESION;
use super::hertz::{EFFECTIVE_MODULUS, effective_radius, expected_overlap};
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Role, Values};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::functions::cbrt;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Adhesive elastic spheres with snap-in and snap-off.
///
/// ```text
/// F(a) = 4 E* a³/(3 R) − √(8 π Γ E* a³)        δ(a) = a²/R − √(2 π Γ a/E*)
/// ```
///
/// Bodies attach when they touch (δ ≥ 0) and stay attached until δ falls to δ_sep = −3 a_sep²/R, where the neck
/// breaks. With y = √(a/a_sep) ≥ 1 all pairs share one curve, δ = s (y⁴ − 4 y) and F = (F_c/9) y³ (y³ − 6), with
/// a_sep = (π Γ R²/(8 E*))^(1/3), s = a_sep²/R and the pull-off force F_c = (3/2) π Γ R.
///
/// The energy is split in two: what the bodies store elastically, and −Γ π a² of the surfaces that touch. What
/// snap-in and snap-off lose, 3.6·4^(4/3) and 2.4 times F_c s/9, is booked as adhesive.
///
/// A step in which the force sets in or ends applies it for the part of the step in which it acted.
///
/// # Source
/// K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. Lond. A 324, 301 (1971); K. L. Johnson, *Contact
/// Mechanics* (1985), section 5.5. The single curve, its inversion and the losses are derived from these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jkr {
    /// Effective modulus E* [Pa].
    effective_modulus: f64,
    /// Work of adhesion Γ of both surfaces together [J/m²].
    work_of_adhesion: f64,
    /// a_sep/R^(2/3) = (π Γ/(8 E*))^(1/3) [m^(1/3)].
    separation_scale: f64,
}

impl Law for Jkr {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "jkr",
        summary: "adhesive elastic spheres with snap-in and snap-off",
        equations: "\
F   = 4 E* a³/(3 R) − √(8 π Γ E* a³)   δ = a²/R − √(2 π Γ a/E*)
attached from δ ≥ 0 until δ ≤ δ_sep = −3 a_sep²/R,  a_sep = (π Γ R²/(8 E*))^(1/3)
F_c = (3/2) π Γ R                      pull-off force;  friction refers to F + 2 F_c",
        source: "Johnson, Kendall & Roberts, Proc. R. Soc. Lond. A 324, 301 (1971)",
        parameters: &[EFFECTIVE_MODULUS, WORK_OF_ADHESION],
        particle_quantities: &[],
        memory: &["cube_root_radius [m^(1/3)]"],
        closed_form: "pull-off, separation and restitution in pulvis_contact::theory::jkr",
        example: "law = \"jkr\"\neffective_modulus = \"1e9 Pa\"\nwork_of_adhesion = \"0.1 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self::new(values.number("effective_modulus")?, values.number("work_of_adhesion")?))
    }
}

impl Jkr {
    /// Effective modulus E* [Pa] and work of adhesion Γ of both surfaces together [J/m²].
    pub fn new(effective_modulus: f64, work_of_adhesion: f64) -> Self {
        let separation_scale = elementary::cbrt(PI * work_of_adhesion / (8.0 * effective_modulus));
        Self { effective_modulus, work_of_adhesion, separation_scale }
    }

    /// Effective modulus E* [Pa].
    pub fn effective_modulus(&self) -> f64 {
        self.effective_modulus
    }

    /// Work of adhesion Γ of both surfaces together [J/m²].
    pub fn work_of_adhesion(&self) -> f64 {
        self.work_of_adhesion
    }

    /// a_sep [m].
    fn separation_radius(&self, radius: f64) -> f64 {
        let root = elementary::cbrt(radius);
        self.separation_scale * root * root
    }

    /// The answer, and y³ where the bodies are attached.
    #[inline(always)]
    pub(super) fn on_curve<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut [R; 1],
    ) -> (NormalResponse<R>, R) {
        let number = R::splat;
        let (zero, one) = (R::zero(), R::one());
        let before = memory[0].gt(zero);
        let touches = motion.overlap.ge(zero);
        let sets_in = touches & !before;
        let mut root = memory[0];
        if sets_in.any() {
            let inverse_radius = number(2.0) * motion.pair.inverse_harmonic_radius();
            root = R::select(sets_in, cbrt(one / inverse_radius), root);
        }
        let bound = before | touches;
        // Pairs apart shall not divide by zero.
        let safe = R::select(bound, root, one);
        let scale = self.separation_scale;
        let unit = number(scale * scale) * safe;
        let e = number(3.0) + motion.overlap / unit;
        let attached = bound & e.gt(zero);
        let ends = before & !attached;
        let y = curve::invert(e.max(number(f64::MIN_POSITIVE)));

        let cube = y * y * y;
        let ninth = number(PI / 6.0 * self.work_of_adhesion) * (safe * safe * safe);
        let contact_radius = (number(scale) * (safe * safe) * (y * y)).keep_where(attached);
        let force = (ninth * curve::force(cube)).keep_where(attached);
        let limit = (ninth * curve::friction_reference(cube)).keep_where(attached);
        let energy = ninth * unit;
        let potential = (energy * curve::energy(y, cube)).keep_where(attached);
        let surface = number(-PI * self.work_of_adhesion) * contact_radius * contact_radius;
        let mut lost = zero;
        let mut applied_force = force;
        if (sets_in | ends).any() {
            lost = (energy * number(curve::SNAP_IN)).keep_where(sets_in)
                + (energy * number(curve::SNAP_OFF)).keep_where(ends);
            let separation_force = number(-5.0) * ninth;
            // Bodies that overlapped already, in a first look or under another law, met before this step.
            let meets = sets_in & attached & !motion.touched_before();
            let separation = number(-3.0) * unit;
            applied_force = R::select(meets, events::sets_in(motion, zero, force), force);
            applied_force =
                R::select(ends, events::ends(motion, separation, separation_force), applied_force);
        }
        memory[0] = root.keep_where(attached);
        let answer = NormalResponse {
            applied_force,
            in_contact: attached,
            was_in_contact: before | motion.touched_before(),
            friction_reference: limit,
            contact_radius,
            pull_off_force: (number(9.0) * ninth).keep_where(attached),
            adhesive_potential: surface,
            dissipated_adhesive: lost,
            ..NormalResponse::elastic(
                motion,
                force,
                potential - surface,
                number(2.0 * self.effective_modulus) * contact_radius,
            )
        };
        (answer, cube)
    }
}

impl NormalLaw for Jkr {
    /// The cube root of the effective radius while the bodies are attached, zero while they are not.
    type Memory<R: Real> = [R; 1];

    const PATH_ONLY: bool = false;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NormalResponse<R> {
        self.on_curve(motion, memory).0
    }

    fn interaction_range(&self, pair: &Pair<f64>) -> f64 {
        3.0 * self.separation_scale * self.separation_scale * elementary::cbrt(effective_radius(pair))
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        let attached = memory[0] > 0.0 && overlap > -self.interaction_range(pair);
        if attached || overlap >= 0.0 { (1, "attached") } else { (0, "apart") }
    }

    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        2.0 * self.effective_modulus * self.expected_contact_radius(pair, expected)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    /// That at the overlap to which elastic spheres are pressed; at least twice the radius at which the neck breaks.
    fn expected_contact_radius(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let separation_radius = self.separation_radius(effective_radius(pair));
        let overlap = expected_overlap(self.effective_modulus, pair, expected);
        let y = curve::invert(3.0 * (1.0 + overlap / self.interaction_range(pair)));
        separation_radius * (y * y).max(2.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law() -> Jkr {
        Jkr::new(1e9, 0.1)
    }

    fn wall() -> Pair {
        Pair::wall(1e-14, 1e-6)
    }

    #[test]
    fn attached_bodies_pull_as_published_and_part_at_the_published_distance() {
        // E* = 1e9 Pa, R = 1e-6 m, Γ = 0.1 J/m²: forces [N] at two overlaps [m], pull-off, separation.
        let mut memory = [0.0];
        let mut force =
            |overlap: f64| law().respond(&NormalMotion::at_rest(&wall(), overlap), &mut memory).force;
        assert!((force(8.397_506_176_1e-9) / 6.772_722_067e-7 - 1.0).abs() < 1e-8);
        assert!((force(2.099_376_544_0e-9) / -2.493_586_709e-7 - 1.0).abs() < 1e-8);
        // F(0) = −(8/9) F_c.
        assert!((force(0.0) / (-8.0 / 9.0 * 4.712_388_980e-7) - 1.0).abs() < 1e-9);
        assert!((law().interaction_range(&wall()) / 3.465_994_308e-9 - 1.0).abs() < 1e-9);
        let least = (0..10_000).map(|step| force(-3.4659e-9 * f64::from(step) / 1e4)).fold(0.0, f64::min);
        // A parabola about its minimum: the grid misses it by less than 1e-7 of it.
        assert!((least / -4.712_388_980e-7 - 1.0).abs() < 1e-7, "{least}");
        assert!(force(-3.46e-9) < 0.0);
        assert_eq!(force(-3.47e-9), 0.0);
        assert_eq!(force(-1e-9), 0.0, "bodies that have parted attract no more");
    }

    #[test]
    fn a_cycle_loses_the_published_energy_in_whatever_steps() {
        for steps in [1, 7, 1000] {
            let mut memory = [0.0];
            let mut lost = 0.0;
            for step in 0..=steps {
                let overlap = 2e-8 - 4e-8 * f64::from(step) / f64::from(steps);
                let answer = law().respond(&NormalMotion::at_rest(&wall(), overlap), &mut memory);
                lost += answer.dissipated_adhesive;
            }
            assert!((lost / 1.527_967_303e-15 - 1.0).abs() < 1e-9, "{lost}");
        }
    }
}
