//! Groups of particles.

use super::arrangement::{Arrangement, MOST_PARTICLES, check_columns, read_arrangement};
use super::columns::{ParticleColumn, read_columns};
use super::materials::{Material, needs_density, read_material_with_density};
use super::radius::read_radius;
use crate::collision::{Sphere, unfit_for_numbers};
use crate::context::{Location, Reported};
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Integer};
use pulvis_boundary::Cuboid;
use pulvis_math::{Dimension, Vector3, elementary};
use pulvis_packing::{GasVelocities, RadiusDistribution};
use std::f64::consts::PI;
use std::path::Path;

/// Particles that have a material, a distribution of sizes and a start in common.
#[derive(Clone, Debug, PartialEq)]
pub struct ParticleGroup {
    /// Index of the material, which has a density; of the first particle where a file or a list tells them.
    pub material: usize,
    /// Number of particles, at least 1.
    pub count: usize,
    /// Radii; `None` where the file or the list of the arrangement gives them.
    pub radius: Option<RadiusDistribution>,
    /// Where the particles start.
    pub arrangement: Arrangement,
    /// How they move at the start.
    pub velocity: VelocityPlan,
    /// Further quantities; the same names in the same order for all groups.
    pub columns: Vec<ParticleColumn>,
}

impl ParticleGroup {
    /// Index of the material of a particle of the group.
    pub fn material_of(&self, number: usize) -> usize {
        self.arrangement.grains().get(number).and_then(|grain| grain.material).unwrap_or(self.material)
    }

    /// Number of particles of a material.
    pub fn count_of(&self, material: usize) -> usize {
        match self.arrangement.grains() {
            [] if self.material == material => self.count,
            [] => 0,
            grains => {
                grains.iter().filter(|grain| grain.material.unwrap_or(self.material) == material).count()
            }
        }
    }

    /// Indices of the materials of all particles, each once, ascending.
    pub fn materials(&self) -> Vec<usize> {
        let grains = self.arrangement.grains();
        if grains.is_empty() {
            return vec![self.material];
        }
        let mut materials: Vec<usize> =
            grains.iter().map(|grain| grain.material.unwrap_or(self.material)).collect();
        materials.sort_unstable();
        materials.dedup();
        materials
    }
}

/// Velocities at the start of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VelocityPlan {
    /// Mean velocity [m/s]; zero where the file or the list of the arrangement gives velocities.
    pub mean: Vector3,
    /// What is added at random: Gaussian components; momentum and temperature are those of the group.
    pub random: GasVelocities,
    /// Angular velocity of every particle [rad/s]; zero where the file or the list of the arrangement gives them.
    pub angular_velocity: Vector3,
}

/// A group and the place where its arrangement stands, for checks that need the walls.
pub(super) type PlacedGroup = (ParticleGroup, Location);

/// Reads `[[particles]]`; there may be none where inlets bring them.
pub(super) fn read_particles(
    root: &mut TableReader<'_>,
    materials: &[Material],
    folder: &Path,
) -> Result<Vec<PlacedGroup>, Reported> {
    let tables = root.tables("particles")?;
    if tables.is_empty() && !root.keys().contains(&"inlets") {
        return Err(root.refuse("particles", no_tables(root, "particles")));
    }
    let mut groups: Vec<Result<PlacedGroup, Reported>> = Vec::with_capacity(tables.len());
    for table in tables {
        // Where the first group is wrong, the others are compared with nothing.
        let first = match groups.first() {
            Some(Ok((group, _))) => Some(&group.columns[..]),
            _ => None,
        };
        let group = read_group(table, materials, folder, first);
        groups.push(group);
    }
    groups.into_iter().collect()
}

/// A list of tables that is missing or empty.
pub(super) fn no_tables(root: &TableReader<'_>, key: &str) -> Problem {
    let expected = format!("one or more tables [[{key}]]");
    if root.keys().contains(&key) {
        Problem::rule("the list is empty", expected)
    } else {
        Problem::MissingKey { key: key.to_owned(), expected }
    }
}

