//! Where the particles of a group start.

use super::domain::read_extent;
use super::points::{PointsError, read_points};
use crate::context::Reported;
use crate::list::{List, Vector};
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Choice, Integer, Text};
use pulvis_boundary::Cuboid;
use pulvis_math::{Dimension, Vector3};
use pulvis_packing::{Growth, Lattice};
use std::path::{Path, PathBuf};

/// Where the particles of a group start.
#[derive(Clone, Debug, PartialEq)]
pub enum Arrangement {
    /// On a simple cubic lattice.
    Lattice(Lattice),
    /// At random, whole and without overlap, in this block.
    Random(Cuboid),
    /// Touching each other in an aggregate that has grown at random.
    Aggregate {
        /// Its centre of mass [m].
        centre: Vector3,
        /// How it has grown.
        growth: Growth,
    },
    /// As a file says.
    File {
        /// The absolute path of the file.
        path: PathBuf,
        /// What stands in it; radius and velocity are given for all grains or for none.
        grains: Vec<Grain>,
    },
    /// At these positions [m].
    List(Vec<Vector3>),
}

/// A particle of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Position of the centre [m].
    pub position: Vector3,
    /// Radius [m], if the file has them.
    pub radius: Option<f64>,
    /// Velocity [m/s], if the file has them.
    pub velocity: Option<Vector3>,
}

/// More particles than this do not fit into any memory: the number is a slip.
pub(super) const MOST_PARTICLES: i64 = 10_000_000_000;

/// Reads `[particles.arrangement]`; paths of files are relative to `folder`.
pub(super) fn read_arrangement(mut table: TableReader<'_>, folder: &Path) -> Result<Arrangement, Reported> {
    let read = match table.selector("kind", &["lattice", "random", "aggregate", "file", "list"])? {
        "lattice" => read_lattice(&mut table).map(Arrangement::Lattice),
        "random" => read_extent(&mut table).map(Arrangement::Random),
        "aggregate" => {
            let centre = table.required("centre", Vector::of(Dimension::LENGTH));
            let growth = table.required("growth", Choice(&Growth::ALL));
            centre.and_then(|centre| Ok(Arrangement::Aggregate { centre: centre.into(), growth: growth? }))
        }
        "file" => read_file(&mut table, folder),
        _ => table
            .required("positions", List::of(Vector::of(Dimension::LENGTH)).at_least(1))
            .map(|positions| Arrangement::List(positions.into_iter().map(Vector3::from).collect())),
    };
    table.finish();
    read
}

fn read_lattice(table: &mut TableReader<'_>) -> Result<Lattice, Reported> {
    let lower = table.required("lower", Vector::of(Dimension::LENGTH));
    let counts = table.required("counts", List::of(Integer::between(1, MOST_PARTICLES)).exactly(3));
    let spacing = table.required("spacing", QuantityRule::of(Dimension::LENGTH).above(0.0));
    // Beyond half a spacing a particle could change places with its neighbour.
    let jitter = table.or("jitter", QuantityRule::of(Dimension::NONE).at_least(0.0).at_most(0.5), 0.0);
    let mut sites: i64 = 1;
    let mut cells = [1; 3];
    for (cell, count) in cells.iter_mut().zip(counts?) {
        *cell = usize::try_from(count).unwrap_or(usize::MAX);
        sites = sites.saturating_mul(count);
    }
    if sites > MOST_PARTICLES {
        let problem = Problem::rule(format!("the lattice has {sites} sites"), "1e10 or fewer");
        return Err(table.refuse("counts", problem));
    }
    Ok(Lattice { lower: lower?.into(), counts: cells, spacing: spacing?, jitter: jitter? })
}

fn read_file(table: &mut TableReader<'_>, folder: &Path) -> Result<Arrangement, Reported> {
    let given = table.required("path", Text)?;
    let path = folder.join(given);
    let path = std::path::absolute(&path).unwrap_or(path);
    match read_points(&path) {
        Ok(grains) => Ok(Arrangement::File { path, grains }),
        Err(error @ (PointsError::Missing { .. } | PointsError::Unreadable { .. })) => Err(table
            .refuse_with_help(
                "path",
                Problem::Refused(Box::new(error)),
                "the path is relative to the folder of the scenario",
            )),
        Err(error) => Err(table.refuse("path", Problem::Refused(Box::new(error)))),
    }
}
