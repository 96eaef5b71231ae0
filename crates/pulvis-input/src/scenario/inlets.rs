//! Inlets: particles that come in while a run goes on.

use super::axis::Axis;
use super::columns::{ParticleColumn, read_columns};
use super::materials::{Material, read_material_with_density};
use super::openings::{
    Schedule, read_name, read_schedule, read_size_classes, write_schedule, write_size_classes,
};
use super::particles::{PlacedGroup, check_masses};
use super::radius::read_radius;
use super::region::{read_region, write_region};
use super::resolved::bodies::write_radius;
use super::resolved::writer::{Writer, quantity, text, vector};
use crate::context::{Location, Reported};
use crate::list::Vector;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::Integer;
use pulvis_boundary::{Cuboid, Domain, Region};
use pulvis_math::{Dimension, Vector3};
use pulvis_packing::{Amount, RadiusDistribution};

/// Particles of one material that come into a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Inlet {
    /// Its name, which no other inlet, outlet or observer has: letters, digits and underscores.
    pub name: String,
    /// Index of the material, which has a density.
    pub material: usize,
    /// Where particles come in, whole; bounded in all directions.
    pub region: Region,
    /// How much in a second.
    pub rate: Amount,
    /// How much in all; without end where it is `None`.
    pub total: Option<Amount>,
    /// Radii.
    pub radius: RadiusDistribution,
    /// Mean velocity [m/s].
    pub velocity: Vector3,
    /// Standard deviation of each component of the velocity, Gaussian [m/s].
    pub standard_deviation: f64,
    /// Angular velocity of every particle [rad/s].
    pub angular_velocity: Vector3,
    /// Further quantities; the same names in the same order as those of all groups of particles.
    pub columns: Vec<ParticleColumn>,
    /// Seed of its random numbers; that of the scenario where it is `None`.
    pub seed: Option<u64>,
    /// When it is open.
    pub schedule: Schedule,
    /// Time between two instants at which particles come in [s]; chosen by the run where it is `None`.
    pub interval: Option<f64>,
    /// How long a particle may wait for room before the run stops [s]; 20 intervals where it is `None`.
    pub max_delay: Option<f64>,
    /// Radii between classes of size that are counted apart [m], rising.
    pub size_classes: Vec<f64>,
}

/// What bounds a region: periodic directions and a box, if there are.
type Around<'a> = (Option<&'a Domain>, Option<&'a Cuboid>);

/// Reads `[[inlets]]`, with the places of their `stages`.
pub(super) fn read_inlets(
    root: &mut TableReader<'_>,
    materials: &[Material],
    groups: Option<&[PlacedGroup]>,
    around: Around<'_>,
    names: &mut Vec<String>,
) -> Result<Vec<(Inlet, Location)>, Reported> {
    let tables = root.tables("inlets")?;
    if tables.is_empty() && root.keys().contains(&"inlets") && groups.is_some_and(<[_]>::is_empty) {
        let problem = Problem::rule("the list is empty", "one or more tables [[inlets]] or [[particles]]");
        return Err(root.refuse("inlets", problem));
    }
    let mut inlets: Vec<Result<(Inlet, Location), Reported>> = Vec::with_capacity(tables.len());
    for table in tables {
        let group = groups.and_then(<[_]>::first).map(|(group, _)| &group.columns[..]);
        let first = group.or(match inlets.first() {
            Some(Ok((inlet, _))) => Some(&inlet.columns[..]),
            _ => None,
        });
        let inlet = read_inlet(table, materials, first, around, names);
        inlets.push(inlet);
    }
    inlets.into_iter().collect()
}

