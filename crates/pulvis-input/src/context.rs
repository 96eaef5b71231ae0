//! Mistakes found during one walk, and where they stand.

use crate::error::InputError;
use crate::problem::Problem;
use crate::scenario::CheckpointReader;
use crate::source::Source;
use std::cell::RefCell;
use std::ops::Range;

/// Proof that a mistake has been recorded. It can only be had by reporting one, so that a value
/// cannot get lost without a message.
#[derive(Clone, Copy, Debug)]
pub struct Reported(());

/// The place of a value or table, kept for checks that need more than one table.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Location {
    pub(crate) span: Range<usize>,
    /// Dotted path of the key.
    pub path: String,
    pub(crate) replaced: bool,
}

impl Location {
    pub(crate) fn error(&self, source: &Source, problem: Problem) -> InputError {
        InputError {
            place: Some(source.place(&self.span)),
            key: self.path.clone(),
            replaced: self.replaced,
            ..InputError::of_file(&source.name, problem)
        }
    }
}

/// What all readers of one walk share.
pub(crate) struct Context<'d> {
    source: &'d Source,
    /// What reads checkpoints that the file names.
    pub(crate) checkpoints: Option<CheckpointReader>,
    errors: RefCell<Vec<InputError>>,
    open: RefCell<Vec<Location>>,
}

impl<'d> Context<'d> {
    pub(crate) fn new(source: &'d Source, checkpoints: Option<CheckpointReader>) -> Self {
        Self { source, checkpoints, errors: RefCell::default(), open: RefCell::default() }
    }

    /// Records a mistake.
    pub(crate) fn report(&self, location: &Location, problem: Problem, help: Option<String>) -> Reported {
        self.errors.borrow_mut().push(InputError { help, ..location.error(self.source, problem) });
        Reported(())
    }

    /// Remembers a table whose unknown keys are still to be refused.
    pub(crate) fn open(&self, table: &Location) {
        self.open.borrow_mut().push(table.clone());
    }

    /// Forgets a table whose keys have all been checked.
    pub(crate) fn close(&self, table: &Location) {
        self.open.borrow_mut().retain(|open| open != table);
    }

    /// All mistakes. A table left open is one only if nothing else is wrong: readers stop at mistakes.
    pub(crate) fn into_errors(self) -> Vec<InputError> {
        let mut errors = self.errors.into_inner();
        if errors.is_empty() {
            let unchecked = |location: &Location| location.error(self.source, Problem::Unchecked);
            errors.extend(self.open.borrow().iter().map(unchecked));
        }
        errors
    }
}
