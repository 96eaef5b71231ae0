//! The contact table: candidate pairs in blocks of eight, and what each contact remembers.

mod block;
mod candidates;
mod interactions;
mod kernel;
mod layout;
mod leftovers;
mod listing;
mod piece;
mod rebuild;
mod row_set;
mod sweep;
mod table;
mod view;

pub use interactions::Interactions;
pub(crate) use kernel::{Advance, Moving, WallMotionNow};
pub(crate) use rebuild::MemoryStore;
pub(crate) use sweep::Sweep;
pub(crate) use table::{ContactTable, Surroundings};
pub use view::{ContactPartner, ContactView};
pub(crate) use view::{Views, view_contacts};
