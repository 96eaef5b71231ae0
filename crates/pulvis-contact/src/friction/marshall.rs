//! Torsion of elastic spheres: the resistance of a contact area against twisting.

use pulvis_math::Real;

use super::force_memory::{Linear, SeriesSlider};
use super::parameters::{EFFECTIVE_SHEAR_MODULUS, GAMMA_T, MU};
use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{InvalidParameter, LawEntry, Role, Values};

/// Twisting of the contact area: stiffness, dashpot and limit are those of sliding, summed over the area.
///
/// ```text
/// M = −(k a²/2) φ − (γ_t a²/2) ω,   k = 8 G* a,      |M| ≤ (2/3) a μ N
/// ```
///
/// a is the radius of the contact area, φ the angle of twist, N the normal force to which the Coulomb limit of sliding
/// refers. The limit is that of an area that slides everywhere under a uniform pressure. As a changes, the memory is the
/// moment and the energy that holds it, as in `mindlin`. Dashpot and slider are in series.
///
/// # Source
/// J. S. Marshall, J. Comput. Phys. 228, 1541 (2009), section 2.5. Taken from other codes' documentation; the memory of
/// force and energy is of decision 16.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Marshall {
    /// Effective shear modulus G* [Pa].
    pub effective_shear_modulus: f64,
    /// Dashpot coefficient γ_t of sliding [kg/s].
    pub sliding_dashpot: f64,
    /// Coefficient of sliding friction μ [1].
    pub coefficient: f64,
}

static ENTRY: LawEntry = LawEntry {
    role: Role::Torsion,
    name: "marshall",
    summary: "twisting of the contact area, with the stiffness, dashpot and limit of sliding over it",
    equations: "\
dM  = (k a²/2) dφ,  k = 8 G* a    moment M of the twist φ; a: radius of the contact area
M_v = (γ_t a²/2) dφ/dt            dashpot, in series with the slider
|M| ≤ (2/3) a μ N                 N: F of `hertz`, F + 2 F_c of `jkr`",
    source: "Marshall, J. Comput. Phys. 228, 1541 (2009), section 2.5; the original was not at hand (certainty B)",
    parameters: &[EFFECTIVE_SHEAR_MODULUS, MU, GAMMA_T],
    particle_quantities: &[],
    memory: &["torsion_force [N]", "torsion_energy [J]"],
    closed_form: "frequency of the torsion oscillation, √(4 G* a³ (1/I_i + 1/I_j)), and closed cycles of pressing and twisting cost work",
    example: "law = \"marshall\"\neffective_shear_modulus = \"3e7 Pa\"\nmu = 0.5",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Torsion).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<Marshall, InvalidParameter> {
    Ok(Marshall {
        effective_shear_modulus: values.number("effective_shear_modulus")?,
        sliding_dashpot: values.number("gamma_t")?,
        coefficient: values.number("mu")?,
    })
}

impl FrictionLaw for Marshall {
    const ONLY: Option<Role> = Some(Role::Torsion);

    /// The energy that holds the moment [J].
    type Scalars<R: Real> = [R; 1];

    /// As torsion is described by the path L φ and the force M/L, all of this is over powers of L.
    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut [R; 1],
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let arm = motion.contact_radius / motion.lever;
        let square = arm * arm;
        let stiffness = R::splat(4.0 * self.effective_shear_modulus) * motion.contact_radius * square;
        let limit = R::splat(2.0 / 3.0 * self.coefficient) * arm * motion.friction_reference;
        let slider = SeriesSlider {
            spring: Linear(stiffness),
            dashpot: (self.sliding_dashpot != 0.0).then(|| R::splat(0.5 * self.sliding_dashpot) * square),
            static_limit: limit,
            limit,
            forgets_energy: false,
        };
        slider.respond(motion, vector, &mut scalars[0])
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

    /// No contact area is larger than the effective radius L/2.
    fn dashpot(&self) -> f64 {
        self.sliding_dashpot / 8.0
    }

    fn max_stiffness(&self, scale: &ContactScale) -> f64 {
        let arm = scale.contact_radius / scale.harmonic_radius;
        4.0 * self.effective_shear_modulus * scale.contact_radius * arm * arm
    }

    const NEEDS_CONTACT_RADIUS: bool = true;
}
