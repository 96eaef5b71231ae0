//! Curves that are checked and prepared once.

use std::sync::{Mutex, PoisonError};

use super::pieces::{Elastic, ElasticPiece, Loading, LoadingPiece, Starts};
use crate::catalogue::InvalidParameter;

/// The largest number of points of a curve: every piece has a number among the branches of the law.
pub(super) const MOST_POINTS: usize = 100;

/// By how much unloading may be less steep than loading for round-off, as a share.
const ROUND_OFF: f64 = 1e-12;

/// The curves of loading and unloading, prepared for the loop over contacts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurveTable {
    pub(super) loading: Loading,
    pub(super) elastic: Elastic,
    /// Where the pieces of the loading curve start.
    loading_starts: Starts,
    last_overlap: f64,
    steepest: f64,
}

/// Overlaps [m] and forces [N] of a curve.
type Points<'v> = (&'v [f64], &'v [f64]);

/// The tables of all laws. A law is a plain number for the loops, so that its table has to live as long as the program does.
static TABLES: Mutex<Vec<&'static CurveTable>> = Mutex::new(Vec::new());

impl CurveTable {
    /// The table of two curves, of loading alone for an elastic contact. Equal curves have one table.
    pub(super) fn of(
        loading: Points<'_>,
        unloading: Option<Points<'_>>,
    ) -> Result<&'static Self, InvalidParameter> {
        let table = Self::new(loading, unloading)?;
        let mut known = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(same) = known.iter().find(|known| ***known == table) {
            return Ok(same);
        }
        let kept: &'static Self = Box::leak(Box::new(table));
        known.push(kept);
        Ok(kept)
    }

    fn new(loading: Points<'_>, unloading: Option<Points<'_>>) -> Result<Self, InvalidParameter> {
        let load = Curve::new(["loading_overlap", "loading_force"], loading)?;
        if load.overlaps.first() != Some(&0.0) {
            return Err(first(
                "loading_overlap",
                load.overlaps,
                "0 m",
                "the curve starts where bodies touch",
            ));
        }
        let unload = match unloading {
            Some(points) => Curve::new(["unloading_overlap", "unloading_force"], points)?,
            None => load.clone(),
        };
        let elastic = elastic_pieces(&unload);
        let steepest = unload.slopes.iter().copied().fold(0.0, f64::max);
        Ok(Self {
            loading: Loading::new(loading_pieces(&load, &unload)?),
            elastic: Elastic::new(elastic),
            loading_starts: Starts::new(load.overlaps[..load.slopes.len()].iter().copied()),
            last_overlap: load.overlaps.last().copied().unwrap_or_default(),
            steepest,
        })
    }

    /// The last overlap of the loading curve [m].
    #[inline(always)]
    pub(super) fn last_overlap(&self) -> f64 {
        self.last_overlap
    }

    /// The steepest slope [N/m], which is one of the unloading curve.
    pub(super) fn steepest(&self) -> f64 {
        self.steepest
    }

    /// The number of the piece of the loading curve at an overlap [m].
    pub(super) fn loading_piece(&self, overlap: f64) -> u8 {
        self.loading_starts.index(overlap) as u8
    }

    /// The number of the piece of the elastic curve at an elastic overlap [m].
    pub(super) fn elastic_piece(&self, elastic: f64) -> u8 {
        self.elastic.index(elastic) as u8
    }
}

/// A curve whose points are known to grow.
#[derive(Clone)]
struct Curve<'v> {
    overlaps: &'v [f64],
    forces: &'v [f64],
    /// Slope from each point to the next one [N/m]; there is no such number for the last point.
    slopes: Vec<f64>,
}

