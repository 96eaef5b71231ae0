//! Import of a state.

use pulvis_math::{Packed4, Vector3};

use super::{CellState, GroupRecord, ListState, ParticleState, State, StateError, WallRecord};
use crate::columns::NumberReader;
use crate::contacts::{BrokenBonds, Interactions};
use crate::ledger::Running;
use crate::neighbours::{CellGrid, Moved, Skin};
use crate::particles::{ForceTorque, Particle, Particles};
use crate::simulation::cell::Cell;
use crate::simulation::{Group, Simulation};
use crate::walls::{Wall, WallState};

impl Simulation {
    /// A simulation that continues the exported one, with the same bits.
    ///
    /// `interactions` and `walls` are those of the exported simulation: contact models, and the names, materials,
    /// shapes, areas and motions of the walls. Where walls stand and whether they are there is taken from the state.
    /// Threads and instructions are the default ones.
    ///
    /// # Errors
    /// The state is damaged, or it is that of another system.
    pub fn import_state(
        interactions: Interactions,
        mut walls: Vec<Wall>,
        state: &State,
    ) -> Result<Self, StateError> {
        state.check(&walls)?;
        for (wall, record) in walls.iter_mut().zip(&state.walls) {
            wall.present = record.present;
            wall.point = Vector3::from(record.listed_point);
            wall.angle = record.listed_angle;
        }
        let particles = particles_of(&state.particles, state.next_id);
        let &State { background, time_step, .. } = state;
        let listed = state.cell.listed;
        let mut simulation =
            Self::without_list(particles, interactions, walls, listed, background, time_step);
        simulation.temperature.clone_from(&state.temperature);
        simulation.broken_bonds = BrokenBonds::new(&state.broken_bonds);
        simulation.take_in_groups(&state.groups);
        simulation.check_models()?;
        simulation.check_walls()?;
        simulation.remake_list(&state.list)?;
        simulation.contacts.import(&simulation.particles.id, &state.memory, &state.list.active)?;
        simulation.pass.observed = state.totals;
        simulation.go_to_present(state)?;
        simulation.sum_charges_of_all();
        Ok(simulation)
    }

    /// Before the list is made: particles whose motion is prescribed have no contacts among themselves.
    fn take_in_groups(&mut self, groups: &[GroupRecord]) {
        let group = |record: &GroupRecord| {
            let GroupRecord { name, ids, motion, start, travelled, work } = record.clone();
            let travelled = Vector3::from(travelled);
            Group { name, ids, rows: Vec::new(), motion, start, travelled, work }
        };
        self.groups = groups.iter().map(group).collect();
        self.find_rows_of_groups();
        for group in self.groups.iter().filter(|group| group.motion.is_prescribed()) {
            group.rows.iter().for_each(|&row| self.particles.prescribe(row as usize, true));
        }
    }

    /// Makes the neighbour list of the state again. Particles and walls are then where they were at that rebuild.
    fn remake_list(&mut self, list: &ListState) -> Result<(), StateError> {
        let listed = |(centre, radius): (&[f64; 3], &f64)| Packed4::new(Vector3::from(*centre), *radius);
        let positions: Vec<Packed4> = list.position.iter().zip(&list.radius_with_skin).map(listed).collect();
        for (position, listed) in self.particles.position.iter_mut().zip(&positions) {
            position.vector = listed.vector;
        }
        let mut unsorted = vec![Packed4::default(); positions.len()];
        for (&row, &listed) in list.former_row.iter().zip(&positions) {
            unsorted[row as usize] = listed;
        }
        self.skin = Skin {
            thickest: list.skin_thickest,
            thinnest: list.skin_thinnest,
            positions,
            steps: list.steps,
            ..Skin::default()
        };
        self.skin.renew_walls(&self.walls);
        (self.chooses_skin, self.mean_radius) = (list.chooses_skin, list.mean_radius);
        self.check_periods()?;
        let (grid, order) = CellGrid::sort(&self.domain, &unsorted, self.interactions.longest_range());
        if order != list.former_row {
            return Err(StateError::List { problem: "its particles come in another order".to_owned() });
        }
        self.list_candidates(&grid, &order);
        self.former_rows = order;
        let (blocks, found) = (self.contacts.blocks(), list.active.len());
        if blocks != found {
            let problem = format!("it has {blocks} blocks of contacts, but the state knows of {found}");
            return Err(StateError::List { problem });
        }
        let (chunks, found) = (self.outcomes.len(), list.displacement_largest.len());
        if chunks != found {
            let problem = format!("it has {chunks} chunks of rows, but the state knows of {found}");
            return Err(StateError::List { problem });
        }
        Ok(())
    }

    /// Moves particles, walls and counters to their values in the state.
    fn go_to_present(&mut self, state: &State) -> Result<(), StateError> {
        let ParticleState { position, force, torque, .. } = &state.particles;
        for (column, &now) in self.particles.position.iter_mut().zip(position) {
            column.vector = Vector3::from(now);
        }
        for ((row, &force), &torque) in self.particles.forces_and_torques.iter_mut().zip(force).zip(torque) {
            *row = ForceTorque {
                force: Packed4::new(Vector3::from(force), 0.0),
                torque: Packed4::new(Vector3::from(torque), 0.0),
            };
        }
        let ListState { displacement_largest, displacement_second, remaining_skin, .. } = &state.list;
        let moved = displacement_largest.iter().zip(displacement_second).zip(remaining_skin);
        for (outcome, ((&longest, &second), &left)) in self.outcomes.iter_mut().zip(moved) {
            outcome.moved = Moved { longest, second, left };
        }
        for (index, record) in state.walls.iter().enumerate() {
            let WallRecord { name, point, angle, motion_start, motion, .. } = record;
            self.walls[index].point = Vector3::from(*point);
            self.walls[index].angle = *angle;
            self.wall_starts[index] = *motion_start;
            self.wall_states[index] =
                WallState::from_numbers(NumberReader::new(&format!("wall `{name}`"), motion))?;
        }
        self.domain = state.domain;
        let CellState { motion, listed, numbers } = &state.cell;
        self.cell = Cell::from_numbers(*motion, *listed, NumberReader::new("the cell", numbers))?;
        self.running = Running::from_numbers(NumberReader::new("the energy ledger", &state.ledger))?;
        self.accounting = state.keeps_ledger;
        self.rebuilds = state.list.rebuilds;
        (self.step, self.time) = (state.step, state.time);
        Ok(())
    }
}

fn particles_of(state: &ParticleState, next_id: u32) -> Particles {
    let particle = |row: usize| Particle {
        material: state.material[row],
        radius: state.radius[row],
        mass: state.mass[row],
        position: state.position[row].into(),
        velocity: state.velocity[row].into(),
        angular_velocity: state.angular_velocity[row].into(),
    };
    let rows: Vec<Particle> = (0..state.id.len()).map(particle).collect();
    let mut particles = Particles::new(&rows);
    particles.id.clone_from(&state.id);
    particles.columns.clone_from(&state.columns);
    let applied = state.applied_force.iter().map(|&force| Packed4::new(Vector3::from(force), 0.0));
    particles.applied = applied.collect();
    particles.next_id = next_id;
    particles
}
