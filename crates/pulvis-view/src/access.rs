//! Who may ask.
//!
//! On a loopback address other machines cannot ask, but web pages in the same browser can try: a page whose own name is made
//! to lead to 127.0.0.1 (DNS rebinding) would be answered as if it were ours. Its `Host` gives it away. At any other
//! address every question needs the token, which the first address that is opened carries and a cookie keeps.

use crate::message::{Answer, Question};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::net::SocketAddr;

/// The cookie that keeps the token.
const COOKIE: &str = "pulvis-token";

/// Who may ask.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Access {
    /// Browsers on this machine, by the names of the machine itself.
    Loopback {
        /// The port.
        port: u16,
    },
    /// All who know the token.
    Token(String),
}

impl Access {
    /// What is right for an address.
    pub fn of(address: SocketAddr) -> Self {
        if address.ip().is_loopback() {
            Self::Loopback { port: address.port() }
        } else {
            Self::Token(random_token())
        }
    }

    /// Why a question is not answered.
    pub(crate) fn refuses(&self, question: &Question) -> Option<Answer> {
        let host = question.host.as_deref().unwrap_or_default();
        // A form of another page may be sent here, but not without saying where it is from.
        if question.origin.as_deref().is_some_and(|origin| origin != format!("http://{host}")) {
            return Some(Answer::refused(403, "questions of other pages are not answered"));
        }
        let allowed = match self {
            Self::Loopback { port } => {
                ["127.0.0.1", "localhost", "[::1]"].iter().any(|name| host == format!("{name}:{port}"))
            }
            Self::Token(token) => {
                let given = question.parameter("token").or_else(|| cookie(question));
                given.is_some_and(|given| equal(&given, token))
            }
        };
        let why = match self {
            Self::Loopback { .. } => "the name of this host is not one of this machine",
            Self::Token(_) => {
                "the token is missing or wrong; open the address that `pulvis view` has printed"
            }
        };
        (!allowed).then(|| Answer::refused(403, why))
    }

    /// The cookie for a browser that has brought the token along.
    pub(crate) fn cookie(&self, question: &Question) -> Option<String> {
        let Self::Token(token) = self else { return None };
        question.parameter("token").map(|_| format!("{COOKIE}={token}; HttpOnly; SameSite=Strict; Path=/"))
    }

    /// The address to open.
    pub fn url(&self, address: SocketAddr) -> String {
        match self {
            Self::Loopback { .. } => format!("http://{address}/"),
            Self::Token(token) => format!("http://{address}/?token={token}"),
        }
    }
}

fn cookie(question: &Question) -> Option<String> {
    let cookies = question.cookie.as_deref()?;
    let found = cookies.split(';').find_map(|pair| pair.trim().strip_prefix(COOKIE)?.strip_prefix('='))?;
    Some(found.to_owned())
}

/// In a time that does not tell how much of it is right.
fn equal(one: &str, other: &str) -> bool {
    let differences = one.bytes().zip(other.bytes()).fold(0, |sum, (a, b)| sum | (a ^ b));
    one.len() == other.len() && differences == 0
}

/// 128 bits. The keys of the standard library's hash come from the system's source of randomness, and its values cannot be
/// told without them.
fn random_token() -> String {
    let part = || {
        let mut hasher = RandomState::new().build_hasher();
        hasher.write_u32(std::process::id());
        hasher.finish()
    };
    format!("{:016x}{:016x}", part(), part())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(host: &str, target: &str, cookie: Option<&str>) -> Question {
        let (host, cookie) = (Some(host.to_owned()), cookie.map(str::to_owned));
        Question { method: "GET".to_owned(), target: target.to_owned(), host, cookie, ..Question::default() }
    }

    #[test]
    fn a_page_whose_name_was_made_to_lead_here_is_not_answered() {
        let access = Access::Loopback { port: 8017 };
        for host in ["127.0.0.1:8017", "localhost:8017", "[::1]:8017"] {
            assert_eq!(access.refuses(&asked(host, "/", None)), None, "{host}");
        }
        for host in ["evil.example:8017", "127.0.0.1", "127.0.0.1:80", "localhost:8017.evil.example", ""] {
            assert_eq!(
                access.refuses(&asked(host, "/", None)).map(|answer| answer.status),
                Some(403),
                "{host}"
            );
        }
    }

    #[test]
    fn a_question_from_another_page_is_not_answered() {
        let access = Access::Loopback { port: 8017 };
        let from = |origin: &str| {
            let question = asked("127.0.0.1:8017", "/api/collide", None);
            access.refuses(&Question { origin: Some(origin.to_owned()), ..question }).is_some()
        };
        assert!(!from("http://127.0.0.1:8017"));
        assert!(from("http://evil.example") && from("null") && from("https://127.0.0.1:8017"));
    }

    #[test]
    fn at_other_addresses_nobody_is_answered_without_the_token() {
        let address = SocketAddr::from(([192, 0, 2, 1], 8017));
        let access = Access::of(address);
        let Access::Token(token) = &access else { unreachable!("no loopback") };
        assert!(token.len() == 32 && access != Access::of(address), "a token of its own for each start");
        let refused = |target: &str, cookie: Option<&str>| {
            access.refuses(&asked("192.0.2.1:8017", target, cookie)).is_some()
        };
        assert!(!refused(&format!("/?token={token}"), None));
        assert!(!refused("/", Some(&format!("a=b; {COOKIE}={token}"))));
        assert!(
            refused("/", None) && refused("/?token=", None) && refused(&format!("/?token={token}0"), None)
        );
        assert!(refused("/", Some(&format!("{COOKIE}={}", "0".repeat(32)))));
    }
}
