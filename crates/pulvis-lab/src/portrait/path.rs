//! Paths of all scales, and how much of a law they show.

use pulvis_contact::catalogue::Role;
use pulvis_math::{elementary, max_or_nan};

use crate::probe::ProbeSample;

/// Radius of the bodies [m].
pub(super) const RADIUS: f64 = 1.0e-3;

/// Three to the decade, from the `first` power of ten up to the `last`.
fn decades(first: i32, last: i32) -> impl Iterator<Item = f64> {
    (3 * first..=3 * last).map(|third| elementary::powf(10.0, f64::from(third) / 3.0))
}

/// How long legs may take [s].
pub(super) fn durations() -> Vec<f64> {
    decades(-9, 1).collect()
}

/// Turning points of overlaps and of the other motion [m], which laws along the normal do not need.
pub(super) fn paths(role: Role) -> Vec<[Vec<f64>; 2]> {
    let along = |depth: f64, range: f64| {
        let mut overlap = vec![-range, depth, 0.7 * depth, 1.3 * depth, -range];
        if role == Role::NonContact {
            // Reach and overlap may be of different scales: each has legs of its own.
            overlap.insert(4, 0.0);
            overlap.insert(1, 0.0);
        }
        let other = vec![0.0; overlap.len()];
        [overlap, other]
    };
    match role {
        Role::Sliding | Role::Rolling | Role::Torsion => decades(-9, -4)
            .map(|other| {
                let depth = 0.01 * RADIUS;
                [vec![0.0, depth, depth, depth, depth], vec![0.0, 0.0, other, -other, other]]
            })
            .collect(),
        // Attractions set in and end at distances of all scales.
        _ => {
            let ranges: &[f64] =
                if role == Role::NonContact { &[0.1, 1.0, 10.0, 100.0, 1000.0] } else { &[0.1, 1.0, 10.0] };
            decades(-9, -4)
                .flat_map(|depth| ranges.iter().map(move |times| along(depth, times * depth)))
                .collect()
        }
    }
}

/// How much a curve shows of a law, more is better.
pub(super) fn score(role: Role, samples: &[ProbeSample]) -> f64 {
    let Some(last) = samples.last() else { return f64::NEG_INFINITY };
    if matches!(role, Role::Sliding | Role::Rolling | Role::Torsion) {
        // Springs and slip alike: slip dissipates more of the work than springs hold.
        return near(last.dissipated / last.work, 0.7);
    }
    let acting = samples.iter().filter(|sample| sample.force != 0.0).count() as f64 / samples.len() as f64;
    let most_work = samples.iter().map(|sample| sample.work).fold(0.0, f64::max);
    // Every branch, to the end, and no more of nothing than it needs.
    branches(samples)
        + if last.force == 0.0 { 2.0 } else { 0.0 }
        + near(pull_over_push(samples), 0.4)
        + 0.5 * near(last.dissipated / most_work, 0.4)
        + 0.5 * near(acting, 0.8)
        + 0.1 * near(deepest(samples), 0.01 * RADIUS)
        - 20.0 * (mismatch(samples) / most_work).min(1.0)
}

/// The most by which work done differs from what is stored and dissipated: a path in steps so large that they pass
/// what the law does.
fn mismatch(samples: &[ProbeSample]) -> f64 {
    let at_first = samples.first().map_or(0.0, |sample| sample.stored_energy);
    let of =
        |sample: &ProbeSample| (sample.work - (sample.stored_energy - at_first) - sample.dissipated).abs();
    samples.iter().map(of).fold(0.0, max_or_nan)
}

/// How much a collision shows of a dashpot, by the part of the energy that is lost.
pub(super) fn score_of_loss(loss: f64) -> f64 {
    near(loss, 0.4)
}

/// One where a positive number is as wanted, less the more decades it is away, zero where it is not positive.
fn near(found: f64, wanted: f64) -> f64 {
    if found > 0.0 && found.is_finite() {
        1.0 / (1.0 + elementary::ln(found / wanted).abs() / std::f64::consts::LN_10)
    } else {
        0.0
    }
}

/// Number of branches.
fn branches(samples: &[ProbeSample]) -> f64 {
    let mut names: Vec<&str> = samples.iter().map(|sample| sample.branch).collect();
    names.sort_unstable();
    names.dedup();
    names.len() as f64
}

/// The largest attraction over the largest repulsion.
fn pull_over_push(samples: &[ProbeSample]) -> f64 {
    let forces = samples.iter().map(|sample| sample.force);
    let (least, largest) =
        forces.fold((0.0_f64, 0.0_f64), |(least, largest), force| (least.min(force), largest.max(force)));
    -least / largest
}

fn deepest(samples: &[ProbeSample]) -> f64 {
    samples.iter().map(|sample| sample.overlap).fold(0.0, f64::max)
}
