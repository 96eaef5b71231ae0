//! The laboratory: the page sends scenario files, and is answered with what `pulvis collide` and `pulvis probe` compute of
//! them.

mod catalogue;
mod collide;
mod map;
mod oblique;
mod parallel;
mod presets;
mod probe;
mod state;
mod sticking;

use crate::message::{Answer, Question};
use pulvis_input::{Document, InputErrors};
use serde_json::{Value, json};

/// What the scenario of a question is called in messages.
const NAME: &str = "scenario.toml";

/// A refusal in words.
type Outcome = Result<Value, String>;

/// Answers a question about laws and contacts; `None`: it is not one.
pub(crate) fn answer(name: &str, question: &Question) -> Option<Answer> {
    let reading = question.method == "GET";
    let outcome = match (name, reading) {
        ("laws", true) => Ok(catalogue::laws()),
        ("presets", true) => Ok(presets::list()),
        ("start", true) => state::start(
            &question.parameter("role").unwrap_or_default(),
            &question.parameter("law").unwrap_or_default(),
        ),
        ("state", false) => state::read(&question.body),
        ("collide", false) => {
            let quick = question.parameter("quick").is_some();
            collide::answer(&question.body, number(question, "velocity"), quick)
        }
        ("oblique", false) => {
            let quick = question.parameter("quick").is_some();
            oblique::answer(&question.body, angle(question), quick)
        }
        ("map", false) => map::answer(question),
        ("sticking", false) => sticking::answer(&question.body),
        ("probe", false) => probe::answer(&question.body),
        _ => return None,
    };
    Some(match outcome {
        Ok(value) => Answer::json(&value),
        Err(why) => Answer::refused(422, why),
    })
}

fn number(question: &Question, name: &str) -> Option<f64> {
    question.parameter(name)?.parse().ok().filter(|number: &f64| *number > 0.0 && number.is_finite())
}

/// An angle of incidence [rad].
fn angle(question: &Question) -> Option<f64> {
    let range = 0.0..std::f64::consts::FRAC_PI_2;
    question.parameter("angle")?.parse().ok().filter(|angle| range.contains(angle))
}

/// The text as a document.
fn document(text: &str) -> Result<Document, String> {
    Document::from_str(NAME, text).map_err(words)
}

fn words(errors: InputErrors) -> String {
    errors.to_string()
}

/// One column of many rows.
fn column<T>(rows: &[T], value: impl Fn(&T) -> f64) -> Value {
    json!(rows.iter().map(value).collect::<Vec<f64>>())
}
