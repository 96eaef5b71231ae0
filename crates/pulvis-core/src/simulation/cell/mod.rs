//! A periodic cell that deforms.
//!
//! Velocities of particles are *peculiar*: relative to the homogeneous flow V(x) = G x of the cell, of which a particle has
//! no part of its own. An image of a particle then has the velocity of the particle, and two particles approach each other
//! with c_i − c_j + G (x_i − x_j), whichever images they are: nothing in a cell can tell where its boundary or its origin is.
//!
//! ```text
//! x' = c + G x,    m c' = f − m G c,    dE/dt = −V σ : G,    V σ = Σ m c ⊗ c + Σ f ⊗ b
//! ```
//!
//! For a shear of constant rate, and for a length that grows at a constant speed, these are Newton's equations of
//! v = c + G x. The energy E is that of the peculiar motion and of the contacts.
//!
//! # Source
//! D. J. Evans and G. P. Morriss, Statistical Mechanics of Nonequilibrium Liquids, 2nd ed. (2008), section 6.3: the
//! SLLOD equations of motion, and the work that a flow does.

mod flow;
mod record;

use pulvis_boundary::{CellContent, CellMotion, Domain, UpperTriangular};
use pulvis_math::Vector3;

use super::errors::{Alarm, StepError};
use super::{SetupError, Simulation};
use crate::contacts::Flow;
use crate::neighbours::Carried;

/// The largest strain of a cell in a time step [1]: touching particles then approach each other by a fiftieth of a radius at
/// most.
pub(super) const MOST_STRAIN: f64 = 1e-2;

/// How the cell deforms, and what that keeps between steps.
#[derive(Clone, Debug)]
pub(crate) struct Cell {
    pub(super) motion: CellMotion,
    /// When the present motion began [s].
    start: f64,
    /// The particles when it began.
    content: CellContent,
    /// The velocity gradient of the last step [1/s].
    pub(super) rate: UpperTriangular,
    /// V σ at the end of the last step [J].
    stress: [[f64; 3]; 3],
    /// Work done on the particles so far [J].
    pub(super) work: f64,
    /// The time integral of the velocity gradient since the beginning of the simulation [1].
    strain: UpperTriangular,
    /// The deformation since the last rebuild of the neighbour list, and the domain at that time.
    pub(super) since_list: UpperTriangular,
    pub(super) listed: Domain,
}

impl Cell {
    /// A cell that does not deform.
    pub(super) fn new(domain: Domain) -> Self {
        Self {
            motion: CellMotion::default(),
            start: 0.0,
            content: CellContent::default(),
            rate: UpperTriangular::ZERO,
            stress: [[0.0; 3]; 3],
            work: 0.0,
            strain: UpperTriangular::ZERO,
            since_list: UpperTriangular::IDENTITY,
            listed: domain,
        }
    }

    /// Whether the cell is another one than at the last rebuild of the neighbour list.
    pub(super) fn has_deformed(&self) -> bool {
        self.since_list != UpperTriangular::IDENTITY
    }
}

impl Simulation {
    /// Sets how the periodic cell deforms from now on: each component of its velocity gradient at a rate or under a stress.
    /// The middle of the block of the [domain](Self::domain) stays where it is. All velocities of particles, and the
    /// kinetic energy of the ledger, are relative to the flow of the cell from now on; the work that the cell does is booked
    /// as `work_cell`. Drag acts against the motion relative to the flow.
    ///
    /// # Errors
    /// A component deforms along a direction that is not periodic; a wall is present, the motion of a group is prescribed, or
    /// there is gravity: none can follow the cell; a number cannot be, or a rate strains the cell by more than a hundredth in a time step.
    pub fn set_cell_motion(&mut self, motion: CellMotion) -> Result<(), SetupError> {
        super::checks::check_cell_motion(&motion, &self.domain, self.time_step)?;
        if motion.moves() {
            self.check_surroundings_of_cell()?;
        }
        self.switch(|simulation| {
            simulation.cell.motion = motion;
            simulation.cell.start = simulation.time;
            simulation.cell.content = simulation.content();
            // Dashpots see the new rate at once. What follows a stress starts with the next step.
            simulation.cell.rate = motion.prescribed();
        });
        Ok(())
    }

    fn check_surroundings_of_cell(&self) -> Result<(), SetupError> {
        let refused = |problem: String| Err(SetupError::Cell { problem });
        if let Some(wall) = self.walls.iter().find(|wall| wall.present) {
            return refused(format!("the wall `{}` is there, which cannot follow it", wall.name));
        }
        if let Some(group) = self.groups.iter().find(|group| group.motion().is_prescribed()) {
            let name = group.name();
            return refused(format!(
                "the motion of the group `{name}` is prescribed, which cannot follow it"
            ));
        }
        let gravity = self.background.gravity;
        if gravity != Vector3::zero() {
            return refused(format!(
                "there is gravity, ({}, {}, {}) m/s²: a cell without a bottom has no height",
                gravity.x, gravity.y, gravity.z
            ));
        }
        Ok(())
    }

