//! A linear model of adhesive elasto-plastic spheres that snap on and off, after Pasha et al.

use pulvis_math::{Dimension, Mask, Real};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// Thornton and Ning's law in straight lines.
///
/// ```text
/// f    = k_e (δ − δ_0)               elastic loading up to f_y,  δ_0 = 8 f_ce/(9 k_e)
/// f    = f_y + k_p (δ − δ_y)         plastic loading, which moves the force-free overlap by u
/// f    = k_e (δ − δ_0 − u)           un- and re-loading, down to the pull-off force −f_cp
/// f    = −f_cp + k_e (δ_cp − δ)      from there on, reversible, to −(5/9) f_cp, where the bodies detach
/// f_cp = f_ce + k_cp u
/// ```
///
/// Bodies attach when they touch, with the force −(8/9) f_ce. A contact that has flowed detaches at an overlap
/// δ_0 + u − (13/9) f_cp/k_e, which may be positive; it attaches there again, and is forgotten once it is detached and
/// δ ≤ 0.
///
/// The energy is counted from the detached contact on: then neither detaching nor attaching anew loses anything, and a first
/// touch loses (73/162) f_ce²/k_e.
///
/// # Source
/// M. Pasha, S. Dogbe, C. Hare, A. Hassanpour, M. Ghadiri, Granular Matter 16, 151 (2014). The growth of the pull-off force
/// and the line beyond it are recalled and could not be confirmed against the original; energies are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pasha {
    /// Elastic stiffness k_e [N/m].
    elastic: f64,
    /// Stiffness of plastic loading k_p [N/m].
    plastic: f64,
    /// Growth of the pull-off force with the plastic overlap k_cp [N/m].
    growth: f64,
    /// Pull-off force of an elastic contact f_ce [N].
    f_ce: f64,
    /// Force at which the contact begins to flow f_y [N].
    f_y: f64,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PashaMemory<R> {
    /// By how much plastic flow has moved the force-free overlap, u [m].
    pub plastic_overlap: R,
    /// 1 while the bodies are attached.
    pub attached: R,
}

impl<R: Real> Memory<R> for PashaMemory<R> {
    const COLUMNS: usize = 2;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { plastic_overlap: column(0), attached: column(1) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.plastic_overlap);
        column(1, self.attached);
    }
}

const fn stiffness(
    name: &'static str,
    symbol: &'static str,
    range: Range,
    meaning: &'static str,
) -> Parameter {
    Parameter::number(name, symbol, Dimension::STIFFNESS, range, meaning)
}

impl Law for Pasha {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "pasha",
        summary: "adhesive elasto-plastic contact in straight lines that snaps on and off",
        equations: "\
f    = k_e (δ − δ_0)            elastic up to f_y,  δ_0 = 8 f_ce/(9 k_e);  attaches at δ = 0
f    = f_y + k_p (δ − δ_y)      plastic loading moves the force-free overlap by u
f    = k_e (δ − δ_0 − u)        un-/re-loading down to −f_cp,  f_cp = f_ce + k_cp u
f    = −f_cp + k_e (δ_cp − δ)   beyond, to −(5/9) f_cp, where the bodies detach",
        source: "Pasha, Dogbe, Hare, Hassanpour & Ghadiri, Granular Matter 16, 151 (2014); the growth of the pull-off force and the line beyond it could not be confirmed against the original",
        parameters: &[
            stiffness("k_e", "k_e", Range::Positive, "elastic stiffness"),
            stiffness("k_p", "k_p", Range::Positive, "stiffness of plastic loading, at most k_e"),
            stiffness(
                "k_cp",
                "k_cp",
                Range::NonNegative,
                "growth of the pull-off force with the plastic overlap, at most 9/13 k_e",
            ),
            Parameter::number(
                "f_ce",
                "f_ce",
                Dimension::FORCE,
                Range::NonNegative,
                "pull-off force of an elastic contact, 3/2 π Γ R",
            ),
            Parameter::number(
                "f_y",
                "f_y",
                Dimension::FORCE,
                Range::NonNegative,
                "force at which the contact begins to flow",
            ),
        ],
        particle_quantities: &[],
        memory: &["plastic_overlap [m]", "attached [1]"],
        closed_form: "restitution, pull-off and detachment in pulvis_contact::theory::pasha",
        example: "law = \"pasha\"\nk_e = \"1e4 N/m\"\nk_p = \"2e3 N/m\"\nk_cp = \"500 N/m\"\nf_ce = \"1e-4 N\"\nf_y = \"5e-4 N\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let law = Self {
            elastic: values.number("k_e")?,
            plastic: values.number("k_p")?,
            growth: values.number("k_cp")?,
            f_ce: values.number("f_ce")?,
            f_y: values.number("f_y")?,
        };
        let inconsistent = |name, found: f64, most: String, reason| {
            Err(InvalidParameter::Inconsistent {
                name,
                found: format!("{found} N/m"),
                expected: most,
                reason,
            })
        };
        if law.plastic > law.elastic {
            return inconsistent(
                "k_p",
                law.plastic,
                format!("at most k_e = {} N/m", law.elastic),
                "a contact unloads at least as stiffly as it was loaded, otherwise it creates energy",
            );
        }
        let most = 9.0 / 13.0 * law.elastic;
        if law.growth > most {
            return inconsistent(
                "k_cp",
                law.growth,
                format!("at most 9/13 k_e = {most} N/m"),
                "the deeper a contact was pressed, the farther beyond touching it would act, without bound",
            );
        }
        Ok(law)
    }
}

/// (U(detached) − U(force-free)) k_e/f_cp².
const DETACHED: f64 = 137.0 / 162.0;
/// The force on the line, without its sign, at which the bodies detach, over f_cp.
const LINE_END: f64 = 13.0 / 9.0;

