//! The linear spring-dashpot law.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Real, elementary};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

/// Linear spring and dashpot, f = k δ + γ_0 dδ/dt while δ > 0.
///
/// The spring and the dashpot are given in one of five ways: by `k` alone, by `k` and `gamma_0`, by
/// `k` and `restitution`, by `k` and `damping_rate` (γ = rate × m_r, the convention of LAMMPS
/// gran/hooke), or by `contact_time` and `restitution`. With a restitution, every pair of a
/// polydisperse packing gets the dashpot that its own reduced mass needs. Valid for
/// 0 <= γ < 2 √(k m_r); the contact ends at δ = 0.
///
/// # Source
/// P. A. Cundall, O. D. L. Strack, Géotechnique 29, 47 (1979); A. Singh, V. Magnanimo, S. Luding,
/// arXiv:1503.03720 ("S1"), eqs. (2)-(4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    // k = stiffness + stiffness_per_mass m_r
    stiffness: f64,
    stiffness_per_mass: f64,
    // gamma = dashpot + dashpot_per_root_mass √m_r + dashpot_per_mass m_r
    dashpot: f64,
    dashpot_per_root_mass: f64,
    dashpot_per_mass: f64,
}

impl Linear {
    /// Spring stiffness k [N/m] and dashpot coefficient γ_0 [kg/s].
    pub fn new(stiffness: f64, dashpot: f64) -> Self {
        Self {
            stiffness,
            stiffness_per_mass: 0.0,
            dashpot,
            dashpot_per_root_mass: 0.0,
            dashpot_per_mass: 0.0,
        }
    }

    /// Spring stiffness k [N/m], and for each pair the dashpot γ = −2 ln e √(k m_r / (π² + ln² e))
    /// that gives the coefficient of restitution e (S1 eq. 4, solved for γ).
    pub fn from_restitution(stiffness: f64, restitution: f64) -> Self {
        let log = elementary::ln(restitution);
        let dashpot_per_root_mass = -2.0 * log * (stiffness / (PI * PI + log * log)).sqrt();
        Self { dashpot_per_root_mass, ..Self::new(stiffness, 0.0) }
    }

    /// For each pair the spring k = m_r (π² + ln² e)/t_c² and dashpot γ = −2 m_r ln e / t_c that give
    /// the duration t_c [s] and the coefficient of restitution e (S1 eqs. 3 and 4, solved).
    pub fn from_contact_time(contact_time: f64, restitution: f64) -> Self {
        let log = elementary::ln(restitution);
        Self {
            stiffness_per_mass: (PI * PI + log * log) / (contact_time * contact_time),
            dashpot_per_mass: -2.0 * log / contact_time,
            ..Self::new(0.0, 0.0)
        }
    }

    /// Spring stiffness k of a pair [N/m].
    #[inline(always)]
    pub fn stiffness<R: Real>(&self, pair: &Pair<R>) -> R {
        let stiffness = R::splat(self.stiffness);
        // The reduced mass costs a division: only where the law was given by a duration.
        if self.stiffness_per_mass == 0.0 {
            stiffness
        } else {
            stiffness + R::splat(self.stiffness_per_mass) * pair.reduced_mass()
        }
    }
}

