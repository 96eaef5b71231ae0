//! Reads the reference values, and builds the collisions they belong to.

#![allow(dead_code)] // each test file uses a part

use std::collections::BTreeMap;

use pulvis_contact::catalogue::Values;
use pulvis_contact::{ContactLaws, ContactModel, NonContact, Normal, Viscosity};
use pulvis_input::collision::{Bodies, CollisionCase, Method, Sphere};

/// Values of the papers' figures, computed by an independent program branch by branch with 30 digits.
const REFERENCE: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../pulvis-contact/tests/data/luding_reference.csv");

/// One row of the file.
#[derive(Debug)]
pub struct Row {
    cells: BTreeMap<String, String>,
}

impl Row {
    pub fn text(&self, name: &str) -> &str {
        &self.cells[name]
    }

    pub fn number(&self, name: &str) -> f64 {
        self.text(name).parse().unwrap_or_else(|_| panic!("{name} of row {}", self.text("row_id")))
    }

    pub fn value(&self) -> f64 {
        self.number("value")
    }

    pub fn is(&self, figure: &str, quantity: &str) -> bool {
        self.text("figure") == figure && self.text("quantity") == quantity
    }

    pub fn contact(&self) -> ContactModel {
        let interpolation = if self.text("interp") == "sqrt" { "square-root" } else { "linear" };
        let values = Values::new()
            .with("k1", self.number("k1"))
            .with("kp", self.number("kp"))
            .with("kc", self.number("kc"))
            .with("phi_f", self.number("phi_f"))
            .with_choice("interpolation", interpolation);
        let normal = Normal::build("luding", &values).unwrap().unwrap();
        let law = match self.text("noncontact") {
            "irreversible" => "jump-in",
            other => other,
        };
        let attraction = if law == "none" {
            Values::new()
        } else {
            Values::new().with("f_a", self.number("fa")).with("kc_a", self.number("kca"))
        };
        let noncontact = NonContact::build(law, &attraction).unwrap().unwrap();
        let gamma = Values::new().with("gamma_0", self.number("gamma0"));
        let viscosity = Viscosity::build("constant", &gamma).unwrap().unwrap();
        let laws = ContactLaws { noncontact, viscosity, ..ContactLaws::default() };
        ContactModel { normal, laws }
    }

    pub fn bodies(&self) -> Bodies {
        let one = Sphere { radius: self.number("a1"), mass: self.number("m1") };
        if self.text("a2") == "inf" {
            return Bodies::Wall(one);
        }
        Bodies::Pair([one, Sphere { radius: self.number("a2"), mass: self.number("m2") }])
    }

    pub fn case(&self) -> CollisionCase {
        let velocity = self.number("v_inf");
        CollisionCase {
            value: velocity,
            velocity,
            incidence: None,
            bodies: self.bodies(),
            contact: self.contact(),
            contact_number: 0,
            method: Method::Exact,
            surroundings: pulvis_input::Surroundings::default(),
        }
    }

    /// The plastic limit overlap δ_p [m].
    pub fn plastic_limit(&self) -> f64 {
        let Normal::Luding(law) = self.contact().normal else { unreachable!() };
        law.plastic_limit(&self.bodies().pair())
    }

    /// The unit of time √(m_r/k1) [s].
    pub fn time_unit(&self) -> f64 {
        (self.bodies().pair().reduced_mass() / self.number("k1")).sqrt()
    }

    pub fn describe(&self) -> String {
        format!(
            "row {}: figure {}, {}, {} at {} = {}",
            self.text("row_id"),
            self.text("figure"),
            self.text("curve"),
            self.text("quantity"),
            self.text("x_name"),
            self.text("x")
        )
    }
}

/// All rows.
pub fn rows() -> Vec<Row> {
    let text = std::fs::read_to_string(REFERENCE).unwrap();
    let mut lines = text.lines();
    let names: Vec<String> = cells(lines.next().unwrap());
    lines.map(|line| Row { cells: names.iter().cloned().zip(cells(line)).collect() }).collect()
}

/// The cells of a line; some are quoted.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            other => cells.last_mut().unwrap().push(other),
        }
    }
    cells
}
