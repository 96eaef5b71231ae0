//! Motions in a checkpoint: their names, and their parameters by their keys.

use pulvis_boundary::WallMotion;
use pulvis_boundary::motion::{Parameter, Slot};
use pulvis_core::walls::Wall;
use pulvis_math::Vector3;
use serde::{Deserialize, Serialize};

/// The parameters of a motion by their keys, vectors in three.
pub(super) type Parameters = Vec<(String, f64)>;

/// What cannot be a motion of a wall in this program.
const UNKNOWN: &str = "a wall of it moves in a way that this program does not know";

/// What a motion has to say.
pub(super) fn written(parameters: Vec<Parameter<'_>>) -> Parameters {
    let mut written = Vec::new();
    for parameter in parameters {
        let values = match parameter.value {
            Slot::Number(number) => vec![*number],
            Slot::Vector(vector) => vector.to_array().to_vec(),
        };
        written.extend(values.into_iter().map(|value| (parameter.name.to_owned(), value)));
    }
    written
}

/// Gives a motion the parameters that were written; false where it has others.
pub(super) fn read(parameters: Vec<Parameter<'_>>, written: &[(String, f64)]) -> bool {
    let mut values = written.iter();
    let mut next = |key: &str| values.next().filter(|(name, _)| name == key).map(|(_, value)| *value);
    let mut take = |parameter: Parameter<'_>| {
        match parameter.value {
            Slot::Number(number) => *number = next(parameter.name)?,
            Slot::Vector(vector) => {
                *vector = Vector3::new(next(parameter.name)?, next(parameter.name)?, next(parameter.name)?);
            }
        }
        Some(())
    };
    let all = parameters.into_iter().all(|parameter| take(parameter).is_some());
    all && values.next().is_none()
}

/// A wall that a program has taken in hand, as it was then: the scenario does not tell it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(in crate::protocol) struct LedWall {
    place: u32,
    present: bool,
    motion: String,
    parameters: Parameters,
}

impl LedWall {
    /// The wall at this place in the list of walls.
    pub(in crate::protocol) fn of(place: usize, wall: &Wall) -> Self {
        let mut motion = wall.motion;
        let parameters = written(motion.parameters());
        Self { place: place as u32, present: wall.present, motion: motion.name().to_owned(), parameters }
    }

    /// Its place in the list of walls.
    pub(in crate::protocol) fn place(&self) -> usize {
        self.place as usize
    }

    /// Makes the wall among the walls of a scenario what it was.
    ///
    /// # Errors
    /// There is no such wall, or this program does not know the motion.
    pub(in crate::protocol) fn put_into(&self, walls: &mut [Wall]) -> Result<(), &'static str> {
        let mut motion = WallMotion::named(&self.motion).ok_or(UNKNOWN)?;
        let wall = walls.get_mut(self.place()).ok_or("it has more walls than its scenario")?;
        if !read(motion.parameters(), &self.parameters) {
            return Err(UNKNOWN);
        }
        (wall.motion, wall.present) = (motion, self.present);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn every_motion_comes_back_with_its_parameters_and_another_one_is_refused() {
        for name in WallMotion::NAMES {
            let mut motion = WallMotion::named(name).unwrap();
            for (number, parameter) in motion.parameters().into_iter().enumerate() {
                match parameter.value {
                    Slot::Number(value) => *value = 1.0 / (3.0 + number as f64),
                    Slot::Vector(vector) => *vector = Vector3::new(0.1, -0.0, f64::MIN_POSITIVE),
                }
            }
            let mut wall = Wall::fixed("lid", 0, Vector3::zero(), Vector3::new(0.0, 0.0, 1.0));
            let still = wall.clone();
            (wall.motion, wall.present) = (motion, false);
            let led = LedWall::of(1, &wall);
            let mut walls = vec![still.clone(), still.clone()];
            led.put_into(&mut walls).unwrap();
            assert_eq!(format!("{walls:?}"), format!("{:?}", [still.clone(), wall]), "{name}");
            assert!(led.put_into(&mut [still.clone()]).unwrap_err().contains("more walls"), "{name}");
            let longer =
                LedWall { parameters: [led.parameters.clone(), vec![("x".to_owned(), 1.0)]].concat(), ..led };
            assert_eq!(longer.put_into(&mut walls), Err(UNKNOWN), "{name}");
        }
        let gone = LedWall { place: 0, present: true, motion: "flight".to_owned(), parameters: Vec::new() };
        assert_eq!(gone.put_into(&mut []), Err(UNKNOWN));
    }
}
