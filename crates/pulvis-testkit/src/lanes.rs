//! How many contacts the suites compute side by side.

use pulvis_math::F64Array;

/// Two: enough for contacts on different branches, and a quarter of the code that eight of every law would be. The
/// engine's own widths give the bits of the plain number, too: `pulvis-math` tests it operation by operation, and
/// `pulvis-core` run by run.
pub(crate) const LANES: usize = 2;

/// Numbers of [`LANES`] contacts.
pub(crate) type Lanes = F64Array<LANES>;
