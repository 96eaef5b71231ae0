//! Which question is answered by what.

use crate::access::Access;
use crate::laboratory;
use crate::message::{Answer, Question};
use crate::page;
use crate::run::Run;
use crate::{ViewError, run};
use std::path::Path;

/// What is served.
#[derive(Debug)]
pub struct Site {
    access: Access,
    run: Option<Run>,
}

impl Site {
    /// The laboratory, and the run in a folder if there is one to be shown.
    ///
    /// # Errors
    /// No run is there.
    pub fn new(access: Access, folder: Option<&Path>) -> Result<Self, ViewError> {
        Ok(Self { access, run: folder.map(Run::open).transpose()? })
    }

    /// Answers a question.
    pub fn answer(&self, question: &Question) -> Answer {
        if let Some(refusal) = self.access.refuses(question) {
            return refusal;
        }
        let answer = self.allowed(question);
        Answer { cookie: self.access.cookie(question), ..answer }
    }

    fn allowed(&self, question: &Question) -> Answer {
        let path = question.path();
        let reading = question.method == "GET";
        if !reading && question.method != "POST" {
            return Answer::refused(405, "only GET and POST are answered");
        }
        if let Some(file) = page::answer(path).filter(|_| reading) {
            return file;
        }
        let known = match (path.strip_prefix("/api/"), &self.run) {
            (Some(name), run) => {
                laboratory::answer(name, question).or_else(|| run::answer(name, question, run.as_ref()))
            }
            (None, Some(run)) if reading => path.strip_prefix("/run/").map(|file| run.file(file)),
            _ => None,
        };
        known.unwrap_or_else(|| Answer::refused(404, format!("there is no {path}")))
    }
}
