//! Tangential force that softens as it approaches the Coulomb limit.

use pulvis_math::{Dimension, Mask, Real, elementary};

use super::force_memory::quotient;
use super::parameters::MU;
use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{Choice, InvalidParameter, LawEntry, Parameter, Range, Role, Values};
use crate::functions::cbrt;

/// Incremental slip: the stiffness falls from K₀ to zero as the force comes up to the Coulomb limit.
///
/// ```text
/// passive     dT/ds = K₀ (1 − |T|/(μ N))^g                       while |T| grows,  K₀ while it falls
/// published   dT/ds = K₀ (1 − (T − T*)/(μ N − T*))^g             along the force,  T* = T where the motion turned last
///             dT/ds = K₀ (1 − (T* − T)/(μ N + T*))^g             against it
/// ```
///
/// Both are integrated exactly over a step: with x = 1 − T/(μ N) the path is (x₀^(1−g) − x^(1−g)) μ N/((1 − g) K₀).
///
/// The published rule makes the spring stiff again at every turn of the motion, which small vibrations use to pump
/// energy out of it: loading with tiny reversals costs 0.499 (μ N)²/K₀, unloading returns 0.533. The passive rule stores
/// U = T²/(2 K₀), which the normal force does not change; the work of any step is at least what U grows by.
///
/// # Source
/// O. R. Walton, Mech. Mater. 16, 239 (1993); O. R. Walton, R. L. Braun, J. Rheol. 30, 949 (1986). Taken from a review.
/// The published rule in the plane: displacements across the force see K₀, and T* is a number along the force, whose
/// share of μ N stays when N changes. The passive rule and its integral are derived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Walton {
    /// Stiffness K₀ of the unloaded contact [N/m].
    pub stiffness: f64,
    /// Exponent g [1].
    pub exponent: f64,
    /// Coefficient of friction μ [1].
    pub coefficient: f64,
    /// Where the stiffness starts again.
    pub variant: Variant,
}

/// Where the stiffness starts again from K₀.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// Only while the force falls.
    Passive,
    /// At every turn of the motion.
    Published,
}

static ENTRY: LawEntry = LawEntry {
    role: Role::Sliding,
    name: "walton-1993",
    summary: "tangential force that softens as it comes up to the Coulomb limit",
    equations: "\
passive    dT/ds = K₀ (1 − |T|/(μ N))^g             while |T| grows,  K₀ while it falls
published  dT/ds = K₀ (1 − (T − T*)/(μ N − T*))^g   along T,  T* = T where the motion turned last
           dT/ds = K₀ (1 − (T* − T)/(μ N + T*))^g   against T",
    source: "Walton, Mech. Mater. 16, 239 (1993); the original was not at hand, and the published rule in the plane is our reading of it (certainty B)",
    parameters: &[
        Parameter::number(
            "k_0",
            "K₀",
            Dimension::STIFFNESS,
            Range::Positive,
            "tangential stiffness of the unloaded contact",
        ),
        Parameter::number(
            "exponent",
            "g",
            Dimension::NONE,
            Range::Within(0.0, 1.0),
            "how the stiffness falls with the force",
        )
        .or(1.0 / 3.0),
        MU,
        Parameter::choice(
            "variant",
            "",
            &[
                Choice { name: "passive", meaning: "stiff while the force falls: creates no energy" },
                Choice {
                    name: "published",
                    meaning: "stiff again at every turn of the motion: creates up to 0.034 (μ N)²/K₀ a cycle",
                },
            ],
            "passive",
            "where the stiffness starts again from K₀",
        ),
    ],
    particle_quantities: &[],
    memory: &[
        "tangential_force_x [N]",
        "tangential_force_y [N]",
        "tangential_force_z [N]",
        "turning_force_share [1]",
    ],
    closed_form: "monotone shear, T = μ N (1 − (1 − (1 − g) K₀ s/(μ N))^(1/(1−g))), and closed cycles cost work",
    example: "law = \"walton-1993\"\nk_0 = \"80 N/m\"\nmu = 0.5",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Sliding).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<Walton, InvalidParameter> {
    Ok(Walton {
        stiffness: values.number("k_0")?,
        exponent: values.number("exponent")?,
        coefficient: values.number("mu")?,
        variant: match values.choice("variant")? {
            "published" => Variant::Published,
            _ => Variant::Passive,
        },
    })
}

impl Walton {
    /// By how much a force grows that stands at `held` of the `range` [N] over which its stiffness falls to zero, where a
    /// stiff spring would grow by `trial` [N].
    #[inline(always)]
    fn growth<R: Real>(&self, trial: R, held: R, range: R) -> R {
        let left = (R::one() - quotient(held, range)).max(R::zero());
        if self.exponent == 1.0 / 3.0 {
            // (x₀³ − (x₀² − y/range)^(3/2)) range for x₀ = left^(1/3), without the difference.
            let positive = left.gt(R::zero());
            let root = cbrt(R::select(positive, left, R::one())).keep_where(positive);
            let square = root * root;
            let grown = (R::splat(2.0 / 3.0) * trial).min(range * square);
            let y = quotient(grown, range);
            let rest = (square - y).max(R::zero());
            let three = R::splat(3.0);
            let cubes = three * square * square - three * square * y + y * y;
            return quotient(grown * cubes, left + rest * rest.sqrt()).min(trial);
        }
        R::from_fn(|lane| grown(trial.lane(lane), left.lane(lane), range.lane(lane), self.exponent))
    }

