//! Which particles hang together by contacts.

mod graph;

use pulvis_core::Simulation;
use pulvis_input::scenario::Scenario;
use pulvis_math::Vector3;
use std::collections::BTreeSet;

use super::fracture::{Sphere, roughness as rough};
use super::setup::box_walls;
pub(super) use graph::Graph;

/// Columns of the time series that tell of groups, before those of axes.
pub(super) const COLUMNS: [&str; 8] = [
    "clusters",
    "largest_cluster",
    "second_cluster",
    "monomers",
    "mean_cluster",
    "gyration_radius",
    "deposited",
    "deposited_mass",
];

/// Groups of particles that are joined by contacts. Walls join nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Clusters {
    /// Values of [`COLUMNS`]: number of groups, a particle without a contact is one of its own; particles of the largest and of
    /// the second largest one; groups of one; Σ s²/Σ s over the sizes s of all; √(Σ m (x − x_c)²/Σ m) of the centres x of the
    /// largest one \[m\]; particles in groups that are joined to a wall, and their mass \[kg\].
    pub values: [f64; COLUMNS.len()],
    /// Whether one group is joined to both box walls of an axis; `None` where one of them is missing.
    pub spans: [Option<bool>; 3],
    /// How rough the surfaces are along which a sample has parted along an axis, the mean of both \[m\]: those of the groups that
    /// are joined to the low and the high wall of the box.
    pub roughness: [Option<f64>; 3],
}

/// The clusters at the present time, by the rule of the scenario.
pub(super) fn clusters(scenario: &Scenario, simulation: &Simulation) -> Clusters {
    let graph = Graph::new(simulation, scenario.output.clusters);
    let touching = |wall: usize| {
        let own = graph.at_walls().iter().filter(|(_, touched)| *touched == wall);
        own.map(|(particle, _)| graph.root(*particle)).collect::<BTreeSet<usize>>()
    };
    let ends = [0, 1, 2].map(|axis| match box_walls(scenario, axis) {
        [Some(low), Some(high)] if [low, high].iter().all(|wall| simulation.walls()[*wall].present) => {
            Some([touching(low), touching(high)])
        }
        _ => None,
    });
    let mut roughness = [None; 3];
    for (axis, ends) in ends.iter().enumerate() {
        let Some([low, high]) = ends else { continue };
        if low.is_disjoint(high) {
            let surfaces = [(low, 1.0), (high, -1.0)].map(|(piece, outward)| {
                rough(&spheres(simulation, |id| piece.contains(&graph.root(id))), axis, outward)
            });
            roughness[axis] = surfaces[0].zip(surfaces[1]).map(|(low, high)| 0.5 * (low + high));
        }
    }
    Clusters {
        values: values(&graph, simulation),
        spans: ends.map(|ends| ends.map(|[low, high]| !low.is_disjoint(&high))),
        roughness,
    }
}

/// The values of [`COLUMNS`].
fn values(graph: &Graph, simulation: &Simulation) -> [f64; COLUMNS.len()] {
    let sizes = graph.sizes();
    let size = |place: usize| sizes.get(place).map_or(0.0, |size| *size as f64);
    let alone = sizes.iter().filter(|size| **size == 1).count() as f64;
    let [sum, squares] = [1, 2].map(|power| sizes.iter().map(|size| size.pow(power) as f64).sum::<f64>());
    let particles = simulation.particles();
    let rows = particles.rows_by_id();
    let mass_of = |id: usize| {
        let row = rows.binary_search_by_key(&id, |&row| particles.ids()[row] as usize);
        row.map_or(0.0, |place| particles.masses()[rows[place]])
    };
    let gyration = graph.largest().map_or(f64::NAN, |root| gyration_radius(&graph.layout(root), mass_of));
    let at_walls: BTreeSet<usize> =
        graph.at_walls().iter().map(|(particle, _)| graph.root(*particle)).collect();
    let deposited: Vec<usize> = rows
        .iter()
        .map(|&row| particles.ids()[row] as usize)
        .filter(|&id| at_walls.contains(&graph.root(id)))
        .collect();
    let mass = deposited.iter().map(|&id| mass_of(id)).sum();
    [sizes.len() as f64, size(0), size(1), alone, squares / sum, gyration, deposited.len() as f64, mass]
}

