//! The page of `pulvis view`: a contact laboratory, and the frames of a run, in the browser.
//!
//! [`Viewer`] serves one page with everything in it, and answers its questions. It computes nothing of its own: the page
//! writes scenario files, and the laboratory does with them what `pulvis collide` and `pulvis probe` do. [`export()`] writes the
//! page with the frames of a run into one file that needs no server.

mod access;
mod error;
mod export;
mod http;
mod laboratory;
mod message;
mod page;
mod routes;
mod run;
mod server;

pub use access::Access;
pub use error::ViewError;
pub use export::{ExportSummary, export};
pub use message::{Answer, Question};
pub use routes::Site;
pub use server::Viewer;
