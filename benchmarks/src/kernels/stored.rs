//! Numbers in memory, and contact memory in columns of them.

use pulvis_contact::{ContactKinematics, ContactLaws, ContactMemory, Memory, NormalLaw, resistance};
use pulvis_math::{F64Array, Real, Simd8, Vector3};

/// What values of `R` are loaded from and stored to: one number, or eight beside each other.
pub(super) trait Stored<R>: Real {
    fn load(&self) -> R;
    fn store(&mut self, value: R);
}

impl Stored<f64> for f64 {
    #[inline(always)]
    fn load(&self) -> f64 {
        *self
    }
    #[inline(always)]
    fn store(&mut self, value: f64) {
        *self = value;
    }
}

impl<R: Simd8> Stored<R> for F64Array<8> {
    #[inline(always)]
    fn load(&self) -> R {
        R::load(self)
    }
    #[inline(always)]
    fn store(&mut self, value: R) {
        value.store(self);
    }
}

#[inline(always)]
pub(super) fn load_vector<R: Real, S: Stored<R>>(vector: &Vector3<S>) -> Vector3<R> {
    Vector3::new(vector.x.load(), vector.y.load(), vector.z.load())
}

#[inline(always)]
pub(super) fn store_vector<R: Real, S: Stored<R>>(vector: &mut Vector3<S>, value: Vector3<R>) {
    vector.x.store(value.x);
    vector.y.store(value.y);
    vector.z.store(value.z);
}

#[inline(always)]
pub(super) fn load_motion<R: Real, S: Stored<R>>(motion: &ContactKinematics<S>) -> ContactKinematics<R> {
    ContactKinematics {
        normal: load_vector(&motion.normal),
        overlap: motion.overlap.load(),
        inverse_distance: motion.inverse_distance.load(),
        radius_i: motion.radius_i.load(),
        radius_j: motion.radius_j.load(),
        velocity: load_vector(&motion.velocity),
        velocity_mid: load_vector(&motion.velocity_mid),
        angular_velocity_i: load_vector(&motion.angular_velocity_i),
        angular_velocity_j: load_vector(&motion.angular_velocity_j),
        angular_velocity_i_mid: load_vector(&motion.angular_velocity_i_mid),
        angular_velocity_j_mid: load_vector(&motion.angular_velocity_j_mid),
    }
}

/// The columns of contact memory that models of the level `RESISTANCE` use: those of the normal law, then
/// touch, the springs of sliding and rolling, and that of torsion.
#[derive(Clone, Copy)]
pub(super) struct MemoryColumns<const RESISTANCE: u8> {
    normal: usize,
    touched: bool,
}

impl<const RESISTANCE: u8> MemoryColumns<RESISTANCE> {
    pub(super) fn of<N: NormalLaw>(laws: &ContactLaws) -> Self {
        let normal = <N::Memory<f64> as Memory<f64>>::COLUMNS;
        Self { normal, touched: laws.noncontact.remembers_touch() }
    }

    /// Number of columns.
    pub(super) fn count(self) -> usize {
        self.normal + 8
    }

    // Closures are for the normal law's columns alone, as in the engine: what is in them is inlined, but
    // not by force.
    #[inline(always)]
    pub(super) fn load<R: Real, S: Stored<R>, M: Memory<R>>(self, columns: &[S]) -> ContactMemory<R, M> {
        let (normal, others) = columns.split_at(self.normal);
        let mut memory = ContactMemory {
            normal: M::load(|column| normal[column].load()),
            touched: R::zero(),
            sliding: Vector3::zero(),
            rolling: Vector3::zero(),
            torsion: R::zero(),
        };
        if self.touched {
            memory.touched = others[0].load();
        }
        if RESISTANCE >= resistance::SLIDING {
            memory.sliding = Vector3::new(others[1].load(), others[2].load(), others[3].load());
        }
        if RESISTANCE >= resistance::ALL {
            memory.rolling = Vector3::new(others[4].load(), others[5].load(), others[6].load());
            memory.torsion = others[7].load();
        }
        memory
    }

    #[inline(always)]
    pub(super) fn store<R: Real, S: Stored<R>, M: Memory<R>>(
        self,
        memory: &ContactMemory<R, M>,
        columns: &mut [S],
    ) {
        let (normal, others) = columns.split_at_mut(self.normal);
        memory.normal.store(|column, value| normal[column].store(value));
        if self.touched {
            others[0].store(memory.touched);
        }
        if RESISTANCE >= resistance::SLIDING {
            others[1].store(memory.sliding.x);
            others[2].store(memory.sliding.y);
            others[3].store(memory.sliding.z);
        }
        if RESISTANCE >= resistance::ALL {
            others[4].store(memory.rolling.x);
            others[5].store(memory.rolling.y);
            others[6].store(memory.rolling.z);
            others[7].store(memory.torsion);
        }
    }
}
