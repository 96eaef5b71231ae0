//! How rough the two surfaces are along which a sample has parted.

use std::collections::HashMap;

/// A sphere: centre and radius [m].
pub(super) type Sphere = ([f64; 3], f64);

/// Columns of the cross-section with fewer neighbours than this say nothing about a surface.
const LEAST_COLUMNS: usize = 4;

/// Root mean square of the heights of a surface about their mean [m]: the cross-section is cut into squares as wide as a mean
/// particle, and the height of a square is that of the outermost sphere whose centre lies in it. `outward` is 1 where the
/// surface looks up the axis, and -1 where it looks down. `None` where there are too few squares.
pub(super) fn roughness(spheres: &[Sphere], axis: usize, outward: f64) -> Option<f64> {
    let count = spheres.len() as f64;
    let width = 2.0 * spheres.iter().map(|(_, radius)| radius).sum::<f64>() / count;
    let mut heights: HashMap<[i64; 2], f64> = HashMap::new();
    for (centre, radius) in spheres {
        let cell = [1, 2].map(|turn| (centre[(axis + turn) % 3] / width).floor() as i64);
        let height = outward * centre[axis] + radius;
        let highest = heights.entry(cell).or_insert(height);
        *highest = highest.max(height);
    }
    if heights.len() < LEAST_COLUMNS {
        return None;
    }
    // Sorted, so that the sum does not depend on the order of the table.
    let mut heights: Vec<f64> = heights.into_values().collect();
    heights.sort_by(f64::total_cmp);
    let count = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / count;
    Some((heights.iter().map(|height| (height - mean) * (height - mean)).sum::<f64>() / count).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A layer of spheres of radius 1 whose heights alternate by ±`step`.
    fn layer(step: f64) -> Vec<Sphere> {
        let sites = (0..6).flat_map(|i| (0..6).map(move |j| (i, j)));
        let height = |i: i32, j: i32| if (i + j) % 2 == 0 { step } else { -step };
        sites
            .map(|(i, j)| ([height(i, j), 2.0 * f64::from(i) + 1.0, 2.0 * f64::from(j) + 1.0], 1.0))
            .collect()
    }

    #[test]
    fn a_flat_layer_is_smooth_and_steps_are_as_rough_as_they_are_high() {
        for outward in [1.0, -1.0] {
            assert!(roughness(&layer(0.0), 0, outward).is_some_and(|rough| rough < 1e-12));
            assert!(roughness(&layer(0.7), 0, outward).is_some_and(|rough| (rough - 0.7).abs() < 1e-12));
        }
        assert_eq!(roughness(&layer(0.7)[..3], 0, 1.0), None);
        assert_eq!(roughness(&[], 0, 1.0), None);
    }
}
