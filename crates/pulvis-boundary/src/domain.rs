//! The directions in which space repeats itself.

use pulvis_math::{Real, Vector3};

use crate::{Cuboid, UpperTriangular};

/// Space, periodic in some directions. Directions that are not periodic are unbounded; what keeps
/// particles together there is walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Domain {
    /// The block that repeats; along directions that are not periodic it means nothing.
    pub extent: Cuboid,
    /// Whether x, y, z repeat.
    pub periodic: [bool; 3],
    /// How far the next block along y is shifted along x, and the next one along z along x and along y: the tilts xy, xz
    /// and yz of a cell that has been sheared [m]. Shifts by whole periods change nothing, so that none is longer than half
    /// a period here.
    pub tilts: [f64; 3],
}

impl Domain {
    /// Space without any periodic direction.
    pub fn unbounded() -> Self {
        Self::periodic(Vector3::zero(), Vector3::zero(), [false; 3])
    }

    /// A box from `lower` to `upper` [m], which repeats itself in the marked directions.
    pub fn periodic(lower: Vector3, upper: Vector3, periodic: [bool; 3]) -> Self {
        Self { extent: Cuboid { lower, upper }, periodic, tilts: [0.0; 3] }
    }

    /// The period along an axis [m], `None` where it is not periodic.
    pub fn period(&self, axis: usize) -> Option<f64> {
        self.periodic[axis].then(|| self.extent.size()[axis])
    }

    /// From one image to the next along an axis [m], zero where it is not periodic.
    pub fn shift(&self, axis: usize) -> Vector3 {
        let [xy, xz, yz] = self.tilts;
        let period = self.period(axis).unwrap_or(0.0);
        match axis {
            0 => Vector3::new(period, 0.0, 0.0),
            1 => Vector3::new(xy, period, 0.0),
            _ => Vector3::new(xz, yz, period),
        }
    }

    /// A length along an axis [m] in periods; zero where it is not periodic.
    pub fn turns(&self, length: f64, axis: usize) -> f64 {
        self.period(axis).map_or(0.0, |period| length / period)
    }

    /// Whether the blocks along an axis are shifted along another one.
    pub fn is_tilted(&self) -> bool {
        self.tilts != [0.0; 3]
    }

    /// The edges of the cell that repeats, as columns [m]: along x, along y with the tilt xy, along z with the tilts xz and
    /// yz.
    pub fn edges(&self) -> UpperTriangular {
        let Vector3 { x, y, z } = self.extent.size();
        let [xy, xz, yz] = self.tilts;
        UpperTriangular { xx: x, yy: y, zz: z, xy, xz, yz }
    }

    /// The middle of the block [m], which stays where it is when the cell deforms.
    pub fn middle(&self) -> Vector3 {
        (self.extent.lower + self.extent.upper) * 0.5
    }

    /// The domain after a deformation about the middle of its block.
    pub fn deformed(&self, gradient: &UpperTriangular) -> Self {
        let edges = gradient.after(&self.edges());
        let (middle, half) = (self.middle(), Vector3::new(edges.xx, edges.yy, edges.zz) * 0.5);
        let mut deformed = *self;
        for axis in (0..3).filter(|&axis| self.periodic[axis]) {
            *deformed.extent.lower.component_mut(axis) = middle[axis] - half[axis];
            *deformed.extent.upper.component_mut(axis) = middle[axis] + half[axis];
        }
        // The image along z is one shift along y farther, which comes with a shift along x, where `yz` loses a period.
        let [yz, turns] = remainder(edges.yz, edges.yy);
        let [xz, _] = remainder(edges.xz - turns * edges.xy, edges.xx);
        let [xy, _] = remainder(edges.xy, edges.xx);
        Self { tilts: [xy, xz, yz], ..deformed }
    }

    /// The position brought back into the box along the periodic directions.
    #[inline]
    pub fn wrapped(&self, mut position: Vector3) -> Vector3 {
        if self.is_tilted() {
            return self.wrapped_tilted(position);
        }
        for axis in 0..3 {
            if let Some(period) = self.period(axis) {
                let turns = ((position[axis] - self.extent.lower[axis]) / period).floor();
                *position.component_mut(axis) -= turns * period;
            }
        }
        position
    }

    /// The same where blocks are shifted. What comes back is in the block and not in the parallelepiped of the edges: the
    /// block fills space as well, and stays the same however often the tilt loses a period.
    fn wrapped_tilted(&self, mut position: Vector3) -> Vector3 {
        for axis in [2, 1, 0] {
            let turns = self.turns(position[axis] - self.extent.lower[axis], axis).floor();
            position -= self.shift(axis) * turns;
        }
        position
    }

    /// A position [m] as a straight cell would have it: sheared back, and brought into the box. For a search by cells.
    pub fn straightened(&self, position: Vector3) -> Vector3 {
        let straight = Self { tilts: [0.0; 3], ..*self };
        straight.wrapped(self.extent.lower + self.shear().inverse().times(position - self.extent.lower))
    }

