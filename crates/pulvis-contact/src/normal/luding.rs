//! The hysteretic, adhesive, elasto-plastic law of Luding and of Singh, Magnanimo and Luding.

use pulvis_math::{Dimension, Mask, Real};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{Choice, InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// Piece-wise linear, hysteretic, adhesive normal force of meso-particles.
///
/// With the largest overlap D = δ_max, capped at δ_p = k_p/(k_p − k_1) φ_f a12:
///
/// ```text
/// k2(D)  = k1 + (kp − k1) D/δ_p                     un- and re-loading stiffness, S1 (9)
/// f      = k2 (δ − δ_0),  δ_0 = (1 − k1/k2) D       un-/re-loading, and k1 δ on virgin loading
/// f      = kp (δ − φ_f a12)                         limit branch, for δ > δ_p, S1 (6)
/// f      = −kc δ                                    wherever the line above lies below it
/// ```
///
/// On the last branch D shrinks so that the point (δ, f) stays on its own k2 line; re-loading from
/// there follows that line. Valid for kp >= k1 > 0, kc >= 0, φ_f > 0.
///
/// # Source
/// S. Luding, Granular Matter 10, 235 (2008), eqs. (6)-(8); A. Singh, V. Magnanimo, S. Luding,
/// arXiv:1503.03720 ("S1"), eqs. (5)-(10) and (D.1). The inversion that keeps (δ, f) on its line is
/// derived from S1 (9), section 2.2.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Luding {
    /// Stiffness of plastic loading k1 [N/m].
    pub k1: f64,
    /// Stiffness of the limit branch kp, the largest un-/re-loading stiffness [N/m].
    pub kp: f64,
    /// Adhesion strength kc: minus the slope of the tensile limit branch [N/m].
    pub kc: f64,
    /// Plasticity depth φ_f: force-free overlap of a fully plastic contact over a12 [1].
    pub phi_f: f64,
    /// How k2 depends on the largest overlap.
    pub interpolation: Interpolation,
}

/// How the un-/re-loading stiffness k2 grows with x = D/δ_p from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// k2 = k1 + (kp − k1) x, S1 (9).
    Linear,
    /// k2 = k1 + (kp − k1) √x, S1 (D.1).
    SquareRoot,
    /// k2 = kp from the first touch on, without a limit branch (Walton and Braun 1986).
    Constant,
}

/// The memory of the Luding law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LudingMemory<R> {
    /// Largest overlap δ_max, capped at δ_p and shrinking on the adhesive branch [m].
    pub overlap_max: R,
}

impl<R: Real> Memory<R> for LudingMemory<R> {
    const COLUMNS: usize = 1;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { overlap_max: column(0) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.overlap_max);
    }
}

const INTERPOLATIONS: &[Choice] = &[
    Choice { name: "linear", meaning: "k2 = k1 + (kp - k1) D/δ_p, S1 (9)" },
    Choice { name: "square-root", meaning: "k2 = k1 + (kp - k1) √(D/δ_p), S1 (D.1)" },
    Choice { name: "constant", meaning: "k2 = kp at any D, no limit branch (Walton and Braun 1986)" },
];

