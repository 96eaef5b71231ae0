//! The reading layer, tested with a small schema of its own that uses every kind of value.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod document;
mod files;
mod schema;