    /// The force after a displacement, by the passive rule.
    #[inline(always)]
    fn passive<R: Real, T: Tangent<R>>(&self, force: T, displacement: T, limit: R) -> T {
        let trial = force + displacement.scaled(R::splat(self.stiffness));
        let (held, size) = (force.norm_squared(), trial.norm_squared());
        let grows = size.gt(held);
        let mut factor = R::one();
        if grows.any() {
            let (held, size) = (held.sqrt(), size.sqrt());
            let growth = self.growth((size - held).max(R::zero()), held, limit);
            factor = R::select(grows, quotient(held + growth, size), factor);
        }
        trial.scaled(factor)
    }

    /// The force after a displacement and the share of the limit at which the motion turned, by the published rule.
    #[inline(always)]
    fn published<R: Real, T: Tangent<R>>(&self, force: T, displacement: T, limit: R, share: R) -> (T, R) {
        let size = force.norm_squared().sqrt();
        let bare = !size.gt(R::zero());
        let along = T::select(bare, displacement, force);
        let direction = along.scaled(quotient(R::one(), along.norm_squared().sqrt()));
        let way = displacement.dot(direction);
        let forward = way.ge(R::zero());
        let turned = (share * limit).keep_where(!bare);
        // A force beyond the last turn, seen in the direction of motion, is a turn of its own.
        let turn = R::select(forward, turned.min(size), turned.max(size));
        let held = (size - turn).abs();
        let range = R::select(forward, limit - turn, limit + turn);
        let stiffness = R::splat(self.stiffness);
        let growth = self.growth(stiffness * way.abs(), held, range);
        let after = R::select(forward, size + growth, size - growth);
        let across = (displacement - direction.scaled(way)).scaled(stiffness);
        let after_force = direction.scaled(after) + across;
        let reversed = after.lt(R::zero());
        let turn = R::select(reversed, -turn, turn);
        (after_force, quotient(turn, limit))
    }

    /// `force`, no longer than `limit` [N].
    #[inline(always)]
    fn clipped<R: Real, T: Tangent<R>>(force: T, limit: R) -> T {
        let square = force.norm_squared();
        let beyond = square.gt(limit * limit);
        let mut share = R::one();
        if beyond.any() {
            share = R::select(beyond, quotient(limit, square.sqrt()), share);
        }
        force.scaled(share)
    }
}

/// [`Walton::growth`] for any exponent, with `left` = 1 − held/range.
fn grown(trial: f64, left: f64, range: f64, exponent: f64) -> f64 {
    if !range.is_finite() {
        return trial;
    }
    if left <= 0.0 || range <= 0.0 {
        return 0.0;
    }
    let fallen = if exponent < 1.0 {
        let rest = 1.0 - exponent;
        let gone = rest * trial / range / elementary::powf(left, rest);
        if gone < 1.0 { -elementary::exp_m1(elementary::ln_1p(-gone) / rest) } else { 1.0 }
    } else {
        -elementary::exp_m1(-trial / range)
    };
    (range * left * fallen).min(trial)
}

impl FrictionLaw for Walton {
    const ONLY: Option<Role> = Some(Role::Sliding);

    /// The share of the limit at which the motion turned last, along the force; zero for the passive rule.
    type Scalars<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut [R; 1],
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let limit = (R::splat(self.coefficient) * motion.friction_reference).keep_where(motion.in_contact);
        let before = *vector;
        let carried = Self::clipped(before, limit);
        let after = match self.variant {
            Variant::Passive => self.passive(carried, motion.displacement, limit),
            Variant::Published => {
                let (after, share) = self.published(carried, motion.displacement, limit, scalars[0]);
                scalars[0] = share;
                Self::clipped(after, limit)
            }
        };
        let flexibility = R::splat(0.5 / self.stiffness);
        let square = before.norm_squared();
        let stored_energy = flexibility * after.norm_squared();
        let work = (before + after).scaled(R::splat(0.5)).dot(motion.displacement);
        let dissipated_slip = work + flexibility * square - stored_energy;
        *vector = after;
        let opens = !motion.in_contact & square.gt(R::zero());
        let viscous_power = R::zero();
        (FrictionResponse { force: T::zero() - after, stored_energy, dissipated_slip, viscous_power }, opens)
    }

    #[inline(always)]
    fn elastic_force<R: Real, T: Tangent<R>>(&self, force: T) -> T {
        force
    }

    #[inline(always)]
    fn lost_by_shortening<R: Real>(&self, before: R, after: R) -> R {
        R::splat(0.5 / self.stiffness) * (before - after)
    }

    fn dashpot(&self) -> f64 {
        0.0
    }

    fn max_stiffness(&self, _scale: &ContactScale) -> f64 {
        self.stiffness
    }
}
