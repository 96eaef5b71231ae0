//! Which particles a picture leaves out.

use std::str::FromStr;

use pulvis_input::{Dimension, QuantityRule, parse_quantity};

/// Shows particles on one side of a plane only: those whose centre lies there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clip {
    axis: usize,
    side: Side,
    at: Place,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    Below,
    Above,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    /// A coordinate [m].
    Length(f64),
    /// A share of the box around all that would be shown without clips [1].
    Share(f64),
}

impl Clip {
    /// Whether a particle is shown, where `limits` is the box around all that would be shown [m].
    pub(super) fn keeps(&self, centre: [f64; 3], limits: [[f64; 3]; 2]) -> bool {
        let [low, high] = limits.map(|corner| corner[self.axis]);
        let at = match self.at {
            Place::Length(at) => at,
            Place::Share(share) => low + share * (high - low),
        };
        match self.side {
            Side::Below => centre[self.axis] < at,
            Side::Above => centre[self.axis] > at,
        }
    }
}

impl FromStr for Clip {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let refused = |problem: String| {
            format!(
                "{problem}; expected what is to be seen, for example \"y<2 mm\", \"z>0.1 m\" or \"x<50%\""
            )
        };
        let Some((axis, place)) = text.split_once(['<', '>']) else {
            return Err(refused("there is no `<` or `>`".to_owned()));
        };
        let side = if text.as_bytes()[axis.len()] == b'<' { Side::Below } else { Side::Above };
        let axis = axis.trim();
        let Some(axis) = ["x", "y", "z"].iter().position(|known| *known == axis) else {
            return Err(refused(format!("`{axis}` is no axis")));
        };
        let at = match place.trim().strip_suffix('%') {
            Some(share) => {
                let number = share.trim().parse::<f64>().ok().filter(|share| share.is_finite());
                Place::Share(
                    number.ok_or_else(|| refused(format!("`{}` is no number", share.trim())))? / 100.0,
                )
            }
            None => Place::Length(
                parse_quantity(place.trim(), QuantityRule::of(Dimension::LENGTH))
                    .map_err(|error| refused(error.to_string()))?,
            ),
        };
        Ok(Self { axis, side, at })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use super::*;

    #[test]
    fn a_clip_removes_exactly_what_is_beyond() {
        let limits = [[0.0, -1.0, 0.0], [0.01, 1.0, 0.01]];
        let kept = |clip: &str, axis: usize| -> Vec<f64> {
            let clip: Clip = clip.parse().unwrap();
            let centre = |at: f64| std::array::from_fn(|x| if x == axis { at } else { 0.5 });
            [-1.0, -0.5, 0.0, 0.001, 0.002, 0.003, 0.5]
                .into_iter()
                .filter(|&at| clip.keeps(centre(at), limits))
                .collect()
        };
        assert_eq!(kept("x<2 mm", 0), [-1.0, -0.5, 0.0, 0.001]);
        assert_eq!(kept(" z > 2 mm", 2), [0.003, 0.5]);
        assert_eq!(kept("y>50%", 1), [0.001, 0.002, 0.003, 0.5]);
        assert_eq!(kept("y<25 %", 1), [-1.0]);
    }

    #[test]
    fn what_cannot_be_read_says_what_was_found_and_expected() {
        for (text, found) in [
            ("x=2 mm", "there is no `<` or `>`"),
            ("w<2 mm", "`w` is no axis"),
            ("x<2", "has no unit"),
            ("x<2 N", "force"),
            ("x<half%", "`half` is no number"),
        ] {
            let message = Clip::from_str(text).unwrap_err();
            assert!(message.contains(found) && message.contains("expected what is to be seen"), "{message}");
        }
    }
}
