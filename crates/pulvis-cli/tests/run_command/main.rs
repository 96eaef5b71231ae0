//! `pulvis run`, `pulvis check` and `pulvis reproduce` from outside: files, messages, exit codes, Ctrl-C.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stderr)]

mod check;
mod folder;
mod place;
mod reproduce;
mod resume;
mod run;
mod start;
