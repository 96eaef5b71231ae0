//! Eight numbers in plain Rust, for every processor.

use super::{Octet, Quad, Row, side_by_side};
use crate::lanes::Lanes;
use crate::vector::Vector3;

impl Row for [f64; 4] {
    #[inline(always)]
    fn load(quad: &Quad) -> Self {
        [quad.vector.x, quad.vector.y, quad.vector.z, quad.scalar]
    }
    #[inline(always)]
    fn store(self, quad: &mut Quad) {
        *quad = Quad::new(Vector3::new(self[0], self[1], self[2]), self[3]);
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

impl Octet for Lanes<8> {
    type Row = [f64; 4];
    type Twin = [Self::Row; 2];
    #[inline(always)]
    fn load(source: &Lanes<8>) -> Self {
        *source
    }
    #[inline(always)]
    fn store(self, target: &mut Lanes<8>) {
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
    fn twins(first: [Self; 4], second: [Self; 4]) -> [Self::Twin; 8] {
        side_by_side(Self::rows(first), Self::rows(second))
    }
}
