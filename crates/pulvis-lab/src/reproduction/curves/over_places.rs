//! Points of numbers that were seen in runs, over the places that they belong to.

use super::{Curve, FORMULA, FORMULA_POINTS, method, of_table};
use crate::reproduction::SeenFeature;
use pulvis_input::figure::{FigurePanel, FigureSeries, Formula, Show};
use pulvis_io::plot::SeriesStyle;
use pulvis_math::elementary;

/// Numbers seen in runs over their places: each variant by a cross and the mean by a ring, or what is held against them.
pub(super) fn of_features(
    panel: &FigurePanel,
    series: &FigureSeries,
    features: &[SeenFeature],
) -> Vec<Curve> {
    let chosen = match &series.show {
        Show::Features(chosen) => chosen,
        Show::Formula(formula) => return vec![between_features(panel, formula, features)],
        Show::Reference(table) => return vec![of_table(panel, series, table, panel.y.quantity.name)],
        _ => return Vec::new(),
    };
    let place = |at: f64, value: f64| (panel.x.factor * at, panel.y.factor * value);
    let (mut means, mut single) = (Vec::new(), Vec::new());
    for seen in chosen.iter().filter_map(|number| features.get(*number)) {
        let Some(at) = seen.feature.at else { continue };
        means.push(place(at, seen.mean()));
        if seen.values.len() > 1 {
            single.extend(seen.values.iter().map(|(_, value)| place(at, *value)));
        }
    }
    let name = panel.y.quantity.name;
    let identity = (series.data, chosen.first().copied().unwrap_or(0), None, name);
    let mut curves = vec![Curve::plain(identity, None, method(&series.show, false), means)];
    if !single.is_empty() {
        curves.push(Curve::plain(identity, None, ("single runs", SeriesStyle::Crosses), single));
    }
    curves
}

/// A closed form between the first and the last feature that the panel shows.
fn between_features(panel: &FigurePanel, formula: &Formula, features: &[SeenFeature]) -> Curve {
    let shown = panel.series.iter().flat_map(|series| match &series.show {
        Show::Features(chosen) => chosen.as_slice(),
        _ => &[],
    });
    let places = shown.filter_map(|number| features.get(*number)?.feature.at);
    let (low, high) =
        places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    let point = |number: usize| {
        let share = number as f64 / FORMULA_POINTS as f64;
        let x = if panel.x.logarithmic {
            low * elementary::powf(high / low, share)
        } else {
            low + (high - low) * share
        };
        (panel.x.factor * x, panel.y.factor * formula.at(x))
    };
    // Each closed form has a colour of its own.
    let own = usize::try_from(formula.amplitude.to_bits() ^ formula.offset.to_bits()).unwrap_or(0);
    let identity = (FORMULA, own, None, panel.y.quantity.name);
    let look = ("closed form", SeriesStyle::Line);
    Curve::plain(identity, None, look, (0..=FORMULA_POINTS).map(point).collect())
}
