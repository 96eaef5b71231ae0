//! Observers of a scenario: their columns in the time series, and the distribution of contact forces.

use pulvis_core::Simulation;
use pulvis_core::observation::{Observation, ObservationPlan, Tensor, deviator, eigenvalues, pressure};
use pulvis_input::scenario::{ObservedQuantity, Observer, Scenario};
use pulvis_io::table::{Cell, Table};

use super::error::RunError;

const AXES: [&str; 3] = ["x", "y", "z"];

/// The components that a symmetric tensor has, with their names.
const COMPONENTS: [(&str, usize, usize); 6] =
    [("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("xz", 0, 2), ("yz", 1, 2)];

/// A quantity of an observer.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ObservedColumn {
    /// What it is, without the name of the observer.
    pub(super) quantity: String,
    /// Unit in SI.
    pub(super) unit: &'static str,
    /// The name of its column.
    pub(super) column: String,
}

/// The columns of an observer, in the order of its [`values`].
pub(super) fn columns(scenario: &Scenario, observer: &Observer) -> Vec<ObservedColumn> {
    let mut columns = Vec::new();
    let name = &observer.name;
    let mut add = |quantity: String, unit| {
        let column = format!("{quantity}_{name}");
        columns.push(ObservedColumn { quantity, unit, column });
    };
    for quantity in &observer.quantities {
        match quantity {
            ObservedQuantity::Stress => {
                COMPONENTS.iter().for_each(|(part, ..)| add(format!("stress_{part}"), "Pa"));
                for quantity in ["pressure", "deviatoric_stress", "kinetic_pressure"] {
                    add(quantity.to_owned(), "Pa");
                }
            }
            ObservedQuantity::Particles => {
                add("particles".to_owned(), "1");
                add("solid_fraction".to_owned(), "1");
                AXES.iter().for_each(|axis| add(format!("velocity_{axis}"), "m/s"));
                add("granular_temperature".to_owned(), "J");
            }
            ObservedQuantity::Coordination => {
                for quantity in ["contacts", "coordination", "corrected_coordination", "rattlers"] {
                    add(quantity.to_owned(), "1");
                }
            }
            ObservedQuantity::Fabric => {
                COMPONENTS.iter().for_each(|(part, ..)| add(format!("fabric_{part}"), "1"));
                add("fabric_deviator".to_owned(), "1");
                COMPONENTS.iter().for_each(|(part, ..)| add(format!("volume_fabric_{part}"), "1"));
            }
            ObservedQuantity::Forces => {
                add("normal_force_mean".to_owned(), "N");
                add("normal_force_max".to_owned(), "N");
                add("tensile_share".to_owned(), "1");
            }
            ObservedQuantity::Walls => {
                for wall in &scenario.walls {
                    let force = |axis: &&str| format!("wall_force_{axis}_{}", wall.name);
                    AXES.iter().for_each(|axis| add(force(axis), "N"));
                }
            }
        }
    }
    columns
}

/// What the observers of a scenario look at.
pub(super) fn plan(scenario: &Scenario) -> ObservationPlan {
    let wants = |wanted: fn(&ObservedQuantity) -> bool| {
        scenario.observers.iter().any(|observer| observer.quantities.iter().any(wanted))
    };
    ObservationPlan {
        regions: scenario.observers.iter().map(|observer| observer.region).collect(),
        contacts: wants(|quantity| *quantity != ObservedQuantity::Particles),
        rattlers: wants(|quantity| *quantity == ObservedQuantity::Coordination),
        least_contacts: scenario.observers.iter().map(|observer| observer.least_contacts).collect(),
    }
}

/// The values of all observers, one after the other. The sample has these lengths now [m].
pub(super) fn values(
    scenario: &Scenario,
    plan: &ObservationPlan,
    simulation: &Simulation,
    lengths: [Option<f64>; 3],
) -> Vec<f64> {
    let lengths = lengths.map(|length| length.unwrap_or(f64::NAN));
    let mut values = Vec::new();
    for (observer, seen) in scenario.observers.iter().zip(simulation.observe(plan)) {
        let volume = match &observer.region {
            None => lengths.iter().product(),
            Some(region) => region.volume(lengths),
        };
        for quantity in &observer.quantities {
            push(&mut values, *quantity, &seen, volume);
        }
    }
    values
}

fn push(values: &mut Vec<f64>, quantity: ObservedQuantity, seen: &Observation, volume: f64) {
    // Only with rotating particles, or moving ones, is a stress not symmetric: half the sum of both components.
    let components =
        |tensor: Tensor| COMPONENTS.map(|(_, row, column)| 0.5 * (tensor[row][column] + tensor[column][row]));
    match quantity {
        ObservedQuantity::Stress => {
            let stress = seen.stress(volume);
            values.extend(components(stress));
            values.extend([pressure(&stress), deviator(&stress), pressure(&seen.kinetic_stress(volume))]);
        }
        ObservedQuantity::Particles => {
            values.extend([seen.particles, seen.solid_fraction(volume)]);
            values.extend(seen.mean_velocity().to_array());
            values.push(seen.granular_temperature());
        }
        ObservedQuantity::Coordination => {
            let (all, corrected) = (seen.coordination(), seen.corrected_coordination());
            values.extend([seen.contacts, all, corrected, seen.rattlers]);
        }
        ObservedQuantity::Fabric => {
            values.extend(components(seen.fabric()));
            let [largest, _, smallest] = eigenvalues(&seen.fabric());
            values.push(largest - smallest);
            values.extend(components(seen.volume_fabric(volume)));
        }
        ObservedQuantity::Forces => {
            let tensile = seen.tensile / seen.contacts;
            values.extend([seen.normal_force_mean(), seen.normal_force_max, tensile]);
        }
        ObservedQuantity::Walls => {
            values.extend(seen.wall_forces.iter().flat_map(|force| force.to_array()));
        }
    }
}

/// The file of the distribution of forces at the end of a stage, numbered from zero.
pub(super) fn histogram_file(observer: &Observer, stage: usize) -> String {
    format!("forces_{}.stage-{}.csv", observer.name, stage + 1)
}

/// Whether a run may write a distribution of this name.
pub(super) fn is_histogram(name: &str) -> bool {
    let parts = || {
        let (observer, number) =
            name.strip_prefix("forces_")?.strip_suffix(".csv")?.rsplit_once(".stage-")?;
        let is_name = !observer.is_empty() && observer.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        Some(is_name && !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit()))
    };
    parts() == Some(true)
}

