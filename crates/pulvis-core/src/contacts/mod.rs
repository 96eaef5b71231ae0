//! The contact table: neighbour pairs in blocks of eight, and the memory of each contact.

mod among_ranks;
mod binding;
mod block;
mod bonds;
mod chunk;
mod force_pass;
mod interactions;
mod kernel;
mod listing;
mod rebuild;
mod records;
mod row_set;
mod search;
mod sums;
mod table;
mod totals;
mod view;

pub(crate) use among_ranks::{HaloParts, Known};
pub use binding::Binding;
pub(crate) use binding::view_bindings;
pub(crate) use block::ContactGroup;
pub(crate) use bonds::BrokenBonds;
pub use bonds::{BondCount, BrokenBond};
pub(crate) use chunk::Chunk;
pub(crate) use force_pass::Sweep;
pub use interactions::Interactions;
pub(crate) use kernel::{Advance, Flow, KinematicColumns};
pub(crate) use rebuild::MemoryStore;
pub use records::{ContactRecords, MemoryColumn, MemoryError};
pub(crate) use table::{ContactTable, Surroundings};
pub use totals::ContactTotals;
pub use view::{ContactPartner, ContactView};
pub(crate) use view::{Deep, Views, view_contacts};
