//! Mistakes in scenario files: where, what was found, what was expected, what to do.

use crate::problem::{Problem, shortened};
use crate::value::split_path;
use std::fmt;

/// Where in a file a mistake stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Line, the first is 1.
    pub line: usize,
    /// Column in characters, the first is 1.
    pub column: usize,
    /// The text of the line.
    pub excerpt: String,
    /// Number of characters to underline, at least 1.
    pub width: usize,
}

impl Place {
    /// A longer line is shown in part.
    const LONGEST_SHOWN: usize = 120;
    /// Characters shown before the mark of a line that is shown in part.
    const BEFORE_MARK: usize = 40;

    /// The line, or the part of a long line around the mark; what stands before the mark in the line
    /// below; and the width of the mark.
    fn window(&self) -> (String, String, usize) {
        let length = self.excerpt.chars().count();
        let marked = self.column.saturating_sub(1).min(length);
        // The end of a line that is a little longer is shown rather than an ellipsis.
        let start = if length > Self::LONGEST_SHOWN { marked.saturating_sub(Self::BEFORE_MARK) } else { 0 };
        let end = length.min(start + Self::LONGEST_SHOWN);
        let mut shown = String::new();
        let mut indent = String::new();
        if start > 0 {
            shown.push('…');
            indent.push(' ');
        }
        for (position, character) in self.excerpt.chars().enumerate().take(end).skip(start) {
            shown.push(character);
            // A tab has to be repeated under the line, or the mark would stand elsewhere.
            if position < marked {
                indent.push(if character == '\t' { '\t' } else { ' ' });
            }
        }
        if end < length {
            shown.push('…');
        }
        (shown, indent, self.width.min(end - marked).max(1))
    }
}

/// One mistake in a scenario file.
#[derive(Debug)]
pub struct InputError {
    /// The file as the user named it.
    pub file: String,
    /// Where it stands; `None` if the file could not be read at all.
    pub place: Option<Place>,
    /// Dotted path of the key or table, empty for the whole file.
    pub key: String,
    /// What is wrong.
    pub problem: Problem,
    /// What to do, where the problem's own text does not say it.
    pub help: Option<String>,
    /// Whether the value was set from outside the file, so that the shown line is not to blame.
    pub replaced: bool,
}

impl InputError {
    /// The longest text of a problem that is told in full [characters].
    const LONGEST: usize = 1500;

    /// A mistake of the file as a whole.
    pub(crate) fn of_file(file: &str, problem: Problem) -> Self {
        Self { file: file.to_owned(), place: None, key: String::new(), problem, help: None, replaced: false }
    }

    /// The first line without `error: ` and the file's name, as `tests/bad` compares it.
    pub fn headline(&self) -> String {
        let mut line = String::new();
        if let Some(place) = &self.place {
            line.push_str(&format!("{}:{}: ", place.line, place.column));
        }
        if !self.key.is_empty() {
            line.push_str(&format!("{}: ", shortened(&self.key, 120)));
        }
        // Texts of the file may be in it.
        line.push_str(&shortened(&self.problem.to_string(), Self::LONGEST));
        line
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joint = if self.place.is_some() { "" } else { " " };
        write!(out, "error: {}:{joint}{}", self.file, self.headline())?;
        if let Some(place) = &self.place {
            let number = place.line.to_string();
            let margin = " ".repeat(number.len());
            let (shown, indent, width) = place.window();
            write!(out, "\n{margin}|\n{number}| {shown}")?;
            write!(out, "\n{margin}| {indent}{}", "^".repeat(width))?;
        }
        if self.replaced {
            write!(
                out,
                "\n  note: this value was set from outside the file; the line shows what it replaces"
            )?;
        }
        match &self.help {
            Some(help) => write!(out, "\n  help: {help}"),
            None => Ok(()),
        }
    }
}

impl std::error::Error for InputError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.problem)
    }
}

/// All mistakes of one run over a file, in the order of the file.
#[derive(Debug)]
pub struct InputErrors {
    errors: Vec<InputError>,
    omitted: usize,
}

impl InputErrors {
    /// More than this is rarely read; often they share one cause.
    pub const MOST: usize = 20;

