//! The `pulvis` command.
fn main() {}
