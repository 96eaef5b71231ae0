//! Reports: one HTML file that holds all its pictures, and the same in Markdown.
//!
//! Texts are plain; `k_{p}` stands for a k with a lowered p, as in plots.

mod html;
mod markdown;

use crate::table::Table;
use crate::{IoError, file};
use std::io::Write;
use std::path::Path;

/// How something has turned out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// As it has to be.
    Passed,
    /// Not as it has to be.
    Missed,
    /// It could not be found out.
    Failed,
    /// Nothing was asked for.
    Unjudged,
}

impl Verdict {
    /// In a word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Missed => "missed",
            Self::Failed => "failed",
            Self::Unjudged => "reported",
        }
    }
}

/// A row of the table at the beginning: one section.
#[derive(Clone, Debug, PartialEq)]
pub struct SummaryRow {
    /// Cells, the first of which leads to the section.
    pub cells: Vec<String>,
    /// How it turned out, in the last column.
    pub verdict: Verdict,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// Some sentences.
    Paragraph(String),
    /// A short heading with sentences behind it.
    Remark {
        /// The heading.
        head: String,
        /// The sentences.
        text: String,
    },
    /// A picture.
    Picture {
        /// The picture as SVG.
        svg: String,
        /// Name of the picture's file beside the report, for Markdown.
        file: String,
        /// What it shows, for those who cannot see it.
        alternative: String,
    },
    /// Pictures beside one another.
    Images(Vec<Image>),
    /// Text under a picture.
    Caption(String),
    /// A table; numbers are rounded.
    Table(Table),
    /// Names of files beside the report.
    Files(Vec<String>),
    /// Text in a fixed font that is unfolded on demand.
    Listing {
        /// What it is.
        head: String,
        /// The text.
        text: String,
    },
}

/// A picture of pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// The picture as PNG.
    pub png: Vec<u8>,
    /// Name of the picture's file beside the report, for Markdown.
    pub file: String,
    /// What it shows, in a word.
    pub caption: String,
}

/// A section: one figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// By which links name it: letters, digits and hyphens.
    pub anchor: String,
    /// Its heading.
    pub title: String,
    /// How it turned out.
    pub verdict: Verdict,
    /// What it holds.
    pub blocks: Vec<Block>,
}

/// A report.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// Its heading.
    pub title: String,
    /// What it is about, in some sentences.
    pub lead: String,
    /// Names and values: who computed it, when, on what.
    pub facts: Vec<(String, String)>,
    /// Heads of the columns of the summary.
    pub summary_columns: Vec<String>,
    /// The summary, one row a section.
    pub summary: Vec<SummaryRow>,
    /// The sections.
    pub sections: Vec<Section>,
}

/// Significant digits of tables.
const DIGITS: usize = 3;

impl Report {
    /// The report as one HTML page that needs no other file.
    pub fn to_html(&self) -> String {
        html::render(self)
    }

    /// The report in Markdown; its pictures are files beside it.
    pub fn to_markdown(&self) -> String {
        markdown::render(self)
    }

    /// Writes `report.html` and `report.md` into a folder.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), IoError> {
        for (name, text) in [("report.html", self.to_html()), ("report.md", self.to_markdown())] {
            file::replace(&folder.join(name), |out| out.write_all(text.as_bytes()))?;
        }
        Ok(())
    }
}

/// A text in a markup where `escape` makes letters harmless, `<sub>` lowers and `<sup>` raises them.
fn marked_up(text: &str, escape: impl Fn(&str) -> String) -> String {
    let runs = crate::plot::script::runs(text);
    let piece = |run: &crate::plot::script::Run<'_>| {
        let text = escape(run.text);
        match run.below {
            below if below > 0.0 => format!("<sub>{text}</sub>"),
            below if below < 0.0 => format!("<sup>{text}</sup>"),
            _ => text,
        }
    };
    runs.iter().map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::Cell;

    fn sample() -> Report {
        let mut table = Table::new(["check", "deviation"]);
        let _ = table.push([Cell::from("e | exact"), Cell::from(1.23456e-9)]);
        let picture = Block::Picture {
            svg: "<svg width=\"640\" height=\"420\"></svg>".to_owned(),
            file: "one.png".to_owned(),
            alternative: "e < 1 & more".to_owned(),
        };
        Report {
            title: "Figures".to_owned(),
            lead: "All of them.".to_owned(),
            facts: vec![("version".to_owned(), "1 < 2".to_owned())],
            summary_columns: ["figure", "verdict"].map(str::to_owned).to_vec(),
            summary: vec![SummaryRow { cells: vec!["one".to_owned()], verdict: Verdict::Missed }],
            sections: vec![Section {
                anchor: "one".to_owned(),
                title: "With k_{p}".to_owned(),
                verdict: Verdict::Missed,
                blocks: vec![picture, Block::Table(table), Block::Caption("<script>".to_owned())],
            }],
        }
    }

    #[test]
    fn a_page_holds_its_pictures_and_no_text_becomes_markup() {
        let html = sample().to_html();
        assert!(html.contains("<svg") && html.contains("k<sub>p</sub>") && html.contains("1 &lt; 2"));
        assert!(!html.contains("<script>") && html.contains("&lt;script&gt;"));
        // Nothing is fetched from elsewhere.
        assert!(!html.contains("src=") && !html.contains("http"), "{html}");
        assert!(html.contains("href=\"#one\"") && html.contains("id=\"one\""));
    }

    #[test]
    fn markdown_names_the_files_of_its_pictures_and_keeps_bars_out_of_its_tables() {
        let text = sample().to_markdown();
        assert!(text.contains("](one.png)") && text.contains("e \\| exact"), "{text}");
        assert!(text.contains("1.23e-9") || text.contains("1.23e−9"), "{text}");
    }
}
