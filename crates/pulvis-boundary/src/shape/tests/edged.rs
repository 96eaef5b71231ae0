//! Shapes with edges around an axis.

use pulvis_math::elementary::sin_cos;

use super::*;

const FAR: f64 = 100.0;

fn shapes() -> [(WallShape, [[f64; 2]; 2]); 6] {
    let (axis, normal) = (AXIS, AXIS);
    let cone = |radii: [f64; 2]| Cone { axis, radii, height: 0.9 }.into();
    [
        (cone([0.4, 1.1]), [[0.4, 0.0], [1.1, 0.9]]),
        (cone([1.1, 0.0]), [[1.1, 0.0], [0.0, 0.9]]),
        (cone([0.0, 2.5]), [[0.0, 0.0], [2.5, 0.9]]),
        (Tube { axis, radius: 0.7, length: 1.3 }.into(), [[0.7, 0.0], [0.7, 1.3]]),
        (Disk { normal, radius: 0.8 }.into(), [[0.0, 0.0], [0.8, 0.0]]),
        // As far as centres of the tests are from it.
        (PlaneWithHole { normal, radius: 0.6 }.into(), [[0.6, 0.0], [9.0, 0.0]]),
    ]
}

/// Centres all around the shapes, from their reference point.
fn around() -> Vec<Vector3> {
    let [one, other] = two_across();
    let at = |number: u32| {
        let (sine, cosine) = sin_cos(2.4 * f64::from(number));
        let from_axis = 0.013 + 1.7 * (0.618_034 * f64::from(number)).fract();
        (one * cosine + other * sine) * from_axis
            + AXIS * (2.6 * (0.414_213 * f64::from(number)).fract() - 0.7)
    };
    (0..300).map(at).collect()
}

/// The point of the surface that is nearest to a centre, by search over the line in its half-plane.
fn nearest_by_search([start, end]: [[f64; 2]; 2], centre: Vector3) -> Vector3 {
    let across = centre.tangential_to(AXIS);
    let outwards = across * (1.0 / across.norm());
    let at = |share: f64| {
        let [radius, height] = [0, 1].map(|axis| start[axis] + (end[axis] - start[axis]) * share);
        outwards * radius + AXIS * height
    };
    let mut interval = [0.0_f64, 1.0];
    for _ in 0..200 {
        let thirds = [1.0, 2.0].map(|part| interval[0] + (interval[1] - interval[0]) * part / 3.0);
        let [one, other] = thirds.map(|share| (at(share) - centre).norm());
        if one < other { interval[1] = thirds[1] } else { interval[0] = thirds[0] }
    }
    at(0.5 * (interval[0] + interval[1]))
}

#[test]
fn the_nearest_point_of_every_shape_is_where_a_search_finds_it() {
    for (shape, ends) in shapes() {
        for centre in around() {
            let found = nearest_by_search(ends, centre);
            let seen = shape.edged().unwrap().surface_of(0, centre, FAR).unwrap();
            // The search stops where the distance no longer changes, which is the root of the rounding error.
            assert!((centre - seen.normal * seen.distance - found).norm() < 1e-7, "{shape:?} {centre:?}");
            assert!((seen.normal.norm() - 1.0).abs() < 1e-14);
            assert!(seen.tangent.dot(seen.normal).abs() < 1e-14 && (seen.tangent.norm() - 1.0).abs() < 1e-14);
            assert!((shape.distance(centre) - seen.distance).abs() < 1e-15);
            assert_eq!(
                shape.edged().unwrap().surface_of(0, centre, seen.distance),
                None,
                "not nearer than that"
            );
        }
    }
}

#[test]
fn the_normal_is_the_gradient_of_the_distance_on_either_side_of_the_axis() {
    let step = 1e-6;
    for (shape, _) in shapes() {
        let shape = shape.edged().unwrap();
        for (feature, centre) in around().into_iter().flat_map(|centre| [(0, centre), (1, centre)]) {
            let Some(seen) = shape.surface_of(feature, centre, FAR) else { continue };
            for axis in 0..3 {
                let mut shift = Vector3::zero();
                *shift.component_mut(axis) = step;
                let at = |centre| shape.surface_of(feature, centre, FAR).unwrap().distance;
                let slope = (at(centre + shift) - at(centre - shift)) * (0.5 / step);
                // Rounding errors over the step; near a rim the second difference is as large as one over the distance.
                assert!((slope - seen.normal[axis]).abs() < 2e-5, "{feature} {centre:?} {slope} {seen:?}");
            }
        }
    }
}