impl Law for Luding {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "luding",
        summary: "hysteretic adhesive elasto-plastic contact of meso-particles, piece-wise linear",
        equations: "\
D   = min(max(D, δ), δ_p)        largest overlap, δ_p = kp/(kp − k1) φ_f a12
k2  = k1 + (kp − k1) D/δ_p       (or with √(D/δ_p), or constant kp)
f   = k2 (δ − δ_0)               δ_0 = (1 − k1/k2) D;  k1 δ while D grows, kp (δ − φ_f a12) beyond δ_p
f   = −kc δ                      where that is larger; D then shrinks with δ along its k2 line
with φ_f': kp' = k1 + AB/2 + √((AB/2)² + k1 AB) in place of kp, A = (kp − k1)²/kp, B = φ_f'/φ_f: the same k2(D)",
        source: "Luding, Granular Matter 10, 235 (2008), eqs. 6-8; Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. 5-10, A.3, D.1",
        parameters: &[
            Parameter::number(
                "k1",
                "k₁",
                Dimension::STIFFNESS,
                Range::Positive,
                "stiffness of plastic (virgin) loading",
            ),
            Parameter::number(
                "kp",
                "k_p",
                Dimension::STIFFNESS,
                Range::Positive,
                "stiffness of the elastic limit branch, the largest k2; at least k1",
            ),
            Parameter::number(
                "kc",
                "k_c",
                Dimension::STIFFNESS,
                Range::NonNegative,
                "adhesion strength, minus the slope of the tensile limit",
            ),
            Parameter::number(
                "phi_f",
                "φ_f",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "plasticity depth: largest force-free overlap over the harmonic mean radius a12",
            ),
            Parameter::number(
                "tuned_phi_f",
                "φ_f'",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "plasticity depth to which the limit is moved: kp and phi_f then only say how softer contacts behave",
            )
            .optional(),
            Parameter::choice(
                "interpolation",
                "",
                INTERPOLATIONS,
                "linear",
                "how k2 grows with the largest overlap",
            ),
        ],
        particle_quantities: &[],
        memory: &["overlap_max [m]"],
        closed_form: "restitution, sticking overlap, largest overlap and duration in pulvis_contact::theory (S1 eqs. 21-39)",
        example: "law = \"luding\"\nk1 = \"100 N/m\"\nkp = \"500 N/m\"\nkc = \"100 N/m\"\nphi_f = 0.05",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let interpolation = match values.choice("interpolation")? {
            "square-root" => Interpolation::SquareRoot,
            "constant" => Interpolation::Constant,
            _ => Interpolation::Linear,
        };
        Self {
            k1: values.number("k1")?,
            kp: values.number("kp")?,
            kc: values.number("kc")?,
            phi_f: values.number("phi_f")?,
            interpolation,
        }
        .checked()?
        .tuned(values.optional_number("tuned_phi_f"))
    }
}

impl Luding {
    fn checked(self) -> Result<Self, InvalidParameter> {
        if self.kp < self.k1 {
            return Err(InvalidParameter::Inconsistent {
                name: "kp",
                found: format!("{} N/m", self.kp),
                expected: format!("kp >= k1 = {} N/m", self.k1),
                reason: "a contact unloads at least as stiffly as it was loaded, otherwise it creates energy",
            });
        }
        Ok(self)
    }

    /// The law whose limit is moved to the plasticity depth `tuned`, with the same k2 of contacts below the old limit. S1
    /// appendix A, (A.3).
    fn tuned(self, tuned: Option<f64>) -> Result<Self, InvalidParameter> {
        let Some(phi_f) = tuned else { return Ok(self) };
        if self.interpolation != Interpolation::Linear {
            return Err(InvalidParameter::Inconsistent {
                name: "tuned_phi_f",
                found: "given beside another interpolation".to_owned(),
                expected: "interpolation = \"linear\"".to_owned(),
                reason: "only a k2 that grows linearly can be kept",
            });
        }
        let excess = self.kp - self.k1;
        let half = 0.5 * (phi_f / self.phi_f) * excess * (excess / self.kp);
        let kp = self.k1 + half + (half * (half + 2.0 * self.k1)).sqrt();
        Ok(Self { kp, phi_f, ..self })
    }

    /// Whether there is a finite plastic limit overlap δ_p.
    #[inline(always)]
    fn has_plastic_limit(&self) -> bool {
        self.kp > self.k1 && self.interpolation != Interpolation::Constant
    }

    /// Plastic limit overlap δ_p = kp/(kp − k1) φ_f a12 [m]; infinite for an elastic contact
    /// (kp = k1) and for constant k2. S1 (10).
    #[inline(always)]
    pub fn plastic_limit<R: Real>(&self, pair: &Pair<R>) -> R {
        match self.interpolation {
            Interpolation::Constant => R::splat(f64::INFINITY),
            _ => R::splat(self.kp / (self.kp - self.k1) * self.phi_f) * pair.harmonic_radius(),
        }
    }

    /// 1/δ_p [1/m], zero where δ_p is infinite. Unlike δ_p it costs no division.
    #[inline(always)]
    fn inverse_plastic_limit<R: Real>(&self, pair: &Pair<R>) -> R {
        match self.interpolation {
            Interpolation::Constant => R::zero(),
            _ => R::splat((self.kp - self.k1) / (self.kp * self.phi_f)) * pair.inverse_harmonic_radius(),
        }
    }

