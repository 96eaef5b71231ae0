//! What is measured of a running simulation: one row of the time series.

use pulvis_boundary::Shape;
use pulvis_core::Simulation;
use pulvis_core::observation::ObservationPlan;
use pulvis_input::scenario::{ClusterRule, Scenario, WallShape};

use super::cell;
use super::clusters::{self, Clusters, clusters};
use super::groups;
use super::observers;
use super::openings::{self, Openings};
use super::stage::{length, wall_force, wall_stress};

const AXES: [&str; 3] = ["x", "y", "z"];

/// Takes measurements; the columns are fixed for the whole run.
#[derive(Clone, Debug)]
pub struct Measure {
    columns: Vec<String>,
    /// Whether any contact of any stage may be bonded.
    bonds: bool,
    scaled: Option<Scaled>,
    /// What observers look at.
    observed: ObservationPlan,
}

/// The reference of dimensionless columns.
#[derive(Clone, Copy, Debug)]
struct Scaled {
    length: f64,
    stiffness: f64,
    /// Lengths L0 of the sample along x, y, z [m].
    reference: [Option<f64>; 3],
}

/// The names of the columns of a scenario's time series.
pub fn column_names(scenario: &Scenario) -> Vec<String> {
    let mut columns: Vec<String> = ["step", "time", "stage"].map(str::to_owned).into();
    let blank = pulvis_core::Ledger::default();
    columns.extend(blank.accounts().iter().map(|(name, _)| (*name).to_owned()));
    let totals = ["kinetic", "elastic", "dissipated", "closing_error", "relative_error"];
    columns.extend(totals.map(str::to_owned));
    let contacts =
        ["particles", "contacts", "wall_contacts", "coordination", "overlap_max", "solid_fraction"];
    columns.extend(contacts.map(str::to_owned));
    if may_bond(scenario) {
        columns.extend(["bonds", "broken_bonds"].map(str::to_owned));
    }
    if scenario.output.clusters != ClusterRule::Never {
        columns.extend(clusters::COLUMNS.map(str::to_owned));
        for name in ["spans", "roughness"] {
            columns.extend(AXES.map(|axis| format!("{name}_{axis}")));
        }
    }
    columns.extend(scenario.temperature.iter().map(|_| "temperature".to_owned()));
    columns.extend(AXES.map(|axis| format!("centre_of_mass_{axis}")));
    columns.extend(["stress_xx", "stress_yy", "stress_zz"].map(str::to_owned));
    for axis in AXES {
        columns.extend(["length", "strain", "wall_stress"].map(|name| format!("{name}_{axis}")));
    }
    columns.extend(cell::columns(scenario));
    for wall in &scenario.walls {
        let names: &[&str] = match wall.shape {
            WallShape::Plane(_) => &["position", "force"],
            _ if wall.shape.direction_of_push().is_some() => {
                &["force_x", "force_y", "force_z", "torque", "position"]
            }
            _ => &["force_x", "force_y", "force_z", "torque"],
        };
        columns.extend(names.iter().map(|name| format!("{name}_{}", wall.name)));
    }
    columns.extend(groups::columns(scenario));
    if scenario.output.dimensionless.is_some() {
        columns.extend(AXES.iter().flat_map(|axis| [format!("D_{axis}"), format!("F_{axis}")]));
    }
    for observer in &scenario.observers {
        columns.extend(observers::columns(scenario, observer).into_iter().map(|observed| observed.column));
    }
    columns.extend(openings::columns(scenario));
    columns
}

/// Whether any contact of any stage may be bonded.
fn may_bond(scenario: &Scenario) -> bool {
    let mut contacts = scenario.stages.iter().flat_map(|stage| &stage.contacts);
    contacts.any(|contact| contact.model.laws.bond.is_some())
}

impl Measure {
    /// What is to be measured of a scenario, which starts as `simulation` is.
    pub fn new(scenario: &Scenario, simulation: &Simulation) -> Self {
        let scaled = scenario.output.dimensionless.map(|plan| Scaled {
            length: plan.length,
            stiffness: plan.stiffness,
            reference: [None; 3],
        });
        let (columns, bonds, observed) =
            (column_names(scenario), may_bond(scenario), observers::plan(scenario));
        let mut measure = Self { columns, bonds, scaled, observed };
        measure.take_reference(scenario, simulation);
        measure
    }

    /// The stage of this number has ended.
    pub(super) fn end_stage(&mut self, scenario: &Scenario, simulation: &Simulation, number: usize) {
        if scenario.output.dimensionless.and_then(|scales| scales.reference_stage) == Some(number) {
            self.take_reference(scenario, simulation);
        }
    }

