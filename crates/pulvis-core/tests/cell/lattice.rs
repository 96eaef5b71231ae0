//! Lattices of elastic springs, whose stress is known at any strain.

use super::common::{RADIUS, elastic, setup, sphere, start, vector};
use super::{at_rates, stress};
use pulvis_core::{Domain, Particle, Setup, Simulation, UpperTriangular};
use pulvis_math::Vector3;

/// Stiffness of the springs of [`elastic`] [N/m].
pub const STIFFNESS: f64 = 1000.0;
/// Number of conventional cells of the lattice along each axis.
const CELLS: usize = 4;

/// The twelve ways from a sphere to its neighbours in a face-centred cubic lattice, in edges of a conventional cell.
fn neighbours() -> Vec<Vector3> {
    let mut all = Vec::new();
    for (one, other) in [(0.5, 0.5), (0.5, -0.5), (-0.5, 0.5), (-0.5, -0.5)] {
        all.extend([vector(one, other, 0.0), vector(one, 0.0, other), vector(0.0, one, other)]);
    }
    all
}

/// A face-centred cubic lattice of spheres that overlap by this share of their diameter.
pub fn lattice(overlap: f64) -> (Setup, f64) {
    let edge = 2.0_f64.sqrt() * 2.0 * RADIUS * (1.0 - overlap);
    let mut particles: Vec<Particle> = Vec::new();
    for number in 0..CELLS.pow(3) {
        let corner =
            [number % CELLS, number / CELLS % CELLS, number / CELLS / CELLS].map(|index| index as f64);
        for within in [[0.1; 3], [0.6, 0.6, 0.1], [0.6, 0.1, 0.6], [0.1, 0.6, 0.6]] {
            let place: [f64; 3] = std::array::from_fn(|axis| (corner[axis] + within[axis]) * edge);
            particles.push(sphere(Vector3::from(place), Vector3::zero(), RADIUS));
        }
    }
    let domain = Domain::periodic(Vector3::zero(), vector(1.0, 1.0, 1.0) * (CELLS as f64 * edge), [true; 3]);
    (Setup { domain, ..setup(particles, elastic()) }, edge)
}

/// The stress of the lattice after a deformation [Pa]: over the volume F a³ of four spheres, half the sum over their
/// twelve neighbours of force times way.
pub fn exact_stress(edge: f64, deformation: &UpperTriangular, row: usize, column: usize) -> f64 {
    let sum: f64 = neighbours()
        .into_iter()
        .map(|way| {
            let way = deformation.times(way * edge);
            let force = STIFFNESS * (2.0 * RADIUS - way.norm()).max(0.0);
            force * way[row] * way[column] / way.norm()
        })
        .sum();
    0.5 * 4.0 * sum / (edge.powi(3) * deformation.determinant())
}

fn deformed(overlap: f64, rates: UpperTriangular, steps: u64) -> (Simulation, f64) {
    let (setup, edge) = lattice(overlap);
    let mut simulation = start(setup, 50.0);
    simulation.set_cell_motion(at_rates(rates)).unwrap();
    simulation.advance(steps).unwrap();
    (simulation, edge)
}

#[test]
fn a_lattice_in_any_homogeneous_deformation_has_the_stress_of_its_springs() {
    let rates = UpperTriangular { xx: -2.0, yy: -1.0, zz: 0.5, xy: 6.0, xz: -1.5, yz: 2.0 };
    let (simulation, edge) = deformed(0.01, rates, 400);
    // F of equal steps by the rule of the middle.
    let half = rates * (0.5 * simulation.time_step());
    let step = (UpperTriangular::IDENTITY - half).inverse().after(&(UpperTriangular::IDENTITY + half));
    let mut deformation = UpperTriangular::IDENTITY;
    (0..400).for_each(|_| deformation = step.after(&deformation));
    assert!(deformation.xy > 0.003);
    for (row, column) in [(0, 0), (1, 1), (2, 2), (0, 1), (1, 0), (0, 2), (2, 0), (1, 2), (2, 1)] {
        let (found, exact) =
            (stress(&simulation, row, column), exact_stress(edge, &deformation, row, column));
        let scale = exact_stress(edge, &deformation, 0, 0);
        assert!((found - exact).abs() < 1e-10 * scale, "{row}{column}: {found} {exact}");
    }
    let ledger = simulation.ledger();
    assert!(ledger.kinetic() < 1e-20 * ledger.elastic(), "a lattice moves as its cell does");
    let stored = ledger.elastic_normal - ledger.initial;
    assert!((ledger.work_cell - stored).abs() < 1e-6 * stored.abs(), "{} {stored}", ledger.work_cell);
}

#[test]
fn the_bulk_and_shear_moduli_of_the_lattice_are_those_of_its_springs() {
    // With springs that just touch: C11 = √2 k/d, C12 = C44 = C11/2 and K = (C11 + 2 C12)/3 = 2 √2 k/(3 d).
    // Born and Huang, Dynamical Theory of Crystal Lattices (1954), section 11: central forces between nearest neighbours.
    let diameter = 2.0 * RADIUS;
    let steps = 200;
    let slope = |rates: UpperTriangular, row: usize, column: usize| {
        let (simulation, edge) = deformed(0.002, rates, steps);
        let unit = UpperTriangular::IDENTITY;
        let strain = if row == column { simulation.cell_strain().xx } else { simulation.cell_strain().xy };
        (stress(&simulation, row, column) - exact_stress(edge, &unit, row, column)) / -strain
    };
    let bulk = slope(UpperTriangular { xx: -1.0, yy: -1.0, zz: -1.0, ..UpperTriangular::ZERO }, 0, 0) / 3.0;
    let exact = 2.0 * 2.0_f64.sqrt() / 3.0 * STIFFNESS / diameter;
    // The overlap of 0.2 % at the start changes moduli by some of it.
    assert!((bulk / exact - 1.0).abs() < 0.01, "{bulk} {exact}");
    let rigidity = slope(UpperTriangular { xy: 1.0, ..UpperTriangular::ZERO }, 0, 1);
    let exact = STIFFNESS / (2.0_f64.sqrt() * diameter);
    assert!((rigidity / exact - 1.0).abs() < 0.01, "{rigidity} {exact}");
}
