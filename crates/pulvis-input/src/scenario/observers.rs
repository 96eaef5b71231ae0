//! Observers: what is measured of the sample or of a part of it, in columns of the time series.

use super::axis::Axis;
use super::region::{read_region, write_region};
use super::resolved::writer::{Writer, list, quantity, text};
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Choice, Integer, Text};
use pulvis_boundary::{Cuboid, Domain, Region};
use pulvis_math::Dimension;

/// What is measured of a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Observer {
    /// Its name, which no other observer has: letters, digits and underscores.
    pub name: String,
    /// What it looks at; `None` is the whole sample.
    pub region: Option<Region>,
    /// What it measures, in the order of [`ObservedQuantity::ALL`], each once.
    pub quantities: Vec<ObservedQuantity>,
    /// Averages leave out this time from the start of each stage [s].
    pub discard: f64,
    /// Number of blocks that averages are taken over, at least 2.
    pub blocks: usize,
    /// With how many contacts a particle is no rattler.
    pub least_contacts: u32,
    /// Whether the distribution of normal forces is written at the end of each stage.
    pub histogram: bool,
}

/// A group of columns that an observer can have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum ObservedQuantity {
    /// Stress tensor, pressure, deviator, kinetic pressure.
    Stress,
    /// Number, solid fraction, mean velocity, granular temperature.
    Particles,
    /// Contacts, coordination with and without rattlers, rattlers.
    Coordination,
    /// Fabric tensors and their deviators.
    Fabric,
    /// Mean and largest normal force, share of contacts that pull.
    Forces,
    /// Force on every wall.
    Walls,
}

impl ObservedQuantity {
    /// All of them, with their names in a scenario.
    pub const ALL: [(&'static str, Self); 6] = [
        ("stress", Self::Stress),
        ("particles", Self::Particles),
        ("coordination", Self::Coordination),
        ("fabric", Self::Fabric),
        ("forces", Self::Forces),
        ("walls", Self::Walls),
    ];

    /// The name in a scenario.
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, quantity)| *quantity == self).map_or("", |(name, _)| name)
    }
}

/// Contacts that hold a particle without friction.
const DEFAULT_LEAST_CONTACTS: u32 = 4;

/// Blocks of averages where nothing is said.
const DEFAULT_BLOCKS: usize = 10;

/// Observers of a scenario: as many as regions can be looked at in one go.
const MOST_OBSERVERS: usize = 64;

/// Reads `[[observers]]`, in a periodic domain or a box, if there are.
pub(super) fn read_observers(
    root: &mut TableReader<'_>,
    domain: Option<&Domain>,
    enclosure: Option<&Cuboid>,
) -> Result<Vec<Observer>, Reported> {
    let tables = root.tables("observers")?;
    if tables.len() > MOST_OBSERVERS {
        let found = format!("{} observers", tables.len());
        let expected = format!("{MOST_OBSERVERS} at most");
        return Err(root.refuse("observers", Problem::rule(found, expected)));
    }
    let mut observers: Vec<Observer> = Vec::new();
    let mut failure = None;
    for table in tables {
        match read_observer(table, &observers, domain, enclosure) {
            Ok(observer) => observers.push(observer),
            Err(reported) => failure = Some(reported),
        }
    }
    failure.map_or(Ok(observers), Err)
}

fn read_observer(
    mut table: TableReader<'_>,
    before: &[Observer],
    domain: Option<&Domain>,
    enclosure: Option<&Cuboid>,
) -> Result<Observer, Reported> {
    let name = table.required("name", Text).and_then(|name| check_name(&table, name, before));
    let region = read_region(&mut table, "region")
        .and_then(|region| region.map(|region| check_region(&table, region, domain, enclosure)).transpose());
    let quantities = read_quantities(&mut table);
    let discard = table.or("discard", QuantityRule::of(Dimension::TIME).at_least(0.0), 0.0);
    let blocks = table.optional("blocks", Integer::between(2, 1_000_000));
    let least_contacts = table.optional("least_contacts", Integer::between(1, 12));
    let histogram = table.or("histogram", Boolean, false);
    table.finish();
    Ok(Observer {
        name: name?,
        region: region?,
        quantities: quantities?,
        discard: discard?,
        blocks: blocks?.map_or(DEFAULT_BLOCKS, |blocks| blocks.unsigned_abs() as usize),
        least_contacts: least_contacts?
            .and_then(|least| u32::try_from(least).ok())
            .unwrap_or(DEFAULT_LEAST_CONTACTS),
        histogram: histogram?,
    })
}

