//! Tangential force of adhesive elastic spheres, whose contact area peels as it is sheared.

use pulvis_math::{Mask, Real};

use super::force_memory::{SeriesSlider, Spring, quotient};
use super::parameters::{EFFECTIVE_SHEAR_MODULUS, GAMMA_T, MU};
use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{InvalidParameter, LawEntry, Role, Values};
use crate::functions::cbrt_near_one;
use crate::memory::Memory;
use crate::normal::EFFECTIVE_MODULUS;

/// A tangential force T peels the neck of the law of JKR, until at T_c the peeling is complete and the contact slides.
///
/// ```text
/// dT    = 8 G* a_T ds
/// a_T³  = (3 R/(4 E*)) (P + 2 F_c + √(4 P F_c + 4 F_c² − T² E*/(4 G*)))
/// T_c   = 4 √((P F_c + F_c²) G*/E*)                         where the root vanishes
/// T    ≤ max(T_c, μ (P + 2 F_c)) before peeling is complete,  μ (P + 2 F_c) afterwards
/// ```
///
/// P is the normal force, F_c the pull-off force of the neck that the normal law knows (`jkr`, `viscoelastic-jkr`,
/// `thornton-ning`). Laws without a neck (`hertz`, `dmt`) have nothing to peel: with them this is `mindlin`, whose limit is μ
/// times what the normal law names, F + 2 π Γ R of `dmt`.
/// While P is constant the force is elastic, with the energy E(T) = ∫ T dT/(8 G* a_T) in closed form. When P falls, E
/// of a given force grows. As in `mindlin` the memory is T and an energy U ≥ E(T), and T falls as far as U demands.
///
/// Completely peeled, a contact stays so until it opens, as concerns its limit; a_T follows T always.
///
/// # Source
/// C. Thornton, K. K. Yin, Powder Technol. 65, 153 (1991), which extends A. R. Savkoor, G. A. D. Briggs, Proc. R. Soc.
/// Lond. A 356, 103 (1977). Taken from a review; the energy and its memory are derived.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThorntonYin {
    /// Effective shear modulus G* [Pa].
    pub effective_shear_modulus: f64,
    /// Effective modulus E* [Pa].
    pub effective_modulus: f64,
    /// Dashpot coefficient γ_t [kg/s].
    pub dashpot: f64,
    /// Coefficient of friction μ [1].
    pub coefficient: f64,
}

static ENTRY: LawEntry = LawEntry {
    role: Role::Sliding,
    name: "thornton-yin",
    summary: "tangential stiffness of an adhesive contact that peels as it is sheared, with a Coulomb limit",
    equations: "\
dT   = 8 G* a_T ds                  T: tangential force, s: displacement
a_T³ = (3 R/(4 E*)) (P + 2 F_c + √(4 P F_c + 4 F_c² − T² E*/(4 G*)))
T_c  = 4 √((P F_c + F_c²) G*/E*)    where peeling is complete
T    ≤ max(T_c, μ (P + 2 F_c))      before that;  T ≤ μ (P + 2 F_c) afterwards",
    source: "Thornton & Yin, Powder Technol. 65, 153 (1991); the original was not at hand, and that peeling does not heal before the contact opens is our choice (certainty B)",
    parameters: &[EFFECTIVE_SHEAR_MODULUS, EFFECTIVE_MODULUS, MU, GAMMA_T],
    particle_quantities: &[],
    memory: &[
        "tangential_force_x [N]",
        "tangential_force_y [N]",
        "tangential_force_z [N]",
        "tangential_energy [J]",
        "peeled [1]",
    ],
    closed_form: "force at the end of peeling, radius of the sheared area and displacement of a force in pulvis_contact::theory::JkrPair; closed cycles cost work",
    example: "law = \"thornton-yin\"\neffective_shear_modulus = \"3e7 Pa\"\neffective_modulus = \"1e8 Pa\"\nmu = 0.5",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Sliding).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<ThorntonYin, InvalidParameter> {
    Ok(ThorntonYin {
        effective_shear_modulus: values.number("effective_shear_modulus")?,
        effective_modulus: values.number("effective_modulus")?,
        dashpot: values.number("gamma_t")?,
        coefficient: values.number("mu")?,
    })
}

/// What a contact remembers beside the force.
#[derive(Clone, Copy, Debug, Default)]
pub struct PeelMemory<R> {
    /// The energy that holds the force [J].
    pub energy: R,
    /// One where the neck has been peeled completely.
    pub peeled: R,
}

impl<R: Real> Memory<R> for PeelMemory<R> {
    const COLUMNS: usize = 2;
    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        Self { energy: column(0), peeled: column(1) }
    }
    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        column(0, self.energy);
        column(1, self.peeled);
    }
}

/// A neck under a normal force P, with the abbreviations B = 4 F_c (P + F_c) and u = T² E*/(4 G*).
#[derive(Clone, Copy, Debug)]
struct Neck<R> {
    /// 8 G* a without shear [N/m].
    unsheared: R,
    /// P + 2 F_c [N].
    load: R,
    /// B [N²], its root, and P + 2 F_c + √B [N].
    square: R,
    root: R,
    sum: R,
    /// E*/(4 G*).
    ratio: R,
    /// 8 G* a_T in the middle of the step [N/m].
    stiffness: R,
}

