//! A piece-wise linear plastic law whose pull-off force does not follow from its slopes, after Walton and Johnson.

use pulvis_math::{Dimension, Mask, Real};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// Loading along k1, unloading along k2, a pull-off force f_po of its own, and a tail of a slope of its own.
///
/// ```text
/// f    = k1 δ                          while the largest overlap D grows
/// f    = k2 (δ − o)                    un- and re-loading, force-free overlap o = (1 − k1/k2) D
/// f_po = f_0 + κ k1 D                  pull-off force, reached at δ_t = o − f_po/k2
/// f    = −f_po + k_tail (δ_t − δ)      from there to zero, at δ_end = δ_t − f_po/k_tail
/// ```
///
/// Re-loading from the tail follows k2, with f_po lowered to the force that was reached: no energy comes from nothing.
/// With f_0 > 0 the tail may end beyond touching, at δ_end < 0, and the contact then lives on until there. For δ ≤ 0 the
/// envelope of loading is zero.
///
/// The memory is kept until the tail has ended and δ ≤ 0: also a contact that is free of force at δ > 0 is remembered.
///
/// # Source
/// After O. R. Walton, S. M. Johnson, AIP Conf. Proc. 1145 (2009), who treat pull-off force and slope of the tensile force
/// as independent. The equations are a reconstruction that could not be confirmed against the original; its algebra and
/// its energies are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaltonJohnson {
    /// Stiffness of plastic loading k1 [N/m].
    pub k1: f64,
    /// Un- and re-loading stiffness k2 [N/m].
    pub k2: f64,
    /// Pull-off force of a first touch f_0 [N].
    pub f_0: f64,
    /// Pull-off force over load κ [1].
    pub kappa: f64,
    /// Slope of the tail, without its sign [N/m].
    pub k_tail: f64,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WaltonJohnsonMemory<R> {
    /// Force-free overlap o, negative where the contact is stretched [m].
    pub force_free_overlap: R,
    /// Pull-off force f_po [N].
    pub pull_off_force: R,
    /// 1 while the bodies are attached.
    pub attached: R,
}

impl<R: Real> Memory<R> for WaltonJohnsonMemory<R> {
    const COLUMNS: usize = 3;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { force_free_overlap: column(0), pull_off_force: column(1), attached: column(2) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.force_free_overlap);
        column(1, self.pull_off_force);
        column(2, self.attached);
    }
}

const fn stiffness(name: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter {
    Parameter::number(name, symbol, Dimension::STIFFNESS, Range::Positive, meaning)
}

impl Law for WaltonJohnson {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "walton-johnson",
        summary: "piece-wise linear plastic contact with pull-off force and tail apart (a reconstruction)",
        equations: "\
f    = k1 δ                        while the largest overlap D grows
f    = k2 (δ − o)                  un-/re-loading,  o = (1 − k1/k2) D
f_po = f_0 + κ k1 D                pull-off force,  reached at δ_t = o − f_po/k2
f    = −f_po + k_tail (δ_t − δ)    tail to zero;  re-loading from there along k2, f_po = |f|",
        source: "after Walton & Johnson, AIP Conf. Proc. 1145 (2009); a reconstruction that could not be confirmed against the original",
        parameters: &[
            stiffness("k1", "k₁", "stiffness of plastic (virgin) loading"),
            stiffness("k2", "k₂", "un- and re-loading stiffness, at least k1"),
            Parameter::number(
                "f_0",
                "f₀",
                Dimension::FORCE,
                Range::NonNegative,
                "pull-off force of a first touch (as of JKR: 3/2 π Γ R)",
            )
            .or(0.0),
            Parameter::number(
                "kappa",
                "κ",
                Dimension::NONE,
                Range::NonNegative,
                "pull-off force over the largest load, 0 to about 0.5",
            )
            .or(0.0),
            stiffness("k_tail", "k_tail", "slope of the tensile tail, without its sign"),
        ],
        particle_quantities: &[],
        memory: &["force_free_overlap [m]", "pull_off_force [N]", "attached [1]"],
        closed_form: "restitution, pull-off and end of the tail in pulvis_contact::theory::walton_johnson",
        example: "law = \"walton-johnson\"\nk1 = \"100 N/m\"\nk2 = \"400 N/m\"\nf_0 = \"1e-4 N\"\nkappa = 0.05\nk_tail = \"50 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        Self {
            k1: values.number("k1")?,
            k2: values.number("k2")?,
            f_0: values.number("f_0")?,
            kappa: values.number("kappa")?,
            k_tail: values.number("k_tail")?,
        }
        .checked()
    }
}