    /// How the cell deforms.
    pub fn cell_motion(&self) -> &CellMotion {
        &self.cell.motion
    }

    /// The velocity gradient ∂v_a/∂x_b of the cell in the last step [1/s]; zero where it does not deform.
    pub fn cell_rate(&self) -> UpperTriangular {
        self.cell.rate
    }

    /// The time integral of the velocity gradient since the beginning [1]: logarithmic strains, positive for extension, and
    /// shear strains, which do not fall back where the tilt loses a period.
    pub fn cell_strain(&self) -> UpperTriangular {
        self.cell.strain
    }

    /// V σ = Σ m c ⊗ c + Σ f ⊗ b now [J], compression positive: over the volume of the cell, its stress. f is the force
    /// on the first body of a contact, b the way to it from the second.
    pub fn stress_times_volume(&self) -> [[f64; 3]; 3] {
        let mut sums = self.pass.observed.virial;
        let kinetic = self.kinetic_tensor();
        for (entry, [row, column]) in UpperTriangular::INDICES.into_iter().enumerate() {
            sums[row][column] += kinetic[entry];
            if row != column {
                sums[column][row] += kinetic[entry];
            }
        }
        sums
    }

    /// Σ m c_a c_b over all particles for ab = xx, yy, zz, xy, xz and yz [J].
    pub fn kinetic_tensor(&self) -> [f64; 6] {
        let particles = &self.particles;
        self.pool.sum_over(particles.len(), |rows| {
            let mut sums = [0.0; 6];
            for row in rows {
                let (mass, velocity) = (particles.mass[row], particles.velocity[row].vector);
                for (sum, [one, other]) in sums.iter_mut().zip(UpperTriangular::INDICES) {
                    *sum += mass * velocity[one] * velocity[other];
                }
            }
            sums
        })
    }

    fn content(&self) -> CellContent {
        let particles = &self.particles;
        let count = particles.len().max(1) as f64;
        let mass = particles.mass.iter().sum::<f64>();
        let diameter = 2.0 * particles.radius.iter().sum::<f64>() / count;
        CellContent { diameter, density: mass / particles.total_volume() }
    }

    /// What the contact loop knows of the flow in a step [s]; `None` where there is none. Of a step of no duration the
    /// middle is its end.
    pub(super) fn flow(&self, time_step: f64) -> Option<Flow> {
        let end = self.cell.rate;
        let half = UpperTriangular::IDENTITY + end * (0.5 * time_step);
        (end != UpperTriangular::ZERO).then(|| Flow { mid: half.inverse().after(&end), end })
    }

    /// Whether the cell deforms in this step, in which no wall must then be.
    pub(super) fn cell_moves(&self) -> Result<bool, StepError> {
        let moves = self.cell.motion.moves();
        match self.walls.iter().find(|wall| moves && wall.present) {
            Some(wall) => Err(self.alarm(Alarm::WallInMovingCell { wall: wall.name.clone() })),
            None => Ok(moves),
        }
    }

    /// By how much the deformation since the last rebuild can have brought each of two particles nearer to the other,
    /// beside their displacements relative to it [m].
    ///
    /// Two that were b apart are |F b + u| ≥ s b − u₁ − u₂ apart, with the least stretch s of F and displacements u. A gap
    /// g = b − R of two that may touch at R has closed by no more than (1 − s) b + u₁ + u₂, and it still is open where
    /// s g > (1 − s) R + u₁ + u₂. This is (1/s − 1) times what such two can have between their centres, a half for each.
    pub(super) fn closing_of_cell(&self) -> f64 {
        if !self.cell.has_deformed() {
            return 0.0;
        }
        (1.0 / self.cell.since_list.least_stretch() - 1.0) * 0.5 * self.search_radius()
    }

    /// Where the flow has carried what was listed at the last rebuild; `None` where it has not.
    pub(super) fn carried(&self) -> Option<Carried> {
        self.cell
            .has_deformed()
            .then(|| Carried { gradient: self.cell.since_list, middle: self.domain.middle() })
    }

    /// Fits the skin to the present periods before a rebuild.
    pub(super) fn fit_skin_to_cell(&mut self) -> Result<(), StepError> {
        if self.chooses_skin && self.check_periods().is_err() {
            self.choose_first_skin();
        }
        match self.check_periods() {
            Err(SetupError::ShortPeriod { axis, period, least }) => {
                Err(self.alarm(Alarm::CellTooNarrow { axis, period, least }))
            }
            _ => Ok(()),
        }
    }

    /// A new list is made for the present cell.
    pub(super) fn note_list_of_cell(&mut self) {
        (self.cell.since_list, self.cell.listed) = (UpperTriangular::IDENTITY, self.domain);
    }
}
