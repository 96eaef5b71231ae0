//! What stops a run.

use crate::context::Reported;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use pulvis_math::Dimension;

/// Limits beyond which a run stops with an error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Closing error of the energy ledger over the largest energy in motion so far [1]; infinite where the author
    /// does not want it.
    pub energy_error: f64,
    /// Overlap of two bodies over the smaller radius, at a wall over the radius [1]; may be infinite.
    pub overlap: f64,
    /// Speed of any particle [m/s]; may be infinite.
    pub speed: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { energy_error: 1e-2, overlap: 1.0, speed: f64::INFINITY }
    }
}

/// Reads `[limits]`.
pub(super) fn read_limits(root: &mut TableReader<'_>) -> Result<Limits, Reported> {
    let default = Limits::default();
    let Some(mut table) = root.optional_table("limits")? else { return Ok(default) };
    let rule = |dimension: Dimension| QuantityRule::of(dimension).above(0.0).or_infinite();
    let energy_error = table.or("energy_error", rule(Dimension::NONE), default.energy_error);
    let overlap = table.or("overlap", rule(Dimension::NONE), default.overlap);
    let speed = table.or("speed", rule(Dimension::VELOCITY), default.speed);
    table.finish();
    Ok(Limits { energy_error: energy_error?, overlap: overlap?, speed: speed? })
}
