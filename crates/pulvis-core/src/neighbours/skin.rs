//! When the neighbour list is out of date.

use std::ops::Range;

use pulvis_boundary::UpperTriangular;
use pulvis_math::{InstructionSet, Packed4, Vector3, max_or_nan};

use super::moved::{Moved, Survey, length_of};
use crate::particles::Particles;
use crate::thread_pool::ThreadPool;
use crate::walls::{Shape, Wall};

/// Where a wall was at a rebuild.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ListedWall {
    /// Reference point [m].
    pub(crate) point: Vector3,
    /// Angle by which it had turned [rad].
    pub(crate) angle: f64,
}

/// How far particles and walls may move before the neighbour list is rebuilt, and where they were at the last rebuild.
///
/// Every particle has a skin of its own. Two particles are neighbours if their skins overlap, and the list is valid as
/// long as no particle has left its skin. Fast particles have thick skins, so that a few of them do not cause rebuilds for
/// all.
#[derive(Clone, Debug, Default)]
pub(crate) struct Skin {
    /// The thickest and the thinnest skin of a particle [m].
    pub(crate) thickest: f64,
    pub(crate) thinnest: f64,
    /// Centres at the last rebuild [m], and radii with skins [m].
    pub(crate) positions: Vec<Packed4>,
    /// Where the walls were at the last rebuild.
    pub(crate) walls: Vec<ListedWall>,
    /// Steps since the last rebuild.
    pub(crate) steps: u64,
}

/// Where the flow of a cell has carried what stood somewhere at the last rebuild.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Carried {
    /// The deformation since then.
    pub(crate) gradient: UpperTriangular,
    /// What it has left where it was [m].
    pub(crate) middle: Vector3,
}

impl Carried {
    #[inline(always)]
    fn position(&self, before: Vector3) -> Vector3 {
        self.middle + self.gradient.times(before - self.middle)
    }
}

/// Steps that a list should last: a skin is as thick as the distance that its particle moves in that many steps. A rebuild
/// takes the time of some eight steps.
const LIFE: u64 = 250;
/// The thinnest skin, over the thickest one, lies between these.
const THINNEST: Range<f64> = 0.1..0.5;

/// Steps between two measurements of displacements. In between, the maximum speed bounds them: this avoids loading the
/// listed positions, which are not in any cache.
const SURVEY: u64 = 8;

impl Skin {
    /// Sets the skin of all particles [m], whatever their speed.
    pub(crate) fn set(&mut self, thickness: f64) {
        (self.thickest, self.thinnest) = (thickness, thickness);
    }

    /// Sets the thickest skin of a particle [m], and the thinnest one to its smallest value.
    pub(crate) fn set_thickest(&mut self, thickness: f64) {
        (self.thickest, self.thinnest) = (thickness, THINNEST.start * thickness);
    }

    /// The thickest and the thinnest skin [m].
    pub(crate) fn sizes(&self) -> [f64; 2] {
        [self.thickest, self.thinnest]
    }

    /// Sets the thickest and the thinnest skin [m].
    pub(crate) fn set_sizes(&mut self, [thickest, thinnest]: [f64; 2]) {
        (self.thickest, self.thinnest) = (thickest, thinnest);
    }

    /// Adapts the thinnest skin at a rebuild: halved if the slow particles moved no farther than their speed predicted,
    /// doubled if they moved more than twice as far.
    pub(crate) fn adapt(&mut self, positions: &[Packed4], pool: &ThreadPool) {
        let (listed, thinnest) = (&self.positions, self.thinnest);
        if thinnest == self.thickest {
            return;
        }
        let longest = pool.largest_over(positions.len(), |rows| {
            let way = |(now, before): (&Packed4, &Packed4)| {
                let thin = before.scalar - now.scalar < 1.01 * thinnest;
                if thin { (now.vector - before.vector).norm_squared() } else { 0.0 }
            };
            positions[rows.clone()].iter().zip(&listed[rows]).map(way).fold(0.0, max_or_nan)
        });
        // The largest displacement over the one that the speeds at the last rebuild predicted.
        let used = longest.sqrt() / thinnest * LIFE as f64 / self.steps.max(1) as f64;
        if used > 2.0 {
            self.thinnest = (2.0 * thinnest).min(THINNEST.end * self.thickest);
        } else if used < 1.2 {
            self.thinnest = (0.5 * thinnest).max(THINNEST.start * self.thickest);
        }
    }

    /// Gives all particles new skins at their present positions. `flow` is how fast the flow of a cell brings each particle
    /// nearer to its neighbours [m/s]; `time_step` in s.
    pub(crate) fn renew(&mut self, particles: &Particles, flow: f64, time_step: f64, pool: &ThreadPool) {
        let time = LIFE as f64 * time_step;
        let (thinnest, thickest) = (self.thinnest, self.thickest);
        pool.fill(&mut self.positions, particles.len(), |row| {
            let Packed4 { vector, scalar } = particles.position[row];
            // A NaN speed gives the thinnest skin.
            let way = (particles.velocity[row].vector.norm() + flow) * time;
            Packed4::new(vector, scalar + way.max(thinnest).min(thickest))
        });
        self.steps = 0;
    }

