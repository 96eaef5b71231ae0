//! `pulvis run`, `pulvis check`, `pulvis render`, `pulvis study`, `pulvis reproduce` and `pulvis view` from outside: files, messages, exit codes, Ctrl-C.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::print_stderr)]

mod check;
mod disk;
mod explain;
mod folder;
mod place;
mod render;
mod reproduce;
mod resume;
mod run;
mod start;
mod study;
mod view;
mod watch;
