//! The files of an analysis: VTK images, tables, and what their columns mean.

use std::path::Path;

use pulvis_io::IoError;
use pulvis_io::table::{Cell, Table};
use pulvis_io::vtk::{Column, ImageGrid, write_image};

use super::fields::Fields;

/// Name, meaning, unit and number of components of every field.
pub(super) const DESCRIPTIONS: [(&str, &str, &str, usize); 8] = [
    ("solid_fraction", "volume of the particles over that of space", "1", 1),
    ("density", "mass over volume", "kg/m^3", 1),
    ("momentum", "momentum over volume", "kg m^-2 s^-1", 3),
    ("velocity", "momentum over mass", "m/s", 3),
    ("contact_stress", "f_k b_l of the contacts along their ways, compression positive", "Pa", 9),
    ("kinetic_stress", "m (v - V)_k (v - V)_l over volume, against the local velocity V", "Pa", 9),
    ("wall_force", "force of the walls on the particles over volume", "N/m^3", 3),
    ("fabric", "solid fraction times the sum of n_k n_l over the contacts of a particle", "1", 9),
];

/// Writes fields as a VTK image with one value per cell.
pub(super) fn write_vtk(fields: &Fields, path: &Path) -> Result<(), IoError> {
    let velocity: Vec<[f64; 3]> = (0..fields.grid.len()).map(|cell| fields.velocity(cell)).collect();
    let columns = [
        Column::scalar("solid_fraction", &fields.solid_fraction),
        Column::scalar("density", &fields.density),
        Column::vector("momentum", &fields.momentum),
        Column::vector("velocity", &velocity),
        Column::tensor("contact_stress", &fields.contact_stress),
        Column::tensor("kinetic_stress", &fields.kinetic_stress),
        Column::vector("wall_force", &fields.wall_force),
        Column::tensor("fabric", &fields.fabric),
    ];
    let grid = ImageGrid { origin: fields.grid.lower, spacing: fields.grid.cell, cells: fields.grid.counts };
    write_image(path, &grid, &columns)
}

/// Writes fields as a table with a row for each cell.
pub(super) fn write_table(fields: &Fields, path: &Path) -> Result<(), IoError> {
    let names = DESCRIPTIONS.iter().flat_map(|(name, .., components)| names(name, *components));
    let mut table = Table::new(["x", "y", "z"].map(str::to_owned).into_iter().chain(names));
    for cell in 0..fields.grid.len() {
        let mut row: Vec<f64> = fields.grid.middle(cell).into();
        row.extend([fields.solid_fraction[cell], fields.density[cell]]);
        row.extend(fields.momentum[cell]);
        row.extend(fields.velocity(cell));
        row.extend(fields.contact_stress[cell]);
        row.extend(fields.kinetic_stress[cell]);
        row.extend(fields.wall_force[cell]);
        row.extend(fields.fabric[cell]);
        table.push(row.into_iter().map(Cell::from))?;
    }
    table.write(path)
}

/// Writes what the columns mean, as `fields.json` of a run does.
pub(super) fn write_descriptions(path: &Path) -> Result<(), IoError> {
    let mut table = Table::new(["file", "field", "columns", "meaning", "unit", "shape"]);
    let mut add = |file: &str, field: &str, columns: &str, meaning: &str, unit: &str, shape: &str| {
        table.push([file, field, columns, meaning, unit, shape].map(Cell::from))
    };
    for file in ["fields_*.csv", "profile_*.csv"] {
        add(file, "position", "x y z", "middle of the cell", "m", "3")?;
    }
    for (name, meaning, unit, components) in DESCRIPTIONS {
        let shape = match components {
            1 => "",
            3 => "3",
            _ => "3 3",
        };
        add("fields_*.vti", name, name, meaning, unit, shape)?;
        for file in ["fields_*.csv", "profile_*.csv"] {
            add(file, name, &names(name, components).join(" "), meaning, unit, shape)?;
        }
    }
    table.write(path)
}

/// Names of the columns of a field.
fn names(name: &str, components: usize) -> Vec<String> {
    let axes = ["x", "y", "z"];
    match components {
        1 => vec![name.to_owned()],
        3 => axes.map(|axis| format!("{name}_{axis}")).into(),
        _ => axes.iter().flat_map(|one| axes.map(|other| format!("{name}_{one}{other}"))).collect(),
    }
}
