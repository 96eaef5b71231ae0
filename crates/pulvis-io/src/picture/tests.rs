#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use super::*;
use crate::{Colour, ColourMap};

/// Colour of a pixel of the rendered scene.
fn pixels(scene: &Scene<'_>) -> impl Fn(u32, u32) -> [u8; 3] + use<> {
    let picture = render(scene, 2).unwrap();
    move |x, y| {
        let place = 3 * (y * picture.width + x) as usize;
        [picture.pixels[place], picture.pixels[place + 1], picture.pixels[place + 2]]
    }
}

/// A shaken block of spheres, with values, tubes between neighbours and a box.
fn block(side: u32) -> (Vec<[f64; 3]>, Vec<f64>, Vec<f64>, Vec<Tube>) {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let centres: Vec<[f64; 3]> = (0..side.pow(3))
        .map(|n| [n % side, n / side % side, n / side.pow(2)].map(|n| f64::from(n) + 0.4 * random()))
        .collect();
    let radii = centres.iter().map(|_| 0.3 + 0.3 * random()).collect();
    let values = centres.iter().map(|centre| centre[2]).collect();
    let tube =
        |pair: &[[f64; 3]]| Tube { ends: [pair[0], pair[1]], radius: 0.1, paint: Paint::Value(pair[0][0]) };
    let tubes = centres.windows(2).map(tube).collect();
    (centres, radii, values, tubes)
}

#[test]
fn the_pixels_are_the_same_for_any_number_of_threads() {
    let (centres, radii, values, tubes) = block(6);
    let edges = OutlineBox { low: [-1.0; 3], high: [7.0; 3] }.edges();
    let scene = Scene {
        width: 301,
        height: 233,
        tubes: &tubes,
        edges: &edges,
        bar_label: "height [m]",
        ..Scene::new(&centres, &radii, &values)
    };
    let one = render(&scene, 1).unwrap();
    for threads in [2, 3, 8] {
        assert!(render(&scene, threads).unwrap() == one, "{threads} threads");
    }
}

#[test]
fn every_sample_shows_what_is_nearest() {
    // Against all shapes, without tiles, order and bounds.
    let (centres, radii, values, tubes) = block(5);
    for projection in [Projection::Perspective, Projection::Parallel] {
        let scene = Scene {
            width: 97,
            height: 75,
            tubes: &tubes,
            projection,
            ..Scene::new(&centres, &radii, &values)
        };
        let selection = Selection::of(&scene);
        let camera = Camera::fit(&scene, &selection);
        let shapes = collect(&scene, &selection, &camera, [0.0, 1.0]).shapes;
        let threads = ThreadPool::default();
        let buffer = DepthBuffer::draw(&shapes, &camera, [scene.width, scene.height], &threads);
        let mut seen = 0;
        for place in (0..buffer.depth.len()).step_by(7) {
            let [x, y] = [place % buffer.width, place / buffer.width]
                .map(|sample| (sample as f64 + 0.5) / depth::SAMPLES as f64);
            let ray = camera.ray(x, y);
            let nearest = shapes.iter().filter_map(|shape| shape.depth(&ray)).fold(f64::INFINITY, f64::min);
            assert_eq!(buffer.depth[place], nearest as f32, "{projection:?} {x} {y}");
            seen += usize::from(nearest.is_finite());
        }
        assert!(seen > 1000, "{seen}");
    }
}

