//! Renders a block of 20 000 spheres, to be looked at: `cargo run --release -p pulvis-io --example sample_picture -- <folder>`.
#![allow(clippy::print_stderr, clippy::disallowed_methods)]

use pulvis_io::picture::{OutlineBox, Scene, View, render};
use pulvis_io::{ColourMap, IoError};
use std::path::Path;
use std::time::Instant;

fn main() -> std::process::ExitCode {
    let Some(folder) = std::env::args_os().nth(1) else {
        eprintln!("usage: sample_picture <folder>");
        return std::process::ExitCode::from(2);
    };
    match draw(folder.as_ref()) {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

/// A heap on a grid with shaken places and sizes.
fn draw(folder: &Path) -> Result<(), IoError> {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut centres, mut radii, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for number in 0..20_000 {
        let place = [number % 32, number / 32 % 25, number / 800].map(|n| 2.0e-3 * (f64::from(n) + 0.5));
        let centre = place.map(|x| x + 6.0e-4 * (random() - 0.5));
        let slope = 0.052 - 0.55 * (centre[0] - 0.020).abs();
        if centre[2] < slope {
            values.push(0.3 * (centre[2] / 0.05).powi(2) + 0.02 * random());
            centres.push(centre);
            radii.push(1.0e-3 * (0.75 + 0.4 * random()));
        }
    }
    let scene = Scene {
        title: "Heap",
        bar_label: "speed [m/s]",
        edges: &OutlineBox { low: [0.0; 3], high: [0.064, 0.05, 0.055] }.edges(),
        scale_bar: true,
        ..Scene::new(&centres, &radii, &values)
    };
    let start = Instant::now();
    let heap = render(&scene, 2)?;
    eprintln!("{} spheres: {:.0} ms", centres.len(), 1.0e3 * start.elapsed().as_secs_f64());
    heap.write(&folder.join("heap.png"))?;
    let signed: Vec<f64> = centres.iter().map(|centre| 1.0e-5 * (centre[0] * 150.0).sin()).collect();
    let few = Scene {
        values: &signed[..800],
        centres: &centres[..800],
        radii: &radii[..800],
        colours: ColourMap::BlueRed,
        view: View::TOP,
        range: Some([-1.0e-5, 1.0e-5]),
        bar_label: "spin [rad/s]",
        title: "",
        width: 600,
        height: 500,
        ..scene
    };
    render(&few, 2)?.write(&folder.join("layer.png"))?;
    let (mut flown, classes) = (centres.clone(), [0.0, 1.0].repeat(centres.len() / 2 + 1));
    flown.iter_mut().step_by(40).for_each(|centre| *centre = centre.map(|x| 1.0e6 * x));
    flown.iter_mut().step_by(300).for_each(|centre| *centre = [f64::NAN; 3]);
    let exploded = Scene {
        centres: &flown,
        values: &classes[..centres.len()],
        classes: &["glass", "steel"],
        title: "Exploded",
        ..scene
    };
    render(&exploded, 2)?.write(&folder.join("exploded.png"))?;
    let far: Vec<[f64; 3]> = centres.iter().map(|centre| centre.map(|x| 1.0e6 * x)).collect();
    render(&Scene { centres: &far, edges: &[], ..scene }, 2)?.write(&folder.join("far.png"))?;
    let one = Scene { centres: &[[0.0; 3]], radii: &[1.0e-3], values: &[0.0], edges: &[], ..scene };
    render(&one, 2)?.write(&folder.join("one.png"))
}
