//! Hover texts: what the pages of the manual say about each key.

/// A page with its tables.
pub(super) struct Manual {
    sections: Vec<Section>,
}

/// What stands below a heading.
struct Section {
    heading: String,
    rows: Vec<Row>,
}

/// A row of a table: its cells with the headings of their columns.
#[derive(Clone)]
struct Row {
    cells: Vec<(String, String)>,
}

impl Manual {
    /// A page in Markdown.
    pub(super) fn new(page: &str) -> Self {
        let mut sections = vec![Section { heading: String::new(), rows: Vec::new() }];
        let mut head: Option<Vec<String>> = None;
        for line in page.lines() {
            if line.starts_with('#') {
                let heading = line.trim_start_matches('#').trim().to_owned();
                sections.push(Section { heading, rows: Vec::new() });
                head = None;
            } else if let Some(cells) = cells(line) {
                let is_rule = cells.iter().all(|cell| cell.chars().all(|c| "-: ".contains(c)));
                match &head {
                    None => head = Some(cells),
                    Some(_) if is_rule => {}
                    Some(head) => {
                        let row = Row { cells: head.iter().cloned().zip(cells).collect() };
                        sections.last_mut().into_iter().for_each(|section| section.rows.push(row.clone()));
                    }
                }
            } else {
                head = None;
            }
        }
        Self { sections }
    }

    /// What the section whose heading contains `section` says of a key: meaning, unit and default. `None` where it says nothing.
    pub(super) fn text(&self, section: &str, key: &str) -> Option<String> {
        let found = self.sections.iter().filter(|one| one.heading.contains(section));
        let row = found.flat_map(|section| &section.rows).find(|row| row.names(key))?;
        Some(row.text())
    }
}

/// The cells of a row of a table; a bar behind a backslash stands in a cell.
fn cells(line: &str) -> Option<Vec<String>> {
    let inner = line.trim().strip_prefix('|')?.strip_suffix('|')?.replace("\\|", "\u{0}");
    Some(inner.split('|').map(|cell| cell.trim().replace('\u{0}', "|")).collect())
}

impl Row {
    /// Whether the first cell names a key: as `key`, as "key" of a choice, or as the end of a path or of a table's heading.
    fn names(&self, key: &str) -> bool {
        let Some((_, first)) = self.cells.first() else { return false };
        first.split('`').skip(1).step_by(2).any(|word| {
            let word = word.trim_matches(['[', ']', '"']);
            let word = word.strip_suffix(".NAME").unwrap_or(word);
            word == key || word.rsplit('.').next() == Some(key)
        })
    }

    fn text(&self) -> String {
        let mut text = String::new();
        let mut rest = String::new();
        for (heading, cell) in self.cells.iter().skip(1).filter(|(_, cell)| !cell.is_empty()) {
            match heading.as_str() {
                "unit" if cell != "1" => text += &format!(" [{}]", cell.trim_matches('`')),
                "unit" => {}
                "default" if cell == "required" => rest += "\n\nRequired.",
                "default" => rest += &format!("\n\nDefault: {cell}"),
                "keys" => rest += &format!("\n\nKeys: {cell}"),
                _ => text += cell,
            }
        }
        (text + &rest).trim().to_owned()
    }
}
