//! The Edinburgh elasto-plastic adhesive law.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Mask, Real, elementary};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::functions::Power;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// Plastic loading, unloading and adhesion along powers of the overlap.
///
/// ```text
/// f = −f_0 + k1 δ^n                   loading
/// f = −f_0 + k2 (δ^n − δ_p^n)         un- and re-loading, k2 = k1/(1 − λ_p), δ_p = λ_p^(1/n) δ_max
/// f = −f_0 − k_adh δ^x                wherever the line above lies below it
/// ```
///
/// Where a surface energy Δγ is given, k_adh follows from the largest overlap so that the pull at its end δ_min is
/// f_min = (3/2) π Δγ √(2 δ_p R), at most ½ k2 δ_p^n. On the adhesive limit δ_p shrinks so that the point stays on its
/// unloading curve; k_adh stays.
///
/// The publication's k1 and k_adh have units that depend on the exponents. Here k1 δ^n means k1 δ (δ/ℓ)^(n−1) with a
/// reference overlap ℓ, and k_adh likewise: with ℓ = 1 m the numbers are those of SI.
///
/// The constant pull f_0 acts from touch to touch, with a jump; publications write it with the other sign.
///
/// # Source
/// S. C. Thakur, J. P. Morrissey, J. Sun, J. F. Chen, J. Y. Ooi, Granular Matter 16, 383 (2014); J. P. Morrissey, PhD
/// thesis, Edinburgh (2013), for the exponent of the adhesive limit. Energies and the rule on the limit are derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Eepa {
    /// k1 [N/m^n].
    k1: f64,
    /// k2 [N/m^n].
    k2: f64,
    /// λ_p [1].
    lambda_p: f64,
    /// λ_p^(1/n) [1].
    plastic_share: f64,
    /// n.
    power: Power,
    /// n − 1.
    slope_power: Power,
    /// x.
    adhesion_power: Power,
    /// f_0 [N].
    f_0: f64,
    adhesion: Adhesion,
}

/// What the adhesive limit follows from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Adhesion {
    /// Δγ [J/m²].
    SurfaceEnergy(f64),
    /// k_adh [N/m^x].
    Stiffness(f64),
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EepaMemory<R> {
    /// Plastic overlap δ_p, positive in every contact [m].
    pub plastic_overlap: R,
    /// k_adh [N/m^x].
    pub adhesion_stiffness: R,
}

impl<R: Real> Memory<R> for EepaMemory<R> {
    const COLUMNS: usize = 2;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { plastic_overlap: column(0), adhesion_stiffness: column(1) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.plastic_overlap);
        column(1, self.adhesion_stiffness);
    }
}