    /// (k2 − k1)/(kp − k1) at the largest overlap D, with 1/δ_p.
    #[inline(always)]
    fn hardening<R: Real>(&self, overlap_max: R, inverse_limit: R) -> R {
        match self.interpolation {
            Interpolation::Linear => overlap_max * inverse_limit,
            Interpolation::SquareRoot => (overlap_max * inverse_limit).sqrt(),
            Interpolation::Constant => R::one(),
        }
    }

    /// Un-/re-loading stiffness k2 [N/m] of a contact that has hardened so far.
    #[inline(always)]
    fn stiffness<R: Real>(&self, hardening: R) -> R {
        R::splat(self.k1) + R::splat(self.kp - self.k1) * hardening
    }

    /// The largest overlap D [m] whose k2 line passes through the point (δ, −kc δ) of the tensile
    /// limit branch: the inverse of δ_min(D) = (k2 − k1)/(k2 + kc) D, S1 section 2.2.5.
    #[inline(always)]
    fn overlap_max_on_limit<R: Real>(&self, overlap: R, limit: R, inverse_limit: R) -> R {
        // Elastic contacts never reach the limit branch; zero keeps the unused result finite.
        let ratio = if self.kp > self.k1 { (self.k1 + self.kc) / (self.kp - self.k1) } else { 0.0 };
        let y = overlap * inverse_limit;
        match self.interpolation {
            Interpolation::Linear => limit * R::splat(0.5) * (y + (y * (y + R::splat(4.0 * ratio))).sqrt()),
            Interpolation::SquareRoot => {
                let s = largest_cubic_root(y, ratio);
                limit * s * s
            }
            Interpolation::Constant => overlap * R::splat(1.0 + ratio),
        }
    }

    /// Energy [J] that is lost while a contact that was loaded up to `before` is loaded up to `after`,
    /// each a largest overlap D with its k2: the difference of the areas between the k1 line and the
    /// k2 line, ½ k1 D δ_0 (from S1 eqs. 5 and 9), over the common denominator.
    #[inline(always)]
    fn plastic_work<R: Real>(&self, before: (R, R), after: (R, R)) -> R {
        let k1 = R::splat(self.k1);
        let numerator_before = before.0 * before.0 * (before.1 - k1) * after.1;
        let numerator_after = after.0 * after.0 * (after.1 - k1) * before.1;
        R::splat(0.5 * self.k1) * (numerator_after - numerator_before) / (before.1 * after.1)
    }

    /// Energy [J] that is lost on the tensile limit branch from δ_min(D) down to zero:
    /// ½ kc δ_min² (1 + kc/k2), work done minus elastic energy that was there before. With
    /// δ_min = (k2 − k1)/(k2 + kc) D one quotient is left.
    #[inline(always)]
    fn adhesive_work<R: Real>(&self, overlap_max: R, k2: R) -> R {
        let overlap = (k2 - R::splat(self.k1)) * overlap_max;
        R::splat(0.5 * self.kc) * overlap * overlap / (k2 * (k2 + R::splat(self.kc)))
    }
}

