//! Reading one value.

use crate::context::{Context, Location, Reported};
use crate::overrides::{Copied, Replacement};
use crate::problem::Problem;
use crate::reader::TableReader;
use crate::shape::Shape;
use crate::value::{Node, Value};

/// One value being read.
pub struct ValueReader<'d> {
    context: &'d Context<'d>,
    node: &'d Node,
    path: String,
}

impl<'d> ValueReader<'d> {
    pub(crate) fn new(context: &'d Context<'d>, node: &'d Node, path: String) -> Self {
        Self { context, node, path }
    }

    /// The dotted path of this value.
    pub fn path(&self) -> &str {
        &self.path
    }

    pub(crate) fn raw(&self) -> &'d Value {
        &self.node.value
    }

    /// Reads the value in a given shape.
    ///
    /// # Errors
    /// It is of another shape; that has been reported.
    pub fn read<S: Shape>(&self, shape: S) -> Result<S::Output, Reported> {
        shape.read(self)
    }

    /// Whether this is a table, for keys that hold either a value or a table.
    pub fn is_table(&self) -> bool {
        matches!(self.node.value, Value::Table(_))
    }

    /// Whether this is a list.
    pub fn is_list(&self) -> bool {
        matches!(self.node.value, Value::List(_))
    }

    /// The text, if this is one.
    pub fn text(&self) -> Option<&'d str> {
        match &self.node.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Reads the value as a table.
    ///
    /// # Errors
    /// It is none; that has been reported.
    pub fn table(&self) -> Result<TableReader<'d>, Reported> {
        match &self.node.value {
            Value::Table(table) => {
                Ok(TableReader::new(self.context, table, self.path.clone(), self.node.span.clone()))
            }
            _ => Err(self.wrong_type("a table")),
        }
    }

    /// The items of a list; `expected` says what the list should hold.
    ///
    /// # Errors
    /// It is no list; that has been reported.
    pub fn items(&self, expected: &str) -> Result<Vec<ValueReader<'d>>, Reported> {
        let Value::List(items) = &self.node.value else { return Err(self.wrong_type(expected)) };
        let reader = |(index, node): (usize, &'d Node)| ValueReader {
            context: self.context,
            node,
            path: format!("{}[{index}]", self.path),
        };
        Ok(items.iter().enumerate().map(reader).collect())
    }

    /// This value as a replacement for another one of the same file, see
    /// [`crate::Document::with_override`]; errors will point here.
    pub fn replacement(&self) -> Replacement {
        Replacement::Copied(Copied(self.node.clone()))
    }

    /// The place of this value.
    pub fn location(&self) -> Location {
        Location { span: self.node.span.clone(), path: self.path.clone(), replaced: self.node.replaced }
    }

    /// Reports a mistake at this value.
    pub fn refuse(&self, problem: Problem) -> Reported {
        self.context.report(&self.location(), problem, None)
    }

    /// Reports that this value is of another kind than expected.
    pub fn wrong_type(&self, expected: &str) -> Reported {
        self.refuse(Problem::WrongType { found: self.node.found(), expected: expected.to_owned() })
    }
}
