//! The coefficient of restitution, with and without `f_a`, below and above the plastic limit.

use super::parameters::{LudingPair, NonContact};
use pulvis_math::elementary;

/// Where the kinetic energy of a sticking pair vanishes on the way out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// On the elastic branch of slope `k2`, before the tensile branch is reached.
    Unloading,
    /// On the tensile branch of slope `-kc`.
    Tensile,
    /// Out of contact, on the non-contact branch of slope `-k_c^a`.
    NonContact,
}

/// How a collision ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Regime {
    /// The particles separate.
    Rebound,
    /// The particles stay bound. Any outward stop counts: the energy only falls afterwards.
    Stick(Stage),
}

/// Outcome of one central collision without viscosity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restitution {
    /// `e = v_f^inf/v_i^inf = eps_o e_n eps_i`, S1 (25); zero where the pair sticks [-].
    pub value: f64,
    /// How the collision ended.
    pub regime: Regime,
    /// Pull-in coefficient `eps_i = v_i/v_i^inf`, S1 (17b) [-].
    pub pull_in: f64,
    /// Contact coefficient `e_n = v_f/v_i`, S1 (22), (24); zero where the contact does not open [-].
    pub contact: f64,
    /// Pull-off coefficient `eps_o = v_f^inf/v_f`, S1 (18b); zero where the pair does not come free [-].
    pub pull_off: f64,
    /// Largest overlap \[m\].
    pub overlap_max: f64,
    /// History overlap `D = min(delta_max, dp)` from which the pair unloads \[m\].
    pub history: f64,
    /// Overlap at the end: where the kinetic energy vanishes (sticking), or where the force ends (`delta_a`,
    /// zero for zero range) \[m\].
    pub overlap_end: f64,
    /// Energy lost: up to the end of the interaction, for a sticking pair up to its first stop, where the
    /// rest is stored in the elastic branch and in the adhesive potential \[J\].
    pub energy_dissipated: f64,
}

/// Energies along one collision, all from the history overlap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Balance {
    /// `D = min(delta_max, dp)` \[m\].
    pub history: f64,
    /// Kinetic energy left at `D`; positive only above the plastic limit \[J\].
    pub at_limit: f64,
    /// Kinetic energy at the force-free overlap `delta_0a` on the way out, S1 (20c), (23b) \[J\].
    pub force_free: f64,
    /// `delta_0a = delta_0 + f_a/k2` \[m\].
    pub force_free_overlap: f64,
    /// Kinetic energy at `delta_min`, negative if it is not reached, S1 (20d), (23c) corrected \[J\].
    pub at_minimum: f64,
    /// Kinetic energy at the end of the contact, negative if it is not reached, S1 (21), (23e) \[J\].
    pub end: f64,
    /// Kinetic energy at touch \[J\].
    pub touch: f64,
    /// Area of the loop \[J\].
    pub loop_area: f64,
}

impl LudingPair {
    /// Overlap at which the loading branch `k1` alone would stop the touch velocity `v_i` [m/s], S1 (20b)
    /// \[m\].
    pub(super) fn loading_overlap(&self, touch_velocity: f64) -> f64 {
        let f_a = self.p.adhesion_force;
        let momentum = (self.p.k1 * self.p.reduced_mass).sqrt() * touch_velocity;
        (f_a + elementary::hypot(f_a, momentum)) / self.p.k1
    }

