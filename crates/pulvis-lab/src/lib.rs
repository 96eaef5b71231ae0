//! Level 4 of the house: experiments.
//!
//! [`collision`]: two bodies head on, one contact, to round-off or with the engine's time step.

pub mod collision;
