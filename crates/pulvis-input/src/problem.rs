//! What can be wrong with a scenario file.

use crate::quantity::QuantityError;
use crate::similar::similar;
use std::error::Error;
use std::io;
use thiserror::Error;

/// One mistake, without its place. The text is what stands behind file, line and key.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Problem {
    /// No such file.
    #[error("there is no such file")]
    NoSuchFile,
    /// A folder instead of a file.
    #[error("is a folder; expected a scenario file")]
    Folder,
    /// The operating system refuses.
    #[error("cannot be read: {reason}")]
    Unreadable {
        /// The refusal of the operating system.
        reason: io::Error,
    },
    /// More bytes than any scenario has.
    #[error("is larger than {limit} MiB; expected a scenario file")]
    TooLarge {
        /// Largest size accepted in MiB.
        limit: u64,
    },
    /// Bytes that are no text.
    #[error("the byte 0x{byte:02x} is not UTF-8 text; expected a scenario file in UTF-8")]
    NotText {
        /// The first byte that cannot be read.
        byte: u8,
    },
    /// Nothing but blanks and comments.
    #[error("the file has no keys; expected a scenario, which begins for example with [materials.grain]")]
    Empty,
    /// Text that is no TOML.
    #[error("this is no valid TOML: {message}")]
    Syntax {
        /// The parser's own words.
        message: String,
    },
    /// A key or table that stands in the file a second time.
    #[error("`{key}` stands here a second time; expected each key and table once")]
    Duplicate {
        /// The key.
        key: String,
    },
    /// A key that nobody asked for.
    #[error("unknown key{}", or_similar(.similar.as_deref()))]
    UnknownKey {
        /// The known key that was probably meant.
        similar: Option<String>,
    },
    /// A key that is needed.
    #[error("missing `{key}`; expected {expected}")]
    MissingKey {
        /// The key.
        key: String,
        /// What it should hold.
        expected: String,
    },
    /// A value of another kind.
    #[error("found {found}; expected {expected}")]
    WrongType {
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// A quantity that cannot be read, has another dimension, or is out of range.
    #[error(transparent)]
    Quantity(#[from] QuantityError),
    /// A name that is not in the list.
    #[error("found \"{found}\"; expected {}{}", one_of(.choices), or_similar(.similar.as_deref()))]
    UnknownChoice {
        /// The name as written.
        found: String,
        /// All names that are allowed.
        choices: Vec<String>,
        /// The one that was probably meant.
        similar: Option<String>,
    },
    /// A whole number outside its range.
    #[error("{found} is out of range; expected {expected}")]
    IntegerRange {
        /// The number as written.
        found: String,
        /// The range in words.
        expected: String,
    },
    /// A list of the wrong length.
    #[error("found {found} value{}; expected {expected}", if *.found == 1 { "" } else { "s" })]
    WrongLength {
        /// Number of values in the list.
        found: usize,
        /// What was expected, in words.
        expected: String,
    },
    /// Values that are fine alone but contradict each other.
    #[error("{found}; expected {expected}")]
    Rule {
        /// What was found, as a clause: `50 N/m is smaller than k1 = 100 N/m`.
        found: String,
        /// What must hold: `kp >= k1`.
        expected: String,
    },
    /// The refusal of another crate, for example of a contact law for its parameters.
    #[error(transparent)]
    Refused(Box<dyn Error + Send + Sync>),
    /// A path of a replacement that leads nowhere.
    #[error("there is no key `{key}` to replace{}", or_similar(.similar.as_deref()))]
    NothingToReplace {
        /// The step that is missing.
        key: String,
        /// The key that was probably meant.
        similar: Option<String>,
    },
    /// A path of a replacement that cannot be read.
    #[error("`{path}` is no path of keys; write for example contact.normal.kc or stages[0].duration")]
    UnreadablePath {
        /// The path as written.
        path: String,
    },
    /// A path of a replacement that ends at a table or a list.
    #[error("is {found}; expected a single value to replace")]
    NotReplaceable {
        /// What stands there.
        found: &'static str,
    },
    /// A table that was opened and never closed: its unknown keys would pass unseen.
    #[error("the keys of this table were not checked; this is a bug in Pulvis, please report it")]
    Unchecked,
}

/// `; did you mean …?` where there is something to suggest.
pub(crate) fn or_similar(similar: Option<&str>) -> String {
    similar.map(|name| format!("; did you mean `{name}`?")).unwrap_or_default()
}

/// `"linear" or "square-root"`.
pub(crate) fn one_of(choices: &[String]) -> String {
    let quoted: Vec<String> = choices.iter().map(|choice| format!("\"{choice}\"")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => "nothing".to_owned(),
    }
}

/// A text as a message echoes it: not more than `most` characters.
pub(crate) fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most.saturating_sub(1)).chain(['…']).collect()
}

/// The longest finding that a message tells in full: texts of the file may be in it.
const LONGEST_FOUND: usize = 600;

/// The longest value that a message echoes in full.
pub(crate) const LONGEST_VALUE: usize = 60;

impl Problem {
    /// A name that is none of the choices.
    pub fn unknown_choice(found: &str, choices: &[&str]) -> Self {
        Self::UnknownChoice {
            found: shortened(found, LONGEST_VALUE),
            choices: choices.iter().map(|&choice| choice.to_owned()).collect(),
            similar: similar(found, choices.iter().copied()).map(str::to_owned),
        }
    }

    /// Values that contradict each other: what was found, and what must hold.
    pub fn rule(found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self::Rule { found: shortened(&found.into(), LONGEST_FOUND), expected: expected.into() }
    }
}