fn read_group(
    mut table: TableReader<'_>,
    materials: &[Material],
    folder: &Path,
    first: Option<&[ParticleColumn]>,
) -> Result<PlacedGroup, Reported> {
    // Asked for first, whoever gives it.
    table.value("material");
    let count = table.optional("count", Integer::between(1, MOST_PARTICLES));
    let place = table.location("arrangement");
    let arrangement =
        table.required_table("arrangement").and_then(|table| read_arrangement(table, materials, folder));
    let material = match &arrangement {
        // Whether one is needed is not known.
        &Err(reported) if table.value("material").is_none() => Err(reported),
        arrangement => read_group_material(&mut table, materials, arrangement.as_ref().ok()),
    };
    let radius = table.optional_table("radius").and_then(|radius| radius.map(read_radius).transpose());
    let velocity = table.optional_table("velocity");
    let velocity = velocity.and_then(|velocity| match velocity {
        Some(velocity) => read_velocity(velocity, arrangement.as_ref().ok()),
        None => Ok(VelocityPlan::default()),
    });
    let columns = read_columns(&mut table, first);
    let count = match (count, &arrangement) {
        (Ok(count), Ok(arrangement)) => fitting_count(&table, arrangement, count),
        (Err(reported), _) | (_, &Err(reported)) => Err(reported),
    };
    if let (Ok(1), Ok(VelocityPlan { random, .. })) = (&count, &velocity)
        && (random.zero_momentum || random.exact_temperature)
    {
        let found = "a single particle without momentum does not move";
        return Err(table.refuse("velocity", Problem::rule(found, "a gas of several particles")));
    }
    let radius = match (radius, &arrangement) {
        (Ok(radius), Ok(arrangement)) => fitting_radius(&table, arrangement, radius),
        (Err(reported), _) | (_, &Err(reported)) => Err(reported),
    };
    if let (Ok(material), Ok(Some(radius))) = (material, &radius) {
        check_masses(&table, materials.get(material), radius)?;
    }
    if let (Ok(material), Ok(None), Ok(arrangement)) = (material, &radius, &arrangement) {
        check_grains(&table, materials, material, arrangement)?;
    }
    if let (Ok(arrangement), Ok(columns)) = (&arrangement, &columns) {
        check_columns(&table, arrangement, columns)?;
    }
    if let (Ok(Arrangement::Random(block)), Ok(count), Ok(Some(radius))) = (&arrangement, &count, &radius) {
        fitting_block(&table, block, *count, radius.limits().0)?;
    }
    table.finish();
    let (material, count, radius) = (material?, count?, radius?);
    let (arrangement, velocity, columns) = (arrangement?, velocity?, columns?);
    Ok((ParticleGroup { material, count, radius, arrangement, velocity, columns }, place))
}

/// Refuses radii of which the engine cannot compute.
pub(super) fn check_masses(
    table: &TableReader<'_>,
    material: Option<&Material>,
    radius: &RadiusDistribution,
) -> Result<(), Reported> {
    let (smallest, largest) = radius.limits();
    match [smallest, largest].into_iter().find_map(|radius| unfit_for_numbers(&sphere(radius, material))) {
        Some(problem) => Err(table.refuse("radius", problem)),
        None => Ok(()),
    }
}

/// Refuses particles of a file or a list of which the engine cannot compute; those without a material of their own have that of the group.
fn check_grains(
    table: &TableReader<'_>,
    materials: &[Material],
    material: usize,
    arrangement: &Arrangement,
) -> Result<(), Reported> {
    let source = source_of(arrangement);
    for (number, grain) in arrangement.grains().iter().enumerate() {
        let Some(radius) = grain.radius else { continue };
        let sphere = sphere(radius, materials.get(grain.material.unwrap_or(material)));
        if let Some(Problem::Rule { found, expected }) = unfit_for_numbers(&sphere) {
            let found = format!("particle {} of the {source}: {found}", number + 1);
            return Err(table.refuse("arrangement", Problem::rule(found, expected)));
        }
    }
    Ok(())
}

