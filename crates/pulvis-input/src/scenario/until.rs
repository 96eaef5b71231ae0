//! When a stage ends. Each rule is a field of [`StopRules`], with a line where the rules are read and one where
//! they are written.

use super::axis::{Axis, AxisShape};
use super::openings::Opening;
use super::resolved::writer::{Writer, number, quantity, text};
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Choice, Integer, Name, Text};
use pulvis_boundary::UpperTriangular;
use pulvis_math::Dimension;
use pulvis_packing::Amount;

/// A stage ends as soon as any of these holds; at least one is given.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StopRules {
    /// Duration of the stage [s].
    pub time: Option<f64>,
    /// Kinetic over elastic energy falls to this [1], not before [`Self::minimum_time`].
    pub kinetic_to_elastic: Option<f64>,
    /// Time before which the energies are not looked at [s].
    pub minimum_time: f64,
    /// A sample is at rest only while the stress on every servo wall, and every stress that the cell follows, differs from the pressure at the end of its ramp by
    /// this share at most [1].
    pub pressure_tolerance: Option<f64>,
    /// The box has been strained so far.
    pub strain: Option<StrainRule>,
    /// The cell has been sheared so far.
    pub shear_strain: Option<ShearRule>,
    /// The stress on a pair of walls has been reached, or that of the cell along a periodic direction.
    pub stress: Option<StressRule>,
    /// So much has passed an inlet or outlet.
    pub passed: Option<PassedRule>,
    /// A column of the time series no longer drifts.
    pub steady: Option<SteadyRule>,
}

/// The means of a column of the time series over blocks of time no longer drift: over so many blocks in a row the straight line
/// through them changes by no more than its standard error, or than a share of their mean.
#[derive(Clone, Debug, PartialEq)]
pub struct SteadyRule {
    /// Name of the column.
    pub column: String,
    /// Duration of a block [s].
    pub block: f64,
    /// Number of blocks, three at least.
    pub blocks: u32,
    /// The share of the mean [1].
    pub tolerance: f64,
}

/// So much has passed an inlet or outlet since the start of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PassedRule {
    /// Index of the inlet, or that of the outlet plus the number of inlets.
    pub opening: usize,
    /// How much, greater than zero.
    pub amount: Amount,
}

impl StopRules {
    /// Whether no rule is given.
    pub fn is_empty(&self) -> bool {
        let &Self { minimum_time, pressure_tolerance, .. } = self;
        *self == Self { minimum_time, pressure_tolerance, ..Self::default() }
    }

    /// Whether something else than time may end the stage, so that nobody knows when.
    pub fn are_open_ended(&self) -> bool {
        !Self { time: None, ..self.clone() }.is_empty()
    }

    /// The rules that look at the two box walls of an axis, by their keys.
    pub(super) fn axes(&self) -> impl Iterator<Item = (&'static str, Axis)> {
        let strain = self.strain.map(|rule| ("strain", rule.axis));
        strain.into_iter().chain(self.stress.map(|rule| ("stress", rule.axis)))
    }
}

/// (L − L0)/L0 of the distance L of the two box walls, or of a period, reaches a value; L0 is L at the start of the stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainRule {
    /// Direction of L.
    pub axis: Axis,
    /// The strain [1]: positive for extension, negative for compression, never zero.
    pub value: f64,
}

/// The shear strain of the cell since the start of the stage reaches a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearRule {
    /// Its component: the place of xy, xz or yz in [`UpperTriangular::NAMES`].
    pub component: usize,
    /// The strain [1]; never zero.
    pub value: f64,
}

/// The mean compressive stress of the two box walls of an axis crosses a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StressRule {
    /// Direction of the normals of the walls.
    pub axis: Axis,
    /// The stress, compression positive [Pa].
    pub value: f64,
    /// From which side.
    pub crosses: Crossing,
}

/// The side from which a value is reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// From below.
    Upwards,
    /// From above.
    Downwards,
}

impl Crossing {
    /// The name in a scenario.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Upwards => "upwards",
            Self::Downwards => "downwards",
        }
    }
}

