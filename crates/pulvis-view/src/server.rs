//! Sockets.

use crate::ViewError;
use crate::access::Access;
use crate::http::converse;
use crate::routes::Site;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The port unless told otherwise; if it is taken, one of the next ones.
const PORT: u16 = 8017;

/// How many ports are tried.
const TRIES: u16 = 50;

/// Connections at a time: browsers open six, some of them in advance.
const WORKERS: usize = 16;

/// How often it is looked whether it is over.
const PATIENCE: Duration = Duration::from_millis(50);

/// A server that listens.
#[derive(Debug)]
pub struct Viewer {
    listener: TcpListener,
    address: SocketAddr,
    site: Site,
    url: String,
}

impl Viewer {
    /// Opens the run in `folder`, if any, and listens at an address, which others may reach if it is not a loopback address.
    ///
    /// # Errors
    /// No run is there, or the port is taken.
    pub fn listen(folder: Option<&Path>, address: IpAddr, port: Option<u16>) -> Result<Self, ViewError> {
        let listener = bind(address, port)?;
        let wanted = SocketAddr::new(address, port.unwrap_or(PORT));
        let address =
            listener.local_addr().map_err(|source| ViewError::Listen { address: wanted, source })?;
        let access = Access::of(address);
        let url = access.url(address);
        let site = Site::new(access, folder)?;
        Ok(Self { listener, address, site, url })
    }

    /// The address to open.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Answers until `stop` is true.
    pub fn serve(&self, stop: &AtomicBool) {
        std::thread::scope(|scope| {
            for _ in 0..WORKERS {
                scope.spawn(|| self.work(stop));
            }
            while !stop.load(Ordering::Relaxed) {
                std::thread::sleep(PATIENCE);
            }
            // Workers wait for connections, and see that it is over when there is one.
            for _ in 0..WORKERS {
                let _ = TcpStream::connect_timeout(&self.own(), PATIENCE);
            }
        });
    }

    fn work(&self, stop: &AtomicBool) {
        while !stop.load(Ordering::Relaxed) {
            match self.listener.accept() {
                Ok((stream, _)) if !stop.load(Ordering::Relaxed) => {
                    converse(stream, |question| self.site.answer(question));
                }
                Ok(_) => {}
                // Too many open files, say: it may be better later.
                Err(_) => std::thread::sleep(PATIENCE),
            }
        }
    }

    /// An address at which this server can be reached from this machine.
    fn own(&self) -> SocketAddr {
        let ip = match self.address.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => IpAddr::V4(Ipv4Addr::LOCALHOST),
            IpAddr::V6(ip) if ip.is_unspecified() => IpAddr::V6(Ipv6Addr::LOCALHOST),
            ip => ip,
        };
        SocketAddr::new(ip, self.address.port())
    }
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
