//! All candidate contacts: listed anew when bodies have moved, and swept every step.

use std::ops::Range;

use pulvis_contact::ContactEnergies;
use pulvis_math::{InstructionSet, Lanes, Vector3};

use super::Interactions;
use super::block::ContactGroup;
use super::leftovers::Leftovers;
use super::listing::{Listing, Sources};
use super::piece::{Closed, Incoming, Piece, cut};
use super::rebuild::MemoryStore;
use super::sweep::{Countdown, Halos, Sums, Sweep, Sweeping};
use crate::domain::Images;
use crate::neighbours::{CellGrid, Moved, Skin};
use crate::particles::{Load, MaterialIndex, Particles};
use crate::shared::Shared;
use crate::team::Team;
use crate::walls::Wall;

/// The candidates and what they remember.
#[derive(Clone, Debug, Default)]
pub(crate) struct ContactTable {
    pieces: Vec<Piece>,
    row_count: usize,
    /// The halos of all pieces, one behind the other.
    halos: Vec<u32>,
    /// Where the halo of each piece begins, and the end.
    halo_starts: Vec<usize>,
    pending: Vec<Countdown>,
    /// Scratch: one for each member of the team.
    sums: Vec<Sums>,
    leftovers: Leftovers,
    /// Scratch: one for each member of the team.
    listings: Vec<Listing>,
}

/// What the list of candidates depends on.
#[derive(Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) particles: &'a Particles,
    /// The rows that the particles had when contacts were last listed.
    pub(crate) order: &'a [u32],
    /// The materials of all particles, each once.
    pub(crate) materials: &'a [MaterialIndex],
    pub(crate) interactions: &'a Interactions,
    pub(crate) walls: &'a [Wall],
    pub(crate) images: Images,
    pub(crate) skin: &'a Skin,
    pub(crate) instructions: InstructionSet,
}

impl ContactTable {
    /// All groups, piece by piece, in each piece pairs of particles first.
    pub(crate) fn groups(&self) -> impl Iterator<Item = &ContactGroup> {
        self.pieces.iter().flat_map(|piece| &piece.groups)
    }

    /// The runs of rows that threads take their work by.
    pub(crate) fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// Lets `store` remember what the contacts remember.
    pub(crate) fn remember(&self, store: &mut MemoryStore, team: &Team) {
        store.gather(&self.pieces, team);
    }

    /// Lists all candidates within reach and skin; contacts keep their `memory`. Answers with the number
    /// of places that the loads need, those of the rows first.
    pub(crate) fn rebuild(
        &mut self,
        around: &Surroundings<'_>,
        grid: &CellGrid,
        memory: &MemoryStore,
        team: &Team,
    ) -> usize {
        if self.pieces.is_empty() {
            self.pieces = cut(around.particles.len());
        }
        self.listings.resize_with(team.threads(), Listing::default);
        let count = self.pieces.len();
        let (pieces, listings) = (Shared::new(&mut self.pieces), Shared::new(&mut self.listings));
        let sources = Sources { around, grid, memory };
        team.for_each_number(count, |member, number| {
            // SAFETY: every member is told its own number, and every piece is listed once.
            let (listing, piece) = unsafe { (listings.get_mut(member), pieces.get_mut(number)) };
            listing.list(piece, sources);
        });
        self.row_count = around.particles.len();
        self.link(self.row_count)
    }

    /// Gives the halo of every piece its sums, which stand behind those of all `rows`, and tells every
    /// piece whose halos it takes part in. Answers with the end of all sums.
    fn link(&mut self, rows: usize) -> usize {
        self.halos.clear();
        self.halo_starts.clear();
        for number in 0..self.pieces.len() {
            let start = self.halos.len();
            self.halo_starts.push(start);
            let halo = std::mem::take(&mut self.pieces[number].halo);
            let mut slot = 0;
            while slot < halo.len() {
                let later = self.pieces.partition_point(|piece| piece.rows.end <= halo[slot] as usize);
                let rows_end = self.pieces[later].rows.end;
                let after = slot + halo[slot..].partition_point(|&row| (row as usize) < rows_end);
                self.pieces[later].incoming.push(Incoming { slots: start + slot..start + after });
                self.pieces[number].dependents.push(later as u32);
                slot = after;
            }
            self.halos.extend_from_slice(&halo);
            self.pieces[number].halo = halo;
        }
        self.halo_starts.push(self.halos.len());
        let counts = self.pieces.iter().map(|piece| 1 + piece.incoming.len() as u32);
        self.pending = counts.map(Countdown::from).collect();
        rows + self.halos.len()
    }

    /// Takes in how far the rows of every piece, and walls, have moved since the candidates were listed [m].
    pub(crate) fn close_gaps(&mut self, moved: impl Fn(usize) -> Moved, walls: f64) {
        for (number, piece) in self.pieces.iter_mut().enumerate() {
            let own = moved(number);
            let others = piece.dependents.iter().map(|&other| moved(other as usize).longest);
            piece.closed =
                Closed { pairs: own.longest + others.fold(own.second, f64::max), walls: own.longest + walls };
        }
    }

    /// Computes the loads of all contacts. When those on the rows of a piece are complete, and nobody
    /// uses these rows any more, `finish` is called with the number of the piece, its rows and the loads.
    pub(crate) fn sweep(
        &mut self,
        sweep: &Sweep<'_>,
        team: &Team,
        finish: impl Fn(usize, Range<usize>, &mut [Load]) + Sync,
    ) {
        let count = self.pieces.len();
        self.sums.resize_with(team.threads(), Sums::default);
        self.leftovers.clear(team.threads(), count);
        let sweeping = Sweeping {
            sweep: *sweep,
            pieces: Shared::new(&mut self.pieces),
            sums: Shared::new(&mut self.sums),
            pending: &self.pending,
            leftovers: &self.leftovers,
            halos: Halos { rows: &self.halos, starts: &self.halo_starts, row_count: self.row_count },
            finish,
        };
        // SAFETY: every member is told its own number, and every piece is computed once.
        let compute = |member, number| unsafe { sweeping.compute(member, number) };
        team.for_each_number_in_turns(count, compute, |member, turn| {
            while let Some(number) = sweeping.leftovers.take(member, turn) {
                // SAFETY: nobody else has taken it.
                unsafe { sweeping.finish_stored(number) };
            }
        });
    }

    /// The sum of all contacts' energies, group by group: the same for any number of threads.
    pub(crate) fn energies(&self) -> ContactEnergies {
        let mut sum = ContactEnergies::<Lanes<8>>::default();
        for group in self.groups() {
            sum += group.energies;
        }
        sum.sum_lanes()
    }

    /// Adds the force of every wall on the particles to its place in `forces`.
    pub(crate) fn add_wall_forces(&self, forces: &mut [Vector3]) {
        for group in self.groups() {
            for (sum, &force) in forces.iter_mut().zip(&group.wall_forces) {
                *sum += force;
            }
        }
    }

    /// Number of candidate contacts.
    pub(crate) fn candidates(&self) -> usize {
        self.groups().map(ContactGroup::len).sum()
    }

    /// Memory of the whole table [byte].
    pub(crate) fn memory_size(&self) -> usize {
        let sums: usize = self.sums.iter().map(Sums::memory_size).sum();
        let listings: usize = self.listings.iter().map(Listing::memory_size).sum();
        let halos = 2 * size_of_val(&self.halos[..]) + sums + listings;
        self.groups().map(ContactGroup::memory_size).sum::<usize>() + halos
    }
}
