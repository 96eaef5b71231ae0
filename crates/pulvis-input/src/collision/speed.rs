//! How fast the bodies meet: as a velocity, or in units of the velocity that reaches the plastic limit.

use super::bodies::Bodies;
use super::closed_form::luding_pair;
use super::incidence::Incidence;
use crate::context::{Location, Reported};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_contact::ContactModel;
use pulvis_contact::theory::{LudingPair, NonContact};
use pulvis_math::{Dimension, elementary};

/// The measure of a speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// Relative speed outside the range of all forces [m/s].
    Velocity,
    /// Its part along the line of centres [m/s].
    NormalVelocity,
    /// Touch velocity over v_p0 = √(k1/m_r) δ_p, S1 (13).
    Chi,
    /// Touch velocity over v_p, which knows f_a, S1 (19).
    Zeta,
}

impl Measure {
    pub(super) const ALL: [(&'static str, Self); 4] = [
        ("velocity", Self::Velocity),
        ("normal_velocity", Self::NormalVelocity),
        ("chi", Self::Chi),
        ("zeta", Self::Zeta),
    ];

    /// What values must be. A bare velocity is one in m/s: the issue of a sweep is a list of numbers.
    pub(super) fn rule(self) -> QuantityRule {
        let dimension = match self {
            Self::Velocity | Self::NormalVelocity => Dimension::VELOCITY,
            Self::Chi | Self::Zeta => Dimension::NONE,
        };
        QuantityRule::of(dimension).above(0.0).or_bare()
    }
}

/// A speed as the user gave it.
#[derive(Clone, Debug)]
pub(super) struct Speed {
    pub(super) measure: Measure,
    pub(super) value: f64,
    pub(super) location: Location,
}

/// Reads at most one of `velocity`, `normal_velocity`, `chi` and `zeta`.
pub(super) fn read_speed(table: &mut TableReader<'_>) -> Result<Option<Speed>, Reported> {
    let mut speed: Option<Speed> = None;
    for (key, measure) in Measure::ALL {
        let Some(value) = table.optional(key, measure.rule())? else { continue };
        if let Some(first) = &speed {
            let problem = Problem::rule(
                format!("given beside `{}`", first.location.path),
                "only one of `velocity`, `normal_velocity`, `chi`, `zeta`",
            );
            return Err(table.refuse(key, problem));
        }
        speed = Some(Speed { measure, value, location: table.location(key) });
    }
    Ok(speed)
}

impl Speed {
    /// Relative speed outside the range of all forces [m/s], or why there is none. All measures but the speed itself are
    /// about its part along the line of centres.
    pub(super) fn velocity(
        &self,
        contact: &ContactModel,
        bodies: &Bodies,
        incidence: Option<Incidence>,
    ) -> Result<f64, Problem> {
        match (self.measure, incidence) {
            (Measure::Velocity, _) => Ok(self.value),
            (_, None) => self.normal_velocity(contact, bodies),
            (_, Some(Incidence { angle, .. })) => {
                Ok(self.normal_velocity(contact, bodies)? / elementary::cos(angle))
            }
        }
    }

    /// The part along the line of centres [m/s].
    fn normal_velocity(&self, contact: &ContactModel, bodies: &Bodies) -> Result<f64, Problem> {
        if self.measure == Measure::NormalVelocity {
            return Ok(self.value);
        }
        let pair = luding_pair(contact, &bodies.pair()).filter(|pair| pair.dp().is_finite());
        let Some(pair) = pair else {
            return Err(Problem::rule(
                "this contact has no plastic limit to measure the speed by",
                "`luding` with kp > k1 and a k2 that is not constant, or `velocity`",
            ));
        };
        let unit = match self.measure {
            Measure::Zeta => pair.v_p().filter(|unit| *unit > 0.0),
            _ => Some(pair.v_p0()),
        };
        let Some(unit) = unit else {
            return Err(Problem::rule(
                "2 f_a > k1 dp: the attraction alone carries every contact to its plastic limit, and zeta has no unit",
                "a smaller f_a, or `chi`",
            ));
        };
        outside(&pair, self.value * unit)
    }
}

/// The speed outside all ranges that leads to the touch velocity `touch` [m/s].
fn outside(pair: &LudingPair, touch: f64) -> Result<f64, Problem> {
    if pair.parameters().noncontact != NonContact::Reversible || pair.v_fa() == 0.0 {
        return Ok(touch);
    }
    let least = pair.v_fa();
    if touch <= least {
        let found = format!("the bodies would touch at {touch:.4e} m/s");
        let expected = format!("more than the {least:.4e} m/s that the attraction gives to bodies at rest");
        return Err(Problem::rule(found, expected));
    }
    Ok(((touch - least) * (touch + least)).sqrt())
}
