//! Vector instructions are instructions in the loops, never calls.
//!
//! A closure or a function without `#[inline(always)]` in a kernel is compiled without the kernel's instruction set;
//! each of its operations becomes a call with operands in memory. The results stay the same, and the loop takes twice
//! the time: no other test would see it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use object::{Object, ObjectSymbol};

#[test]
fn no_vector_instruction_is_a_function_call() {
    let program = std::fs::read(env!("CARGO_BIN_EXE_pulvis")).unwrap();
    let file = object::File::parse(&*program).unwrap();
    let names: Vec<&str> = file.symbols().filter_map(|symbol| symbol.name().ok()).collect();
    assert!(names.iter().any(|name| name.contains("pulvis_core")), "the program has no symbols to look at");
    let is_vector = |name: &str| ["_mm_", "_mm256_", "_mm512_"].iter().any(|part| name.contains(part));
    // Hash tables of the standard library compare sixteen bytes at a time: calls in crates that tests do not optimise. No loop of
    // the engine works on bytes.
    let is_of_hash_tables = |name: &str| ["_epi8", "_si128"].iter().any(|part| name.contains(part));
    let calls: Vec<&&str> = names.iter().filter(|name| is_vector(name) && !is_of_hash_tables(name)).collect();
    assert!(calls.is_empty(), "vector instructions that are called: {calls:?}");
}
