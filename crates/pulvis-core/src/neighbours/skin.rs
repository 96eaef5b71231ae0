//! When the list of candidates is out of date.

use pulvis_math::Vector3;

/// Where particles and walls were when the candidates were listed, and how far they may move.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skin {
    /// Candidates are listed up to this much beyond their reach [m].
    pub(crate) thickness: f64,
    positions: Vec<Vector3>,
    walls: Vec<f64>,
}

/// Whether a new list is needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Outdated {
    /// The list still holds.
    No,
    /// Something has moved half a skin.
    Yes,
    /// The particle in this row is nowhere: its position is no number.
    Lost(usize),
}

impl Skin {
    /// Remembers the present places.
    pub(crate) fn renew(&mut self, positions: &[Vector3], wall_offsets: impl Iterator<Item = f64>) {
        self.positions.clear();
        self.positions.extend_from_slice(positions);
        self.walls.clear();
        self.walls.extend(wall_offsets);
    }

    /// Whether anything has moved half a skin since the list was made: two bodies can then have
    /// come closer by a whole skin.
    pub(crate) fn outdated(
        &self,
        positions: &[Vector3],
        wall_offsets: impl Iterator<Item = f64>,
    ) -> Outdated {
        let limit = 0.25 * self.thickness * self.thickness;
        let moved = positions.iter().zip(&self.positions).any(|(now, before)| {
            let squared = (*now - *before).norm_squared();
            squared > limit || squared.is_nan()
        });
        if moved && let Some(lost) = positions.iter().position(|position| !position.is_finite()) {
            return Outdated::Lost(lost);
        }
        let walls_moved =
            wall_offsets.zip(&self.walls).any(|(now, before)| 2.0 * (now - before).abs() > self.thickness);
        if moved || walls_moved || positions.len() != self.positions.len() {
            Outdated::Yes
        } else {
            Outdated::No
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_is_out_of_date_when_something_has_moved_half_a_skin() {
        let mut skin = Skin { thickness: 0.2, ..Skin::default() };
        let start = vec![Vector3::zero(); 2];
        skin.renew(&start, [0.0].into_iter());
        let mut moved = start;
        moved[1].x = 0.09;
        assert_eq!(skin.outdated(&moved, [0.09].into_iter()), Outdated::No);
        assert_eq!(skin.outdated(&moved, [0.11].into_iter()), Outdated::Yes);
        moved[1].x = 0.11;
        assert_eq!(skin.outdated(&moved, [0.0].into_iter()), Outdated::Yes);
        moved[0].y = f64::NAN;
        assert_eq!(skin.outdated(&moved, [0.0].into_iter()), Outdated::Lost(0));
    }
}