#[test]
fn a_silhouette_has_the_projected_radius() {
    for projection in [Projection::Perspective, Projection::Parallel] {
        let (centres, radii) = ([[0.0; 3], [3.0, 0.0, 0.0]], [1.0, 0.5]);
        let scene = Scene {
            width: 900,
            height: 400,
            view: View::FRONT,
            projection,
            ..Scene::new(&centres, &radii, &[])
        };
        let picture = render(&scene, 2).unwrap();
        let camera = Camera::fit(&scene, &Selection::of(&scene));
        // Both lie in the plane of the target; a sphere in perspective covers the tangent of its half angle.
        let distance = camera.to_camera(Vector([0.0; 3])).0[2];
        let inked = |x: u32, y: u32| picture.pixels[3 * (y * 900 + x) as usize] < 250;
        let row: Vec<u32> = (0..900).filter(|&x| inked(x, 200)).collect();
        let gap = row.windows(2).position(|pair| pair[1] > pair[0] + 1).expect("a gap between the spheres");
        let widths = [gap + 1, row.len() - gap - 1].map(|width| width as f64 / camera.scale);
        for (width, radius, aside) in [(widths[0], 1.0, -1.25), (widths[1], 0.5, 1.75)] {
            // The middle of the scene lies at x = 1.25.
            let tangent = |angle: f64| distance * angle.tan();
            let (direction, half) =
                (f64::atan2(aside, distance), (radius / f64::hypot(aside, distance)).asin());
            let expected = match projection {
                Projection::Parallel => 2.0 * radius,
                Projection::Perspective => tangent(direction + half) - tangent(direction - half),
            };
            assert!(
                (width - expected).abs() < 1.5 / camera.scale,
                "{projection:?}: {width} for {expected} at {} pixels a metre",
                camera.scale
            );
        }
    }
}

#[test]
fn the_nearer_sphere_hides_the_farther() {
    let centres = [[0.0, 0.0, 0.0], [0.0, -3.0, 0.0]];
    let (radii, values) = ([1.0, 0.5], [0.0, 1.0]);
    let scene = Scene { view: View::FRONT, width: 200, height: 200, ..Scene::new(&centres, &radii, &values) };
    let at = pixels(&scene);
    let centre = at(100, 100);
    assert!(centre[0] > centre[2], "the small yellow sphere is in front: {centre:?}");
    let beside = at(40, 100);
    assert!(beside[2] > beside[1], "the large violet sphere shows beside it: {beside:?}");
    assert_eq!(at(2, 2), [255; 3], "the background is white");
    let behind = Scene { view: View { direction: [0.0, -1.0, 0.0], ..View::FRONT }, ..scene };
    let centre = pixels(&behind)(100, 100);
    assert!(centre[2] > centre[1], "seen from behind it is hidden: {centre:?}");
}

#[test]
fn a_tube_joins_its_ends_in_its_own_colour_on_any_paper() {
    let red = Colour::new(200, 0, 0);
    let tubes = [Tube { ends: [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]], radius: 0.2, paint: Paint::Plain(red) }];
    let limits = Some([[-1.0; 3], [1.0; 3]]);
    for (paper, ground) in [(Paper::White, 255), (Paper::Black, 0x16)] {
        let view = View::FRONT;
        let scene = Scene {
            width: 200,
            height: 200,
            tubes: &tubes,
            limits,
            paper,
            view,
            ..Scene::new(&[], &[], &[])
        };
        let at = pixels(&scene);
        for x in [30, 100, 170] {
            let [red, green, blue] = at(x, 100);
            assert!(red > 100 && red / 2 > green.max(blue), "{:?}", at(x, 100));
        }
        assert_eq!(at(100, 60), [ground; 3]);
    }
}

#[test]
fn strange_scenes_are_drawn_without_panic() {
    let nan = f64::NAN;
    let centres = [[nan, 0.0, 0.0], [0.0; 3], [1.0, 0.0, f64::INFINITY], [1.0e200, 0.0, 0.0]];
    let radii = [1.0, 1.0, 1.0, -1.0];
    let values = [0.0, nan, f64::INFINITY, 1.0];
    let upright = View { direction: [0.0, 0.0, 1.0], up: [0.0, 0.0, 5.0] };
    let nowhere = View { direction: [0.0; 3], up: [nan; 3] };
    let broken = Tube { ends: [[nan; 3], [0.0; 3]], radius: 1.0, paint: Paint::Value(nan) };
    let point = Tube { ends: [[0.0; 3]; 2], radius: 1.0, paint: Paint::Value(nan) };
    for (view, projection) in [
        (View::OBLIQUE, Projection::Perspective),
        (upright, Projection::Parallel),
        (nowhere, Projection::Perspective),
    ] {
        let edges = [[[nan; 3], [1.0; 3]]];
        let small = Scene {
            width: 64,
            height: 64,
            bar_label: "v",
            title: "t",
            caption: "c",
            view,
            projection,
            edges: &edges,
            tubes: &[broken, point],
            ..Scene::new(&centres, &radii, &values)
        };
        let _ = pixels(&small);
        let _ = pixels(&Scene { centres: &[], radii: &[], values: &[], ..small });
        let _ = pixels(&Scene { classes: &["a", "b"], scale_bar: true, width: 300, ..small });
        let _ = pixels(&Scene { limits: Some([[0.0; 3]; 2]), ..small });
        let _ = pixels(&Scene { limits: Some([[nan; 3]; 2]), ..small });
    }
}

