//! Curves of straight pieces, looked up lane by lane.

use pulvis_math::Real;

/// The most numbers that a value of the loops holds.
const MOST_LANES: usize = 32;

/// The pieces that the lanes of a value lie on.
type Indices = [u16; MOST_LANES];

/// Where pieces start. A grid of equal steps says which piece a step begins in; from there it is a piece or two to the right
/// one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Starts {
    starts: Box<[f64]>,
    /// The piece at the beginning of each step of the grid.
    first: Box<[u16]>,
    /// Steps of the grid over the length [1/m].
    per_length: f64,
}

impl Starts {
    /// Of pieces in ascending order; the first one also holds what lies before it.
    pub(super) fn new(starts: impl ExactSizeIterator<Item = f64>) -> Self {
        let starts: Box<[f64]> = starts.collect();
        let steps = 4 * starts.len();
        let last = starts.last().copied().unwrap_or_default();
        let per_length = if last > 0.0 { steps as f64 / last } else { 0.0 };
        let piece_at = |step: usize| {
            // A little before, so that round-off never leads beyond a value's own piece.
            let value = (step as f64 - 1e-6) / per_length;
            starts.partition_point(|start| *start <= value).saturating_sub(1) as u16
        };
        let first = (0..=steps).map(piece_at).collect();
        Self { starts, first, per_length }
    }

    /// The number of the piece that holds a value.
    #[inline(always)]
    pub(super) fn index(&self, value: f64) -> usize {
        // The cast takes what is beyond the grid to its ends.
        let step = ((value * self.per_length) as usize).min(self.first.len() - 1);
        let mut found = usize::from(self.first[step]);
        while self.starts.get(found + 1).is_some_and(|start| *start <= value) {
            found += 1;
        }
        found
    }

    /// The same in every lane.
    #[inline(always)]
    fn indices<R: Real>(&self, values: R) -> Indices {
        const { assert!(R::LANES <= MOST_LANES) };
        let mut indices = [0; MOST_LANES];
        for (lane, index) in indices.iter_mut().enumerate().take(R::LANES) {
            *index = self.index(values.lane(lane)) as u16;
        }
        indices
    }
}

/// A column of the pieces, by their numbers.
#[inline(always)]
fn column<R: Real, P>(pieces: &[P], indices: &Indices, of: impl Fn(&P) -> f64) -> R {
    R::from_fn(|lane| pieces.get(usize::from(indices[lane])).map_or(0.0, &of))
}

/// A straight piece of the elastic curve: force and stored energy where it starts, and its slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ElasticPiece<R> {
    pub(super) start: R,
    pub(super) force: R,
    pub(super) slope: R,
    pub(super) energy: R,
}

/// The elastic curve g over the elastic part of the overlap.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Elastic {
    starts: Starts,
    pub(super) pieces: Box<[ElasticPiece<f64>]>,
}

impl Elastic {
    pub(super) fn new(pieces: Vec<ElasticPiece<f64>>) -> Self {
        Self { starts: Starts::new(pieces.iter().map(|piece| piece.start)), pieces: pieces.into() }
    }

    pub(super) fn index(&self, elastic: f64) -> usize {
        self.starts.index(elastic)
    }

    /// The pieces that hold these elastic overlaps.
    #[inline(always)]
    pub(super) fn piece<R: Real>(&self, elastic: R) -> ElasticPiece<R> {
        let indices = self.starts.indices(elastic);
        ElasticPiece {
            start: column(&self.pieces, &indices, |piece| piece.start),
            force: column(&self.pieces, &indices, |piece| piece.force),
            slope: column(&self.pieces, &indices, |piece| piece.slope),
            energy: column(&self.pieces, &indices, |piece| piece.energy),
        }
    }
}

/// A piece of virgin loading on which both curves are straight: what holds where it starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LoadingPiece {
    /// Overlap [m].
    pub(super) start: f64,
    /// Elastic part of the overlap [m].
    pub(super) elastic: f64,
    /// The share of a further overlap that is elastic, from 0 to 1.
    pub(super) elastic_share: f64,
    /// Force [N] and its slope [N/m].
    pub(super) force: f64,
    pub(super) slope: f64,
    /// What has been lost up to here [J].
    pub(super) work: f64,
}

/// Virgin loading.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Loading {
    starts: Starts,
    pieces: Box<[LoadingPiece]>,
}

impl Loading {
    pub(super) fn new(pieces: Vec<LoadingPiece>) -> Self {
        Self { starts: Starts::new(pieces.iter().map(|piece| piece.start)), pieces: pieces.into() }
    }

    /// Elastic part of the overlap of contacts that are loaded to here [m].
    #[inline(always)]
    pub(super) fn elastic_overlap<R: Real>(&self, loaded: R) -> R {
        let indices = self.starts.indices(loaded);
        let start: R = column(&self.pieces, &indices, |piece| piece.start);
        let elastic: R = column(&self.pieces, &indices, |piece| piece.elastic);
        elastic + column::<R, _>(&self.pieces, &indices, |piece| piece.elastic_share) * (loaded - start)
    }

    /// What contacts have lost that were loaded to here, ∫L dδ_p [J].
    #[inline(always)]
    pub(super) fn plastic_work<R: Real>(&self, loaded: R) -> R {
        let indices = self.starts.indices(loaded);
        let beyond = loaded - column::<R, _>(&self.pieces, &indices, |piece| piece.start);
        let plastic_share = R::one() - column::<R, _>(&self.pieces, &indices, |piece| piece.elastic_share);
        let force: R = column(&self.pieces, &indices, |piece| piece.force);
        let slope: R = column(&self.pieces, &indices, |piece| piece.slope);
        let work: R = column(&self.pieces, &indices, |piece| piece.work);
        work + plastic_share * beyond * (force + R::splat(0.5) * slope * beyond)
    }
}
