//! What particles are coloured by.

use pulvis_input::Problem;
use pulvis_input::scenario::Scenario;
use pulvis_io::vtk::{Frame, Numbers, PolyData};

use super::error::RenderError;
use super::view::Direction;

/// What particles are coloured by.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Their speed.
    Speed,
    /// Their distance from the nearest particle along the line of sight.
    Depth,
    /// The mean stress in each, compression positive.
    Stress,
    /// Their touching contacts, walls included.
    Coordination,
    /// Their material.
    Material,
    /// A column of the frames; of vectors, the magnitude.
    Column(String),
}

/// Quantities that have names of their own.
const NAMED: [(&str, Quantity); 5] = [
    ("speed", Quantity::Speed),
    ("depth", Quantity::Depth),
    ("stress", Quantity::Stress),
    ("coordination", Quantity::Coordination),
    ("material", Quantity::Material),
];

/// Labels of columns of frames.
const LABELS: [(&str, &str); 8] = [
    ("radius", "radius [m]"),
    ("v", "speed [m/s]"),
    ("omega", "angular velocity [rad/s]"),
    ("f", "total force [N]"),
    ("torque", "total torque [N m]"),
    ("id", "number of the particle"),
    ("cluster", "smallest number in its group"),
    ("cluster_size", "particles in its group"),
];

impl Quantity {
    /// The quantity of a name; any other name is that of a column.
    pub fn named(name: &str) -> Self {
        let known = NAMED.into_iter().find(|(known, _)| *known == name);
        known.map_or_else(|| Self::Column(name.to_owned()), |(_, quantity)| quantity)
    }

    /// Its value for each particle. Depths are counted from the middle of the coordinates.
    ///
    /// # Errors
    /// The frame has no such column.
    pub(super) fn values(&self, frame: &Frame, direction: Direction) -> Result<Vec<f64>, RenderError> {
        let particles = &frame.particles;
        match self {
            Self::Speed => column(particles, "v"),
            Self::Depth => Ok(particles.points.iter().map(|&centre| direction.along(centre)).collect()),
            Self::Stress => stresses(frame),
            Self::Coordination => column(particles, "coordination"),
            Self::Material => column(particles, "type"),
            Self::Column(name) => column(particles, name),
        }
    }

    /// What stands beside the colour bar: quantity and unit.
    pub(super) fn label(&self, scenario: Option<&Scenario>) -> String {
        match self {
            Self::Speed => "speed [m/s]".to_owned(),
            Self::Depth => "depth [m]".to_owned(),
            Self::Stress => "mean stress [Pa]".to_owned(),
            Self::Coordination => "contacts of each particle".to_owned(),
            Self::Material => String::new(),
            Self::Column(name) => column_label(name, scenario),
        }
    }

    /// Whether it follows from the contacts.
    pub(super) fn needs_contacts(&self) -> bool {
        *self == Self::Stress
    }

    /// Whether its sign means something.
    pub(super) fn is_signed(&self) -> bool {
        *self == Self::Stress
    }
}

fn column_label(name: &str, scenario: Option<&Scenario>) -> String {
    if let Some((_, label)) = LABELS.iter().find(|(known, _)| *known == name) {
        return (*label).to_owned();
    }
    let words = name.replace('_', " ");
    let columns = scenario.map(Scenario::columns).unwrap_or_default();
    match columns.iter().find(|column| column.name == name) {
        Some(column) => format!("{words} [{}]", column.dimension.unit()),
        None => words,
    }
}

/// A column as numbers; of vectors, the magnitude.
fn column(particles: &PolyData, name: &str) -> Result<Vec<f64>, RenderError> {
    match particles.column(name) {
        Some(Numbers::Vector(values)) => {
            Ok(values.iter().map(|[x, y, z]| (x * x + y * y + z * z).sqrt()).collect())
        }
        Some(_) => Ok(particles.scalar(name).unwrap_or_default()),
        None => {
            let own = particles.columns.iter().map(|(name, _)| name.as_str());
            let all: Vec<&str> = NAMED.iter().map(|(name, _)| *name).chain(own).collect();
            Err(RenderError::Quantity(Box::new(Problem::unknown_choice(name, &all))))
        }
    }
}

/// The mean stress in each particle, Σ F_n l/(3 V): normal forces, and the distances l of the contact points from the
/// centre, over its volume; compression positive \[Pa\]. The contact point lies in the middle of the overlap of two
/// particles, and on a wall.
fn stresses(frame: &Frame) -> Result<Vec<f64>, RenderError> {
    let radii = column(&frame.particles, "radius")?;
    let mut sums = vec![0.0; radii.len()];
    for contact in Contacts::of(frame)?.iter() {
        let share = if contact.second.is_some() { 0.5 } else { 1.0 };
        for row in [contact.first, contact.second].into_iter().flatten() {
            sums[row] += contact.normal_force * (radii[row] - share * contact.overlap);
        }
    }
    let volume = |radius: f64| 4.0 / 3.0 * std::f64::consts::PI * radius * radius * radius;
    Ok(sums.iter().zip(&radii).map(|(sum, &radius)| sum / (3.0 * volume(radius))).collect())
}