    /// Energy balance of a collision that touches with the velocity `v_i` [m/s].
    ///
    /// S1 (23c) prints `(kc delta_min - f_a)^2`; it is `(kc delta_min + f_a)^2`, and with it (23e) follows.
    pub(super) fn balance(&self, touch_velocity: f64) -> Balance {
        let p = &self.p;
        let f_a = p.adhesion_force;
        let interaction_range = self.loading_overlap(touch_velocity);
        let history = interaction_range.min(self.dp());
        let k2 = self.k2(history);
        // E_i - E(D) = (reach - D) times the mean force in between: no difference of two large energies.
        let at_limit = (interaction_range - history) * (0.5 * p.k1 * (interaction_range + history) - f_a);
        let touch = 0.5 * p.reduced_mass * touch_velocity * touch_velocity;
        let share = self.loop_share(self.stiffness_excess(history));
        // (1/2) k1 D^2 = E_i + f_a D below the limit: the loop is then an exact share of E_i.
        let loop_area = if at_limit > 0.0 {
            0.5 * p.k1 * history * history * share
        } else {
            share * (touch + f_a * history)
        };
        let end = touch - loop_area;
        let minimum = self.delta_min(history);
        Balance {
            history,
            at_limit,
            force_free: elementary::powi(p.k1 * history - f_a, 2) / (2.0 * k2) + at_limit,
            force_free_overlap: self.delta_0(history) + f_a / k2,
            at_minimum: end + minimum * (0.5 * p.kc * minimum + f_a),
            end,
            touch,
            loop_area,
        }
    }

    /// Touch velocity `v_i` for the velocity `v_inf` [m/s] outside the range of all forces, S1 (17a) [m/s].
    #[must_use]
    pub fn touch_velocity(&self, velocity: f64) -> f64 {
        match self.p.noncontact {
            NonContact::Reversible => elementary::hypot(velocity, self.v_fa()),
            NonContact::None | NonContact::JumpIn => velocity,
        }
    }

    /// Pull-in coefficient `eps_i = sqrt(1 + f_a^2/(k_c^a m_r v_inf^2))`, S1 (17b); 1 for jump-in [-].
    #[must_use]
    pub fn pull_in(&self, velocity: f64) -> f64 {
        if self.p.noncontact == NonContact::Reversible && self.v_fa() > 0.0 {
            self.touch_velocity(velocity) / velocity
        } else {
            1.0
        }
    }

    /// Pull-off coefficient `eps_o = sqrt(1 - (v_f^a/v_f)^2)` for the velocity `v_f` [m/s] at the end of the
    /// contact.
    ///
    /// S1 (18b), exact also with `f_a` in the contact; S0 prints the particle mass for `m_r`, and S1 after
    /// (25) says "1 or < 0" for what is below 1 in both modes. Zero where the pair does not come free [-].
    #[must_use]
    pub fn pull_off(&self, separation_velocity: f64) -> f64 {
        let v_fa = self.v_fa();
        if v_fa == 0.0 {
            return 1.0;
        }
        if separation_velocity <= v_fa {
            return 0.0;
        }
        ((separation_velocity - v_fa) * (separation_velocity + v_fa)).sqrt() / separation_velocity
    }

    /// Largest overlap of a collision with the touch velocity `v_i` [m/s], S1 (20b) and section 3.3.2 \[m\].
    #[must_use]
    pub fn overlap_max(&self, touch_velocity: f64) -> f64 {
        self.turning_overlap(&self.balance(touch_velocity))
    }

    pub(super) fn turning_overlap(&self, balance: &Balance) -> f64 {
        if balance.at_limit > 0.0 {
            balance.force_free_overlap + (2.0 * balance.force_free / self.p.kp).sqrt()
        } else {
            balance.history
        }
    }

