//! Dense random packings: spheres that grow and push each other apart.
//!
//! All spheres start as points at random and grow together. After each step of growth every overlapping pair is moved apart along
//! its line of centres, sweep by sweep, until no overlap is left. Where that takes too many sweeps the step is taken back and
//! halved. What comes out is a packing without overlap, near random close packing if it is asked for: a method between those of
//! Jodrey and Tory and of Lubachevsky and Stillinger.
//!
//! # Source
//! W. S. Jodrey, E. M. Tory, Phys. Rev. A 32, 2347 (1985): pairs are moved apart until none overlaps. B. D. Lubachevsky,
//! F. H. Stillinger, J. Stat. Phys. 60, 561 (1990): spheres that grow from points.

use std::f64::consts::PI;

use pulvis_boundary::{Cuboid, Domain, Images};
use pulvis_math::{Vector3, elementary};
use rand::RngExt;
use thiserror::Error;

use super::Random;

/// The spheres jam before they have their size.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "spheres that grow at random jam at a solid fraction of {reached:.3} of the block, and {wanted:.3} is asked for; equal spheres far from walls come to some 0.63"
)]
pub struct Jammed {
    /// Solid fraction that was reached [1].
    pub reached: f64,
    /// Solid fraction of all spheres at their size [1].
    pub wanted: f64,
}

/// Overlap over the distance of touching centres that counts as none while spheres grow [1]; they grow a little beyond their size,
/// so that none is left in the end.
const NO_OVERLAP: f64 = 1e-4;
const BEYOND: f64 = 1.0 + 5.0 * NO_OVERLAP;
/// The first and the last step of growth, over the size [1].
const STEPS: [f64; 2] = [0.05, 2e-4];
/// Sweeps in which a step must be done.
const SWEEPS: usize = 600;
/// How far overlapping spheres are moved apart, over their overlap [1]. Nearly twice: they rebound from each other, which stirs the
/// packing; less stirs less, and the packing jams earlier.
const REBOUND: f64 = 1.9;
/// Solid fraction to begin with: hardly any overlap.
const START: f64 = 0.05;
/// Pairs are listed up to this gap, over the smallest radius [1].
const MARGIN: f64 = 0.4;

/// Positions for spheres of the given radii [m] in a block, without any overlap with each other or with those that are `present`
/// (centre [m], radius [m]). They lie whole in `region`, except along periodic directions.
///
/// The time grows with the number of spheres, and steeply towards a solid fraction of 0.63.
///
/// # Errors
/// They jam before they have their size.
pub fn dense_positions(
    radii: &[f64],
    region: &Cuboid,
    domain: &Domain,
    present: &[(Vector3, f64)],
    random: &mut Random,
) -> Result<Vec<Vector3>, Jammed> {
    if radii.is_empty() {
        return Ok(Vec::new());
    }
    let solid: f64 = radii.iter().map(|&radius| 4.0 / 3.0 * PI * elementary::powi(radius, 3)).sum();
    let wanted = solid / region.volume();
    let mut packing = Growing::new(radii, region, domain, present, random);
    let jammed = |scale: f64| Jammed { reached: wanted * elementary::powi(scale.min(1.0), 3), wanted };
    let mut scale = elementary::cbrt(START / wanted).min(1.0);
    let mut step = STEPS[0];
    // The start may need many sweeps: what is present pushes points out of itself.
    if !(0..10).any(|_| packing.relax(scale)) {
        return Err(jammed(0.0));
    }
    while scale < BEYOND {
        let before = packing.centres.clone();
        let next = (scale * (1.0 + step)).min(BEYOND);
        if packing.relax(next) {
            scale = next;
        } else {
            packing.centres = before;
            step *= 0.5;
            if step < STEPS[1] {
                return Err(jammed(scale));
            }
        }
    }
    // The last moves of a sweep, each less than a ten-thousandth, may have added up.
    let mut whole = packing.near_pairs(1.0, 0.0).is_empty();
    for _ in 0..20 {
        whole = whole || (packing.relax(BEYOND) && packing.near_pairs(1.0, 0.0).is_empty());
    }
    if !whole {
        return Err(jammed(scale));
    }
    packing.centres.truncate(radii.len());
    Ok(packing.centres)
}

/// Spheres on their way. Those behind the first `grow` are present: they neither grow nor move.
struct Growing<'a> {
    centres: Vec<Vector3>,
    radii: Vec<f64>,
    grow: usize,
    region: &'a Cuboid,
    domain: &'a Domain,
    images: Images,
    smallest: f64,
    largest: f64,
}

impl<'a> Growing<'a> {
    fn new(
        radii: &[f64],
        region: &'a Cuboid,
        domain: &'a Domain,
        present: &[(Vector3, f64)],
        random: &mut Random,
    ) -> Self {
        let size = region.size();
        let mut point = || {
            let [x, y, z] = [0, 1, 2].map(|axis| region.lower[axis] + size[axis] * random.random::<f64>());
            Vector3::new(x, y, z)
        };
        let centres: Vec<Vector3> =
            radii.iter().map(|_| point()).chain(present.iter().map(|(centre, _)| *centre)).collect();
        let radii_of_all: Vec<f64> =
            radii.iter().copied().chain(present.iter().map(|(_, radius)| *radius)).collect();
        Self {
            centres,
            grow: radii.len(),
            region,
            domain,
            images: domain.images(),
            smallest: radii.iter().copied().fold(f64::INFINITY, f64::min),
            largest: radii_of_all.iter().copied().fold(0.0, f64::max),
            radii: radii_of_all,
        }
    }

