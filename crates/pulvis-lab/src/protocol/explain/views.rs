//! Contacts and forces of a state as tables.

use pulvis_core::{ContactPartner, ParticleId, Simulation};
use pulvis_io::table::{Cell, Table, significant};
use pulvis_math::Vector3;

/// Digits of numbers in tables.
const DIGITS: usize = 4;

/// A contact as people are told of it.
pub(super) struct Seen {
    pub(super) first: ParticleId,
    pub(super) second: ContactPartner,
    /// Overlap over the smaller radius [1].
    pub(super) relative: f64,
    overlap: f64,
    normal_force: f64,
    /// Force on the first body [N].
    force: Vector3,
}

/// All contacts that touch, the deepest first; those that are NaN before them.
pub(super) fn contacts(simulation: &Simulation) -> Vec<Seen> {
    let particles = simulation.particles();
    let (rows, radii) = (particles.rows_by_id(), particles.radii());
    let radius = |id: ParticleId| radii[rows[id as usize]];
    let mut seen = Vec::new();
    simulation.for_each_contact(&mut |contact| {
        let one = radius(contact.first);
        let smaller = match contact.second {
            ContactPartner::Particle(other) => one.min(radius(other)),
            ContactPartner::Wall(_) => one,
        };
        seen.push(Seen {
            first: contact.first,
            second: contact.second,
            relative: contact.overlap / smaller,
            overlap: contact.overlap,
            normal_force: contact.normal_force,
            force: contact.force,
        });
    });
    seen.sort_by(|one, other| other.relative.abs_if_nan().total_cmp(&one.relative.abs_if_nan()));
    seen
}

/// NaN of either sign sorts before all numbers.
trait AbsIfNan {
    fn abs_if_nan(self) -> f64;
}

impl AbsIfNan for f64 {
    fn abs_if_nan(self) -> f64 {
        if self.is_nan() { f64::NAN.abs() } else { self }
    }
}

/// `particle 98` or `wall floor`.
pub(super) fn name(simulation: &Simulation, partner: ContactPartner) -> String {
    match partner {
        ContactPartner::Particle(id) => format!("particle {id}"),
        ContactPartner::Wall(place) => {
            format!("wall {}", simulation.walls().get(place).map_or("", |wall| wall.name.as_str()))
        }
    }
}

/// The fastest particle and its speed [m/s].
pub(super) fn fastest(simulation: &Simulation) -> Option<(ParticleId, f64)> {
    let particles = simulation.particles();
    let speeds = particles.velocities().iter().map(|velocity| velocity.norm()).enumerate();
    let (row, speed) = speeds.max_by(|(_, one), (_, other)| one.total_cmp(other))?;
    Some((particles.ids()[row], speed))
}

/// A table of the deepest contacts.
pub(super) fn deepest_contacts(simulation: &Simulation, most: usize) -> String {
    let columns =
        ["first", "second", "overlap/radius", "overlap [m]", "normal force [N]", "steps in its contact time"];
    let mut table = Table::new(columns);
    for contact in contacts(simulation).iter().take(most) {
        let steps = simulation.contact_time(contact.first, contact.second);
        let row = [
            Cell::from(format!("particle {}", contact.first)),
            name(simulation, contact.second).into(),
            contact.relative.into(),
            contact.overlap.into(),
            contact.normal_force.into(),
            steps.map(|time| time / simulation.time_step()).into(),
        ];
        // Every row has all columns.
        let _ = table.push(row);
    }
    if table.rows().is_empty() { "  none\n".to_owned() } else { table.to_text(DIGITS) }
}

/// A table of all forces on a particle.
pub(super) fn forces_on(simulation: &Simulation, id: ParticleId) -> String {
    let columns = ["from", "force x [N]", "force y [N]", "force z [N]", "overlap/radius"];
    let mut table = Table::new(columns);
    let mut push = |from: String, force: Vector3, overlap: Option<f64>| {
        let [x, y, z] = force.to_array();
        // Every row has all columns.
        let _ = table.push([from.into(), x.into(), y.into(), z.into(), Cell::from(overlap)]);
    };
    for contact in contacts(simulation) {
        if contact.first == id {
            push(name(simulation, contact.second), contact.force, Some(contact.relative));
        } else if contact.second == ContactPartner::Particle(id) {
            push(format!("particle {}", contact.first), contact.force * -1.0, Some(contact.relative));
        }
    }
    let particles = simulation.particles();
    if let Some(row) = particles.ids().iter().position(|known| *known == id) {
        push("gravity".to_owned(), simulation.background().gravity * particles.masses()[row], None);
        if let Some(force) = simulation.electrostatic_force(row) {
            push("all other charges".to_owned(), force, None);
        }
        let velocity = particles.velocities().iter().nth(row).unwrap_or(Vector3::zero());
        let [x, y, z, radius, mass] =
            [velocity.x, velocity.y, velocity.z, particles.radii()[row], particles.masses()[row]]
                .map(|value| significant(value, DIGITS));
        let table = table.to_text(DIGITS);
        return format!("{table}velocity ({x}, {y}, {z}) m/s, radius {radius} m, mass {mass} kg\n");
    }
    table.to_text(DIGITS)
}