impl Law for Linear {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "linear",
        summary: "linear spring and dashpot",
        equations: "\
f   = k δ + γ₀ dδ/dt             for δ > 0
e   = exp(−π h/ω),  t_c = π/ω    h = γ₀/(2 m_r),  ω² = k/m_r − h²",
        source: "Cundall & Strack, Géotechnique 29, 47 (1979); Singh, Magnanimo & Luding, arXiv:1503.03720, eqs. 2-4",
        parameters: &[
            Parameter::number("k", "k", Dimension::STIFFNESS, Range::Positive, "spring stiffness").optional(),
            Parameter::number("gamma_0", "γ₀", Dimension::DASHPOT, Range::NonNegative, "dashpot coefficient")
                .optional(),
            Parameter::number(
                "contact_time",
                "t_c",
                Dimension::TIME,
                Range::Positive,
                "duration of a contact; sets k and the dashpot of each pair by its reduced mass",
            )
            .optional(),
            Parameter::number(
                "restitution",
                "e",
                Dimension::NONE,
                Range::Within(0.0, 1.0),
                "coefficient of restitution; sets the dashpot of each pair by its reduced mass",
            )
            .optional(),
            Parameter::number(
                "damping_rate",
                "γ₀/m_r",
                Dimension::RATE,
                Range::NonNegative,
                "dashpot coefficient over the reduced mass (LAMMPS gran/hooke: gamma_n)",
            )
            .optional(),
        ],
        particle_quantities: &[],
        memory: &[],
        closed_form: "restitution, duration and largest overlap in pulvis_contact::theory (S1 eqs. 3, 4)",
        example: "law = \"linear\"\nk = \"100 N/m\"\ngamma_0 = \"5e-3 kg/s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let given = |name| values.optional_number(name);
        let dashpots = ["gamma_0", "restitution", "damping_rate"];
        let mut named = dashpots.into_iter().filter(|name| given(name).is_some());
        if let (Some(first), Some(second)) = (named.next(), named.next()) {
            return Err(InvalidParameter::Inconsistent {
                name: second,
                found: format!("given beside `{first}`"),
                expected: "only one of `gamma_0`, `restitution`, `damping_rate`".to_owned(),
                reason: "each of them sets the dashpot",
            });
        }
        match (given("k"), given("contact_time"), given("restitution")) {
            (Some(_), Some(_), _) => Err(InvalidParameter::Inconsistent {
                name: "contact_time",
                found: "given beside `k`".to_owned(),
                expected: "either `k` or `contact_time`".to_owned(),
                reason: "each of them sets the spring",
            }),
            (None, None, _) => Err(InvalidParameter::Missing { name: "k" }),
            (None, Some(_), None) => Err(InvalidParameter::Missing { name: "restitution" }),
            (None, Some(contact_time), Some(restitution)) => {
                Ok(Self::from_contact_time(contact_time, restitution))
            }
            (Some(stiffness), None, Some(restitution)) => Ok(Self::from_restitution(stiffness, restitution)),
            (Some(stiffness), None, None) => Ok(Self {
                dashpot_per_mass: given("damping_rate").unwrap_or(0.0),
                ..Self::new(stiffness, given("gamma_0").unwrap_or(0.0))
            }),
        }
    }
}

impl Linear {
    /// Dashpot coefficient γ_0 of a pair [kg/s].
    #[inline(always)]
    fn dashpot_of<R: Real>(&self, pair: &Pair<R>) -> R {
        // A square root and a division only for the ways of giving the dashpot that need them.
        let mut dashpot = R::splat(self.dashpot);
        if self.dashpot_per_root_mass != 0.0 {
            dashpot += R::splat(self.dashpot_per_root_mass) * pair.reduced_mass().sqrt();
        }
        if self.dashpot_per_mass != 0.0 {
            dashpot += R::splat(self.dashpot_per_mass) * pair.reduced_mass();
        }
        dashpot
    }
}

impl NormalLaw for Linear {
    type Memory<R: Real> = ();

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, _memory: &mut ()) -> NormalResponse<R> {
        let stiffness = self.stiffness(&motion.pair);
        let force = stiffness * motion.depth;
        let stored_energy = R::splat(0.5) * force * motion.depth;
        NormalResponse {
            dashpot: self.dashpot_of(&motion.pair),
            ..NormalResponse::elastic(motion, force, stored_energy, stiffness)
        }
    }

    const HAS_DASHPOT: bool = true;

    fn dashpot(&self, pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.dashpot_of(pair)
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, _memory: &()) -> (u8, &'static str) {
        if overlap <= 0.0 { (0, "open") } else { (1, "spring") }
    }

    fn max_stiffness(&self, pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.stiffness(pair)
    }
}
