//! Which spheres a picture shows, and what it says of the others.

use super::outline;
use super::scene::Scene;

/// Without a box, spheres farther from the middle than this many times the distance within which most lie are outside.
const FAR: f64 = 5.0;

/// The share of the spheres that counts as most.
const MOST: f64 = 0.9;

/// Spheres this share of the box' longest side beyond its faces are still in the view.
const AROUND_BOX: f64 = 0.5;

/// Most spheres, if they are within this many times that side, are in the view with the box.
const NEAR_BOX: f64 = 5.0;

/// The spheres of a scene that the view takes in.
#[derive(Clone, Debug)]
pub(super) struct Selection {
    /// Of each sphere, whether it is shown.
    pub(super) shown: Vec<bool>,
    /// How many could be shown, but are too far away.
    outside: usize,
    /// How many have no finite position or no positive, finite radius.
    unlocated: usize,
    /// Whether spheres that would be too small to see are drawn as dots.
    pub(super) enlarged: bool,
}

impl Selection {
    /// The view holds the limits of the scene, else the outlines, the spheres near them and the bulk of the spheres if it is not
    /// far away; without outlines, the bulk of the spheres.
    pub(super) fn of(scene: &Scene<'_>) -> Self {
        let drawable: Vec<bool> = scene
            .centres
            .iter()
            .zip(scene.radii)
            .map(|(&centre, &radius)| can_be_drawn(centre, radius))
            .collect();
        let around = || outline_limits(scene, &drawable).or_else(|| bulk_limits(scene, &drawable));
        let limits = scene.limits.or_else(around);
        let inside = |centre: &[f64; 3]| {
            limits
                .is_none_or(|[low, high]| (0..3).all(|axis| (low[axis]..=high[axis]).contains(&centre[axis])))
        };
        let shown: Vec<bool> = scene
            .centres
            .iter()
            .zip(&drawable)
            .map(|(centre, &drawable)| drawable && inside(centre))
            .collect();
        let count = |flags: &[bool]| flags.iter().filter(|flag| **flag).count();
        let outside = count(&drawable) - count(&shown);
        Self { outside, unlocated: drawable.len() - count(&drawable), shown, enlarged: false }
    }

    /// Number of the spheres that are shown.
    pub(super) fn count(&self) -> usize {
        self.shown.iter().filter(|shown| **shown).count()
    }

    /// Notes on what the picture does not show, one a line.
    pub(super) fn notes(&self, scene: &Scene<'_>) -> Vec<String> {
        let all = self.shown.len();
        let colourless =
            scene.values.iter().zip(&self.shown).filter(|(value, shown)| **shown && !value.is_finite());
        let of_all =
            |count: usize, text: &str| (count > 0).then(|| format!("{count} of {all} particles {text}"));
        let notes = [
            of_all(self.outside, "lie outside the view"),
            of_all(self.unlocated, "have no finite position or radius and are not shown"),
            of_all(colourless.count(), "have no finite value to colour them by"),
            self.enlarged.then(|| "particles are drawn larger than they are, as dots".to_owned()),
        ];
        notes.into_iter().flatten().collect()
    }
}

/// Whether a sphere is finite, positive, and small enough for the arithmetic.
fn can_be_drawn(centre: [f64; 3], radius: f64) -> bool {
    centre.iter().all(|x| x.abs() < 1.0e100) && radius > 0.0 && radius < 1.0e100
}

/// Limits around all outlines, and around most of the spheres where these are not far from them: a tube that was lifted is not
/// all that there is to see.
fn outline_limits(scene: &Scene<'_>, drawable: &[bool]) -> Option<[[f64; 3]; 2]> {
    let [mut low, mut high] = outline::limits(&scene.all_edges())?;
    let longest = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let chosen = || (0..drawable.len()).filter(|&number| drawable[number]);
    let ends = |share: f64| -> Option<Vec<f64>> {
        (0..3).map(|axis| quantile(chosen().map(|number| scene.centres[number][axis]), share)).collect()
    };
    if let (Some(first), Some(last)) = (ends(1.0 - MOST), ends(MOST)) {
        let reach = NEAR_BOX * longest;
        if (0..3).all(|axis| first[axis] >= low[axis] - reach && last[axis] <= high[axis] + reach) {
            for axis in 0..3 {
                low[axis] = low[axis].min(first[axis]);
                high[axis] = high[axis].max(last[axis]);
            }
        }
    }
    let margin = AROUND_BOX * longest;
    Some([low.map(|x| x - margin), high.map(|x| x + margin)])
}

