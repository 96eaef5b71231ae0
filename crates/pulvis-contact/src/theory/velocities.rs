//! Velocities at which the behaviour of a pair changes.

use super::parameters::{Interpolation, LudingPair, NonContact};
use pulvis_math::elementary;

/// Limits of the two sticking ranges, as velocities outside the range of all forces.
///
/// S1 calls them `v_c^(a)`, `v_c^(b)`, `v_c^(c)` (in captions sometimes `chi_c^(1)`, `chi_c^(2)` for the last
/// two). The pair sticks for `v <= low_end` and for `high_onset <= v <= high_end`. Where the two ranges have
/// merged, `low_end` and `high_onset` are `None` and the pair sticks at every `v <= high_end`, which is
/// infinite if there is no plastic limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CriticalVelocities {
    /// End of the low-velocity sticking caused by `f_a`; zero for `f_a = 0` [m/s].
    pub low_end: Option<f64>,
    /// Onset of the high-velocity sticking caused by `kc`; `None` if there is none [m/s].
    pub high_onset: Option<f64>,
    /// End of the high-velocity sticking; `None` if there is none [m/s].
    pub high_end: Option<f64>,
}

impl CriticalVelocities {
    /// Whether a pair with these limits sticks at the velocity `v_inf` [m/s].
    #[must_use]
    pub fn sticks(&self, velocity: f64) -> bool {
        let low = self.low_end.is_some_and(|end| end > 0.0 && velocity <= end);
        let onset = match (self.low_end, self.high_onset) {
            (None, None) => 0.0,
            (_, onset) => onset.unwrap_or(f64::INFINITY),
        };
        low || (velocity >= onset && self.high_end.is_some_and(|end| velocity <= end))
    }
}

/// Stiffness excesses `s` between which a pair below the plastic limit separates.
struct ReboundWindow {
    lower: f64,
    upper: f64,
}

impl LudingPair {
    /// Impact velocity that just reaches the plastic limit without `f_a`: `v_p0 = sqrt(k1/m_r) dp`, S1 (13)
    /// [m/s].
    #[must_use]
    pub fn v_p0(&self) -> f64 {
        (self.p.k1 / self.p.reduced_mass).sqrt() * self.dp()
    }

    /// Touch velocity that just reaches the plastic limit: `v_p = sqrt(dp (k1 dp - 2 f_a)/m_r)`, S1 (19).
    ///
    /// `None` for `2 f_a > k1 dp`: then the adhesive force alone carries every contact to the limit [m/s].
    #[must_use]
    pub fn v_p(&self) -> Option<f64> {
        let dp = self.dp();
        let squared = dp * (self.p.k1 * dp - 2.0 * self.p.adhesion_force) / self.p.reduced_mass;
        (squared >= 0.0).then(|| squared.sqrt())
    }

    /// Smallest velocity at the end of the contact with which the pair comes free, `v_f^a = f_a/sqrt(m_r
    /// k_c^a)`.
    ///
    /// S1 after (18b). S0 (18), (19) print the particle mass and call it a maximum. Zero for zero range
    /// [m/s].
    #[must_use]
    pub fn v_fa(&self) -> f64 {
        self.p.adhesion_force / (self.p.reduced_mass * self.p.noncontact_stiffness).sqrt()
    }

    /// Limits of the sticking ranges with `f_a` and with a finite non-contact range.
    ///
    /// Closed for `f_a = 0` (S1 (34), (37)), for the linear interpolation with zero range (a square) and for
    /// the constant interpolation; otherwise the exact energy balance is solved by bisection down to
    /// neighbouring `f64`.
    #[must_use]
    pub fn critical_velocities(&self) -> CriticalVelocities {
        if self.dp().is_infinite() {
            return self.critical_velocities_without_limit();
        }
        let eta = self.eta();
        let end = self.threshold_velocity(self.dp(), eta);
        match self.rebound_window() {
            Some(window) if window.lower < eta => {
                let sticks_again = window.upper <= eta;
                CriticalVelocities {
                    low_end: Some(
                        self.threshold_velocity(self.history_of_excess(window.lower), window.lower),
                    ),
                    high_onset: sticks_again
                        .then(|| self.threshold_velocity(self.history_of_excess(window.upper), window.upper)),
                    high_end: sticks_again.then_some(end),
                }
            }
            _ => CriticalVelocities { low_end: None, high_onset: None, high_end: Some(end) },
        }
    }

    /// Without a plastic limit `k2` is one constant, and the balance is a square in `D`.
    fn critical_velocities_without_limit(&self) -> CriticalVelocities {
        let s = self.eta();
        let f_a = self.p.adhesion_force;
        let returned = 1.0 - self.loop_share(s);
        if returned <= 0.0 {
            return CriticalVelocities { low_end: None, high_onset: None, high_end: Some(f64::INFINITY) };
        }
        let stiffness = self.p.k1 * returned;
        let history = (f_a + (f_a * f_a + 2.0 * stiffness * self.noncontact_energy()).sqrt()) / stiffness;
        CriticalVelocities {
            low_end: Some(self.threshold_velocity(history, s)),
            high_onset: None,
            high_end: None,
        }
    }

    /// Velocity outside all ranges that a loop with the history `D` just uses up.
    ///
    /// At a threshold the kinetic energy is exactly what gets lost, a sum of positive terms. (The identical
    /// `v^2 = X (X - phi) k1 dp^2/m_r` is a difference.)
    fn threshold_velocity(&self, history: f64, excess: f64) -> f64 {
        let loop_area = 0.5 * self.p.k1 * history * history * self.loop_share(excess);
        let touch_loss = if self.p.noncontact == NonContact::JumpIn { self.noncontact_energy() } else { 0.0 };
        (2.0 * (loop_area + touch_loss) / self.p.reduced_mass).sqrt()
    }

