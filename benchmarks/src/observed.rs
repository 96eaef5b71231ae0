//! What the state looks like after the timed steps: the same numbers can be had from other codes.

use std::fmt::Write as _;
use std::path::Path;

use pulvis_core::{ContactPartner, Simulation};

use crate::failure::Failure;

/// The state in a few numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Observed {
    /// Kinetic energy of translation [J].
    pub(crate) kinetic: f64,
    /// Kinetic energy of rotation [J].
    pub(crate) rotational: f64,
    /// Contacts between particles.
    pub(crate) pairs: usize,
    /// Contacts with walls.
    pub(crate) at_walls: usize,
    /// Contacts with particles, per particle [1].
    pub(crate) coordination: f64,
    /// Mean overlap of contacts between particles [m].
    pub(crate) mean_overlap: f64,
}

impl Observed {
    /// Looks at the present state.
    pub(crate) fn of(simulation: &Simulation) -> Self {
        let (mut pairs, mut at_walls, mut overlaps) = (0, 0, 0.0);
        simulation.for_each_contact(&mut |contact| match contact.second {
            ContactPartner::Particle(_) if contact.overlap > 0.0 => {
                pairs += 1;
                overlaps += contact.overlap;
            }
            ContactPartner::Wall(_) if contact.overlap > 0.0 => at_walls += 1,
            _ => {}
        });
        let ledger = simulation.ledger();
        Self {
            kinetic: ledger.kinetic_translation,
            rotational: ledger.kinetic_rotation,
            pairs,
            at_walls,
            coordination: 2.0 * pairs as f64 / simulation.particles().len().max(1) as f64,
            mean_overlap: overlaps / pairs.max(1) as f64,
        }
    }
}

/// Writes the particles by id as a table `x y z r vx vy vz` (SI).
pub(crate) fn write_table(simulation: &Simulation, path: &Path) -> Result<(), Failure> {
    let particles = simulation.particles();
    let mut text = String::new();
    for row in particles.rows_by_id() {
        let (x, v) = (particles.positions()[row], particles.velocities()[row]);
        let radius = particles.radii()[row];
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{:e} {:e} {:e} {radius:e} {:e} {:e} {:e}", x.x, x.y, x.z, v.x, v.y, v.z);
    }
    std::fs::write(path, text).map_err(|cause| Failure::Write { path: path.to_owned(), cause })
}
