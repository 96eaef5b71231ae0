//! The relative motion of two bodies along the line of their centres.

use pulvis_contact::{
    ContactKinematics, ContactLaws, ContactMemory, ContactResponse, Memory, NormalLaw, Pair, resistance,
};
use pulvis_math::Vector3;

use super::extrapolation::State;

/// Overlap δ [m], closing rate u = dδ/dt [m/s] and work done by the dashpots [J].
pub(super) type Motion = State<3>;

/// Whether the bodies overlap. Force laws may jump where this changes, so that a step never does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// δ <= 0.
    Apart,
    /// δ > 0.
    Contact,
}

/// m_r d²δ/dt² = −f for one contact.
pub(super) struct Dynamics<'c, N> {
    pub law: N,
    pub laws: &'c ContactLaws,
    pub pair: Pair,
}

/// The branches of the normal law and of the attraction at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Branches {
    numbers: (u8, u8),
    normal: &'static str,
    noncontact: &'static str,
    /// Whether the attraction is at work.
    pub attracted: bool,
}

impl Branches {
    /// The branch that rules: that of the normal law in contact, else that of the attraction.
    pub fn name(&self, phase: Phase) -> &'static str {
        if phase == Phase::Contact { self.normal } else { self.noncontact }
    }
}

impl<N: NormalLaw> Dynamics<'_, N> {
    /// The overlap as the laws shall see it within `phase`, also where a trial strays beyond its end.
    fn within(phase: Phase, overlap: f64) -> f64 {
        match phase {
            Phase::Contact => overlap.max(f64::MIN_POSITIVE),
            Phase::Apart => overlap.min(-f64::MIN_POSITIVE),
        }
    }

    /// Forces and energies; updates the memory.
    pub fn respond(
        &self,
        phase: Phase,
        motion: &Motion,
        memory: &mut ContactMemory<f64, N::Memory<f64>>,
    ) -> ContactResponse<f64> {
        let along = |value: f64| Vector3::new(value, 0.0, 0.0);
        let zero = along(0.0);
        let motion = ContactKinematics {
            normal: along(1.0),
            overlap: Self::within(phase, motion[0]),
            inverse_distance: 0.0,
            radius_i: 0.0,
            radius_j: 0.0,
            velocity: along(-motion[1]),
            velocity_mid: along(-motion[1]),
            angular_velocity_i: zero,
            angular_velocity_j: zero,
            angular_velocity_i_mid: zero,
            angular_velocity_j_mid: zero,
        };
        self.laws.respond::<f64, N, { resistance::NONE }>(&self.law, &self.pair, &motion, 0.0, memory)
    }

    /// Rates of the motion with the memory as it stands: laws remember turning points only, and no
    /// step passes one.
    pub fn rate(&self, phase: Phase, motion: &Motion, memory: &ContactMemory<f64, N::Memory<f64>>) -> Motion {
        let response = self.respond(phase, motion, &mut memory.clone());
        [
            motion[1],
            -response.normal_force * self.pair.inverse_reduced_mass(),
            response.energies.viscous_power,
        ]
    }

    /// The branches at an overlap.
    pub fn branches(
        &self,
        phase: Phase,
        overlap: f64,
        memory: &ContactMemory<f64, N::Memory<f64>>,
    ) -> Branches {
        let overlap = Self::within(phase, overlap);
        let normal = self.law.branch(&self.pair, overlap.max(0.0), &memory.normal);
        let noncontact = self.laws.noncontact.branch(overlap, memory.touched);
        Branches {
            numbers: (normal.0, noncontact.0),
            normal: normal.1,
            noncontact: noncontact.1,
            attracted: noncontact.0 != 0,
        }
    }

    /// The energy that the papers' figures call potential (S1 Fig. 15): the work ½ f δ along branches
    /// that start at the origin (k1 and −kc), what the elastic branch holds on all others [J].
    pub fn branch_potential(
        &self,
        branches: &Branches,
        overlap: f64,
        response: &ContactResponse<f64>,
        memory: &ContactMemory<f64, N::Memory<f64>>,
    ) -> f64 {
        if matches!(branches.normal, "k1" | "kc") && overlap > 0.0 {
            let force = self.law.respond(&self.pair, overlap, &mut memory.normal.clone()).force;
            0.5 * force * overlap
        } else {
            response.energies.elastic_normal
        }
    }

    /// The largest overlap that the law remembers, δ_max; `None` where it remembers none [m].
    pub fn remembered_overlap(&self, memory: &ContactMemory<f64, N::Memory<f64>>) -> Option<f64> {
        let column = N::ENTRY.memory.iter().position(|name| name.starts_with("overlap_max"))?;
        let mut found = None;
        memory.normal.store(|number, value| {
            if number == column {
                found = Some(value);
            }
        });
        found
    }
}
