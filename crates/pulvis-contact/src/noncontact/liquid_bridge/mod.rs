//! A liquid bridge between spheres.

use pulvis_math::{Mask, Real, elementary};

use super::{NonContactLaw, NonContactResponse};
use crate::energy::AttractionAccount;
use crate::events;
use crate::functions::{atan, cbrt};
use crate::kinematics::NormalMotion;
use crate::pair::{Pair, Sizes};

mod entry;

/// Capillary attraction of a liquid bridge, which forms at touch and breaks at the rupture distance
/// S_c = (1 + θ/2) V^(1/3).
///
/// The volume is the same for every bridge, or a share φ of the liquid on both bodies, V = φ (V_i + V_j); walls are dry. The
/// liquid of a particle is a quantity of it that stays: a bridge holds its share of it while it lasts, and gives each body
/// back what it took when it breaks. Bridges do not know of each other, and liquid does not pass from body to body: a
/// particle with n bridges has lent n φ of its liquid, which is more than it has for n > 1/φ. With φ = (2 − √3)/4 = 0.067,
/// the caps in which touching equal spheres shade each other, twelve neighbours take 0.80 of it.
///
/// With S = −δ, k = √(R_w/V) and R_w = 2 a_i a_j/(a_i + a_j) (wall: 2 a_i) the force is −F_0 = −2 π R_w σ cos θ in contact
/// and −F_0/(1 + 1.05 k S + 2.5 k² S²) apart. Its potential is U(S) = −F_0 (2/(Δ k)) (atan A − atan B) with
/// A = (5 k S_c + 1.05)/Δ, B = (5 k S + 1.05)/Δ, Δ = √8.8975, and U(0) − F_0 δ in contact.
///
/// Nobody does work when the bridge forms: −U(0), the work to break it, is booked as dissipated by capillarity at touch.
/// Nothing is lost at rupture, where the potential is zero: what bridges have cost that broke is what is dissipated less
/// the −U(0) of those that there are.
///
/// V/R_w³ should be below about 1e-3, and the bodies should not be far from equal: only their mean radius enters. A step in which the force sets in or ends applies it for the part of the step in
/// which it acted.
///
/// # Source
/// C. D. Willett, M. J. Adams, S. A. Johnson, J. P. K. Seville, Langmuir 16, 9396 (2000), simplified form, as public codes
/// write it; the volume from caps of equal spheres after D. Shi, J. J. McCarthy, Powder Technol. 184, 64 (2008), which could
/// not be confirmed against the original; rupture distance after G. Lian, C. Thornton, M. J. Adams, J. Colloid Interface Sci. 161, 138 (1993), which
/// could not be confirmed against the original. The potential is derived here.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiquidBridge {
    liquid: Liquid,
    /// 2 π σ cos θ [N/m].
    strength: f64,
    /// S_c/V^(1/3) = 1 + θ/2.
    reach: f64,
}

/// Where the liquid of a bridge comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Liquid {
    /// Every bridge has the volume V [m³] and the rupture distance S_c [m].
    PerBridge { volume: f64, rupture: f64 },
    /// From the particles: the share φ, and the least and the largest liquid of any that is not dry [m³].
    Shared { share: f64, least: f64, largest: f64 },
}

/// One over the volume [1/m³] and the rupture distance [m] of a bridge; of dry bodies neither has a meaning.
#[derive(Clone, Copy)]
struct Bridge<R: Real> {
    inverse_volume: R,
    rupture: R,
    wet: R::Mask,
}

/// The name of the particle quantity.
const LIQUID: &str = "liquid";

/// Coefficient b of 1 + b x + c x² under the force, x = k S.
const B: f64 = 1.05;
/// Coefficient c of it.
const C: f64 = 2.5;

impl LiquidBridge {
    /// Volume of every bridge [m³], surface tension [N/m] and contact angle [rad].
    pub fn new(volume: f64, surface_tension: f64, contact_angle: f64) -> Self {
        let reach = 1.0 + 0.5 * contact_angle;
        let liquid = Liquid::PerBridge { volume, rupture: reach * elementary::cbrt(volume) };
        Self::of(liquid, surface_tension, contact_angle)
    }

    /// Share of the liquid of both bodies that a bridge takes [1], surface tension [N/m] and contact angle [rad].
    pub fn shared(share: f64, surface_tension: f64, contact_angle: f64) -> Self {
        let liquid = Liquid::Shared { share, least: f64::INFINITY, largest: 0.0 };
        Self::of(liquid, surface_tension, contact_angle)
    }

    fn of(liquid: Liquid, surface_tension: f64, contact_angle: f64) -> Self {
        let strength = std::f64::consts::TAU * surface_tension * elementary::cos(contact_angle);
        Self { liquid, strength, reach: 1.0 + 0.5 * contact_angle }
    }

