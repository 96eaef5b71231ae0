//! What is observed of a sample or of a part of it: stress, fabric, coordination, contact forces.

mod tensor;

pub(crate) use tensor::add_product;
pub use tensor::{Tensor, deviator, eigenvalues, pressure};

use pulvis_boundary::Region;
use pulvis_math::Vector3;

/// A particle with fewer contacts than this carries no load if there is no friction: it is a rattler, as are particles that
/// have fewer once all rattlers are taken away (Göncü, Durán, Luding, C. R. Mécanique 338, 570 (2010), sec. 2.3). With
/// friction two contacts can hold a particle.
pub const LEAST_CONTACTS: u32 = 4;

/// What is observed beside particles and their motion, and in how many regions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObservationPlan {
    /// The regions; `None` is everything.
    pub regions: Vec<Option<Region>>,
    /// Whether contacts are looked at: stress of contacts, fabric, coordination, forces.
    pub contacts: bool,
    /// Whether rattlers are found; needs contacts.
    pub rattlers: bool,
    /// With how many contacts a particle is no rattler, for each region; [`LEAST_CONTACTS`] where nothing stands.
    pub least_contacts: Vec<u32>,
}

impl ObservationPlan {
    /// The largest number of regions.
    pub const MOST_REGIONS: usize = u64::BITS as usize;

    /// All that can be observed of the whole sample.
    pub fn whole() -> Self {
        Self { regions: vec![None], contacts: true, rattlers: true, least_contacts: Vec::new() }
    }
}

/// Sums over the particles and contacts of a region at an instant.
///
/// A particle belongs to a region if its centre lies in it. A contact belongs to it with the share of its branch vector
/// that lies in it, so that regions that fill space share out all contacts, and the stress is that of coarse graining with
/// the region as window (Goldhirsch, Granular Matter 12, 239 (2010), eq. 21). Bodies touch where their overlap is positive.
/// Walls are partners as particles are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Observation {
    /// Number of particles N.
    pub particles: f64,
    /// Their volume Σ V_i [m³].
    pub solid_volume: f64,
    /// Their mass [kg].
    pub mass: f64,
    /// Their momentum [kg m/s].
    pub momentum: Vector3,
    /// Σ m v' ⊗ v' for velocities v' relative to the flow of a cell that deforms [J].
    pub kinetic: Tensor,
    /// Number of touching contacts N_c, each with its share.
    pub contacts: f64,
    /// Σ_i n_i, the touching contacts of each particle of the region.
    pub contact_ends: f64,
    /// Particles that carry no load, see [`ObservationPlan::least_contacts`]; NaN if not looked for.
    pub rattlers: f64,
    /// Σ_i n_i over the particles that are no rattlers, contacts with rattlers left out; NaN if not looked for.
    pub corrected_ends: f64,
    /// Σ f ⊗ b over all contacts that act: force on the first body, branch from the second centre to the first, of a wall
    /// from the contact point [J].
    pub virial: Tensor,
    /// Σ n ⊗ n over touching contacts.
    pub fabric_sum: Tensor,
    /// Σ_p V_p Σ_c n ⊗ n over the touching contacts of each particle of the region [m³].
    pub volume_fabric_sum: Tensor,
    /// Sum of the normal forces of touching contacts, repulsion positive [N].
    pub normal_force_sum: f64,
    /// Sum of overlap times normal force of touching contacts [J].
    pub overlap_force_sum: f64,
    /// The largest normal force; zero without a repulsive contact [N].
    pub normal_force_max: f64,
    /// Number of touching contacts that pull, each with its share.
    pub tensile: f64,
    /// Force of the particles on each wall at contact points in the region [N].
    pub wall_forces: Vec<Vector3>,
}

impl Observation {
    /// Stress of the contacts (1/V) Σ f ⊗ b, compression positive [Pa] (Love 1927; Weber 1966), for a `volume` V [m³].
    pub fn contact_stress(&self, volume: f64) -> Tensor {
        tensor::scaled(&self.virial, 1.0 / volume)
    }

    /// Stress of the motion (1/V) Σ m v' ⊗ v' [Pa], for a `volume` V [m³].
    pub fn kinetic_stress(&self, volume: f64) -> Tensor {
        tensor::scaled(&self.kinetic, 1.0 / volume)
    }

    /// The sum of both [Pa].
    pub fn stress(&self, volume: f64) -> Tensor {
        let (contacts, motion) = (self.contact_stress(volume), self.kinetic_stress(volume));
        tensor::from_fn(|row, column| contacts[row][column] + motion[row][column])
    }

    /// Solid fraction φ = Σ V_i/V [1], for a `volume` V [m³].
    pub fn solid_fraction(&self, volume: f64) -> f64 {
        self.solid_volume / volume
    }

    /// Coordination Z = Σ n_i/N [1]: 2 N_c/N where there are no walls.
    pub fn coordination(&self) -> f64 {
        self.contact_ends / self.particles
    }

    /// Corrected coordination Z* [1]: that of the particles that are no rattlers, among themselves and with walls.
    pub fn corrected_coordination(&self) -> f64 {
        self.corrected_ends / (self.particles - self.rattlers)
    }

    /// Fabric F = (1/N_c) Σ n ⊗ n [1], of trace 1 (Satake 1982).
    pub fn fabric(&self) -> Tensor {
        tensor::scaled(&self.fabric_sum, 1.0 / self.contacts)
    }

    /// Fabric F^V = (1/V) Σ_p V_p Σ_c n ⊗ n [1], for a `volume` V [m³]. Its trace is φ Z for equal spheres, g₃ φ Z for
    /// others (Göncü, Durán, Luding 2010, eqs. 4 and 6).
    pub fn volume_fabric(&self, volume: f64) -> Tensor {
        tensor::scaled(&self.volume_fabric_sum, 1.0 / volume)
    }

    /// Mean normal force of touching contacts, repulsion positive [N].
    pub fn normal_force_mean(&self) -> f64 {
        self.normal_force_sum / self.contacts
    }

    /// Granular temperature T = Σ m v'²/(3 N) [J].
    pub fn granular_temperature(&self) -> f64 {
        tensor::trace(&self.kinetic) / (3.0 * self.particles)
    }

    /// Velocity of the centre of mass [m/s].
    pub fn mean_velocity(&self) -> Vector3 {
        self.momentum * (1.0 / self.mass)
    }
}
