//! The contact under the indenter, step by step.

use super::ProbeSample;
use crate::branch::ruling_branch;
use pulvis_boundary::TemperatureProgram;
use pulvis_contact::bond::INTACT;
use pulvis_contact::conventions::LeverArm;
use pulvis_contact::normal::NormalSource;
use pulvis_contact::{
    ContactInputs, ContactKinematics, ContactModel, ContactResponse, NormalMotion, NormalResponse, Pair,
    ROOM_TEMPERATURE, bond,
};
use pulvis_input::Surroundings;
use pulvis_input::collision::Bodies;
use pulvis_math::Vector3;

/// Overlap, shear, roll and twist [m], or their rates [m/s].
pub(super) type Pose = [f64; 4];

/// How long a step of an infinitely slow path is said to take [s]. Contacts that depend on it are not led along one.
const ANY_TIME: f64 = 1.0;

/// What the contact answers at one instant.
#[derive(Clone, Copy)]
struct Answer {
    response: ContactResponse<f64>,
    /// Force that is recorded: without the weights by which a jump within a step is spread over its half kicks [N].
    force: f64,
    contact_radius: f64,
    /// Forces and torques against the four motions, those that did the work [N] and [N m/m].
    against: [f64; 4],
}

/// A contact that is led along a path.
pub(super) struct Indenter<'c> {
    contact: &'c ContactModel,
    pair: Pair,
    temperature: Option<&'c TemperatureProgram>,
    radii: [f64; 2],
    /// What the contact remembers.
    columns: Vec<f64>,
    scratch: Vec<f64>,
    /// Whether the path has times.
    timed: bool,
    time: f64,
    dissipated: f64,
    work: f64,
    last: Answer,
    legs: f64,
    pub(super) samples: Vec<ProbeSample>,
}

impl<'c> Indenter<'c> {
    /// The contact at the start of its path. The work that brought it there from afar is what it stores. A bond that forms
    /// at the start of a stage does so here.
    pub(super) fn new(
        contact: &'c ContactModel,
        bodies: &Bodies,
        surroundings: &'c Surroundings,
        start: Pose,
        timed: bool,
    ) -> Self {
        let radii = bodies.radii();
        let count = contact.memory_layout().columns();
        let nothing = NormalResponse::none();
        let mut indenter = Self {
            contact,
            pair: bodies.pair().with_quantities(surroundings.quantities_of(contact)),
            temperature: surroundings.temperature.as_ref(),
            radii,
            columns: vec![0.0; count],
            scratch: vec![0.0; count],
            timed,
            time: 0.0,
            dissipated: 0.0,
            work: 0.0,
            last: Answer {
                response: ContactResponse::default(),
                force: nothing.force,
                contact_radius: nothing.contact_radius,
                against: [0.0; 4],
            },
            legs: 0.0,
            samples: Vec::new(),
        };
        contact.form_bond(start[0], &mut indenter.columns);
        indenter.last = indenter.ask(&start, &[0.0; 4], 0.0, &[0.0; 4]);
        let energies = &indenter.last.response.energies;
        indenter.dissipated = energies.dissipated();
        indenter.work = energies.stored() + indenter.dissipated;
        indenter.record(&start, 0.0);
        indenter
    }

    /// Leads the contact straight from one pose to the next, in a `duration` [s] or infinitely slowly.
    pub(super) fn follow_leg(&mut self, from: &Pose, to: &Pose, duration: Option<f64>, points: u32) {
        let time_step = duration.map_or(ANY_TIME, |duration| duration / f64::from(points));
        let change = std::array::from_fn(|motion| (to[motion] - from[motion]) / f64::from(points));
        let rates = if duration.is_some() { change.map(|change: f64| change / time_step) } else { [0.0; 4] };
        if self.timed {
            // The rates jump at a turning point, and so do the forces of dashpots.
            self.last = self.ask(from, &[0.0; 4], 0.0, &rates);
            self.dissipated += self.last.response.energies.dissipated();
            if self.last.force != self.samples.last().map_or(self.last.force, |sample| sample.force) {
                self.record(from, 0.0);
            }
        }
        for point in 1..=points {
            let share = f64::from(point) / f64::from(points);
            // The ends exactly as prescribed.
            let pose = if point == points {
                *to
            } else {
                std::array::from_fn(|motion| from[motion] + (to[motion] - from[motion]) * share)
            };
            let before = self.last;
            self.last = self.ask(&pose, &change, time_step, &rates);
            self.book(&before, &change, time_step);
            self.record(&pose, share);
        }
        self.legs += 1.0;
    }

    /// Books what was done and lost in a step.
    fn book(&mut self, before: &Answer, change: &Pose, time_step: f64) {
        let (old, new) = (&before.response.energies, &self.last.response.energies);
        self.dissipated += new.dissipated();
        for (motion, change) in change.iter().enumerate() {
            self.work += 0.5 * (before.against[motion] + self.last.against[motion]) * change;
        }
        if self.timed {
            self.time += time_step;
            self.dissipated += 0.5 * (old.viscous_power + new.viscous_power) * time_step;
        }
    }

