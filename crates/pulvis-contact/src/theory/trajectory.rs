//! The motion through one collision, branch by branch, and the oscillation of a pair that sticks.

use pulvis_math::elementary;
use std::f64::consts::TAU;

use super::energies::{available, loading_potential, tensile_potential, unloading_potential};
use super::parameters::LudingPair;
use super::restitution::{Balance, Regime, Restitution, Stage};

/// A swing that returns to the overlap it came from meets it up to round-off.
const ROUND_OFF: f64 = 1.0 + 1e-12;

/// Branch of the force law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Branch {
    /// First loading, slope `k1`.
    Loading,
    /// Elastic un- and reloading, slope `k2` (beyond the plastic limit: the limit branch, slope `kp`).
    Unloading,
    /// Tension, slope `-kc`.
    Tensile,
}

/// State of the pair at one instant of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollisionState {
    /// Overlap \[m\].
    pub overlap: f64,
    /// Rate of the overlap, positive on approach [m/s].
    pub velocity: f64,
    /// Branch of the law.
    pub branch: Branch,
    /// History overlap `D` at this instant \[m\].
    pub history: f64,
    /// Hysteretic force, without `f_a` \[N\].
    pub hysteretic_force: f64,
    /// Kinetic energy of the relative motion \[J\].
    pub kinetic_energy: f64,
    /// Potential energy of the branch, S1 Fig. 15 \[J\].
    pub potential_energy: f64,
    /// Energy that unloading from here would give back, S1 Fig. 15 \[J\].
    pub available_energy: f64,
}

/// What a pair does after it stuck on a contact branch: it swings along `k2` for ever.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StuckOscillation {
    /// Smallest overlap, where the pair stopped \[m\].
    pub overlap_lower: f64,
    /// Largest overlap \[m\].
    pub overlap_upper: f64,
    /// History overlap, lowered with `k2` along the tensile branch \[m\].
    pub history: f64,
    /// Stiffness of the oscillation [N/m].
    pub stiffness: f64,
    /// Period \[s\].
    pub period: f64,
}

/// One linear piece of the motion.
#[derive(Debug, Clone, Copy)]
struct Phase {
    branch: Branch,
    start: f64,
    overlap: f64,
    velocity: f64,
    /// History overlap; on the branches that change it, a placeholder.
    history: f64,
    /// Slope of the force, negative on the tensile branch.
    slope: f64,
    /// Total force at the start of the phase.
    force: f64,
}

/// Motion through one collision from touch, for `gamma_0 = 0`.
#[derive(Debug, Clone)]
pub struct Trajectory {
    pair: LudingPair,
    phases: Vec<Phase>,
    end: f64,
}

impl LudingPair {
    /// The oscillation after sticking, for the velocity `v_inf` [m/s] outside all ranges.
    ///
    /// On the tensile branch the history is lowered with the overlap (S1 2.2.5: `k2` for unloading from `k1`
    /// and for reloading from `kc` "are exactly matched"), so the swing is softer than the branch it came
    /// from. `None` where the pair separates, stops out of contact, or where a strong `f_a` pulls it back
    /// into plastic loading.
    #[must_use]
    pub fn stuck_oscillation(&self, velocity: f64) -> Option<StuckOscillation> {
        self.oscillation_of(&self.restitution(velocity))
    }

    fn oscillation_of(&self, result: &Restitution) -> Option<StuckOscillation> {
        let lower = result.overlap_end;
        let (history, limit) = match result.regime {
            Regime::Rebound | Regime::Stick(Stage::NonContact) => return None,
            Regime::Stick(Stage::Unloading) => (result.history, result.overlap_max),
            Regime::Stick(Stage::Tensile) => {
                let history = self.history_on_tensile_branch(lower)?;
                (history, history)
            }
        };
        let stiffness = self.k2(history);
        let centre = self.delta_0(history) + self.p.adhesion_force / stiffness;
        let upper = 2.0 * centre - lower;
        // A stop on k2 mirrors the largest overlap itself: equality up to round-off.
        (upper <= limit * ROUND_OFF).then(|| StuckOscillation {
            overlap_lower: lower,
            overlap_upper: upper,
            history,
            stiffness,
            period: TAU * (self.p.reduced_mass / stiffness).sqrt(),
        })
    }

