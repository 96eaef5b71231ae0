//! Syntax errors of TOML, with advice for the slips that scenario files invite.

use crate::error::{InputError, Place};
use crate::problem::{LONGEST_VALUE, Problem, shortened};
use crate::source::Source;

/// The first syntax error, and every key or table that stands there twice.
///
/// Not the other ones: after its first stumble the parser guesses, and an unclosed list makes an
/// error of every line that follows.
pub(crate) fn syntax_errors(source: &Source, errors: &[toml::de::Error]) -> Vec<InputError> {
    let is_duplicate = |error: &toml::de::Error| error.message() == DUPLICATE;
    let others = errors.iter().filter(|error| !is_duplicate(error));
    let first = others.min_by_key(|error| error.span().map_or(usize::MAX, |span| span.start));
    let duplicates = errors.iter().filter(|error| is_duplicate(error));
    duplicates.chain(first).map(|error| syntax_error(source, error)).collect()
}

/// What the parser says of a second key of the same name.
const DUPLICATE: &str = "duplicate key";

fn syntax_error(source: &Source, error: &toml::de::Error) -> InputError {
    let end = source.text.len();
    let span = error.span().unwrap_or(end..end);
    let place = source.place(&span);
    let problem = match error.message() {
        DUPLICATE => {
            Problem::Duplicate { key: shortened(source.text.get(span).unwrap_or_default(), LONGEST_VALUE) }
        }
        message => Problem::Syntax { message: message.to_owned() },
    };
    let help = match problem {
        Problem::Syntax { .. } => advice(source, &place),
        _ => None,
    };
    InputError { place: Some(place), help, ..InputError::of_file(&source.name, problem) }
}

fn advice(source: &Source, place: &Place) -> Option<String> {
    if let Some((key, value)) = place.excerpt.split_once('=') {
        let value = value.split('#').next().unwrap_or_default().trim();
        let number = value.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'));
        if number && value.contains(char::is_alphabetic) && !value.contains('"') {
            let key = key.trim();
            let value = shortened(value, LONGEST_VALUE);
            return Some(format!("a quantity with its unit stands in quotes: {key} = \"{value}\""));
        }
    }
    let before = source.text.lines().take(place.line.saturating_sub(1));
    let previous = before.filter(|line| !line.trim().is_empty()).last()?;
    let previous = previous.split('#').next().unwrap_or_default().trim_end();
    previous.ends_with([',', '[']).then(|| "is the list above closed by `]`?".to_owned())
}
