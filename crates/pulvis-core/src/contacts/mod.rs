//! The contact table: candidate pairs in blocks of eight, and what each contact remembers.

mod block;
mod interactions;
mod kernel;
mod layout;
mod rebuild;
mod view;

pub(crate) use block::{ContactGroup, Partner};
pub use interactions::Interactions;
pub(crate) use kernel::{Moving, Totals, WallMotionNow, pair_forces, wall_forces};
pub(crate) use rebuild::MemoryStore;
pub use view::{ContactPartner, ContactView};
pub(crate) use view::{Views, view_contacts};
