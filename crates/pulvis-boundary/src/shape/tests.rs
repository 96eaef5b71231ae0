#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::disallowed_methods)]

use pulvis_math::F64Array;

use super::*;

const AXIS: Vector3 = Vector3 { x: 2.0 / 7.0, y: -3.0 / 7.0, z: 6.0 / 7.0 };
const POINT: Vector3 = Vector3 { x: 0.3, y: -1.2, z: 0.7 };
const RADIUS: f64 = 1.7;

fn cylinder(side: CylinderSide) -> Edgeless {
    Edgeless::Cylinder(Cylinder { axis: AXIS, radius: RADIUS, side })
}

/// Two unit vectors across the axis.
fn two_across() -> [Vector3; 2] {
    let one = Vector3::new(1.0, 0.0, 0.0).tangential_to(AXIS);
    let one = one * (1.0 / one.norm());
    [one, AXIS.cross(one)]
}

/// The point of a grid on the cylinder's surface that is nearest to `centre`, by search alone: three rounds, each
/// around the best point of the one before.
fn nearest(centre: Vector3) -> Vector3 {
    let [one, other] = two_across();
    let (mut best, mut angle, mut height) = (POINT, 0.0, 0.0);
    let mut span = [std::f64::consts::PI, 8.0];
    for _ in 0..6 {
        let (around, along) = (angle, height);
        let mut least = f64::INFINITY;
        for i in -60..=60 {
            for j in -60..=60 {
                let (a, h) = (around + span[0] * f64::from(i) / 60.0, along + span[1] * f64::from(j) / 60.0);
                let point = POINT + AXIS * h + (one * a.cos() + other * a.sin()) * RADIUS;
                let distance = (point - centre).norm();
                if distance < least {
                    (least, best, angle, height) = (distance, point, a, h);
                }
            }
        }
        span = span.map(|span| span / 20.0);
    }
    best
}

fn centres() -> [Vector3; 8] {
    let [one, other] = two_across();
    std::array::from_fn(|number| {
        let number = number as f64;
        let (angle, height) = (0.8 * number, 0.9 * number - 3.0);
        let from_axis = RADIUS * (0.57 + 0.15 * number);
        POINT + AXIS * height + (one * angle.cos() + other * angle.sin()) * from_axis
    })
}

#[test]
fn the_surface_of_a_cylinder_is_where_a_search_finds_it() {
    for side in [CylinderSide::Inside, CylinderSide::Outside] {
        for centre in centres() {
            let surface = cylinder(side).surface(POINT, centre);
            let found = nearest(centre);
            let is_outside = (centre - POINT).tangential_to(AXIS).norm() > RADIUS;
            let in_front = is_outside == (side == CylinderSide::Outside);
            let distance = (centre - found).norm() * if in_front { 1.0 } else { -1.0 };
            // The last grid's spacing is π/60/20⁵ radii, and the distance is stationary there; so is not the point.
            assert!((surface.distance - distance).abs() < 1e-9, "{side:?}: {surface:?} {distance}");
            assert!((centre - surface.normal * surface.distance - found).norm() < 1e-6, "{surface:?}");
            assert!((surface.normal.norm() - 1.0).abs() < 1e-14);
        }
    }
}

