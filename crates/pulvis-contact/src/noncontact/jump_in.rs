//! The irreversible attraction that jumps in at touch.

use pulvis_math::Real;

use super::{NonContactLaw, NonContactResponse, linear_tail, reversible};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Role, Values};
use crate::events;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Attraction that is absent on approach, jumps to −f_a at touch, and on separation fades linearly
/// down to δ_a = −f_a/k_c^a. The pair remembers the touch until it is out of reach; coming together
/// again it starts anew. The energy f_a²/(2 k_c^a) that separation will cost is booked as adhesive
/// dissipation at the jump. A step in which the force jumps applies it for the part of the step in which it acted.
///
/// # Source
/// A. Singh, V. Magnanimo, S. Luding, arXiv:1503.03720 ("S1"), eq. (15); the branch followed on
/// separation is that of eqs. (13) and (14).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JumpIn {
    /// Adhesion force f_a in contact [N].
    pub f_a: f64,
    /// Slope k_c^a on separation [N/m].
    pub kc_a: f64,
}

impl Law for JumpIn {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "jump-in",
        summary: "attraction that sets in at touch and fades on separation, irreversible",
        equations: "\
f   = 0                          on approach, δ < 0
f   = −f_a                       in contact, δ ≥ 0
f   = −k_c^a δ − f_a             after a touch, for δ_a < δ < 0,  δ_a = −f_a/k_c^a
f   = 0                          for δ ≤ δ_a; the touch is forgotten",
        source: "Singh, Magnanimo & Luding, arXiv:1503.03720, eq. 15",
        parameters: reversible::PARAMETERS,
        particle_quantities: &[],
        memory: &["touched [1]"],
        closed_form: "pull-off efficiency ε_o and v_f^a in pulvis_contact::theory (S1 eqs. 18, 19)",
        example: "law = \"jump-in\"\nf_a = \"1e-5 N\"\nkc_a = \"50 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Ok(Self { f_a: values.number("f_a")?, kc_a: values.number("kc_a")? })
    }
}

impl JumpIn {
    /// How far beyond touching the attraction acts, f_a/k_c^a [m].
    pub fn range(&self) -> f64 {
        self.f_a / self.kc_a
    }
}

impl NonContactLaw for JumpIn {
    type Memory<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NonContactResponse<R> {
        let (force, potential) = linear_tail(self.f_a, self.kc_a, motion.overlap);
        let half = R::splat(0.5);
        let before = memory[0].gt(half);
        let touches = motion.overlap.ge(R::zero());
        // Zero reach: at δ = 0 nothing is left to remember.
        let within_reach = motion.overlap.gt(R::splat(-self.range()));
        let now = (before | touches) & within_reach;
        memory[0] = R::one().keep_where(now);
        let sudden = R::splat(0.5 * self.f_a * self.range());
        let force = force.keep_where(now);
        // Bodies that overlapped already, in a first look, met before this step.
        let meets = now & !before & !motion.touched_before();
        let mut applied_force = R::select(meets, events::sets_in(motion, R::zero(), force), force);
        if self.range() <= 0.0 {
            let parts = before & !now;
            let last = R::splat(-self.f_a);
            applied_force = R::select(parts, events::ends(motion, R::zero(), last), applied_force);
        }
        NonContactResponse {
            force,
            applied_force,
            potential: potential.keep_where(now),
            dissipated: sudden.keep_where(now & !before),
        }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.range()
    }

    fn max_stiffness(&self, _pair: &Pair<f64>) -> f64 {
        if self.kc_a.is_finite() { self.kc_a } else { 0.0 }
    }

    fn acts_on_approach(&self) -> bool {
        false
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        // With zero reach nothing acts at δ = 0 either.
        if overlap <= -self.range() {
            (0, "free")
        } else if overlap >= 0.0 {
            (2, "in contact")
        } else if memory[0] > 0.5 {
            (1, "attraction")
        } else {
            (0, "free")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(overlap: f64) -> NormalMotion<f64> {
        NormalMotion::at_rest(&Pair::wall(1e-6, 1e-3), overlap)
    }

    const LAW: JumpIn = JumpIn { f_a: 1e-4, kc_a: 50.0 };

    #[test]
    fn a_pair_that_never_touched_feels_nothing() {
        let mut touched = [0.0];
        assert_eq!(LAW.respond(&at(-1e-7), &mut touched), NonContactResponse::default());
        assert_eq!(touched, [0.0]);
    }

    #[test]
    fn the_memory_of_a_touch_lives_until_the_pair_is_out_of_reach() {
        let mut touched = [0.0];
        let touch = LAW.respond(&at(0.0), &mut touched);
        assert_eq!(touch.force, -1e-4);
        assert_eq!(touch.dissipated, 0.5 * 1e-4 * 2e-6);
        assert!((LAW.respond(&at(-1e-6), &mut touched).force + 5e-5).abs() < 1e-19); // one rounding
        assert_eq!(LAW.respond(&at(-1e-6), &mut touched).dissipated, 0.0);
        assert_eq!(LAW.respond(&at(-2e-6), &mut touched).force, 0.0);
        assert_eq!(touched, [0.0]);
        assert_eq!(LAW.respond(&at(-1e-6), &mut touched).force, 0.0);
    }

    #[test]
    fn zero_reach_leaves_the_force_in_contact() {
        let law = JumpIn { f_a: 1e-4, kc_a: f64::INFINITY };
        let mut touched = [0.0];
        assert_eq!(law.respond(&at(1e-9), &mut touched).force, -1e-4);
        assert_eq!(law.respond(&at(-1e-12), &mut touched).force, 0.0);
        assert_eq!(touched, [0.0]);
    }
}
