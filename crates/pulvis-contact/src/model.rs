//! One contact, composed of its laws.

use std::f64::consts::PI;

use pulvis_math::{Real, Vector3};

use crate::conventions::{Conventions, LeverArm, RollingLever};
use crate::energy::ContactEnergies;
use crate::friction::{SpringMotion, SpringSlider, carried_along};
use crate::noncontact::{self, NonContact};
use crate::normal::{Memory, Normal, NormalLaw, NormalLawVisitor};
use crate::pair::Pair;
use crate::viscosity::{self, Viscosity};

/// Everything of a contact but its normal law: chosen at run time, the same for every contact of a
/// pair of materials.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
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

impl Default for Composition {
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
    pub composition: Composition,
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
pub struct PairMotion<R> {
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
    /// Spin of i [rad/s].
    pub spin_i: Vector3<R>,
    /// Spin of j, zero for a wall [rad/s].
    pub spin_j: Vector3<R>,
    /// Spin of i at mid-step [rad/s].
    pub spin_i_mid: Vector3<R>,
    /// Spin of j at mid-step [rad/s].
    pub spin_j_mid: Vector3<R>,
}

/// Forces, torques and energies of a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactResponse<R> {
    /// Total force along the normal, repulsion positive [N].
    pub normal_force: R,
    /// Force on i; the force on j is its opposite [N].
    pub force: Vector3<R>,
    /// Torque on i [N m].
    pub torque_i: Vector3<R>,
    /// Torque on j [N m].
    pub torque_j: Vector3<R>,
    /// Energies.
    pub energies: ContactEnergies<R>,
}

impl ContactModel {
    /// A frictionless contact of one normal law.
    pub fn frictionless(normal: impl Into<Normal>) -> Self {
        Self { normal: normal.into(), composition: Composition::default() }
    }

    /// How far beyond touching the contact acts [m].
    pub fn reach(&self) -> f64 {
        self.composition.noncontact.reach()
    }

    /// Shortest duration [s] of any motion that the contact can make: π over its highest frequency,
    /// over all branches and springs, for bodies with masses [kg] and radii [m] (`None`: a wall).
    ///
    /// Frequencies: √(k/m_r) along the normal; √(k_t (1/m_r + a_i²/I_i + a_j²/I_j)) of sliding;
    /// L √(k (1/I_i + 1/I_j)) of rolling and torsion; γ/m_r of the dashpots. Solid spheres,
    /// I = 2/5 m a².
    pub fn shortest_contact_time(&self, body_i: (f64, f64), body_j: Option<(f64, f64)>) -> f64 {
        let (mass_i, radius_i) = body_i;
        let inertia = |(mass, radius): (f64, f64)| 0.4 * mass * radius * radius;
        let pair = match body_j {
            Some((mass_j, radius_j)) => Pair::spheres(mass_i, mass_j, radius_i, radius_j),
            None => Pair::wall(mass_i, radius_i),
        };
        let inverse_inertia = 1.0 / inertia(body_i) + body_j.map_or(0.0, |body| 1.0 / inertia(body));
        let arms = radius_i * radius_i / inertia(body_i)
            + body_j.map_or(0.0, |body| body.1 * body.1 / inertia(body));
        let laws = &self.composition;
        let lever = pair.harmonic_radius;
        let (stiffest, own_dashpot) = self.normal.accept(Steepest(pair));
        let normal = stiffest.max(laws.noncontact.stiffest()) / pair.reduced_mass;
        let tangential = 1.0 / pair.reduced_mass + arms;
        let turning = lever * lever * inverse_inertia;
        let spring = |slider: Option<SpringSlider>, factor: f64| {
            slider.map_or(0.0, |slider| slider.stiffness * factor)
        };
        let damper =
            |slider: Option<SpringSlider>, factor: f64| slider.map_or(0.0, |slider| slider.dashpot * factor);
        let squares = normal
            .max(spring(laws.sliding, tangential))
            .max(spring(laws.rolling, turning))
            .max(spring(laws.torsion, turning));
        let dashpot = own_dashpot + laws.viscosity.largest_coefficient(&pair);
        let rates = (dashpot / pair.reduced_mass)
            .max(damper(laws.sliding, tangential))
            .max(damper(laws.rolling, turning))
            .max(damper(laws.torsion, turning));
        PI / squares.sqrt().max(rates)
    }
}

