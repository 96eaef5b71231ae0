//! When the list of candidates is out of date.

use pulvis_math::Quad;

/// Where particles and walls were when the candidates were listed, and how far they may move.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skin {
    /// Candidates are listed up to this much beyond their reach [m].
    pub(crate) thickness: f64,
    places: Vec<Quad>,
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
    pub(crate) fn renew(&mut self, places: &[Quad], wall_offsets: impl Iterator<Item = f64>) {
        self.places.clear();
        self.places.extend_from_slice(places);
        self.walls.clear();
        self.walls.extend(wall_offsets);
    }

    /// Where the particles were.
    pub(crate) fn listed(&self) -> &[Quad] {
        &self.places
    }

    /// By how much a gap can have closed since the list was made [m], if no particle has moved farther
    /// than the root of `farthest` [m²].
    pub(crate) fn closed(&self, farthest: f64, wall_offsets: impl Iterator<Item = f64>) -> f64 {
        let moved = farthest.sqrt();
        let walls = wall_offsets.zip(&self.walls).map(|(now, before)| (now - before).abs());
        moved + walls.fold(moved, f64::max)
    }

    /// Whether the list still holds: a gap that has closed by more than a skin may be that of two
    /// bodies which are not on it.
    pub(crate) fn outdated(&self, closed: f64, places: &[Quad]) -> Outdated {
        if closed.is_finite() && closed <= self.thickness {
            return Outdated::No;
        }
        match places.iter().position(|place| !place.vector.is_finite()) {
            Some(lost) => Outdated::Lost(lost),
            None => Outdated::Yes,
        }
    }
}

#[cfg(test)]
mod tests {
    use pulvis_math::Vector3;

    use super::*;

    #[test]
    fn a_list_is_out_of_date_when_two_bodies_can_have_come_closer_by_a_skin() {
        let mut skin = Skin { thickness: 0.2, ..Skin::default() };
        let start = vec![Quad::default(); 2];
        skin.renew(&start, [0.0].into_iter());
        let outdated = |farthest: f64, wall: f64, places: &[Quad]| {
            skin.outdated(skin.closed(farthest * farthest, [wall].into_iter()), places)
        };
        assert_eq!(outdated(0.09, 0.09, &start), Outdated::No);
        assert_eq!(outdated(0.09, 0.12, &start), Outdated::Yes);
        assert_eq!(outdated(0.11, 0.0, &start), Outdated::Yes);
        let lost = [Quad::new(Vector3::new(0.0, f64::NAN, 0.0), 1.0), Quad::default()];
        assert_eq!(outdated(f64::INFINITY, 0.0, &lost), Outdated::Lost(0));
    }
}
