//! The medium that charges act through.

/// Charges act on each other over all distances, through a medium that fills all space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Electrostatics {
    /// Relative permittivity ε_r of the medium, 1 in a vacuum [1].
    pub relative_permittivity: f64,
}

impl Electrostatics {
    /// The largest number of charged particles: every step takes the forces of all pairs, here of eight million.
    pub const MOST_CHARGES: usize = 4096;
}

impl Default for Electrostatics {
    fn default() -> Self {
        Self { relative_permittivity: 1.0 }
    }
}
