//! Random positions without overlap.

use pulvis_boundary::{Cuboid, Domain};
use pulvis_math::{Vector3, elementary};
use rand::RngExt;
use thiserror::Error;

use super::{OccupiedSpace, Random};

/// There is no room for a sphere.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[error(
    "no room for sphere {placed} of {wanted} (radius {radius} m) after {attempts} random trials; the solid fraction would be {solid_fraction:.3}"
)]
pub struct NoRoom {
    /// Spheres placed before.
    pub placed: usize,
    /// Spheres wanted.
    pub wanted: usize,
    /// Radius of the sphere that found no room [m].
    pub radius: f64,
    /// Trials made for it.
    pub attempts: usize,
    /// Volume of all spheres over that of the region [1].
    pub solid_fraction: f64,
}

const ATTEMPTS: usize = 20_000;

/// Random positions for spheres of the given radii [m], none of which overlap each other or the
/// `present` ones (centre [m], radius [m]): random sequential addition, the largest first. The spheres
/// lie whole in `region`, except along periodic directions.
///
/// # Errors
/// A sphere finds no room.
pub fn random_positions(
    radii: &[f64],
    region: &Cuboid,
    domain: &Domain,
    present: &[(Vector3, f64)],
    random: &mut Random,
) -> Result<Vec<Vector3>, NoRoom> {
    let largest = radii.iter().chain(present.iter().map(|(_, radius)| radius)).copied().fold(0.0, f64::max);
    let mut occupied = OccupiedSpace::new(2.0 * largest.max(f64::MIN_POSITIVE), *domain);
    for &(centre, radius) in present {
        occupied.add(centre, radius);
    }
    let mut order: Vec<usize> = (0..radii.len()).collect();
    order.sort_by(|&a, &b| radii[b].total_cmp(&radii[a]).then(a.cmp(&b)));
    let mut positions = vec![Vector3::zero(); radii.len()];
    for (placed, &sphere) in order.iter().enumerate() {
        let radius = radii[sphere];
        let free = (0..ATTEMPTS).find_map(|_| {
            let centre = draw(region, domain, radius, random)?;
            occupied.is_free(centre, radius).then_some(centre)
        });
        let Some(centre) = free else {
            let solid: f64 = radii
                .iter()
                .map(|&radius| 4.0 / 3.0 * std::f64::consts::PI * elementary::powi(radius, 3))
                .sum();
            let solid_fraction = solid / region.volume();
            let wanted = radii.len();
            return Err(NoRoom { placed, wanted, radius, attempts: ATTEMPTS, solid_fraction });
        };
        occupied.add(centre, radius);
        positions[sphere] = centre;
    }
    Ok(positions)
}

fn draw(region: &Cuboid, domain: &Domain, radius: f64, random: &mut Random) -> Option<Vector3> {
    let mut centre = Vector3::zero();
    for axis in 0..3 {
        let margin = if domain.period(axis).is_some() { 0.0 } else { radius };
        let (low, high) = (region.lower[axis] + margin, region.upper[axis] - margin);
        let drawn = random.random::<f64>();
        if low > high {
            return None;
        }
        *centre.component_mut(axis) = low + (high - low) * drawn;
    }
    Some(centre)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::super::random_stream;
    use super::*;

    fn unit_cube() -> Cuboid {
        Cuboid { lower: Vector3::zero(), upper: Vector3::new(1.0, 1.0, 1.0) }
    }

    #[test]
    fn spheres_lie_in_the_region_and_do_not_overlap_not_even_across_a_periodic_boundary() {
        let domain = Domain::periodic(Vector3::zero(), Vector3::new(1.0, 1.0, 1.0), [true, false, true]);
        let radii: Vec<f64> = (0..200).map(|i| 0.03 + 0.0001 * f64::from(i)).collect();
        let positions = random_positions(&radii, &unit_cube(), &domain, &[], &mut random_stream(3)).unwrap();
        let images = domain.images();
        for i in 0..radii.len() {
            assert!(positions[i].y >= radii[i] && positions[i].y <= 1.0 - radii[i]);
            for j in 0..i {
                let distance = images.nearest(positions[i] - positions[j]).norm();
                assert!(distance >= radii[i] + radii[j], "{i} {j}");
            }
        }
    }

    #[test]
    fn too_many_spheres_are_refused_with_the_solid_fraction() {
        let radii = vec![0.1; 200];
        let error = random_positions(&radii, &unit_cube(), &Domain::unbounded(), &[], &mut random_stream(3));
        let error = error.unwrap_err();
        assert!(error.placed < 200 && error.solid_fraction > 0.8);
    }

    #[test]
    fn regions_that_lie_beyond_all_numbers_of_cells_have_room_or_none_but_break_nothing() {
        for far in [1e30, 1e300] {
            let place = Vector3::new(far, -far, far);
            let region = Cuboid { lower: place, upper: place * 2.0 };
            let placed =
                random_positions(&[1.0, 2.0], &region, &Domain::unbounded(), &[], &mut random_stream(1));
            assert!(placed.map_or(true, |places| places.len() == 2));
        }
    }
}
