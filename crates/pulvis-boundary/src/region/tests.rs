use super::*;

fn corner(x: f64) -> Vector3 {
    Vector3::new(x, x, x)
}

#[test]
fn a_box_and_a_sphere_hold_what_is_in_them() {
    let domain = Domain::unbounded();
    let cube = Region::Box(Cuboid { lower: corner(0.0), upper: corner(1.0) });
    let ball = Region::Sphere { centre: corner(0.0), radius: 1.0 };
    assert!(cube.contains(corner(0.0), &domain) && cube.contains(corner(1.0), &domain));
    assert!(!cube.contains(Vector3::new(0.5, 0.5, 1.0 + 1e-15), &domain));
    assert!(ball.contains(corner(0.577), &domain) && !ball.contains(corner(0.578), &domain));
    let half = Region::Box(Cuboid { lower: corner(f64::NEG_INFINITY), upper: corner(0.0) });
    assert!(half.contains(corner(-1e300), &domain) && !half.contains(corner(1e-9), &domain));
    for region in [cube, ball, half] {
        assert!(!region.contains(Vector3::new(0.0, f64::NAN, 0.0), &domain));
    }
}

#[test]
fn every_image_counts_along_periodic_directions() {
    let domain = Domain::periodic(corner(0.0), corner(1.0), [true, false, false]);
    let slab = Region::Box(Cuboid { lower: Vector3::new(0.9, 0.0, 0.0), upper: Vector3::new(1.1, 1.0, 1.0) });
    let at = |x: f64| Vector3::new(x, 0.5, 0.5);
    for inside in [0.95, 0.05, -0.05, 1.05, 2.0, -7.0] {
        assert!(slab.contains(at(inside), &domain), "{inside}");
    }
    assert!(!slab.contains(at(0.5), &domain) && !slab.contains(at(1.5), &domain));
    assert!(!slab.contains(Vector3::new(0.95, -0.5, 0.5), &domain));
    let ball = Region::Sphere { centre: at(0.0), radius: 0.1 };
    assert!(ball.contains(at(0.95), &domain) && !ball.contains(at(0.8), &domain));
    assert!(!ball.contains(Vector3::new(0.0, 1.5, 0.5), &domain));
    let left = Vector3::new(f64::NEG_INFINITY, 0.0, 0.0);
    let unbounded = Region::Box(Cuboid { lower: left, upper: Vector3::new(0.2, 1.0, 1.0) });
    assert!(unbounded.contains(at(0.7), &domain));
}

#[test]
fn a_cylinder_and_a_layer_hold_what_is_in_them() {
    let domain = Domain::unbounded();
    let ends = [Vector3::new(0.0, 0.0, 1.0), Vector3::new(0.0, 0.0, 3.0)];
    let drum = Region::Cylinder { ends, radius: 0.5 };
    let layer = Region::Layer { axis: 2, lower: 1.0, upper: 3.0 };
    for (x, z, inside) in [(0.0, 1.0, true), (0.5, 3.0, true), (0.51, 2.0, false), (0.0, 0.99, false)] {
        assert_eq!(drum.contains(Vector3::new(x, 0.0, z), &domain), inside, "{x} {z}");
        assert_eq!(layer.contains(Vector3::new(x, 1e9, z), &domain), (1.0..=3.0).contains(&z));
    }
    let tilted = Region::Cylinder { ends: [corner(-1.0), corner(1.0)], radius: 0.5 };
    assert!(tilted.contains(corner(0.9), &domain) && !tilted.contains(corner(1.01), &domain));
    assert!(!tilted.contains(Vector3::new(0.4, -0.4, 0.0), &domain));
    let [lower, upper] = tilted.bounds();
    let reach = 1.0 + 0.5 * (2.0_f64 / 3.0).sqrt();
    assert!((upper - corner(reach)).norm() < 1e-14 && (lower + corner(reach)).norm() < 1e-14);
    for region in [drum, tilted, layer] {
        assert!(!region.contains(Vector3::new(0.0, f64::NAN, 1.5), &domain));
    }
    let turning = Domain::periodic(corner(0.0), corner(4.0), [false, false, true]);
    assert!(layer.contains(Vector3::new(0.0, 0.0, -2.0), &turning));
    assert!(drum.contains(Vector3::new(0.0, 0.0, -2.0), &turning));
    assert!(!drum.contains(Vector3::new(0.0, 0.0, 0.5), &turning));
}

