//! Numbers computed from columns of a time series: `-stress_xy / stress_yy`, `ln(1 / (1 - solid_fraction))`.

use crate::context::Reported;
use crate::problem::Problem;
use crate::reader::TableReader;
use pulvis_math::elementary;

/// A column of a time series, or what is computed from columns row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Expression {
    root: Node,
    columns: Vec<String>,
}

#[derive(Clone, Debug, PartialEq)]
enum Node {
    Number(f64),
    /// Index of the column.
    Column(usize),
    Apply(Function, Box<Node>),
    Combine(Operator, Box<[Node; 2]>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Function {
    Negative,
    Logarithm,
    SquareRoot,
    Absolute,
    /// Of the first row of the run.
    First,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Power,
}

const FUNCTIONS: [(&str, Function); 4] = [
    ("ln", Function::Logarithm),
    ("sqrt", Function::SquareRoot),
    ("abs", Function::Absolute),
    ("first", Function::First),
];

/// Longer than any formula.
const MOST_LETTERS: usize = 1000;

/// Deeper brackets than anybody writes; reading them goes one call deeper for each.
const MOST_BRACKETS: usize = 50;

impl Expression {
    /// Reads numbers, columns, `+ - * / ^`, brackets and the functions ln, sqrt, abs and first. A minus between two names
    /// stands between blanks, since names of walls may have hyphens.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.len() > MOST_LETTERS {
            return Err(format!("has more than {MOST_LETTERS} letters"));
        }
        let mut parser = Parser { rest: text, columns: Vec::new(), depth: 0 };
        let root = parser.sum()?;
        parser.skip_blanks();
        match parser.rest.chars().next() {
            None => Ok(Self { root, columns: parser.columns }),
            Some(_) => Err(format!("does not go on as a formula does at `{}`", parser.rest)),
        }
    }

    /// The columns that it needs, each once.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Its value in a row, which gives the number of each of [`Self::columns`]; `first` gives those of the first row.
    pub fn value(&self, row: &dyn Fn(usize) -> f64, first: &dyn Fn(usize) -> f64) -> f64 {
        self.root.value(row, first)
    }
}

impl Node {
    fn value(&self, row: &dyn Fn(usize) -> f64, first: &dyn Fn(usize) -> f64) -> f64 {
        match self {
            Self::Number(number) => *number,
            Self::Column(column) => row(*column),
            Self::Apply(Function::First, argument) => argument.value(first, first),
            Self::Apply(function, argument) => {
                let argument = argument.value(row, first);
                match function {
                    Function::Negative => -argument,
                    Function::Logarithm => elementary::ln(argument),
                    Function::SquareRoot => argument.sqrt(),
                    Function::Absolute | Function::First => argument.abs(),
                }
            }
            Self::Combine(operator, both) => {
                let [one, other] = [both[0].value(row, first), both[1].value(row, first)];
                match operator {
                    Operator::Plus => one + other,
                    Operator::Minus => one - other,
                    Operator::Times => one * other,
                    Operator::Over => one / other,
                    Operator::Power => elementary::powf(one, other),
                }
            }
        }
    }
}

struct Parser<'t> {
    rest: &'t str,
    columns: Vec<String>,
    depth: usize,
}

