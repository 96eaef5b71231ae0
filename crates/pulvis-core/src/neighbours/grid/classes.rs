//! Which particles share a level of the grid.

use pulvis_math::{Packed4, Vector3};

/// Largest number of classes: the finest one also takes all smaller particles.
const MOST: usize = 24;

/// Classes of like sizes, finest first; none is empty.
#[derive(Clone, Debug)]
pub(super) struct Classes {
    pub(super) list: Vec<Class>,
    /// Index of each row's class in the list.
    pub(super) of_row: Vec<u8>,
}

/// Particles of like sizes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Class {
    /// Number of particles.
    pub(super) count: u32,
    /// Largest radius [m].
    pub(super) largest: f64,
    /// Lower corner of the box around the centres [m].
    pub(super) lower: [f64; 3],
    /// Upper corner of the box around the centres [m].
    pub(super) upper: [f64; 3],
}

impl Classes {
    /// Sorts particles into classes, in each of which sizes differ by less than a factor of two. The size of a particle is
    /// its radius plus half the `margin` [m], which is what the width of cells must allow for.
    pub(super) fn of(positions: &[Packed4], margin: f64) -> Self {
        let half_margin = 0.5 * margin;
        let largest = positions.iter().map(|position| position.scalar).fold(0.0, f64::max) + half_margin;
        let mut halved = [Class::empty(); MOST];
        let mut of_row = Vec::with_capacity(positions.len());
        for &Packed4 { vector: position, scalar: radius } in positions {
            let halvings = whole_halvings(largest / (radius + half_margin));
            of_row.push(halvings as u8);
            halved[halvings].take_in(position, radius);
        }
        let mut list = Vec::new();
        let mut class_of_halvings = [0; MOST];
        for halvings in (0..MOST).rev().filter(|&halvings| halved[halvings].count > 0) {
            class_of_halvings[halvings] = list.len() as u8;
            list.push(halved[halvings]);
        }
        for class in &mut of_row {
            *class = class_of_halvings[usize::from(*class)];
        }
        Self { list, of_row }
    }

    /// Centres [m] of the particles of a class.
    pub(super) fn centres<'a>(
        &'a self,
        class: usize,
        positions: &'a [Packed4],
    ) -> impl Iterator<Item = Vector3> + 'a {
        let of_class = move |&(_, &other): &(&Packed4, &u8)| usize::from(other) == class;
        positions.iter().zip(&self.of_row).filter(of_class).map(|(position, _)| position.vector)
    }
}

impl Class {
    fn empty() -> Self {
        Self { count: 0, largest: 0.0, lower: [f64::INFINITY; 3], upper: [f64::NEG_INFINITY; 3] }
    }

    fn take_in(&mut self, position: Vector3, radius: f64) {
        self.count += 1;
        self.largest = self.largest.max(radius);
        for axis in 0..3 {
            self.lower[axis] = self.lower[axis].min(position[axis]);
            self.upper[axis] = self.upper[axis].max(position[axis]);
        }
    }
}

/// How often a ratio can be halved without falling below one. Read from its exponent, because a logarithm for every particle
/// would be slow.
fn whole_halvings(ratio: f64) -> usize {
    const ONE: u64 = 1023;
    let exponent = (ratio.to_bits() >> 52) & 0x7ff;
    (exponent.saturating_sub(ONE) as usize).min(MOST - 1)
}