/// Pixels in the colour of notes.
fn note_pixels(scene: &Scene<'_>) -> usize {
    let at = pixels(scene);
    let all = (0..scene.height).flat_map(|y| (0..scene.width).map(move |x| (x, y)));
    all.filter(|&(x, y)| at(x, y)[0] > at(x, y)[1].saturating_add(90)).count()
}

#[test]
fn an_exploded_packing_is_drawn_with_a_note_and_not_as_a_blank_sheet() {
    let flown = |n: u32| [1.0e6 * f64::from(n % 7), 1.0e5 * f64::from(n), 0.0];
    let centres: Vec<[f64; 3]> = (0..60).map(flown).collect();
    let (radii, values) = (vec![1.0; 60], vec![0.0; 60]);
    let scene = Scene { width: 300, height: 300, ..Scene::new(&centres, &radii, &values) };
    let at = pixels(&scene);
    let inked = (0..200).flat_map(|y| (0..300).map(move |x| (x, y))).filter(|&(x, y)| at(x, y) != [255; 3]);
    assert!(inked.count() > 60, "dots where the particles are");
    assert!(note_pixels(&scene) > 50, "and a note that they are enlarged");
    let nowhere = vec![[f64::NAN; 3]; 60];
    assert!(note_pixels(&Scene { centres: &nowhere, ..scene }) > 50);
    let sound: Vec<[f64; 3]> = (0..60).map(|n| [2.0 * f64::from(n), 0.0, 0.0]).collect();
    assert_eq!(note_pixels(&Scene { centres: &sound, ..scene }), 0);
}

#[test]
fn a_picture_is_written_as_it_is_and_shows_the_ends_of_its_bar() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    let scene = Scene {
        width: 300,
        height: 200,
        bar_label: "speed [m/s]",
        ..Scene::new(&[[0.0; 3], [2.0, 0.0, 0.0]], &[1.0; 2], &[1.0, 3.0])
    };
    let picture = render(&scene, 1).unwrap();
    picture.write(&path).unwrap();
    let read = raster::Decoded::open(&path).unwrap();
    assert_eq!(read.pixels.as_flattened(), picture.pixels());
    // From bottom to top the bar goes through the colours; the pixels beside its ends are mixed with the frame.
    for share in [0.02, 0.5, 0.98] {
        let Colour { red, green, blue } = ColourMap::Viridis.at(share);
        let near = |pixel: &[u8; 3]| pixel.iter().zip([red, green, blue]).all(|(&a, b)| a.abs_diff(b) < 6);
        assert!(read.pixels.iter().any(near), "{share}");
    }
}

#[test]
fn unequal_columns_and_other_endings_are_refused() {
    let scene = Scene::new(&[[0.0; 3]], &[], &[0.0]);
    assert!(matches!(render(&scene, 1), Err(IoError::ColumnLength { .. })));
    let scene = Scene::new(&[], &[], &[]);
    let picture = render(&Scene { width: 64, height: 64, ..scene }, 1).unwrap();
    assert!(matches!(picture.write(Path::new("a.gif")), Err(IoError::UnknownFormat { .. })));
    assert!(matches!(render(&Scene { width: 0, ..scene }, 1), Err(IoError::PictureSize { .. })));
}