impl Law for Eepa {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "eepa",
        summary: "Edinburgh elasto-plastic adhesive contact",
        equations: "\
f = −f_0 + k1 δ^n                loading
f = −f_0 + k2 (δ^n − δ_p^n)      un-/re-loading,  k2 = k1/(1 − λ_p),  δ_p = λ_p^(1/n) δ_max
f = −f_0 − k_adh δ^x             where that is larger; δ_p then shrinks with δ
k_adh = f_min/δ_min^x            f_min = (3/2) π Δγ √(2 δ_p R) ≤ ½ k2 δ_p^n,  δ_min^n = δ_p^n − f_min/k2
k1 δ^n = k1 δ (δ/ℓ)^(n−1),  k_adh δ^x = k_adh δ (δ/ℓ)^(x−1)",
        source: "Thakur, Morrissey, Sun, Chen & Ooi, Granular Matter 16, 383 (2014); the exponent x of the adhesive limit after Morrissey (2013), not confirmed against the original",
        parameters: &[
            Parameter::number(
                "k1",
                "k₁",
                Dimension::STIFFNESS,
                Range::Positive,
                "loading stiffness: (4/3) E* √R with n = 1.5, 2 E* R with n = 1",
            ),
            Parameter::number(
                "lambda_p",
                "λ_p",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "plasticity 1 − k1/k2, below 1",
            ),
            Parameter::number("exponent", "n", Dimension::NONE, Range::AtLeast(1.0), "exponent of loading, at most 3")
                .or(1.5),
            Parameter::number(
                "adhesion_exponent",
                "x",
                Dimension::NONE,
                Range::AtLeast(1.0),
                "exponent of the adhesive limit, at most 20; without it that of loading",
            )
            .optional(),
            Parameter::number("f_0", "f_0", Dimension::FORCE, Range::NonNegative, "constant pull of bodies that touch")
                .or(0.0),
            Parameter::number(
                "surface_energy",
                "Δγ",
                Dimension::STIFFNESS,
                Range::NonNegative,
                "adhesive surface energy (1 J/m^2 = 1 N/m); sets k_adh",
            )
            .optional(),
            Parameter::number(
                "k_adh",
                "k_adh",
                Dimension::STIFFNESS,
                Range::NonNegative,
                "constant stiffness of the adhesive limit, in place of a surface energy",
            )
            .optional(),
            Parameter::number(
                "reference_overlap",
                "ℓ",
                Dimension::LENGTH,
                Range::Positive,
                "overlap at which k1 and k_adh are the stiffnesses; with 1 m their numbers are N/m^n and N/m^x",
            )
            .or(1.0),
        ],
        particle_quantities: &[],
        memory: &["plastic_overlap [m]", "adhesion_stiffness [N/m^x]"],
        closed_form: "restitution without adhesion in pulvis_contact::theory::eepa; whole cycles (law_eepa)",
        example: "law = \"eepa\"\nk1 = \"1e6 N/m\"\nlambda_p = 0.5\nsurface_energy = \"1 N/m\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let adhesion = match (values.optional_number("surface_energy"), values.optional_number("k_adh")) {
            (Some(_), Some(_)) => {
                return Err(InvalidParameter::Inconsistent {
                    name: "k_adh",
                    found: "given beside `surface_energy`".to_owned(),
                    expected: "only one of `surface_energy`, `k_adh`".to_owned(),
                    reason: "each of them sets the adhesive limit",
                });
            }
            (Some(energy), None) => Adhesion::SurfaceEnergy(energy),
            (None, Some(stiffness)) => Adhesion::Stiffness(stiffness),
            (None, None) => return Err(InvalidParameter::Missing { name: "surface_energy" }),
        };
        let exponent = at_most(3.0, "exponent", values.number("exponent")?)?;
        let of_adhesion = values.optional_number("adhesion_exponent").unwrap_or(exponent);
        let adhesion_exponent = at_most(20.0, "adhesion_exponent", of_adhesion)?;
        let lambda_p = values.number("lambda_p")?;
        if lambda_p >= 1.0 {
            return Err(InvalidParameter::Inconsistent {
                name: "lambda_p",
                found: lambda_p.to_string(),
                expected: "less than 1".to_owned(),
                reason: "k2 = k1/(1 - lambda_p) must be finite",
            });
        }
        let reference = values.number("reference_overlap")?;
        let k1 = values.number("k1")? * elementary::powf(reference, 1.0 - exponent);
        let power = Power::new(exponent);
        Ok(Self {
            k1,
            k2: k1 / (1.0 - lambda_p),
            lambda_p,
            plastic_share: power.inverse(lambda_p),
            power,
            slope_power: Power::new(exponent - 1.0),
            adhesion_power: Power::new(adhesion_exponent),
            f_0: values.number("f_0")?,
            adhesion: match adhesion {
                Adhesion::Stiffness(stiffness) => {
                    Adhesion::Stiffness(stiffness * elementary::powf(reference, 1.0 - adhesion_exponent))
                }
                energy @ Adhesion::SurfaceEnergy(_) => energy,
            },
        })
    }
}

fn at_most(most: f64, name: &'static str, exponent: f64) -> Result<f64, InvalidParameter> {
    if exponent <= most {
        return Ok(exponent);
    }
    Err(InvalidParameter::Inconsistent {
        name,
        found: exponent.to_string(),
        expected: format!("at most {most}"),
        reason: "powers of small overlaps would leave the range of numbers",
    })
}

/// A point of an unloading curve: the overlap and its power n.
#[derive(Clone, Copy)]
struct Strain<R> {
    overlap: R,
    power: R,
}