    /// Sorts by place and keeps the first [`Self::MOST`]. A missing key comes after the unknown keys of
    /// its table: what is missing has often been written in another way, and that is the mistake.
    pub(crate) fn new(mut errors: Vec<InputError>) -> Self {
        let place = |error: &InputError| error.place.as_ref().map(|place| (place.line, place.column));
        let unknown: Vec<_> = errors
            .iter()
            .filter(|error| matches!(error.problem, Problem::UnknownKey { .. }))
            .map(|error| (split_path(&error.key).unwrap_or_default(), place(error)))
            .collect();
        errors.sort_by_cached_key(|error| {
            let here = (place(error), false);
            if !matches!(error.problem, Problem::MissingKey { .. }) {
                return here;
            }
            // The path of the whole file is empty.
            let table = split_path(&error.key).unwrap_or_default();
            let in_table = unknown
                .iter()
                .filter(|(key, _)| key.split_last().is_some_and(|(_, parent)| parent == table.as_slice()));
            in_table.map(|&(_, place)| (place, true)).fold(here, Ord::max)
        });
        let omitted = errors.len().saturating_sub(Self::MOST);
        errors.truncate(Self::MOST);
        Self { errors, omitted }
    }

    /// As they come, of more than one file: those of the first file first.
    pub(crate) fn in_order(mut errors: Vec<InputError>) -> Self {
        let omitted = errors.len().saturating_sub(Self::MOST);
        errors.truncate(Self::MOST);
        Self { errors, omitted }
    }

    /// The mistakes alone.
    pub(crate) fn into_errors(self) -> Vec<InputError> {
        self.errors
    }

    /// The same mistakes, with advice where they have none yet.
    pub(crate) fn with_help(mut self, help: &str) -> Self {
        for error in &mut self.errors {
            error.help.get_or_insert_with(|| help.to_owned());
        }
        self
    }

    /// The mistakes, in the order of the file.
    pub fn errors(&self) -> &[InputError] {
        &self.errors
    }

    /// Number of further mistakes that are not shown.
    pub fn omitted(&self) -> usize {
        self.omitted
    }
}

impl From<InputError> for InputErrors {
    fn from(error: InputError) -> Self {
        Self::new(vec![error])
    }
}

impl fmt::Display for InputErrors {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, error) in self.errors.iter().enumerate() {
            let gap = if position == 0 { "" } else { "\n\n" };
            write!(out, "{gap}{error}")?;
        }
        match self.omitted {
            0 => Ok(()),
            more => write!(out, "\n\n{more} more mistakes are not shown"),
        }
    }
}

impl std::error::Error for InputErrors {}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;
    use crate::{Dimension, Document};

    fn refused(text: &str) -> String {
        let read = Document::from_str("a.toml", text).unwrap().read(|mut root| {
            let radius = root.required("radius", Dimension::LENGTH);
            root.finish();
            radius
        });
        read.unwrap_err().to_string()
    }

    #[test]
    fn of_a_long_line_the_part_around_the_mark_is_shown() {
        let (before, after) = ("x".repeat(100_000), "y".repeat(100_000));
        let message = refused(&format!("a = \"{before}\"\nradius = \"{before} {after}\""));
        assert!(message.len() < 1500, "{} bytes", message.len());
        let message = refused(&format!("{before} = 1"));
        assert!(message.len() < 1000, "{} bytes", message.len());
        // The mark stands under the value, and no farther than the line is shown.
        let list = format!("radius = [{}1]", "1, ".repeat(100));
        let message = refused(&list);
        let lines: Vec<&str> = message.lines().collect();
        assert_eq!(lines[2].chars().count(), lines[3].chars().count() + 1, "{message}");
        assert!(lines[2].starts_with("1| radius = [1, 1,") && lines[2].ends_with('…'), "{message}");
        assert_eq!(lines[2].find('['), lines[3].find('^'));
        let late = format!("b = \"{}\" # {}\nradius = 1 # {}", "z".repeat(300), "z".repeat(300), after);
        assert!(refused(&late).contains("\n2| radius = 1 # yyy"), "{}", refused(&late));
    }

    #[test]
    fn a_mark_far_to_the_right_is_shown_with_what_stands_before_it() {
        let place = Place { line: 1, column: 501, excerpt: "µ".repeat(1000), width: 700 };
        let (shown, indent, width) = place.window();
        assert_eq!((shown.chars().count(), indent.chars().count(), width), (122, 41, 80));
    }
}