#[test]
fn eight_spheres_at_a_time_see_the_surface_that_each_sees_alone() {
    type Eight = F64Array<8>;
    let shapes = [
        Edgeless::Plane(Plane { normal: AXIS }),
        cylinder(CylinderSide::Inside),
        cylinder(CylinderSide::Outside),
    ];
    let centres = centres();
    let component = |of: fn(&Vector3) -> f64| Eight::from_fn(|lane| of(&centres[lane]));
    let together = Vector3::new(component(|v| v.x), component(|v| v.y), component(|v| v.z));
    for shape in shapes {
        let all = shape.surface(POINT, together);
        let rates = shape.normal_rate(&all, Vector3::splat(Vector3::new(0.3, 0.2, -0.9)));
        for (lane, &centre) in centres.iter().enumerate() {
            let alone = shape.surface(POINT, centre);
            assert_eq!(all.normal.lane(lane), alone.normal);
            assert_eq!(all.distance.lane(lane), alone.distance);
            assert_eq!(all.mean_curvature.lane(lane), alone.mean_curvature);
            let rate = shape.normal_rate(&alone, Vector3::new(0.3, 0.2, -0.9));
            assert_eq!(rates.map(|rates| rates.lane(lane)), rate);
            // Planes and cylinders are curved alike everywhere.
            let least = match shape {
                Edgeless::Plane(plane) => plane.least_mean_curvature(),
                Edgeless::Cylinder(cylinder) => cylinder.least_mean_curvature(),
            };
            assert_eq!(alone.mean_curvature, least);
        }
    }
}

#[test]
fn the_normal_turns_as_fast_as_the_shape_says() {
    let velocity = Vector3::new(0.4, 0.7, -0.5);
    let step = 1e-5;
    for side in [CylinderSide::Inside, CylinderSide::Outside] {
        let shape = cylinder(side);
        for centre in centres() {
            let normal = |shift: f64| shape.surface(POINT, centre + velocity * shift).normal;
            let turned = (normal(step) - normal(-step)) * (0.5 / step);
            let rate = shape.normal_rate(&shape.surface(POINT, centre), velocity).unwrap();
            // Central difference: second order in the step.
            assert!((turned - rate).norm() < 1e-8, "{side:?}: {turned:?} {rate:?}");
            let along = shape.normal_rate(&shape.surface(POINT, centre), AXIS).unwrap();
            assert!(along.norm() < 1e-15, "motion along the axis turns nothing: {along:?}");
        }
    }
}

#[test]
fn a_sphere_on_the_axis_sees_a_wall_far_away_and_no_nan() {
    let surface = cylinder(CylinderSide::Inside).surface(POINT, POINT);
    assert_eq!(surface.normal, Vector3::zero());
    assert_eq!(surface.distance, RADIUS);
    let rate = cylinder(CylinderSide::Inside).normal_rate(&surface, Vector3::new(1.0, 0.0, 0.0));
    assert_eq!(rate, Some(Vector3::zero()));
}

#[test]
fn a_cylinder_that_moves_along_its_axis_comes_no_nearer() {
    let shape = Cylinder { axis: AXIS, radius: RADIUS, side: CylinderSide::Outside };
    assert!(shape.approach(AXIS * 3.0) < 1e-15);
    let [one, _] = two_across();
    assert!((shape.approach(AXIS * 3.0 + one * 0.25) - 0.25).abs() < 1e-15);
    assert!((WallShape::from(Plane { normal: AXIS }).approach(AXIS * -0.5) - 0.5).abs() < 1e-15);
}

#[test]
fn shapes_that_cannot_be_are_refused_in_words() {
    let refused = |shape: WallShape, radius: f64| shape.check(radius).unwrap_err();
    let axis = Vector3::new(0.0, 0.0, 1.0);
    let inside = |radius: f64| Cylinder { axis, radius, side: CylinderSide::Inside };
    assert_eq!(inside(0.1).check(0.05), Ok(()));
    assert_eq!(Cylinder { side: CylinderSide::Outside, ..inside(0.1) }.check(5.0), Ok(()));
    assert_eq!(refused(inside(0.1).into(), 0.1), "a particle of 0.1 m radius has no room inside 0.1 m");
    assert_eq!(refused(inside(f64::NAN).into(), 0.0), "its radius is NaN m, not a length greater than zero");
    assert_eq!(
        refused(Cylinder { axis: axis * 2.0, ..inside(0.1) }.into(), 0.0),
        "its axis (0, 0, 2) is not of length 1"
    );
    assert_eq!(
        refused(Plane { normal: Vector3::zero() }.into(), 0.0),
        "its normal (0, 0, 0) is not of length 1"
    );
}

mod edged;
mod mesh;
