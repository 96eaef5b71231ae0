//! Title and colour bar.

use super::SphereScene;
use crate::plot::axis::Scale;
use crate::plot::canvas::{Across, Along, Canvas, Setting, Stroke, text_width};
use crate::plot::{Axis, raster, unit};
use crate::{Colour, IoError};
use plotters::prelude::{BitMapBackend, IntoDrawingArea};

const INK: Colour = Colour::grey(0x22);

/// Drawn pixels per pixel of the picture, for smooth edges.
const OVERSAMPLING: u32 = 3;

/// Lengths that depend on the size of the picture \[pixel\].
struct Layout {
    font: f64,
    margin: f64,
    /// Left end and width of the strip that holds the colour bar.
    strip: [f64; 2],
    /// Height of the strip that holds the title.
    title: f64,
}

fn layout(scene: &SphereScene<'_>) -> Layout {
    let (width, height) = (f64::from(scene.width), f64::from(scene.height));
    let font = (0.024 * width.min(height)).max(9.0);
    let margin = 0.03 * width.min(height);
    let strip = if scene.bar_label.is_empty() { 0.0 } else { (8.5 * font).min(0.4 * width).round() };
    let title = if scene.title.is_empty() { 0.0 } else { (2.4 * font).round() };
    Layout { font, margin, strip: [width - strip, strip], title }
}

/// Left, top, width and height of the part of the picture left for the spheres \[pixel\].
pub(super) fn free_area(scene: &SphereScene<'_>) -> [f64; 4] {
    let Layout { margin, strip: [right, _], title, .. } = layout(scene);
    let height = f64::from(scene.height) - title;
    [margin, title + margin, (right - 2.0 * margin).max(1.0), (height - 2.0 * margin).max(1.0)]
}

/// Draws title and colour bar over the margins of the picture.
pub(super) fn draw(pixels: &mut [u8], scene: &SphereScene<'_>, range: [f64; 2]) -> Result<(), IoError> {
    let Layout { title, strip: [_, strip], .. } = layout(scene);
    if title > 0.0 {
        let setting = |size| setting(size * 1.25, Along::Middle, Across::Middle, false);
        overlay(pixels, scene, [0, 0, scene.width, title as u32], |canvas, layout| {
            canvas.text(
                (0.5 * f64::from(scene.width), 0.62 * layout.title),
                scene.title,
                setting(layout.font),
            )
        })?;
    }
    if strip > 0.0 {
        let strip = (strip as u32).min(scene.width);
        let area = [scene.width - strip, title as u32, strip, scene.height - title as u32];
        overlay(pixels, scene, area, |canvas, layout| {
            draw_bar(canvas, scene, range, layout.font, f64::from(scene.height) - layout.title)
        })?;
    }
    Ok(())
}

/// Draws into a white rectangle (left, top, width, height) of the picture, smoothed.
fn overlay(
    pixels: &mut [u8],
    scene: &SphereScene<'_>,
    [left, top, width, height]: [u32; 4],
    draw: impl FnOnce(&Canvas<BitMapBackend<'_>>, &Layout) -> Result<(), IoError>,
) -> Result<(), IoError> {
    let (wide, high) = (width * OVERSAMPLING, height * OVERSAMPLING);
    let mut large = vec![255_u8; 3 * wide as usize * high as usize];
    {
        let area = BitMapBackend::with_buffer(&mut large, (wide, high)).into_drawing_area();
        draw(&Canvas::new(area, f64::from(OVERSAMPLING), Stroke::Filled), &layout(scene))?;
    }
    let small = raster::average(&large, wide as usize, OVERSAMPLING as usize);
    let row = 3 * scene.width as usize;
    let rows = pixels.chunks_exact_mut(row).skip(top as usize);
    for (target, source) in rows.zip(small.chunks_exact(3 * width as usize)) {
        let start = 3 * left as usize;
        target[start..start + source.len()].copy_from_slice(source);
    }
    Ok(())
}

/// The bar in the middle half of the strip's height, with ticks and label.
fn draw_bar(
    canvas: &Canvas<BitMapBackend<'_>>,
    scene: &SphereScene<'_>,
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
    canvas.line(&frame, INK, 1.2)?;
    let axis = Axis { range: Some(range), label: scene.bar_label.to_owned(), ..Axis::default() };
    let (ticks, exponent) = Scale::new(&axis, std::iter::empty()).ticks(6.0);
    let mut widest = 0.0_f64;
    for tick in &ticks {
        let y = bottom + (top - bottom) * tick.place;
        canvas.line(&[(right, y), (right + 0.35 * font, y)], INK, 1.2)?;
        let place = (right + 0.6 * font, y);
        canvas.text(place, &tick.label, setting(font, Along::Start, Across::Middle, false))?;
        widest = widest.max(text_width(&tick.label, font));
    }
    let label = unit::label(scene.bar_label, exponent);
    let x = right + 0.6 * font + widest + 0.5 * font;
    canvas.text((x, 0.5 * (top + bottom)), &label, setting(font, Along::Middle, Across::Top, true))
}

fn setting(size: f64, along: Along, across: Across, upwards: bool) -> Setting {
    Setting { size, colour: INK, along, across, upwards }
}
