//! A contact whose curves of loading and unloading are tables.

use pulvis_math::{Mask, Real};

use super::{NormalLaw, NormalResponse};
use crate::catalogue::{InvalidParameter, Law, LawEntry, Values};
use crate::expected::ExpectedLoading;
use crate::kinematics::NormalMotion;
use crate::pair::Pair;

mod entry;
mod pieces;
mod table;

use pieces::ElasticPiece;
use table::CurveTable;

/// Loading and unloading along measured or computed curves, straight between their points.
///
/// The overlap is an elastic part and a plastic one, δ = δ_e + δ_p: an elastic element with the curve g and a plastic one
/// in series. The plastic part grows on virgin loading only, so that
///
/// ```text
/// f = L(δ)                    while the largest overlap D grows: the curve of loading
/// f = g(δ − δ_p(D)) ≥ 0       un- and re-loading: the curve of unloading, moved along δ to where loading ended
/// δ_p(D) = D − g⁻¹(L(D))
/// ```
///
/// The energy ∫g dδ_e is stored, and L dδ_p ≥ 0 is lost, if g is at least as steep as L at every force: curves for which that
/// does not hold are refused, and no closed path creates energy. Both integrals of straight pieces are exact. Beyond the last
/// point of a curve its last slope goes on.
///
/// With a reference radius R_ref, bodies of the effective radius R* are geometrically similar to those of the curves:
/// f/R*² is the same function of δ/R*.
///
/// # Source
/// Elastic and plastic element in series: K. L. Johnson, *Contact Mechanics* (1985), section 6.4 (an unloading that is
/// elastic and does not depend on the way there). Similarity: Y.-T. Cheng, C.-M. Cheng, Mater. Sci. Eng. R 44, 91 (2004).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tabulated {
    /// The curves; kept until the program ends, once for equal ones.
    table: &'static CurveTable,
    /// Effective radius R_ref of the bodies that the curves belong to [m]; `None` if they hold for bodies of all radii.
    reference_radius: Option<f64>,
}

impl Law for Tabulated {
    const ENTRY: LawEntry = entry::ENTRY;

    fn from_values(values: &Values) -> Result<Self, InvalidParameter> {
        let unloading = match (values.numbers("unloading_overlap"), values.numbers("unloading_force")) {
            (Err(_), Err(_)) => None,
            (overlaps, forces) => Some((overlaps?, forces?)),
        };
        let loading = (values.numbers("loading_overlap")?, values.numbers("loading_force")?);
        Ok(Self {
            table: CurveTable::of(loading, unloading)?,
            reference_radius: values.optional_number("reference_radius"),
        })
    }
}

/// Where a contact stands on the elastic curve.
struct Standing<R: Real> {
    /// Elastic part of the overlap, of the bodies of the table [m].
    elastic: R,
    /// The largest overlap and the overlap, of the bodies of the table [m].
    loaded: R,
    force: R,
    slope: R,
    energy: R,
}

impl Tabulated {
    /// R_ref/R*, and R*/R_ref: overlaps of the contact times the first are those of the table.
    #[inline(always)]
    fn scales<R: Real>(&self, pair: &Pair<R>) -> (R, R) {
        match self.reference_radius {
            None => (R::one(), R::one()),
            // The effective radius is half the harmonic mean.
            Some(radius) => {
                let to_table = R::splat(2.0 * radius) * pair.inverse_harmonic_radius();
                (to_table, R::one() / to_table)
            }
        }
    }

    /// The point of a contact that was pressed to `loaded`, all lengths of the bodies of the table [m].
    #[inline(always)]
    fn standing<R: Real>(&self, depth: R, loaded: R) -> Standing<R> {
        let at_turn = self.table.loading.elastic_overlap(loaded);
        let elastic = (at_turn - (loaded - depth)).max(R::zero());
        let ElasticPiece { start, force, slope, energy } = self.table.elastic.piece(elastic);
        let beyond = elastic - start;
        Standing {
            elastic,
            loaded,
            force: force + slope * beyond,
            slope,
            energy: energy + beyond * (force + R::splat(0.5) * slope * beyond),
        }
    }
}

impl NormalLaw for Tabulated {
    /// The largest overlap.
    type Memory<R: Real> = [R; 1];

    #[inline(always)]
    fn respond<R: Real>(&self, motion: &NormalMotion<R>, memory: &mut [R; 1]) -> NormalResponse<R> {
        let (depth, before) = (motion.depth, memory[0]);
        let deepest = before.max(depth);
        let (to_table, from_table) = self.scales(&motion.pair);
        let point = self.standing(depth * to_table, deepest * to_table);
        let of_forces = from_table * from_table;
        let of_energies = of_forces * from_table;
        let force = (point.force * of_forces).keep_where(motion.touching);
        // Most contacts of a packing at rest lose nothing; where other lanes do, this difference is zero.
        let mut plastic = R::zero();
        if deepest.gt(before).any() {
            let work = &self.table.loading;
            plastic = (work.plastic_work(point.loaded) - work.plastic_work(before * to_table)) * of_energies;
        }
        memory[0] = deepest.keep_where(motion.touching);
        NormalResponse {
            dissipated_plastic: plastic,
            inverse_overlap_scale: to_table * R::splat(1.0 / self.table.last_overlap()),
            ..NormalResponse::elastic(
                motion,
                force,
                (point.energy * of_energies).keep_where(motion.touching),
                (point.slope * from_table).keep_where(force.gt(R::zero())),
            )
        }
    }

    fn branch(&self, pair: &Pair<f64>, overlap: f64, memory: &[f64; 1]) -> (u8, &'static str) {
        if overlap <= 0.0 {
            return (0, "open");
        }
        let to_table = self.scales(pair).0;
        let point = self.standing(overlap * to_table, memory[0].max(overlap) * to_table);
        if overlap >= memory[0] {
            // A piece of a curve is a branch of its own: there is a kink between two.
            return (2 + self.table.loading_piece(overlap * to_table), "loading");
        }
        // Round-off of the two terms of the elastic overlap.
        if point.elastic <= 4.0 * f64::EPSILON * point.loaded {
            return (1, "free");
        }
        (2 + table::MOST_POINTS as u8 + self.table.elastic_piece(point.elastic), "unloading")
    }

    fn max_stiffness(&self, pair: &Pair<f64>, _expected: &ExpectedLoading) -> f64 {
        self.table.steepest() * self.scales(pair).1
    }

    fn remembered_overlap(&self, memory: &[f64; 1]) -> Option<f64> {
        Some(memory[0])
    }
}