    /// The bridge between the bodies of a pair.
    #[inline(always)]
    fn between<R: Real>(&self, pair: &Pair<R>) -> Bridge<R> {
        let (number, zero, one) = (R::splat, R::zero(), R::one());
        match self.liquid {
            Liquid::PerBridge { volume, rupture } => {
                Bridge { inverse_volume: number(1.0 / volume), rupture: number(rupture), wet: one.gt(zero) }
            }
            Liquid::Shared { share, .. } => {
                let [liquid_i, liquid_j] = pair.quantities().attraction[0];
                let volume = number(share) * (liquid_i + liquid_j);
                let wet = volume.gt(zero);
                let volume = R::select(wet, volume, one);
                let rupture = (number(self.reach) * cbrt(volume)).keep_where(wet);
                Bridge { inverse_volume: one / volume, rupture, wet }
            }
        }
    }

    /// The least and the largest volume that a bridge of the pair may have: that of its own liquid, or that of the bodies
    /// that there are [m³].
    fn volumes(&self, pair: &Pair) -> [f64; 2] {
        match self.liquid {
            Liquid::PerBridge { volume, .. } => [volume; 2],
            Liquid::Shared { share, least, largest } => {
                let [liquid_i, liquid_j] = pair.quantities().attraction[0];
                let own = liquid_i + liquid_j;
                let least = if own > 0.0 { least.min(own) } else { least };
                [share * least, share * own.max(2.0 * largest)]
            }
        }
    }

    /// Force and potential [N], [J] at the distance S >= 0 of bodies with the mean radius R_w.
    #[inline(always)]
    fn apart<R: Real>(&self, bridge: &Bridge<R>, radius: R, distance: R) -> (R, R) {
        let (one, number) = (R::one(), R::splat);
        let scale = (radius * bridge.inverse_volume).sqrt();
        let x = scale * distance;
        let strength = number(self.strength) * radius;
        let force = strength / (one + x * (number(B) + number(C) * x));
        let root = (4.0 * C - B * B).sqrt();
        let tangent = |x: R| number(2.0 * C / root) * x + number(B / root);
        let (a, b) = (tangent(bridge.rupture * scale), tangent(x));
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
        if !(before | touches).any() {
            return NonContactResponse::default();
        }
        let bridge = self.between(&motion.pair);
        let (bridged, forms) = ((before | touches) & bridge.wet, touches & !before & bridge.wet);
        let held = bridged & motion.overlap.gt(-bridge.rupture);
        let breaks = before & bridge.wet & !held;
        memory[0] = R::one().keep_where(held);
        let radius = R::one() / motion.pair.inverse_harmonic_radius();
        let distance = (-motion.overlap).max(zero);
        let (pull, well) = self.apart(&bridge, radius, distance);
        let force = pull.keep_where(held);
        let mut answer = NonContactResponse {
            force,
            applied_force: force,
            potential: (well + pull * motion.depth).keep_where(held),
            dissipated: zero,
        };
        if (forms | breaks).any() {
            answer.dissipated = (-self.apart(&bridge, radius, zero).1).keep_where(forms);
            // Bodies that overlapped already, in a first look, met before this step.
            let meets = forms & motion.overlap.le(motion.growth);
            let applied = R::select(meets, events::sets_in(motion, zero, force), force);
            let last = self.apart(&bridge, radius, bridge.rupture).0;
            answer.applied_force = R::select(breaks, events::ends(motion, -bridge.rupture, last), applied);
        }
        answer
    }

    fn interaction_range(&self, pair: &Pair<f64>) -> f64 {
        let [_, largest] = self.volumes(pair);
        self.reach * elementary::cbrt(largest)
    }

    /// F_0 k times the largest slope of 1/(1 + 1.05 x + 2.5 x²), 1.2237 at x = 0.1344; of the smallest bridge.
    fn max_stiffness(&self, pair: &Pair<f64>) -> f64 {
        let (radius, [least, _]) = (pair.harmonic_radius(), self.volumes(pair));
        1.2237 * self.strength * radius * (radius / least).sqrt()
    }

    fn reads_quantities(&self) -> bool {
        matches!(self.liquid, Liquid::Shared { .. })
    }

    fn bounded_by(self, sizes: &dyn Fn(&str) -> Sizes) -> Self {
        let Liquid::Shared { share, .. } = self.liquid else { return self };
        let Sizes { least, largest } = sizes(LIQUID);
        Self { liquid: Liquid::Shared { share, least, largest }, ..self }
    }

    fn acts_on_approach(&self) -> bool {
        false
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        let bridge = self.between(pair);
        if overlap >= 0.0 {
            (2, "in contact")
        } else if memory[0] > 0.5 && overlap > -bridge.rupture {
            (1, "bridge")
        } else {
            (0, "free")
        }
    }
}
