//! The tangential law of Mindlin for elastic spheres, with a memory that creates no energy.

use pulvis_math::Real;

use super::force_memory::{Linear, SeriesSlider};
use super::parameters::{EFFECTIVE_SHEAR_MODULUS, GAMMA_T, MU};
use super::{ContactScale, FrictionLaw, FrictionResponse, SpringMotion, Tangent};
use crate::catalogue::{Choice, InvalidParameter, LawEntry, Parameter, Role, Values};

/// Tangential stiffness k = 8 G* a that follows the radius a of the contact area, with a Coulomb limit.
///
/// The memory is the tangential force T and the energy U that belongs to it, U ≥ T²/(2 k). At a fixed area shear
/// stores exactly what it is given, dU = T ds; a growing area changes neither T nor U; a shrinking one takes as much of
/// T as U can no longer hold, |T| ≤ 2 k U/|T|, the micro-slip of a receding edge. Nothing of this creates energy, for
/// steps of any size. The usual rules do: to keep the displacement, or the force without rescaling it, gives energy
/// back that nobody put in. To rescale the force with every fall of a (`rescale = "unloading"`) is passive but forgets
/// T by vibrations of the area, so that a shaken pile creeps.
///
/// Valid for δ ≪ R and without the partial slip of Mindlin's full solution.
///
/// # Source
/// R. D. Mindlin, J. Appl. Mech. 16, 259 (1949); K. L. Johnson, *Contact Mechanics* (1985), eq. (7.44). The memory of
/// force and energy is derived, with its proof, in decision 16.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mindlin {
    /// Effective shear modulus G* [Pa].
    pub effective_shear_modulus: f64,
    /// Dashpot coefficient γ_t [kg/s].
    pub dashpot: f64,
    /// Coefficient of friction μ [1].
    pub coefficient: f64,
    /// What becomes of the force when the area shrinks.
    pub rescale: Rescale,
}

/// What becomes of the tangential force when the contact area shrinks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rescale {
    /// It falls as far as the stored energy demands.
    Energy,
    /// It falls with the radius of the area, T a/a_old.
    Unloading,
}

static ENTRY: LawEntry = LawEntry {
    role: Role::Sliding,
    name: "mindlin",
    summary: "tangential stiffness that follows the contact area, with a Coulomb limit",
    equations: "\
dT  = 8 G* a ds                  tangential force T of the displacement s
|T| ≤ 2 k U/|T|,  k = 8 G* a     when the area shrinks; U: stored energy
|f| ≤ μ N                        N: F of `hertz`, F + 2 F_c of `jkr`",
    source: "Mindlin, J. Appl. Mech. 16, 259 (1949); Johnson, Contact Mechanics (1985), eq. 7.44",
    parameters: &[
        EFFECTIVE_SHEAR_MODULUS,
        MU,
        GAMMA_T,
        Parameter::choice(
            "rescale",
            "",
            &[
                Choice {
                    name: "energy",
                    meaning: "T falls as far as its stored energy demands: passive, no ratcheting",
                },
                Choice {
                    name: "unloading",
                    meaning: "T falls with a: passive, but vibrations make it creep",
                },
            ],
            "energy",
            "what becomes of the tangential force T when the contact area shrinks",
        ),
    ],
    particle_quantities: &[],
    memory: &[
        "tangential_force_x [N]",
        "tangential_force_y [N]",
        "tangential_force_z [N]",
        "tangential_energy [J]",
    ],
    closed_form: "frequency of a sticking contact at constant overlap, √(8 G* a (1/m_r + a_i²/I_i + a_j²/I_j)); closed cycles cost work",
    example: "law = \"mindlin\"\neffective_shear_modulus = \"3e7 Pa\"\nmu = 0.5",
};

/// The description of the law in `role`, if it can play it.
pub(super) fn entry(role: Role) -> Option<&'static LawEntry> {
    (role == Role::Sliding).then_some(&ENTRY)
}

pub(super) fn build(_role: Role, values: &Values) -> Result<Mindlin, InvalidParameter> {
    Ok(Mindlin {
        effective_shear_modulus: values.number("effective_shear_modulus")?,
        dashpot: values.number("gamma_t")?,
        coefficient: values.number("mu")?,
        rescale: match values.choice("rescale")? {
            "unloading" => Rescale::Unloading,
            _ => Rescale::Energy,
        },
    })
}

impl FrictionLaw for Mindlin {
    const ONLY: Option<Role> = Some(Role::Sliding);

    /// The energy that the tangential force stores [J].
    type Scalars<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real, T: Tangent<R>>(
        &self,
        motion: &SpringMotion<T, R>,
        vector: &mut T,
        scalars: &mut [R; 1],
    ) -> (FrictionResponse<T, R>, R::Mask) {
        let stiffness = R::splat(8.0 * self.effective_shear_modulus) * motion.contact_radius;
        let limit = R::splat(self.coefficient) * motion.friction_reference;
        let slider = SeriesSlider {
            spring: Linear(stiffness),
            dashpot: (self.dashpot != 0.0).then_some(R::splat(self.dashpot)),
            static_limit: limit,
            limit,
            forgets_energy: self.rescale == Rescale::Unloading,
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

    fn dashpot(&self) -> f64 {
        self.dashpot
    }

    fn max_stiffness(&self, scale: &ContactScale) -> f64 {
        8.0 * self.effective_shear_modulus * scale.contact_radius
    }

    const NEEDS_CONTACT_RADIUS: bool = true;
}
