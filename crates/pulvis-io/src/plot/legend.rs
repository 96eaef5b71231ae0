//! The legend, in the corner where it hides least.

use super::canvas::{Across, Along, Canvas, Setting, text_width};
use super::chart::SeriesStyle;
use super::draw::{CURVE, DASH, Panel, TICK_FONT, draw_symbol};
use super::geometry::{Point, Rectangle, dashes};
use crate::{Colour, IoError};
use plotters::prelude::DrawingBackend;

/// Height of a line, length of a sample, and room around the whole [pt].
const ROW: f64 = 16.0;
const SAMPLE: f64 = 26.0;
const PADDING: f64 = 6.0;

/// Distance from the frame [pt].
const MARGIN: f64 = 9.0;

/// Draws the labels of all series that have one.
pub(super) fn draw<DB: DrawingBackend>(canvas: &Canvas<DB>, panel: &Panel<'_>) -> Result<(), IoError> {
    let colours = panel.chart.colours();
    let entries: Vec<usize> =
        (0..colours.len()).filter(|&number| !panel.chart.series[number].label.is_empty()).collect();
    if entries.is_empty() {
        return Ok(());
    }
    let label = |number: usize| panel.chart.series[number].label.as_str();
    let widest = entries.iter().map(|&number| text_width(label(number), TICK_FONT)).fold(0.0, f64::max);
    let width = PADDING + SAMPLE + 6.0 + widest + PADDING;
    let place = emptiest_corner(panel, width, ROW * entries.len() as f64 + PADDING);
    let Rectangle { left, top, right, bottom } = place;
    canvas.fill(&[(left, top), (right, top), (right, bottom), (left, bottom)], Colour::WHITE, 0.85)?;
    for (row, &number) in entries.iter().enumerate() {
        let y = top + 0.5 * PADDING + ROW * (row as f64 + 0.5);
        let start = left + PADDING;
        draw_sample(canvas, panel.chart.series[number].style, (start, y), colours[number])?;
        let (along, across) = (Along::Start, Across::Middle);
        let setting = Setting { size: TICK_FONT, colour: Colour::grey(0x22), along, across, upwards: false };
        canvas.text((start + SAMPLE + 6.0, y), label(number), setting)?;
    }
    Ok(())
}

fn draw_sample<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    style: SeriesStyle,
    (x, y): Point,
    number: usize,
) -> Result<(), IoError> {
    let colour = Colour::palette(number);
    let line = [(x, y), (x + SAMPLE, y)];
    match style {
        SeriesStyle::Line => canvas.line(&line, colour, CURVE),
        SeriesStyle::Dashed => {
            dashes(&line, DASH.0, DASH.1).iter().try_for_each(|dash| canvas.line(dash, colour, CURVE))
        }
        SeriesStyle::Points => draw_symbol(canvas, (x + 0.5 * SAMPLE, y), colour, number),
    }
}

/// The corner (or middle of a side) whose rectangle covers the shortest piece of curves, the fewest symbols and no
/// marker label; among equals the first listed.
fn emptiest_corner(panel: &Panel<'_>, width: f64, height: f64) -> Rectangle {
    let frame = panel.frame;
    let places = occupied(panel);
    let (near_left, near_right) = (frame.left + MARGIN, frame.right - MARGIN - width);
    let (near_top, near_bottom) = (frame.top + MARGIN, frame.bottom - MARGIN - height);
    let (middle_x, middle_y) = (0.5 * (near_left + near_right), 0.5 * (near_top + near_bottom));
    let corners = [
        (near_right, near_top),
        (near_left, near_top),
        (near_right, near_bottom),
        (near_left, near_bottom),
        (near_right, middle_y),
        (near_left, middle_y),
        (middle_x, near_top),
        (middle_x, near_bottom),
    ];
    let rectangle = |(left, top): Point| Rectangle { left, top, right: left + width, bottom: top + height };
    let covered = |corner: &Point| {
        let place = rectangle(*corner);
        places.iter().filter(|&&point| place.contains(point)).count()
    };
    rectangle(corners.iter().min_by_key(|corner| covered(corner)).copied().unwrap_or(corners[0]))
}

/// Points every few units along all curves, and all symbols and marker labels (which weigh more).
fn occupied(panel: &Panel<'_>) -> Vec<Point> {
    const STEP: f64 = 3.0;
    let mut places = Vec::new();
    for (number, series) in panel.chart.series.iter().enumerate() {
        if series.style == SeriesStyle::Points {
            places.extend(panel.symbols(number).flat_map(|symbol| [symbol; 3]));
            continue;
        }
        for piece in panel.pieces(number) {
            places.extend(dashes(&piece, STEP, STEP).into_iter().flatten());
        }
    }
    for (x, top, length) in panel.marker_labels() {
        let steps = (length / STEP).ceil() as usize;
        places.extend((0..=steps).flat_map(|step| [(x, top + STEP * step as f64); 2]));
    }
    places
}
