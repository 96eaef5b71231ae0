//! The legend, in the corner where it hides least.

use super::canvas::{Across, Along, Canvas, Setting, text_width};
use super::chart::SeriesStyle;
use super::draw::{CURVE, DASH, MARKER_INK, Panel, THICK, TICK_FONT, draw_line, draw_symbol};
use super::geometry::{Point, Rectangle};
use super::placing;
use crate::{Colour, IoError};
use plotters::prelude::DrawingBackend;

/// Height of a line, length of a sample, and room around the whole \[pt\].
const ROW: f64 = 16.0;
const SAMPLE: f64 = 26.0;
const PADDING: f64 = 6.0;

/// Distance from the frame \[pt\].
const MARGIN: f64 = 9.0;

/// So much of curves [places of `placing`] may lie below a legend before it moves out of the frame.
const BEARABLE: usize = 0;

/// Series with a label, and the size of the legend that shows them.
struct Extent {
    entries: Vec<usize>,
    width: f64,
    height: f64,
}

/// Width that a panel needs at its right for a legend that finds no free place inside, else zero \[pt\].
pub(super) fn width_outside(panel: &Panel<'_>) -> f64 {
    let extent = extent(panel);
    let crowded = extent.entries.len() > 1 && emptiest_place(panel, &extent).1 > BEARABLE;
    // A legend that takes half the picture is worse than a hidden piece of curve.
    let bearable = extent.width < 0.45 * panel.frame.width();
    if crowded && bearable { extent.width } else { 0.0 }
}

fn extent(panel: &Panel<'_>) -> Extent {
    let series = panel.chart.series.iter().enumerate();
    let entries: Vec<usize> =
        series.filter(|(_, series)| !series.label.is_empty()).map(|(number, _)| number).collect();
    let label = |&number: &usize| text_width(&panel.chart.series[number].label, TICK_FONT);
    let widest = entries.iter().map(label).fold(0.0, f64::max);
    let height = ROW * entries.len() as f64 + PADDING;
    Extent { entries, width: PADDING + SAMPLE + 6.0 + widest + PADDING, height }
}

/// Draws the labels of all series that have one.
pub(super) fn draw<DB: DrawingBackend>(canvas: &Canvas<DB>, panel: &Panel<'_>) -> Result<(), IoError> {
    let colours = panel.chart.colours();
    let extent = extent(panel);
    if extent.entries.is_empty() {
        return Ok(());
    }
    let (inside, hidden) = emptiest_place(panel, &extent);
    let outside = panel.room_right >= extent.width && hidden > BEARABLE;
    let place = if outside {
        let (left, top) = (panel.frame.right + 4.0, panel.frame.top);
        Rectangle { left, top, right: left + extent.width, bottom: top + extent.height }
    } else {
        inside
    };
    let Rectangle { left, top, right, bottom } = place;
    let corners = [(left, top), (right, top), (right, bottom), (left, bottom), (left, top), (right, top)];
    canvas.fill(&corners[..4], Colour::WHITE, 1.0)?;
    if !outside {
        // A box that hides the grid has to look like one.
        canvas.line(&corners, MARKER_INK, 0.5)?;
    }
    for (row, &number) in extent.entries.iter().enumerate() {
        let y = top + 0.5 * PADDING + ROW * (row as f64 + 0.5);
        let start = left + PADDING;
        let series = &panel.chart.series[number];
        let width = if series.thick { THICK } else { CURVE };
        draw_sample(canvas, (series.style, width), (start, y), colours[number])?;
        let (along, across) = (Along::Start, Across::Middle);
        let setting = Setting { size: TICK_FONT, colour: Colour::grey(0x22), along, across, upwards: false };
        canvas.text((start + SAMPLE + 6.0, y), &panel.chart.series[number].label, setting)?;
    }
    Ok(())
}

fn draw_sample<DB: DrawingBackend>(
    canvas: &Canvas<DB>,
    (style, width): (SeriesStyle, f64),
    (x, y): Point,
    number: usize,
) -> Result<(), IoError> {
    let colour = Colour::palette(number);
    match style {
        symbol if symbol.is_unconnected() => {
            draw_symbol(canvas, (x + 0.5 * SAMPLE, y), colour, (symbol, number))
        }
        SeriesStyle::Dashed => draw_line(canvas, &[(x, y), (x + SAMPLE, y)], (colour, CURVE), Some(DASH)),
        _ => draw_line(canvas, &[(x, y), (x + SAMPLE, y)], (colour, width), None),
    }
}

/// The corner (or middle of a side) whose rectangle hides least, and how much that is; among equals the first listed.
fn emptiest_place(panel: &Panel<'_>, extent: &Extent) -> (Rectangle, usize) {
    let frame = panel.frame;
    let mut places = placing::occupied(panel);
    let labels: Vec<Rectangle> = panel.marker_labels(&places).map(|(_, place, _)| place).collect();
    places.extend(labels.into_iter().flat_map(placing::spread));
    let (near_left, near_right) = (frame.left + MARGIN, frame.right - MARGIN - extent.width);
    let (near_top, near_bottom) = (frame.top + MARGIN, frame.bottom - MARGIN - extent.height);
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
    let judged = corners.map(|(left, top)| {
        let place = Rectangle { left, top, right: left + extent.width, bottom: top + extent.height };
        (place, placing::covered(&places, place))
    });
    judged.into_iter().min_by_key(|(_, hidden)| *hidden).unwrap_or(judged[0])
}
