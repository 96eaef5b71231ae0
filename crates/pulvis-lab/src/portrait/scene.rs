//! Scenarios around the example of a law.

use pulvis_contact::catalogue::{Kind, LawEntry, Parameter, Presence, Range, Role};
use pulvis_math::Dimension;

use super::path;

/// The bodies of every picture.
const BODIES: &str = "bodies = \"pair\"\nradius = \"1 mm\"\ndensity = \"2500 kg/m^3\"\n";

/// Normal laws that other laws are shown beside, the plainest first.
const HOSTS: [&str; 3] = [
    "law = \"linear\"\nk = \"100 N/m\"",
    "law = \"hertz\"\neffective_modulus = \"1e8 Pa\"",
    "law = \"jkr\"\neffective_modulus = \"1e8 Pa\"\nwork_of_adhesion = \"0.1 N/m\"",
];

/// Speeds of collisions [m/s].
const SPEEDS: [f64; 4] = [0.1, 0.01, 1.0, 10.0];

/// Steps on each leg of a path: enough for smooth curves in a file of moderate size.
const POINTS: u32 = 80;

/// Normal laws that dashpots are shown beside.
const HOSTS_OF_DASHPOTS: [&str; 3] = [
    "law = \"linear\"\nk = \"100 N/m\"",
    "law = \"hertz\"\neffective_modulus = \"1e8 Pa\"",
    "law = \"hertz\"\neffective_modulus = \"4e10 Pa\"",
];

/// What the bodies are surrounded by: nothing that a law would read, or else a temperature.
const SURROUNDINGS: [&str; 2] = ["", "temperature = \"505 K\"\n"];

/// How long a leg takes where it is not known what is a good time, for a draft [s].
const ANY_DURATION: f64 = 1.0e-3;

/// The laws of a contact that shows the example: the example alone if it is a normal law, or beside others.
fn contacts(entry: &LawEntry) -> Vec<String> {
    let table = |role: Role, law: &str| format!("\n[contact.{}]\n{law}\n", role.key());
    if entry.role == Role::Normal {
        return vec![table(Role::Normal, entry.example)];
    }
    let hosts = if entry.role == Role::Viscosity { HOSTS_OF_DASHPOTS } else { HOSTS };
    let beside = table(entry.role, entry.example);
    // On a path no stage starts.
    let beside = if entry.role == Role::Bond { beside + "form = \"first-touch\"\n" } else { beside };
    hosts.iter().map(|host| table(Role::Normal, host) + &beside).collect()
}

/// Collisions that show the example of a dashpot, at speeds of all scales.
pub(super) fn collisions(entry: &LawEntry) -> Vec<String> {
    let bodies = bodies(entry);
    let text = |speed: &f64, contact: &str| {
        let speed = quoted(*speed, "m/s");
        format!("title = \"{}\"\n\n[collision]\n{bodies}velocity = {speed}\n{contact}", entry.name)
    };
    let contacts = contacts(entry);
    SPEEDS.iter().flat_map(|speed| contacts.iter().map(move |contact| text(speed, contact))).collect()
}

/// The bodies of the picture of a law, with the quantities that it reads.
fn bodies(entry: &LawEntry) -> String {
    // What only some variants read is not for the example.
    let read = entry.particle_quantities.iter().filter(|quantity| quantity.presence == Presence::Required);
    let quantities = read.map(|quantity| {
        let Parameter { name, kind, .. } = quantity;
        let (size, signed) = match kind {
            Kind::Number { dimension: Dimension::LENGTH, range, .. } => {
                (0.01 * path::RADIUS, *range == Range::Any)
            }
            Kind::Number { range, .. } => (1.0e-10, *range == Range::Any),
            Kind::Choice(_) | Kind::Numbers { .. } => (0.0, false),
        };
        // Of opposite signs, for attraction.
        let values = [size, if signed { -size } else { size }].map(|value| quoted(value, &quantity.unit()));
        format!("{name} = [{}]\n", values.join(", "))
    });
    quantities.fold(BODIES.to_owned(), |text, line| text + &line)
}

/// The laws of a contact, to be led along a path.
#[derive(Clone)]
pub(super) struct Scene<'e> {
    entry: &'e LawEntry,
    contact: String,
    surroundings: &'static str,
    /// Whether the path has times.
    timed: bool,
}

impl<'e> Scene<'e> {
    /// Scenes that may show a law, the plainest first.
    pub(super) fn all(entry: &'e LawEntry) -> Vec<Self> {
        let mut scenes = Vec::new();
        for contact in contacts(entry) {
            for surroundings in SURROUNDINGS {
                for timed in [false, true] {
                    scenes.push(Self { entry, contact: contact.clone(), surroundings, timed });
                }
            }
        }
        scenes
    }

    /// A scenario with any path.
    pub(super) fn draft(&self) -> String {
        self.with_path(path::paths(self.entry.role).swap_remove(0), ANY_DURATION)
    }

    /// Scenarios with paths of all scales, and durations of all scales if the path has times.
    pub(super) fn candidates(&self) -> Vec<String> {
        let durations = if self.timed { path::durations() } else { vec![ANY_DURATION] };
        let mut texts = Vec::new();
        for turns in path::paths(self.entry.role) {
            texts.extend(durations.iter().map(|duration| self.with_path(turns.clone(), *duration)));
        }
        texts
    }

    fn with_path(&self, [overlap, other]: [Vec<f64>; 2], duration: f64) -> String {
        let lengths = |turns: &[f64]| {
            let texts: Vec<String> = turns.iter().map(|turn| quoted(*turn, "m")).collect();
            format!("[{}]", texts.join(", "))
        };
        let mut text = format!(
            "title = \"{}\"\n{}\n[probe]\n{}",
            self.entry.name,
            self.surroundings,
            bodies(self.entry)
        );
        text += &format!("overlap = {}\n", lengths(&overlap));
        let motion = match self.entry.role {
            Role::Sliding => Some("shear"),
            Role::Rolling => Some("roll"),
            Role::Torsion => Some("twist"),
            _ => None,
        };
        if let Some(motion) = motion {
            text += &format!("{motion} = {}\n", lengths(&other));
        }
        text += &format!("points = {POINTS}\n");
        if self.timed {
            let legs = vec![quoted(duration, "s"); overlap.len() - 1];
            text += &format!("durations = [{}]\n", legs.join(", "));
        }
        text + &self.contact
    }
}

/// A quantity as a scenario has it, with two digits.
fn quoted(value: f64, unit: &str) -> String {
    if value == 0.0 { format!("\"0 {unit}\"") } else { format!("\"{value:.1e} {unit}\"") }
}