    fn record(&mut self, pose: &Pose, share: f64) {
        let [overlap, shear, roll, twist] = *pose;
        let Answer { response, force, contact_radius, against } = &self.last;
        let lever = self.pair.harmonic_radius();
        self.samples.push(ProbeSample {
            time: self.timed.then_some(self.time),
            leg: self.legs + share,
            overlap,
            force: *force,
            contact_radius: *contact_radius,
            stored_energy: response.energies.stored(),
            dissipated: self.dissipated,
            branch: ruling_branch(self.contact, &self.pair, self.radii, overlap, &self.columns),
            shear,
            shear_force: against[1],
            roll,
            roll_torque: against[2] * lever,
            twist,
            twist_torque: against[3] * lever,
            work: self.work,
        });
    }

    /// Lets the contact answer to a pose after a step of `change`, at the end of which the bodies move with `rates`.
    fn ask(&mut self, pose: &Pose, change: &Pose, time_step: f64, rates: &Pose) -> Answer {
        let mid = if time_step > 0.0 { change.map(|change| change / time_step) } else { *rates };
        let mut motion = self.kinematics(pose[0], &mid, rates, [pose[0]; 2]);
        let middle = self.time + 0.5 * time_step;
        let temperature = self.temperature.map_or(ROOM_TEMPERATURE, |program| program.at(middle));
        self.scratch.copy_from_slice(&self.columns);
        let inputs = ContactInputs { pair: &self.pair, motion: &motion, time_step, temperature };
        let beside = self.contact.beside_bond(inputs, &mut self.scratch);
        let along = NormalMotion::new(&self.pair, &beside, time_step, temperature);
        let normal = self.contact.normal.respond(&along, self.scratch.as_mut_slice());
        // Sliding takes its lever arms at mid-step, of a contact that began within the step in the middle of its part.
        let part = if along.growth > 0.0 && normal.in_contact && !normal.was_in_contact {
            along.overlap.max(0.0) / along.growth
        } else {
            1.0
        };
        let bonded = self.is_bonded();
        let overlap = if normal.in_contact || bonded { pose[0] } else { 0.0 };
        motion = self.kinematics(pose[0], &mid, rates, [overlap - 0.5 * part * change[0], overlap]);
        let step = [time_step, temperature];
        let response = self.contact.respond_at(&self.pair, &motion, step, &mut self.columns);
        Answer {
            force: response.normal_force - response.event_force,
            contact_radius: normal.contact_radius,
            against: self.against(&response, overlap),
            response,
        }
    }

    /// The motion of the bodies: they turn against each other by half of the rolling and twisting each, and i moves along
    /// the surface so that this does not shear the contact. The lever arms belong to the `overlaps` at mid-step and now.
    fn kinematics(
        &self,
        overlap: f64,
        mid: &Pose,
        rates: &Pose,
        overlaps: [f64; 2],
    ) -> ContactKinematics<f64> {
        let lever = self.pair.harmonic_radius();
        let velocities = |rates: &Pose, overlap: f64| {
            let spin = Vector3::new(rates[3], 0.0, rates[2]) * (0.5 / lever);
            let [arm_i, arm_j] = self.arms(overlap);
            let velocity = Vector3::new(-rates[0], rates[1] + spin.z * (arm_i - arm_j), 0.0);
            (velocity, spin)
        };
        let (velocity_mid, spin_mid) = velocities(mid, overlaps[0]);
        let (velocity, spin) = velocities(rates, overlaps[1]);
        ContactKinematics {
            normal: Vector3::new(1.0, 0.0, 0.0),
            overlap,
            inverse_distance: 0.0,
            normal_rate: None,
            radius_i: self.radii[0],
            radius_j: self.radii[1],
            velocity,
            velocity_mid,
            angular_velocity_i: spin,
            angular_velocity_j: -spin,
            angular_velocity_i_mid: spin_mid,
            angular_velocity_j_mid: -spin_mid,
        }
    }

    /// Whether a bond holds.
    fn is_bonded(&self) -> bool {
        let slots = *self.contact.memory_layout().slots();
        self.contact.laws.bond.is_some() && self.columns[slots.bond() + bond::STATE] == INTACT
    }

    /// The lever arms of the sliding force about the two centres, as the contact's convention has them, or those of a beam
    /// that bonds the bodies [m].
    fn arms(&self, overlap: f64) -> [f64; 2] {
        if self.is_bonded() && self.contact.laws.bond.is_some_and(|bond| bond.springs.at_mid_length()) {
            return [0.5 * (self.radii[0] + self.radii[1] - overlap); 2];
        }
        let shorter = match self.contact.laws.conventions.lever_arm {
            LeverArm::Corrected => 0.5 * overlap,
            LeverArm::Radius => 0.0,
        };
        self.radii.map(|radius| radius - shorter)
    }

    /// The forces against the four motions. Of the torque on i that of the sliding force is not against rolling.
    fn against(&self, response: &ContactResponse<f64>, overlap: f64) -> [f64; 4] {
        let [arm_i, _] = self.arms(overlap);
        let (force, torque) = (response.force, response.torque_i);
        let lever = self.pair.harmonic_radius();
        // force × x has the z-component −f_y.
        let rolling = torque.z + force.y * arm_i;
        // Differences, so that nothing is zero and not minus zero.
        [response.normal_force, 0.0 - force.y, 0.0 - rolling / lever, 0.0 - torque.x / lever]
    }
}
