//! Sockets.

use crate::ViewError;
use crate::access::Access;
use crate::message::{Answer, Question};
use crate::routes::Site;
use std::io::Read;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tiny_http::{Header, Request, Response, Server, StatusCode};

/// The port unless told otherwise; if it is taken, one of the next ones.
const PORT: u16 = 8017;

/// How many ports are tried.
const TRIES: u16 = 50;

/// Questions that are answered at a time: those of one page do not wait for each other.
const WORKERS: usize = 4;

/// No scenario is longer \[byte\].
const LONGEST_BODY: u64 = 1 << 20;

/// How often a worker looks whether it should stop.
const PATIENCE: Duration = Duration::from_millis(100);

/// What browsers are told of every answer: nothing from elsewhere is loaded, and no other page may show or read this one.
const HEADERS: [(&str, &str); 5] = [
    (
        "Content-Security-Policy",
        "default-src 'self'; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; object-src 'none'; base-uri 'none'; frame-ancestors 'none'",
    ),
    ("X-Content-Type-Options", "nosniff"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Cache-Control", "no-store"),
];

/// A server that listens.
pub struct Viewer {
    server: Server,
    site: Site,
    url: String,
}

impl std::fmt::Debug for Viewer {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Viewer").field("site", &self.site).finish_non_exhaustive()
    }
}

impl Viewer {
    /// Opens the run in `folder`, if any, and listens at an address, which others may reach if it is not a loopback address.
    ///
    /// # Errors
    /// No run is there, or the port is taken.
    pub fn listen(folder: Option<&Path>, address: IpAddr, port: Option<u16>) -> Result<Self, ViewError> {
        let listener = bind(address, port)?;
        let failed =
            |source| ViewError::Listen { address: SocketAddr::new(address, port.unwrap_or(PORT)), source };
        let address = listener.local_addr().map_err(failed)?;
        let access = Access::of(address);
        let url = access.url(address);
        let site = Site::new(access, folder)?;
        let server = Server::from_listener(listener, None)
            .map_err(|error| failed(std::io::Error::other(error.to_string())))?;
        Ok(Self { server, site, url })
    }

    /// The address to open.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Answers until `stop` is true.
    pub fn serve(&self, stop: &AtomicBool) {
        std::thread::scope(|scope| {
            for _ in 0..WORKERS {
                scope.spawn(|| {
                    while !stop.load(Ordering::Relaxed) {
                        // A question that breaks off is over; the next one may be whole.
                        if let Ok(Some(request)) = self.server.recv_timeout(PATIENCE) {
                            self.answer(request);
                        }
                    }
                });
            }
        });
    }

    fn answer(&self, mut request: Request) {
        let header = |request: &Request, name: &'static str| {
            let found = request.headers().iter().find(|header| header.field.equiv(name));
            found.map(|header| header.value.as_str().to_owned())
        };
        let mut question = Question {
            method: request.method().to_string(),
            target: request.url().to_owned(),
            host: header(&request, "Host"),
            origin: header(&request, "Origin"),
            cookie: header(&request, "Cookie"),
            body: String::new(),
        };
        let mut body = Vec::new();
        let read = request.as_reader().take(LONGEST_BODY + 1).read_to_end(&mut body);
        let answer = match (read, String::from_utf8(body)) {
            (Err(_), _) => Answer::refused(400, "the question breaks off"),
            (Ok(length), _) if length as u64 > LONGEST_BODY => {
                Answer::refused(413, "the scenario is longer than 1 MiB")
            }
            (Ok(_), Err(_)) => Answer::refused(400, "the question is no text"),
            (Ok(_), Ok(body)) => {
                question.body = body;
                self.site.answer(&question)
            }
        };
        // A browser that has gone away needs no answer.
        let _ = request.respond(response(answer));
    }
}

fn response(answer: Answer) -> Response<std::io::Cursor<Vec<u8>>> {
    let mut headers = HEADERS.to_vec();
    headers.push(("Content-Type", answer.kind));
    if let Some(cookie) = &answer.cookie {
        headers.push(("Set-Cookie", cookie));
    }
    let headers =
        headers.into_iter().filter_map(|(name, value)| Header::from_bytes(name, value).ok()).collect();
    let length = answer.body.len();
    Response::new(StatusCode(answer.status), headers, std::io::Cursor::new(answer.body), Some(length), None)
}

/// The port that was asked for, or the first free one.
fn bind(address: IpAddr, port: Option<u16>) -> Result<TcpListener, ViewError> {
    let first = SocketAddr::new(address, port.unwrap_or(PORT));
    let tries = if port.is_some() { 1 } else { TRIES };
    for number in 0..tries {
        let address = SocketAddr::new(first.ip(), first.port() + number);
        match TcpListener::bind(address) {
            Ok(listener) => return Ok(listener),
            Err(error) if error.kind() == std::io::ErrorKind::AddrInUse => {}
            Err(source) => return Err(ViewError::Listen { address, source }),
        }
    }
    Err(ViewError::PortTaken(first))
}
