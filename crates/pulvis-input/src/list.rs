//! Lists and vectors of values.

use crate::context::Reported;
use crate::problem::Problem;
use crate::quantity::QuantityRule;
use crate::shape::Shape;
use crate::value_reader::ValueReader;

/// A list whose items all have one shape.
#[derive(Clone, Copy, Debug)]
pub struct List<S> {
    item: S,
    least: usize,
    most: usize,
    single: bool,
}

impl<S> List<S> {
    /// A list of any length, even empty.
    pub const fn of(item: S) -> Self {
        Self { item, least: 0, most: usize::MAX, single: false }
    }

    /// Demands this many items.
    pub fn exactly(self, count: usize) -> Self {
        Self { least: count, most: count, ..self }
    }

    /// Demands at least this many items.
    pub fn at_least(self, count: usize) -> Self {
        Self { least: count, ..self }
    }

    /// Demands at most this many items.
    pub fn at_most(self, count: usize) -> Self {
        Self { most: count, ..self }
    }

    /// Takes a value that stands alone as a list of one.
    pub fn or_single(self) -> Self {
        Self { single: true, ..self }
    }
}

impl<S: Shape> Shape for List<S> {
    type Output = Vec<S::Output>;

    fn describe(&self) -> String {
        let count = match (self.least, self.most) {
            (0, usize::MAX) => String::new(),
            (1, 1) => "1 value: ".to_owned(),
            (least, most) if least == most => format!("{least} values: each "),
            (least, usize::MAX) => format!("{least} or more values: each "),
            (least, most) => format!("{least} to {most} values: each "),
        };
        let list = format!("a list of {count}{}", self.item.describe());
        if self.single { format!("{} or {list}", self.item.describe()) } else { list }
    }

    fn example(&self) -> Option<String> {
        let count = self.least.max(1);
        self.item.example().map(|item| format!("[{}]", vec![item; count].join(", ")))
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<Self::Output, Reported> {
        if self.single && !value.is_list() {
            let item = self.item.read(value)?;
            return match self.least {
                0 | 1 => Ok(vec![item]),
                _ => Err(self.wrong_length(value, 1)),
            };
        }
        let items = value.items(&self.describe())?;
        if !(self.least..=self.most).contains(&items.len()) {
            return Err(self.wrong_length(value, items.len()));
        }
        // First read all, then stop: one run shall report every bad item.
        let read: Vec<_> = items.iter().map(|item| self.item.read(item)).collect();
        read.into_iter().collect()
    }
}

impl<S: Shape> List<S> {
    fn wrong_length(&self, value: &ValueReader<'_>, found: usize) -> Reported {
        value.refuse(Problem::WrongLength { found, expected: self.describe() })
    }
}

/// Three components x, y, z of one dimension, each with its own unit.
#[derive(Clone, Copy, Debug)]
pub struct Vector(QuantityRule);

impl Vector {
    /// A vector whose components follow one rule.
    pub fn of(rule: impl Into<QuantityRule>) -> Self {
        Self(rule.into())
    }

    fn list(&self) -> List<QuantityRule> {
        List::of(self.0).exactly(3)
    }
}

impl Shape for Vector {
    type Output = [f64; 3];

    fn describe(&self) -> String {
        self.list().describe()
    }

    fn example(&self) -> Option<String> {
        self.list().example()
    }

    fn read(&self, value: &ValueReader<'_>) -> Result<[f64; 3], Reported> {
        let components = self.list().read(value)?;
        let found = components.len();
        components.try_into().map_err(|_| self.list().wrong_length(value, found))
    }
}