#[test]
fn volumes_are_those_of_the_text_books() {
    use std::f64::consts::PI;
    let ends = [corner(0.0), Vector3::new(0.0, 3.0, 4.0)];
    let cube = Cuboid { lower: corner(0.0), upper: corner(2.0) };
    let half = Cuboid { lower: Vector3::new(f64::NEG_INFINITY, 0.0, 0.0), ..cube };
    let cases = [
        (Region::Sphere { centre: corner(1.0), radius: 2.0 }, 32.0 / 3.0 * PI),
        (Region::Cylinder { ends, radius: 2.0 }, 20.0 * PI),
        (Region::Box(cube), 8.0),
        (Region::Box(half), 28.0),
        (Region::Layer { axis: 1, lower: 1.0, upper: 1.5 }, 31.5),
    ];
    for (region, volume) in cases {
        assert!((region.volume([7.0, 8.0, 9.0]) / volume - 1.0).abs() < 1e-14, "{region:?}");
    }
}

#[test]
fn half_of_a_line_across_a_face_lies_inside() {
    let domain = Domain::unbounded();
    let ends = [corner(0.0), Vector3::new(0.0, 0.0, 1.0)];
    let share =
        |region: Region, from: [f64; 3], to: [f64; 3]| region.share_of_line(from.into(), to.into(), &domain);
    let cube = Region::Box(Cuboid { lower: corner(0.0), upper: corner(1.0) });
    let drum = Region::Cylinder { ends, radius: 1.0 };
    let ball = Region::Sphere { centre: corner(0.0), radius: 1.0 };
    let layer = Region::Layer { axis: 0, lower: 0.0, upper: 1.0 };
    for region in [cube, drum, ball, layer] {
        assert!((share(region, [0.5, 0.1, 0.1], [1.5, 0.1, 0.1]) - 0.5).abs() < 0.02, "{region:?}");
        assert_eq!(share(region, [0.2, 0.1, 0.1], [0.3, 0.2, 0.2]), 1.0);
        assert_eq!(share(region, [1.2, 0.1, 0.1], [1.3, 0.1, 0.1]), 0.0);
    }
    // A chord of √3/2 on either side of the centre, out of a line of length 4.
    assert!((share(ball, [-2.0, 0.5, 0.0], [2.0, 0.5, 0.0]) - 0.75_f64.sqrt() / 2.0).abs() < 1e-14);
    assert!((share(drum, [0.0, 0.0, -1.0], [0.0, 0.0, 3.0]) - 0.25).abs() < 1e-14);
    assert_eq!(share(layer, [2.0, 0.0, 0.0], [2.0, 9.0, 0.0]), 0.0);
}

#[test]
fn regions_that_fill_space_share_every_line_out_between_them_across_periods_too() {
    let domain = Domain::periodic(corner(0.0), corner(1.0), [true, true, false]);
    let layers = [(-0.1, 0.25), (0.25, 0.9)].map(|(lower, upper)| Region::Layer { axis: 0, lower, upper });
    let infinite = f64::INFINITY;
    let boxes = [(0.0, 0.5), (0.5, 1.0)].map(|(lower, upper)| {
        let (lower, upper) = (Vector3::new(lower, 0.2, -infinite), Vector3::new(upper, 1.2, infinite));
        Region::Box(Cuboid { lower, upper })
    });
    for step in 0..40 {
        let at = f64::from(step) * 0.037 - 0.4;
        let from = Vector3::new(at, 1.0 - 2.0 * at, 0.3);
        for to in [[0.3, 0.1, 0.2], [-0.3, 0.2, -0.1], [0.0, -0.4, 0.0]] {
            let to = from + Vector3::from(to);
            for parts in [&layers[..], &boxes[..]] {
                let sum: f64 = parts.iter().map(|part| part.share_of_line(from, to, &domain)).sum();
                assert!((sum - 1.0).abs() < 1e-13, "{from:?} {to:?} {sum}");
            }
        }
    }
}