    /// By which factors the components of a separation grow at most when it is sheared back, over its length [1].
    pub fn straightening(&self) -> [f64; 3] {
        let UpperTriangular { xy, xz, yz, .. } = self.shear().inverse();
        [Vector3::new(1.0, xy, xz).norm(), Vector3::new(0.0, 1.0, yz).norm(), 1.0]
    }

    /// The shear that makes a straight cell the tilted one.
    fn shear(&self) -> UpperTriangular {
        let Vector3 { y, z, .. } = self.extent.size();
        // Where nothing is tilted a length may be zero.
        let ratio = |tilt: f64, length: f64| if tilt == 0.0 { 0.0 } else { tilt / length };
        let [xy, xz, yz] = self.tilts;
        UpperTriangular { xy: ratio(xy, y), xz: ratio(xz, z), yz: ratio(yz, z), ..UpperTriangular::IDENTITY }
    }

    /// Periods for the contact loop, infinite where there is none.
    pub fn images(&self) -> Images {
        let periods = [0, 1, 2].map(|axis| self.period(axis).unwrap_or(f64::INFINITY));
        let tilts = self.is_tilted().then_some(self.tilts);
        Images { periods, any: self.periodic.contains(&true), tilts }
    }
}

/// The part of a shift that is no whole number of periods, and that number.
fn remainder(shift: f64, period: f64) -> [f64; 2] {
    if shift == 0.0 {
        return [0.0; 2];
    }
    let turns = (shift / period).round();
    [shift - turns * period, turns]
}

/// The nearest-image rule.
#[derive(Clone, Copy, Debug)]
pub struct Images {
    periods: [f64; 3],
    any: bool,
    /// The tilts xy, xz and yz, where there are any [m].
    tilts: Option<[f64; 3]>,
}

impl Images {
    /// The shortest of the vectors that differ from `separation` by whole periods, for separations
    /// below one and a half periods.
    ///
    /// In a tilted cell it is the shortest if that is shorter than half of every period; shorter ones are what contacts
    /// have.
    #[inline(always)]
    pub fn nearest<R: Real>(&self, separation: Vector3<R>) -> Vector3<R> {
        if !self.any {
            return separation;
        }
        if let Some(tilts) = self.tilts {
            return self.nearest_tilted(separation, tilts);
        }
        Vector3::new(
            nearest_along(separation.x, self.periods[0]),
            nearest_along(separation.y, self.periods[1]),
            nearest_along(separation.z, self.periods[2]),
        )
    }

    /// The same in a tilted cell, from z to x: a vector shorter than half of every period has a z that only one number of
    /// periods leads to, then such a y, then such an x. Which whole periods the tilts have lost does not matter.
    ///
    /// Two of them along x and y: positions in the block are up to a period apart, and shifts add half a period each.
    #[inline(always)]
    fn nearest_tilted<R: Real>(&self, separation: Vector3<R>, [xy, xz, yz]: [f64; 3]) -> Vector3<R> {
        let [along_x, along_y, along_z] = self.periods;
        let Vector3 { mut x, mut y, mut z } = separation;
        let turns = turns_along(z, along_z);
        z = nearest_along(z, along_z);
        (x, y) = (x - turns * R::splat(xz), y - turns * R::splat(yz));
        for _ in 0..2 {
            let turns = turns_along(y, along_y);
            y = nearest_along(y, along_y);
            x -= turns * R::splat(xy);
        }
        for _ in 0..3 {
            x = nearest_along(x, along_x);
        }
        Vector3::new(x, y, z)
    }

    /// Whether the nearest image of a separation is another one.
    #[inline(always)]
    pub fn are_crossed(&self, separation: Vector3) -> bool {
        let beyond = |axis: usize| separation[axis].abs() > 0.5 * self.periods[axis];
        self.any && (beyond(0) | beyond(1) | beyond(2))
    }
}

/// One component of the nearest image.
#[inline(always)]
fn nearest_along<R: Real>(component: R, period: f64) -> R {
    let (whole, half) = (R::splat(period), R::splat(0.5 * period));
    let lowered = R::select(component.gt(half), component - whole, component);
    R::select(component.lt(-half), component + whole, lowered)
}