#[test]
fn the_normal_turns_as_fast_as_the_feature_says() {
    let (velocity, step) = (Vector3::new(0.4, 0.7, -0.5), 1e-6);
    for (shape, _) in shapes() {
        let shape = shape.edged().unwrap();
        for centre in around() {
            let seen = shape.surface_of(0, centre, FAR).unwrap();
            let normal = |shift: f64| shape.surface_of(0, centre + velocity * shift, FAR).unwrap().normal;
            let turned = (normal(step) - normal(-step)) * (0.5 / step);
            let rate = seen.normal_rate(velocity);
            // Central difference: second order in the step over the distance from axis and rim, of which the least is 0.01.
            assert!((turned - rate).norm() < 1e-4 * (1.0 + rate.norm()), "{seen:?}: {turned:?} {rate:?}");
        }
    }
}

#[test]
fn a_tube_is_curved_as_a_cylinder_and_a_disk_is_flat_up_to_its_rim() {
    let [one, _] = two_across();
    let tube = WallShape::from(Tube { axis: AXIS, radius: 0.7, length: 1.3 });
    let seen = |shape: &WallShape, centre| shape.edged().unwrap().surface_of(0, centre, FAR).unwrap();
    for (from_axis, sign) in [(0.6, -1.0), (0.8, 1.0)] {
        let curvature = seen(&tube, one * from_axis + AXIS * 0.4).mean_curvature;
        assert!((curvature - sign * 0.5 / 0.7).abs() < 1e-14);
    }
    // cos θ/(2 r) of a cone: at 45° and the radius 1.
    let cone = WallShape::from(Cone { axis: AXIS, radii: [0.5, 1.5], height: 1.0 });
    let inwards = (AXIS - one) * 0.5_f64.sqrt();
    let curvature = seen(&cone, one + AXIS * 0.5 + inwards * 0.1).mean_curvature;
    assert!((curvature + 0.25 * 2.0_f64.sqrt()).abs() < 1e-14, "{curvature}");
    let disk = WallShape::from(Disk { normal: AXIS, radius: 0.8 });
    assert_eq!(seen(&disk, one * 0.9 + AXIS * 0.1).mean_curvature, 0.0);
    // Nothing is more hollow than a tube as wide as the sphere.
    assert_eq!(cone.least_mean_curvature_for(0.1), -0.5 / 0.5);
    assert_eq!(cone.least_mean_curvature_for(2.0), -0.5 / 2.0);
    assert_eq!(
        WallShape::from(Cone { axis: AXIS, radii: [0.0, 1.0], height: 1.0 }).least_mean_curvature_for(2.0),
        -0.25
    );
}

#[test]
fn a_grain_on_the_axis_is_held_at_two_opposite_points() {
    for (shape, _) in shapes() {
        let seen = |feature: u32| shape.edged().unwrap().surface_of(feature, AXIS * 0.2, FAR);
        let Some(far) = seen(1) else { continue };
        let near = seen(0).unwrap();
        assert!((near.distance - far.distance).abs() < 1e-15);
        assert!((near.normal.tangential_to(AXIS) + far.normal.tangential_to(AXIS)).norm() < 1e-15);
        // The axis is of unit length up to rounding errors.
        assert!((near.normal.dot(AXIS) - far.normal.dot(AXIS)).abs() < 1e-14);
    }
}

#[test]
fn features_near_a_centre_are_those_that_it_can_meet() {
    for (shape, _) in shapes() {
        let shape = shape.edged().unwrap();
        for centre in around() {
            let mut found = Vec::new();
            shape.features_near(centre, 0.3, &mut found);
            for feature in 0..2 {
                let seen = shape.surface_of(feature, centre, 0.3);
                let listed = found.iter().find(|(known, _)| *known == feature);
                let Some(seen) = seen else { continue };
                assert!(listed.is_some_and(|(_, distance)| (distance - seen.distance).abs() < 1e-15));
            }
        }
    }
}

#[test]
fn edged_shapes_that_cannot_be_are_refused_in_words() {
    let (axis, normal) = (AXIS, AXIS);
    let refused = |shape: WallShape| shape.check(0.1).unwrap_err();
    let cone = Cone { axis, radii: [0.0, 1.0], height: 1.0 };
    assert_eq!(cone.check(1.0), Ok(()));
    assert_eq!(
        refused(Cone { radii: [0.0, 0.0], ..cone }.into()),
        "its radii are 0 m and 0 m, not lengths of which one is greater than zero"
    );
    assert_eq!(
        refused(Cone { height: -1.0, ..cone }.into()),
        "its height is -1 m, not a length greater than zero"
    );
    assert_eq!(
        refused(Tube { axis, radius: 1.0, length: f64::NAN }.into()),
        "its length is NaN m, not a length greater than zero"
    );
    assert_eq!(
        refused(Disk { normal, radius: 0.0 }.into()),
        "its radius is 0 m, not a length greater than zero"
    );
    assert_eq!(
        refused(PlaneWithHole { normal: Vector3::zero(), radius: 1.0 }.into()),
        "its axis (0, 0, 0) is not of length 1"
    );
}
