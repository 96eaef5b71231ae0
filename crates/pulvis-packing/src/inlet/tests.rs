#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;

fn plan(rate: Amount, total: Option<Amount>) -> InletPlan {
    InletPlan {
        region: Region::Box(Cuboid { lower: Vector3::zero(), upper: Vector3::new(1.0, 1.0, 1.0) }),
        rate,
        total,
        radius: RadiusDistribution::Uniform { minimum: 0.02, maximum: 0.04 },
        density: 1000.0,
        velocity: Vector3::new(0.0, 0.0, -2.0),
        standard_deviation: 0.1,
        seed: 3,
        stream: 1,
    }
}

fn supply(inlet: &mut Inlet, open: f64, space: &mut OccupiedSpace) -> Vec<NewSphere> {
    inlet.supply(open, &Domain::unbounded(), space)
}

fn space() -> OccupiedSpace {
    OccupiedSpace::new(0.08, Domain::unbounded())
}

#[test]
fn an_inlet_brings_in_what_its_rate_says_and_never_more() {
    let open = Domain::unbounded();
    let mut inlet = Inlet::new(plan(Amount::Number(100.0), None), &open).unwrap();
    // 0.07 s are seven hundredths to round-off.
    for (time, expected) in [(0.009, 0), (0.01, 1), (0.07, 6), (0.0799, 0), (0.08, 1), (0.5, 42)] {
        assert_eq!(supply(&mut inlet, time, &mut space()).len(), expected, "{time}");
    }
    let mut inlet = Inlet::new(plan(Amount::Mass(1.0), None), &open).unwrap();
    let mut mass = 0.0;
    for step in 1..=300 {
        let time = f64::from(step) * 0.01;
        mass += supply(&mut inlet, time, &mut space()).iter().map(|sphere| sphere.mass).sum::<f64>();
        // What is missing is less than one sphere: 4/3 pi 0.04^3 m^3 of 1000 kg/m^3.
        assert!(mass <= time * (1.0 + 1e-9) && mass > time - 0.2681, "{mass} kg at {time} s");
    }
    assert!((inlet.state().mass - mass).abs() < 1e-12);
}

#[test]
fn a_total_is_kept_to_the_sphere() {
    let mut inlet =
        Inlet::new(plan(Amount::Mass(1.0), Some(Amount::Number(7.0))), &Domain::unbounded()).unwrap();
    assert_eq!(supply(&mut inlet, 1e3, &mut space()).len(), 7);
    assert!(inlet.is_exhausted() && supply(&mut inlet, 1e9, &mut space()).is_empty());
    let total = Some(Amount::Mass(2.0));
    let mut inlet = Inlet::new(plan(Amount::Number(1e3), total), &Domain::unbounded()).unwrap();
    let mass: f64 = supply(&mut inlet, 1e3, &mut space()).iter().map(|sphere| sphere.mass).sum();
    assert!(mass <= 2.0 && mass > 2.0 - 0.2681 && inlet.is_exhausted(), "{mass}");
    assert_eq!(inlet.delay(1e9), 0.0);
}

#[test]
fn spheres_lie_whole_in_the_region_overlap_nothing_and_wait_where_there_is_no_room() {
    let mut inlet = Inlet::new(plan(Amount::Number(1e5), None), &Domain::unbounded()).unwrap();
    let mut space = space();
    let spheres = supply(&mut inlet, 1.0, &mut space);
    // Far less than 100 000: random sequential addition ends at a solid fraction below 0.4.
    assert!(spheres.len() > 1000 && spheres.len() < 5000, "{}", spheres.len());
    for (number, one) in spheres.iter().enumerate() {
        let [low, high] = [one.position.to_array(), one.position.to_array()];
        assert!(low.iter().all(|at| *at >= one.radius) && high.iter().all(|at| *at <= 1.0 - one.radius));
        for other in &spheres[..number] {
            assert!((one.position - other.position).norm() >= one.radius + other.radius);
        }
    }
    // The next sphere, number n + 1, was due after (n + 1)/rate; it keeps its radius while it waits.
    let due = (spheres.len() + 1) as f64 / 1e5;
    assert!((inlet.delay(1.0) - (1.0 - due)).abs() < 1e-12);
    let waiting = inlet.state().next_radius;
    // A hundred more trials find a few more places, with the sphere that has waited first.
    let more = supply(&mut inlet, 1.1, &mut space);
    assert!(more.len() < spheres.len() / 4, "{}", more.len());
    assert!(more.first().is_none_or(|sphere| Some(sphere.radius) == waiting));
    let mut empty = self::space();
    let fresh = inlet.state().next_radius.unwrap();
    assert_eq!(supply(&mut inlet, 1.1, &mut empty)[0].radius, fresh);
}

