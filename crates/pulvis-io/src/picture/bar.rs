//! What the colours mean: a bar for a quantity, a list for classes.

use super::furniture::setting;
use super::scene::Scene;
use crate::plot::axis::Scale;
use crate::plot::canvas::{Across, Along, Canvas, text_width};
use crate::plot::{Axis, unit};
use crate::{Colour, IoError};
use plotters::prelude::BitMapBackend;

/// Width that the strip needs \[pixel\].
pub(super) fn width(scene: &Scene<'_>, font: f64) -> f64 {
    let widest = scene.classes.iter().map(|name| text_width(name, font)).fold(0.0, f64::max);
    if !scene.classes.is_empty() {
        widest + 3.6 * font
    } else if scene.bar_label.is_empty() {
        0.0
    } else {
        8.5 * font
    }
}

/// Draws bar or list into a strip of this height \[pixel\].
pub(super) fn draw(
    canvas: &Canvas<BitMapBackend<'_>>,
    scene: &Scene<'_>,
    range: [f64; 2],
    font: f64,
    height: f64,
) -> Result<(), IoError> {
    if scene.classes.is_empty() {
        draw_bar(canvas, scene, range, font, height)
    } else {
        draw_classes(canvas, scene, font, height)
    }
}

fn draw_classes(
    canvas: &Canvas<BitMapBackend<'_>>,
    scene: &Scene<'_>,
    font: f64,
    height: f64,
) -> Result<(), IoError> {
    let row = 1.8 * font;
    let top = (0.5 * (height - row * scene.classes.len() as f64)).max(0.0);
    for (number, name) in scene.classes.iter().enumerate() {
        let y = top + row * (number as f64 + 0.5);
        canvas.disc((1.2 * font, y), 0.55 * font, Colour::palette(number))?;
        canvas.text((2.2 * font, y), name, setting(scene, font, Along::Start, Across::Middle, false))?;
    }
    Ok(())
}

/// The bar in the middle half of the strip's height, with ticks and label.
fn draw_bar(
    canvas: &Canvas<BitMapBackend<'_>>,
    scene: &Scene<'_>,
    range: [f64; 2],
    font: f64,
    height: f64,
) -> Result<(), IoError> {
    let (left, right, top, bottom) = (0.6 * font, 1.8 * font, 0.2 * height, 0.8 * height);
    let steps = 128;
    for step in 0..steps {
        let edge = |step: i32| bottom + (top - bottom) * f64::from(step) / f64::from(steps);
        let (low, high) = (edge(step), edge(step + 1));
        let colour = scene.colours.at((f64::from(step) + 0.5) / f64::from(steps));
        canvas.fill(&[(left, low), (right, low), (right, high), (left, high)], colour, 1.0)?;
    }
    let frame = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top), (right, top)];
    canvas.line(&frame, scene.paper.ink(), 1.2)?;
    // Whole numbers, counts for example, have no ticks between them.
    let whole = scene.all_values().chain(range).all(|value| value.fract() == 0.0 || !value.is_finite());
    let room = if whole { (range[1] - range[0]).min(6.0) } else { 6.0 };
    let axis = Axis { range: Some(range), label: scene.bar_label.to_owned(), ..Axis::default() };
    let (ticks, exponent) = Scale::new(&axis, std::iter::empty()).ticks(room);
    let mut widest = 0.0_f64;
    for tick in &ticks {
        let y = bottom + (top - bottom) * tick.place;
        canvas.line(&[(right, y), (right + 0.35 * font, y)], scene.paper.ink(), 1.2)?;
        let place = (right + 0.6 * font, y);
        canvas.text(place, &tick.label, setting(scene, font, Along::Start, Across::Middle, false))?;
        widest = widest.max(text_width(&tick.label, font));
    }
    let label = unit::label(scene.bar_label, exponent);
    let x = right + 0.6 * font + widest + 0.5 * font;
    canvas.text((x, 0.5 * (top + bottom)), &label, setting(scene, font, Along::Middle, Across::Top, true))
}
