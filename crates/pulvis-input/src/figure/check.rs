//! What a figure has to fulfil.

use super::axis::{read_quantity, read_scale};
use super::data::{FigureData, chosen, contact};
use super::quantity::{Family, JUDGED, Quantity, Scale};
use super::reference::{ReferenceTable, read_reference};
use super::series::{families, read_case};
use super::{Experiment, Surroundings};
use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Name, Text};
use pulvis_math::Dimension;

/// What a result is compared with.
#[derive(Clone, Debug, PartialEq)]
pub enum Against {
    /// The closed form.
    Theory,
    /// The exact method.
    Exact,
    /// A table of another program's values, over one of its columns.
    Reference {
        /// The table.
        table: ReferenceTable,
        /// The column that says where.
        over: Quantity,
    },
}

/// A largest deviation that a figure may have.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureCheck {
    /// Index of the data.
    pub data: usize,
    /// Whether the engine's integrator is judged, not the exact method.
    pub of_engine: bool,
    /// What its quantity is a property of.
    pub family: Family,
    /// What is compared.
    pub quantity: Quantity,
    /// In which unit.
    pub scale: Scale,
    /// With what.
    pub against: Against,
    /// Of one contact only: its number.
    pub contact: Option<usize>,
    /// Of one collision of a sweep only.
    pub case: Option<usize>,
    /// The largest deviation that is allowed, in the unit.
    pub most: f64,
    /// Why this much is allowed.
    pub why: String,
}

/// Reads all `[[checks]]`.
pub(super) fn read_checks(
    root: &mut TableReader<'_>,
    data: &[FigureData],
    around: &Surroundings<'_>,
) -> Result<Vec<FigureCheck>, Reported> {
    let tables = root.tables("checks")?;
    let checks: Vec<_> = tables.into_iter().map(|table| read_check(table, data, around)).collect();
    checks.into_iter().collect()
}

fn read_check(
    mut table: TableReader<'_>,
    data: &[FigureData],
    around: &Surroundings<'_>,
) -> Result<FigureCheck, Reported> {
    let index = chosen(&mut table, data)?;
    let one = data.get(index).ok_or_else(|| table.refuse("data", Problem::rule("no such data", "a name")))?;
    if matches!(one.experiment, Experiment::Runs(_)) {
        let problem = Problem::rule("runs have no theory to be held against", "[[features]]");
        return Err(table.refuse("data", problem));
    }
    let is_probe = matches!(one.experiment, Experiment::Probe(_));
    let method = table.or("method", Name(&["exact", "engine"]), "exact");
    let against = table.required("against", Name(&["theory", "exact", "reference"]));
    let most = table.required("most", QuantityRule::of(Dimension::NONE).at_least(0.0));
    let why = table.required("why", Text);
    let contact = contact(&mut table, one);
    let case = read_case(&mut table, one);
    let (method, against) = (method?, against?);
    let family = match (against, families(one)) {
        ("reference", [.., last]) => *last,
        (_, [first, ..]) => *first,
        (_, []) => Family::Collision,
    };
    let beside = if family == Family::Collision { JUDGED } else { &[] };
    let quantity = read_quantity(&mut table, "quantity", family, beside);
    let scale = quantity.and_then(|quantity| Ok((quantity, read_scale(&mut table, &quantity)?)));
    let against = match against {
        "theory" | "exact" if is_probe => {
            let problem = Problem::rule("no closed form follows a prescribed path", "\"reference\"");
            Err(table.refuse("against", problem))
        }
        "theory" => Ok(Against::Theory),
        "exact" if method == "exact" => {
            let problem = Problem::rule("the exact method agrees with itself", "\"theory\" or \"reference\"");
            Err(table.refuse("against", problem))
        }
        "exact" => Ok(Against::Exact),
        _ => read_against(&mut table, family, scale.map(|(quantity, _)| quantity), around),
    };
    let (quantity, scale) = scale?;
    table.finish();
    Ok(FigureCheck {
        data: index,
        of_engine: method == "engine",
        family,
        quantity,
        scale,
        against: against?,
        contact: contact?,
        case: case?,
        most: most?,
        why: why?,
    })
}

/// A table of reference values with a column of the quantity, and one that says where.
fn read_against(
    table: &mut TableReader<'_>,
    family: Family,
    quantity: Result<Quantity, Reported>,
    around: &Surroundings<'_>,
) -> Result<Against, Reported> {
    let over = read_quantity(table, "over", family, &[]);
    let reference = read_reference(table, "file", around);
    let (quantity, over, reference) = (quantity?, over?, reference?);
    for needed in [quantity, over] {
        if reference.column(needed.name).is_none() {
            let found = format!("the table has the columns {}", reference.columns.join(", "));
            return Err(table.refuse("file", Problem::rule(found, format!("a column `{}`", needed.name))));
        }
    }
    Ok(Against::Reference { table: reference, over })
}