fn read_inlet(
    mut table: TableReader<'_>,
    materials: &[Material],
    first: Option<&[ParticleColumn]>,
    around: Around<'_>,
    names: &mut Vec<String>,
) -> Result<(Inlet, Location), Reported> {
    let name = read_name(&mut table, names);
    let material = read_material_with_density(&mut table, materials);
    let region = read_region(&mut table, "region").and_then(|region| match region {
        Some(region) => bounded(&table, region, around),
        None => {
            let expected = "a table [inlets.region], where particles come in".to_owned();
            Err(table.refuse("region", Problem::MissingKey { key: "region".to_owned(), expected }))
        }
    });
    let rate = read_rate(&mut table);
    let total = read_total(&mut table);
    let radius = table.required_table("radius").and_then(read_radius);
    let velocity = read_velocity(&mut table);
    let columns = read_columns(&mut table, first);
    let seed = table.optional("seed", Integer::at_least(0));
    let schedule = read_schedule(&mut table);
    let positive = QuantityRule::of(Dimension::TIME).above(0.0);
    let interval = table.optional("interval", positive);
    let max_delay = table.optional("max_delay", positive.or_infinite());
    let size_classes = read_size_classes(&mut table);
    if let (Ok(material), Ok(radius)) = (material, &radius) {
        check_masses(&table, materials.get(material), radius)?;
    }
    if let (Ok(region), Ok(radius)) = (&region, &radius) {
        check_room(&table, region, radius, around.0)?;
    }
    table.finish();
    let ((velocity, standard_deviation, angular_velocity), (schedule, place)) = (velocity?, schedule?);
    let inlet = Inlet {
        name: name?,
        material: material?,
        region: region?,
        rate: rate?,
        total: total?,
        radius: radius?,
        velocity,
        standard_deviation,
        angular_velocity,
        columns: columns?,
        seed: seed?.map(i64::unsigned_abs),
        schedule,
        interval: interval?,
        max_delay: max_delay?,
        size_classes: size_classes?,
    };
    Ok((inlet, place))
}

/// The region with an end in every direction: what has none ends with the box, or with the period.
fn bounded(
    table: &TableReader<'_>,
    region: Region,
    (domain, enclosure): Around<'_>,
) -> Result<Region, Reported> {
    let [mut lower, mut upper] = region.bounds();
    for axis in Axis::ALL {
        let (name, index) = (axis.name(), axis.index());
        let period = domain.filter(|domain| domain.periodic[index]);
        if !(lower[index].is_finite() && upper[index].is_finite()) {
            let Some(extent) = period.map(|domain| &domain.extent).or(enclosure) else {
                let found = format!("it has no end along {name}");
                let expected = "a region that ends in all directions, or a [box]";
                return Err(table.refuse("region", Problem::rule(found, expected)));
            };
            *lower.component_mut(index) = extent.lower[index];
            *upper.component_mut(index) = extent.upper[index];
        }
        if let Some(period) = period.and_then(|domain| domain.period(index))
            && upper[index] - lower[index] > period
        {
            let length = upper[index] - lower[index];
            let found = format!("it is {length} m long along {name}, which repeats after {period} m");
            return Err(table.refuse("region", Problem::rule(found, "a region that holds nothing twice")));
        }
    }
    Ok(match region {
        Region::Layer { .. } => Region::Box(Cuboid { lower, upper }),
        other => other,
    })
}

/// Refuses particles that do not lie whole in the region.
fn check_room(
    table: &TableReader<'_>,
    region: &Region,
    radius: &RadiusDistribution,
    domain: Option<&Domain>,
) -> Result<(), Reported> {
    let (_, largest) = radius.limits();
    if region.inset(largest, domain.unwrap_or(&Domain::unbounded())).is_some() {
        return Ok(());
    }
    let found = format!("a particle of radius {largest} m does not lie whole in it");
    Err(table.refuse("region", Problem::rule(found, "a region that is wider than the largest particle")))
}