/// √(Σ m (x − x_c)²/Σ m) over centres x with their centre of mass x_c [m].
fn gyration_radius(layout: &[(usize, Vector3)], mass_of: impl Fn(usize) -> f64) -> f64 {
    let total: f64 = layout.iter().map(|(id, _)| mass_of(*id)).sum();
    let mut centre = Vector3::zero();
    layout.iter().for_each(|(id, at)| centre += *at * (mass_of(*id) / total));
    let squares = layout.iter().map(|(id, at)| mass_of(*id) * (*at - centre).norm_squared());
    (squares.sum::<f64>() / total).sqrt()
}

/// The particles that are wanted.
fn spheres(simulation: &Simulation, wanted: impl Fn(usize) -> bool) -> Vec<Sphere> {
    let particles = simulation.particles();
    let all = particles.ids().iter().zip(particles.positions().iter()).zip(particles.radii());
    all.filter(|((id, _), _)| wanted(**id as usize))
        .map(|((_, centre), radius)| (centre.to_array(), *radius))
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::protocol::Session;

    /// A chain of four across a periodic face, a pair on the plate and a grain alone; neighbours overlap by 1 um.
    const PIECES: &str = r#"
        [materials.grain]
        density = "2500 kg/m^3"
        [contacts.grain-grain.normal]
        law = "linear"
        k = "1 N/m"
        [domain]
        lower = ["0 mm", "0 mm", "0 mm"]
        upper = ["10 mm", "10 mm", "10 mm"]
        periodic = ["x", "y"]
        [[particles]]
        material = "grain"
        radius = { distribution = "fixed", value = "0.5 mm" }
        arrangement = { kind = "list", positions = [
          ["8.5 mm", "2 mm", "5 mm"], ["9.499 mm", "2 mm", "5 mm"], ["0.498 mm", "2 mm", "5 mm"], ["1.497 mm", "2 mm", "5 mm"],
          ["5 mm", "5 mm", "0.499 mm"], ["5 mm", "5 mm", "1.498 mm"],
          ["5 mm", "8 mm", "5 mm"]] }
        [walls.plate]
        material = "grain"
        point = ["0 mm", "0 mm", "0 mm"]
        normal = [0, 0, 1]
        [[stages]]
        name = "look"
        until = { time = "1 ms" }
        [output]
        clusters = true
    "#;

    #[test]
    fn pieces_are_counted_across_periods_and_the_chain_has_the_radius_of_gyration_of_its_closed_form() {
        let scenario = Scenario::from_str("test.toml", PIECES).unwrap_or_else(|errors| panic!("{errors}"));
        let mut session = Session::new(scenario.clone()).unwrap();
        session.advance(1, false).unwrap();
        let seen = clusters(&scenario, session.simulation());
        let [count, largest, second, alone, mean, gyration, deposited, mass] = seen.values;
        assert_eq!([count, largest, second, alone, deposited], [3.0, 4.0, 2.0, 1.0, 2.0]);
        assert!((mean - (16.0 + 4.0 + 1.0) / 7.0).abs() < 1e-12, "{mean}");
        // Four on a line at distances s: s √(5/4).
        assert!((gyration / (0.999e-3 * 1.25_f64.sqrt()) - 1.0).abs() < 1e-6, "{gyration}");
        let expected = 2.0 * 2500.0 * std::f64::consts::PI / 6.0 * 1e-9;
        assert!((mass / expected - 1.0).abs() < 1e-12, "{mass}");
    }

    #[test]
    fn elastic_contacts_join_nothing_where_only_bound_ones_do() {
        let text = PIECES.replace("clusters = true", "clusters = \"bound\"");
        let scenario = Scenario::from_str("test.toml", &text).unwrap_or_else(|errors| panic!("{errors}"));
        let mut session = Session::new(scenario.clone()).unwrap();
        session.advance(1, false).unwrap();
        let seen = clusters(&scenario, session.simulation());
        assert_eq!(seen.values[..7], [7.0, 1.0, 1.0, 7.0, 1.0, 0.0, 0.0]);
    }

    #[test]
    fn two_unequal_masses_turn_about_their_centre_of_mass() {
        // Masses 1 and 3 at a distance of 4: 3 and 1 from the centre, (1·9 + 3·1)/4 = 3.
        let layout = [(0, Vector3::zero()), (1, Vector3 { x: 0.0, y: 4.0, z: 0.0 })];
        let radius = gyration_radius(&layout, |id| [1.0, 3.0][id]);
        assert!((radius - 3.0_f64.sqrt()).abs() < 1e-14, "{radius}");
    }
}
