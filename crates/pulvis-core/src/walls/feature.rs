//! Names of the parts of walls that contacts are with.

/// A feature of a wall: the part of its surface that a contact is with. Planes and cylinders have one; a mesh has its
/// flat parts, edges and corners. What a contact remembers belongs to a particle and a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WallFeature(u32);

/// Bits of the wall's index; the feature's index stands above them. Together they have 30, as rows have.
const WALL_BITS: u32 = 10;

impl WallFeature {
    /// Walls that can be told apart.
    pub(crate) const MOST_WALLS: usize = 1 << WALL_BITS;

    /// The feature with this index among those of a wall.
    pub(crate) fn new(wall: usize, feature: u32) -> Self {
        debug_assert!(wall < Self::MOST_WALLS && feature < 1 << (30 - WALL_BITS));
        Self(feature << WALL_BITS | wall as u32)
    }

    /// From its number.
    #[inline(always)]
    pub(crate) fn from_number(number: u32) -> Self {
        Self(number)
    }

    /// A number below 2³⁰.
    pub(crate) fn number(self) -> u32 {
        self.0
    }

    /// The index of the feature among those of the wall.
    pub(crate) fn index(self) -> u32 {
        self.0 >> WALL_BITS
    }

    /// The index of the wall.
    #[inline(always)]
    pub(crate) fn wall(self) -> usize {
        self.0 as usize & (Self::MOST_WALLS - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_and_features_are_told_apart() {
        let mut numbers = std::collections::HashSet::new();
        for wall in [0, 1, 500, WallFeature::MOST_WALLS - 1] {
            for feature in [0, 1, 77, (1 << 20) - 1] {
                let key = WallFeature::new(wall, feature);
                assert_eq!(WallFeature::from_number(key.number()).wall(), wall);
                assert_eq!(key.index(), feature);
                assert!(key.number() < 1 << 30 && numbers.insert(key.number()));
            }
        }
    }
}