    /// History overlap that belongs to a stiffness excess.
    fn history_of_excess(&self, excess: f64) -> f64 {
        let ratio = excess / self.eta();
        self.dp() * if self.p.interpolation == Interpolation::SquareRoot { ratio * ratio } else { ratio }
    }

    /// Solves `E_f = f_a^2/(2 k_c^a)` below the limit; `None` if the pair separates nowhere there.
    fn rebound_window(&self) -> Option<ReboundWindow> {
        let (eta, beta) = (self.eta(), self.beta());
        let phi = 2.0 * self.p.adhesion_force / (self.p.k1 * self.dp());
        if phi == 0.0 {
            return Some(ReboundWindow { lower: 0.0, upper: (1.0 + beta) / beta });
        }
        let well = self.noncontact_energy() / (0.5 * self.p.k1 * self.dp() * self.dp());
        if self.p.interpolation == Interpolation::Linear && well == 0.0 {
            return zero_range_window(eta, beta, phi);
        }
        let order = if self.p.interpolation == Interpolation::SquareRoot { 2 } else { 1 };
        Margin {
            beta,
            order,
            force: phi * elementary::powi(eta, order),
            well: well * elementary::powi(eta, 2 * order),
        }
        .window(eta)
    }
}

/// Roots of `beta eta X^2 - (1 + beta - phi eta) X + phi (1 + beta) = 0` in `s = eta X`.
fn zero_range_window(eta: f64, beta: f64, phi: f64) -> Option<ReboundWindow> {
    let linear = 1.0 + beta - phi * eta;
    let constant = phi * eta * (1.0 + beta);
    let discriminant = linear * linear - 4.0 * beta * constant;
    if linear <= 0.0 || discriminant < 0.0 {
        return None;
    }
    let sum = 0.5 * (linear + discriminant.sqrt());
    Some(ReboundWindow { lower: constant / sum, upper: sum / beta })
}

/// The sign of this function of `s` decides whether a pair below the limit comes free:
/// `F(s) = 1 + beta - beta s - (force s^-n + well s^-2n)(1 + beta + s)`.
///
/// `F` is the final energy over `(1/2) k1 D^2`, times `1 + beta + s`. All its terms are concave in `s > 0`,
/// so it has one maximum and at most two roots.
struct Margin {
    beta: f64,
    order: i32,
    force: f64,
    well: f64,
}

impl Margin {
    fn value(&self, s: f64) -> f64 {
        let b = 1.0 + self.beta;
        let attraction = |strength: f64, power: i32| {
            if strength > 0.0 { strength * elementary::powi(s, -power) * (b + s) } else { 0.0 }
        };
        b - self.beta * s - attraction(self.force, self.order) - attraction(self.well, 2 * self.order)
    }

    fn slope(&self, s: f64) -> f64 {
        let b = 1.0 + self.beta;
        let attraction = |strength: f64, power: i32| {
            if strength > 0.0 {
                let m = f64::from(power);
                strength * elementary::powi(s, -power) * (m * b / s + m - 1.0)
            } else {
                0.0
            }
        };
        attraction(self.force, self.order) + attraction(self.well, 2 * self.order) - self.beta
    }

    fn window(&self, eta: f64) -> Option<ReboundWindow> {
        let peak = if self.slope(eta) >= 0.0 { eta } else { last_positive(|s| self.slope(s), eta) };
        if self.value(peak) <= 0.0 {
            return None;
        }
        // Rising part: the first positive value is the last negative one seen from the other side.
        let lower = last_positive(|s| -self.value(s), peak);
        let upper = if self.value(eta) > 0.0 {
            f64::INFINITY
        } else {
            last_positive_above(|s| self.value(s), peak, eta)
        };
        Some(ReboundWindow { lower, upper })
    }
}

/// Largest `f64` in `(0, end]` at which the decreasing `function` is still positive.
fn last_positive(function: impl Fn(f64) -> f64, end: f64) -> f64 {
    last_positive_above(function, f64::MIN_POSITIVE, end)
}

/// Bisection over the bit patterns of positive numbers, which are ordered like the numbers: it ends at
/// neighbouring numbers after at most 64 halvings, whatever the scale of the root.
fn last_positive_above(function: impl Fn(f64) -> f64, start: f64, end: f64) -> f64 {
    let (mut below, mut above) = (start.to_bits(), end.to_bits());
    while above - below > 1 {
        let middle = below + (above - below) / 2;
        if function(f64::from_bits(middle)) > 0.0 { below = middle } else { above = middle }
    }
    f64::from_bits(below)
}

#[cfg(test)]
mod tests {
    use super::Margin;

    #[test]
    fn the_slope_of_the_margin_is_its_derivative() {
        for order in [1, 2] {
            for (beta, force, well) in [(0.3, 0.2, 0.0), (0.0, 0.7, 0.1), (2.0, 0.0, 0.4)] {
                let margin = Margin { beta, order, force, well };
                for s in [0.3, 1.0, 4.0] {
                    let step = 1e-5 * s;
                    let difference = (margin.value(s + step) - margin.value(s - step)) / (2.0 * step);
                    // Second order in the relative step 1e-5, round-off 1e-16/1e-5.
                    let slope = margin.slope(s);
                    assert!((difference - slope).abs() < 1e-8 * (1.0 + slope.abs()), "{difference} {slope}");
                }
            }
        }
    }
}