impl Parser<'_> {
    fn skip_blanks(&mut self) {
        self.rest = self.rest.trim_start();
    }

    /// Takes one of the signs, if it comes next.
    fn sign(&mut self, signs: &[(char, Operator)]) -> Option<Operator> {
        self.skip_blanks();
        let next = self.rest.chars().next()?;
        let (sign, operator) = signs.iter().find(|(sign, _)| *sign == next)?;
        self.rest = self.rest.strip_prefix(*sign)?;
        Some(*operator)
    }

    fn takes(&mut self, sign: char) -> bool {
        self.sign(&[(sign, Operator::Plus)]).is_some()
    }

    fn sum(&mut self) -> Result<Node, String> {
        let mut sum = self.product()?;
        while let Some(operator) = self.sign(&[('+', Operator::Plus), ('-', Operator::Minus)]) {
            sum = Node::Combine(operator, Box::new([sum, self.product()?]));
        }
        Ok(sum)
    }

    fn product(&mut self) -> Result<Node, String> {
        let mut product = self.factor()?;
        while let Some(operator) = self.sign(&[('*', Operator::Times), ('/', Operator::Over)]) {
            product = Node::Combine(operator, Box::new([product, self.factor()?]));
        }
        Ok(product)
    }

    fn factor(&mut self) -> Result<Node, String> {
        self.depth += 1;
        if self.depth > MOST_BRACKETS {
            return Err(format!("has more than {MOST_BRACKETS} brackets and signs inside one another"));
        }
        let factor = if self.takes('-') {
            Node::Apply(Function::Negative, Box::new(self.factor()?))
        } else {
            let base = self.atom()?;
            if self.takes('^') {
                Node::Combine(Operator::Power, Box::new([base, self.factor()?]))
            } else {
                base
            }
        };
        self.depth -= 1;
        Ok(factor)
    }

    fn atom(&mut self) -> Result<Node, String> {
        if self.takes('(') {
            return self.bracketed();
        }
        self.skip_blanks();
        let name = self.name();
        if name.is_empty() {
            return self.number();
        }
        if !self.takes('(') {
            let known = self.columns.iter().position(|column| *column == name);
            let column = known.unwrap_or(self.columns.len());
            if known.is_none() {
                self.columns.push(name);
            }
            return Ok(Node::Column(column));
        }
        let function = FUNCTIONS.iter().find(|(known, _)| *known == name);
        let (_, function) = function
            .ok_or_else(|| format!("has the function `{name}`; there are ln, sqrt, abs and first"))?;
        Ok(Node::Apply(*function, Box::new(self.bracketed()?)))
    }

    /// What stands before the bracket that closes.
    fn bracketed(&mut self) -> Result<Node, String> {
        let inner = self.sum()?;
        if self.takes(')') { Ok(inner) } else { Err("lacks a `)`".to_owned()) }
    }

    /// Takes a name: letters, digits and underscores, and a hyphen if a letter follows directly.
    fn name(&mut self) -> String {
        let is_part = |place: usize, letter: char| {
            let after = self.rest.get(place + letter.len_utf8()..).and_then(|rest| rest.chars().next());
            let joins = letter == '-' && place > 0 && after.is_some_and(char::is_alphabetic);
            letter.is_alphabetic() || letter == '_' || joins || (place > 0 && letter.is_ascii_digit())
        };
        let end = self.rest.char_indices().find(|(place, letter)| !is_part(*place, *letter));
        let (name, rest) = self.rest.split_at(end.map_or(self.rest.len(), |(place, _)| place));
        self.rest = rest;
        name.to_owned()
    }

    fn number(&mut self) -> Result<Node, String> {
        let text = self.rest;
        let mut end = 0;
        let mut before = ' ';
        for letter in text.chars() {
            let of_exponent = matches!(letter, '+' | '-') && matches!(before, 'e' | 'E');
            if !(letter.is_ascii_digit() || matches!(letter, '.' | 'e' | 'E') || of_exponent) {
                break;
            }
            (end, before) = (end + letter.len_utf8(), letter);
        }
        let (number, rest) = text.split_at(end);
        self.rest = rest;
        let found = if text.is_empty() { "its end".to_owned() } else { format!("`{text}`") };
        let number = number.parse().ok().filter(|number: &f64| number.is_finite());
        number.map(Node::Number).ok_or_else(|| format!("needs a number, a column or a bracket at {found}"))
    }
}

/// The text at `key`, if it is a column or a formula of columns.
pub(super) fn checked(table: &TableReader<'_>, key: &str, text: String) -> Result<String, Reported> {
    match Expression::parse(&text) {
        Ok(_) => Ok(text),
        Err(reason) => {
            let expected =
                "a column, or numbers and columns with + - * / ^, brackets, ln, sqrt, abs or first";
            Err(table.refuse(key, Problem::rule(format!("\"{text}\" {reason}"), expected)))
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    /// The value with a = 3, b = 4 (1 and 2 in the first row).
    fn value(text: &str) -> f64 {
        let expression = Expression::parse(text).expect(text);
        let of = |names: [f64; 2]| {
            let columns = expression.columns().to_vec();
            move |column: usize| if columns[column] == "a" { names[0] } else { names[1] }
        };
        expression.value(&of([3.0, 4.0]), &of([1.0, 2.0]))
    }

    #[test]
    fn powers_bind_before_signs_before_products_before_sums() {
        for (text, expected) in [
            ("a", 3.0),
            ("-a^2 + 2*b", -1.0),
            ("a - b - 1", -2.0),
            ("2^-1", 0.5),
            ("2^a^2 / 2 / 2", 128.0),
            ("sqrt(a*a + b*b) - abs(-5)", 0.0),
            ("1 / (1 - first(a)/b)", 4.0 / 3.0),
            ("first(b) * 1.5e1", 30.0),
            ("ln(b/4)", 0.0),
        ] {
            assert!((value(text) - expected).abs() < 1e-12, "{text}: {}", value(text));
        }
    }

    #[test]
    fn names_of_walls_keep_their_hyphens_and_each_column_is_asked_for_once() {
        let expression = Expression::parse("force_x-high - 2*force_x-high + a1").expect("a formula");
        assert_eq!(expression.columns(), ["force_x-high", "a1"]);
    }

    #[test]
    fn what_is_no_formula_is_refused_with_the_reason() {
        for (text, reason) in [
            ("", "needs a number, a column or a bracket at its end"),
            ("a +", "needs a number, a column or a bracket at its end"),
            ("(a + b", "lacks a `)`"),
            ("sin(a)", "has the function `sin`; there are ln, sqrt, abs and first"),
            ("a b", "does not go on as a formula does at `b`"),
            ("1.2.3", "needs a number, a column or a bracket at `1.2.3`"),
        ] {
            assert_eq!(Expression::parse(text).expect_err(text), reason);
        }
        assert!(Expression::parse(&"(".repeat(400)).is_err() && Expression::parse(&"-".repeat(400)).is_err());
    }
}
