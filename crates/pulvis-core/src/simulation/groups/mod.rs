//! Groups of particles, and particles whose motion is prescribed: held where they are, or led along a path.
//!
//! A prescribed particle is a piece of wall in the shape of a sphere. Its inverse mass is zero in the columns, so that kicks
//! leave its velocity as it is, without a branch in the loop over particles. For the same reason the reduced mass of a contact
//! with it is the mass of the other body, 1/m_r = 1/m + 0: that is the mass which the contact moves, so that dashpots which are
//! made for a restitution give this restitution. Two prescribed particles do not act on each other, and none acts on walls:
//! neither could give way, and a reduced mass would be infinite.
//!
//! The ledger treats them as walls: they have no kinetic energy, and the work that leads them is `work_walls`.

mod lead;

use pulvis_boundary::GroupMotion;
use pulvis_math::Vector3;

use super::{SetupError, Simulation};
use crate::particles::ParticleId;

/// Particles with a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    pub(super) name: String,
    /// Ids of its particles, ascending.
    pub(super) ids: Vec<ParticleId>,
    /// Their rows, in the order of the ids.
    pub(super) rows: Vec<u32>,
    pub(super) motion: GroupMotion,
    /// When the present motion began [s].
    pub(super) start: f64,
    /// Displacement since then, of motions that translate \[m\].
    pub(super) travelled: Vector3,
    /// Work done on the other particles, and on its own against gravity and drag, so far \[J\].
    pub(super) work: f64,
}

impl Group {
    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The ids of its particles, ascending. Particles that are removed leave the group.
    pub fn ids(&self) -> &[ParticleId] {
        &self.ids
    }

    /// How it moves.
    pub fn motion(&self) -> &GroupMotion {
        &self.motion
    }

    /// Work that has been done on the sample by leading it \[J\]; part of the ledger's `work_walls`.
    pub fn work(&self) -> f64 {
        self.work
    }

    fn is_led(&self) -> bool {
        self.motion.is_led() && !self.rows.is_empty()
    }
}

/// Force and torque of everything else on a group: of contacts and attractions, not of gravity, drag and what a program applies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupLoad {
    /// Force [N].
    pub force: Vector3,
    /// Torque about `point` [N m].
    pub torque: Vector3,
    /// A point of the axis where the group rotates, otherwise its centre of mass; of positions within the domain along
    /// periodic directions \[m\].
    pub point: Vector3,
}

/// Groups. Their particles are given by ids; who is inserted later belongs to none.
impl Simulation {
    /// Makes a group, or gives one of this name other particles; then it is free. An id may be given twice.
    ///
    /// # Errors
    /// There is no particle with one of the ids.
    pub fn set_group(&mut self, name: &str, ids: &[ParticleId]) -> Result<(), SetupError> {
        let mut members = ids.to_vec();
        members.sort_unstable();
        members.dedup();
        let mut known = self.particles.id.clone();
        known.sort_unstable();
        if let Some(&id) = members.iter().find(|id| known.binary_search(id).is_err()) {
            return Err(SetupError::NotInGroup { name: name.to_owned(), id });
        }
        match self.groups.iter().position(|group| group.name == name) {
            Some(index) => {
                if self.groups[index].motion.is_prescribed() {
                    self.set_group_motion(name, GroupMotion::Free)?;
                }
                self.groups[index].ids = members;
            }
            None => self.groups.push(Group {
                name: name.to_owned(),
                ids: members,
                rows: Vec::new(),
                motion: GroupMotion::Free,
                start: self.time,
                travelled: Vector3::zero(),
                work: 0.0,
            }),
        }
        self.find_rows_of_groups();
        Ok(())
    }

    /// Holds a group, leads it, or sets it free. Particles that are held or led keep no memory of contacts among themselves;
    /// bonds between two of them are gone when they are free again. Who becomes free keeps the velocity that it has.
    ///
    /// # Errors
    /// There is no such group; the motion cannot be; a particle of it is prescribed by another group; a rotation would carry
    /// particles along a periodic direction; or the periodic cell deforms.
    pub fn set_group_motion(&mut self, name: &str, motion: GroupMotion) -> Result<(), SetupError> {
        let index = self.groups.iter().position(|group| group.name == name);
        let index = index.ok_or_else(|| SetupError::NoGroup { name: name.to_owned() })?;
        self.check_group_motion(index, &motion)?;
        self.switch(|simulation| {
            simulation.start_group_motion(index, motion);
            simulation.renew_candidates();
        });
        Ok(())
    }