/// Limits around the bulk of the spheres.
fn bulk_limits(scene: &Scene<'_>, drawable: &[bool]) -> Option<[[f64; 3]; 2]> {
    let chosen = || (0..drawable.len()).filter(|&number| drawable[number]);
    let radius = quantile(chosen().map(|number| scene.radii[number]), 0.5)?;
    let (mut low, mut high) = ([0.0; 3], [0.0; 3]);
    for (axis, (low, high)) in low.iter_mut().zip(&mut high).enumerate() {
        let coordinates = || chosen().map(|number| scene.centres[number][axis]);
        let middle = quantile(coordinates(), 0.5)?;
        let most = quantile(coordinates().map(|x| (x - middle).abs()), MOST)?;
        let distance = FAR * (most + radius);
        (*low, *high) = (middle - distance, middle + distance);
    }
    Some([low, high])
}

fn quantile(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let number = (share * values.len() as f64).floor() as usize;
    values.get(number.min(values.len().saturating_sub(1))).copied()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::OutlineBox;

    fn grid(count: u32) -> Vec<[f64; 3]> {
        (0..count).map(|n| [n % 5, n / 5 % 5, n / 25].map(f64::from)).collect()
    }

    #[test]
    fn what_flew_away_or_has_no_position_is_counted_and_the_rest_fills_the_view() {
        let mut centres = grid(100);
        centres[3] = [1.0e6, 0.0, 0.0];
        centres[50][2] = f64::NAN;
        centres[51][0] = f64::INFINITY;
        let (radii, values) = (vec![0.5; 100], vec![0.0; 100]);
        let scene = Scene::new(&centres, &radii, &values);
        let selection = Selection::of(&scene);
        assert_eq!(selection.count(), 97);
        let expected = [
            "1 of 100 particles lie outside the view",
            "2 of 100 particles have no finite position or radius and are not shown",
        ];
        assert_eq!(selection.notes(&scene), expected);
    }

    #[test]
    fn with_a_box_the_view_is_the_box_even_if_all_have_flown_far_from_it() {
        let centres: Vec<[f64; 3]> =
            grid(100).iter().map(|centre| centre.map(|x| 1.0e6 * (x + 1.0))).collect();
        let (radii, values) = (vec![0.5; 100], vec![0.0; 100]);
        let edges = OutlineBox { low: [0.0; 3], high: [4.0; 3] }.edges();
        let scene = Scene { edges: &edges, ..Scene::new(&centres, &radii, &values) };
        let selection = Selection::of(&scene);
        assert_eq!(selection.count(), 0);
        assert_eq!(selection.notes(&scene), ["100 of 100 particles lie outside the view"]);
    }

    #[test]
    fn grains_that_a_tube_has_left_behind_are_in_the_view_with_it() {
        let centres = grid(100);
        let (radii, values) = (vec![0.5; 100], vec![0.0; 100]);
        let edges = OutlineBox { low: [0.0, 0.0, 12.0], high: [4.0, 4.0, 16.0] }.edges();
        let scene = Scene { edges: &edges, ..Scene::new(&centres, &radii, &values) };
        let selection = Selection::of(&scene);
        assert_eq!((selection.count(), selection.notes(&scene).len()), (100, 0));
    }

    #[test]
    fn a_sound_packing_has_no_notes() {
        let centres = grid(100);
        let (radii, values) = (vec![0.5; 100], vec![0.0; 100]);
        let scene = Scene::new(&centres, &radii, &values);
        let selection = Selection::of(&scene);
        assert_eq!((selection.count(), selection.notes(&scene).len()), (100, 0));
    }
}
