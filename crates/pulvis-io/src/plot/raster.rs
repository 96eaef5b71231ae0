//! PNG: drawn several times too large, then averaged, which smooths the edges.

use super::canvas::{Canvas, Stroke};
use super::figure::{Figure, PlotFormat};
use crate::{IoError, file};
use plotters::prelude::{BitMapBackend, IntoDrawingArea};
use png::{BitDepth, ColorType, Compression, Encoder, PixelDimensions, Unit};
use std::io::{self, Write};
use std::path::Path;

/// Pixels to the inch unless told otherwise, two to a point: sharp on paper and on dense screens.
pub(crate) const DPI: u32 = 144;

/// Points to the inch.
const POINTS: f64 = 72.0;

/// Drawn pixels per pixel of the file, in each direction. Fine pixels need less smoothing, and would take much memory.
fn oversampling(dpi: u32) -> u32 {
    match dpi {
        ..=200 => 3,
        201..=400 => 2,
        _ => 1,
    }
}

/// Portable network graphics.
pub(super) const FORMAT: PlotFormat =
    PlotFormat { extension: "png", summary: "pixels, for slides and web pages", write };

fn write(figure: &Figure, path: &Path) -> Result<(), IoError> {
    let (dpi, times) = (figure.resolution(), oversampling(figure.resolution()));
    let scale = f64::from(dpi) / POINTS;
    let (width, height) = figure.size();
    let [width, height] = [width, height].map(|side| (f64::from(side) * scale).round() as u32);
    let (wide, high) = (width * times, height * times);
    let mut large = vec![255_u8; 3 * wide as usize * high as usize];
    {
        let area = BitMapBackend::with_buffer(&mut large, (wide, high)).into_drawing_area();
        figure.draw(&Canvas::new(area, scale * f64::from(times), Stroke::Filled))?;
    }
    let pixels = average(&large, wide as usize, times as usize);
    file::replace(path, |out| encode(out, &pixels, [width, height], dpi))
}

/// Writes pixels (red, green, blue) as PNG, with their number to the inch.
pub(crate) fn encode(
    out: &mut impl Write,
    pixels: &[u8],
    [width, height]: [u32; 2],
    dpi: u32,
) -> io::Result<()> {
    let mut encoder = Encoder::new(out, width, height);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    // Pixels per metre on paper, so that fonts come out in the sizes that were asked for.
    let per_metre = (f64::from(dpi) / 0.0254).round() as u32;
    let (xppu, yppu) = (per_metre, per_metre);
    encoder.set_pixel_dims(Some(PixelDimensions { xppu, yppu, unit: Unit::Meter }));
    let mut writer = encoder.write_header().map_err(io::Error::other)?;
    writer.write_image_data(pixels).map_err(io::Error::other)?;
    writer.finish().map_err(io::Error::other)
}

/// Averages squares of `times` by `times` pixels of an image `wide` pixels wide.
pub(crate) fn average(large: &[u8], wide: usize, times: usize) -> Vec<u8> {
    let width = wide / times;
    let mut small = Vec::with_capacity(large.len() / (times * times));
    let mut sums = vec![0_u32; 3 * width];
    for rows in large.chunks_exact(3 * wide * times) {
        sums.fill(0);
        for row in rows.chunks_exact(3 * wide) {
            for (sum, square) in sums.chunks_exact_mut(3).zip(row.chunks_exact(3 * times)) {
                for pixel in square.chunks_exact(3) {
                    sum.iter_mut().zip(pixel).for_each(|(sum, &part)| *sum += u32::from(part));
                }
            }
        }
        let count = (times * times) as u32;
        small.extend(sums.iter().map(|sum| ((sum + count / 2) / count) as u8));
    }
    small
}

/// A picture as it stands in a file, for tests.
#[cfg(test)]
pub(crate) struct Decoded {
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// Red, green and blue of the pixels, row by row.
    pub(crate) pixels: Vec<[u8; 3]>,
}

#[cfg(test)]
impl Decoded {
    pub(crate) fn open(path: &std::path::Path) -> Result<Self, Box<dyn std::error::Error>> {
        let file = std::io::BufReader::new(std::fs::File::open(path)?);
        let mut reader = png::Decoder::new(file).read_info()?;
        let mut bytes = vec![0; reader.output_buffer_size().ok_or("the picture is too large")?];
        let info = reader.next_frame(&mut bytes)?;
        if (info.color_type, info.bit_depth) != (ColorType::Rgb, BitDepth::Eight) {
            return Err(format!("expected 8 bits of red, green and blue, found {info:?}").into());
        }
        let pixels = bytes.chunks_exact(3).map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        Ok(Self { width: info.width, height: info.height, pixels })
    }

    pub(crate) fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        self.pixels[(y * self.width + x) as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averaging_keeps_what_is_even_and_halves_what_is_half() {
        // Two rows of four pixels: left half black and white in turn, right half grey.
        let row = [[0; 3], [255; 3], [9; 3], [9; 3]];
        let large: Vec<u8> = [row, row].as_flattened().as_flattened().to_vec();
        assert_eq!(average(&large, 4, 2), [128, 128, 128, 9, 9, 9]);
    }
}