    fn check_group_motion(&self, index: usize, motion: &GroupMotion) -> Result<(), SetupError> {
        let group = &self.groups[index];
        let refused = |problem: String| Err(SetupError::GroupMotion { name: group.name.clone(), problem });
        if let Err(invalid) = motion.check() {
            return refused(invalid.to_string());
        }
        if !motion.is_prescribed() {
            return Ok(());
        }
        if self.cell.motion.moves() {
            return refused("its motion is prescribed, but it cannot follow a cell that deforms".to_owned());
        }
        if let GroupMotion::Rotation(rotation) = motion {
            // The way of a particle off the axis has a part along every direction that the axis is not along.
            let along = |axis: usize| {
                let unit = rotation.axis * (1.0 / rotation.axis.norm());
                (unit[axis].abs() - 1.0).abs() < 1e-12
            };
            if let Some(axis) = (0..3).find(|&axis| self.domain.period(axis).is_some() && !along(axis)) {
                let name = ["x", "y", "z"][axis];
                return refused(format!("it cannot rotate through {name}, which is periodic"));
            }
        }
        let others = self.groups.iter().enumerate();
        for (_, other) in others.filter(|(other, group)| *other != index && group.motion.is_prescribed()) {
            let both = group.ids.iter().find(|id| other.ids.binary_search(id).is_ok());
            if let Some(id) = both {
                let problem = format!("its particle {id} is held or led by the group `{}`", other.name);
                return refused(problem);
            }
        }
        Ok(())
    }

    fn start_group_motion(&mut self, index: usize, motion: GroupMotion) {
        let group = &mut self.groups[index];
        (group.motion, group.start, group.travelled) = (motion, self.time, Vector3::zero());
        for &row in &group.rows {
            let row = row as usize;
            self.particles.prescribe(row, motion.is_prescribed());
            if motion.is_prescribed() {
                let position = self.particles.position[row].vector;
                self.particles.velocity[row].vector = motion.velocity(position, 0.0);
                self.particles.angular_velocity[row].vector = motion.angular_velocity();
            }
        }
        self.note_prescribed();
    }

    pub(super) fn note_prescribed(&mut self) {
        let holds = |group: &Group| group.motion.is_prescribed() && !group.rows.is_empty();
        self.particles.any_prescribed = self.groups.iter().any(holds);
    }

    /// All groups, in the order in which they were made.
    pub fn groups(&self) -> &[Group] {
        &self.groups
    }

    /// The group of this name.
    pub fn group(&self, name: &str) -> Option<&Group> {
        self.groups.iter().find(|group| group.name == name)
    }

    /// Force and torque on a group, as of the end of the last advance.
    pub fn group_load(&self, group: &Group) -> GroupLoad {
        let (particles, background) = (&self.particles, &self.background);
        let rows = || group.rows.iter().map(|&row| row as usize);
        let point = match &group.motion {
            GroupMotion::Rotation(rotation) => rotation.point,
            _ => {
                let moments = rows().map(|row| particles.position[row].vector * particles.mass[row]);
                let mass: f64 = rows().map(|row| particles.mass[row]).sum();
                moments.fold(Vector3::zero(), |sum, moment| sum + moment) * (1.0 / mass)
            }
        };
        let (mut force, mut torque) = (Vector3::zero(), Vector3::zero());
        for row in rows() {
            let position = particles.position[row];
            let (velocity, turning) =
                (particles.velocity[row].vector, particles.angular_velocity[row].vector);
            let drag = background.drag_on(velocity, turning, position.scalar);
            let of_all = &particles.forces_and_torques[row];
            let applied = particles.applied.get(row).map_or(Vector3::zero(), |applied| applied.vector);
            let outer = background.gravity * particles.mass[row] - drag.force + applied;
            let of_contacts = of_all.force.vector - outer;
            force += of_contacts;
            torque += (position.vector - point).cross(of_contacts) + of_all.torque.vector + drag.torque;
        }
        GroupLoad { force, torque, point }
    }

    /// Finds the rows of all groups in a new order of the particles. Who is no longer there leaves.
    pub(super) fn find_rows_of_groups(&mut self) {
        let members =
            || self.groups.iter().flat_map(|group| group.ids.first().into_iter().chain(group.ids.last()));
        let (Some(&least), Some(&most)) = (members().min(), members().max()) else { return };
        // Ids of a group lie near each other, as those of particles that came together do.
        let mut row_of = vec![u32::MAX; (most - least) as usize + 1];
        for (row, &id) in self.particles.id.iter().enumerate() {
            if (least..=most).contains(&id) {
                row_of[(id - least) as usize] = row as u32;
            }
        }
        let row_of = |id: ParticleId| row_of[(id - least) as usize];
        for group in &mut self.groups {
            group.ids.retain(|&id| row_of(id) != u32::MAX);
            group.rows.clear();
            group.rows.extend(group.ids.iter().map(|&id| row_of(id)));
        }
        self.note_prescribed();
    }
}