    fn radius(&self, sphere: usize, scale: f64) -> f64 {
        if sphere < self.grow { scale * self.radii[sphere] } else { self.radii[sphere] }
    }

    /// Moves pairs apart until none overlaps at this scale of the radii; whether that is done in time.
    fn relax(&mut self, scale: f64) -> bool {
        let margin = MARGIN * scale * self.smallest;
        let (mut pairs, mut moved) = (self.near_pairs(scale, margin), 0.0);
        for _ in 0..SWEEPS {
            if moved > 0.5 * margin {
                (pairs, moved) = (self.near_pairs(scale, margin), 0.0);
            }
            let (worst, farthest) = self.sweep(scale, &pairs);
            moved += farthest;
            // What has moved farther than the list reaches may overlap unseen.
            if worst <= NO_OVERLAP && moved <= 0.5 * margin {
                return true;
            }
        }
        false
    }

    /// One look at all pairs. Answers with the largest overlap that was found, over the distance of touching centres, and
    /// with how far any sphere has moved at most [m].
    fn sweep(&mut self, scale: f64, pairs: &[[u32; 2]]) -> (f64, f64) {
        let mut ways = vec![0.0_f64; self.grow];
        let mut worst = self.keep_inside(scale, &mut ways);
        for &[one, other] in pairs {
            let (one, other) = (one as usize, other as usize);
            let touching = self.radius(one, scale) + self.radius(other, scale);
            let apart = self.images.nearest(self.centres[one] - self.centres[other]);
            let square = apart.norm_squared();
            if square >= touching * touching {
                continue;
            }
            let distance = square.sqrt();
            worst = worst.max(1.0 - distance / touching);
            // Two centres at one place part along x.
            let normal = if distance > 0.0 { apart * (1.0 / distance) } else { Vector3::new(1.0, 0.0, 0.0) };
            let way = REBOUND * (touching - distance);
            let share = if other < self.grow { 0.5 } else { 1.0 };
            self.centres[one] += normal * (share * way);
            ways[one] += share * way;
            if other < self.grow {
                self.centres[other] -= normal * (0.5 * way);
                ways[other] += 0.5 * way;
            }
        }
        (worst, ways.into_iter().fold(0.0, f64::max))
    }

    /// Moves spheres back into the block. Answers with how far one stood out, over its diameter.
    fn keep_inside(&mut self, scale: f64, ways: &mut [f64]) -> f64 {
        let mut worst = 0.0_f64;
        for (sphere, way) in ways.iter_mut().enumerate() {
            let radius = self.radius(sphere, scale);
            for axis in (0..3).filter(|&axis| self.domain.period(axis).is_none()) {
                let (low, high) = (self.region.lower[axis] + radius, self.region.upper[axis] - radius);
                let place = self.centres[sphere].component_mut(axis);
                // In a block that is too thin the sphere is never inside.
                let inside = place.max(low).min(high);
                let out = (*place - inside).abs().max(low - high);
                worst = worst.max(0.5 * out / radius);
                *way += (*place - inside).abs();
                *place = inside;
            }
        }
        worst
    }

    /// The pairs whose surfaces are nearer than `margin` [m], the sphere that moves first.
    fn near_pairs(&mut self, scale: f64, margin: f64) -> Vec<[u32; 2]> {
        // The nearest image is that of centres in the block, or little beyond it.
        let domain = self.domain;
        self.centres.iter_mut().for_each(|centre| *centre = domain.wrapped(*centre));
        let width = 2.0 * self.largest + margin;
        let mut cells: std::collections::BTreeMap<[i64; 3], Vec<u32>> = std::collections::BTreeMap::new();
        let counts = [0, 1, 2].map(|axis| self.domain.period(axis).map(|period| (period / width) as i64));
        // Fewer than three cells along a period: every cell would be its own neighbour, so there is one.
        let counts = counts.map(|count| count.map(|count| if count < 3 { 1 } else { count }));
        let cell_of = |centre: Vector3| {
            [0, 1, 2].map(|axis| {
                let place = centre[axis] - self.domain.extent.lower[axis];
                match counts[axis].zip(self.domain.period(axis)) {
                    // Rounding may put a centre onto the upper face.
                    Some((count, period)) => {
                        ((place / period * count as f64).floor() as i64).clamp(0, count - 1)
                    }
                    // Beyond this, doubles do not tell cells apart.
                    None => (centre[axis] / width).floor().clamp(-1e15, 1e15) as i64,
                }
            })
        };
        for (sphere, centre) in self.centres.iter().enumerate() {
            cells.entry(cell_of(*centre)).or_default().push(sphere as u32);
        }
        let steps = |axis: usize| if counts[axis] == Some(1) { 0..=0 } else { -1..=1 };
        let mut pairs = Vec::new();
        for (cell, spheres) in &cells {
            for (x, y, z) in
                steps(0).flat_map(|x| steps(1).flat_map(move |y| steps(2).map(move |z| (x, y, z))))
            {
                let near = [x, y, z];
                let other = [0, 1, 2].map(|axis| {
                    let place = cell[axis] + near[axis];
                    counts[axis].map_or(place, |count| place.rem_euclid(count))
                });
                let Some(others) = cells.get(&other) else { continue };
                for &one in spheres {
                    pairs.extend(
                        others
                            .iter()
                            .filter(|&&two| one < two)
                            .map(|&two| [one, two])
                            .filter(|&pair| self.is_near(pair, scale, margin)),
                    );
                }
            }
        }
        pairs
    }

