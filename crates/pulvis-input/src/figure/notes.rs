//! Notes that figures share: misprints of the papers, and decisions where they leave a choice.

use super::Surroundings;
use crate::context::Reported;
use crate::document::Document;
use crate::error::InputErrors;
use crate::list::List;
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Text;
use std::path::Path;

/// The file that holds them.
const NOTES: &str = "notes.toml";

/// A note.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// By which figures name it.
    pub key: String,
    /// What it says.
    pub text: String,
}

/// Reads `notes`, a list of keys of `notes.toml` in the folder above.
pub(super) fn read_notes(
    root: &mut TableReader<'_>,
    around: &Surroundings<'_>,
) -> Result<Vec<Note>, Reported> {
    let wanted = root.or("notes", List::of(Text), Vec::new())?;
    if wanted.is_empty() {
        return Ok(Vec::new());
    }
    let file = around.folder.parent().unwrap_or(Path::new("")).join(NOTES);
    let known = match load(&file) {
        Ok(known) => known,
        Err(errors) => {
            around.elsewhere.borrow_mut().extend(errors.into_errors());
            let found = format!("{} cannot be read", file.display());
            return Err(root.refuse("notes", Problem::rule(found, "a file of notes: `key = \"text\"`")));
        }
    };
    let find = |key: &String| {
        let note = known.iter().find(|note| note.key == *key).cloned();
        note.ok_or_else(|| {
            let keys: Vec<&str> = known.iter().map(|note| note.key.as_str()).collect();
            root.refuse("notes", Problem::unknown_choice(key, &keys))
        })
    };
    let notes: Vec<_> = wanted.iter().map(find).collect();
    notes.into_iter().collect()
}

fn load(file: &Path) -> Result<Vec<Note>, InputErrors> {
    Document::load(file)?.read(|mut root| {
        let keys = root.keys();
        let mut notes = Vec::new();
        for key in keys {
            notes.push(root.required(key, Text).map(|text| Note { key: key.to_owned(), text }));
        }
        root.finish();
        notes.into_iter().collect()
    })
}
