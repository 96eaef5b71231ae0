//! Level 4 of the house: experiments.
//!
//! [`protocol`]: a scenario's stages, run one after another. [`collision`]: two bodies head on, one contact, to round-off or with the engine's time step.

pub mod collision;
pub mod protocol;