#[test]
fn an_inlet_that_is_stopped_and_resumed_brings_in_the_same_spheres() {
    let make = || Inlet::new(plan(Amount::Mass(3.0), None), &Domain::unbounded()).unwrap();
    let (mut whole, mut stopped) = (make(), make());
    for step in 1..=50 {
        let time = f64::from(step) * 0.05;
        let state = stopped.state();
        stopped = make();
        stopped.set_state(&state);
        assert_eq!(supply(&mut whole, time, &mut space()), supply(&mut stopped, time, &mut space()));
    }
    assert!(whole.state().number > 50);
}

#[test]
fn points_of_regions_fill_them_evenly() {
    let mut random = random_stream(2);
    let centre = Vector3::new(1.0, -2.0, 0.5);
    let ends = [centre, centre + Vector3::new(1.0, 2.0, -2.0)];
    let regions = [Region::Sphere { centre, radius: 2.0 }, Region::Cylinder { ends, radius: 2.0 }];
    const COUNT: usize = 20_000;
    for region in regions {
        let points: Vec<Vector3> = (0..COUNT).map(|_| random_point(&region, &mut random)).collect();
        assert!(points.iter().all(|point| region.contains(*point, &Domain::unbounded())));
        let mean = |value: &dyn Fn(&Vector3) -> f64| points.iter().map(value).sum::<f64>() / COUNT as f64;
        // Mean squares of evenly filled bodies: 3/5 R^2 of a ball, R^2/2 about the axis of a cylinder, and its middle
        // at half its length. Four standard errors, which are below R^2/300.
        match region {
            Region::Sphere { centre, radius } => {
                let square = mean(&|point| (*point - centre).norm_squared());
                assert!((square - 0.6 * radius * radius).abs() < 0.05, "{square}");
            }
            Region::Cylinder { ends: [start, end], radius } => {
                let axis = (end - start).unit().unwrap();
                let square = mean(&|point| (*point - start).tangential_to(axis).norm_squared());
                assert!((square - 0.5 * radius * radius).abs() < 0.05, "{square}");
                let along = mean(&|point| (*point - start).dot(axis));
                assert!((along - 1.5).abs() < 0.03, "{along}");
            }
            _ => unreachable!(),
        }
    }
}

#[test]
fn regions_without_end_and_spheres_that_do_not_fit_are_refused() {
    let rate = Amount::Number(1.0);
    let layer = Region::Layer { axis: 2, lower: 0.0, upper: 1.0 };
    let unbounded = Inlet::new(InletPlan { region: layer, ..plan(rate, None) }, &Domain::unbounded());
    assert_eq!(unbounded.unwrap_err(), InvalidInlet::Unbounded);
    let ball = Region::Sphere { centre: Vector3::zero(), radius: 0.03 };
    let large = Inlet::new(InletPlan { region: ball, ..plan(rate, None) }, &Domain::unbounded());
    assert_eq!(large.unwrap_err(), InvalidInlet::TooLarge { radius: 0.04 });
    let radius = RadiusDistribution::Fixed { value: -1.0 };
    let wrong = Inlet::new(InletPlan { radius, ..plan(rate, None) }, &Domain::unbounded());
    assert!(matches!(wrong.unwrap_err(), InvalidInlet::Radius(_)));
}
