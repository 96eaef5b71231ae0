//! How long a contact lasts.

use pulvis_math::elementary;
use std::f64::consts::FRAC_PI_2;

use super::parameters::LudingPair;
use super::restitution::{Balance, Stage};

/// Times and velocities at the corners of the force law.
#[derive(Debug, Clone, Copy)]
pub(super) struct Timetable {
    /// From touch to `D` on the branch `k1` \[s\].
    pub loading: f64,
    /// From `D` over the largest overlap to `delta_min`, or to the stop \[s\].
    pub unloading: f64,
    /// From `delta_min` to the opening, or to the stop; zero if not reached \[s\].
    pub tensile: f64,
    /// Velocity at `D` (positive above the plastic limit) [m/s].
    pub velocity_at_history: f64,
    /// Speed at `delta_min`; zero if not reached [m/s].
    pub velocity_at_minimum: f64,
}

impl LudingPair {
    /// Duration of the contact (`delta >= 0`) for the touch velocity `v_i > 0` [m/s]; `None` where it does
    /// not open.
    ///
    /// With `f_a = 0` and `chi <= 1`: `t = (pi/2)/w1 + [pi/2 + asin(kc delta_min/(k1 D))]/w2 + atanh(wc
    /// delta_min/v_min)/wc`, `w = sqrt(k/m_r)`. Not in the papers; each branch is a harmonic (or exponential)
    /// motion, and their phases add up. Angles are taken by `atan2` of position and velocity, which stays
    /// accurate where `asin` has a vertical tangent \[s\].
    #[must_use]
    pub fn contact_duration(&self, touch_velocity: f64) -> Option<f64> {
        let balance = self.balance(touch_velocity);
        if !(balance.end > 0.0 && touch_velocity > 0.0) {
            return None;
        }
        let table = self.timetable(touch_velocity, &balance, None);
        Some(table.loading + table.unloading + table.tensile)
    }

    /// Times along the way; `stop` is the stage and overlap at which a sticking pair comes to rest.
    pub(super) fn timetable(
        &self,
        touch_velocity: f64,
        balance: &Balance,
        stop: Option<(Stage, f64)>,
    ) -> Timetable {
        let p = &self.p;
        let mass = p.reduced_mass;
        let speed = |energy: f64| (2.0 * energy.max(0.0) / mass).sqrt();
        let shift = p.adhesion_force / p.k1;
        let history = balance.history;
        let velocity_at_history = speed(balance.at_limit);
        let w1 = (p.k1 / mass).sqrt();
        let loading = (elementary::atan2(w1 * (history - shift), velocity_at_history)
            + elementary::atan2(w1 * shift, touch_velocity))
            / w1;
        let w2 = (self.k2(history) / mass).sqrt();
        let centre = balance.force_free_overlap;
        let minimum = self.delta_min(history);
        let velocity_at_minimum = speed(balance.at_minimum);
        let outward = match stop {
            Some((Stage::Unloading, _)) => FRAC_PI_2,
            _ => elementary::atan2(w2 * (centre - minimum), velocity_at_minimum),
        };
        let inward = FRAC_PI_2 - elementary::atan2(w2 * (history - centre), velocity_at_history);
        let tensile = match stop {
            Some((Stage::Unloading, _)) => 0.0,
            Some((Stage::Tensile, overlap)) => self.tensile_time(minimum, velocity_at_minimum, overlap, 0.0),
            _ => self.tensile_time(minimum, velocity_at_minimum, 0.0, speed(balance.end)),
        };
        let unloading = (inward + FRAC_PI_2 + outward) / w2;
        Timetable { loading, unloading, tensile, velocity_at_history, velocity_at_minimum }
    }

    /// Time on the tensile branch from the overlap `from` (speed `fast`) down to `to` (speed `slow`).
    ///
    /// The integral of `d delta/v` with `v^2` a square in `delta`: `ln[(a1 + wc v1)/(a2 + wc v2)]/wc`, where
    /// `a = wc^2 delta + f_a/m_r`. The difference of the two arguments is divided out, so that `kc -> 0`
    /// gives `2 (from - to)/(fast + slow)` without a jump.
    fn tensile_time(&self, from: f64, fast: f64, to: f64, slow: f64) -> f64 {
        let path = from - to;
        if path <= 0.0 {
            return 0.0;
        }
        let mass = self.p.reduced_mass;
        let wc = (self.p.kc / mass).sqrt();
        let pull = self.p.adhesion_force / mass;
        let acceleration = wc * wc * to + pull;
        let mean = (wc * wc * (from + to) + 2.0 * pull) / (fast + slow);
        let growth = path * (wc + mean) / (acceleration + wc * slow);
        if wc == 0.0 || wc * growth < f64::EPSILON {
            // Uniform acceleration: ln(1 + y) = y at this accuracy, and nothing is divided by wc = 0.
            return 2.0 * path / (fast + slow);
        }
        elementary::ln_1p(wc * growth) / wc
    }
}
