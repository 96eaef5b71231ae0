//! JSON schemas of scenario files, for completion, hover texts and early refusals in editors.
//!
//! Laws come from the catalogue, names from the lists that the readers use, hover texts from the pages of the manual. The tests
//! hold the keys of every table against those that the readers ask for.

mod bodies;
mod laws;
mod manual;
mod pairs;
mod scenario;
mod selected;
mod shapes;

use manual::Manual;
use serde_json::{Value, json};
use shapes::Page;

/// A kind of file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Of `pulvis run`.
    Scenario,
    /// Of `pulvis collide`.
    Collision,
    /// Of `pulvis probe`.
    Probe,
    /// Of `pulvis study`.
    Study,
}

impl FileKind {
    /// All of them, with their names.
    pub const ALL: [(&'static str, Self); 4] = [
        ("scenario", Self::Scenario),
        ("collision", Self::Collision),
        ("probe", Self::Probe),
        ("study", Self::Study),
    ];

    /// The page of the manual that describes it.
    fn page(self) -> (&'static str, &'static str) {
        match self {
            Self::Scenario => (include_str!("../../../../docs/scenario.md"), "Top level"),
            Self::Collision => (include_str!("../../../../docs/collision.md"), "Scenarios of"),
            Self::Probe => {
                (include_str!("../../../../docs/book/src/probe.md"), "A contact on a prescribed path")
            }
            Self::Study => (include_str!("../../../../docs/study.md"), "Studies of"),
        }
    }
}

/// The schema of a kind of file: JSON schema, draft 7, which editors know best.
pub fn schema(kind: FileKind) -> Value {
    let (text, section) = kind.page();
    let manual = Manual::new(text);
    let page = Page { manual: &manual, section };
    let mut schema = match kind {
        FileKind::Scenario => scenario::file(page),
        FileKind::Collision => pairs::collision(page),
        FileKind::Probe => pairs::probe(page),
        FileKind::Study => pairs::study(page),
    };
    let name = FileKind::ALL.iter().find(|(_, known)| *known == kind).map_or("", |(name, _)| name);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!(format!("Pulvis {name}"));
    schema
}
