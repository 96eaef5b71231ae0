//! Eight numbers in plain Rust, for every processor.

use super::{Packed4, Pointer, Routine, Simd4, Simd8, Task, side_by_side};
use crate::array::F64Array;
use crate::vector::Vector3;

impl Simd4 for [f64; 4] {
    #[inline(always)]
    fn load(packed: &Packed4) -> Self {
        [packed.vector.x, packed.vector.y, packed.vector.z, packed.scalar]
    }
    #[inline(always)]
    fn store(self, packed: &mut Packed4) {
        *packed = Packed4::new(Vector3::new(self[0], self[1], self[2]), self[3]);
    }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        [value; 4]
    }
    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        [self[0] + other[0], self[1] + other[1], self[2] + other[2], self[3] + other[3]]
    }
    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        [self[0] - other[0], self[1] - other[1], self[2] - other[2], self[3] - other[3]]
    }
    #[inline(always)]
    fn times(self, other: Self) -> Self {
        [self[0] * other[0], self[1] * other[1], self[2] * other[2], self[3] * other[3]]
    }
    #[inline(always)]
    fn with_scalar_of(self, other: Self) -> Self {
        [self[0], self[1], self[2], other[3]]
    }
}

impl Simd8 for F64Array<8> {
    type Simd4 = [f64; 4];
    type Simd4Pair = [Self::Simd4; 2];
    #[inline(always)]
    fn load(source: &F64Array<8>) -> Self {
        *source
    }
    #[inline(always)]
    fn store(self, target: &mut F64Array<8>) {
        *target = self;
    }
    #[inline(always)]
    fn columns(rows: [[f64; 4]; 8]) -> [Self; 4] {
        let mut columns = [Self::default(); 4];
        for (lane, row) in rows.iter().enumerate() {
            for (column, number) in columns.iter_mut().zip(row) {
                column.0[lane] = *number;
            }
        }
        columns
    }
    #[inline(always)]
    fn rows(columns: [Self; 4]) -> [[f64; 4]; 8] {
        let mut rows = [[0.0; 4]; 8];
        for (lane, row) in rows.iter_mut().enumerate() {
            for (number, column) in row.iter_mut().zip(&columns) {
                *number = column.0[lane];
            }
        }
        rows
    }

    #[inline(always)]
    fn row_pairs(first: [Self; 4], second: [Self; 4]) -> [Self::Simd4Pair; 8] {
        side_by_side(Self::rows(first), Self::rows(second))
    }

    fn pointer<T: Task, P: Routine<T>>() -> Pointer<T, Self> {
        #[inline(never)]
        fn call<T: Task, P: Routine<T>>(data: &mut T::Data<'_, F64Array<8>>) {
            P::call::<F64Array<8>>(data);
        }
        Pointer(call::<T, P>)
    }
}
