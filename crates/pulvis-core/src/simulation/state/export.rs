//! Export of a state.

use pulvis_math::Packed4;

use super::{CellState, GroupRecord, ListState, ParticleState, State, WallRecord};
use crate::neighbours::{ListedWall, Moved, Skin};
use crate::particles::{ForceTorque, Particles};
use crate::simulation::{Group, Outcome, Simulation};
use crate::walls::{Wall, WallState};

impl Simulation {
    /// Everything that decides the next bit. The simulation itself does not change.
    pub fn export_state(&self) -> State {
        debug_assert!(self.knows_everything(), "contacts of other ranks are not known");
        // A new field must be listed here: decide whether it affects the next bit.
        let Self {
            particles,
            // Given again at the import.
            interactions: _,
            walls,
            wall_states,
            wall_starts,
            groups,
            domain,
            cell,
            background,
            temperature,
            time_step,
            step,
            time,
            contacts,
            broken_bonds,
            // Filled and used up in a rebuild.
            memory: _,
            former_rows,
            // Affect the speed only.
            pool: _,
            instructions: _,
            pointers: _,
            phases: _,
            ranks: _,
            // Stop the simulation, but change no bit.
            limits: _,
            first_deep: _,
            accounting,
            // Follow from the particles.
            materials: _,
            outcomes,
            pass,
            // Written in every step before they are read.
            tree: _,
            charges: _,
            row_sums: _,
            walls_now: _,
            on_particles: _,
            skin,
            chooses_skin,
            mean_radius,
            running,
            rebuilds,
        } = self;
        let (memory, active) = contacts.export(&particles.id);
        let list = ListState {
            rebuilds: *rebuilds,
            chooses_skin: *chooses_skin,
            mean_radius: *mean_radius,
            former_row: former_rows.clone(),
            active,
            ..list_of(skin, outcomes)
        };
        State {
            step: *step,
            time: *time,
            time_step: *time_step,
            domain: *domain,
            cell: CellState { motion: cell.motion, listed: cell.listed, numbers: cell.numbers() },
            background: *background,
            temperature: temperature.clone(),
            keeps_ledger: *accounting,
            next_id: particles.next_id,
            particles: particles_of(particles),
            walls: walls_of(walls, wall_states, wall_starts, &skin.walls),
            groups: groups.iter().map(group_of).collect(),
            list,
            memory,
            totals: pass.observed,
            broken_bonds: broken_bonds.pairs().to_vec(),
            ledger: running.numbers(),
        }
    }
}

fn particles_of(particles: &Particles) -> ParticleState {
    let Particles {
        id,
        material,
        radius,
        mass,
        position,
        velocity,
        angular_velocity,
        forces_and_torques,
        // Written at the beginning of a step, before they are read.
        velocity_predicted: _,
        angular_velocity_predicted: _,
        applied,
        // Follows from positions and charges.
        electrostatic: _,
        columns,
        next_id: _,
        // Follows from the groups.
        any_prescribed: _,
    } = particles;
    let vectors = |column: &[Packed4]| column.iter().map(|packed| packed.vector.to_array()).collect();
    // The halo sums of the last step follow those of the rows.
    let of_rows = &forces_and_torques[..id.len()];
    ParticleState {
        id: id.clone(),
        material: material.clone(),
        radius: radius.clone(),
        mass: mass.clone(),
        position: vectors(position),
        velocity: vectors(velocity),
        angular_velocity: vectors(angular_velocity),
        force: of_rows.iter().map(|ForceTorque { force, .. }| force.vector.to_array()).collect(),
        torque: of_rows.iter().map(|ForceTorque { torque, .. }| torque.vector.to_array()).collect(),
        applied_force: vectors(applied),
        columns: columns.clone(),
    }
}

fn walls_of(walls: &[Wall], states: &[WallState], starts: &[f64], listed: &[ListedWall]) -> Vec<WallRecord> {
    let record = |(((wall, state), start), listed): (((&Wall, &WallState), &f64), &ListedWall)| WallRecord {
        name: wall.name.clone(),
        present: wall.present,
        point: wall.point.to_array(),
        listed_point: listed.point.to_array(),
        angle: wall.angle,
        listed_angle: listed.angle,
        motion_start: *start,
        motion: state.numbers(),
    };
    walls.iter().zip(states).zip(starts).zip(listed).map(record).collect()
}

fn group_of(group: &Group) -> GroupRecord {
    // Rows follow from ids.
    let Group { name, ids, rows: _, motion, start, travelled, work } = group;
    GroupRecord {
        name: name.clone(),
        ids: ids.clone(),
        motion: *motion,
        start: *start,
        travelled: travelled.to_array(),
        work: *work,
    }
}

/// The parts of skins and integration that belong to the neighbour list.
fn list_of(skin: &Skin, outcomes: &[Outcome]) -> ListState {
    let Skin { thickest, thinnest, positions, walls: _, steps } = skin;
    let mut list = ListState {
        steps: *steps,
        skin_thickest: *thickest,
        skin_thinnest: *thinnest,
        position: positions.iter().map(|listed| listed.vector.to_array()).collect(),
        radius_with_skin: positions.iter().map(|listed| listed.scalar).collect(),
        ..ListState::default()
    };
    // The speeds and powers of the last kicks are not used again.
    for Outcome { kicked: _, moved: Moved { longest, second, left }, seconds: _ } in outcomes {
        list.displacement_largest.push(*longest);
        list.displacement_second.push(*second);
        list.remaining_skin.push(*left);
    }
    list
}
