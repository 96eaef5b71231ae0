//! How far particles have moved since the last rebuild.

use pulvis_math::{Kernel, Packed4, Real, Simd4, Simd8, Vector3};

/// Bounds of how far some particles have moved since the last rebuild.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Moved {
    /// The largest and the second largest displacement of any particle [m]: no gap between two of the particles has
    /// closed by more than their sum.
    pub(crate) longest: f64,
    pub(crate) second: f64,
    /// The smallest remaining skin of any particle: its skin less its displacement [m].
    pub(crate) left: f64,
}

impl Default for Moved {
    /// For no particles.
    fn default() -> Self {
        Self { longest: 0.0, second: 0.0, left: f64::INFINITY }
    }
}

impl Moved {
    /// For particles that have not moved, with skins of at least this thickness [m].
    pub(crate) fn nowhere(skin: f64) -> Self {
        Self { left: skin, ..Self::default() }
    }

    /// For particles that may be anywhere.
    pub(crate) const ANYWHERE: Self =
        Self { longest: f64::INFINITY, second: f64::INFINITY, left: f64::NEG_INFINITY };

    /// Adds the displacement of one more particle, with its skin [m].
    #[inline(always)]
    pub(super) fn take_in(&mut self, displacement: f64, skin: f64) {
        self.second = self.second.max(displacement.min(self.longest));
        self.longest = self.longest.max(displacement);
        self.left = self.left.min(skin - displacement);
    }

    /// The bounds after all particles have moved by up to `displacement` [m] more.
    pub(crate) fn farther(self, displacement: f64) -> Self {
        Self {
            longest: self.longest + displacement,
            second: self.second + displacement,
            left: self.left - displacement,
        }
    }
}

/// Measures how far particles have moved, from their centres and radii now and their centres and radii with skins at the
/// last rebuild.
pub(super) struct Survey<'a> {
    pub(super) positions: &'a [Packed4],
    pub(super) listed: &'a [Packed4],
}

impl Kernel for Survey<'_> {
    type Output = Moved;

    #[inline(always)]
    fn run<R: Simd8>(self) -> Moved {
        let (positions, last_positions) = self.positions.as_chunks::<8>();
        let (listed, last_listed) = self.listed.as_chunks::<8>();
        let (mut longest, mut second, mut left) = (R::zero(), R::zero(), R::splat(f64::INFINITY));
        for (now, before) in positions.iter().zip(listed) {
            let [x, y, z, radius] = columns::<R>(now);
            let [x_before, y_before, z_before, skinned] = columns::<R>(before);
            let displacement = length_of(Vector3::new(x - x_before, y - y_before, z - z_before));
            second = second.max(displacement.min(longest));
            longest = longest.max(displacement);
            left = left.min(skinned - radius - displacement);
        }
        let mut moved = Moved::default();
        let [longest, second, left] = [longest.to_array(), second.to_array(), left.to_array()];
        for lane in 0..8 {
            moved.take_in(longest.0[lane], f64::INFINITY);
            moved.take_in(second.0[lane], f64::INFINITY);
            moved.left = moved.left.min(left.0[lane]);
        }
        for (now, before) in last_positions.iter().zip(last_listed) {
            moved.take_in(length_of(now.vector - before.vector), before.scalar - now.scalar);
        }
        moved
    }
}

/// The length of a displacement; infinite if it is NaN.
#[inline(always)]
pub(super) fn length_of<R: Real>(displacement: Vector3<R>) -> R {
    let displacement = displacement.norm();
    R::select(displacement.lt(R::splat(f64::INFINITY)), displacement, R::splat(f64::INFINITY))
}

#[inline(always)]
fn columns<R: Simd8>(packed: &[Packed4; 8]) -> [R; 4] {
    R::columns([
        R::Simd4::load(&packed[0]),
        R::Simd4::load(&packed[1]),
        R::Simd4::load(&packed[2]),
        R::Simd4::load(&packed[3]),
        R::Simd4::load(&packed[4]),
        R::Simd4::load(&packed[5]),
        R::Simd4::load(&packed[6]),
        R::Simd4::load(&packed[7]),
    ])
}

#[cfg(test)]
mod tests {
    use pulvis_math::InstructionSet;

    use super::*;

    /// Particles of radius 1 that have moved so far along x, each in its skin.
    fn moved(displacements_and_skins: &[(f64, f64)]) -> Moved {
        let at = |x: f64, radius: f64| Packed4::new(Vector3::new(x, 0.0, 0.0), radius);
        let positions: Vec<Packed4> =
            displacements_and_skins.iter().map(|&(displacement, _)| at(displacement, 1.0)).collect();
        let listed: Vec<Packed4> =
            displacements_and_skins.iter().map(|&(_, skin)| at(0.0, 1.0 + skin)).collect();
        let sets = InstructionSet::available().into_iter();
        let all: Vec<Moved> =
            sets.map(|set| set.run(Survey { positions: &positions, listed: &listed })).collect();
        assert!(all.iter().all(|moved| *moved == all[0]), "{all:?}");
        all[0]
    }

    #[test]
    fn the_two_largest_displacements_are_kept_in_any_order_and_the_smallest_remaining_skin() {
        for length in 3..30 {
            for index in 0..length {
                let mut all = vec![(-0.5, 1.0); length];
                all[index] = (-3.0, 8.0);
                all[(index + 1) % length] = (2.0, 2.25);
                assert_eq!(moved(&all), Moved { longest: 3.0, second: 2.0, left: 0.25 });
            }
        }
        assert_eq!(moved(&[]), Moved::default());
    }

    #[test]
    fn what_is_nowhere_has_left_its_skin() {
        for length in 1..20 {
            for (index, nowhere) in
                (0..length).flat_map(|index| [f64::NAN, f64::INFINITY].map(|x| (index, x)))
            {
                let mut all = vec![(0.0, 1.0); length];
                all[index].0 = nowhere;
                let moved = moved(&all);
                assert_eq!((moved.longest, moved.left), (f64::INFINITY, f64::NEG_INFINITY));
            }
        }
    }

    #[test]
    fn what_is_left_of_a_skin_is_negative_where_it_has_been_left() {
        let left = |one, other| moved(&[(one, 0.1), (other, 0.2)]).left;
        assert!((left(0.04, 0.0) - 0.06).abs() < 1e-15 && (left(0.0, 0.19) - 0.01).abs() < 1e-15);
        assert!(left(0.11, 0.0) < 0.0 && left(0.0, -0.21) < 0.0);
    }
}
