//! The contact loop: the same text for every law and instruction set.

mod batch;
mod bonds;
mod hand_over;
mod normal;
mod pairs;
mod walls;

use std::ops::Range;

use pulvis_math::{InstructionSet, Packed4, Simd8, max_or_nan};

use self::batch::{BlockSums, Response};
use self::normal::{StepMiddle, Wants};
use super::block::{ContactGroup, Partner};
use super::chunk::Approach;
use crate::columns::NamedColumn;
use crate::particles::ForceTorque;
use crate::shared::Shared;
use crate::walls::WallNow;
use pulvis_boundary::{Images, UpperTriangular};

/// The columns that contacts read. See [`Particles`](crate::Particles) for what the packed vectors hold.
#[derive(Clone, Copy)]
pub(crate) struct KinematicColumns<'a> {
    pub(crate) position: Shared<'a, Packed4>,
    /// Velocities at mid-step, which moved the positions.
    pub(crate) velocity_mid: Shared<'a, Packed4>,
    /// Velocities at the time of the positions.
    pub(crate) velocity: Shared<'a, Packed4>,
    pub(crate) angular_velocity_mid: Shared<'a, Packed4>,
    pub(crate) angular_velocity: Shared<'a, Packed4>,
    /// Quantities that laws may ask for.
    pub(crate) quantities: &'a [NamedColumn],
}

impl KinematicColumns<'_> {
    /// Prefetches a row, except the predicted angular velocity, which few contacts use.
    #[inline(always)]
    fn prefetch(&self, row: usize) {
        self.position.prefetch(row);
        self.velocity_mid.prefetch(row);
        self.velocity.prefetch(row);
        self.angular_velocity_mid.prefetch(row);
    }
}

/// The step that bodies have moved over, and options of the loop.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Advance {
    /// The step that led to the present positions [s].
    pub(crate) time_step: f64,
    /// Temperature in the middle of that step [K].
    pub(crate) temperature: f64,
    /// The nearest-image rule.
    pub(crate) images: Images,
    /// The flow that the cell carries all bodies along with, if it does.
    pub(crate) flow: Option<Flow>,
    /// Whether the time of each part is measured.
    pub(crate) timed: bool,
    /// Whether energies are summed up.
    pub(crate) ledger: bool,
    /// Whether stored energies are summed too. Dissipated energies must be summed in every step, stored energies only
    /// when they are asked for.
    pub(crate) stored: bool,
    /// The instruction set that loops use.
    pub(crate) instructions: InstructionSet,
    /// Whether laws of common contacts are called through pointers too.
    pub(crate) pointers: bool,
}

/// The velocity gradient of a flow [1/s]: what it adds to the relative velocity of two bodies over the way from one to the
/// other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flow {
    /// Of the middle of the step, for the way at its end.
    pub(crate) mid: UpperTriangular,
    /// At the end of the step.
    pub(crate) end: UpperTriangular,
}

/// Computes a group's contacts, particle pairs or contacts with a wall, and adds their forces and torques to `sums`.
///
/// # Safety
/// The group's rows lie within the columns of `moving`, its walls within `walls`, and its slots within `sums`; no other
/// thread writes those rows meanwhile.
pub(crate) unsafe fn sweep(
    group: &mut ContactGroup,
    sums: &mut [ForceTorque],
    moving: KinematicColumns<'_>,
    walls: &[WallNow],
    advance: &Advance,
    approach: Approach,
    prefetch: Prefetch<'_>,
) {
    let partner = group.partner;
    let approach = match partner {
        Partner::Particle => approach.pairs,
        Partner::Wall => approach.walls,
    };
    let contacts = Loop { group, sums, moving, advance, approach, prefetch };
    // SAFETY: the caller's.
    match partner {
        Partner::Particle => unsafe { pairs::sweep(contacts) },
        Partner::Wall => unsafe { walls::sweep(contacts, walls) },
    }
}

