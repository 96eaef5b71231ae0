//! As much of HTTP/1.1 (RFC 9112) as one page needs: a question and an answer on each connection, which then ends.

use crate::message::{Answer, Question};
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

/// No scenario is longer \[byte\].
const LONGEST_BODY: u64 = 1 << 20;

/// No line and headers of a question are longer \[byte\].
const LONGEST_HEAD: u64 = 1 << 16;

/// Browsers open connections in advance; one on which nothing is asked for so long is closed.
const PATIENCE: Duration = Duration::from_secs(2);

/// What browsers are told of every answer: nothing from elsewhere is loaded, and no other page may show or read this one.
const HEADERS: &str = "\
Content-Security-Policy: default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; object-src 'none'; base-uri 'none'; frame-ancestors 'none'\r
X-Content-Type-Options: nosniff\r
Referrer-Policy: no-referrer\r
Cross-Origin-Resource-Policy: same-origin\r
Cache-Control: no-store\r
Connection: close\r
";

/// Reads a question, and sends what `site` answers. A browser that has gone away needs no answer.
pub(crate) fn converse(stream: TcpStream, site: impl Fn(&Question) -> Answer) {
    let timeouts =
        stream.set_read_timeout(Some(PATIENCE)).and_then(|()| stream.set_write_timeout(Some(PATIENCE)));
    let Ok(mut writer) = timeouts.and_then(|()| stream.try_clone()) else { return };
    let answer = match read(BufReader::new(stream)) {
        Ok(Some(question)) => site(&question),
        Ok(None) => return,
        Err(refusal) => refusal,
    };
    let _ = writer.write_all(&written(&answer)).and_then(|()| writer.flush());
}

/// A question; `None` where the other side has asked nothing.
fn read(reader: impl BufRead) -> Result<Option<Question>, Answer> {
    let broken = || Answer::refused(400, "this is no question in HTTP/1.1");
    let mut head = reader.take(LONGEST_HEAD);
    let line = |head: &mut std::io::Take<_>| {
        let mut line = String::new();
        BufRead::read_line(head, &mut line).ok().filter(|length| *length > 0).map(|_| line)
    };
    let Some(first) = line(&mut head) else { return Ok(None) };
    let mut words = first.split_whitespace();
    let (Some(method), Some(target), Some("HTTP/1.1" | "HTTP/1.0")) =
        (words.next(), words.next(), words.next())
    else {
        return Err(broken());
    };
    let mut question =
        Question { method: method.to_owned(), target: target.to_owned(), ..Question::default() };
    let mut length = 0;
    loop {
        let header = line(&mut head).ok_or_else(broken)?;
        let header = header.trim_end();
        if header.is_empty() {
            break;
        }
        let (name, value) = header.split_once(':').ok_or_else(broken)?;
        let value = value.trim().to_owned();
        match name.to_ascii_lowercase().as_str() {
            // Two hosts are none.
            "host" if question.host.is_some() => return Err(broken()),
            "host" => question.host = Some(value),
            "origin" => question.origin = Some(value),
            "cookie" => question.cookie = Some(value),
            "content-length" => length = value.parse().map_err(|_| broken())?,
            "transfer-encoding" => {
                return Err(Answer::refused(411, "the length of a question is to be told first"));
            }
            _ => {}
        }
    }
    if length > LONGEST_BODY {
        return Err(Answer::refused(413, "the scenario is longer than 1 MiB"));
    }
    head.set_limit(length);
    let mut body = String::new();
    let read = head.read_to_string(&mut body).map_err(|_| broken())?;
    if read as u64 != length {
        return Err(broken());
    }
    question.body = body;
    Ok(Some(question))
}

fn written(answer: &Answer) -> Vec<u8> {
    let Answer { status, kind, body, cookie } = answer;
    let cookie = cookie.as_ref().map_or(String::new(), |cookie| format!("Set-Cookie: {cookie}\r\n"));
    let length = body.len();
    let reason = if *status == 200 { "OK" } else { "Refused" };
    let head = format!(
        "HTTP/1.1 {status} {reason}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n{HEADERS}{cookie}\r\n"
    );
    [head.as_bytes(), body].concat()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_question_is_read_with_its_headers_and_no_more_than_its_body() {
        let text = "POST /api/probe?a=1 HTTP/1.1\r\nHOST: 127.0.0.1:8017\r\nCookie: a=b\r\nContent-Length: 3\r\n\r\nxyzw";
        let question = read(text.as_bytes()).unwrap().unwrap();
        assert_eq!(
            (question.method.as_str(), question.path(), question.body.as_str()),
            ("POST", "/api/probe", "xyz")
        );
        assert_eq!(question.host.as_deref(), Some("127.0.0.1:8017"));
        assert_eq!(question.parameter("a").as_deref(), Some("1"));
        assert!(read(&b""[..]).unwrap().is_none());
    }

    #[test]
    fn what_is_no_question_is_refused() {
        let status = |text: &str| read(text.as_bytes()).unwrap_err().status;
        assert_eq!(status("hello\r\n\r\n"), 400);
        assert_eq!(status("GET / HTTP/1.1\r\nHost: a\r\n"), 400);
        assert_eq!(status("GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n"), 400);
        assert_eq!(status("POST / HTTP/1.1\r\nContent-Length: 9\r\n\r\nshort"), 400);
        assert_eq!(status("POST / HTTP/1.1\r\nContent-Length: x\r\n\r\n"), 400);
        assert_eq!(status("POST / HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n"), 413);
        assert_eq!(status("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"), 411);
        assert_eq!(status(&format!("GET / HTTP/1.1\r\nX: {}\r\n\r\n", "x".repeat(1 << 17))), 400);
    }
}
