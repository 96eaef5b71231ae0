//! The text of a file, and where in it a byte stands.

use crate::error::Place;
use std::ops::Range;

/// The text of one scenario file with its name.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    /// The name as the user wrote it.
    pub(crate) name: String,
    /// The text without byte order mark.
    pub(crate) text: String,
}

impl Source {
    /// A text with its name; a byte order mark is dropped.
    pub(crate) fn new(name: &str, text: &str) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        Self { name: name.to_owned(), text: text.to_owned() }
    }

    /// Line, column and the line's text for a range of bytes.
    pub(crate) fn place(&self, span: &Range<usize>) -> Place {
        let start = self.boundary(span.start);
        let (before, _) = self.text.split_at(start);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let rest = self.text.get(line_start..).unwrap_or_default();
        let excerpt = rest.split('\n').next().unwrap_or_default().trim_end_matches('\r');
        let line_end = line_start + excerpt.len();
        // A value over several lines is underlined on its first one; the end of the file still gets a mark.
        let marked = self.boundary(span.end).min(line_end).max(start);
        Place {
            line: before.matches('\n').count() + 1,
            column: count(self.text.get(line_start..start)) + 1,
            excerpt: excerpt.to_owned(),
            width: count(self.text.get(start..marked)).max(1),
        }
    }

    /// The nearest character boundary at or before this byte, inside the text.
    fn boundary(&self, byte: usize) -> usize {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        byte
    }
}

fn count(text: Option<&str>) -> usize {
    text.unwrap_or_default().chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &str) -> Source {
        Source { name: "a.toml".into(), text: text.into() }
    }

    #[test]
    fn columns_count_characters_not_bytes() {
        let place = source("# µ\nµ = 1 # µ").place(&(10..11));
        assert_eq!((place.line, place.column, place.width), (2, 5, 1));
        assert_eq!(place.excerpt, "µ = 1 # µ");
    }

    #[test]
    fn a_place_behind_the_end_is_the_end() {
        let place = source("a = 1\r\n").place(&(70..90));
        assert_eq!((place.line, place.column, place.width), (2, 1, 1));
    }

    #[test]
    fn a_value_over_several_lines_is_marked_on_the_first() {
        let place = source("a = [1,\r\n 2]").place(&(4..12));
        assert_eq!((place.line, place.column, place.width), (1, 5, 3));
        assert_eq!(place.excerpt, "a = [1,");
    }
}