/// Bins to the mean force.
const BINS: f64 = 10.0;

/// Bins on either side of zero at most: forces beyond are in the last ones.
const MOST_BINS: f64 = 1000.0;

/// The distribution of the normal forces of the contacts of an observer. Forces are in units of the mean of their sizes, so
/// that a density times the width of a bin is a probability.
pub(super) fn histogram(observer: &Observer, simulation: &Simulation) -> Result<Table, RunError> {
    let forces = simulation.normal_forces(observer.region.as_ref());
    let total: f64 = forces.iter().map(|(_, share)| share).sum();
    let mean = forces.iter().map(|(force, share)| force.abs() * share).sum::<f64>() / total;
    let mut table = Table::new(["from [1]", "to [1]", "contacts [1]", "density [1]", "mean force [N]"]);
    let bin = |force: f64| (force / mean * BINS).floor().clamp(-MOST_BINS, MOST_BINS - 1.0);
    let bins: Vec<(i64, f64)> = forces
        .iter()
        .map(|(force, share)| (bin(*force), *share))
        .filter(|(bin, _)| bin.is_finite())
        .map(|(bin, share)| (bin as i64, share))
        .collect();
    let Some(first) = bins.iter().map(|(bin, _)| *bin).min() else { return Ok(table) };
    let last = bins.iter().map(|(bin, _)| *bin).max().unwrap_or(first);
    let mut counts = vec![0.0; (last - first + 1) as usize];
    bins.iter().for_each(|(bin, share)| counts[(bin - first) as usize] += share);
    for (number, count) in (first..).zip(counts) {
        let (from, to) = (number as f64 / BINS, (number + 1) as f64 / BINS);
        table.push([from, to, count, count / total * BINS, mean].map(Cell::from))?;
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distributions_are_told_from_files_of_the_user() {
        assert!(is_histogram("forces_core.stage-12.csv"));
        for name in ["forces.csv", "forces_.stage-1.csv", "forces_a.stage-.csv", "forces_a.stage-x.csv"] {
            assert!(!is_histogram(name), "{name}");
        }
    }
}
