//! Thornton and Ning's adhesive elasto-plastic spheres in straight lines, after Pasha et al.

use super::error::{TheoryError, not_negative, positive};

/// A pair that loads along `k_e` up to the force `f_y` and along `k_p` beyond, and pulls off with
/// `f_cp = f_ce + k_cp (alpha_p - alpha_0)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PashaPair {
    elastic: f64,
    plastic: f64,
    growth: f64,
    elastic_pull_off: f64,
    yield_force: f64,
    reduced_mass: f64,
}

impl PashaPair {
    /// A pair with the stiffnesses `[k_e, k_p, k_cp]` [N/m], the forces `f_ce` and `f_y` \[N\] and the reduced mass `m_r`
    /// \[kg\].
    ///
    /// # Errors
    ///
    /// Where a stiffness, a force or the mass are not positive, or `k_p` exceeds `k_e`.
    pub fn new(
        [elastic, plastic, growth]: [f64; 3],
        elastic_pull_off: f64,
        yield_force: f64,
        reduced_mass: f64,
    ) -> Result<Self, TheoryError> {
        if elastic < plastic {
            return Err(TheoryError::SofterUnloading { k1: plastic, kp: elastic });
        }
        Ok(Self {
            elastic: positive("elastic stiffness", elastic)?,
            plastic: positive("plastic stiffness", plastic)?,
            growth: not_negative("growth of the pull-off force", growth)?,
            elastic_pull_off: positive("pull-off force", elastic_pull_off)?,
            yield_force: not_negative("yield force", yield_force)?,
            reduced_mass: positive("reduced mass", reduced_mass)?,
        })
    }

    /// Largest overlap of a collision with the velocity `v` [m/s] that makes the contact flow \[m\]: the root of
    /// `m_r v^2/2 = k_e a_y^2/2 - (8/9) f_ce a_y + f_y (a - a_y) + k_p (a - a_y)^2/2`.
    #[must_use]
    pub fn overlap_max(&self, velocity: f64) -> f64 {
        let pull = 8.0 / 9.0 * self.elastic_pull_off;
        let yields = (self.yield_force + pull) / self.elastic;
        let rest = 0.5 * self.reduced_mass * velocity * velocity - 0.5 * self.elastic * yields * yields
            + pull * yields;
        let beyond =
            (self.yield_force * self.yield_force + 2.0 * self.plastic * rest).sqrt() - self.yield_force;
        yields + beyond / self.plastic
    }

    /// Force at the largest overlap of a contact that has flowed \[N\].
    #[must_use]
    pub fn force_max(&self, overlap_max: f64) -> f64 {
        let yields = (self.yield_force + 8.0 / 9.0 * self.elastic_pull_off) / self.elastic;
        self.yield_force + self.plastic * (overlap_max - yields)
    }

    /// Overlap `alpha_p` at which the unloading contact is free of force \[m\].
    #[must_use]
    pub fn force_free_overlap(&self, overlap_max: f64) -> f64 {
        overlap_max - self.force_max(overlap_max) / self.elastic
    }

    /// Pull-off force `f_cp` after a largest overlap \[N\].
    #[must_use]
    pub fn pull_off_force(&self, overlap_max: f64) -> f64 {
        let elastic = 8.0 / 9.0 * self.elastic_pull_off / self.elastic;
        self.elastic_pull_off + self.growth * (self.force_free_overlap(overlap_max) - elastic)
    }

    /// Overlap `alpha_fp` at which the bodies detach \[m\].
    #[must_use]
    pub fn detachment_overlap(&self, overlap_max: f64) -> f64 {
        self.force_free_overlap(overlap_max) - 13.0 / 9.0 * self.pull_off_force(overlap_max) / self.elastic
    }

    /// Coefficient of restitution at a velocity [m/s] that makes the contact flow, from
    /// `E_f = (f_max^2 - (137/81) f_cp^2)/(2 k_e)`; zero where the bodies stick [-].
    #[must_use]
    pub fn restitution(&self, velocity: f64) -> f64 {
        let overlap = self.overlap_max(velocity);
        let (load, pull) = (self.force_max(overlap), self.pull_off_force(overlap));
        let left = (load * load - 137.0 / 81.0 * pull * pull) / self.elastic;
        (left / (self.reduced_mass * velocity * velocity)).max(0.0).sqrt()
    }

    /// Velocity below which elastic bodies stick, `sqrt(73/81) f_ce/sqrt(k_e m_r)` [m/s].
    #[must_use]
    pub fn sticking_velocity(&self) -> f64 {
        (73.0_f64 / 81.0).sqrt() * self.elastic_pull_off / (self.elastic * self.reduced_mass).sqrt()
    }
}
