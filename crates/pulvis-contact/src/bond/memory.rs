//! What a bond remembers.

use pulvis_math::{Real, Vector3};

use crate::memory::Memory;

/// The state of bodies that are bonded.
pub const INTACT: f64 = 1.0;
/// The state of bodies whose bond has broken; zero is that of bodies that never were bonded.
pub const BROKEN: f64 = -1.0;

/// The column of the state among those of a bond.
pub const STATE: usize = 8;

/// The names of the columns, with units.
pub(super) const COLUMNS: &[&str] = &[
    "bond_shear_x [m]",
    "bond_shear_y [m]",
    "bond_shear_z [m]",
    "bond_bending_x [rad]",
    "bond_bending_y [rad]",
    "bond_bending_z [rad]",
    "bond_twist [rad]",
    "bond_overlap [m]",
    "bond_state [1]",
];

/// The memory of a bond.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BondMemory<R: Real> {
    /// Displacement of i against j along the surfaces [m].
    pub shear: Vector3<R>,
    /// Rotation of i against j across the line of centres [rad].
    pub bending: Vector3<R>,
    /// Rotation of i against j about the line of centres [rad].
    pub twist: R,
    /// Overlap at which the bond has no normal force; of a broken bond the overlap at which the contact begins, where the
    /// bond had taken its place [m].
    pub overlap: R,
    /// [`INTACT`], [`BROKEN`], or zero.
    pub state: R,
}

impl<R: Real> Memory<R> for BondMemory<R> {
    const COLUMNS: usize = COLUMNS.len();

    #[inline(always)]
    fn load(mut column: impl FnMut(usize) -> R) -> Self {
        let shear = Vector3::new(column(0), column(1), column(2));
        let bending = Vector3::new(column(3), column(4), column(5));
        Self { shear, bending, twist: column(6), overlap: column(7), state: column(STATE) }
    }

    #[inline(always)]
    fn store(&self, mut column: impl FnMut(usize, R)) {
        let Self { shear, bending, twist, overlap, state } = *self;
        column(0, shear.x);
        column(1, shear.y);
        column(2, shear.z);
        column(3, bending.x);
        column(4, bending.y);
        column(5, bending.z);
        column(6, twist);
        column(7, overlap);
        column(STATE, state);
    }
}
