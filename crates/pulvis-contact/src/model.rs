//! One contact, composed of its laws.

use std::f64::consts::PI;

use pulvis_math::{Real, Vector3};

use crate::conventions::Conventions;
use crate::energy::ContactEnergies;
use crate::friction::SpringSlider;
use crate::noncontact::{self, NonContact};
use crate::normal::{Memory, Normal, NormalLaw, NormalLawVisitor};
use crate::pair::Pair;
use crate::resistance::{self, Resistance};
use crate::viscosity::{self, Viscosity};

/// Everything of a contact but its normal law: chosen at run time, the same for every contact of a
/// pair of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactLaws {
    /// Attraction at a distance.
    pub noncontact: NonContact,
    /// Dashpot along the line of centres.
    pub viscosity: Viscosity,
    /// Resistance against sliding.
    pub sliding: Option<SpringSlider>,
    /// Resistance against rolling.
    pub rolling: Option<SpringSlider>,
    /// Resistance against torsion.
    pub torsion: Option<SpringSlider>,
    /// Choices in which codes differ.
    pub conventions: Conventions,
}

impl Default for ContactLaws {
    fn default() -> Self {
        Self {
            noncontact: NonContact::None(noncontact::None),
            viscosity: Viscosity::None(viscosity::None),
            sliding: None,
            rolling: None,
            torsion: None,
            conventions: Conventions::default(),
        }
    }
}

/// All laws between two materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactModel {
    /// Force along the line of centres.
    pub normal: Normal,
    /// The rest of the contact.
    pub laws: ContactLaws,
}

/// What a contact remembers, over all its laws.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactMemory<R, M> {
    /// The memory of the normal law.
    pub normal: M,
    /// 1 where the pair has touched since it was last out of reach, otherwise 0.
    pub touched: R,
    /// Sliding spring [m].
    pub sliding: Vector3<R>,
    /// Rolling spring [m].
    pub rolling: Vector3<R>,
    /// Torsion spring along the line of centres [m].
    pub torsion: R,
}

/// How two bodies i and j lie and move. Velocities come twice: at the time of the positions, which
/// dashpots see, and at the middle of the step that led there, which springs follow.
#[derive(Clone, Copy, Debug)]
pub struct ContactKinematics<R> {
    /// Unit vector from j to i; of a wall, the normal that points to the body.
    pub normal: Vector3<R>,
    /// Overlap δ, negative at a distance [m].
    pub overlap: R,
    /// 1/distance of the centres, zero for a plane wall: how fast the normal turns [1/m].
    pub inverse_distance: R,
    /// Radius of i [m].
    pub radius_i: R,
    /// Radius of j, zero for a wall [m].
    pub radius_j: R,
    /// Velocity of i minus velocity of j [m/s].
    pub velocity: Vector3<R>,
    /// The same at mid-step [m/s].
    pub velocity_mid: Vector3<R>,
    /// Angular velocity of i [rad/s].
    pub angular_velocity_i: Vector3<R>,
    /// Angular velocity of j, zero for a wall [rad/s].
    pub angular_velocity_j: Vector3<R>,
    /// Angular velocity of i at mid-step [rad/s].
    pub angular_velocity_i_mid: Vector3<R>,
    /// Angular velocity of j at mid-step [rad/s].
    pub angular_velocity_j_mid: Vector3<R>,
}

/// Forces, torques and energies of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactResponse<R> {
    /// Total force along the normal, repulsion positive [N].
    pub normal_force: R,
    /// Force on i; the force on j is its opposite [N].
    pub force: Vector3<R>,
    /// Torque on i [N m].
    pub torque_i: Vector3<R>,
    /// Torque on j [N m]; that on a wall means nothing.
    pub torque_j: Vector3<R>,
    /// Energies.
    pub energies: ContactEnergies<R>,
}

// Not derived: what is derived is not inlined by force.
impl<R: Real> Default for ContactResponse<R> {
    #[inline(always)]
    fn default() -> Self {
        Self {
            normal_force: R::zero(),
            force: Vector3::zero(),
            torque_i: Vector3::zero(),
            torque_j: Vector3::zero(),
            energies: ContactEnergies::default(),
        }
    }
}

