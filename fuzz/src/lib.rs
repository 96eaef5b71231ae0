//! What coverage-guided fuzzing asks of everything that is read.

use std::fs;
use std::path::PathBuf;

use pulvis_input::InputErrors;

/// Letters beyond which nobody reads a message.
const LONGEST: usize = 2000;

/// Asserts that what is refused is refused with a file and in few words.
///
/// # Panics
/// It is not.
pub fn judge<T>(read: Result<T, InputErrors>) {
    let Err(errors) = read else { return };
    assert!(!errors.errors().is_empty(), "refused without a reason");
    for error in errors.errors() {
        let headline = error.headline();
        assert!(!error.file.is_empty() && headline.chars().count() < LONGEST, "{headline}");
        assert!(!error.to_string().contains("bug in Pulvis"), "{error}");
    }
}

/// A file of this process with a content, for readers that want one.
///
/// # Panics
/// It cannot be written.
pub fn file(ending: &str, content: &[u8]) -> PathBuf {
    let path = std::env::temp_dir().join(format!("pulvis-fuzz-{}.{ending}", std::process::id()));
    fs::write(&path, content).expect("the temporary folder takes files");
    path
}
