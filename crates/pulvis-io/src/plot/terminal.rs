//! Charts as text for terminals: curves in Braille dots, or in letters where no colour can tell them apart.

use super::axis::{Scale, Tick};
use super::bounds::vertical_scale;
use super::chart::{Chart, Series};
use super::unit;

/// Colours of the terminal's own palette, so that they fit its ground: blue, yellow, green, red, magenta, cyan.
const COLOURS: [u8; 6] = [34, 33, 32, 31, 35, 36];

/// Dots of a character: two columns, four rows.
const DOTS: [usize; 2] = [2, 4];

/// The bit of each dot in the Braille block of Unicode, row by row.
const BITS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

/// Fewest characters of the field of curves.
const LEAST: [usize; 2] = [20, 5];

impl Chart {
    /// The chart as lines of text, `columns` wide and `rows` high, of which labels take a part. With `colours`, each curve has
    /// its own by the escape sequences of terminals; without, several curves are drawn in letters.
    pub fn to_text(&self, columns: usize, rows: usize, colours: bool) -> String {
        let points = || self.series.iter().flat_map(|series| series.points.iter().copied());
        let (x, y) = (Scale::new(&self.x, points().map(|(x, _)| x)), vertical_scale(self));
        let height = rows.saturating_sub(4 + usize::from(!self.title.is_empty())).max(LEAST[1]);
        let (y_ticks, y_exponent) = y.ticks((height as f64 / 3.0).max(2.0));
        let margin = y_ticks.iter().map(|tick| tick.label.chars().count()).max().unwrap_or(0);
        let width = columns.saturating_sub(margin + 2).max(LEAST[0]);
        let (x_ticks, x_exponent) = x.ticks((width as f64 / 12.0).max(2.0));
        let mut field = Field::new(width, height);
        for (number, series) in self.series.iter().enumerate() {
            field.draw(series, number, &x, &y);
        }
        let letters = !colours && self.series.len() > 1;
        let mut text = String::new();
        for line in [
            self.title.clone(),
            unit::label(&self.y.label, y_exponent).trim().to_owned(),
            self.legend(colours, letters),
        ] {
            if !line.is_empty() {
                text += &format!("{line}\n");
            }
        }
        if !field.has_dots() {
            text += "(no finite value)\n";
        }
        for row in 0..height {
            let tick = y_ticks.iter().find(|tick| row_of(tick, height) == row);
            let (label, edge) = tick.map_or(("", '│'), |tick| (tick.label.as_str(), '┤'));
            text += &format!("{label:>margin$} {edge}{}\n", field.line(row, colours, letters));
        }
        let blank = " ".repeat(margin + 1);
        text += &format!("{blank}└{}\n", edge_below(&x_ticks, width));
        text += &format!("{blank} {}\n", labels_below(&x_ticks, width));
        let label = unit::label(&self.x.label, x_exponent);
        text + format!("{blank} {label:^width$}").trim_end() + "\n"
    }

    fn legend(&self, colours: bool, letters: bool) -> String {
        let named = self.series.iter().enumerate().filter(|(_, series)| !series.label.is_empty());
        let entry = |(number, series): (usize, &Series)| match (colours, letters) {
            (true, _) => format!("\x1b[{}m──\x1b[0m {}", colour(number), series.label),
            (false, true) => format!("{} {}", letter(number), series.label),
            (false, false) => series.label.clone(),
        };
        named.map(entry).collect::<Vec<_>>().join("   ")
    }
}

fn colour(series: usize) -> u8 {
    COLOURS[series % COLOURS.len()]
}

fn letter(series: usize) -> char {
    char::from(b'a' + (series % 26) as u8)
}

/// The row of a tick of the vertical axis.
fn row_of(tick: &Tick, height: usize) -> usize {
    (((1.0 - tick.place.clamp(0.0, 1.0)) * height as f64) as usize).min(height - 1)
}

/// The column of a tick of the horizontal axis.
fn column_of(tick: &Tick, width: usize) -> usize {
    ((tick.place.clamp(0.0, 1.0) * width as f64) as usize).min(width - 1)
}

fn edge_below(ticks: &[Tick], width: usize) -> String {
    let marked: Vec<usize> =
        ticks.iter().filter(|tick| !tick.label.is_empty()).map(|tick| column_of(tick, width)).collect();
    (0..width).map(|column| if marked.contains(&column) { '┬' } else { '─' }).collect()
}

/// Labels centred below their ticks, as far as they leave a blank between each other.
fn labels_below(ticks: &[Tick], width: usize) -> String {
    let mut line = String::new();
    for tick in ticks.iter().filter(|tick| !tick.label.is_empty()) {
        let (used, length) = (line.chars().count(), tick.label.chars().count());
        let start = column_of(tick, width).saturating_sub(length / 2);
        if (used == 0 || start > used) && start + length <= width + 1 {
            line += &" ".repeat(start - used);
            line += &tick.label;
        }
    }
    line
}

/// Dots of curves, the later ones above.
struct Field {
    width: usize,
    height: usize,
    /// Of each character its dots, and the series that has drawn last.
    cells: Vec<(u32, usize)>,
}

impl Field {
    fn new(width: usize, height: usize) -> Self {
        Self { width, height, cells: vec![(0, 0); width * height] }
    }

    fn has_dots(&self) -> bool {
        self.cells.iter().any(|(dots, _)| *dots != 0)
    }