impl NormalLaw for Luding {
    type Memory<R: Real> = LudingMemory<R>;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut LudingMemory<R>) -> NormalResponse<R> {
        let (pair, overlap) = (&motion.pair, motion.depth);
        let (k1, kc) = (R::splat(self.k1), R::splat(self.kc));
        let inverse_limit = self.inverse_plastic_limit(pair);

        let mut before = memory.overlap_max;
        let mut loaded = before.max(overlap);
        let beyond = (loaded * inverse_limit).gt(R::one());
        // δ_p itself costs a division, and only few contacts are fully plastic.
        if beyond.any() {
            let limit = self.plastic_limit(pair);
            // A switch of parameters may have lowered the limit below what the contact remembers.
            before = R::select(beyond, before.min(limit), before);
            loaded = R::select(beyond, loaded.min(limit), loaded);
        }
        let hardening_loaded = self.hardening(loaded, inverse_limit);
        let k2_loaded = self.stiffness(hardening_loaded);
        let line = k2_loaded * overlap - (k2_loaded - k1) * loaded;
        let tensile_limit = -(kc * overlap);
        let on_limit = line.lt(tensile_limit);
        let force = R::select(on_limit, tensile_limit, line);
        let mut after = loaded;
        let mut hardening = hardening_loaded;
        let mut k2 = k2_loaded;
        // In most contacts of a packing at rest the history does not change, and nothing is lost. Where
        // other lanes lose something, these two differences are zero.
        let (mut plastic, mut adhesive) = (R::zero(), R::zero());
        if on_limit.any() {
            let shrunk = self.overlap_max_on_limit(overlap, self.plastic_limit(pair), inverse_limit);
            // Never above what it was: round-off must not make a contact grow on this branch.
            after = R::select(on_limit, shrunk.min(loaded), loaded);
            hardening = self.hardening(after, inverse_limit);
            k2 = self.stiffness(hardening);
            adhesive = self.adhesive_work(loaded, k2_loaded) - self.adhesive_work(after, k2);
        }
        if loaded.gt(before).any() {
            let k2_before = self.stiffness(self.hardening(before, inverse_limit));
            plastic = self.plastic_work((before, k2_before), (loaded, k2_loaded));
        }
        memory.overlap_max = after.keep_where(motion.touching);

        let stored_energy = R::splat(0.5) * force * force / k2;
        NormalResponse {
            friction_reference: (force + kc * overlap).max(R::zero()),
            hardening,
            inverse_overlap_scale: if self.has_plastic_limit() {
                inverse_limit
            } else {
                pair.inverse_harmonic_radius()
            },
            dissipated_plastic: plastic,
            dissipated_adhesive: adhesive,
            ..NormalResponse::elastic(motion, force, stored_energy, k2)
        }
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &LudingMemory<f64>) -> (u8, &'static str) {
        let limit = self.plastic_limit(pair);
        let loaded = memory.overlap_max.min(limit).max(overlap.min(limit));
        let k2 = self.stiffness(self.hardening(loaded, self.inverse_plastic_limit(pair)));
        let line = k2 * overlap - (k2 - self.k1) * loaded;
        // After the response the point lies on the tensile limit to round-off of the line's two
        // terms, not below it.
        let round_off = 8.0 * f64::EPSILON * k2 * (overlap + loaded);
        if overlap <= 0.0 {
            (0, "open")
        } else if line < -(self.kc * overlap) + round_off {
            (1, "kc")
        } else if overlap >= limit {
            (2, "limit")
        } else if overlap >= memory.overlap_max {
            (3, "k1")
        } else {
            (4, "k2")
        }
    }

    fn max_stiffness(&self, _pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.kp.max(self.kc)
    }

    /// The work ½ f δ along the branches that start at the origin, k1 and −kc.
    fn branch_potential(
        &self,
        branch: u8,
        motion: &NormalMotion<f64>,
        memory: &LudingMemory<f64>,
    ) -> Option<f64> {
        let from_origin = matches!(branch, 1 | 3) && motion.overlap > 0.0;
        from_origin.then(|| 0.5 * motion.overlap * self.respond(motion, &mut memory.clone()).force)
    }

    fn remembered_overlap(&self, memory: &LudingMemory<f64>) -> Option<f64> {
        Some(memory.overlap_max)
    }
}

/// The positive root s of s³ − y s − y c = 0 for y, c >= 0, to round-off.
///
/// The upper bound √y + ∛(y c) makes Newton's method fall monotonically; lanes that have arrived
/// are frozen, so a lane gives the bits of the plain number whatever its neighbours do.
#[inline(always)]
fn largest_cubic_root<R: Real>(y: R, c: f64) -> R {
    let mut root = y.sqrt() + (y * R::splat(c)).cbrt();
    for _ in 0..60 {
        let slope = R::splat(3.0) * root * root - y;
        let next = root - (root * (root * root - y) - y * R::splat(c)) / slope;
        let falls = next.lt(root);
        root = R::select(falls, next, root);
        if !falls.any() {
            break;
        }
    }
    root
}