/// How many periods it takes off: −1, 0 or 1.
#[inline(always)]
fn turns_along<R: Real>(component: R, period: f64) -> R {
    let half = R::splat(0.5 * period);
    let lowered = R::one().keep_where(component.gt(half));
    R::select(component.lt(-half), -R::one(), lowered)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_image_is_never_farther_than_half_a_period() {
        let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 2.0, 3.0), [true, false, true]);
        let images = domain.images();
        let nearest = images.nearest(Vector3::new(0.9, 1.9, -2.0));
        assert!((nearest.x + 0.1).abs() < 1e-15);
        assert_eq!(nearest.y, 1.9);
        assert_eq!(nearest.z, 1.0);
        assert!(
            images.are_crossed(Vector3::new(0.9, 1.9, 0.0))
                && images.are_crossed(Vector3::new(0.0, 0.0, -1.6))
        );
        assert!(!images.are_crossed(Vector3::new(0.4, 1.9, -1.4)));
    }

    #[test]
    fn wrapping_leaves_open_directions_alone() {
        let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 1.0, 1.0), [true, false, false]);
        assert_eq!(domain.wrapped(Vector3::new(-0.25, 7.0, -3.0)), Vector3::new(0.75, 7.0, -3.0));
    }

    /// Points in a block of 1 m, 1.5 m and 2 m whose lower corner is not the origin.
    fn points() -> impl Iterator<Item = Vector3> {
        let along =
            |number: i32, turn: f64| 0.5 * (1.0 + pulvis_math::elementary::cos(turn * f64::from(number)));
        (0..60).map(move |number| {
            Vector3::new(-0.2 + along(number, 0.7), 0.3 + 1.5 * along(number, 1.9), 2.0 * along(number, 3.1))
        })
    }

    fn tilted(tilts: [f64; 3]) -> Domain {
        let lower = Vector3::new(-0.2, 0.3, 0.0);
        Domain { tilts, ..Domain::periodic(lower, lower + Vector3::new(1.0, 1.5, 2.0), [true; 3]) }
    }

    #[test]
    fn in_a_tilted_cell_the_nearest_image_is_the_nearest_of_all_that_there_are() {
        for tilts in [[0.4, 0.0, 0.0], [-0.5, 0.5, -0.75], [0.1, -0.45, 0.6]] {
            let domain = tilted(tilts);
            let [xy, xz, yz] = tilts;
            let mut short = 0;
            for (one, other) in points().flat_map(|one| points().map(move |other| (one, other))) {
                let apart = one - other;
                let steps = || (-4..=4).map(f64::from);
                let all = steps()
                    .flat_map(|i| steps().flat_map(move |j| (-2..=2).map(move |k| (i, j, f64::from(k)))));
                let lengths = all.map(|(i, j, k)| {
                    (apart + Vector3::new(i + j * xy + k * xz, 1.5 * j + k * yz, 2.0 * k)).norm()
                });
                let shortest = lengths.fold(f64::INFINITY, f64::min);
                let found = domain.images().nearest(apart).norm();
                if shortest < 0.5 {
                    short += 1;
                    assert!((found - shortest).abs() < 1e-12, "{tilts:?} {apart:?}: {found} {shortest}");
                } else {
                    assert!(found >= shortest - 1e-12);
                }
            }
            assert!(short > 500);
        }
    }

    #[test]
    fn a_tilt_that_loses_a_period_leaves_all_images_where_they_are() {
        let (domain, lost) = (tilted([0.5, 0.25, -0.75]), tilted([-0.5, 0.25 + 0.5, 0.75]));
        for (one, other) in points().zip(points().skip(7)) {
            let (here, there) = (domain.images().nearest(one - other), lost.images().nearest(one - other));
            assert!(here.norm() > 0.5 || (here - there).norm() < 1e-12, "{here:?} {there:?}");
        }
        // What deforms the cell on and on brings it back to where it was.
        let shear = UpperTriangular { xy: 0.125, ..UpperTriangular::IDENTITY };
        let mut sheared = tilted([0.0; 3]);
        for _ in 0..16 {
            sheared = sheared.deformed(&shear);
            assert!(sheared.tilts[0].abs() <= 0.5);
        }
        assert!(sheared.tilts[0].abs() < 1e-12, "{:?}", sheared.tilts);
    }

    #[test]
    fn wrapping_into_a_tilted_cell_leads_to_an_image_within_the_block() {
        let domain = tilted([0.4, -0.3, 0.7]);
        for far in points().map(|point| point * 7.0 - Vector3::new(4.0, 4.0, 4.0)) {
            let here = domain.wrapped(far);
            let inverse = domain.edges().inverse().times(far - here);
            assert!(inverse.to_array().into_iter().all(|turns| (turns - turns.round()).abs() < 1e-12));
            let within =
                |axis: usize| (domain.extent.lower[axis]..=domain.extent.upper[axis]).contains(&here[axis]);
            assert!(within(0) && within(1) && within(2), "{here:?}");
            let straight = domain.straightened(here);
            assert!((0..3).all(|axis| {
                (domain.extent.lower[axis]..=domain.extent.upper[axis]).contains(&straight[axis])
            }));
        }
    }

    #[test]
    fn a_separation_sheared_back_is_no_longer_than_its_factors_say() {
        let domain = tilted([0.5, -0.5, 0.7]);
        let factors = domain.straightening();
        let straight = Domain { tilts: [0.0; 3], ..domain }.images();
        for (one, other) in points().zip(points().skip(3)) {
            let apart = domain.images().nearest(one - other);
            if apart.norm() < 0.4 {
                let back = straight.nearest(domain.straightened(one) - domain.straightened(other));
                for axis in 0..3 {
                    assert!(back[axis].abs() <= factors[axis] * apart.norm() * (1.0 + 1e-12));
                }
            }
        }
        assert_eq!(tilted([0.0; 3]).straightening(), [1.0; 3]);
    }
}
