//! One axis of a panel.

use super::expression::checked;
use super::quantity::{Family, Quantity, Scale};
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Text};
use pulvis_math::Dimension;

/// What an axis shows.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureAxis {
    /// The quantity.
    pub quantity: Quantity,
    /// In which unit.
    pub scale: Scale,
    /// Quantity and unit in words.
    pub label: String,
    /// Whether equal ratios have equal lengths.
    pub logarithmic: bool,
    /// By what values are multiplied before they are shown: -1 turns an axis round.
    pub factor: f64,
    /// Its ends, in its unit.
    pub range: Option<[f64; 2]>,
}

impl FigureAxis {
    /// What it shows, in the words of the file: `overlap/delta_p`, or with its SI unit `overlap [m]`.
    pub fn key(&self) -> String {
        self.key_of(self.quantity.name)
    }

    /// The same of another quantity of its unit.
    pub fn key_of(&self, name: &str) -> String {
        let unit = self.quantity.unit;
        let named = Scale::NAMED.into_iter().find(|(_, scale, _, _)| *scale == self.scale);
        named.map_or_else(|| format!("{name} [{unit}]"), |(per, _, _, _)| format!("{name}/{per}"))
    }
}

/// Reads a quantity of a `family`, or one of those `beside` it.
pub(super) fn read_quantity(
    table: &mut TableReader<'_>,
    key: &str,
    family: Family,
    beside: &[Quantity],
) -> Result<Quantity, Reported> {
    let name = table.required(key, Text)?;
    let all = || family.quantities().iter().chain(beside);
    let found = all().find(|quantity| quantity.name == name).copied();
    if found.is_none() && family == Family::Run {
        // Whether the runs have such columns is known once all of them have been read.
        return checked(table, key, name).map(|name| Quantity::of_expression(&name));
    }
    found.ok_or_else(|| {
        let known: Vec<&str> = all().map(|quantity| quantity.name).collect();
        table.refuse(key, Problem::unknown_choice(&name, &known))
    })
}

/// Reads the unit in which a quantity is shown.
pub(super) fn read_scale(table: &mut TableReader<'_>, quantity: &Quantity) -> Result<Scale, Reported> {
    let Some(name) = table.optional("per", Text)? else { return Ok(Scale::Si) };
    let fitting = Scale::NAMED.into_iter().filter(|(_, _, _, unit)| *unit == quantity.unit);
    let fitting: Vec<_> = fitting.collect();
    let found = fitting.iter().find(|(known, _, _, _)| *known == name);
    found.map(|(_, scale, _, _)| *scale).ok_or_else(|| {
        let known: Vec<&str> = fitting.iter().map(|(known, _, _, _)| *known).collect();
        let problem = if known.is_empty() {
            let found = format!("`{}` [{}] has no other unit", quantity.name, quantity.unit);
            Problem::rule(found, "no `per`")
        } else {
            Problem::unknown_choice(&name, &known)
        };
        table.refuse("per", problem)
    })
}

/// Reads an axis whose quantity is one of a `family`.
pub(super) fn read_axis(mut table: TableReader<'_>, family: Family) -> Result<FigureAxis, Reported> {
    let quantity = read_quantity(&mut table, "quantity", family, &[]);
    let scale = match &quantity {
        Ok(quantity) => read_scale(&mut table, quantity),
        Err(reported) => table.value("per").map_or(Ok(Scale::Si), |_| Err(*reported)),
    };
    let label = table.optional("label", Text);
    let logarithmic = table.or("log", Boolean, false);
    let factor = table.or("factor", QuantityRule::of(Dimension::NONE), 1.0).and_then(|factor| {
        let zero = || table.refuse("factor", Problem::rule("everything would be zero", "another number"));
        if factor == 0.0 { Err(zero()) } else { Ok(factor) }
    });
    let ends = List::of(QuantityRule::of(Dimension::NONE)).exactly(2);
    let range = table.optional("range", ends);
    let (logarithmic, range) = (logarithmic?, range?);
    let range = match range.as_deref() {
        Some([low, high]) if low < high && (*low > 0.0 || !logarithmic) => Some([*low, *high]),
        Some(_) => {
            let found = "an axis that does not go up, or a logarithmic one that begins at zero or below";
            return Err(table.refuse("range", Problem::rule(found, "two ends, the lower one first")));
        }
        None => None,
    };
    table.finish();
    let (quantity, scale) = (quantity?, scale?);
    let label = label?.unwrap_or_else(|| scale.label(&quantity));
    Ok(FigureAxis { quantity, scale, label, logarithmic, factor: factor?, range })
}
