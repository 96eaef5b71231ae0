//! Descriptions of laws: complete, true to the code that reads them, and strict.

use pulvis_contact::catalogue::{InvalidParameter, Kind, LawEntry, Presence, Range, Value, Values};

use crate::parameters::example;

/// Checks one list of the catalogue, with the function that builds its laws by name.
pub fn check_list<L: std::fmt::Debug>(
    entries: &[&LawEntry],
    build: impl Fn(&str, &Values) -> Option<Result<L, InvalidParameter>>,
) {
    for (index, entry) in entries.iter().enumerate() {
        let row_pairs = entries[..index].iter().filter(|other| other.name == entry.name).count();
        assert_eq!(row_pairs, 0, "two laws are called {}", entry.name);
        check_texts(entry);
        let (name, values) = example(entry);
        assert_eq!(name, entry.name, "the example names its own law");
        let strict = Strict { entry, values: &values, build: &build };
        strict.accepts(&values);
        strict.refuses_unknown_names();
        strict.refuses_missing_parameters();
        strict.refuses_what_is_out_of_range();
    }
    assert!(build("no-such-law", &Values::new()).is_none(), "an unknown law is no law");
}

fn check_texts(entry: &LawEntry) {
    let law = entry.name;
    for (what, text) in [
        ("name", law),
        ("summary", entry.summary),
        ("equations", entry.equations),
        ("source", entry.source),
        ("closed_form", entry.closed_form),
        ("example", entry.example),
    ] {
        assert!(!text.trim().is_empty(), "{law} has no {what}");
    }
    assert!(!entry.summary.ends_with('.') && !entry.summary.contains('\n'), "{law}: summary is one phrase");
    for column in entry.memory {
        assert!(column.ends_with(']') && column.contains(" ["), "{law}: memory `{column}` names no unit");
    }
    for (index, parameter) in entry.parameters.iter().enumerate() {
        let name = parameter.name;
        assert!(entry.parameters[..index].iter().all(|other| other.name != name), "{law}: {name} twice");
        assert!(!parameter.meaning.trim().is_empty(), "{law}.{name} has no meaning");
        assert!(!parameter.allowed().is_empty() && !parameter.unit().is_empty(), "{law}.{name}");
        match (parameter.kind, parameter.presence) {
            (Kind::Numbers { .. }, Presence::Default(_) | Presence::DefaultChoice(_)) => {
                panic!("{law}.{name}: a list has no default")
            }
            (Kind::Number { .. }, Presence::DefaultChoice(_)) => panic!("{law}.{name}: default is no number"),
            (Kind::Choice(_), Presence::Default(_)) => panic!("{law}.{name}: default is no name"),
            (Kind::Number { .. }, Presence::Default(number)) => {
                assert!(
                    parameter.check(&Value::Number(number)).is_ok(),
                    "{law}.{name}: default out of range"
                );
                assert!(!parameter.symbol.is_empty(), "{law}.{name} has no symbol");
            }
            (Kind::Number { .. } | Kind::Numbers { .. }, _) => {
                assert!(!parameter.symbol.is_empty(), "{law}.{name} has no symbol")
            }
            (Kind::Choice(options), presence) => {
                assert!(options.iter().all(|option| !option.meaning.is_empty()), "{law}.{name}");
                if let Presence::DefaultChoice(default) = presence {
                    assert!(options.iter().any(|option| option.name == default), "{law}.{name}: default");
                }
            }
        }
    }
}

struct Strict<'a, F> {
    entry: &'a LawEntry,
    values: &'a Values,
    build: &'a F,
}

impl<L: std::fmt::Debug, F: Fn(&str, &Values) -> Option<Result<L, InvalidParameter>>> Strict<'_, F> {
    fn built(&self, values: &Values) -> Result<L, InvalidParameter> {
        (self.build)(self.entry.name, values).expect("a listed law")
    }

    fn accepts(&self, values: &Values) {
        if let Err(error) = self.built(values) {
            panic!("{}: the example is refused: {error}", self.entry.name);
        }
    }

    fn refuses(&self, values: &Values, name: &str) {
        match self.built(values) {
            Ok(law) => panic!("{}: {values:?} is accepted as {law:?}", self.entry.name),
            Err(error) => assert_eq!(error.name(), name, "{}: the wrong one is blamed", self.entry.name),
        }
    }

    fn refuses_unknown_names(&self) {
        self.refuses(&self.values.clone().with("no_such_parameter", 1.0), "no_such_parameter");
    }

    fn refuses_missing_parameters(&self) {
        for parameter in self.entry.parameters.iter().filter(|known| known.presence == Presence::Required) {
            let mut values = Values::new();
            for (name, value) in self.values.iter().filter(|(name, _)| *name != parameter.name) {
                values.set(name, value.clone());
            }
            self.refuses(&values, parameter.name);
        }
    }

    fn refuses_what_is_out_of_range(&self) {
        for parameter in self.entry.parameters {
            let name = parameter.name;
            match parameter.kind {
                Kind::Choice(options) => {
                    for option in options {
                        self.accepts(&self.values.clone().with_choice(name, option.name));
                    }
                    self.refuses(&self.values.clone().with_choice(name, "no-such-choice"), name);
                    self.refuses(&self.values.clone().with(name, 1.0), name);
                }
                Kind::Numbers { range, length: (least, most), .. } => {
                    let one = self.values.numbers(name).ok().and_then(|list| list.last().copied());
                    let of = |length: usize, value: f64| vec![value; length];
                    for outside in outside(range, false) {
                        self.refuses(&self.values.clone().with_numbers(name, &of(least, outside)), name);
                    }
                    for length in [least - 1, most + 1] {
                        let list = of(length, one.unwrap_or(1.0));
                        self.refuses(&self.values.clone().with_numbers(name, &list), name);
                    }
                    self.refuses(&self.values.clone().with(name, 1.0), name);
                    self.refuses(&self.values.clone().with_choice(name, "1"), name);
                }
                Kind::Number { range, may_be_infinite, .. } => {
                    for outside in outside(range, may_be_infinite) {
                        self.refuses(&self.values.clone().with(name, outside), name);
                    }
                    self.refuses(&self.values.clone().with_choice(name, "1"), name);
                    if may_be_infinite {
                        self.accepts(&self.values.clone().with(name, f64::INFINITY));
                    }
                }
            }
        }
    }
}

/// Numbers that the range does not hold.
fn outside(range: Range, may_be_infinite: bool) -> Vec<f64> {
    let mut numbers = vec![f64::NAN];
    if !may_be_infinite {
        numbers.push(f64::INFINITY);
    }
    match range {
        Range::Any => {}
        Range::Positive => numbers.extend([0.0, -1.0, f64::NEG_INFINITY]),
        Range::NonNegative => numbers.extend([-1e-300, -1.0, f64::NEG_INFINITY]),
        Range::AtLeast(least) => numbers.extend([least - 1e-9, f64::NEG_INFINITY]),
        Range::Between(from, up_to) => numbers.extend([from - 1e-9, up_to + 1e-9, f64::NEG_INFINITY]),
        Range::Within(above, up_to) => numbers.extend([above, above - 1.0, up_to + 1e-9, f64::NEG_INFINITY]),
    }
    numbers
}