impl<'v> Curve<'v> {
    fn new(names: [&'static str; 2], (overlaps, forces): Points<'v>) -> Result<Self, InvalidParameter> {
        let [of_overlaps, of_forces] = names;
        if overlaps.len() != forces.len() {
            return Err(InvalidParameter::Inconsistent {
                name: of_forces,
                found: format!("a list of {} values", forces.len()),
                expected: format!("{} values, as many as `{of_overlaps}` has", overlaps.len()),
                reason: "a point of a curve is an overlap and a force",
            });
        }
        grows(of_overlaps, "m", overlaps, "a curve gives one force for each overlap")?;
        grows(of_forces, "N", forces, "the elastic part of the overlap follows from the force")?;
        if forces.first() != Some(&0.0) {
            return Err(first(of_forces, forces, "0 N", "the curve starts without a force"));
        }
        let steps = overlaps.windows(2).zip(forces.windows(2));
        let slopes: Vec<f64> = steps.map(|(x, f)| (f[1] - f[0]) / (x[1] - x[0])).collect();
        if let Some(slope) = slopes.iter().find(|slope| !(**slope > 0.0 && slope.is_finite())) {
            return Err(InvalidParameter::Inconsistent {
                name: of_overlaps,
                found: format!("a curve with a slope of {slope} N/m"),
                expected: "slopes that are finite and greater than 0".to_owned(),
                reason: "two points are so close that their slope is no number",
            });
        }
        Ok(Self { overlaps, forces, slopes })
    }

    /// The piece that a force lies on; the last one beyond the curve.
    fn piece(&self, force: f64) -> usize {
        let after = self.forces.partition_point(|known| *known <= force);
        after.clamp(1, self.slopes.len()) - 1
    }

    /// Overlap and slope at a force, on the piece that starts there or goes through.
    fn at(&self, force: f64) -> (f64, f64) {
        let piece = self.piece(force);
        let slope = self.slopes[piece];
        (self.overlaps[piece] + (force - self.forces[piece]) / slope, slope)
    }
}

fn grows(
    name: &'static str,
    unit: &str,
    values: &[f64],
    reason: &'static str,
) -> Result<(), InvalidParameter> {
    match values.windows(2).find(|two| two[1] <= two[0]) {
        None => Ok(()),
        Some(two) => Err(InvalidParameter::Inconsistent {
            name,
            found: format!("{} {unit} after {} {unit}", two[1], two[0]),
            expected: "values that grow from point to point".to_owned(),
            reason,
        }),
    }
}

/// A computed number in six digits.
fn brief(number: f64) -> f64 {
    format!("{number:.5e}").parse().unwrap_or(number)
}

fn first(name: &'static str, values: &[f64], expected: &str, reason: &'static str) -> InvalidParameter {
    InvalidParameter::Inconsistent {
        name,
        found: format!("{} at its first point", values.first().copied().unwrap_or(f64::NAN)),
        expected: format!("{expected} there"),
        reason,
    }
}

/// The unloading curve from its first point on, with the energy under it.
fn elastic_pieces(unload: &Curve<'_>) -> Vec<ElasticPiece<f64>> {
    let mut energy = 0.0;
    let residual = unload.overlaps[0];
    let piece = |(index, slope): (usize, &f64)| {
        let (start, force) = (unload.overlaps[index] - residual, unload.forces[index]);
        let piece = ElasticPiece { start, force, slope: *slope, energy };
        let length = unload.overlaps[index + 1] - residual - start;
        energy += length * (force + 0.5 * slope * length);
        piece
    };
    unload.slopes.iter().enumerate().map(piece).collect()
}

/// Virgin loading, cut where either curve has a point; refuses what would create energy.
fn loading_pieces(load: &Curve<'_>, unload: &Curve<'_>) -> Result<Vec<LoadingPiece>, InvalidParameter> {
    // Beyond its last point the last piece of a curve goes on.
    let starts = |curve: &Curve<'_>| curve.forces[..curve.slopes.len()].to_vec();
    let mut forces = [starts(load), starts(unload)].concat();
    forces.sort_unstable_by(f64::total_cmp);
    forces.dedup();
    let mut pieces: Vec<LoadingPiece> = Vec::with_capacity(forces.len());
    for force in forces {
        let ((start, slope), (elastic, unloading_slope)) = (load.at(force), unload.at(force));
        let share = slope / unloading_slope;
        if share > 1.0 + ROUND_OFF || share.is_nan() {
            return Err(InvalidParameter::Inconsistent {
                name: "unloading_overlap",
                found: format!(
                    "a curve with a slope of {} N/m at {} N",
                    brief(unloading_slope),
                    brief(force)
                ),
                expected: format!("at least {} N/m there, the slope of loading", brief(slope)),
                reason: "a contact that unloads more softly than it was loaded creates energy on a closed path",
            });
        }
        let work = pieces.last().map_or(0.0, |before| {
            let length = start - before.start;
            let plastic_share = 1.0 - before.elastic_share;
            before.work + plastic_share * length * (before.force + 0.5 * before.slope * length)
        });
        let elastic = elastic - unload.overlaps[0];
        pieces.push(LoadingPiece { start, elastic, elastic_share: share.min(1.0), force, slope, work });
    }
    Ok(pieces)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn equal_curves_share_a_table_and_a_softer_unloading_is_refused() {
        let points = |slope: f64| ([0.0, 1e-6, 2e-6], [0.0, slope * 1e-6, slope * 2e-6]);
        let (soft, hard) = (points(100.0), points(250.0));
        let table = |load: &'_ ([f64; 3], [f64; 3]), unload: &'_ ([f64; 3], [f64; 3])| {
            CurveTable::of((&load.0, &load.1), Some((&unload.0, &unload.1)))
        };
        assert!(std::ptr::eq(table(&soft, &hard).unwrap(), table(&soft, &hard).unwrap()));
        let refused = table(&hard, &soft).unwrap_err();
        assert_eq!(refused.name(), "unloading_overlap");
        assert!(refused.to_string().contains("creates energy"), "{refused}");
    }

    #[test]
    fn straight_curves_lose_the_area_between_them() {
        // Between the lines of loading and unloading lies k1 D δ_0/2, δ_0 = (1 − k1/k2) D (Walton & Braun 1986).
        let (overlaps, load, unload) = ([0.0, 1e-6], [0.0, 1e-4], [0.0, 4e-4]);
        let table = CurveTable::of((&overlaps, &load), Some((&overlaps, &unload))).unwrap();
        for depth in [3e-7, 1e-6, 5e-6] {
            let expected = 0.5 * 100.0 * depth * 0.75 * depth;
            let found: f64 = table.loading.plastic_work(depth);
            assert!((found / expected - 1.0).abs() < 1e-14, "{found} J at {depth} m");
        }
    }
}
