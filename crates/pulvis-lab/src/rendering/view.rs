//! From where a picture is taken, as a user says it.

use std::str::FromStr;

use pulvis_io::picture::View;

/// From where a picture is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewPoint(pub View);

impl Default for ViewPoint {
    fn default() -> Self {
        Self(View::OBLIQUE)
    }
}

impl FromStr for ViewPoint {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let angles = |text: &str| -> Option<View> {
            let (azimuth, elevation) = text.split_once(',')?;
            let [azimuth, elevation] = [azimuth, elevation].map(|angle| angle.trim().parse::<f64>().ok());
            let (azimuth, elevation) = azimuth.zip(elevation)?;
            let is_angle = azimuth.abs() <= 360.0 && elevation.abs() <= 90.0;
            is_angle.then(|| View::from_angles(azimuth, elevation))
        };
        let view = match text.trim() {
            "x" => View::SIDE,
            "y" => View::FRONT,
            "z" => View::TOP,
            "iso" => View::OBLIQUE,
            other => angles(other).ok_or(
                "expected x (from the right), y (from the front), z (from above), iso, or azimuth and elevation of the eye \
                 in degrees, from -360 to 360 and from -90 to 90, for example \"-60,20\"",
            )?,
        };
        Ok(Self(view))
    }
}

/// A direction of looking, of unit length.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Direction([f64; 3]);

impl Direction {
    pub(super) fn of(view: View) -> Self {
        let length = view.direction.iter().map(|x| x * x).sum::<f64>().sqrt();
        Self(view.direction.map(|x| x / length))
    }

    /// How far a point lies in this direction \[m\].
    pub(super) fn along(self, point: [f64; 3]) -> f64 {
        self.0[0] * point[0] + self.0[1] * point[1] + self.0[2] * point[2]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn views_have_names_or_angles() {
        assert_eq!("y".parse(), Ok(ViewPoint(View::FRONT)));
        assert_eq!(" -90, 0 ".parse(), Ok(ViewPoint(View::from_angles(-90.0, 0.0))));
        for text in ["w", "1", "1,2,3", "0,91", "400,0", "nan,0", "a,b", ""] {
            let found: Result<ViewPoint, _> = text.parse();
            assert!(found.is_err(), "{text}");
        }
    }
}