#[test]
fn regions_of_a_sheared_cell_take_images_along_its_edges() {
    let domain = Domain { tilts: [0.3, -0.2, 0.4], ..Domain::periodic(corner(0.0), corner(1.0), [true; 3]) };
    let layers = [(0.0, 0.25), (0.25, 1.0)].map(|(lower, upper)| Region::Layer { axis: 2, lower, upper });
    // The block in eight boxes, whose images fill space as those of the cell do.
    let boxes: Vec<Region> = (0..8)
        .map(|number| {
            let lower = [0, 1, 2].map(|axis| if number >> axis & 1 == 1 { 0.4 } else { 0.0 });
            let upper = lower.map(|lower| if lower > 0.0 { 1.0 } else { 0.4 });
            Region::Box(Cuboid { lower: lower.into(), upper: upper.into() })
        })
        .collect();
    let ball = Region::Sphere { centre: corner(0.05), radius: 0.2 };
    for step in 0..60 {
        let at = f64::from(step) * 0.0371 - 0.9;
        let from = Vector3::new(at, 1.0 - 2.0 * at, 0.3 + 1.7 * at);
        for parts in [&layers[..], &boxes] {
            assert_eq!(parts.iter().filter(|part| part.contains(from, &domain)).count(), 1, "{from:?}");
            for to in [[0.3, 0.1, 0.2], [-0.3, 0.2, -0.1], [0.0, -0.2, 0.1]] {
                let to = from + Vector3::from(to);
                let sum: f64 = parts.iter().map(|part| part.share_of_line(from, to, &domain)).sum();
                assert!((sum - 1.0).abs() < 1e-13, "{from:?} {to:?} {sum}");
            }
        }
        for axis in 0..3 {
            let image = from + domain.shift(axis);
            for region in boxes.iter().chain(&layers).chain([&ball]) {
                assert_eq!(
                    region.contains(from, &domain),
                    region.contains(image, &domain),
                    "{from:?} {axis}"
                );
            }
        }
    }
    // Over the corner of the block, and the image of the centre one edge along z farther.
    for edge in [Vector3::zero(), domain.shift(1), -domain.shift(2), domain.shift(0) - domain.shift(1)] {
        assert!(ball.contains(corner(-0.05) + edge, &domain), "{edge:?}");
    }
}

#[test]
fn spheres_whose_centres_lie_in_the_inset_lie_whole_in_the_region_and_touch_its_boundary() {
    let unit = Vector3::new(1.0, 1.0, 1.0);
    let open = Domain::unbounded();
    let block = Region::Box(Cuboid { lower: Vector3::zero(), upper: unit });
    let inner = Region::Box(Cuboid { lower: unit * 0.25, upper: unit * 0.75 });
    assert_eq!(block.inset(0.25, &open), Some(inner));
    assert_eq!(block.inset(0.51, &open), None);
    // Along a whole period there are no ends.
    let periodic = Domain::periodic(Vector3::zero(), unit, [true, false, false]);
    let (lower, upper) = (Vector3::new(0.0, 0.25, 0.25), Vector3::new(1.0, 0.75, 0.75));
    assert_eq!(block.inset(0.25, &periodic), Some(Region::Box(Cuboid { lower, upper })));
    let ball = Region::Sphere { centre: unit, radius: 2.0 };
    assert_eq!(ball.inset(0.5, &open), Some(Region::Sphere { centre: unit, radius: 1.5 }));
    assert_eq!(ball.inset(2.5, &open), None);
    let rod = Region::Cylinder { ends: [Vector3::zero(), Vector3::new(0.0, 0.0, 4.0)], radius: 1.0 };
    let ends = [Vector3::new(0.0, 0.0, 0.5), Vector3::new(0.0, 0.0, 3.5)];
    assert_eq!(rod.inset(0.5, &open), Some(Region::Cylinder { ends, radius: 0.5 }));
    assert_eq!(rod.inset(1.5, &open), None);
    let layer = Region::Layer { axis: 1, lower: 0.0, upper: 1.0 };
    assert_eq!(layer.inset(0.4, &open), Some(Region::Layer { axis: 1, lower: 0.4, upper: 0.6 }));
}