fn read_rate(table: &mut TableReader<'_>) -> Result<Amount, Reported> {
    let number = table.optional("number_rate", QuantityRule::of(Dimension::RATE).above(0.0));
    let mass = table.optional("mass_rate", QuantityRule::of(Dimension::DASHPOT).above(0.0));
    match (number?, mass?) {
        (Some(number), None) => Ok(Amount::Number(number)),
        (None, Some(mass)) => Ok(Amount::Mass(mass)),
        (Some(_), Some(_)) => {
            Err(table.refuse("mass_rate", Problem::rule("given beside `number_rate`", "only one of them")))
        }
        (None, None) => {
            let expected =
                "how much comes in: `mass_rate` = \"1 g/s\" or `number_rate` = \"100 1/s\"".to_owned();
            Err(table.refuse("mass_rate", Problem::MissingKey { key: "mass_rate".to_owned(), expected }))
        }
    }
}

fn read_total(table: &mut TableReader<'_>) -> Result<Option<Amount>, Reported> {
    let number = table.optional("total_number", Integer::between(1, 10_000_000_000));
    let mass = table.optional("total_mass", QuantityRule::of(Dimension::MASS).above(0.0));
    match (number?, mass?) {
        #[allow(clippy::cast_precision_loss)] // far below 2^53
        (Some(number), None) => Ok(Some(Amount::Number(number as f64))),
        (None, Some(mass)) => Ok(Some(Amount::Mass(mass))),
        (None, None) => Ok(None),
        (Some(_), Some(_)) => {
            Err(table.refuse("total_mass", Problem::rule("given beside `total_number`", "only one of them")))
        }
    }
}

/// Mean velocity, standard deviation and angular velocity.
fn read_velocity(inlet: &mut TableReader<'_>) -> Result<(Vector3, f64, Vector3), Reported> {
    let Some(mut table) = inlet.optional_table("velocity")? else {
        return Ok((Vector3::zero(), 0.0, Vector3::zero()));
    };
    let mean = table.or("mean", Vector::of(Dimension::VELOCITY), [0.0; 3]);
    let rule = QuantityRule::of(Dimension::VELOCITY).at_least(0.0);
    let standard_deviation = table.or("standard_deviation", rule, 0.0);
    let spin = table.or("spin", Vector::of(Dimension::RATE), [0.0; 3]);
    table.finish();
    Ok((mean?.into(), standard_deviation?, spin?.into()))
}

/// Writes `[[inlets]]`; `material` gives the name of a material as TOML.
pub(super) fn write_inlets(writer: &mut Writer, inlets: &[Inlet], material: impl Fn(usize) -> String) {
    for inlet in inlets {
        writer.item("inlets");
        writer.key("name", text(&inlet.name));
        writer.key("material", material(inlet.material));
        match inlet.rate {
            Amount::Number(rate) => writer.key("number_rate", quantity(rate, Dimension::RATE)),
            Amount::Mass(rate) => writer.key("mass_rate", quantity(rate, Dimension::DASHPOT)),
        }
        match inlet.total {
            Some(Amount::Number(total)) => writer.key("total_number", format!("{total:.0}")),
            Some(Amount::Mass(total)) => writer.key("total_mass", quantity(total, Dimension::MASS)),
            None => {}
        }
        if let Some(seed) = inlet.seed {
            writer.key("seed", seed.to_string());
        }
        write_schedule(writer, &inlet.schedule);
        for (key, value) in [("interval", inlet.interval), ("max_delay", inlet.max_delay)] {
            if let Some(value) = value {
                writer.key(key, quantity(value, Dimension::TIME));
            }
        }
        write_size_classes(writer, &inlet.size_classes);
        writer.table("inlets.region");
        write_region(writer, &inlet.region);
        writer.table("inlets.radius");
        write_radius(writer, &inlet.radius);
        writer.table("inlets.velocity");
        writer.key("mean", vector(inlet.velocity, Dimension::VELOCITY));
        writer.key("standard_deviation", quantity(inlet.standard_deviation, Dimension::VELOCITY));
        writer.key("spin", vector(inlet.angular_velocity, Dimension::RATE));
        if !inlet.columns.is_empty() {
            writer.table("inlets.columns");
        }
        for column in &inlet.columns {
            writer.key(&column.name, quantity(column.value, column.dimension));
        }
    }
}
