//! `fields.json`: what stands in every column of every file of a run.

use pulvis_input::scenario::{FileFormat, Scenario};
use pulvis_io::IoError;
use pulvis_io::frames::component_names;
use pulvis_io::table::{Cell, Table};
use pulvis_io::vtk::Numbers;

use super::frame::Selection;
use super::observers;
use super::snapshots::{Plan, plans};
use super::under_way::TIME_SERIES;

/// The file.
pub(crate) const FIELDS: &str = "fields.json";

/// Name, meaning, unit in SI.
type Description = (&'static str, &'static str, &'static str);

/// Columns of the time series.
const SERIES: &[Description] = &[
    ("step", "steps so far", "1"),
    ("time", "simulated time", "s"),
    ("stage", "number of the stage, from 1", "1"),
    ("kinetic_translation", "kinetic energy of translation", "J"),
    ("kinetic_rotation", "kinetic energy of rotation", "J"),
    ("kinetic_discretisation", "discrete part of the kinetic energy, -dt^2/8 sum(f^2/m + torque^2/I)", "J"),
    ("elastic_normal", "stored in normal springs", "J"),
    ("elastic_sliding", "stored in sliding springs", "J"),
    ("elastic_rolling", "stored in rolling springs", "J"),
    ("elastic_torsion", "stored in torsion springs", "J"),
    ("elastic_bond", "stored in bonds", "J"),
    ("adhesive", "potential of attractions at a distance", "J"),
    ("capillary", "potential of liquid bridges", "J"),
    ("electrostatic", "potential of charges", "J"),
    ("gravity", "potential of gravity", "J"),
    ("dissipated_plastic", "dissipated by plastic deformation", "J"),
    ("dissipated_adhesive", "dissipated by attractions", "J"),
    ("dissipated_capillary", "dissipated by bridges that form", "J"),
    ("dissipated_fracture", "dissipated by bonds that break", "J"),
    ("dissipated_thermal", "dissipated by parameters that change", "J"),
    ("dissipated_viscous", "dissipated by dashpots", "J"),
    ("dissipated_sliding", "dissipated by sliding", "J"),
    ("dissipated_rolling", "dissipated by rolling", "J"),
    ("dissipated_torsion", "dissipated by torsion", "J"),
    ("dissipated_background", "dissipated by drag", "J"),
    ("work_walls", "work of walls and groups that move as prescribed", "J"),
    ("work_servo", "work of walls under a pressure", "J"),
    ("work_cell", "work of a periodic cell that deforms", "J"),
    ("switched", "energy that switches between stages and forces and settings of a program brought", "J"),
    ("inflow", "energy of inserted particles", "J"),
    ("outflow", "energy of removed particles", "J"),
    ("kinetic", "kinetic energy", "J"),
    ("elastic", "energy stored in springs and bonds", "J"),
    ("dissipated", "energy dissipated so far", "J"),
    ("closing_error", "closing error of the energy ledger", "J"),
    ("relative_error", "closing error over the largest energy in motion so far", "1"),
    ("particles", "number of particles", "1"),
    ("contacts", "touching pairs", "1"),
    ("wall_contacts", "touching particle-wall pairs", "1"),
    ("coordination", "touching contacts of a particle, mean", "1"),
    ("overlap_max", "largest overlap", "m"),
    ("solid_fraction", "volume of the particles over that of the box", "1"),
    ("bonds", "bonds that hold", "1"),
    ("broken_bonds", "bonds that have broken so far", "1"),
    ("clusters", "groups of particles joined by contacts", "1"),
    ("largest_cluster", "particles of the largest group", "1"),
    ("second_cluster", "particles of the second largest group", "1"),
    ("monomers", "groups of one particle", "1"),
    ("mean_cluster", "mean number of particles of the group of a particle", "1"),
    ("gyration_radius", "radius of gyration of the centres of the largest group", "m"),
    ("deposited", "particles in groups that are joined to a wall", "1"),
    ("deposited_mass", "their mass", "kg"),
    ("temperature", "temperature", "K"),
];

/// Columns of the time series whose names go on: with an axis, components, or the name of a wall.
const SERIES_STEMS: &[Description] = &[
    ("spans_", "whether one group touches both walls along the axis", "1"),
    ("roughness_", "roughness of the surfaces of fracture across the axis", "m"),
    ("centre_of_mass_", "centre of mass", "m"),
    ("stress_", "sum of f_k l_m over contacts / volume, compression positive", "Pa"),
    ("kinetic_stress_", "sum of m c_k c_m / volume, relative to the flow of the cell", "Pa"),
    ("length_", "distance of the box walls, or period", "m"),
    ("strain_", "(L - L0)/L0 with L0 at the start of the stage", "1"),
    ("wall_stress_", "mean compressive stress of the two box walls", "Pa"),
    ("cell_strain_", "time integral of the velocity gradient of the cell", "1"),
    ("tilt_", "shift of the next image of the cell", "m"),
    ("position_", "position of a plane along its normal", "m"),
    ("members_", "particles of a group", "1"),
    ("force_x_", "force of everything else on a group, or of the particles on a wall, along x", "N"),
    ("force_y_", "the same along y", "N"),
    ("force_z_", "the same along z", "N"),
    (
        "torque_x_",
        "torque of everything else on a group, about its axis of rotation or centre of mass, along x",
        "N m",
    ),
    ("torque_y_", "the same along y", "N m"),
    ("torque_z_", "the same along z", "N m"),
    ("work_", "work that has led a group", "J"),
    ("force_", "force of the particles on a wall; on a plane against its normal, compression positive", "N"),
    ("torque_", "torque of the particles on a wall about its axis", "N m"),
    ("number_", "particles that have passed an inlet or outlet so far", "1"),
    ("mass_", "mass that has passed an inlet or outlet so far", "kg"),
    (
        "flow_",
        "mass that has passed an inlet or outlet since the start of the stage / time since then",
        "kg/s",
    ),
    ("energy_", "kinetic energy that particles have carried through an inlet or outlet so far", "J"),
    ("D_", "(L - L0)/length scale", "1"),
    ("F_", "mean force on the two box walls/(stiffness scale x length scale)", "1"),
];

/// Fields of particles.
const PARTICLES: &[Description] = &[
    ("id", "number of the particle in the order of the scenario", "1"),
    ("type", "number of the material", "1"),
    ("radius", "radius", "m"),
    ("v", "velocity", "m/s"),
    ("omega", "angular velocity", "rad/s"),
    ("f", "total force", "N"),
    ("torque", "total torque", "N m"),
    ("coordination", "touching contacts, walls included", "1"),
    ("mass", "mass", "kg"),
    ("stress", "Love-Weber stress, sum of f_k l_m over contacts / own volume, compression positive", "Pa"),
    ("kinetic_translation", "m v^2/2", "J"),
    ("kinetic_rotation", "I omega^2/2", "J"),
    ("stored_energy", "energy stored in its contacts, half of it with other particles", "J"),
    ("cluster", "smallest number of a particle in its group", "1"),
    ("cluster_size", "particles in its group", "1"),
];

/// Fields of contacts.
pub(super) const CONTACTS: &[Description] = &[
    ("id1", "first particle", "1"),
    ("id2", "second particle; of a wall -1 - its number", "1"),
    ("force", "force on the first body", "N"),
    ("normal_force", "its part along the normal, repulsion positive", "N"),
    ("overlap", "overlap, negative where attraction acts at a distance", "m"),
    (
        "memory",
        "what laws remember, column by column as `pulvis laws NAME` names it; NaN where another law is at work",
        "SI",
    ),
    ("normal", "unit vector from the second body to the first", "1"),
    ("branch", "way from the second centre, of a wall from the contact point, to the first", "m"),
    ("point", "contact point", "m"),
    ("tangential_force", "force without its normal part", "N"),
    ("stored_energy", "energy stored in the contact", "J"),
];

/// The descriptions of all columns of all files.
///
/// # Errors
/// None that a user can cause.
pub(super) fn fields(scenario: &Scenario, series: &[String]) -> Result<Table, IoError> {
    let mut table = Table::new(["file", "field", "columns", "meaning", "unit", "shape"]);
    let mut add = |file: &str, field: &str, columns: &str, meaning: &str, unit: &str, shape: &str| {
        table.push([file, field, columns, meaning, unit, shape].map(Cell::from))
    };
    for column in series {
        let (meaning, unit) = of_series(scenario, column).unwrap_or_default();
        add(TIME_SERIES, column, column, &meaning, unit, "")?;
    }
    for plan in plans(scenario) {
        let [particles, contacts] = files(&plan);
        let format = plan.format;
        add(&particles, "position", &columns(format, "position", 3, ""), "centre of the particle", "m", "3")?;
        for (name, meaning, unit) in of_particles(scenario, &plan.selection) {
            let components = component_count(&name);
            add(
                &particles,
                &name,
                &columns(format, &name, components, ""),
                &meaning,
                &unit,
                shape(components),
            )?;
        }
        for &name in plan.selection.contacts() {
            let Some((_, meaning, unit)) = CONTACTS.iter().find(|(known, ..)| *known == name) else {
                continue;
            };
            let components = component_count(name);
            let columns = if name == "memory" {
                let full = |name: &&str| match format {
                    _ if format == FileFormat::Npz.name() => format!("contact_{name}"),
                    _ if format == FileFormat::Hdf5.name() => hdf5_path(name, true),
                    _ => (*name).to_owned(),
                };
                let names = plan.selection.memory().iter().map(full);
                names.collect::<Vec<_>>().join(" ")
            } else {
                columns(format, name, components, "contact_")
            };
            add(&contacts, name, &columns, meaning, unit, shape(components))?;
        }
    }
    Ok(table)
}

/// Meaning and unit of a column of the time series.
fn of_series(scenario: &Scenario, column: &str) -> Option<(String, &'static str)> {
    for observer in &scenario.observers {
        let observed = observers::columns(scenario, observer);
        if let Some(observed) = observed.iter().find(|observed| observed.column == column) {
            let what = observed.quantity.replace('_', " ");
            return Some((format!("{what} that the observer {} sees", observer.name), observed.unit));
        }
    }
    let exact = SERIES.iter().find(|(known, ..)| *known == column);
    let found = exact.or_else(|| SERIES_STEMS.iter().find(|(stem, ..)| column.starts_with(stem)));
    found.map(|(_, meaning, unit)| ((*meaning).to_owned(), *unit))
}

/// Name, meaning and unit of what is written of particles.
pub(super) fn of_particles(scenario: &Scenario, selection: &Selection<'_>) -> Vec<(String, String, String)> {
    let group = scenario.particles.first().map(|group| &group.columns[..]);
    let own = group.or_else(|| scenario.inlets.first().map(|inlet| &inlet.columns[..])).unwrap_or_default();
    let describe = |name: &str| {
        let known = PARTICLES.iter().find(|(known, ..)| *known == name);
        let (meaning, unit) = match (known, own.iter().find(|column| column.name == name)) {
            (Some((_, meaning, unit)), _) => (*meaning, (*unit).to_owned()),
            (None, Some(column)) => {
                ("column of [particles.columns] or [inlets.columns]", column.dimension.unit())
            }
            (None, None) => ("column of the run before", "SI".to_owned()),
        };
        (name.to_owned(), meaning.to_owned(), unit)
    };
    selection.fields(own.iter().map(|column| column.name.as_str())).into_iter().map(describe).collect()
}

/// Number of components of a field.
pub(super) fn component_count(name: &str) -> usize {
    match name {
        "v" | "omega" | "f" | "torque" | "force" | "normal" | "branch" | "point" | "tangential_force" => 3,
        "stress" => 9,
        _ => 1,
    }
}

fn shape(components: usize) -> &'static str {
    match components {
        1 => "",
        3 => "3",
        _ => "3 3",
    }
}

