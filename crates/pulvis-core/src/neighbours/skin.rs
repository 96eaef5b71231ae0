//! When the list of candidates is out of date.

use std::ops::Range;

use pulvis_math::Quad;

/// Where particles and walls were when the candidates were listed, and how far they may move.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skin {
    /// Candidates are listed up to this much beyond their reach [m].
    pub(crate) thickness: f64,
    places: Vec<Quad>,
    walls: Vec<f64>,
    /// Steps since the list was made.
    steps: u64,
}

/// Steps after which it is looked at how far particles have really moved. In between, the highest speed says
/// how far at the most: that costs no look at where they were, which is far from any cache.
const SURVEY: u64 = 8;

/// The longest and the second longest way of any particle since it was listed: no gap between two
/// particles has closed by more than their sum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Moved {
    pub(crate) longest: f64,
    pub(crate) second: f64,
}

impl Moved {
    /// Takes in one more way; one that is no number counts as infinite.
    #[inline(always)]
    pub(crate) fn take_in(&mut self, way: f64) {
        // Not `>`: a NaN must not be passed over.
        let shorter = way <= self.second;
        if !shorter {
            let way = if way.is_nan() { f64::INFINITY } else { way };
            self.second = way.min(self.longest);
            self.longest = way.max(self.longest);
        }
    }

    /// Of a range of rows.
    fn of(places: &[Quad], listed: &[Quad]) -> Self {
        let mut squares = Self::default();
        for (now, before) in places.iter().zip(listed) {
            squares.take_in((now.vector - before.vector).norm_squared());
        }
        Self { longest: squares.longest.sqrt(), second: squares.second.sqrt() }
    }

    /// At the most, when all have gone on by up to `way`.
    pub(crate) fn farther(self, way: f64) -> Self {
        Self { longest: self.longest + way, second: self.second + way }
    }

    /// By how much a gap between two of these particles can have closed.
    pub(crate) fn closed(self) -> f64 {
        self.longest + self.second
    }

    /// The same for all particles of several sets.
    pub(crate) fn of_all(sets: impl Iterator<Item = Self>) -> Self {
        let mut all = Self::default();
        for set in sets {
            all.take_in(set.longest);
            all.take_in(set.second);
        }
        all
    }
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
        self.steps = 0;
    }

    /// Counts a step. Answers whether a survey is due.
    pub(crate) fn count_step(&mut self) -> bool {
        self.steps += 1;
        self.steps.is_multiple_of(SURVEY)
    }

    /// How far the particles of some rows, now at `places`, have moved since the list was made [m].
    pub(crate) fn moved(&self, rows: Range<usize>, places: &[Quad]) -> Moved {
        Moved::of(&places[rows.clone()], &self.places[rows])
    }

    /// The longest way of any wall since the list was made [m].
    pub(crate) fn moved_walls(&self, offsets: impl Iterator<Item = f64>) -> f64 {
        offsets.zip(&self.walls).map(|(now, before)| (now - before).abs()).fold(0.0, f64::max)
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
    fn the_two_longest_ways_are_kept_in_any_order() {
        for ways in [[1.0, 2.0, 3.0], [3.0, 2.0, 1.0], [2.0, 3.0, 1.0], [3.0, 1.0, 2.0]] {
            let mut moved = Moved::default();
            ways.into_iter().for_each(|way| moved.take_in(way));
            assert_eq!(moved, Moved { longest: 3.0, second: 2.0 });
            moved.take_in(f64::NAN);
            assert_eq!(moved, Moved { longest: f64::INFINITY, second: 3.0 });
        }
    }

    #[test]
    fn a_list_is_out_of_date_when_two_bodies_can_have_come_closer_by_a_skin() {
        let mut skin = Skin { thickness: 0.2, ..Skin::default() };
        let start = vec![Quad::default(); 2];
        skin.renew(&start, [0.0].into_iter());
        let outdated = |ways: [f64; 2], wall: f64, places: &[Quad]| {
            let moved = Moved::of_all(ways.map(|way| Moved { longest: way, second: 0.0 }).into_iter());
            let closed = moved.closed().max(moved.longest + skin.moved_walls([wall].into_iter()));
            skin.outdated(closed, places)
        };
        assert_eq!(outdated([0.09, 0.09], 0.09, &start), Outdated::No);
        assert_eq!(outdated([0.0, 0.19], 0.0, &start), Outdated::No);
        assert_eq!(outdated([0.09, 0.02], 0.12, &start), Outdated::Yes);
        assert_eq!(outdated([0.11, 0.10], 0.0, &start), Outdated::Yes);
        let lost = [Quad::new(Vector3::new(0.0, f64::NAN, 0.0), 1.0), Quad::default()];
        assert_eq!(outdated([0.0, f64::NAN], 0.0, &lost), Outdated::Lost(0));
    }
}
