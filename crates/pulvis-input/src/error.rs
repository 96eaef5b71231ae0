//! Mistakes in scenario files: where, what was found, what was expected, what to do.

use crate::problem::Problem;
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
            line.push_str(&format!("{}: ", self.key));
        }
        line.push_str(&self.problem.to_string());
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
            // A tab has to be repeated under the line, or the mark would stand elsewhere.
            let indent: String = place
                .excerpt
                .chars()
                .take(place.column.saturating_sub(1))
                .map(|c| if c == '\t' { '\t' } else { ' ' })
                .collect();
            write!(out, "\n{margin}|\n{number}| {}", place.excerpt)?;
            write!(out, "\n{margin}| {indent}{}", "^".repeat(place.width))?;
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

    /// Sorts by place and keeps the first [`Self::MOST`].
    pub(crate) fn new(mut errors: Vec<InputError>) -> Self {
        errors.sort_by_key(|error| error.place.as_ref().map(|place| (place.line, place.column)));
        let omitted = errors.len().saturating_sub(Self::MOST);
        errors.truncate(Self::MOST);
        Self { errors, omitted }
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
