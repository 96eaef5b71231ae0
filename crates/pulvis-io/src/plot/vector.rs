//! SVG: lines that stay sharp at any size.

use super::canvas::{Canvas, Stroke};
use super::figure::{Figure, PlotFormat};
use crate::{IoError, file};
use plotters::prelude::{IntoDrawingArea, SVGBackend};
use std::io::Write;
use std::path::Path;

/// The library writes whole numbers only; so fine a unit makes curves smooth all the same.
const UNITS_PER_POINT: u32 = 16;

/// Scalable vector graphics.
pub(super) const FORMAT: PlotFormat =
    PlotFormat { extension: "svg", summary: "lines and text, for papers and web pages", write };

fn write(figure: &Figure, path: &Path) -> Result<(), IoError> {
    let text = text(figure)?;
    file::replace(path, |out| out.write_all(text.as_bytes()))
}

/// The figure as SVG.
pub(super) fn text(figure: &Figure) -> Result<String, IoError> {
    let (width, height) = figure.size();
    let mut text = String::new();
    {
        let size = (width * UNITS_PER_POINT, height * UNITS_PER_POINT);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        let canvas = Canvas::new(area, f64::from(UNITS_PER_POINT), Stroke::Native);
        figure.draw(&canvas)?;
        canvas.finish()?;
    }
    // The size on the page is in points, not in the fine units, which the view box keeps. Joints are rounded.
    let (head, body) = text.split_once("viewBox").unwrap_or(("", &text));
    let head = if head.is_empty() {
        String::new()
    } else {
        format!("<svg width=\"{width}\" height=\"{height}\" stroke-linejoin=\"round\" viewBox")
    };
    Ok(head + &body.replace("font-family=\"sans-serif\"", "font-family=\"DejaVu Sans, Verdana, sans-serif\""))
}