fn check_name(table: &TableReader<'_>, name: String, before: &[Observer]) -> Result<String, Reported> {
    if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') {
        let found = format!("{name:?} is no name for columns");
        return Err(table.refuse("name", Problem::rule(found, "only letters, digits and underscores")));
    }
    if before.iter().any(|observer| observer.name == name) {
        let found = format!("two observers are called {name:?}");
        return Err(table.refuse("name", Problem::rule(found, "another name for each observer")));
    }
    Ok(name)
}

fn read_quantities(table: &mut TableReader<'_>) -> Result<Vec<ObservedQuantity>, Reported> {
    let choices = List::of(Choice(&ObservedQuantity::ALL)).at_least(1);
    let Some(mut quantities) = table.optional("quantities", choices)? else {
        let all = ObservedQuantity::ALL.iter().map(|(_, quantity)| *quantity);
        return Ok(all.filter(|quantity| *quantity != ObservedQuantity::Walls).collect());
    };
    quantities.sort_unstable();
    if let Some(twice) = quantities.windows(2).find(|two| two[0] == two[1]) {
        let found = format!("\"{}\" stands here twice", twice[0].name());
        return Err(table.refuse("quantities", Problem::rule(found, "each quantity once")));
    }
    Ok(quantities)
}

/// Refuses a region that holds no part of the sample for certain, or parts of it twice.
pub(super) fn check_region(
    table: &TableReader<'_>,
    region: Region,
    domain: Option<&Domain>,
    enclosure: Option<&Cuboid>,
) -> Result<Region, Reported> {
    let [lower, upper] = region.bounds();
    for axis in Axis::ALL {
        let (name, index) = (axis.name(), axis.index());
        let (lower, upper) = (lower[index], upper[index]);
        let period = domain.and_then(|domain| domain.period(index));
        if let Some(period) = period.filter(|period| upper.is_finite() && upper - lower > *period) {
            let found =
                format!("it is {} m long along {name}, which repeats after {period} m", upper - lower);
            let expected = "a region that holds nothing twice";
            return Err(table.refuse("region", Problem::rule(found, expected)));
        }
        if let (None, Some(enclosure)) = (period, enclosure)
            && (upper <= enclosure.lower[index] || lower >= enclosure.upper[index])
        {
            let [from, to] = [enclosure.lower[index], enclosure.upper[index]];
            let found = format!("along {name} it goes from {lower} m to {upper} m, beside the box");
            let expected = format!("a part of the box, which goes from {from} m to {to} m at the start");
            return Err(table.refuse("region", Problem::rule(found, expected)));
        }
    }
    Ok(region)
}

/// Refuses an observer that leaves out all of every stage.
pub(super) fn check_discards(
    root: &TableReader<'_>,
    observers: &[Observer],
    durations: &[Option<f64>],
) -> Result<(), Reported> {
    let longest = durations.iter().copied().try_fold(0.0_f64, |longest, time| Some(longest.max(time?)));
    let Some(longest) = longest else { return Ok(()) };
    let Some(observer) = observers.iter().find(|observer| observer.discard >= longest) else { return Ok(()) };
    let (name, discard) = (&observer.name, observer.discard);
    let found =
        format!("observer {name:?} discards {discard} s of each stage, and none is longer than {longest} s");
    Err(root.refuse("observers", Problem::rule(found, "a stage of which something is left")))
}

/// Writes `[[observers]]`.
pub(super) fn write_observers(writer: &mut Writer, observers: &[Observer]) {
    for observer in observers {
        let Observer { name, region, quantities, discard, blocks, least_contacts, histogram } = observer;
        writer.item("observers");
        writer.key("name", text(name));
        writer.key("quantities", list(quantities.iter().map(|quantity| text(quantity.name()))));
        writer.key("discard", quantity(*discard, Dimension::TIME));
        writer.key("blocks", blocks.to_string());
        writer.key("least_contacts", least_contacts.to_string());
        writer.key("histogram", histogram.to_string());
        if let Some(region) = region {
            writer.table("observers.region");
            write_region(writer, region);
        }
    }
}

/// How long each stage lasts, where time alone ends it.
pub(super) fn durations(stages: &[super::stages::PlannedStage]) -> Vec<Option<f64>> {
    stages.iter().map(|stage| stage.until.time).collect()
}