impl ContactModel {
    /// A frictionless contact of one normal law.
    pub fn frictionless(normal: impl Into<Normal>) -> Self {
        Self { normal: normal.into(), laws: ContactLaws::default() }
    }

    /// How far beyond touching the contact acts [m].
    pub fn interaction_range(&self) -> f64 {
        self.laws.noncontact.interaction_range()
    }

    /// Shortest duration [s] of any motion that the contact can make: π over its highest frequency,
    /// over all branches and springs, for bodies with masses [kg] and radii [m] (`None`: a wall).
    ///
    /// Squares of the frequencies: k/m_r along the normal; k_o L² (1/I_i + 1/I_j) of torsion; and the
    /// larger one of the two modes into which sliding, k_t (1/m_r + a_i²/I_i + a_j²/I_j), and rolling,
    /// k_r L² (1/I_i + 1/I_j), combine where a_i/I_i differs from a_j/I_j. Dashpots count with their
    /// rates γ/m_r and so on. Solid spheres, I = 2/5 m a².
    pub fn shortest_contact_time(&self, body_i: (f64, f64), body_j: Option<(f64, f64)>) -> f64 {
        let (mass_i, radius_i) = body_i;
        let pair = match body_j {
            Some((mass_j, radius_j)) => Pair::spheres(mass_i, mass_j, radius_i, radius_j),
            None => Pair::wall(mass_i, radius_i),
        };
        let modes = Modes::new(&pair, body_i, body_j);
        let laws = &self.laws;
        let (max_stiffness, own_dashpot) = self.normal.accept(Steepest(pair));
        let stiffness = |slider: Option<SpringSlider>| slider.map_or(0.0, |slider| slider.stiffness);
        let dashpot = |slider: Option<SpringSlider>| slider.map_or(0.0, |slider| slider.dashpot);
        let squares = (max_stiffness.max(laws.noncontact.max_stiffness()) * pair.inverse_reduced_mass())
            .max(modes.highest(stiffness(laws.sliding), stiffness(laws.rolling)))
            .max(modes.turning * stiffness(laws.torsion));
        let normal_dashpot = own_dashpot + laws.viscosity.largest_coefficient(&pair);
        let rates = (normal_dashpot * pair.inverse_reduced_mass())
            .max(modes.highest(dashpot(laws.sliding), dashpot(laws.rolling)))
            .max(modes.turning * dashpot(laws.torsion));
        PI / squares.sqrt().max(rates)
    }
}

/// Inverse inertias [1/kg] against which the springs of a contact work.
struct Modes {
    /// 1/m_r + a_i²/I_i + a_j²/I_j, of sliding.
    sliding: f64,
    /// L² (1/I_i + 1/I_j), of rolling and torsion.
    turning: f64,
    /// L (a_i/I_i − a_j/I_j): a sliding force rolls the contact unless the bodies are alike.
    coupling: f64,
}

impl Modes {
    fn new(pair: &Pair, body_i: (f64, f64), body_j: Option<(f64, f64)>) -> Self {
        // A wall has a_j = 0 and 1/I_j = 0.
        let inverse_inertia = |(mass, radius): (f64, f64)| 1.0 / (0.4 * mass * radius * radius);
        let (radius_i, turn_i) = (body_i.1, inverse_inertia(body_i));
        let (radius_j, turn_j) = body_j.map_or((0.0, 0.0), |body| (body.1, inverse_inertia(body)));
        let lever = pair.harmonic_radius();
        Self {
            sliding: pair.inverse_reduced_mass()
                + radius_i * radius_i * turn_i
                + radius_j * radius_j * turn_j,
            turning: lever * lever * (turn_i + turn_j),
            coupling: lever * (radius_i * turn_i - radius_j * turn_j),
        }
    }

    /// The larger eigenvalue of the coupled motion for the coefficients of sliding and rolling.
    fn highest(&self, sliding: f64, rolling: f64) -> f64 {
        let (first, second) = (sliding * self.sliding, rolling * self.turning);
        let coupling = sliding * rolling * self.coupling * self.coupling;
        0.5 * (first + second + ((first - second) * (first - second) + 4.0 * coupling).sqrt())
    }
}

/// The steepest slope [N/m] and the own dashpot [kg/s] of a law.
struct Steepest(Pair);

