//! The contact loop: the same text for every law and instruction set.

mod batch;
mod pairs;
mod walls;

use std::ops::Range;

use pulvis_math::{InstructionSet, Quad, Vector3};

use self::pairs::PairSweep;
use self::walls::WallSweep;
use super::block::{ContactGroup, Partner};
use super::piece::Closed;
use crate::domain::Images;
use crate::particles::Load;
use crate::shared::Shared;

/// The columns that contacts read. See [`Particles`](crate::Particles) for what the quads hold.
#[derive(Clone, Copy)]
pub(crate) struct Moving<'a> {
    pub(crate) place: Shared<'a, Quad>,
    /// Velocities at mid-step, which moved the positions.
    pub(crate) velocity_mid: Shared<'a, Quad>,
    /// Velocities at the time of the positions.
    pub(crate) velocity: Shared<'a, Quad>,
    pub(crate) spin_mid: Shared<'a, Quad>,
    pub(crate) spin: Shared<'a, Quad>,
}

impl Moving<'_> {
    /// Has a row brought near, but for predicted spins, which few contacts look at.
    #[inline(always)]
    fn prefetch(&self, row: usize) {
        self.place.prefetch(row);
        self.velocity_mid.prefetch(row);
        self.velocity.prefetch(row);
        self.spin_mid.prefetch(row);
    }
}

/// A plane wall at the time of the positions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WallMotionNow {
    /// Unit normal, pointing to the particles.
    pub(crate) normal: Vector3,
    /// Place of the plane along its normal [m].
    pub(crate) offset: f64,
    /// Velocity at mid-step [m/s].
    pub(crate) velocity_mid: Vector3,
    /// Velocity at the time of the positions [m/s].
    pub(crate) velocity: Vector3,
}

/// Over which step bodies have moved, and how the loop is to run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advance {
    /// The step that led to the present positions [s].
    pub(crate) time_step: f64,
    /// The nearest-image rule.
    pub(crate) images: Images,
    /// Whether times are taken.
    pub(crate) timed: bool,
    /// Whether energies are summed up.
    pub(crate) ledger: bool,
    /// What the processor can do.
    pub(crate) instructions: InstructionSet,
}

/// Computes a group's contacts, particle pairs or contacts with a wall, and adds their loads to `sums`.
///
/// # Safety
/// The group's rows lie within the columns of `moving`, its walls within `walls`, its places of sums within `sums`, and nobody
/// writes those rows meanwhile.
pub(crate) unsafe fn sweep(
    group: &mut ContactGroup,
    sums: &mut [Load],
    moving: Moving<'_>,
    walls: &[WallMotionNow],
    advance: &Advance,
    closed: Closed,
    ahead: Ahead<'_>,
) {
    let normal = group.model.normal;
    let partner = group.partner;
    let closed = match partner {
        Partner::Particle => closed.pairs,
        Partner::Wall => closed.walls,
    };
    let contacts = Loop { group, sums, moving, advance, closed, ahead };
    match partner {
        Partner::Particle => normal.accept(PairSweep(contacts)),
        Partner::Wall => normal.accept(WallSweep(contacts, walls)),
    }
}

/// What a loop works on.
struct Loop<'a> {
    group: &'a mut ContactGroup,
    sums: &'a mut [Load],
    moving: Moving<'a>,
    advance: &'a Advance,
    /// By how much a gap can have closed at the most since the candidates were listed [m].
    closed: f64,
    ahead: Ahead<'a>,
}

/// Rows that are likely to be needed next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ahead<'a> {
    /// One behind the other.
    pub(crate) rows: Range<usize>,
    /// Here and there.
    pub(crate) halo: &'a [u32],
}

impl Loop<'_> {
    /// Has the next `count` of the rows ahead brought near.
    #[inline(always)]
    fn look_ahead(moving: Moving<'_>, ahead: &mut Ahead<'_>, counts: [usize; 2]) {
        let end = (ahead.rows.start + counts[0]).min(ahead.rows.end);
        // Two quads in a cache line.
        for row in (ahead.rows.start..end).step_by(2) {
            moving.prefetch(row);
        }
        ahead.rows.start = end;
        let (near, later) = ahead.halo.split_at(counts[1].min(ahead.halo.len()));
        for &row in near {
            moving.prefetch(row as usize);
        }
        ahead.halo = later;
    }
}