impl Eepa {
    /// k_adh of a contact with the plastic overlap of `plastic` [N/m^x].
    #[inline(always)]
    fn adhesion_stiffness<R: Real>(&self, pair: &Pair<R>, plastic: Strain<R>) -> R {
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
    fn limit_begins<R: Real>(&self, plastic: Strain<R>, adhesion_stiffness: R) -> R {
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
    fn stored_energy<R: Real>(&self, at: Strain<R>, plastic: Strain<R>) -> R {
        R::splat(self.k2) * self.power.area_above(at.overlap, at.power, plastic.overlap, plastic.power)
    }

    /// What the adhesive limit has lost at its end, where the contact holds the point `at`: work and stored energy.
    #[inline(always)]
    fn limit_potential<R: Real>(&self, at: Strain<R>, plastic: Strain<R>, adhesion_stiffness: R) -> R {
        let share = R::splat(1.0 / (self.adhesion_power.exponent() + 1.0));
        let work = share * adhesion_stiffness * self.adhesion_power.of(at.overlap) * at.overlap;
        work + self.stored_energy(at, plastic)
    }

    /// The overlap that the expected loading reaches [m].
    fn expected_overlap(&self, pair: &Pair, expected: &ExpectedLoading) -> f64 {
        let n = self.power.exponent();
        let energy = 0.5 * pair.reduced_mass() * expected.speed * expected.speed;
        let of_speed = elementary::powf((n + 1.0) * energy / self.k1, 1.0 / (n + 1.0));
        let of_force = self.power.inverse((expected.force + (n + 1.0) * self.f_0) / self.k1);
        of_speed.max(of_force).max(expected.overlap * 0.5 * pair.harmonic_radius())
    }
}

impl NormalLaw for Eepa {
    type Memory<R: Real> = EepaMemory<R>;

    const JUMPS: bool = true;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut EepaMemory<R>) -> NormalResponse<R> {
        let (zero, depth, touching) = (R::zero(), motion.depth, motion.touching);
        let at = Strain { overlap: depth, power: self.power.of(depth) };
        let before = Strain { overlap: memory.plastic_overlap, power: self.power.of(memory.plastic_overlap) };
        let (mut plastic, mut k_adh) = (before, memory.adhesion_stiffness);
        let (mut lost_plastic, mut lost_adhesive) = (zero, zero);
        let grown = R::splat(self.plastic_share) * depth;
        let loads = grown.gt(before.overlap);
        if loads.any() {
            plastic.overlap = R::select(loads, grown, before.overlap);
            plastic.power = R::select(loads, R::splat(self.lambda_p) * at.power, before.power);
            k_adh = R::select(loads, self.adhesion_stiffness(&motion.pair, plastic), k_adh);
            let n = self.power.exponent();
            let coefficient = self.k2 * self.lambda_p * (1.0 - self.plastic_share) * n / (n + 1.0);
            let share = R::splat(1.0 / (self.lambda_p * self.plastic_share));
            let growth = at.power * at.overlap - before.power * before.overlap * share;
            lost_plastic = (R::splat(coefficient) * growth).keep_where(loads);
        }
        let line = R::splat(self.k2) * (at.power - plastic.power);
        let pull = k_adh * self.adhesion_power.of(depth);
        let on_limit = line.lt(-pull);
        let spring = line.max(-pull).keep_where(touching);
        let mut after = plastic;
        if on_limit.any() {
            let begins = self.limit_begins(plastic, k_adh);
            let begins = Strain { overlap: begins, power: self.power.of(begins) };
            let power = at.power + pull * R::splat(1.0 / self.k2);
            let overlap = self.power.inverse(power).min(plastic.overlap);
            after.overlap = R::select(on_limit, overlap, plastic.overlap);
            after.power = R::select(on_limit, power, plastic.power);
            let lost = self.limit_potential(begins, plastic, k_adh) - self.limit_potential(at, after, k_adh);
            lost_adhesive = lost.keep_where(on_limit);
        }
        let permanent = R::splat(-self.f_0).keep_where(touching);
        let force = spring + permanent;
        let last = R::splat(-self.f_0);
        *memory = EepaMemory {
            plastic_overlap: after.overlap.keep_where(touching),
            adhesion_stiffness: k_adh.keep_where(touching),
        };
        let slope = R::splat(self.k2 * self.power.exponent()) * self.slope_power.of(depth);
        NormalResponse {
            applied_force: spring + events::while_touching(motion, permanent, last),
            friction_reference: (spring + pull).max(zero).keep_where(touching),
            adhesive_potential: permanent * depth,
            dissipated_plastic: lost_plastic,
            dissipated_adhesive: lost_adhesive,
            ..NormalResponse::elastic(
                motion,
                force,
                self.stored_energy(at, after).keep_where(touching),
                slope.keep_where(touching),
            )
        }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &EepaMemory<f64>) -> (u8, &'static str) {
        if overlap <= 0.0 {
            return (0, "open");
        }
        if self.plastic_share * overlap >= memory.plastic_overlap {
            return (1, "k1");
        }
        let (at, plastic) = (self.power.of(overlap), self.power.of(memory.plastic_overlap));
        let pull = memory.adhesion_stiffness * self.adhesion_power.of(overlap);
        // After the response the point lies on the limit to round-off of the terms, not below it.
        let round_off = 16.0 * f64::EPSILON * self.k2 * (at + plastic);
        if self.k2 * (at - plastic) > -pull + round_off { (2, "k2") } else { (3, "limit") }
    }

    /// The steepest of the unloading curve and of the adhesive limit.
    ///
    /// With a surface energy the limit ends at f_min ≤ ½ k2 δ_p^n with δ_min ≥ δ_p/2^(1/n), so that its slope is at most
    /// x 2^(1/n − 1) k2 δ_p^(n−1), also after smaller loads.
    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let (n, x) = (self.power.exponent(), self.adhesion_power.exponent());
        let overlap = self.expected_overlap(pair, expected);
        let unloading = n * self.k2 * self.slope_power.of(overlap);
        let plastic = self.plastic_share * overlap;
        let limit = match self.adhesion {
            Adhesion::SurfaceEnergy(0.0) => 0.0,
            Adhesion::SurfaceEnergy(energy) => {
                // Deeper contacts than this pull less than the bound.
                let deepest = elementary::powf(
                    3.0 * PI * energy * pair.harmonic_radius().sqrt() / self.k2,
                    1.0 / (n - 0.5),
                );
                let slope = self.slope_power.of(plastic.min(deepest));
                x * elementary::powf(2.0, 1.0 / n - 1.0) * self.k2 * slope
            }
            Adhesion::Stiffness(stiffness) => {
                let plastic = Strain { overlap: plastic, power: self.power.of(plastic) };
                let begins = self.limit_begins(plastic, stiffness);
                x * stiffness * elementary::powf(begins, x - 1.0)
            }
        };
        unloading.max(limit)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;
}