/// What tells quantities of its particles, in words.
fn source_of(arrangement: &Arrangement) -> &'static str {
    if matches!(arrangement, Arrangement::List(_)) { "list" } else { "file" }
}

/// A particle of a radius [m]; what is wrong with a density is told elsewhere.
fn sphere(radius: f64, material: Option<&Material>) -> Sphere {
    let density = material.and_then(|material| material.density.filter(|value| value.is_finite()));
    Sphere { radius, mass: density.unwrap_or(1.0) * 4.0 / 3.0 * PI * elementary::powi(radius, 3) }
}

/// The material of a group, or of the first particle of its file or list; all that particles are made of have a density.
fn read_group_material(
    table: &mut TableReader<'_>,
    materials: &[Material],
    arrangement: Option<&Arrangement>,
) -> Result<usize, Reported> {
    let Some(arrangement) = arrangement.filter(|arrangement| arrangement.gives_materials()) else {
        return read_material_with_density(table, materials);
    };
    if table.value("material").is_some() {
        let source = source_of(arrangement);
        let found =
            format!("the {source} of the arrangement gives the materials, as its key `materials` says");
        return Err(table.refuse("material", Problem::rule(found, "no `material`")));
    }
    // Those that no particle has need no density.
    let mut used: Vec<usize> = arrangement.grains().iter().filter_map(|grain| grain.material).collect();
    used.sort_unstable();
    used.dedup();
    let known = used.iter().map(|&index| needs_density(table, "arrangement", materials, index));
    known.collect::<Result<Vec<_>, _>>()?;
    Ok(arrangement.grains().first().and_then(|grain| grain.material).unwrap_or(0))
}

/// The number of particles, which has to fit the arrangement.
fn fitting_count(
    table: &TableReader<'_>,
    arrangement: &Arrangement,
    given: Option<i64>,
) -> Result<usize, Reported> {
    let given = given.map(|count| usize::try_from(count).unwrap_or(usize::MAX));
    let listed = |kind: &str, positions: usize| match given {
        None => Ok(positions),
        Some(_) => {
            let expected = format!("no `count` beside a {kind}, which gives it");
            Err(table.refuse("count", Problem::rule("the number of particles is given twice", expected)))
        }
    };
    match arrangement {
        Arrangement::File { grains, .. } => listed("file", grains.len()),
        Arrangement::List(grains) => listed("list", grains.len()),
        Arrangement::Lattice(lattice) => {
            let sites = lattice.site_count();
            match given {
                Some(count) if count > sites => {
                    let found = format!("{count} particles do not fit on {sites} sites of the lattice");
                    Err(table.refuse("count", Problem::rule(found, "count <= number of sites")))
                }
                given => Ok(given.unwrap_or(sites)),
            }
        }
        Arrangement::Random(_) | Arrangement::Dense(_) | Arrangement::Aggregate { .. } => {
            given.ok_or_else(|| {
                let what = match arrangement {
                    Arrangement::Random(_) => "a random arrangement",
                    Arrangement::Dense(_) => "a dense arrangement",
                    _ => "an aggregate",
                };
                let expected = format!("the number of particles of {what}");
                table.refuse("count", Problem::MissingKey { key: "count".to_owned(), expected })
            })
        }
    }
}

/// The radii, which stand either here or in the file or the list of the arrangement.
fn fitting_radius(
    table: &TableReader<'_>,
    arrangement: &Arrangement,
    radius: Option<RadiusDistribution>,
) -> Result<Option<RadiusDistribution>, Reported> {
    match (&radius, arrangement.gives(|grain| grain.radius)) {
        (Some(_), true) => {
            let found = match arrangement {
                Arrangement::List(_) => "the list of the arrangement has `radii`",
                _ => "the file of the arrangement has a column `radius`",
            };
            Err(table.refuse("radius", Problem::rule(found, "no [particles.radius]")))
        }
        (None, false) => {
            let expected = "a table [particles.radius]".to_owned();
            Err(table.refuse("radius", Problem::MissingKey { key: "radius".to_owned(), expected }))
        }
        _ => Ok(radius),
    }
}