/// Names of the columns of a field in a file of this format.
fn columns(format: &str, name: &str, components: usize, prefix: &str) -> String {
    let numbers = match components {
        1 => Numbers::Scalar(Vec::new()),
        3 => Numbers::Vector(Vec::new()),
        _ => Numbers::Tensor(Vec::new()),
    };
    let is = |known: FileFormat| format == known.name();
    match name {
        _ if is(FileFormat::Npz) => format!("{prefix}{name}"),
        _ if is(FileFormat::Hdf5) => hdf5_path(name, !prefix.is_empty()),
        "position" if is(FileFormat::Vtk) => "Points".to_owned(),
        "position" if is(FileFormat::Xyz) => "pos".to_owned(),
        "v" if is(FileFormat::Xyz) => "velo".to_owned(),
        "f" if is(FileFormat::Xyz) => "forces".to_owned(),
        "type" if is(FileFormat::Xyz) => "species".to_owned(),
        "type" if is(FileFormat::Csv) => "material".to_owned(),
        _ if is(FileFormat::Vtk) || is(FileFormat::Xyz) => name.to_owned(),
        "position" => "x y z".to_owned(),
        _ => component_names(name, &numbers).join(" "),
    }
}

/// Where the numbers of a field stand in an HDF5 file.
fn hdf5_path(name: &str, of_contacts: bool) -> String {
    let group = if of_contacts { "contacts" } else { "particles/all" };
    format!("{group}/{}/value", pulvis_io::frames::hdf5_name(name))
}