    fn is_near(&self, [one, two]: [u32; 2], scale: f64, margin: f64) -> bool {
        let (one, two) = (one as usize, two as usize);
        let range = self.radius(one, scale) + self.radius(two, scale) + margin;
        let apart = self.images.nearest(self.centres[one] - self.centres[two]);
        one < self.grow && apart.norm_squared() < range * range
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

    use super::super::random_stream;
    use super::*;

    fn cube(edge: f64) -> Cuboid {
        Cuboid { lower: Vector3::zero(), upper: Vector3::new(edge, edge, edge) }
    }

    /// The edge of a cube that so many spheres of radius 1 fill to a solid fraction.
    fn edge(count: usize, fraction: f64) -> f64 {
        (count as f64 * 4.0 / 3.0 * PI / fraction).cbrt()
    }

    fn assert_without_overlap(radii: &[f64], centres: &[Vector3], domain: &Domain) {
        let images = domain.images();
        for one in 0..centres.len() {
            for two in 0..one {
                let apart = images.nearest(centres[one] - centres[two]).norm();
                assert!(apart >= radii[one] + radii[two], "{one} and {two}: {apart}");
            }
        }
    }

    #[test]
    fn a_periodic_packing_is_dense_without_overlap_and_repeats_with_its_seed() {
        let count = 300;
        let region = cube(edge(count, 0.62));
        let domain = Domain::periodic(region.lower, region.upper, [true; 3]);
        let radii = vec![1.0; count];
        let grow = |seed| dense_positions(&radii, &region, &domain, &[], &mut random_stream(seed)).unwrap();
        let centres = grow(5);
        assert_without_overlap(&radii, &centres, &domain);
        assert_eq!(centres, grow(5));
        assert_ne!(centres, grow(6));
        // Not a crystal: of 12 neighbours within 1.05 diameters, a packing of this density has some 5 to 8.
        let images = domain.images();
        let near = |one: &Vector3| {
            centres.iter().filter(|two| images.nearest(*one - **two).norm() < 2.1).count() - 1
        };
        let mean = centres.iter().map(near).sum::<usize>() as f64 / count as f64;
        assert!((4.0..9.0).contains(&mean), "{mean}");
    }

    #[test]
    fn spheres_of_many_sizes_lie_whole_in_a_block_beside_what_is_there() {
        let radii: Vec<f64> = (0..250).map(|number| 0.5 + f64::from(number) / 250.0).collect();
        let solid: f64 = radii.iter().map(|radius| 4.0 / 3.0 * PI * radius.powi(3)).sum();
        let region = cube((solid / 0.5).cbrt());
        let present = [(region.upper * 0.5, 2.0)];
        let domain = Domain::unbounded();
        let centres = dense_positions(&radii, &region, &domain, &present, &mut random_stream(2)).unwrap();
        let all: Vec<Vector3> = centres.iter().copied().chain([present[0].0]).collect();
        let sizes: Vec<f64> = radii.iter().copied().chain([2.0]).collect();
        assert_without_overlap(&sizes, &all, &domain);
        for (centre, radius) in centres.iter().zip(&radii) {
            for axis in 0..3 {
                assert!(centre[axis] >= *radius && centre[axis] <= region.upper[axis] - radius);
            }
        }
    }

    #[test]
    fn more_than_random_packings_hold_is_refused_with_what_was_reached() {
        let count = 120;
        let region = cube(edge(count, 0.72));
        let domain = Domain::periodic(region.lower, region.upper, [true; 3]);
        let jammed =
            dense_positions(&vec![1.0; count], &region, &domain, &[], &mut random_stream(1)).unwrap_err();
        // Random close packing is 0.64; a crystal would be 0.74.
        assert!(jammed.reached > 0.58 && jammed.reached < 0.68 && jammed.wanted > 0.71, "{jammed}");
        // A block in which the spheres do not fit at all.
        let thin = Cuboid { lower: Vector3::zero(), upper: Vector3::new(9.0, 9.0, 1.5) };
        let refused = dense_positions(&[1.0; 3], &thin, &Domain::unbounded(), &[], &mut random_stream(1));
        assert!(refused.is_err());
    }
}