/// Reads `[stages.until]`; an absent table is an empty set of rules.
pub(super) fn read_until(stage: &mut TableReader<'_>, openings: &[Opening]) -> Result<StopRules, Reported> {
    let Some(mut table) = stage.optional_table("until")? else { return Ok(StopRules::default()) };
    let time = table.optional("time", QuantityRule::of(Dimension::TIME).above(0.0));
    let kinetic_to_elastic =
        table.optional("kinetic_to_elastic", QuantityRule::of(Dimension::NONE).above(0.0));
    let minimum_time = table.optional("minimum_time", QuantityRule::of(Dimension::TIME).at_least(0.0));
    let pressure_tolerance =
        table.optional("pressure_tolerance", QuantityRule::of(Dimension::NONE).above(0.0));
    let pressure_tolerance = match (pressure_tolerance, &kinetic_to_elastic) {
        (Ok(Some(_)), Ok(None)) => {
            let problem = Problem::rule("there is no `kinetic_to_elastic` beside it", "both or none of them");
            Err(table.refuse("pressure_tolerance", problem))
        }
        (tolerance, _) => tolerance,
    };
    let strain = table.optional_table("strain").and_then(|rule| rule.map(read_strain).transpose());
    let shear = table.optional_table("shear_strain").and_then(|rule| rule.map(read_shear).transpose());
    let stress = table.optional_table("stress").and_then(|rule| rule.map(read_stress).transpose());
    let passed = table
        .optional_table("passed")
        .and_then(|rule| rule.map(|rule| read_passed(rule, openings)).transpose());
    let steady = table.optional_table("steady").and_then(|rule| rule.map(read_steady).transpose());
    let minimum_time = match (minimum_time, &kinetic_to_elastic, &time) {
        (Ok(Some(_)), Ok(None), _) => {
            let problem =
                Problem::rule("there is no `kinetic_to_elastic` that it delays", "both or none of them");
            Err(table.refuse("minimum_time", problem))
        }
        (Ok(Some(minimum)), Ok(Some(_)), Ok(Some(time))) if minimum >= *time => {
            let found =
                format!("{minimum} s is not shorter than time = {time} s, which ends the stage first");
            Err(table.refuse("minimum_time", Problem::rule(found, "minimum_time < time")))
        }
        (minimum_time, ..) => minimum_time,
    };
    table.finish();
    Ok(StopRules {
        time: time?,
        kinetic_to_elastic: kinetic_to_elastic?,
        minimum_time: minimum_time?.unwrap_or(0.0),
        pressure_tolerance: pressure_tolerance?,
        strain: strain?,
        shear_strain: shear?,
        stress: stress?,
        passed: passed?,
        steady: steady?,
    })
}

/// Writes `[stages.until]`; `openings` are the names of inlets and outlets.
pub(super) fn write_until(writer: &mut Writer, until: &StopRules, openings: &[&str]) {
    if let Some(time) = until.time {
        writer.key("time", quantity(time, Dimension::TIME));
    }
    if let Some(ratio) = until.kinetic_to_elastic {
        writer.key("kinetic_to_elastic", number(ratio));
        writer.key("minimum_time", quantity(until.minimum_time, Dimension::TIME));
        if let Some(tolerance) = until.pressure_tolerance {
            writer.key("pressure_tolerance", number(tolerance));
        }
    }
    if let Some(rule) = until.strain {
        writer.key(
            "strain",
            format!("{{ axis = {}, value = {} }}", text(rule.axis.name()), number(rule.value)),
        );
    }
    if let Some(rule) = until.shear_strain {
        let (component, value) = (text(UpperTriangular::NAMES[rule.component]), number(rule.value));
        writer.key("shear_strain", format!("{{ component = {component}, value = {value} }}"));
    }
    if let Some(rule) = until.stress {
        let (axis, value) = (text(rule.axis.name()), quantity(rule.value, Dimension::PRESSURE));
        let crosses = text(rule.crosses.name());
        writer.key("stress", format!("{{ axis = {axis}, value = {value}, crosses = {crosses} }}"));
    }
    if let Some(SteadyRule { column, block, blocks, tolerance }) = &until.steady {
        let (column, block) = (text(column), quantity(*block, Dimension::TIME));
        let tolerance = number(*tolerance);
        let rule =
            format!("{{ column = {column}, block = {block}, blocks = {blocks}, tolerance = {tolerance} }}");
        writer.key("steady", rule);
    }
    if let Some(PassedRule { opening, amount }) = until.passed {
        let name = text(openings.get(opening).unwrap_or(&""));
        let amount = match amount {
            Amount::Number(number) => format!("number = {number:.0}"),
            Amount::Mass(mass) => format!("mass = {}", quantity(mass, Dimension::MASS)),
        };
        writer.key("passed", format!("{{ name = {name}, {amount} }}"));
    }
}