/// The inputs of the blocks of a group.
#[inline(always)]
fn response<C>(call: C, group: &ContactGroup, advance: &Advance, ledger: bool) -> Response<C> {
    let (laws, slots) = (group.model.laws, *group.layout.slots());
    let with_memory = laws.remembers_normal_motion(&slots);
    let Advance { time_step, temperature, stored, .. } = *advance;
    // Both are needed at the end of an advance only.
    let observed = stored;
    Response { call, laws, slots, time_step, temperature, with_memory, ledger, stored, observed }
}

/// What a pointed loop tells the normal law of the step.
fn step_middle(advance: &Advance) -> StepMiddle {
    StepMiddle { time_step: advance.time_step, temperature: advance.temperature }
}

/// Which parts of a normal law's response the loop over a group uses.
fn wants(group: &ContactGroup, advance: &Advance) -> Wants {
    let (laws, normal) = (&group.model.laws, &group.model.normal);
    let rate = !normal.stiffness_is_bounded();
    Wants {
        energy: advance.ledger && advance.stored,
        losses: advance.ledger && laws.remembers_normal_motion(group.layout.slots()),
        hardening: laws.viscosity.needs_hardening(),
        stiffness: rate || laws.viscosity.needs_stiffness() || laws.needs_normal_stiffness(),
        radius: laws.needs_contact_radius(),
        rate,
    }
}

/// Stores the sums over the blocks of a group.
#[inline(always)]
fn finish<R: Simd8>(group: &mut ContactGroup, totals: &BlockSums<R>) {
    group.energies = totals.energies.to_array();
    group.totals = totals.totals.to_array();
    let rates = totals.rate_squared.to_array();
    group.rate_squared = rates.0.iter().copied().fold(0.0, max_or_nan);
}

/// The inputs of a loop over a group.
struct Loop<'a> {
    group: &'a mut ContactGroup,
    sums: &'a mut [ForceTorque],
    moving: KinematicColumns<'a>,
    advance: &'a Advance,
    /// Upper bound of how much a gap can have closed since the last rebuild [m].
    approach: f64,
    prefetch: Prefetch<'a>,
}

/// Largest number of rows that are prefetched in one round.
const MOST_ROWS: usize = 16;

/// What the next chunk is likely to need.
#[derive(Debug, Default)]
pub(crate) struct Prefetch<'a> {
    /// Rows to prefetch, consecutive.
    pub(crate) rows: Range<usize>,
    /// Rows to prefetch, scattered.
    pub(crate) halo: &'a [u32],
    /// Sums to zero.
    pub(crate) sums: &'a mut [ForceTorque],
}

impl Prefetch<'_> {
    /// How much of each to handle in each of so many rounds.
    #[inline(always)]
    fn in_rounds(&self, rounds: usize) -> [usize; 3] {
        // With few contacts there is little work to hide many prefetches behind.
        let rows = self.rows.len().div_ceil(rounds).min(MOST_ROWS);
        let halo = self.halo.len().div_ceil(rounds).min(MOST_ROWS);
        // Two packed vectors in a cache line.
        [rows.next_multiple_of(2), halo, self.sums.len().div_ceil(rounds)]
    }

    /// Prefetches some of the rows and zeroes some of the sums.
    #[inline(always)]
    fn make_ready(&mut self, moving: KinematicColumns<'_>, [rows, halo, sums]: [usize; 3]) {
        let end = (self.rows.start + rows).min(self.rows.end);
        for row in (self.rows.start..end).step_by(2) {
            moving.prefetch(row);
        }
        self.rows.start = end;
        let (near, later) = self.halo.split_at(halo.min(self.halo.len()));
        for &row in near {
            moving.prefetch(row as usize);
        }
        self.halo = later;
        let left = std::mem::take(&mut self.sums);
        let (near, later) = left.split_at_mut(sums.min(left.len()));
        for sum in near {
            *sum = ForceTorque::default();
        }
        self.sums = later;
    }
}
