//! What pictures are asked for.

use std::str::FromStr;

use pulvis_io::picture::{Paper, Projection};

use super::clip::Clip;
use super::quantity::Quantity;
use super::view::ViewPoint;

/// Which frames of a run become pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrameChoice {
    /// The one of this number, from 0.
    Number(usize),
    /// The one of this time \[s\].
    Time(f64),
    /// The last one.
    Last,
    /// Every one.
    All,
}

impl FromStr for FrameChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "last" => Ok(Self::Last),
            "all" => Ok(Self::All),
            number => number
                .parse()
                .map(Self::Number)
                .map_err(|_| "expected the number of a frame from 0, `last` or `all`".to_owned()),
        }
    }
}

/// What pictures are asked for.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Which frames.
    pub frames: FrameChoice,
    /// What particles are coloured by; `None` for their material where there are several, else their contacts, or with
    /// contacts for none.
    pub colour: Option<Quantity>,
    /// Whether contacts are shown as tubes, and particles small.
    pub contacts: bool,
    /// From where.
    pub view: ViewPoint,
    /// Whether what is farther looks smaller.
    pub projection: Projection,
    /// Width and height \[pixel\].
    pub size: [u32; 2],
    /// What is left out.
    pub clips: Vec<Clip>,
    /// Colours around the scene.
    pub paper: Paper,
    /// Pictures per second of a film \[1/s\].
    pub per_second: u16,
    /// Threads that draw; no pixel depends on their number.
    pub threads: usize,
}

impl Default for Plan {
    /// The last frame from the front, the right and above, 1200 x 900 pixels.
    fn default() -> Self {
        Self {
            frames: FrameChoice::Last,
            colour: None,
            contacts: false,
            view: ViewPoint::default(),
            projection: Projection::Perspective,
            size: [1200, 900],
            clips: Vec::new(),
            paper: Paper::White,
            per_second: 10,
            threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
        }
    }
}

/// What the colours of a picture stand for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Paints {
    /// A quantity of the particles.
    Particles(Quantity),
    /// Normal forces of the contacts; particles are grey.
    Forces,
}
