//! The particles, as columns.

use std::ops::{Index, Range};

use pulvis_math::{Packed4, Vector3, elementary};

use crate::columns::NamedColumn;
use crate::thread_pool::ThreadPool;

/// The id of a particle, as files and interfaces show it. It never changes, whereas rows change when the neighbour search
/// puts them into cell order.
pub type ParticleId = u32;

/// A material's index in the list of materials.
pub type MaterialIndex = u16;

/// Moment of inertia of a solid sphere over m a² [1].
pub(crate) const SOLID_SPHERE: f64 = 0.4;

/// A spherical particle to start with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle {
    /// Index in the list of materials.
    pub material: MaterialIndex,
    /// Radius [m].
    pub radius: f64,
    /// Mass [kg].
    pub mass: f64,
    /// Centre [m].
    pub position: Vector3,
    /// Velocity [m/s].
    pub velocity: Vector3,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector3,
}

/// All particles. Every column has one entry per row; rows are in cell order.
///
/// Loops read packed vectors: a vector and a number that is needed with it, so that one load instruction reads both.
#[derive(Clone, Debug, Default)]
pub struct Particles {
    // Fixed.
    pub(crate) id: Vec<ParticleId>,
    pub(crate) material: Vec<MaterialIndex>,
    pub(crate) radius: Vec<f64>,
    pub(crate) mass: Vec<f64>,
    // Kinematic columns. Between the two kicks of a step, velocity and angular velocity are those at mid-step.
    /// Centre [m] and radius [m].
    pub(crate) position: Vec<Packed4>,
    /// Velocity [m/s] and 1/mass [1/kg]; zero in place of 1/mass where the motion is prescribed, so that kicks do nothing.
    pub(crate) velocity: Vec<Packed4>,
    /// Angular velocity [rad/s] and 1/radius [1/m].
    pub(crate) angular_velocity: Vec<Packed4>,
    // Result of the contact loop: force and torque on every row, followed by the halo sums that are still to be added
    // (see `Chunk`). Between the two kicks of a step, incomplete sums.
    pub(crate) forces_and_torques: Vec<ForceTorque>,
    // Used within a step: velocity and angular velocity at its end if forces stay as they were.
    /// Velocity [m/s] and 1/radius [1/m].
    pub(crate) velocity_predicted: Vec<Packed4>,
    /// Angular velocity [rad/s] and 1/radius [1/m].
    pub(crate) angular_velocity_predicted: Vec<Packed4>,
    /// Forces that a program applies [N], which contacts and background come on top of; empty where there are none. Particles
    /// that are inserted later have zero.
    pub(crate) applied: Vec<Packed4>,
    /// Force of all other charges [N] and the potential energy with them [J], of the last pass in the order of the rows; empty
    /// where charges do not act over all distances.
    pub(crate) electrostatic: Vec<Packed4>,
    /// Quantities that the engine does not use.
    pub(crate) columns: Vec<NamedColumn>,
    /// The id of the next particle: no id is used twice.
    pub(crate) next_id: ParticleId,
    /// Whether the motion of any particle is prescribed.
    pub(crate) any_prescribed: bool,
}

/// Force and torque on a body.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
pub(crate) struct ForceTorque {
    /// Force [N].
    pub(crate) force: Packed4,
    /// Torque [N m].
    pub(crate) torque: Packed4,
}

impl ForceTorque {
    /// Force and torque.
    #[inline(always)]
    pub(crate) fn packed_mut(&mut self) -> &mut [Packed4; 2] {
        // SAFETY: `repr(C)` lays the two packed vectors out as an array of two.
        unsafe { &mut *(&raw mut *self).cast() }
    }
}

/// One vector of every particle.
#[derive(Clone, Copy, Debug)]
pub struct Vectors<'a>(Column<'a>);