impl Pasha {
    /// f_cp after a plastic overlap [N].
    #[inline(always)]
    fn pull_off<R: Real>(&self, plastic_overlap: R) -> R {
        R::splat(self.f_ce) + R::splat(self.growth) * plastic_overlap
    }

    /// The force on the line of un- and re-loading [N].
    #[inline(always)]
    fn line<R: Real>(&self, overlap: R, plastic_overlap: R) -> R {
        R::splat(self.elastic) * (overlap - plastic_overlap) - R::splat(8.0 / 9.0 * self.f_ce)
    }

    /// Whether a contact holds at an overlap.
    #[inline(always)]
    fn holds<R: Real>(&self, overlap: R, plastic_overlap: R) -> R::Mask {
        let line = self.line(overlap, plastic_overlap);
        line.ge(R::splat(-LINE_END) * self.pull_off(plastic_overlap)) & overlap.gt(R::splat(-self.range()))
    }

    /// The plastic overlap u of virgin loading.
    #[inline(always)]
    fn virgin<R: Real>(&self, overlap: R) -> R {
        let share = 1.0 - self.plastic / self.elastic;
        let yields = (self.f_y + 8.0 / 9.0 * self.f_ce) / self.elastic;
        (R::splat(share) * (overlap - R::splat(yields))).max(R::zero())
    }

    /// How far beyond touching the bodies attract each other at the most: after an elastic contact [m].
    fn range(&self) -> f64 {
        5.0 / 9.0 * self.f_ce / self.elastic
    }

    /// Energy [J] that plastic flow from the plastic overlap `before` to `after` loses: ∫ f du, and what the attraction
    /// has grown.
    #[inline(always)]
    fn plastic_work<R: Real>(&self, before: R, after: R) -> R {
        let share = 1.0 - self.plastic / self.elastic;
        let hardening = if share > 0.0 { self.plastic / (2.0 * share) } else { 0.0 };
        let attraction = DETACHED * self.growth / self.elastic;
        let linear = self.f_y + 2.0 * attraction * self.f_ce;
        let square = hardening + attraction * self.growth;
        (after - before) * (R::splat(linear) + R::splat(square) * (after + before))
    }
}

impl NormalLaw for Pasha {
    type Memory<R: Real> = PashaMemory<R>;

    const JUMPS: bool = true;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut PashaMemory<R>) -> NormalResponse<R> {
        let (number, zero, overlap) = (R::splat, R::zero(), motion.overlap);
        let before = memory.plastic_overlap;
        let was_attached = memory.attached.gt(number(0.5));
        let virgin = !was_attached & before.le(zero);
        let attaches = !was_attached & motion.touching & self.holds(overlap, before);
        let bound = was_attached | attaches;
        let loaded = R::select(bound, before.max(self.virgin(overlap)), before);
        let attached = bound & self.holds(overlap, loaded);
        let pull_off = self.pull_off(loaded);
        let line = self.line(overlap, loaded);
        // Beyond the pull-off force by k_e (δ_cp − δ).
        let beyond = (-pull_off - line).max(zero);
        let force = (line.max(-pull_off) + beyond).keep_where(attached);
        let half = number(0.5);
        let pulled = line.max(-pull_off);
        let stored = half * pulled * pulled + beyond * (pull_off - half * beyond);
        let inverse = number(1.0 / self.elastic);
        let potential = number(-DETACHED / self.elastic) * pull_off * pull_off;
        let (mut adhesive, mut applied_force) = (zero, force);
        let detaches = was_attached & !attached;
        if (attaches | detaches).any() {
            let first = number(73.0 / 162.0 * self.f_ce * self.f_ce / self.elastic);
            adhesive = first.keep_where(attaches & virgin);
            let detachment = loaded + (number(8.0 / 9.0 * self.f_ce) - number(LINE_END) * pull_off) * inverse;
            let event = R::select(virgin, zero, detachment);
            // Bodies that overlapped already, in a first look or under another law, met before this step.
            let meets = attaches & !(virgin & motion.touched_before());
            applied_force = R::select(meets, events::sets_in(motion, event, force), applied_force);
            let last = events::ends(motion, detachment, number(-5.0 / 9.0) * pull_off);
            applied_force = R::select(detaches, last, applied_force);
        }
        // Detached bodies remember until they are apart.
        let remembers = attached | motion.touching;
        *memory = PashaMemory {
            plastic_overlap: loaded.keep_where(remembers),
            attached: R::one().keep_where(attached),
        };
        NormalResponse {
            applied_force,
            in_contact: attached,
            was_in_contact: was_attached | (virgin & motion.touched_before()),
            friction_reference: (force + pull_off).keep_where(attached),
            adhesive_potential: potential.keep_where(attached),
            dissipated_plastic: self.plastic_work(before, loaded),
            dissipated_adhesive: adhesive,
            ..NormalResponse::elastic(
                motion,
                force,
                (stored * inverse).keep_where(attached),
                number(self.elastic).keep_where(attached),
            )
        }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.range()
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &PashaMemory<f64>) -> (u8, &'static str) {
        let before = memory.plastic_overlap;
        let attached = memory.attached > 0.5 || overlap > 0.0;
        if !attached || !self.holds(overlap, before) {
            return (0, "detached");
        }
        let virgin = self.virgin(overlap);
        let (line, pull_off) = (self.line(overlap, before), self.pull_off(before));
        if virgin > 0.0 && virgin >= before {
            (1, "plastic")
        } else if line >= -pull_off {
            (2, "elastic")
        } else {
            (3, "beyond pull-off")
        }
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.elastic
    }
}
