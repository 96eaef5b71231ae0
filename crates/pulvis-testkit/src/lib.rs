//! Suites that every law of the catalogue must pass. Test code, used as a dev-dependency only.
//!
//! The suites read the catalogue's lists: a newly listed law is tested without another line. A
//! suite asserts; where it fails, the law, its parameters and the seed of the case are printed.
//!
//! | module | checks |
//! |---|---|
//! | [`catalogue`] | descriptions are complete, examples build, wrong values are refused |
//! | [`normal`] | forces along the line of centres: energy, continuity, history, lanes |
//! | [`noncontact`] | attraction at a distance: potential, reach, hysteresis, lanes |
//! | [`viscosity`] | dashpots: sign, bound, lanes |
//! | [`friction`] | sliding, rolling and torsion: no path gives work back, energies close |
//! | [`contact`] | whole contacts: frame, exchange, mirror, rotation, energy, lanes |
//! | [`bodies`] | two spheres or a sphere and a wall, integrated, for closed forms |
//! | [`collisions`] | head-on collisions with a wall, integrated, for closed forms |
//! | [`loading`] | contacts at rest at one overlap after the other, for published points |
//! | [`oscillation`] | frequencies of two bodies about their contact |
//! | [`reference`] | a whole engine without lists, for the fast one to be held against |
//!
//! `PULVIS_TESTKIT_CASES` multiplies the number of random cases, `PULVIS_TESTKIT_SEED` moves them.

// All of this is test code: a failed expectation is a failed test.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

pub mod bodies;
pub mod bond;
mod cases;
pub mod catalogue;
pub mod collisions;
pub mod contact;
mod draw;
pub mod friction;
mod lanes;
mod live;
pub mod loading;
pub mod noncontact;
pub mod normal;
pub mod oscillation;
pub mod parameters;
pub mod reference;
pub mod viscosity;

pub use cases::for_each_case;
pub use draw::Draw;
pub use live::{LiveContact, Springs};
