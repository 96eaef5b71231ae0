//! The tags of an XML file whose end may be binary.

use super::Broken;
use std::ops::Range;

/// How a tag stands in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `<a>`
    Open,
    /// `</a>`
    Close,
    /// `<a/>`
    Alone,
}

/// A tag.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tag<'a> {
    pub(super) name: &'a str,
    pub(super) kind: Kind,
    /// The number of its line, the first is 1.
    pub(super) line: usize,
    /// Index of its first byte.
    pub(super) start: usize,
    /// Index of the first byte after it.
    pub(super) end: usize,
    attributes: &'a str,
}

impl Tag<'_> {
    /// The value of an attribute, as written.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        let mut rest = self.attributes;
        loop {
            let (before, after) = rest.split_once("=\"")?;
            let (value, next) = after.split_once('"')?;
            if before.trim() == name {
                return Some(value);
            }
            rest = next;
        }
    }

    /// The value of an attribute with its letters in the place of their codes.
    pub(super) fn text(&self, name: &str) -> Option<String> {
        let value = self.attribute(name)?;
        let value = value.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"");
        Some(value.replace("&apos;", "'").replace("&amp;", "&"))
    }
}

/// The tags of a file, one after the other; comments and declarations are passed over.
#[derive(Debug)]
pub(super) struct Tags<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The line of the byte `at`.
    line: usize,
}

impl<'a> Tags<'a> {
    pub(super) fn of(bytes: &'a [u8]) -> Self {
        Self { bytes, at: 0, line: 1 }
    }

    /// The number of the line that comes next.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// The next tag; `None` at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<Tag<'a>>, Broken> {
        loop {
            let Some(start) = self.bytes[self.at..].iter().position(|&byte| byte == b'<') else {
                self.go_to(self.bytes.len());
                return Ok(None);
            };
            self.go_to(self.at + start);
            let rest = &self.bytes[self.at..];
            let end = if rest.starts_with(b"<!--") { find(rest, b"-->") } else { closing(rest) };
            let broken = || Broken::new(self.line, "a tag that does not end", "`>` after it");
            let length = end.ok_or_else(broken)?;
            let (line, start) = (self.line, self.at);
            self.go_to(start + length);
            if !rest.starts_with(b"<?") && !rest.starts_with(b"<!") {
                let text = std::str::from_utf8(&rest[1..length - 1]);
                let text = text.map_err(|_| Broken::new(line, "a tag that is no text", "UTF-8"))?;
                return Ok(Some(tag(text, line, start..self.at)));
            }
        }
    }

    fn go_to(&mut self, index: usize) {
        self.line += self.bytes[self.at..index].iter().filter(|&&byte| byte == b'\n').count();
        self.at = index;
    }
}

/// The tag of what stands between its brackets.
fn tag(text: &str, line: usize, range: Range<usize>) -> Tag<'_> {
    let (kind, text) = match (text.strip_prefix('/'), text.strip_suffix('/')) {
        (Some(text), _) => (Kind::Close, text),
        (_, Some(text)) => (Kind::Alone, text),
        _ => (Kind::Open, text),
    };
    let (name, attributes) = text.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((text, ""));
    Tag { name, kind, line, start: range.start, end: range.end, attributes }
}

/// Length up to the end of a mark.
fn find(bytes: &[u8], mark: &[u8]) -> Option<usize> {
    bytes.windows(mark.len()).position(|window| window == mark).map(|start| start + mark.len())
}

/// Length of a tag: up to the first `>` that is in no quotes.
fn closing(bytes: &[u8]) -> Option<usize> {
    let mut quoted = false;
    for (index, &byte) in bytes.iter().enumerate() {
        match byte {
            b'"' => quoted = !quoted,
            b'>' if !quoted => return Some(index + 1),
            _ => {}
        }
    }
    None
}