    /// The motion from touch with the touch velocity `v_i > 0` [m/s], by phases that are each solved exactly.
    #[must_use]
    pub fn trajectory(&self, touch_velocity: f64) -> Trajectory {
        let p = &self.p;
        let balance = self.balance(touch_velocity);
        let stop = (balance.end <= 0.0).then(|| self.contact_stop(&balance));
        let table = self.timetable(touch_velocity, &balance, stop);
        let history = balance.history;
        let (turn, k2) = (table.loading, self.k2(history));
        let at_turn = (history, table.velocity_at_history);
        let mut phases = vec![
            self.phase(Branch::Loading, 0.0, (0.0, touch_velocity), 0.0, (p.k1, 0.0)),
            self.phase(Branch::Unloading, turn, at_turn, history, (k2, p.k1 * history)),
        ];
        let tension = turn + table.unloading;
        let mut end = tension + table.tensile;
        if matches!(stop, Some((Stage::Unloading, _))) {
            end = f64::INFINITY;
        } else {
            let minimum = self.delta_min(history);
            let at_minimum = (minimum, -table.velocity_at_minimum);
            phases.push(self.phase(Branch::Tensile, tension, at_minimum, history, (-p.kc, -p.kc * minimum)));
        }
        if let Some((Stage::Tensile, overlap)) = stop {
            // Without tensile branch (kp = k1) only f_a can stop the pair, at zero overlap: nothing follows.
            if let Some(history) = self.history_on_tensile_branch(overlap) {
                let (k2, force) = (self.k2(history), -p.kc * overlap);
                phases.push(self.phase(Branch::Unloading, end, (overlap, 0.0), history, (k2, force)));
                end = self.swing_end(end, overlap, history);
            }
        }
        Trajectory { pair: *self, phases, end }
    }

    /// A phase from its start `(overlap, velocity)` and its line `(slope, hysteretic force at the start)`.
    fn phase(
        &self,
        branch: Branch,
        start: f64,
        (overlap, velocity): (f64, f64),
        history: f64,
        (slope, force): (f64, f64),
    ) -> Phase {
        Phase { branch, start, overlap, velocity, history, slope, force: force - self.p.adhesion_force }
    }

    /// How long the motion is known after a stop on the tensile branch: for ever, unless the swing would
    /// reach plastic loading (possible with `f_a` only), which is another collision; then up to there.
    fn swing_end(&self, start: f64, lower: f64, history: f64) -> f64 {
        let k2 = self.k2(history);
        let upper = lower + 2.0 * (self.p.kc * lower + self.p.adhesion_force) / k2;
        if upper <= history * ROUND_OFF {
            return f64::INFINITY;
        }
        // Harmonic about the middle from its lower end: cos(w t) = 1 - 2 (history - lower)/(upper - lower).
        let share = ((history - lower) / (upper - lower)).clamp(0.0, 1.0);
        start + 2.0 * elementary::asin(share.sqrt()) * (self.p.reduced_mass / k2).sqrt()
    }

    fn contact_stop(&self, balance: &Balance) -> (Stage, f64) {
        let stage = if balance.at_minimum <= 0.0 { Stage::Unloading } else { Stage::Tensile };
        (stage, self.stop_overlap(stage, balance))
    }
}

impl Trajectory {
    /// Time at which the contact opens; infinite where the pair stays in contact \[s\].
    #[must_use]
    pub fn end(&self) -> f64 {
        self.end
    }

    /// State at the time `t` \[s\] after touch; `None` outside the contact.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<CollisionState> {
        if !(0.0..=self.end).contains(&time) {
            return None;
        }
        let phase = self.phases.iter().rev().find(|phase| phase.start <= time)?;
        Some(self.state(phase, time - phase.start))
    }

    fn state(&self, phase: &Phase, elapsed: f64) -> CollisionState {
        let p = &self.pair.p;
        let (overlap, velocity) = phase.propagate(elapsed, p.reduced_mass);
        let (history, force, potential) = match phase.branch {
            Branch::Loading => (overlap, p.k1 * overlap, loading_potential(p.k1, overlap)),
            Branch::Unloading => {
                let k2 = self.pair.k2(phase.history);
                let force = k2 * (overlap - self.pair.delta_0(phase.history));
                (phase.history, force, unloading_potential(force, k2))
            }
            Branch::Tensile => {
                let history = self.pair.history_on_tensile_branch(overlap).unwrap_or(0.0);
                (history, -p.kc * overlap, tensile_potential(p.kc, overlap))
            }
        };
        CollisionState {
            overlap,
            velocity,
            branch: phase.branch,
            history,
            hysteretic_force: force,
            kinetic_energy: 0.5 * p.reduced_mass * velocity * velocity,
            potential_energy: potential,
            available_energy: available(force, self.pair.k2(history)),
        }
    }
}

impl Phase {
    /// Exact solution of `m_r delta'' = -(force + slope (delta - overlap))` after the time `t`.
    ///
    /// Written with the displacement from the start of the phase, so that a slope of zero is the plain limit.
    fn propagate(&self, time: f64, mass: f64) -> (f64, f64) {
        let acceleration = -self.force / mass;
        let w = (self.slope.abs() / mass).sqrt();
        let angle = w * time;
        // sine = sin(w t)/w, versine = (1 - cos(w t))/w^2, or their hyperbolic counterparts.
        let (cosine, sine, versine) = if angle < 1e-9 {
            (1.0, time, 0.5 * time * time)
        } else if self.slope > 0.0 {
            (
                elementary::cos(angle),
                elementary::sin(angle) / w,
                2.0 * elementary::powi(elementary::sin(0.5 * angle) / w, 2),
            )
        } else {
            (
                elementary::cosh(angle),
                elementary::sinh(angle) / w,
                2.0 * elementary::powi(elementary::sinh(0.5 * angle) / w, 2),
            )
        };
        let overlap = self.overlap + self.velocity * sine + acceleration * versine;
        (overlap, self.velocity * cosine + acceleration * sine)
    }
}