/// The steepest slope [N/m] and the own dashpot [kg/s] of a law.
struct Steepest(Pair);

impl NormalLawVisitor for Steepest {
    type Output = (f64, f64);
    fn visit<N: NormalLaw>(self, law: N) -> (f64, f64) {
        (law.stiffest(&self.0), law.dashpot(&self.0))
    }
}

impl Composition {
    /// Whether the contact resists sliding, rolling or torsion.
    pub fn has_friction(&self) -> bool {
        self.sliding.is_some() || self.rolling.is_some() || self.torsion.is_some()
    }

    /// The whole contact with the normal law `law`: updates the memory and answers with forces,
    /// torques and energies. `time_step` [s] is the step that led to `motion`. Without `FRICTION`
    /// the sliding, rolling and torsion laws are left out.
    #[inline(always)]
    pub fn respond<R: Real, N: NormalLaw, const FRICTION: bool>(
        &self,
        law: &N,
        pair: &Pair<R>,
        motion: &PairMotion<R>,
        time_step: f64,
        memory: &mut ContactMemory<R, N::Memory<R>>,
    ) -> ContactResponse<R> {
        let touching = motion.overlap.gt(R::zero());
        let overlap = motion.overlap.keep_where(touching);
        let elastic = law.respond(pair, overlap, &mut memory.normal);
        let attraction = self.noncontact.respond(motion.overlap, &mut memory.touched);
        let closing_rate = -motion.velocity.dot(motion.normal);
        let dashpot = law.dashpot(pair) + self.viscosity.coefficient(pair, overlap, &elastic);
        let viscous = (dashpot * closing_rate).keep_where(touching);
        let normal_force = elastic.force + viscous + attraction.force;

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
        if FRICTION {
            let reference = self.conventions.friction_reference(
                elastic.friction_reference,
                elastic.force,
                viscous,
                attraction.force,
            );
            let reference = reference.keep_where(touching);
            self.resist(pair, motion, overlap, reference, time_step, memory, &mut response);
        }
        response
    }