/// The contacts of a frame, each with the rows of its particles.
pub(super) struct Contacts {
    first: Vec<Option<usize>>,
    second: Vec<Option<usize>>,
    normal_force: Vec<f64>,
    overlap: Vec<f64>,
    ends: Vec<[[f64; 3]; 2]>,
}

/// One contact.
pub(super) struct Contact {
    /// Row of the first particle.
    pub(super) first: Option<usize>,
    /// Row of the second one; `None` for a wall.
    pub(super) second: Option<usize>,
    /// Repulsion positive \[N\].
    pub(super) normal_force: f64,
    /// \[m\]
    pub(super) overlap: f64,
    /// What it joins \[m\].
    pub(super) ends: [[f64; 3]; 2],
}

impl Contacts {
    /// # Errors
    /// The frame has not the columns that a run writes.
    pub(super) fn of(frame: &Frame) -> Result<Self, RenderError> {
        // A frame without contacts does not even name their columns.
        let has_none = frame.contacts.points.is_empty();
        let integers = |data: &PolyData, name: &'static str| match data.column(name) {
            Some(Numbers::Integer(values)) => Ok(values.clone()),
            None if has_none && name != "id" => Ok(Vec::new()),
            _ => Err(RenderError::Column(name)),
        };
        let scalars = |name| match frame.contacts.scalar(name) {
            Some(values) => Ok(values),
            None if has_none => Ok(Vec::new()),
            None => Err(RenderError::Column(name)),
        };
        let ids = integers(&frame.particles, "id")?;
        // Frames list particles in the order of their ids.
        let rows = |ids_of: Vec<i64>| ids_of.iter().map(|id| ids.binary_search(id).ok()).collect();
        Ok(Self {
            first: rows(integers(&frame.contacts, "id1")?),
            second: rows(integers(&frame.contacts, "id2")?),
            normal_force: scalars("normal_force")?,
            overlap: scalars("overlap")?,
            ends: frame.contacts.lines(),
        })
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Contact> + '_ {
        (0..self.ends.len()).map(|contact| Contact {
            first: self.first[contact],
            second: self.second[contact],
            normal_force: self.normal_force[contact],
            overlap: self.overlap[contact],
            ends: self.ends[contact],
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn numbers(name: &str, values: &[f64]) -> (String, Numbers) {
        (name.to_owned(), Numbers::Scalar(values.to_vec()))
    }

    fn integers(name: &str, values: &[i64]) -> (String, Numbers) {
        (name.to_owned(), Numbers::Integer(values.to_vec()))
    }

    /// A sphere of radius 1 pressed between two walls and one of radius 2 that pulls at it.
    fn pressed() -> Frame {
        let particles = PolyData {
            points: vec![[0.0; 3], [2.9, 0.0, 0.0]],
            columns: vec![
                integers("id", &[4, 9]),
                numbers("radius", &[1.0, 2.0]),
                ("v".to_owned(), Numbers::Vector(vec![[3.0, 0.0, 4.0], [0.0; 3]])),
            ],
        };
        let contacts = PolyData {
            points: vec![[0.0; 3]; 6],
            columns: vec![
                integers("id1", &[4, 4, 4]),
                integers("id2", &[-1, -2, 9]),
                numbers("normal_force", &[6.0, 6.0, -3.0]),
                numbers("overlap", &[0.2, 0.2, 0.1]),
            ],
        };
        Frame { particles, contacts, walls: PolyData::default(), surfaces: PolyData::default() }
    }

    #[test]
    fn the_mean_stress_is_that_of_the_normal_forces() {
        let stresses = Quantity::Stress.values(&pressed(), Direction::default()).unwrap();
        let volume = 4.0 / 3.0 * std::f64::consts::PI;
        let expected = [(2.0 * 6.0 * 0.8 - 3.0 * 0.95) / (3.0 * volume), -3.0 * 1.95 / (24.0 * volume)];
        for (found, expected) in stresses.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        }
    }

    #[test]
    fn names_are_those_of_quantities_or_of_columns() {
        assert_eq!(Quantity::named("speed"), Quantity::Speed);
        let values = |name: &str| Quantity::named(name).values(&pressed(), Direction::default());
        assert_eq!(values("speed").unwrap(), [5.0, 0.0]);
        assert_eq!(values("v").unwrap(), [5.0, 0.0]);
        assert_eq!(values("radius").unwrap(), [1.0, 2.0]);
        let message = values("radios").unwrap_err().to_string();
        assert!(message.contains("radios") && message.contains("did you mean `radius`"), "{message}");
    }
}
