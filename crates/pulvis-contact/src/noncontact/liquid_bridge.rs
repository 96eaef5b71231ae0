//! A liquid bridge between spheres.

use std::f64::consts::FRAC_PI_2;

use pulvis_math::{Dimension, Mask, Real, elementary};

use super::{NonContactLaw, NonContactResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::energy::AttractionAccount;
use crate::events;
use crate::functions::atan;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Capillary attraction of a liquid bridge of given volume, which forms at touch and breaks at the rupture distance
/// S_c = (1 + θ/2) V^(1/3).
///
/// With S = −δ, k = √(R_w/V) and R_w = 2 a_i a_j/(a_i + a_j) (wall: 2 a_i) the force is −F_0 = −2 π R_w σ cos θ in contact
/// and −F_0/(1 + 1.05 k S + 2.5 k² S²) apart. Its potential is U(S) = −F_0 (2/(Δ k)) (atan A − atan B) with
/// A = (5 k S_c + 1.05)/Δ, B = (5 k S + 1.05)/Δ, Δ = √8.8975, and U(0) − F_0 δ in contact.
///
/// Nobody does work when the bridge forms: −U(0), the work to break it, is booked as dissipated by capillarity at touch.
/// Nothing is lost at rupture, where the potential is zero: what bridges have cost that broke is what is dissipated less
/// the −U(0) of those that there are.
///
/// Every bridge has the same volume; V/R_w³ should be below about 1e-3, and the bodies should not be far from equal:
/// only their mean radius enters. A step in which the force sets in or ends applies it for the part of the step in
/// which it acted.
///
/// # Source
/// C. D. Willett, M. J. Adams, S. A. Johnson, J. P. K. Seville, Langmuir 16, 9396 (2000), simplified form, as public codes
/// write it; rupture distance after G. Lian, C. Thornton, M. J. Adams, J. Colloid Interface Sci. 161, 138 (1993), which
/// could not be confirmed against the original. The potential is derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiquidBridge {
    /// Volume V of a bridge [m³].
    volume: f64,
    /// 2 π σ cos θ [N/m].
    strength: f64,
    /// Rupture distance S_c [m].
    rupture: f64,
}

/// Coefficient b of 1 + b x + c x² under the force, x = k S.
const B: f64 = 1.05;
/// Coefficient c of it.
const C: f64 = 2.5;

impl Law for LiquidBridge {
    const ENTRY: LawEntry = LawEntry {
        role: Role::NonContact,
        name: "liquid-bridge",
        summary: "capillary attraction that sets in at touch and ends where the bridge breaks",
        equations: "\
f   = −F_0                                in contact, δ ≥ 0,  F_0 = 2 π R_w σ cos θ
f   = −F_0/(1 + 1.05 x + 2.5 x²)          after a touch, S = −δ < S_c,  x = S √(R_w/V)
S_c = (1 + θ/2) V^(1/3)                   rupture;  R_w = 2 a_i a_j/(a_i + a_j)",
        source: "Willett, Adams, Johnson & Seville, Langmuir 16, 9396 (2000), simplified; rupture after Lian, Thornton & Adams, J. Colloid Interface Sci. 161, 138 (1993), not confirmed against the original",
        parameters: &[
            Parameter::number("volume", "V", Dimension::VOLUME, Range::Positive, "volume of a bridge"),
            Parameter::number(
                "surface_tension",
                "σ",
                Dimension::STIFFNESS,
                Range::Positive,
                "surface tension of the liquid (water: 0.072 N/m)",
            ),
            Parameter::number(
                "contact_angle",
                "θ",
                Dimension::NONE,
                Range::Between(0.0, FRAC_PI_2),
                "contact angle of the liquid on the bodies [rad]",
            )
            .or(0.0),
        ],
        particle_quantities: &[],
        memory: &["bridge [1]"],
        closed_form: "force, rupture distance and rupture work of published examples (tests of the law)",
        example: "law = \"liquid-bridge\"\nvolume = \"1e-12 m^3\"\nsurface_tension = \"0.072 N/m\"\ncontact_angle = 0.35",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let angle = values.number("contact_angle")?;
        Ok(Self::new(values.number("volume")?, values.number("surface_tension")?, angle))
    }
}

