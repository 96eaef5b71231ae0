//! Visco-elastic spheres whose modulus relaxes: the solution of Lee and Radok for a standard linear solid.

use std::f64::consts::PI;

use pulvis_math::{Dimension, Real, elementary};

use super::dmt::WORK_OF_ADHESION_OR_NONE;
use super::hertz::{effective_radius, expected_overlap};
use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Parameter, Range, Role, Values};
use crate::events;
use crate::expected::ExpectedLoading;
use crate::functions::cbrt;
use crate::kinematics::NormalMotion;
use crate::memory::Memory;
use crate::pair::Pair;

/// Spheres of a material whose effective modulus relaxes from E_0 to E_∞ with the time τ, and a constant pull-off force:
///
/// ```text
/// F = (4/(3 R)) (E_∞ A + q) − 2 π Γ R        A = (R δ)^(3/2),  dq/dt = −q/τ + (E_0 − E_∞) dA/dt,  q >= −E_∞ A
/// ```
///
/// The solution holds while the contact area grows. Where it shrinks the material would pull; the bound of q keeps its
/// force from becoming negative. q is advanced exactly for A linear in the step. The stored energy is
/// ψ = (4/(3 R)) {(2/5) E_∞ A δ + (E_0 − E_∞) [(2/5) (A δ − A_v δ_v) − A_v (δ − δ_v)]} with A_v = A − q/(E_0 − E_∞),
/// δ_v = A_v^(2/3)/R; relaxation loses (4/(3 R)) (E_0 − E_∞) (δ − δ_v) (A − A_v)/τ >= 0, booked as plastic as also what
/// the bound of q takes.
///
/// The step of q is exact for A linear in it, whatever its length is against τ: the automatic time step resolves the collision
/// only.
///
/// # Source
/// E. H. Lee, J. R. M. Radok, J. Appl. Mech. 27, 438 (1960). The bound and the energies are derived here. The law stands
/// in for the adhesive visco-elastic one of G. Haiat, M. C. Phan Huy, E. Barthel, J. Mech. Phys. Solids 51, 69 (2003),
/// which could not be confirmed against the original.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeeRadok {
    /// Effective modulus of fast loading E_0 [Pa].
    instant: f64,
    /// Effective modulus of slow loading E_∞ [Pa].
    relaxed: f64,
    /// Relaxation time τ [s].
    relaxation_time: f64,
    /// 2 π Γ [N/m].
    attraction: f64,
}

/// The memory of the law.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LeeRadokMemory<R> {
    /// Part q of the load that relaxes, times 3 R/4 [N m].
    pub relaxing: R,
    /// Overlap of the last step, zero for bodies apart [m].
    pub depth: R,
}

impl<R: Real> Memory<R> for LeeRadokMemory<R> {
    const COLUMNS: usize = 2;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { relaxing: column(0), depth: column(1) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.relaxing);
        column(1, self.depth);
    }
}

const fn modulus(name: &'static str, symbol: &'static str, meaning: &'static str) -> Parameter {
    Parameter::number(name, symbol, Dimension::PRESSURE, Range::Positive, meaning)
}

impl Law for LeeRadok {
    const ENTRY: LawEntry = LawEntry {
        role: Role::Normal,
        name: "lee-radok",
        summary: "visco-elastic spheres whose modulus relaxes (standard linear solid)",
        equations: "\
F   = (4/(3 R)) (E_∞ A + q) − 2 π Γ R       for δ > 0,  A = (R δ)^(3/2)
dq/dt = −q/τ + (E_0 − E_∞) dA/dt,  q ≥ −E_∞ A
a   = √(R δ)                                contact radius;  friction refers to F + 2 π Γ R",
        source: "Lee & Radok, J. Appl. Mech. 27, 438 (1960); stands in for Haiat, Phan Huy & Barthel (2003), which could not be confirmed against the original",
        parameters: &[
            modulus("modulus_instant", "E₀", "effective modulus of fast loading"),
            modulus(
                "modulus_relaxed",
                "E_∞",
                "effective modulus of slow loading, below that of fast loading",
            ),
            Parameter::number("relaxation_time", "τ", Dimension::TIME, Range::Positive, "relaxation time"),
            WORK_OF_ADHESION_OR_NONE,
        ],
        particle_quantities: &[],
        memory: &["relaxing [N m]", "depth [m]"],
        closed_form: "relaxation of the force at constant overlap; fast and slow collisions as of hertz (tests of the law)",
        example: "law = \"lee-radok\"\nmodulus_instant = \"1e8 Pa\"\nmodulus_relaxed = \"2e7 Pa\"\nrelaxation_time = \"1e-3 s\"",
    };

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let (instant, relaxed) = (values.number("modulus_instant")?, values.number("modulus_relaxed")?);
        if relaxed >= instant {
            return Err(InvalidParameter::Inconsistent {
                name: "modulus_relaxed",
                found: format!("{relaxed} Pa"),
                expected: format!("less than modulus_instant = {instant} Pa"),
                reason: "a material that stiffens while it rests creates energy; `hertz` has one modulus",
            });
        }
        let attraction = 2.0 * PI * values.number("work_of_adhesion")?;
        Ok(Self { instant, relaxed, relaxation_time: values.number("relaxation_time")?, attraction })
    }
}

/// A moment of the relaxing part, over 4/(3 R) where it is an energy.
struct Moment<R> {
    /// A [m³].
    loaded: R,
    /// δ [m].
    depth: R,
    /// A_v [m³].
    creeping: R,
    /// δ_v [m].
    creeping_depth: R,
}

