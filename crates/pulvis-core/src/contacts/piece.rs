//! A run of rows, the contacts that it owns, and the sums of their loads.

use std::ops::Range;

use super::block::ContactGroup;
use crate::phases::Phases;

/// Rows of a piece at the least, so that its blocks are full, and at the most, so that it fits into a
/// second-level cache.
const ROWS: Range<usize> = 128..1024;
/// Pieces that small systems are cut into, so that several threads find work.
const PIECES: usize = 12;

/// Consecutive rows, and every contact whose lower row is one of them.
///
/// Pieces are what threads take their work by. Each sums the loads of its contacts in places of its own:
/// one for each of its rows, then one for each row of later pieces that it has contacts with (its halo).
/// A row's load is the sum of its own place and of the halos of earlier pieces, in their order: no two
/// threads write to the same place, and the order of every sum is fixed.
#[derive(Clone, Debug, Default)]
pub(crate) struct Piece {
    pub(crate) rows: Range<usize>,
    pub(crate) groups: Vec<ContactGroup>,
    /// Rows of later pieces, in ascending order: what listing gives to the list of all halos.
    pub(crate) halo: Vec<u32>,
    /// Parts of the halos of earlier pieces that are rows of this one.
    pub(crate) incoming: Vec<Incoming>,
    /// How far the bodies of its contacts have moved.
    pub(crate) closed: Closed,
    /// Time spent on its contacts since it was listed.
    pub(crate) phases: Phases,
    /// Later pieces that wait for this one.
    pub(crate) dependents: Vec<u32>,
}

/// By how much gaps can have closed since candidates were listed [m]: those between the particles that
/// contacts of a piece are of, and those between its rows and walls.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Closed {
    pub(crate) pairs: f64,
    pub(crate) walls: f64,
}

/// A part of an earlier piece's halo.
#[derive(Clone, Debug)]
pub(crate) struct Incoming {
    /// Places in the list of the halos of all pieces.
    pub(crate) slots: Range<usize>,
}

/// Cuts all rows into pieces, the same for any number of threads.
pub(crate) fn cut(rows: usize) -> Vec<Piece> {
    let length = (rows / PIECES).clamp(ROWS.start, ROWS.end);
    let starts = (0..rows).step_by(length);
    starts.map(|start| Piece { rows: start..(start + length).min(rows), ..Piece::default() }).collect()
}

impl Piece {
    /// Takes in a group, unless it is empty.
    pub(super) fn keep(&mut self, group: ContactGroup) {
        if group.len() > 0 {
            self.groups.push(group);
        }
    }
}
