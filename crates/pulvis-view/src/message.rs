//! Questions of the page and answers to it, without sockets.

use serde_json::Value;

/// What a browser asks.
#[derive(Clone, Debug, Default)]
pub struct Question {
    /// `GET`, `POST` and so on.
    pub method: String,
    /// Path and query, as sent.
    pub target: String,
    /// The header `Host`.
    pub host: Option<String>,
    /// The header `Origin`.
    pub origin: Option<String>,
    /// The header `Cookie`.
    pub cookie: Option<String>,
    /// What was sent along.
    pub body: String,
}

impl Question {
    /// The path without the query, as sent.
    pub fn path(&self) -> &str {
        self.target.split_once('?').map_or(self.target.as_str(), |(path, _)| path)
    }

    /// A value of the query.
    pub fn parameter(&self, name: &str) -> Option<String> {
        let (_, query) = self.target.split_once('?')?;
        let value = query.split('&').find_map(|pair| pair.strip_prefix(name)?.strip_prefix('='))?;
        decode(&value.replace('+', " "))
    }
}

/// Percent signs replaced by what they stand for; `None` where that is no text.
pub(crate) fn decode(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        rest = tail;
        if first == b'%' {
            let (digits, tail) = rest.split_at_checked(2)?;
            bytes.push(u8::from_str_radix(std::str::from_utf8(digits).ok()?, 16).ok()?);
            rest = tail;
        } else {
            bytes.push(first);
        }
    }
    String::from_utf8(bytes).ok()
}

/// What is answered.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Answer {
    /// Status of HTTP.
    pub status: u16,
    /// Media type.
    pub kind: &'static str,
    /// What is sent.
    pub body: Vec<u8>,
    /// A cookie to be kept.
    pub cookie: Option<String>,
}

impl Answer {
    pub(crate) fn of(kind: &'static str, body: impl Into<Vec<u8>>) -> Self {
        Self { status: 200, kind, body: body.into(), cookie: None }
    }

    pub(crate) fn json(value: &Value) -> Self {
        Self::of("application/json", value.to_string())
    }

    /// A refusal with a sentence that the page shows.
    pub(crate) fn refused(status: u16, why: impl Into<String>) -> Self {
        let body = serde_json::json!({ "error": why.into() }).to_string();
        Self { status, ..Self::of("application/json", body) }
    }
}