#[derive(Clone, Copy, Debug)]
enum Column<'a> {
    Packed4s(&'a [Packed4]),
    Forces(&'a [ForceTorque]),
    Torques(&'a [ForceTorque]),
}

impl<'a> Vectors<'a> {
    /// Number of rows.
    pub fn len(&self) -> usize {
        match self.0 {
            Column::Packed4s(packed) => packed.len(),
            Column::Forces(forces_and_torques) | Column::Torques(forces_and_torques) => {
                forces_and_torques.len()
            }
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Where the vectors stand: the address of the first component of row 0, and the bytes from one row to the next. The
    /// three components of a row stand side by side. For views of other languages, which must not outlive the next change
    /// of the particles.
    pub fn layout(self) -> (*const f64, usize) {
        match self.0 {
            Column::Packed4s(packed) => (packed.as_ptr().cast(), size_of::<Packed4>()),
            Column::Forces(both) => (both.as_ptr().cast(), size_of::<ForceTorque>()),
            Column::Torques(both) => {
                let torque = std::mem::offset_of!(ForceTorque, torque);
                (both.as_ptr().cast::<f64>().wrapping_byte_add(torque), size_of::<ForceTorque>())
            }
        }
    }

    /// All of them, row by row.
    pub fn iter(self) -> impl Iterator<Item = Vector3> + use<'a> {
        (0..self.len()).map(move |row| self[row])
    }
}

impl Index<usize> for Vectors<'_> {
    type Output = Vector3;
    #[inline(always)]
    fn index(&self, row: usize) -> &Vector3 {
        match self.0 {
            Column::Packed4s(packed) => &packed[row].vector,
            Column::Forces(forces_and_torques) => &forces_and_torques[row].force.vector,
            Column::Torques(forces_and_torques) => &forces_and_torques[row].torque.vector,
        }
    }
}

impl Particles {
    /// Particles with ids 0, 1, 2, ... in the given order.
    pub fn new(particles: &[Particle]) -> Self {
        let mut columns = Self::default();
        columns.append(particles);
        columns
    }

    /// Appends particles as new rows. Returns their ids, which continue from the last id used.
    pub(crate) fn append(&mut self, particles: &[Particle]) -> Range<ParticleId> {
        let first = self.next_id;
        self.next_id += particles.len() as ParticleId;
        self.id.extend(first..self.next_id);
        for particle in particles {
            let (inverse_radius, velocity) = (1.0 / particle.radius, particle.velocity);
            let turning = Packed4::new(particle.angular_velocity, inverse_radius);
            self.material.push(particle.material);
            self.radius.push(particle.radius);
            self.mass.push(particle.mass);
            self.position.push(Packed4::new(particle.position, particle.radius));
            self.velocity.push(Packed4::new(velocity, 1.0 / particle.mass));
            self.angular_velocity.push(turning);
            self.velocity_predicted.push(Packed4::new(velocity, inverse_radius));
            self.angular_velocity_predicted.push(turning);
        }
        self.forces_and_torques.resize(self.len(), ForceTorque::default());
        if !self.applied.is_empty() {
            self.applied.resize(self.len(), Packed4::default());
        }
        first..self.next_id
    }

    /// Keeps the first `rows` only.
    pub(crate) fn truncate(&mut self, rows: usize) {
        let order: Vec<u32> = (0..rows as u32).collect();
        self.reorder(&order, &ThreadPool::default());
        self.forces_and_torques.truncate(rows);
    }

    /// Number of particles.
    pub fn len(&self) -> usize {
        self.id.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.id.is_empty()
    }

    /// Ids, one a row.
    pub fn ids(&self) -> &[ParticleId] {
        &self.id
    }

    /// Materials, one a row.
    pub fn materials(&self) -> &[MaterialIndex] {
        &self.material
    }

    /// Radii [m].
    pub fn radii(&self) -> &[f64] {
        &self.radius
    }

    /// Masses [kg].
    pub fn masses(&self) -> &[f64] {
        &self.mass
    }

    /// Centres [m].
    pub fn positions(&self) -> Vectors<'_> {
        Vectors(Column::Packed4s(&self.position))
    }

    /// Velocities [m/s].
    pub fn velocities(&self) -> Vectors<'_> {
        Vectors(Column::Packed4s(&self.velocity))
    }

    /// Angular velocities [rad/s].
    pub fn angular_velocities(&self) -> Vectors<'_> {
        Vectors(Column::Packed4s(&self.angular_velocity))
    }

    /// Total forces [N].
    pub fn forces(&self) -> Vectors<'_> {
        Vectors(Column::Forces(&self.forces_and_torques[..self.len()]))
    }

    /// Total torques [N m].
    pub fn torques(&self) -> Vectors<'_> {
        Vectors(Column::Torques(&self.forces_and_torques[..self.len()]))
    }

    /// Forces that a program [applies](crate::Simulation::set_applied_forces) [N]; `None` where it applies none.
    pub fn applied_forces(&self) -> Option<Vectors<'_>> {
        (!self.applied.is_empty()).then(|| Vectors(Column::Packed4s(&self.applied)))
    }

    /// Further quantities by name; their values are one a row.
    pub fn columns(&self) -> &[NamedColumn] {
        &self.columns
    }

    /// The quantity of this name, if there is one; its values are one a row.
    pub fn column(&self, name: &str) -> Option<&NamedColumn> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// The rows in the order of their ids: what files and interfaces should iterate over.
    pub fn rows_by_id(&self) -> Vec<usize> {
        let count = self.len();
        // Few ids have been given up: each has a place of its own.
        if (self.next_id as usize) < 4 * count {
            let mut places = vec![usize::MAX; self.next_id as usize];
            for (row, &id) in self.id.iter().enumerate() {
                places[id as usize] = row;
            }
            places.retain(|&row| row != usize::MAX);
            return places;
        }
        let mut rows: Vec<usize> = (0..count).collect();
        rows.sort_unstable_by_key(|&row| self.id[row]);
        rows
    }

    /// Moment of inertia [kg m²].
    #[inline(always)]
    pub(crate) fn inertia(&self, row: usize) -> f64 {
        SOLID_SPHERE * self.mass[row] * self.radius[row] * self.radius[row]
    }

    /// Whether the motion of a particle is prescribed: forces do not move it.
    #[inline(always)]
    pub fn is_prescribed(&self, row: usize) -> bool {
        self.velocity[row].scalar == 0.0
    }

    /// Prescribes the motion of a particle, or leaves it to the forces again.
    pub(crate) fn prescribe(&mut self, row: usize, prescribed: bool) {
        self.velocity[row].scalar = if prescribed { 0.0 } else { 1.0 / self.mass[row] };
    }

    /// Puts the rows into a new order: row k becomes what was row `order[k]`; rows that are not in `order` are removed.
    /// Forces and torques are not moved: they are computed again after every change of order.
    pub(crate) fn reorder(&mut self, order: &[u32], pool: &ThreadPool) {
        pool.reorder(&mut self.id, order, &mut Vec::new());
        pool.reorder(&mut self.material, order, &mut Vec::new());
        let mut numbers = Vec::new();
        pool.reorder(&mut self.radius, order, &mut numbers);
        pool.reorder(&mut self.mass, order, &mut numbers);
        for column in &mut self.columns {
            pool.reorder(&mut column.values, order, &mut numbers);
        }
        let mut packed = Vec::new();
        for column in [
            &mut self.position,
            &mut self.velocity,
            &mut self.angular_velocity,
            &mut self.velocity_predicted,
            &mut self.angular_velocity_predicted,
        ] {
            pool.reorder(column, order, &mut packed);
        }
        if !self.applied.is_empty() {
            pool.reorder(&mut self.applied, order, &mut packed);
        }
    }

    /// Memory of a particle's row in all columns but the forces and torques [byte].
    pub(crate) const BYTES: usize = 5 * size_of::<Packed4>()
        + 2 * size_of::<f64>()
        + size_of::<ParticleId>()
        + size_of::<MaterialIndex>();

    /// Sum of all momenta [kg m/s].
    pub fn momentum(&self) -> Vector3 {
        let parts = self.mass.iter().zip(&self.velocity).map(|(&mass, velocity)| velocity.vector * mass);
        parts.fold(Vector3::zero(), |sum, part| sum + part)
    }

    /// Total mass [kg].
    pub fn total_mass(&self) -> f64 {
        self.mass.iter().sum()
    }

    /// Centre of mass [m], of positions within the domain along periodic directions; NaN without particles.
    pub fn centre_of_mass(&self) -> Vector3 {
        let moment = self.mass.iter().zip(&self.position).map(|(&mass, position)| position.vector * mass);
        moment.fold(Vector3::zero(), |sum, moment| sum + moment) * (1.0 / self.total_mass())
    }

    /// Total volume of the spheres, overlaps counted twice [m³].
    pub fn total_volume(&self) -> f64 {
        self.radius.iter().map(|&radius| 4.0 / 3.0 * std::f64::consts::PI * elementary::powi(radius, 3)).sum()
    }
}
