//! Numbers in memory, and contact memory in columns of them.

use pulvis_contact::{Columns, ContactKinematics};
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
        normal_rate: None,
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

/// The columns of one group of contacts in memory.
pub(super) struct Slots<'a, S>(pub(super) &'a mut [S]);

impl<R: Real, S: Stored<R>> Columns<R> for Slots<'_, S> {
    #[inline(always)]
    fn get(&self, column: usize) -> R {
        self.0[column].load()
    }
    #[inline(always)]
    fn set(&mut self, column: usize, value: R) {
        self.0[column].store(value);
    }
}