impl LiquidBridge {
    /// Volume of a bridge [m³], surface tension [N/m] and contact angle [rad].
    pub fn new(volume: f64, surface_tension: f64, contact_angle: f64) -> Self {
        Self {
            volume,
            strength: std::f64::consts::TAU * surface_tension * elementary::cos(contact_angle),
            rupture: (1.0 + 0.5 * contact_angle) * elementary::cbrt(volume),
        }
    }

    /// Force and potential [N], [J] at the distance S >= 0 of bodies with the mean radius R_w.
    #[inline(always)]
    fn apart<R: Real>(&self, radius: R, distance: R) -> (R, R) {
        let (one, number) = (R::one(), R::splat);
        let scale = (radius * number(1.0 / self.volume)).sqrt();
        let x = scale * distance;
        let strength = number(self.strength) * radius;
        let force = strength / (one + x * (number(B) + number(C) * x));
        let root = (4.0 * C - B * B).sqrt();
        let tangent = |x: R| number(2.0 * C / root) * x + number(B / root);
        let (a, b) = (tangent(number(self.rupture) * scale), tangent(x));
        // Beyond rupture, where nothing acts, the difference is negative.
        let angle = atan(((a - b) / (one + a * b)).max(R::zero()));
        (-force, -(strength * number(2.0 / root) * angle / scale))
    }
}

impl NonContactLaw for LiquidBridge {
    /// One while there is a bridge.
    type Memory<R: Real> = [R; 1];

    const ACCOUNT: AttractionAccount = AttractionAccount::Capillary;

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NonContactResponse<R> {
        let zero = R::zero();
        let before = memory[0].gt(R::splat(0.5));
        let touches = motion.overlap.ge(zero);
        let (bridged, forms) = (before | touches, touches & !before);
        let held = bridged & motion.overlap.gt(R::splat(-self.rupture));
        let breaks = before & !held;
        memory[0] = R::one().keep_where(held);
        let (mut force, mut potential, mut dissipated) = (zero, zero, zero);
        let mut applied_force = zero;
        if bridged.any() {
            let radius = R::one() / motion.pair.inverse_harmonic_radius();
            let distance = (-motion.overlap).max(zero);
            let (pull, well) = self.apart(radius, distance);
            force = pull.keep_where(held);
            potential = (well + pull * motion.depth).keep_where(held);
            applied_force = force;
            if (forms | breaks).any() {
                dissipated = (-self.apart(radius, zero).1).keep_where(forms);
                // Bodies that overlapped already, in a first look, met before this step.
                let meets = forms & motion.overlap.le(motion.growth);
                applied_force = R::select(meets, events::sets_in(motion, zero, force), applied_force);
                let rupture = R::splat(self.rupture);
                let last = self.apart(radius, rupture).0;
                applied_force = R::select(breaks, events::ends(motion, -rupture, last), applied_force);
            }
        }
        NonContactResponse { force, applied_force, potential, dissipated }
    }

    fn interaction_range(&self, _pair: &Pair<f64>) -> f64 {
        self.rupture
    }

    /// F_0 k times the largest slope of 1/(1 + 1.05 x + 2.5 x²), 1.2237 at x = 0.1344.
    fn max_stiffness(&self, pair: &Pair<f64>) -> f64 {
        let radius = pair.harmonic_radius();
        1.2237 * self.strength * radius * (radius / self.volume).sqrt()
    }

    fn acts_on_approach(&self) -> bool {
        false
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        if overlap >= 0.0 {
            (2, "in contact")
        } else if memory[0] > 0.5 && overlap > -self.rupture {
            (1, "bridge")
        } else {
            (0, "free")
        }
    }
}
