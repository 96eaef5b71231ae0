//! Bonds: stiffness, breaking, and what two bonded bodies keep while they tumble.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

mod bodies;
mod energy;
mod stiffness;
mod strength;