impl NormalLawVisitor for Steepest {
    type Output = (f64, f64);
    fn visit<N: NormalLaw>(self, law: N) -> (f64, f64) {
        (law.max_stiffness(&self.0), law.dashpot(&self.0))
    }
}

impl ContactLaws {
    /// Whether the contact resists sliding, rolling or torsion.
    pub fn has_friction(&self) -> bool {
        self.sliding.is_some() || self.rolling.is_some() || self.torsion.is_some()
    }

    /// Whether any of the laws against sliding, rolling and torsion has a dashpot.
    pub fn has_resistance_dashpot(&self) -> bool {
        [self.sliding, self.rolling, self.torsion].iter().flatten().any(|slider| slider.dashpot != 0.0)
    }

    /// Whether the normal law or the attraction remembers anything: otherwise their force follows from the overlap, and
    /// they lose nothing.
    #[inline(always)]
    pub fn remembers_normal_motion<N: NormalLaw>(&self) -> bool {
        <N::Memory<f64> as Memory<f64>>::COLUMNS > 0 || self.noncontact.remembers_touch()
    }

    /// The lowest level of [`resistance`] that leaves none of the contact's laws out.
    pub fn resistance_level(&self) -> u8 {
        if self.rolling.is_some() || self.torsion.is_some() {
            resistance::ALL
        } else if self.sliding.is_some() {
            resistance::SLIDING
        } else {
            resistance::NONE
        }
    }

    /// The whole contact with the normal law `law`: updates the memory and answers with forces,
    /// torques and energies. `time_step` [s] is the step that led to `motion`. Of the sliding, rolling
    /// and torsion laws those are left out that the level `RESISTANCE` (see [`resistance`]) does not
    /// hold; their code is not there.
    #[inline(always)]
    pub fn respond<R: Real, N: NormalLaw, const RESISTANCE: u8>(
        &self,
        law: &N,
        pair: &Pair<R>,
        motion: &ContactKinematics<R>,
        time_step: f64,
        memory: &mut ContactMemory<R, N::Memory<R>>,
    ) -> ContactResponse<R> {
        let touching = motion.overlap.gt(R::zero());
        let overlap = motion.overlap.keep_where(touching);
        let elastic = law.respond(pair, overlap, &mut memory.normal);
        let attraction = self.noncontact.respond(motion.overlap, &mut memory.touched);
        let closing_rate = -motion.velocity.dot(motion.normal);
        let mut dashpot = law.dashpot(pair);
        if !matches!(self.viscosity, Viscosity::None(_)) {
            dashpot += self.viscosity.coefficient(pair, overlap, &elastic);
        }
        let viscous = (dashpot * closing_rate).keep_where(touching);
        let mut normal_force = elastic.force + viscous;
        if !matches!(self.noncontact, NonContact::None(_)) {
            normal_force += attraction.force;
        }

        let mut response = ContactResponse {
            normal_force,
            force: motion.normal * normal_force,
            energies: ContactEnergies {
                elastic_normal: elastic.stored_energy,
                adhesive_potential: attraction.potential,
                dissipated_plastic: elastic.dissipated_plastic,
                dissipated_adhesive: elastic.dissipated_adhesive + attraction.dissipated,
                viscous_power: viscous * closing_rate,
                ..ContactEnergies::default()
            },
            ..ContactResponse::default()
        };
        if RESISTANCE >= resistance::SLIDING {
            let reference = self.conventions.friction_reference(
                elastic.friction_reference,
                elastic.force,
                viscous,
                attraction.force,
            );
            let step = Resistance::new(&self.conventions, pair, motion, reference, time_step);
            if let Some(slider) = &self.sliding {
                step.slide(slider, &mut memory.sliding, &mut response);
            }
            if RESISTANCE >= resistance::ALL && (self.rolling.is_some() || self.torsion.is_some()) {
                let levers = step.levers();
                if let Some(slider) = &self.rolling {
                    step.roll(slider, levers, &mut memory.rolling, &mut response);
                }
                if let Some(slider) = &self.torsion {
                    step.twist(slider, levers, &mut memory.torsion, &mut response);
                }
            }
        }
        response
    }
}
