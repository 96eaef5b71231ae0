//! What surrounds the curves of a panel: grid, ticks, labels, sections and notes.

use super::axis::Tick;
use super::canvas::{Across, Along, Canvas, Setting, text_width};
use super::draw::{FRAME, INK, LABEL_FONT, MARKER_INK, NOTE_FONT, Panel, TICK_FONT, TITLE_FONT};
use super::geometry::Rectangle;
use super::unit;
use crate::{Colour, IoError};
use plotters::prelude::DrawingBackend;

const GRID: f64 = 0.6;
const GRID_INK: Colour = Colour::grey(0xE4);
const NOTE_INK: Colour = Colour::new(0xA0, 0x10, 0x10);

/// Lengths of ticks, which point inwards \[pt\].
const TICK: f64 = 5.0;
const MINOR_TICK: f64 = 2.5;

/// Heights of a line of notes, and of the line of section names \[pt\].
const NOTE_ROW: f64 = 13.0;
const SECTION_ROW: f64 = 13.0;

/// More notes than this would leave no room for the curves.
const NOTES: usize = 4;

/// With fewer than one finite value in so many, a panel says that there is next to nothing to see.
const SPARSE: usize = 50;

/// Ticks of both axes, and the labels that their common powers of ten leave.
pub(super) struct Ticks {
    across: Vec<Tick>,
    upwards: Vec<Tick>,
    labels: [String; 2],
}

pub(super) fn vertical_room(height: f64) -> f64 {
    (height / 32.0).clamp(2.0, 9.0)
}

fn horizontal_room(width: f64) -> f64 {
    (width / 62.0).clamp(2.0, 12.0)
}

/// Room above the frame \[pt\].
pub(super) fn height_above(title: &str, sections: usize, notes: usize) -> f64 {
    let title = if title.is_empty() { 14.0 } else { 14.0 + TITLE_FONT + 6.0 };
    let sections = if sections == 0 { 0.0 } else { SECTION_ROW };
    title + sections + NOTE_ROW * notes.min(NOTES) as f64
}

