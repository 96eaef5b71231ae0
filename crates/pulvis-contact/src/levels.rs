//! Levels of resistance for which the loop over contacts is compiled; each holds the one before.

/// No resistance at all.
pub const NONE: u8 = 0;
/// Resistance against sliding, if the contact has it.
pub const SLIDING: u8 = 1;
/// Resistance against sliding, rolling and torsion, whatever of them the contact has.
pub const ALL: u8 = 2;