impl<R: Real> Neck<R> {
    /// a_T/a, and √(B − u).
    #[inline(always)]
    fn sheared(&self, u: R) -> (R, R) {
        let root = (self.square - u).max(R::zero()).sqrt();
        let loaded = self.sum.gt(R::zero());
        let cube = R::select(loaded, quotient(self.load + root, self.sum), R::one());
        (cbrt_near_one(cube), root)
    }

    /// The neck with its stiffness in the middle of a step from the force T to T + 8 G* a_T D.
    #[inline(always)]
    fn in_step<T: Tangent<R>>(mut self, force: T, displacement: T) -> Self {
        self.stiffness = self.unsheared;
        if self.square.gt(R::zero()).any() {
            let (first, _) = self.sheared(self.ratio * force.norm_squared());
            let half = displacement.scaled(R::splat(0.5) * self.unsheared * first);
            let (middle, _) = self.sheared(self.ratio * (force + half).norm_squared());
            self.stiffness = self.unsheared * middle;
        }
        self
    }
}

impl<R: Real> Spring<R> for Neck<R> {
    #[inline(always)]
    fn is_curved(&self) -> Option<R::Mask> {
        Some(self.square.gt(R::zero()))
    }

    #[inline(always)]
    fn stiffness(&self) -> R {
        self.stiffness
    }

    /// E(T) = φ T²/(8 G* a) with r = a_T/a and
    ///
    /// ```text
    /// φ = (A + √B) [(3/5) (1 + r + r² + r³ + r⁴) − (3/2) A/(A + √B) (1 + r)]/((√B + √(B − u)) (1 + r + r²)),  A = P + 2 F_c
    /// ```
    ///
    /// from 1/2 to 1/(2 r); beyond T_c the area stays as it is.
    #[inline(always)]
    fn secant(&self, square: R) -> R {
        let number = R::splat;
        let u = self.ratio * square;
        let peels = u.gt(R::zero()) & self.square.gt(R::zero());
        if !peels.any() {
            return self.unsheared;
        }
        let (r, root) = self.sheared(u);
        let most = number(0.5) / r;
        let fifth = R::one() + r * (R::one() + r * (R::one() + r * (R::one() + r)));
        let third = R::one() + r * (R::one() + r);
        let bracket = number(0.6) * (self.sum * fifth) - number(1.5) * (self.load * (R::one() + r));
        // Round-off of a bracket that cancels, where adhesion is weak, shall not leave the bounds.
        let phi = quotient(bracket, (self.root + root) * third).max(number(0.5)).min(most);
        let peeled = u.min(self.square);
        let twice_energy = number(2.0) * (peeled * phi + (u - peeled) * most);
        R::select(peels, self.unsheared * quotient(u, twice_energy), self.unsheared)
    }
}

impl FrictionLaw for ThorntonYin {
    const ONLY: Option<Role> = Some(Role::Sliding);

    type Scalars<R: Real> = PeelMemory<R>;

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut PeelMemory<R>,
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let (load, pull_off) = (motion.friction_reference, motion.pull_off_force);
        let unsheared = R::splat(8.0 * self.effective_shear_modulus) * motion.contact_radius;
        let square = R::splat(4.0) * pull_off * (load - pull_off).max(R::zero());
        let root = square.sqrt();
        let ratio = self.effective_modulus / (4.0 * self.effective_shear_modulus);
        let (sum, ratio_lanes) = (load + root, R::splat(ratio));
        let neck = Neck { unsheared, load, square, root, sum, ratio: ratio_lanes, stiffness: unsheared };
        let limit = R::splat(self.coefficient) * load;
        let peeled = scalars.peeled.gt(R::zero());
        let peeling_force = root * R::splat((1.0 / ratio).sqrt());
        let slider = SeriesSlider {
            spring: neck.in_step(*vector, motion.displacement),
            dashpot: (self.dashpot != 0.0).then_some(R::splat(self.dashpot)),
            static_limit: R::select(peeled, limit, limit.max(peeling_force)),
            limit,
            forgets_energy: false,
        };
        let (answer, slips) = slider.respond(motion, vector, &mut scalars.energy);
        let u = ratio_lanes * vector.norm_squared();
        let completes = slips | (u.gt(R::zero()) & u.ge(square));
        scalars.peeled = R::select(completes, R::one(), scalars.peeled).keep_where(motion.in_contact);
        (answer, slips)
    }

    #[inline(always)]
    fn elastic_force<R: Real, T: Tangent<R>>(&self, force: T) -> T {
        force
    }

    /// Nothing: the energy is kept beside the force.
    #[inline(always)]
    fn lost_by_shortening<R: Real>(&self, _before: R, _after: R) -> R {
        R::zero()
    }

    fn dashpot(&self) -> f64 {
        self.dashpot
    }

    fn max_stiffness(&self, scale: &ContactScale) -> f64 {
        8.0 * self.effective_shear_modulus * scale.contact_radius
    }

    const NEEDS_CONTACT_RADIUS: bool = true;
}