    /// Coefficient of restitution for the velocity `v_inf >= 0` [m/s] outside the range of all forces.
    ///
    /// Exact for `gamma_0 = 0` and every interpolation, S1 (16)-(25). At `v_inf = 0` it is the limit from
    /// above.
    #[must_use]
    pub fn restitution(&self, velocity: f64) -> Restitution {
        let touch_velocity = self.touch_velocity(velocity);
        let balance = self.balance(touch_velocity);
        let well = self.noncontact_energy();
        let touch_loss = if self.p.noncontact == NonContact::JumpIn { well } else { 0.0 };
        let lost = balance.loop_area + touch_loss;
        let share = self.lost_share(velocity, &balance, lost);
        let rebound = share < 1.0;
        let contact = if balance.end > 0.0 {
            (balance.end / balance.touch).sqrt()
        } else if rebound {
            // Energies below the smallest number: the share is still known.
            (1.0 - share).sqrt()
        } else {
            0.0
        };
        let mut result = Restitution {
            value: if rebound { (1.0 - share).sqrt() } else { 0.0 },
            regime: Regime::Rebound,
            pull_in: self.pull_in(velocity),
            contact,
            pull_off: 0.0,
            overlap_max: self.turning_overlap(&balance),
            history: balance.history,
            overlap_end: self.noncontact_overlap(),
            energy_dissipated: lost,
        };
        if rebound {
            result.pull_off =
                if well > 0.0 { ((balance.end - well) / balance.end).max(0.0).sqrt() } else { 1.0 };
        } else {
            let stage = stage_of(&balance);
            let stop = self.stop_overlap(stage, &balance);
            result.regime = Regime::Stick(stage);
            result.overlap_end = stop;
            result.energy_dissipated = self.dissipated_until(stage, stop, &balance, touch_loss);
        }
        result
    }

    /// Lost energy over the kinetic energy outside all ranges, also where both underflow.
    fn lost_share(&self, velocity: f64, balance: &Balance, lost: f64) -> f64 {
        if self.p.adhesion_force == 0.0 && balance.at_limit <= 0.0 {
            return self.loop_share(self.stiffness_excess(balance.history));
        }
        if lost == 0.0 {
            return 0.0;
        }
        lost / (0.5 * self.p.reduced_mass * velocity * velocity)
    }

    /// Overlap at which the pair stops, for each stage.
    pub(super) fn stop_overlap(&self, stage: Stage, balance: &Balance) -> f64 {
        let f_a = self.p.adhesion_force;
        // Root of E_f + slope delta^2/2 + f_a delta = 0 next to zero, without a difference of near equals. On
        // -kc the energy E_f is negative and the root an overlap; on -k_c^a it is positive and the root a
        // gap.
        let root = |slope: f64| {
            let denominator = f_a + (f_a * f_a - 2.0 * slope * balance.end).max(0.0).sqrt();
            if denominator > 0.0 { -2.0 * balance.end / denominator } else { 0.0 }
        };
        match stage {
            Stage::Unloading => {
                let k2 = self.k2(balance.history);
                balance.force_free_overlap - (2.0 * balance.force_free / k2).max(0.0).sqrt()
            }
            Stage::Tensile => root(self.p.kc),
            Stage::NonContact => root(self.p.noncontact_stiffness),
        }
    }

    /// Energy that is neither kinetic, nor stored in the elastic branch, nor in the adhesive potential at the
    /// stop.
    fn dissipated_until(&self, stage: Stage, stop: f64, balance: &Balance, touch_loss: f64) -> f64 {
        let stored = match stage {
            Stage::NonContact => return balance.loop_area + touch_loss,
            Stage::Unloading => {
                let k2 = self.k2(balance.history);
                0.5 * k2 * elementary::powi(stop - self.delta_0(balance.history), 2)
            }
            Stage::Tensile => {
                let k2 = self.history_on_tensile_branch(stop).map_or(self.p.k1, |history| self.k2(history));
                elementary::powi(self.p.kc * stop, 2) / (2.0 * k2)
            }
        };
        balance.touch + self.p.adhesion_force * stop - stored + touch_loss
    }
}

/// Stage at which a sticking pair stops: the first energy along the way that is not positive.
fn stage_of(balance: &Balance) -> Stage {
    if balance.at_minimum <= 0.0 && balance.loop_area > 0.0 {
        Stage::Unloading
    } else if balance.end <= 0.0 {
        Stage::Tensile
    } else {
        Stage::NonContact
    }
}