impl WaltonJohnson {
    fn checked(self) -> Result<Self, InvalidParameter> {
        if self.k2 < self.k1 {
            return Err(InvalidParameter::Inconsistent {
                name: "k2",
                found: format!("{} N/m", self.k2),
                expected: format!("k2 >= k1 = {} N/m", self.k1),
                reason: "a contact unloads at least as stiffly as it was loaded, otherwise it creates energy",
            });
        }
        let most = self.plastic_share() / (self.k1 * self.tail_compliance());
        if self.kappa > most {
            return Err(InvalidParameter::Inconsistent {
                name: "kappa",
                found: self.kappa.to_string(),
                expected: format!("at most (1 - k1/k2)/(k1/k2 + k1/k_tail) = {most}"),
                reason: "the deeper a contact was pressed, the farther beyond touching it would act, without bound",
            });
        }
        Ok(self)
    }

    /// Force-free overlap over the largest one, 1 − k1/k2 [1].
    fn plastic_share(&self) -> f64 {
        1.0 - self.k1 / self.k2
    }

    /// 1/k2 + 1/k_tail: from the force-free overlap to the end of the tail, over the pull-off force [m/N].
    fn tail_compliance(&self) -> f64 {
        1.0 / self.k2 + 1.0 / self.k_tail
    }

    /// How far beyond touching the tail reaches at the most: after the slightest touch [m].
    fn range(&self) -> f64 {
        self.f_0 * self.tail_compliance()
    }

    /// Energy [J] that is lost by virgin loading up to the force-free overlap, ½ k1 D o.
    #[inline(always)]
    fn plastic_work<R: Real>(&self, force_free_overlap: R) -> R {
        let share = self.plastic_share();
        let coefficient = if share > 0.0 { 0.5 * self.k1 / share } else { 0.0 };
        let pressed = force_free_overlap.max(R::zero());
        R::splat(coefficient) * pressed * pressed
    }
}

/// A point of the tail.
struct Tail<R> {
    /// The pull that is left [N].
    pull: R,
    /// Energy lost on the way there [J].
    lost: R,
}

impl WaltonJohnson {
    /// The tail of a contact with a force-free overlap and a pull-off force, at `overlap`.
    #[inline(always)]
    fn tail<R: Real>(&self, overlap: R, force_free_overlap: R, pull_off: R) -> Tail<R> {
        let begins = force_free_overlap - pull_off * R::splat(1.0 / self.k2);
        let ends = begins - pull_off * R::splat(1.0 / self.k_tail);
        let pull = (pull_off - R::splat(self.k_tail) * (begins - overlap)).max(R::zero());
        // Zero at the end of the law's range, also by rounding.
        let pull = pull.keep_where(overlap.gt(R::splat(-self.range())));
        let half = R::splat(0.5);
        let work = half * (pull_off + pull) * (begins - overlap.max(ends));
        let relaxed = half * (pull_off * pull_off - pull * pull) * R::splat(1.0 / self.k2);
        Tail { pull, lost: work + relaxed }
    }
}

impl NormalLaw for WaltonJohnson {
    type Memory<R: Real> = WaltonJohnsonMemory<R>;