    /// Stores the positions of the walls.
    pub(crate) fn renew_walls(&mut self, walls: &[Wall]) {
        self.walls.clear();
        self.walls.extend(walls.iter().map(|wall| ListedWall { point: wall.point, angle: wall.angle }));
    }

    /// Follows a new order of the particles: row k is what was row `order[k]`.
    pub(crate) fn reorder(&mut self, order: &[u32], pool: &ThreadPool) {
        pool.reorder(&mut self.positions, order, &mut Vec::new());
    }

    /// Centres at the last rebuild [m], and radii with skins [m].
    pub(crate) fn positions(&self) -> &[Packed4] {
        &self.positions
    }

    /// The skin of walls [m].
    pub(crate) fn of_walls(&self) -> f64 {
        0.5 * self.thickest
    }

    /// Counts a step. Returns whether displacements are to be measured in it.
    pub(crate) fn count_step(&mut self) -> bool {
        self.steps += 1;
        self.steps.is_multiple_of(SURVEY)
    }

    /// How far the particles of some rows, now at `positions`, have moved since the last rebuild.
    pub(crate) fn moved(
        &self,
        rows: Range<usize>,
        positions: &[Packed4],
        instructions: InstructionSet,
    ) -> Moved {
        instructions.run(Survey { positions: &positions[rows.clone()], listed: &self.positions[rows] })
    }

    /// The same relative to a flow that has carried them along.
    pub(crate) fn moved_beside(&self, flow: &Carried, rows: Range<usize>, positions: &[Packed4]) -> Moved {
        let mut moved = Moved::default();
        for (now, before) in positions[rows.clone()].iter().zip(&self.positions[rows]) {
            let displacement = now.vector - flow.position(before.vector);
            moved.take_in(length_of(displacement), before.scalar - now.scalar);
        }
        moved
    }

    /// Lets a flow carry the listed positions along. The list is of no use afterwards.
    pub(crate) fn carry(&mut self, flow: &Carried) {
        for position in &mut self.positions {
            position.vector = flow.position(position.vector);
        }
    }

    /// Upper bound of how much nearer any wall has come to a particle since the last rebuild [m]. A rotation about the axis
    /// of symmetry brings a wall no nearer. NaN if a
    /// wall stands nowhere.
    pub(crate) fn moved_walls(&self, walls: &[Wall]) -> f64 {
        let approach = |(now, before): (&Wall, &ListedWall)| {
            let approach = now.shape.approach(now.point - before.point);
            if now.angle == before.angle {
                return approach;
            }
            approach + (now.angle - before.angle).abs() * now.shape.distance_from_axis()
        };
        walls.iter().zip(&self.walls).map(approach).fold(0.0, max_or_nan)
    }

    /// Whether the list is still valid, with the smallest remaining skin `left` [m] and walls that have moved by up to
    /// `walls` [m]. A body that has left its skin may meet one that is not its neighbour in the list.
    pub(crate) fn holds(&self, left: f64, walls: f64) -> bool {
        left >= 0.0 && walls <= self.of_walls()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_list_is_out_of_date_when_a_body_has_left_its_skin() {
        let skin = Skin { thickest: 0.2, thinnest: 0.1, ..Skin::default() };
        assert!(skin.holds(0.0, 0.1) && !skin.holds(0.0, 0.11));
        assert!(!skin.holds(-1e-9, 0.0) && !skin.holds(f64::NAN, 0.0));
    }

    #[test]
    fn a_list_is_out_of_date_when_any_wall_stands_nowhere() {
        let mut skin = Skin { thickest: 0.2, thinnest: 0.1, ..Skin::default() };
        let wall = |z: f64| Wall::fixed("wall", 0, Vector3::new(0.0, 0.0, z), Vector3::new(0.0, 0.0, 1.0));
        skin.renew_walls(&[0.0, 1.0, 2.0].map(wall));
        assert_eq!(skin.moved_walls(&[0.0, 1.05, 2.0].map(wall)), 1.05 - 1.0);
        for lost in 0..3 {
            let z = |number: usize| if number == lost { f64::NAN } else { number as f64 };
            let moved = skin.moved_walls(&[0, 1, 2].map(|number| wall(z(number))));
            assert!(!skin.holds(0.1, moved), "wall {lost} moved by {moved}");
        }
    }

    #[test]
    fn skins_become_thin_where_particles_stay_and_thick_where_they_come_near_their_ends() {
        let mut skin = Skin::default();
        skin.set_thickest(1.0);
        let mut adapted = |used: f64| {
            skin.steps = LIFE;
            for _ in 0..20 {
                let listed = |own: f64| Packed4::new(Vector3::zero(), 1.0 + own);
                // A fast one does not count.
                skin.positions = vec![listed(skin.thinnest), listed(1.0)];
                let positions =
                    [used * skin.thinnest, 0.9].map(|x| Packed4::new(Vector3::new(x, 0.0, 0.0), 1.0));
                skin.adapt(&positions, &ThreadPool::default());
            }
            skin.thinnest
        };
        assert_eq!(adapted(0.1), THINNEST.start);
        assert_eq!(adapted(1.5), THINNEST.start);
        assert_eq!(adapted(3.0), THINNEST.end);
        skin.set(0.3);
        skin.adapt(&[], &ThreadPool::default());
        assert_eq!((skin.thinnest, skin.thickest), (0.3, 0.3));
    }
}