impl<R: Real> Moment<R> {
    /// Energy over E_0 − E_∞ [m⁴].
    #[inline(always)]
    fn energy(&self) -> R {
        let own = R::splat(0.4) * self.loaded * self.depth;
        own + R::splat(0.6) * self.creeping * self.creeping_depth - self.creeping * self.depth
    }

    /// Loss per relaxation time, over E_0 − E_∞ [m⁴].
    #[inline(always)]
    fn loss(&self) -> R {
        (self.depth - self.creeping_depth) * (self.loaded - self.creeping)
    }
}

impl LeeRadok {
    /// E_0 − E_∞ [Pa].
    fn relaxing_modulus(&self) -> f64 {
        self.instant - self.relaxed
    }

    #[inline(always)]
    fn moment<R: Real>(&self, loaded: R, depth: R, relaxing: R, inverse_radius: R) -> Moment<R> {
        // Between round-off, A_v lies between 0 and A.
        let creeping = (loaded - relaxing * R::splat(1.0 / self.relaxing_modulus())).max(R::zero());
        let root = cbrt(creeping);
        Moment { loaded, depth, creeping, creeping_depth: root * root * inverse_radius }
    }
}

/// e^(−x) and (1 − e^(−x))/x.
fn decay(x: f64) -> (f64, f64) {
    (elementary::exp(-x), if x > 0.0 { -elementary::exp_m1(-x) / x } else { 1.0 })
}

impl NormalLaw for LeeRadok {
    type Memory<R: Real> = LeeRadokMemory<R>;

    const PATH_ONLY: bool = false;

    const DEPENDS_ON_TIME: bool = true;

    #[inline(always)]
    fn respond<R: Real>(
        &self,
        motion: &NormalMotion<R>,
        memory: &mut LeeRadokMemory<R>,
    ) -> NormalResponse<R> {
        let (number, depth, before) = (R::splat, motion.depth, *memory);
        let inverse_radius = number(2.0) * motion.pair.inverse_harmonic_radius();
        let radius = R::one() / inverse_radius;
        let contact_radius = (radius * depth).sqrt();
        let loaded = radius * depth * contact_radius;
        let loaded_before = radius * before.depth * (radius * before.depth).sqrt();
        let stiffening = number(self.relaxing_modulus());
        let step = motion.time_step / self.relaxation_time;
        let (kept, mean) = decay(step);
        let grown = stiffening * (loaded - loaded_before);
        let free = before.relaxing * number(kept) + grown * number(mean);
        let least = number(-self.relaxed) * loaded;
        let relaxing = free.max(least);
        let scale = number(4.0 / 3.0) * inverse_radius;
        let repulsion = scale * (number(self.relaxed) * loaded + relaxing);

        // Relaxation by Simpson's rule; what the bound takes, exactly.
        let end = self.moment(loaded, depth, free, inverse_radius);
        let mut lost = R::zero();
        if step > 0.0 {
            let start = self.moment(loaded_before, before.depth, before.relaxing, inverse_radius);
            let (kept, mean) = decay(0.5 * step);
            let half = number(0.5);
            let loaded = half * (loaded_before + loaded);
            let root = cbrt(loaded);
            let relaxing = before.relaxing * number(kept) + half * grown * number(mean);
            let middle = self.moment(loaded, root * root * inverse_radius, relaxing, inverse_radius);
            let sum = start.loss() + number(4.0) * middle.loss() + end.loss();
            lost = number(step / 6.0) * sum.max(R::zero());
        }
        let bound = self.moment(loaded, depth, relaxing, inverse_radius);
        // Along the bound the bodies do not do the work against the tension that the bound takes.
        let spared = number(0.5) * (relaxing - free) * (before.depth - depth);
        let taken = stiffening * (end.energy() - bound.energy()) - spared;
        let taken = taken.keep_where(free.lt(least)).max(R::zero());
        let energy = scale * stiffening * bound.energy().max(R::zero());
        let stored_energy = energy + number(0.4) * scale * number(self.relaxed) * loaded * depth;

        let at_touch = number(-self.attraction) * radius;
        let force = (repulsion + at_touch).keep_where(motion.touching);
        let touching = motion.touching;
        *memory = LeeRadokMemory { relaxing: relaxing.keep_where(touching), depth };
        let jumps = self.attraction > 0.0;
        NormalResponse {
            applied_force: if jumps { events::while_touching(motion, force, at_touch) } else { force },
            friction_reference: repulsion.max(R::zero()).keep_where(touching),
            contact_radius,
            adhesive_potential: at_touch * depth,
            dissipated_plastic: scale * (stiffening * lost + taken),
            ..NormalResponse::elastic(
                motion,
                force,
                stored_energy.keep_where(touching),
                number(2.0 * self.instant) * contact_radius,
            )
        }
    }

    fn branch(&self, _pair: &Pair<f64>, overlap: f64, _memory: &LeeRadokMemory<f64>) -> (u8, &'static str) {
        if overlap <= 0.0 { (0, "open") } else { (1, "visco-elastic") }
    }

    fn max_stiffness(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        2.0 * self.instant * self.expected_contact_radius(pair, expected)
    }

    const STIFFNESS_IS_BOUNDED: bool = false;

    /// That at the overlap of the relaxed material, pulled by its adhesion.
    fn expected_contact_radius(&self, pair: &Pair<f64>, expected: &ExpectedLoading) -> f64 {
        let radius = effective_radius(pair);
        let pulled = ExpectedLoading { force: expected.force + self.attraction * radius, ..*expected };
        (radius * expected_overlap(self.relaxed, pair, &pulled)).sqrt()
    }
}
