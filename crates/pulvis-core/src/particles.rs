//! The particles, as columns grouped by who must know them.

use pulvis_math::Vector3;

/// A particle's name: stable for its whole life, what files and interfaces show. Rows move when the
/// neighbour search puts them into cell order; ids do not.
pub type ParticleId = u32;

/// A material's place in the list of materials.
pub type MaterialIndex = u16;

/// A spherical particle to start with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle {
    /// Place in the list of materials.
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
    pub spin: Vector3,
}

/// All particles. Every column has one entry a row; rows are kept in cell order.
#[derive(Clone, Debug, Default)]
pub struct Particles {
    // Fixed.
    pub(crate) id: Vec<ParticleId>,
    pub(crate) material: Vec<MaterialIndex>,
    pub(crate) radius: Vec<f64>,
    pub(crate) mass: Vec<f64>,
    // Moving. Between the two kicks of a step, velocity and spin are those of mid-step.
    pub(crate) position: Vec<Vector3>,
    pub(crate) velocity: Vec<Vector3>,
    pub(crate) spin: Vec<Vector3>,
    // Result of the contact loop.
    pub(crate) force: Vec<Vector3>,
    pub(crate) torque: Vec<Vector3>,
    // Local to a step: what velocity and spin will be at its end if forces stay as they were.
    pub(crate) velocity_predicted: Vec<Vector3>,
    pub(crate) spin_predicted: Vec<Vector3>,
}

/// Applies `$action` to every column.
macro_rules! for_each_column {
    ($particles:expr, $column:ident => $action:expr) => {{
        {
            let $column = &mut $particles.id;
            $action;
        }
        {
            let $column = &mut $particles.material;
            $action;
        }
        {
            let $column = &mut $particles.radius;
            $action;
        }
        {
            let $column = &mut $particles.mass;
            $action;
        }
        {
            let $column = &mut $particles.position;
            $action;
        }
        {
            let $column = &mut $particles.velocity;
            $action;
        }
        {
            let $column = &mut $particles.spin;
            $action;
        }
        {
            let $column = &mut $particles.force;
            $action;
        }
        {
            let $column = &mut $particles.torque;
            $action;
        }
        {
            let $column = &mut $particles.velocity_predicted;
            $action;
        }
        {
            let $column = &mut $particles.spin_predicted;
            $action;
        }
    }};
}

impl Particles {
    /// Particles with ids 0, 1, 2, ... in the given order.
    pub fn new(particles: &[Particle]) -> Self {
        let column = |value: fn(&Particle) -> Vector3| particles.iter().map(value).collect::<Vec<_>>();
        Self {
            id: (0..particles.len() as ParticleId).collect(),
            material: particles.iter().map(|particle| particle.material).collect(),
            radius: particles.iter().map(|particle| particle.radius).collect(),
            mass: particles.iter().map(|particle| particle.mass).collect(),
            position: column(|particle| particle.position),
            velocity: column(|particle| particle.velocity),
            spin: column(|particle| particle.spin),
            force: vec![Vector3::zero(); particles.len()],
            torque: vec![Vector3::zero(); particles.len()],
            velocity_predicted: column(|particle| particle.velocity),
            spin_predicted: column(|particle| particle.spin),
        }
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
    pub fn positions(&self) -> &[Vector3] {
        &self.position
    }

    /// Velocities [m/s].
    pub fn velocities(&self) -> &[Vector3] {
        &self.velocity
    }

    /// Angular velocities [rad/s].
    pub fn spins(&self) -> &[Vector3] {
        &self.spin
    }

    /// Total forces [N].
    pub fn forces(&self) -> &[Vector3] {
        &self.force
    }

    /// Total torques [N m].
    pub fn torques(&self) -> &[Vector3] {
        &self.torque
    }

    /// The rows in the order of their ids: what files and interfaces should iterate over.
    pub fn rows_by_id(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = (0..self.len()).collect();
        rows.sort_unstable_by_key(|&row| self.id[row]);
        rows
    }

    /// Moment of inertia of a solid sphere, 2/5 m a² [kg m²].
    #[inline(always)]
    pub(crate) fn inertia(&self, row: usize) -> f64 {
        0.4 * self.mass[row] * self.radius[row] * self.radius[row]
    }

    /// Puts the rows into a new order: row k becomes what was row `order[k]`.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        for_each_column!(self, column => {
            let moved: Vec<_> = order.iter().map(|&row| column[row as usize]).collect();
            *column = moved;
        });
    }

    /// Memory of all columns [byte].
    pub(crate) fn memory_size(&self) -> usize {
        // Seven vectors, radius, mass, id and material; the skin keeps one more vector.
        self.len() * (8 * size_of::<Vector3>() + 2 * size_of::<f64>() + 4 + 2)
    }

    /// Sum of all momenta [kg m/s].
    pub fn momentum(&self) -> Vector3 {
        let parts = self.mass.iter().zip(&self.velocity).map(|(&mass, &velocity)| velocity * mass);
        parts.fold(Vector3::zero(), |sum, part| sum + part)
    }

    /// Total mass [kg].
    pub fn total_mass(&self) -> f64 {
        self.mass.iter().sum()
    }

    /// Total volume of the spheres, overlaps counted twice [m³].
    pub fn total_volume(&self) -> f64 {
        self.radius.iter().map(|radius| 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3)).sum()
    }
}