    /// The present lengths of the sample become L0 of the dimensionless displacement.
    pub fn take_reference(&mut self, scenario: &Scenario, simulation: &Simulation) {
        if let Some(scaled) = &mut self.scaled {
            scaled.reference = [0, 1, 2].map(|axis| length(scenario, simulation, axis));
        }
    }

    /// The lengths L0 of the dimensionless displacement, if there is one.
    pub(super) fn reference(&self) -> Option<[Option<f64>; 3]> {
        // What a measurement depends on beside scenario and simulation is part of a checkpoint.
        let Self { columns: _, bonds: _, scaled, observed: _ } = self;
        let Scaled { length: _, stiffness: _, reference } = scaled.as_ref()?;
        Some(*reference)
    }

    /// Sets those of an interrupted run.
    pub(super) fn resume(&mut self, lengths: Option<[Option<f64>; 3]>) {
        if let Some((scaled, lengths)) = self.scaled.as_mut().zip(lengths) {
            scaled.reference = lengths;
        }
    }

    /// The names of the columns. Energies [J], stresses [Pa], lengths [m], forces [N], compression
    /// positive; `position_*` is the place of a plane along its normal. Of a cylinder: the components of the force on
    /// it, and the torque about its axis [N m].
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The place of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column == name)
    }

    /// One row: the present state in stage number `stage`. What does not exist is NaN.
    pub(super) fn row(
        &self,
        scenario: &Scenario,
        simulation: &Simulation,
        openings: &Openings,
        stage: usize,
        start_lengths: [Option<f64>; 3],
    ) -> Vec<f64> {
        let ledger = simulation.ledger();
        let mut row = vec![simulation.steps() as f64, simulation.time(), stage as f64];
        row.extend(ledger.accounts().iter().map(|(_, value)| value));
        let error = ledger.closing_error();
        row.extend([ledger.kinetic(), ledger.elastic(), ledger.dissipated(), error, ledger.relative_error()]);
        let lengths = [0, 1, 2].map(|axis| length(scenario, simulation, axis));
        let volume = lengths.iter().map(|length| length.unwrap_or(f64::NAN)).product::<f64>();
        let contacts = simulation.contact_totals();
        let count = simulation.particles().len() as f64;
        row.extend([
            count,
            contacts.pairs,
            contacts.at_walls,
            (2.0 * contacts.pairs + contacts.at_walls) / count,
            contacts.overlap_max,
            simulation.particles().total_volume() / volume,
        ]);
        if self.bonds {
            let bonds = simulation.bonds();
            row.extend([bonds.intact as f64, bonds.broken as f64]);
        }
        if scenario.output.clusters != ClusterRule::Never {
            let Clusters { values, spans, roughness } = clusters(scenario, simulation);
            row.extend(values);
            row.extend(spans.map(|spans| spans.map_or(f64::NAN, |spans| f64::from(u8::from(spans)))));
            row.extend(roughness.map(|roughness| roughness.unwrap_or(f64::NAN)));
        }
        row.extend(simulation.temperature());
        // Along a periodic direction there is no centre.
        let periodic = simulation.domain().periodic;
        let centre = simulation.particles().centre_of_mass().to_array();
        row.extend([0, 1, 2].map(|axis| if periodic[axis] { f64::NAN } else { centre[axis] }));
        row.extend([0, 1, 2].map(|axis| contacts.virial[axis][axis] / volume));
        for axis in 0..3 {
            let strain = lengths[axis].zip(start_lengths[axis]).map(|(now, start)| now / start - 1.0);
            let stress = wall_stress(scenario, simulation, axis);
            row.extend([lengths[axis], strain, stress].map(|value| value.unwrap_or(f64::NAN)));
        }
        row.extend(cell::values(scenario, simulation, volume));
        for (place, wall) in simulation.walls().iter().enumerate() {
            let force = simulation.wall_force(place);
            match wall.plane_normal() {
                Some(normal) => row.extend([wall.point.dot(normal), -force.dot(normal)]),
                None => {
                    row.extend(force.to_array());
                    row.push(simulation.wall_torque(place));
                    row.extend(wall.position_of_push());
                }
            }
        }
        row.extend(groups::values(scenario, simulation));
        if let Some(scaled) = &self.scaled {
            for (axis, (now, reference)) in lengths.iter().zip(scaled.reference).enumerate() {
                let displacement = now.zip(reference);
                let force = wall_force(scenario, simulation, axis);
                row.push(displacement.map_or(f64::NAN, |(now, start)| (now - start) / scaled.length));
                row.push(force.map_or(f64::NAN, |force| force / (scaled.stiffness * scaled.length)));
            }
        }
        if !self.observed.regions.is_empty() {
            row.extend(observers::values(scenario, &self.observed, simulation, lengths));
        }
        row.extend(openings.values(simulation));
        row
    }
}
