//! Level 4 of the house: experiments.
//!
//! [`protocol`]: a scenario's stages, run one after another. [`collision`]: two bodies, one contact, to round-off or with
//! the engine's time step. [`probe`]: one contact on a prescribed path. [`portrait`]: the picture of a law.
//! [`verification`]: contact laws against values that are not theirs. [`reproduction`]: figures of papers. [`study`]: a
//! scenario over seeds and values. [`rendering`]: pictures of the particles of a run. [`run_plot`]: charts of its time series.
//! [`analysis`]: coarse-grained fields of a run.

pub mod analysis;
mod at_once;
mod branch;
pub mod collision;
pub mod portrait;
pub mod probe;
pub mod protocol;
pub mod rendering;
pub mod reproduction;
pub mod run_plot;
pub mod study;
pub mod verification;
