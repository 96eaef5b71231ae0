//! Whether the bodies of a contact will part: what it costs to pull them apart, against how fast they move.

use super::view::{ContactView, Views, respond};
use pulvis_contact::ContactKinematics;
use pulvis_math::Vector3;

/// Pieces of the way along which the bodies are pulled apart. Work by the trapezoidal rule is then within 1e-3 of that of the
/// laws there are.
const PIECES: usize = 400;

/// What holds the bodies of a contact together, and what drives them apart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Binding {
    /// Work that it takes to pull the bodies apart slowly from where they are, with what the contact remembers now; the most of
    /// it on the way, so that energy that comes back later does not count \[J\]. Zero where they are driven apart more than they
    /// are held.
    pub work_to_part: f64,
    /// Kinetic energy of the relative motion along the normal, m_r v_n²/2 with the reduced mass of the two bodies, towards each
    /// other or apart \[J\].
    pub relative_energy: f64,
}

impl Binding {
    /// Whether the motion does not suffice to part the bodies. It is the two bodies that are looked at: what else moves with
    /// them, and the dashpot, are not.
    pub fn is_bound(&self) -> bool {
        self.relative_energy < self.work_to_part
    }
}

/// Calls `see` with every contact of a group that acts, and what holds it.
pub(crate) fn view_bindings(views: Views<'_>, see: &mut dyn FnMut(&ContactView<'_>, &Binding)) {
    let mut columns = Vec::new();
    views.each(&mut |block, lane, view| {
        columns.clear();
        columns.extend_from_slice(view.memory);
        if let Some(binding) = views.binding(block, lane, &mut columns) {
            see(view, &binding);
        }
    });
}

impl Views<'_> {
    /// What holds a contact; `columns` are its memory, which is spent on it.
    fn binding(&self, block: usize, lane: usize, columns: &mut [f64]) -> Option<Binding> {
        let group = self.group;
        let mut seen = self.geometry(group.first_row(block, lane) as usize, block, lane)?;
        let speed = seen.motion.velocity.dot(seen.motion.normal);
        let relative_energy = 0.5 * seen.pair.reduced_mass() * speed * speed;
        let start = seen.motion.overlap;
        let piece = (start.max(0.0) + group.interaction_range) / PIECES as f64;
        // Slowly: no dashpot acts, and nothing slides.
        let zero = Vector3::zero();
        seen.motion = ContactKinematics {
            velocity: zero,
            velocity_mid: zero,
            angular_velocity_i: zero,
            angular_velocity_j: zero,
            angular_velocity_i_mid: zero,
            angular_velocity_j_mid: zero,
            normal_rate: None,
            ..seen.motion
        };
        let (mut work, mut work_to_part) = (0.0_f64, 0.0_f64);
        let mut before = respond(group, &seen, columns).normal_force;
        for number in 1..=PIECES {
            seen.motion.overlap = start - piece * number as f64;
            let now = respond(group, &seen, columns).normal_force;
            work -= 0.5 * piece * (before + now);
            work_to_part = work_to_part.max(work);
            before = now;
        }
        Some(Binding { work_to_part, relative_energy })
    }
}
