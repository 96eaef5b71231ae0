//! Mistakes that show only after reading, for example once the particles exist: they still point into
//! the file.

use crate::document::Document;
use crate::error::InputError;
use crate::problem::Problem;
use crate::value::{Node, Step, Table, Value, join_path, split_path};
use std::ops::Range;

impl Document {
    /// A mistake at the value of a dotted `path` such as `stages[0].time.step`, or at the innermost part
    /// of it that stands in the file.
    pub fn mistake(&self, path: &str, problem: Problem, help: impl Into<String>) -> InputError {
        let (key, span) = innermost(self.parts().1, path);
        InputError {
            place: span.map(|span| self.parts().0.place(&span)),
            key,
            help: Some(help.into()).filter(|help| !help.is_empty()),
            ..InputError::of_file(self.name(), problem)
        }
    }

    /// Whether the file has a value at a dotted path.
    pub fn has(&self, path: &str) -> bool {
        innermost(self.parts().1, path).0 == path
    }
}

/// The longest beginning of `path` that exists, and where it stands.
fn innermost(root: &Table, path: &str) -> (String, Option<Range<usize>>) {
    let (mut way, mut place) = (String::new(), None);
    let steps = split_path(path).unwrap_or_default();
    let mut at: Option<&Node> = None;
    for step in &steps {
        let table = match at.map(|node| &node.value) {
            None => Some(root),
            Some(Value::Table(table)) => Some(table),
            Some(_) => None,
        };
        let next = match (step, at.map(|node| &node.value)) {
            (Step::Key(key), _) => {
                way = if table.is_some_and(|table| table.entries.contains_key(key)) {
                    join_path(&way, key)
                } else {
                    return (way, place);
                };
                table.and_then(|table| table.entries.get(key)).map(|entry| &entry.node)
            }
            (Step::Index(index), Some(Value::List(items))) => {
                let item = items.get(*index);
                if item.is_some() {
                    way = format!("{way}[{index}]");
                }
                item
            }
            (Step::Index(_), _) => None,
        };
        let Some(node) = next else { return (way, place) };
        place = Some(node.span.clone());
        at = Some(node);
    }
    (way, place)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_late_mistake_points_at_the_value_or_at_what_there_is_of_its_path() {
        let text = "a = 1\n[[stages]]\nname = 'x'\n[stages.time]\nstep = '1 s'\n";
        let document = Document::from_str("f.toml", text).unwrap();
        let problem = || Problem::rule("1 s", "less");
        let exact = document.mistake("stages[0].time.step", problem(), "shorten it");
        assert_eq!(exact.headline(), "5:8: stages[0].time.step: 1 s; expected less");
        let part = document.mistake("stages[0].until.time", problem(), "");
        assert_eq!(part.key, "stages[0]");
        assert!(document.mistake("nothing.here", problem(), "").place.is_none());
        assert!(document.has("stages[0].time.step") && !document.has("stages[1]"));
    }
}
