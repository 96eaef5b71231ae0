//! What surrounds the spheres: title, colour bar, scale bar and notes.

use super::bar;
use super::camera::Camera;
use super::scene::Scene;
use super::selection::Selection;
use crate::plot::canvas::{Across, Along, Canvas, Setting, Stroke};
use crate::plot::{raster, unit};
use crate::{Colour, IoError};
use plotters::prelude::{BitMapBackend, IntoDrawingArea};

/// Drawn pixels per pixel of the picture, for smooth edges.
const OVERSAMPLING: u32 = 3;

/// Height of a line of text, in heights of the font.
const LINE: f64 = 1.6;

/// Lengths that depend on the size of the picture \[pixel\].
struct Layout {
    font: f64,
    margin: f64,
    /// Left end and width of the strip that holds the colour bar.
    strip: [f64; 2],
    /// Height of the strip that holds the title.
    title: f64,
    /// Height of the strip that holds caption, notes and scale bar.
    foot: f64,
}

fn layout(scene: &Scene<'_>, notes: usize) -> Layout {
    let (width, height) = (f64::from(scene.width), f64::from(scene.height));
    let font = (0.024 * width.min(height)).max(9.0);
    let margin = 0.03 * width.min(height);
    let strip = bar::width(scene, font).min(0.4 * width).round();
    let title = if scene.title.is_empty() { 0.0 } else { (2.4 * font).round() };
    let scale_bar = if scene.scale_bar { 2.6 * font } else { 0.0 };
    let lines = notes + usize::from(!scene.caption.is_empty());
    let foot = (scale_bar + LINE * font * lines as f64).min(0.4 * height).round();
    Layout { font, margin, strip: [width - strip, strip], title, foot }
}

/// Left, top, width and height of the part of the picture left for the spheres \[pixel\].
pub(super) fn free_area(scene: &Scene<'_>, selection: &Selection) -> [f64; 4] {
    let Layout { margin, strip: [right, _], title, foot, .. } = layout(scene, selection.notes(scene).len());
    let height = f64::from(scene.height) - title - foot;
    [margin, title + margin, (right - 2.0 * margin).max(1.0), (height - 2.0 * margin).max(1.0)]
}

/// Draws everything over the margins of the picture.
pub(super) fn draw(
    pixels: &mut [u8],
    scene: &Scene<'_>,
    selection: &Selection,
    camera: &Camera,
    range: [f64; 2],
) -> Result<(), IoError> {
    let notes = selection.notes(scene);
    let Layout { font, margin, title, foot, strip: [left, strip] } = layout(scene, notes.len());
    let middle = 0.5 * left;
    if title > 0.0 {
        let setting = setting(scene, 1.25 * font, Along::Middle, Across::Middle, false);
        overlay(pixels, scene, [0, 0, scene.width, title as u32], |canvas| {
            canvas.text((0.5 * f64::from(scene.width), 0.62 * title), scene.title, setting)
        })?;
    }
    let anything = selection.count() > 0 || !scene.tubes.is_empty() || !scene.all_edges().is_empty();
    if strip > 0.0 && (selection.count() > 0 || !scene.tubes.is_empty()) {
        let height = f64::from(scene.height) - title;
        let area = [scene.width - strip as u32, title as u32, strip as u32, height as u32];
        overlay(pixels, scene, area, |canvas| bar::draw(canvas, scene, range, font, height))?;
    }
    if foot > 0.0 {
        overlay(pixels, scene, [0, scene.height - foot as u32, left as u32, foot as u32], |canvas| {
            let own = setting(scene, font, Along::Middle, Across::Middle, false);
            let caption = (!scene.caption.is_empty()).then_some((scene.caption, own.colour));
            let notes = notes.iter().map(|note| (note.as_str(), scene.paper.note_ink()));
            for (row, (text, colour)) in caption.into_iter().chain(notes).enumerate() {
                let place = (middle, LINE * font * (row as f64 + 0.5));
                canvas.text(place, text, Setting { colour, ..own })?;
            }
            if scene.scale_bar && anything {
                draw_scale_bar(canvas, scene, camera, font, [margin, left, foot])
            } else {
                Ok(())
            }
        })?;
    }
    if !anything {
        let [x, y, width, height] = free_area(scene, selection).map(|length| length as u32);
        overlay(pixels, scene, [x, y, width, height], |canvas| {
            let setting = setting(scene, 1.25 * font, Along::Middle, Across::Middle, false);
            canvas.text((0.5 * f64::from(width), 0.5 * f64::from(height)), "no particle to show", setting)
        })?;
    }
    Ok(())
}

/// A bar of a round length, at most a quarter of the picture, at the left of the foot: as long as that length is in the
/// middle of the scene.
fn draw_scale_bar(
    canvas: &Canvas<BitMapBackend<'_>>,
    scene: &Scene<'_>,
    camera: &Camera,
    font: f64,
    [margin, width, foot]: [f64; 3],
) -> Result<(), IoError> {
    let most = 0.25 * width / camera.scale;
    let power = 10_f64.powi(most.log10().floor() as i32);
    let length = [5.0, 2.0, 1.0].map(|factor| factor * power).into_iter().find(|&length| length <= most);
    let Some(length) = length else { return Ok(()) };
    let (left, y) = (margin + font, foot - 0.8 * font);
    let right = left + length * camera.scale;
    for line in [[(left, y), (right, y)], [left; 2].map(|x| (x, y)), [right; 2].map(|x| (x, y))] {
        let [from, to] = line;
        let tick = if from == to { 0.3 * font } else { 0.0 };
        canvas.line(&[(from.0, from.1 - tick), (to.0, to.1 + tick)], scene.paper.ink(), 0.12 * font)?;
    }
    let label = unit::amount("length [m]", length);
    let above = (0.5 * (left + right), y - 0.4 * font);
    canvas.text(above, &label, setting(scene, font, Along::Middle, Across::Bottom, false))
}

/// Draws into an empty rectangle (left, top, width, height) of the picture, smoothed.
fn overlay(
    pixels: &mut [u8],
    scene: &Scene<'_>,
    [left, top, width, height]: [u32; 4],
    draw: impl FnOnce(&Canvas<BitMapBackend<'_>>) -> Result<(), IoError>,
) -> Result<(), IoError> {
    let (wide, high) = (width * OVERSAMPLING, height * OVERSAMPLING);
    let Colour { red, green, blue } = scene.paper.ground();
    let mut large = [red, green, blue].repeat(wide as usize * high as usize);
    {
        let area = BitMapBackend::with_buffer(&mut large, (wide, high)).into_drawing_area();
        draw(&Canvas::new(area, f64::from(OVERSAMPLING), Stroke::Filled))?;
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

pub(super) fn setting(scene: &Scene<'_>, size: f64, along: Along, across: Across, upwards: bool) -> Setting {
    Setting { size, colour: scene.paper.ink(), along, across, upwards }
}