    /// Adds sliding, rolling and torsion. Luding 2008, section 2.3-2.4.
    #[allow(clippy::too_many_arguments)] // one call site; the arguments are what the normal part left
    #[inline(always)]
    fn resist<R: Real, M: Memory<R>>(
        &self,
        pair: &Pair<R>,
        motion: &PairMotion<R>,
        overlap: R,
        friction_reference: R,
        time_step: f64,
        memory: &mut ContactMemory<R, M>,
        response: &mut ContactResponse<R>,
    ) {
        let touching = motion.overlap.gt(R::zero());
        let dt = R::splat(time_step);
        let half_step = R::splat(0.5 * time_step);
        let normal = motion.normal;
        let closing_mid = -motion.velocity_mid.dot(normal);
        let sideways = motion.velocity_mid + normal * closing_mid;
        // A contact that began within the step has moved for a part of the step only.
        let elapsed = (dt * (overlap / overlap.max(closing_mid * dt))).keep_where(touching);
        // Normal and lever arms at mid-step. With those of the end of the step the springs would
        // take in and give back work that no force does, to first order in the step.
        let normal_mid = normal - sideways * (half_step * motion.inverse_distance);
        let sideways_mid = sideways * (R::one() - half_step * motion.inverse_distance * closing_mid);
        let arm = |radius: R, overlap: R| match self.conventions.lever_arm {
            LeverArm::Corrected => radius - (R::splat(0.5) * overlap).keep_where(radius.gt(R::zero())),
            LeverArm::Radius => radius,
        };
        let overlap_mid = overlap - half_step * closing_mid;
        let twist = R::splat(0.5) * (motion.spin_i_mid + motion.spin_j_mid).dot(normal) * elapsed;
        let carried = |spring: Vector3<R>| {
            let turned = spring.dot(motion.velocity_mid) * motion.inverse_distance * elapsed;
            carried_along(self.conventions.spring_rotation, spring, normal, turned, twist)
        };

        if let Some(slider) = &self.sliding {
            let (arm_i, arm_j) = (arm(motion.radius_i, overlap), arm(motion.radius_j, overlap));
            let (mid_i, mid_j) = (arm(motion.radius_i, overlap_mid), arm(motion.radius_j, overlap_mid));
            let spins = motion.spin_i * arm_i + motion.spin_j * arm_j;
            let spins_mid = motion.spin_i_mid * mid_i + motion.spin_j_mid * mid_j;
            let velocity = motion.velocity.tangential_to(normal) + normal.cross(spins);
            let step = (sideways_mid + normal_mid.cross(spins_mid)) * elapsed;
            memory.sliding = carried(memory.sliding);
            let answer = slider.respond(
                &SpringMotion {
                    velocity: velocity.keep_where(touching),
                    displacement: step.tangential_to(normal).keep_where(touching),
                    friction_reference,
                },
                &mut memory.sliding,
            );
            let moment = normal.cross(answer.force);
            response.force += answer.force;
            response.torque_i -= moment * arm_i;
            response.torque_j -= moment * arm_j;
            response.energies.elastic_sliding = answer.stored_energy;
            response.energies.dissipated_sliding = answer.dissipated_slip;
            response.energies.viscous_power += answer.viscous_power;
        }
        if self.rolling.is_none() && self.torsion.is_none() {
            return;
        }
        let lever = self.rolling_lever(pair, arm(motion.radius_i, overlap), arm(motion.radius_j, overlap));
        let spin = motion.spin_i - motion.spin_j;
        let spin_mid = motion.spin_i_mid - motion.spin_j_mid;
        if let Some(slider) = &self.rolling {
            let step = normal_mid.cross(spin_mid) * -(lever * elapsed);
            memory.rolling = carried(memory.rolling);
            let answer = slider.respond(
                &SpringMotion {
                    velocity: (normal.cross(spin) * -lever).keep_where(touching),
                    displacement: step.tangential_to(normal).keep_where(touching),
                    friction_reference,
                },
                &mut memory.rolling,
            );
            let torque = normal.cross(answer.force) * lever;
            response.torque_i += torque;
            response.torque_j -= torque;
            response.energies.elastic_rolling = answer.stored_energy;
            response.energies.dissipated_rolling = answer.dissipated_slip;
            response.energies.viscous_power += answer.viscous_power;
        }
        if let Some(slider) = &self.torsion {
            let answer = slider.respond_along(
                &SpringMotion {
                    velocity: (normal.dot(spin) * lever).keep_where(touching),
                    displacement: (normal_mid.dot(spin_mid) * lever * elapsed).keep_where(touching),
                    friction_reference,
                },
                &mut memory.torsion,
            );
            let torque = normal * (lever * answer.force);
            response.torque_i += torque;
            response.torque_j -= torque;
            response.energies.elastic_torsion = answer.stored_energy;
            response.energies.dissipated_torsion = answer.dissipated_slip;
            response.energies.viscous_power += answer.viscous_power;
        }
    }

    /// The length L of the rolling and torsion velocities [m].
    #[inline(always)]
    fn rolling_lever<R: Real>(&self, pair: &Pair<R>, arm_i: R, arm_j: R) -> R {
        match self.conventions.rolling_lever {
            RollingLever::Harmonic => pair.harmonic_radius,
            RollingLever::Reduced => {
                let at_wall = arm_j.le(R::zero());
                R::select(at_wall, arm_i, arm_i * arm_j / (arm_i + arm_j))
            }
        }
    }
}
