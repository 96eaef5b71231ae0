//! The file of a picture.

use std::path::Path;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use pulvis_io::plot::Figure;

use crate::failure::Failure;

/// Refuses a file that exists, or whose ending no format has: before anything is computed, since nobody likes to hear
/// afterwards that there is no place for the picture.
pub fn check(file: &Path, force: bool) -> Result<(), Failure> {
    let ending = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    if !pulvis_io::plot::FORMATS.iter().any(|format| format.extension == ending) {
        let known: Vec<_> = pulvis_io::plot::FORMATS.iter().map(|format| format.extension).collect();
        return Err(Failure::bad_input(format!(
            "{}: no plot format is called `{ending}`; choose one of: {}",
            file.display(),
            known.join(", ")
        )));
    }
    if file.exists() && !force {
        return Err(exists(file));
    }
    Ok(())
}

/// The resolution of pictures in pixels.
#[derive(Debug, Args)]
pub struct Resolution {
    /// Pixels to the inch of a PNG
    #[arg(long, value_name = "N", default_value_t = 144, value_parser = resolution())]
    pub dpi: u32,
}

fn resolution() -> RangedU64ValueParser<u32> {
    let [least, most] = Figure::RESOLUTIONS.map(u64::from);
    RangedU64ValueParser::new().range(least..=most)
}

/// A file stands where output shall go.
pub fn exists(file: &Path) -> Failure {
    Failure::bad_input(format!(
        "{} exists; choose another place, or write over it with --force",
        file.display()
    ))
}