fn read_steady(mut table: TableReader<'_>) -> Result<SteadyRule, Reported> {
    let column = table.required("column", Text);
    let block = table.required("block", QuantityRule::of(Dimension::TIME).above(0.0));
    // A line through two points has no error.
    let blocks = table.or("blocks", Integer::between(3, 1000), 5);
    let tolerance = table.or("tolerance", QuantityRule::of(Dimension::NONE).at_least(0.0), 1e-3);
    table.finish();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 3 to 1000
    let blocks = blocks? as u32;
    Ok(SteadyRule { column: column?, block: block?, blocks, tolerance: tolerance? })
}

fn read_passed(mut table: TableReader<'_>, openings: &[Opening]) -> Result<PassedRule, Reported> {
    let names: Vec<&str> = openings.iter().map(|opening| opening.name.as_str()).collect();
    if names.is_empty() {
        let problem = Problem::rule("there is no inlet or outlet", "[[inlets]] or [[outlets]] to look at");
        return Err(table.refuse("", problem));
    }
    let name = table.required("name", Name(&names));
    let number = table.optional("number", Integer::between(1, 10_000_000_000));
    let mass = table.optional("mass", QuantityRule::of(Dimension::MASS).above(0.0));
    let amount = match (number?, mass?) {
        #[allow(clippy::cast_precision_loss)] // far below 2^53
        (Some(number), None) => Ok(Amount::Number(number as f64)),
        (None, Some(mass)) => Ok(Amount::Mass(mass)),
        (Some(_), Some(_)) => {
            Err(table.refuse("mass", Problem::rule("given beside `number`", "only one of them")))
        }
        (None, None) => {
            let expected = "how much has passed: `number` = 100 or `mass` = \"1 g\"".to_owned();
            Err(table.refuse("number", Problem::MissingKey { key: "number".to_owned(), expected }))
        }
    };
    let (name, amount) = (name?, amount?);
    let index = names.iter().position(|known| *known == name).unwrap_or(0);
    let never = match (amount, openings.get(index).and_then(|opening| opening.total)) {
        (Amount::Number(number), Some(Amount::Number(total))) => number > total,
        // The particle that would exceed a total mass does not come in.
        (Amount::Mass(mass), Some(Amount::Mass(total))) => mass >= total,
        _ => false,
    };
    if never {
        let found = format!("the inlet {name} brings in less than that in all");
        let expected = "`total_number` at most, or less than `total_mass`";
        return Err(table.refuse("", Problem::rule(found, expected)));
    }
    table.finish();
    Ok(PassedRule { opening: index, amount })
}

fn read_strain(mut table: TableReader<'_>) -> Result<StrainRule, Reported> {
    let axis = table.required("axis", AxisShape);
    // At -1 the walls touch.
    let value = table.required("value", QuantityRule::of(Dimension::NONE).above(-1.0)).and_then(|value| {
        if value == 0.0 {
            let expected = "a strain that is positive (extension) or negative (compression)";
            return Err(table.refuse("value", Problem::rule("a stage begins at strain 0", expected)));
        }
        Ok(value)
    });
    table.finish();
    Ok(StrainRule { axis: axis?, value: value? })
}

fn read_shear(mut table: TableReader<'_>) -> Result<ShearRule, Reported> {
    let choices = [("xy", 3), ("xz", 4), ("yz", 5)];
    let component = table.required("component", Choice(&choices));
    let value = table.required("value", QuantityRule::of(Dimension::NONE)).and_then(|value| {
        if value == 0.0 {
            let problem = Problem::rule("a stage begins at shear strain 0", "a shear strain other than 0");
            return Err(table.refuse("value", problem));
        }
        Ok(value)
    });
    table.finish();
    Ok(ShearRule { component: component?, value: value? })
}

fn read_stress(mut table: TableReader<'_>) -> Result<StressRule, Reported> {
    let axis = table.required("axis", AxisShape);
    let value = table.required("value", Dimension::PRESSURE);
    let choices = [("upwards", Crossing::Upwards), ("downwards", Crossing::Downwards)];
    let crosses = table.required("crosses", Choice(&choices));
    table.finish();
    Ok(StressRule { axis: axis?, value: value?, crosses: crosses? })
}