impl Panel<'_> {
    pub(super) fn ticks(&self) -> Ticks {
        let (mut across, x_exponent) = self.x.ticks(horizontal_room(self.frame.width()));
        let (mut upwards, mut y_exponent) = self.y.ticks(vertical_room(self.frame.height()));
        if self.located()[0] == 0 {
            // Without a value there is no range that would mean something.
            (upwards, y_exponent) = (Vec::new(), 0);
            let mut points = self.chart.series.iter().flat_map(|series| &series.points);
            if !points.any(|&(x, _)| self.x.place(x).is_some()) {
                across = Vec::new();
            }
        }
        let labels =
            [unit::label(&self.chart.x.label, x_exponent), unit::label(&self.chart.y.label, y_exponent)];
        Ticks { across, upwards, labels }
    }

    pub(super) fn draw_grid<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        ticks: &Ticks,
    ) -> Result<(), IoError> {
        let frame = self.frame;
        for tick in ticks.across.iter().filter(|tick| !tick.label.is_empty()) {
            let x = frame.left + tick.place * frame.width();
            canvas.line(&[(x, frame.top), (x, frame.bottom)], GRID_INK, GRID)?;
        }
        for tick in ticks.upwards.iter().filter(|tick| !tick.label.is_empty()) {
            let y = frame.bottom - tick.place * frame.height();
            canvas.line(&[(frame.left, y), (frame.right, y)], GRID_INK, GRID)?;
        }
        Ok(())
    }

    /// A thin line where a section begins; its name above the frame, or its number where the name does not fit.
    pub(super) fn draw_sections<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let sections = &self.chart.sections;
        let place = |number: usize| sections.get(number).and_then(|(start, _)| self.x.place(*start));
        let setting = Setting {
            size: NOTE_FONT,
            colour: MARKER_INK,
            along: Along::Middle,
            across: Across::Bottom,
            upwards: false,
        };
        for (number, (_, name)) in sections.iter().enumerate() {
            let (start, end) = (place(number).unwrap_or(0.0), place(number + 1).unwrap_or(1.0));
            let at = |place: f64| self.frame.left + place.clamp(0.0, 1.0) * self.frame.width();
            let (left, right) = (at(start), at(end));
            if number > 0 && (0.0..=1.0).contains(&start) {
                canvas.line(&[(left, self.frame.top), (left, self.frame.bottom)], MARKER_INK, GRID)?;
            }
            let count = (number + 1).to_string();
            let fits = |text: &&str| text_width(text, NOTE_FONT) + 4.0 < right - left;
            if let Some(text) = [name.as_str(), count.as_str()].into_iter().find(fits) {
                canvas.text((0.5 * (left + right), self.frame.top - 3.0), text, setting)?;
            }
        }
        Ok(())
    }

    /// What the panel cannot show, between title and frame.
    pub(super) fn draw_notes<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let more = self.notes.len().saturating_sub(NOTES);
        let mut lines: Vec<String> = self.notes.iter().take(NOTES).cloned().collect();
        if let Some(last) = lines.last_mut().filter(|_| more > 0) {
            *last = format!("… and {} more notes", more + 1);
        }
        let sections = if self.chart.sections.is_empty() { 0.0 } else { SECTION_ROW };
        for (row, line) in lines.iter().rev().enumerate() {
            let y = self.frame.top - 4.0 - sections - NOTE_ROW * row as f64;
            let (along, across) = (Along::Middle, Across::Bottom);
            let setting = Setting { size: NOTE_FONT, colour: NOTE_INK, along, across, upwards: false };
            canvas.text((0.5 * (self.frame.left + self.frame.right), y), line, setting)?;
        }
        Ok(())
    }

    /// Says in words that there is nothing, or next to nothing, to see.
    pub(super) fn draw_emptiness<DB: DrawingBackend>(&self, canvas: &Canvas<DB>) -> Result<(), IoError> {
        let (text, colour) = match self.located() {
            [_, 0] => ("no data".to_owned(), MARKER_INK),
            [0, _] => ("no finite value to show".to_owned(), NOTE_INK),
            [located, all] if located < all / SPARSE => {
                (format!("only {located} of {all} values are finite"), NOTE_INK)
            }
            _ => return Ok(()),
        };
        let (along, across) = (Along::Middle, Across::Middle);
        let setting = Setting { size: TITLE_FONT, colour, along, across, upwards: false };
        let Rectangle { left, top, right, bottom } = self.frame;
        // Above the middle, where a zero line would cross it.
        canvas.text((0.5 * (left + right), top + 0.38 * (bottom - top)), &text, setting)
    }

    pub(super) fn draw_ticks<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        ticks: &Ticks,
    ) -> Result<(), IoError> {
        let Rectangle { left, top, right, bottom } = self.frame;
        let setting = |along, across| Setting { size: TICK_FONT, colour: INK, along, across, upwards: false };
        let length = |tick: &Tick| if tick.label.is_empty() { MINOR_TICK } else { TICK };
        for tick in &ticks.across {
            let x = left + tick.place * self.frame.width();
            canvas.line(&[(x, bottom), (x, bottom - length(tick))], INK, FRAME)?;
            canvas.line(&[(x, top), (x, top + length(tick))], INK, FRAME)?;
            canvas.text((x, bottom + 5.0), &tick.label, setting(Along::Middle, Across::Top))?;
        }
        for tick in &ticks.upwards {
            let y = bottom - tick.place * self.frame.height();
            canvas.line(&[(left, y), (left + length(tick), y)], INK, FRAME)?;
            canvas.line(&[(right, y), (right - length(tick), y)], INK, FRAME)?;
            canvas.text((left - 6.0, y), &tick.label, setting(Along::End, Across::Middle))?;
        }
        // Half a line beyond each corner, so that the corners are full.
        let over = 0.5 * FRAME;
        canvas.line(&[(left - over, bottom), (right + over, bottom)], INK, FRAME)?;
        canvas.line(&[(left - over, top), (right + over, top)], INK, FRAME)?;
        canvas.line(&[(left, top), (left, bottom)], INK, FRAME)?;
        canvas.line(&[(right, top), (right, bottom)], INK, FRAME)
    }

    pub(super) fn draw_labels<DB: DrawingBackend>(
        &self,
        canvas: &Canvas<DB>,
        ticks: &Ticks,
    ) -> Result<(), IoError> {
        let Rectangle { left, top, right, bottom } = self.frame;
        let (middle, height) = (0.5 * (left + right), 0.5 * (top + bottom));
        let setting =
            |size, across, upwards| Setting { size, colour: INK, along: Along::Middle, across, upwards };
        let [x_label, y_label] = &ticks.labels;
        let below = bottom + TICK_FONT + 10.0;
        canvas.text((middle, below), x_label, setting(LABEL_FONT, Across::Top, false))?;
        canvas.text((self.left + 8.0, height), y_label, setting(LABEL_FONT, Across::Top, true))?;
        let above = height_above("", self.chart.sections.len(), self.notes.len()) - 14.0;
        let title = setting(TITLE_FONT, Across::Bottom, false);
        canvas.text((middle, top - 5.0 - above), &self.chart.title, title)
    }
}
