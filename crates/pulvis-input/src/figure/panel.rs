//! One chart of a figure.

use super::Surroundings;
use super::axis::{FigureAxis, read_axis};
use super::data::FigureData;
use super::feature::Feature;
use super::quantity::Family;
use super::series::{FigureSeries, families, read_feature_series, read_series};
use super::settings::Variant;
use crate::context::Reported;
use crate::list::List;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::reader::TableReader;
use crate::shape::{Boolean, Text};
use pulvis_math::Dimension;

/// A straight line, on logarithmic axes a power law.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// What it is called.
    pub label: String,
    /// Its ends, in the units of the axes.
    pub ends: [[f64; 2]; 2],
}

/// A chart of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct FigurePanel {
    /// Text above it.
    pub title: String,
    /// What its quantities are properties of.
    pub family: Family,
    /// The horizontal axis.
    pub x: FigureAxis,
    /// The vertical axis.
    pub y: FigureAxis,
    /// Its curves.
    pub series: Vec<FigureSeries>,
    /// Lines for the eye.
    pub guides: Vec<Guide>,
    /// Whether the limits of sticking are marked, where closed forms tell them.
    pub limits: bool,
}

/// Reads all `[[panels]]`.
pub(super) fn read_panels(
    root: &mut TableReader<'_>,
    known: (&[FigureData], &[Variant], Result<&[Feature], Reported>),
    around: &Surroundings<'_>,
) -> Result<Vec<FigurePanel>, Reported> {
    let tables = root.tables("panels")?;
    if tables.is_empty() {
        let expected = "one table [[panels]] for each chart".to_owned();
        return Err(root.refuse("panels", Problem::MissingKey { key: "panels".to_owned(), expected }));
    }
    let panels: Vec<_> = tables.into_iter().map(|table| read_panel(table, known, around)).collect();
    panels.into_iter().collect()
}

fn read_panel(
    mut table: TableReader<'_>,
    (data, variants, features): (&[FigureData], &[Variant], Result<&[Feature], Reported>),
    around: &Surroundings<'_>,
) -> Result<FigurePanel, Reported> {
    let title = table.or("title", Text, String::new());
    let limits = table.or("limits", Boolean, false);
    let axes = [table.required_table("x"), table.required_table("y")];
    let series = table.tables("series");
    let guides = table.tables("guides");
    let [x, y] = axes;
    let (mut x, mut y, series, guides) = (x?, y?, series?, guides?);
    let family = family(&mut x, &mut y, data);
    let guides: Vec<_> = guides.into_iter().map(read_guide).collect();
    let axes = (read_axis(x, family), read_axis(y, family));
    let y = axes.1.as_ref().ok();
    let read = |series| match family {
        Family::Feature => read_feature_series(series, features?, around),
        _ => read_series(series, (data, variants), (family, y), around),
    };
    let series: Vec<_> = series.into_iter().map(read).collect();
    if series.is_empty() {
        let expected = "one table [[panels.series]] for each curve".to_owned();
        return Err(table.refuse("series", Problem::MissingKey { key: "series".to_owned(), expected }));
    }
    table.finish();
    Ok(FigurePanel {
        title: title?,
        family,
        x: axes.0?,
        y: axes.1?,
        series: series.into_iter().collect::<Result<_, _>>()?,
        guides: guides.into_iter().collect::<Result<_, _>>()?,
        limits: limits?,
    })
}

/// The family that knows the quantities of both axes; if none does, one that some data has, whose messages follow.
fn family(x: &mut TableReader<'_>, y: &mut TableReader<'_>, data: &[FigureData]) -> Family {
    let possible: Vec<Family> = data.iter().flat_map(families).copied().collect();
    let knows = |axis: &mut TableReader<'_>, family: Family| {
        axis.value("quantity").and_then(|value| family.find(value.text()?)).is_some()
    };
    if knows(x, Family::Feature) && knows(y, Family::Feature) {
        return Family::Feature;
    }
    let both = possible.iter().find(|family| knows(x, **family) && knows(y, **family));
    let one = possible.iter().find(|family| knows(x, **family) || knows(y, **family));
    both.or(one).or(possible.first()).copied().unwrap_or(Family::Collision)
}

fn read_guide(mut table: TableReader<'_>) -> Result<Guide, Reported> {
    let label = table.or("label", Text, String::new());
    let point = || List::of(QuantityRule::of(Dimension::NONE)).exactly(2);
    let ends = [table.required("from", point()), table.required("to", point())];
    table.finish();
    let [from, to] = ends;
    let pair =
        |point: Vec<f64>| [point.first(), point.get(1)].map(|value| value.copied().unwrap_or(f64::NAN));
    Ok(Guide { label: label?, ends: [pair(from?), pair(to?)] })
}
