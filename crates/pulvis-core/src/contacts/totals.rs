//! Sums over all contacts that the loops make for observation.

use std::ops::AddAssign;

use pulvis_contact::ContactEnergies;
use pulvis_math::{F64Array, Real, Simd8, Vector3, max_or_nan};

use super::block::{ContactGroup, Partner};
use crate::walls::WallForce;

/// Sums over all contacts at the end of the last advance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactTotals {
    /// Touching contacts between particles [1].
    pub pairs: f64,
    /// Touching contacts with walls [1].
    pub at_walls: f64,
    /// The largest overlap; zero without contacts, NaN if any overlap is NaN [m].
    pub overlap_max: f64,
    /// Σ f_k l_m over all contacts, the one with walls among them, for the force f on the first body and the branch l
    /// from the second to the first: over the volume, the stress of the contacts, compression positive (Love-Weber)
    /// [J].
    pub virial: [[f64; 3]; 3],
}

impl AddAssign for ContactTotals {
    fn add_assign(&mut self, other: Self) {
        self.pairs += other.pairs;
        self.at_walls += other.at_walls;
        let larger = other.overlap_max > self.overlap_max || other.overlap_max.is_nan();
        self.overlap_max = if larger { other.overlap_max } else { self.overlap_max };
        for (row, others) in self.virial.iter_mut().zip(other.virial) {
            for (sum, value) in row.iter_mut().zip(others) {
                *sum += value;
            }
        }
    }
}

/// What the contacts of a chunk come to in a pass. Sums over all contacts are taken over chunks, along a
/// [tree](crate::chunk_tree): the same for any number of threads and of ranks.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChunkTotals {
    /// Energies.
    pub(crate) energies: ContactEnergies,
    /// The largest k/m_r of a contact whose law does not bound its stiffness [1/s²].
    pub(crate) rate_squared: f64,
    /// Forces and torques on the particles, wall by wall; empty where none is near.
    pub(crate) wall_forces: Vec<WallForce>,
    /// For observation; of the last pass of an advance.
    pub(crate) observed: ContactTotals,
}

impl ChunkTotals {
    /// Takes in what the last pass has stored in the groups of the chunk; `observes` tells whether it was the last of an
    /// advance.
    pub(super) fn take_in(&mut self, groups: &[ContactGroup], observes: bool) {
        let mut energies = ContactEnergies::<F64Array<8>>::default();
        self.rate_squared = 0.0;
        self.wall_forces.fill(WallForce::default());
        for group in groups {
            energies += group.energies;
            self.rate_squared = max_or_nan(self.rate_squared, group.rate_squared);
            if self.wall_forces.len() < group.wall_forces.len() {
                self.wall_forces.resize(group.wall_forces.len(), WallForce::default());
            }
            for (sum, &force) in self.wall_forces.iter_mut().zip(&group.wall_forces) {
                *sum += force;
            }
        }
        self.energies = energies.sum_lanes();
        if observes {
            self.observe(groups);
        }
    }

    fn observe(&mut self, groups: &[ContactGroup]) {
        self.observed = ContactTotals::default();
        for group in groups {
            let (touching, overlap_max, virial) = group.totals.sums();
            let (pairs, at_walls) = match group.partner {
                Partner::Particle => (touching, 0.0),
                Partner::Wall => (0.0, touching),
            };
            self.observed += ContactTotals { pairs, at_walls, overlap_max, virial };
        }
    }
}

/// The sums over the blocks of a group, lane by lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GroupTotals<R> {
    touching: R,
    overlap_max: R,
    virial: [Vector3<R>; 3],
}

// Not derived: derived implementations cannot be forced inline.
impl<R: Real> Default for GroupTotals<R> {
    #[inline(always)]
    fn default() -> Self {
        Self { touching: R::zero(), overlap_max: R::zero(), virial: [Vector3::zero(); 3] }
    }
}

impl<R: Simd8> GroupTotals<R> {
    /// Adds eight contacts with the forces [N] on their first bodies and the lengths of their branch vectors [m].
    #[inline(always)]
    pub(crate) fn add(&mut self, overlap: R, normal: Vector3<R>, length: R, force: Vector3<R>) {
        let touching = overlap.gt(R::zero());
        self.touching += R::one().keep_where(touching);
        // A NaN is kept: it is not below anything.
        let lower = overlap.le(self.overlap_max);
        self.overlap_max = R::select(lower, self.overlap_max, overlap);
        let branch = normal * length;
        for (row, component) in self.virial.iter_mut().zip([force.x, force.y, force.z]) {
            *row += branch * component;
        }
    }

    /// Lane by lane, in memory.
    #[inline(always)]
    pub(crate) fn to_array(self) -> GroupTotals<F64Array<8>> {
        let [x, y, z] = self.virial;
        let in_memory = |row: Vector3<R>| Vector3::new(row.x.to_array(), row.y.to_array(), row.z.to_array());
        GroupTotals {
            touching: self.touching.to_array(),
            overlap_max: self.overlap_max.to_array(),
            virial: [in_memory(x), in_memory(y), in_memory(z)],
        }
    }
}

impl GroupTotals<F64Array<8>> {
    /// Contacts that touch, the largest overlap [m], and the sums of force times branch [J].
    pub(crate) fn sums(&self) -> (f64, f64, [[f64; 3]; 3]) {
        let larger = |one: f64, other: f64| if other > one || other.is_nan() { other } else { one };
        let overlap_max = self.overlap_max.0.iter().copied().fold(0.0, larger);
        let along = |row: &Vector3<F64Array<8>>| [row.x.sum_lanes(), row.y.sum_lanes(), row.z.sum_lanes()];
        (self.touching.sum_lanes(), overlap_max, [0, 1, 2].map(|row| along(&self.virial[row])))
    }
}