/// Solid fraction of the densest packing of equal spheres, π/√18 [1].
const DENSEST: f64 = 0.7405;

/// What cannot fit into a block even if all particles are as small as they may be.
fn fitting_block(table: &TableReader<'_>, block: &Cuboid, count: usize, radius: f64) -> Result<(), Reported> {
    let size = block.size();
    let shortest = size.x.min(size.y).min(size.z);
    if 2.0 * radius > shortest {
        let found = format!("the block is {shortest} m thin");
        let expected = format!("room for particles of radius {radius} m");
        return Err(table.refuse("arrangement", Problem::rule(found, expected)));
    }
    #[allow(clippy::cast_precision_loss)] // a share needs no more than a few digits
    let share = count as f64 * 4.0 / 3.0 * PI * elementary::powi(radius, 3) / block.volume();
    if share > DENSEST {
        let found = format!("{count} particles fill {:.0} % of the block or more", 100.0 * share);
        return Err(table.refuse("count", Problem::rule(found, "less than the densest packing, 74 %")));
    }
    Ok(())
}

/// Reads `[particles.velocity]`.
fn read_velocity(
    mut table: TableReader<'_>,
    arrangement: Option<&Arrangement>,
) -> Result<VelocityPlan, Reported> {
    let mean = table.optional("mean", Vector::of(Dimension::VELOCITY));
    let standard_deviation =
        table.optional("standard_deviation", QuantityRule::of(Dimension::VELOCITY).at_least(0.0));
    let zero_momentum = table.or("zero_momentum", Boolean, false);
    let exact_temperature = table.or("exact_temperature", Boolean, false);
    let spin = table.optional("spin", Vector::of(Dimension::RATE));
    let gives_velocity = arrangement.is_some_and(|one| one.gives(|grain| grain.velocity));
    let gives_spin = arrangement.is_some_and(|one| one.gives(|grain| grain.angular_velocity));
    let is_list = matches!(arrangement, Some(Arrangement::List(_)));
    let spin = match spin {
        Ok(Some(_)) if gives_spin => {
            let found = if is_list {
                "the list of the arrangement has `angular_velocities`"
            } else {
                "the file of the arrangement has the columns omegax, omegay, omegaz"
            };
            Err(table.refuse("spin", Problem::rule(found, "no `spin`")))
        }
        spin => spin,
    };
    let refused = |key: &str| {
        let found = if is_list {
            "the list of the arrangement has `velocities`"
        } else {
            "the file of the arrangement has the columns vx, vy, vz"
        };
        table.refuse(key, Problem::rule(found, format!("no `{key}`")))
    };
    let mean = match mean {
        Ok(Some(_)) if gives_velocity => Err(refused("mean")),
        mean => mean,
    };
    let standard_deviation = match standard_deviation {
        Ok(Some(_)) if gives_velocity => Err(refused("standard_deviation")),
        standard_deviation => standard_deviation,
    };
    let random = standard_deviation.and_then(|standard_deviation| {
        let standard_deviation = standard_deviation.unwrap_or(0.0);
        let (zero_momentum, exact_temperature) = (zero_momentum?, exact_temperature?);
        for (key, wanted) in [("zero_momentum", zero_momentum), ("exact_temperature", exact_temperature)] {
            if wanted && standard_deviation == 0.0 {
                let found = "nothing of the velocities is random";
                return Err(table.refuse(key, Problem::rule(found, "a `standard_deviation` beside it")));
            }
        }
        Ok(GasVelocities { standard_deviation, zero_momentum, exact_temperature })
    });
    table.finish();
    Ok(VelocityPlan {
        mean: mean?.unwrap_or_default().into(),
        random: random?,
        angular_velocity: spin?.unwrap_or_default().into(),
    })
}