    #[inline(always)]
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut WaltonJohnsonMemory<R>,
    ) -> NormalResponse<R> {
        let (zero, overlap, touching) = (R::zero(), motion.overlap, motion.touching);
        let was_attached = memory.attached.gt(R::splat(0.5));
        let before = memory.force_free_overlap;
        // A stretched contact that is pushed together again is free of force until the bodies touch.
        let virgin = R::select(touching, R::splat(self.plastic_share()) * overlap, overlap);
        let loaded = before.max(virgin);
        let grown = R::splat(self.f_0) + R::splat(self.kappa * self.k1) * overlap;
        let pull_off = R::select(touching & virgin.ge(before), grown, memory.pull_off_force);
        let plastic = self.plastic_work(loaded) - self.plastic_work(before);
        let line = R::splat(self.k2) * (overlap - loaded);
        let on_tail = line.lt(-pull_off);
        let (mut force, mut after, mut carried, mut adhesive) = (line, loaded, pull_off, zero);
        if on_tail.any() {
            let tail = self.tail(overlap, loaded, pull_off);
            force = R::select(on_tail, -tail.pull, line);
            carried = R::select(on_tail, tail.pull, pull_off);
            after = R::select(on_tail, overlap + tail.pull * R::splat(1.0 / self.k2), loaded);
            adhesive = tail.lost.keep_where(on_tail);
        }
        let attached = touching | (was_attached & carried.gt(zero));
        *memory = WaltonJohnsonMemory {
            force_free_overlap: after.keep_where(attached),
            pull_off_force: carried.keep_where(attached),
            attached: R::one().keep_where(attached),
        };
        // Of bodies apart only a rounding error is left.
        let force = force.keep_where(attached);
        let stored_energy = force * force * R::splat(0.5 / self.k2);
        NormalResponse {
            in_contact: attached,
            was_in_contact: was_attached | motion.touched_before(),
            friction_reference: (force + carried).max(zero).keep_where(attached),
            dissipated_plastic: plastic,
            dissipated_adhesive: adhesive,
            ..NormalResponse::elastic(motion, force, stored_energy, R::splat(self.k2))
        }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.range()
    }

    fn branch(
        &self,
        _pair: &Pair<f64>,
        overlap: f64,
        memory: &WaltonJohnsonMemory<f64>,
    ) -> (u8, &'static str) {
        const OPEN: (u8, &str) = (0, "open");
        const FREE: (u8, &str) = (4, "free");
        let touching = overlap > 0.0;
        if memory.attached < 0.5 && !touching {
            return OPEN;
        }
        let before = memory.force_free_overlap;
        let virgin = if touching { self.plastic_share() * overlap } else { overlap };
        if touching && virgin >= before {
            return (1, "k1");
        }
        let pull_off = memory.pull_off_force;
        let line = self.k2 * (overlap - before.max(virgin));
        // After the response the point lies on the tail to round-off of the line's two terms, not below it.
        let round_off = 8.0 * f64::EPSILON * self.k2 * (overlap.abs() + before.abs());
        if line > -pull_off + round_off {
            return if virgin > before { FREE } else { (2, "k2") };
        }
        match self.tail(overlap, before.max(virgin), pull_off).pull {
            pull if pull > round_off => (3, "tail"),
            _ if touching => FREE,
            _ => OPEN,
        }
    }

    /// Where the tail begins the slope changes by k2 + k_tail. Velocity-Verlet errs there as at the first touch of a
    /// spring of that stiffness, and in a contact that was never pressed flat the bodies are as fast as at touch.
    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        let pulls = self.f_0 > 0.0 || self.kappa > 0.0;
        if pulls { self.k2 + self.k_tail } else { self.k2 }
    }

    fn remembered_overlap(&self, memory: &WaltonJohnsonMemory<f64>) -> Option<f64> {
        let share = self.plastic_share();
        (share > 0.0).then(|| memory.force_free_overlap.max(0.0) / share)
    }
}