    /// Coordinates in dots from the upper left corner; `None` for a gap.
    fn place(&self, (x, y): (f64, f64), along: &Scale, up: &Scale) -> Option<[f64; 2]> {
        let [x, y] = [along.place(x)?, up.place(y)?];
        Some([x * (DOTS[0] * self.width) as f64, (1.0 - y) * (DOTS[1] * self.height) as f64])
    }

    fn draw(&mut self, series: &Series, number: usize, along: &Scale, up: &Scale) {
        let mut before = None;
        for &point in &series.points {
            let place = self.place(point, along, up);
            match (before, place) {
                (Some(from), Some(to)) if !series.style.is_unconnected() => self.line_to(from, to, number),
                (_, Some(place)) => self.dot(place, number),
                _ => {}
            }
            before = place;
        }
    }

    fn line_to(&mut self, from: [f64; 2], to: [f64; 2], number: usize) {
        let [across, down] = [to[0] - from[0], to[1] - from[1]];
        // What lies far outside of a fixed range is cut off, not walked along.
        let most = (DOTS[0] * self.width + DOTS[1] * self.height) as f64;
        let steps = across.abs().max(down.abs()).ceil().clamp(1.0, 4.0 * most);
        for step in 0..=steps as usize {
            let share = step as f64 / steps;
            self.dot([from[0] + share * across, from[1] + share * down], number);
        }
    }

    fn dot(&mut self, [x, y]: [f64; 2], number: usize) {
        let inside = |value: f64, most: usize| {
            (value >= -1e-9 && value <= most as f64 + 1e-9).then(|| (value.max(0.0) as usize).min(most - 1))
        };
        let (columns, rows) = (DOTS[0] * self.width, DOTS[1] * self.height);
        let (Some(column), Some(row)) = (inside(x, columns), inside(y, rows)) else { return };
        let cell = &mut self.cells[row / DOTS[1] * self.width + column / DOTS[0]];
        *cell = (cell.0 | BITS[row % DOTS[1]][column % DOTS[0]], number);
    }

    fn line(&self, row: usize, colours: bool, letters: bool) -> String {
        let mut text = String::new();
        let mut shown = None;
        for &(dots, series) in &self.cells[row * self.width..(row + 1) * self.width] {
            let wanted = (colours && dots != 0).then(|| colour(series));
            if wanted != shown {
                text += &wanted.map_or("\x1b[0m".to_owned(), |code| format!("\x1b[{code}m"));
                shown = wanted;
            }
            text.push(match (dots, letters) {
                (0, _) => ' ',
                (_, true) => letter(series),
                (dots, false) => char::from_u32(0x2800 + dots).unwrap_or('*'),
            });
        }
        if shown.is_some() {
            text += "\x1b[0m";
        }
        text.trim_end().to_owned()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    fn chart() -> Chart {
        Chart::new("").x_label("time [s]").y_label("force [N]")
    }

    #[test]
    fn a_rising_curve_goes_from_the_lower_left_to_the_upper_right_and_labels_have_units() {
        let text = chart()
            .series(Series::line("f", (0..50).map(|n| (f64::from(n) * 1e-3, f64::from(n)))))
            .to_text(60, 16, false);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!((lines[0], lines[1]), ("force [N]", "f"));
        let field: Vec<&str> =
            lines.iter().filter_map(|line| line.split_once(['│', '┤']).map(|(_, field)| field)).collect();
        assert_eq!(field.len(), 12);
        let first_dot = |line: &&str| line.chars().position(|character| character != ' ');
        let dots: Vec<usize> = field.iter().filter_map(first_dot).collect();
        assert!(dots.len() >= 11 && dots.is_sorted_by(|one, other| one > other), "{text}");
        assert!(lines.last().unwrap().contains("time [ms]"), "{text}");
        assert!(lines.iter().all(|line| line.chars().count() <= 60), "{text}");
        assert!(!text.contains('\x1b'));
    }

    #[test]
    fn several_curves_are_letters_without_colours_and_dots_with_them() {
        let both = chart()
            .series(Series::line("one", [(0.0, 0.0), (1.0, 0.0)]))
            .series(Series::line("two", [(0.0, 1.0), (1.0, 1.0)]));
        let plain = both.to_text(50, 12, false);
        assert!(
            plain.contains("a one   b two") && plain.contains("aaaa") && plain.contains("bbbb"),
            "{plain}"
        );
        let coloured = both.to_text(50, 12, true);
        assert!(coloured.contains("\x1b[34m──\x1b[0m one") && coloured.contains("\x1b[33m"), "{coloured}");
        // Every line ends in the colour that it began with.
        assert!(coloured.lines().all(|line| line.matches("\x1b[").count().is_multiple_of(2)), "{coloured:?}");
    }

    #[test]
    fn gaps_infinities_and_nothing_at_all_do_no_harm() {
        let strange = [(0.0, 1.0), (1.0, f64::NAN), (2.0, f64::INFINITY), (3.0, 2.0), (f64::NAN, 0.0)];
        let text = chart().series(Series::line("", strange)).to_text(1, 1, true);
        assert!(!text.contains("no finite value"), "{text}");
        let none = chart().series(Series::line("", [(0.0, f64::NAN)])).to_text(80, 24, false);
        assert!(none.contains("(no finite value)"), "{none}");
        let logarithmic = chart().log_y().series(Series::line("", [(0.0, -1.0), (1.0, 1e-3), (2.0, 1e3)]));
        assert!(logarithmic.to_text(60, 20, false).contains("10²"));
    }
}