/// The files of particles and of contacts, with an asterisk where a number stands.
fn files(plan: &Plan<'_>) -> [String; 2] {
    let name = plan.name;
    let prefix = if name.is_empty() { String::new() } else { format!("{name}_") };
    match FileFormat::ALL.iter().find(|(known, _)| *known == plan.format).map(|(_, format)| format) {
        Some(FileFormat::LammpsDump) => [format!("{name}.dump"), format!("{name}.contacts.dump")],
        Some(FileFormat::Xyz) => [format!("{name}.xyz"), String::new()],
        Some(FileFormat::Npz) => [format!("{name}_*.npz"), format!("{name}_*.npz")],
        Some(FileFormat::Hdf5) => [format!("{name}_*.h5"), format!("{name}_*.h5")],
        Some(FileFormat::Csv) => [format!("{name}_*.csv"), format!("{name}_contacts_*.csv")],
        Some(FileFormat::Vtk) | None => {
            [format!("{prefix}particles_*.vtp"), format!("{prefix}contacts_*.vtp")]
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::protocol::column_names;
    use pulvis_input::scenario::{CONTACT_FIELDS, PARTICLE_FIELDS};

    /// Scenarios that have all columns among them.
    const SCENARIOS: [&str; 5] = [
        include_str!("../../tests/protocol_scenarios/tablet.toml"),
        include_str!("../../../pulvis-input/tests/good/bonds.toml"),
        include_str!("../../../pulvis-input/tests/good/cell.toml"),
        include_str!("../../../pulvis-input/tests/good/drum.toml"),
        include_str!("../../../pulvis-input/tests/good/inlets.toml"),
    ];

    #[test]
    fn every_column_and_every_field_is_described() {
        let mut described = 0;
        for text in SCENARIOS {
            let mut scenario =
                Scenario::from_str("test.toml", text).unwrap_or_else(|errors| panic!("{errors}"));
            scenario.output.clusters = pulvis_input::scenario::ClusterRule::Acting;
            for column in column_names(&scenario) {
                assert!(of_series(&scenario, &column).is_some(), "{column}");
                described += 1;
            }
        }
        assert!(described > 100, "{described}");
        for (known, described) in [(&PARTICLE_FIELDS[..], PARTICLES), (&CONTACT_FIELDS[..], CONTACTS)] {
            assert_eq!(known, described.iter().map(|(name, ..)| *name).collect::<Vec<_>>());
        }
    }
}
