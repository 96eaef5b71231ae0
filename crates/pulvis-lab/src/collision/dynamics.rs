//! The relative motion of two bodies along the line of their centres.

use pulvis_contact::{ContactKinematics, ContactModel, ContactResponse, MemoryLayout, NormalMotion, Pair};
use pulvis_input::collision::Bodies;
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

/// More columns than any contact has.
const MOST_COLUMNS: usize = 48;

/// What a contact remembers, column by column.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    columns: [f64; MOST_COLUMNS],
    count: usize,
}

impl Record {
    /// The columns.
    pub fn columns(&self) -> &[f64] {
        &self.columns[..self.count]
    }

    fn columns_mut(&mut self) -> &mut [f64] {
        &mut self.columns[..self.count]
    }
}

/// m_r d²δ/dt² = −f for one contact.
pub(super) struct Dynamics {
    /// Laws along the line of centres.
    model: ContactModel,
    layout: MemoryLayout,
    pair: Pair,
    /// Radii of the two bodies, of a wall zero [m].
    radii: [f64; 2],
}

/// The branches of the normal law, of the attraction and of the bond at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Branches {
    numbers: (u8, u8, u8),
    normal: &'static str,
    apart: &'static str,
    /// Whether bodies apart attract each other, or are bonded.
    pub attracted: bool,
}

impl Branches {
    /// The branch that rules: that of the normal law in contact, else that of the attraction.
    pub fn name(&self, phase: Phase) -> &'static str {
        if phase == Phase::Contact { self.normal } else { self.apart }
    }
}

impl Dynamics {
    /// The motion of two bodies, the `pair`, under the laws of `model` along the line of their centres.
    pub fn new(model: &ContactModel, bodies: &Bodies, pair: Pair) -> Self {
        let mut model = *model;
        let radii = bodies.radii();
        (model.laws.sliding, model.laws.rolling, model.laws.torsion) = (None, None, None);
        Self { layout: model.memory_layout(), model, pair, radii }
    }

    /// The record of a contact that never was.
    pub fn fresh(&self) -> Record {
        Record { columns: [0.0; MOST_COLUMNS], count: self.layout.columns() }
    }

    /// The overlap as the laws shall see it within `phase`, also where a trial strays beyond its end.
    fn within(phase: Phase, overlap: f64) -> f64 {
        match phase {
            Phase::Contact => overlap.max(f64::MIN_POSITIVE),
            Phase::Apart => overlap.min(-f64::MIN_POSITIVE),
        }
    }

    /// Forces and energies; updates the memory.
    pub fn respond(&self, phase: Phase, motion: &Motion, memory: &mut Record) -> ContactResponse<f64> {
        let along = |value: f64| Vector3::new(value, 0.0, 0.0);
        let zero = along(0.0);
        let motion = ContactKinematics {
            normal: along(1.0),
            overlap: Self::within(phase, motion[0]),
            inverse_distance: 0.0,
            normal_rate: None,
            radius_i: self.radii[0],
            radius_j: self.radii[1],
            velocity: along(-motion[1]),
            velocity_mid: along(-motion[1]),
            angular_velocity_i: zero,
            angular_velocity_j: zero,
            angular_velocity_i_mid: zero,
            angular_velocity_j_mid: zero,
        };
        self.model.respond(&self.pair, &motion, 0.0, memory.columns_mut())
    }

    /// Rates of the motion with the memory as it stands: laws remember turning points only, and no
    /// step passes one.
    pub fn rate(&self, phase: Phase, motion: &Motion, memory: &Record) -> Motion {
        let response = self.respond(phase, motion, &mut memory.clone());
        [
            motion[1],
            -response.normal_force * self.pair.inverse_reduced_mass(),
            response.energies.viscous_power,
        ]
    }

    /// The branches at an overlap.
    pub fn branches(&self, phase: Phase, overlap: f64, memory: &Record) -> Branches {
        let overlap = Self::within(phase, overlap);
        let columns = memory.columns();
        let normal = self.model.normal.branch(&self.pair, overlap, columns);
        let attraction = &self.model.laws.noncontact;
        let noncontact = attraction.branch(&self.pair, overlap, columns, self.layout.slots().attraction());
        let bond = self.model.laws.bond.as_ref();
        let (bonded, alone) = bond.map_or(((0, ""), false), |bond| {
            let start = self.layout.slots().bond();
            (bond.branch(self.radii, overlap, columns, start), bond.hides_contact())
        });
        let of_bond = (bonded.0 != 0).then_some(bonded.1);
        // Beyond touching the bond or the attraction rules, unless the normal law acts there.
        let apart = if normal.0 != 0 { normal.1 } else { of_bond.unwrap_or(noncontact.1) };
        Branches {
            numbers: (normal.0, noncontact.0, bonded.0),
            apart,
            normal: of_bond.filter(|_| alone).unwrap_or(normal.1),
            attracted: noncontact.0 != 0 || normal.0 != 0 || bonded.0 != 0,
        }
    }

    /// The energy that the papers' figures call potential (S1 Fig. 15): what the normal law says of the branch, or
    /// what its elastic branch stores [J].
    pub fn branch_potential(
        &self,
        branches: &Branches,
        overlap: f64,
        response: &ContactResponse<f64>,
        memory: &Record,
    ) -> f64 {
        let motion = NormalMotion::at_rest(&self.pair, overlap);
        let potential = self.model.normal.branch_potential(branches.numbers.0, &motion, memory.columns());
        potential.unwrap_or(response.energies.elastic_normal)
    }

    /// The largest overlap that the law remembers, δ_max; `None` where it remembers none [m].
    pub fn remembered_overlap(&self, memory: &Record) -> Option<f64> {
        self.model.normal.remembered_overlap(memory.columns())
    }
}
