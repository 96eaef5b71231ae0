//! `--allow NAME`: refusals that an expert lifts.

use clap::Args;
use clap::builder::PossibleValuesParser;
use pulvis_input::scenario::{Refusal, Scenario};

/// The refusals to lift.
#[derive(Debug, Args)]
pub struct Allowed {
    /// Let pass what is refused otherwise; recorded in run.toml
    #[arg(long = "allow", value_name = "NAME", value_parser = PossibleValuesParser::new(Refusal::NAMES))]
    names: Vec<String>,
}

impl Allowed {
    /// Lifts them in a scenario.
    pub fn apply(&self, scenario: &mut Scenario) {
        let refusals: Vec<Refusal> = self.names.iter().filter_map(|name| Refusal::named(name)).collect();
        scenario.allow(&refusals);
    }
}
