//! A temperature that changes with time.

/// The temperature of everything over time: straight between the points of a program, constant before the first one and
/// after the last.
#[derive(Clone, Debug, PartialEq)]
pub struct TemperatureProgram {
    /// Times [s], growing, and temperatures [K], positive; at least one.
    points: Vec<(f64, f64)>,
}

/// Why points make no program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InvalidProgram {
    /// There is no point.
    Empty,
    /// The time of this point is not after that of the one before, or not finite.
    Time(usize),
    /// The temperature of this point is not positive and finite.
    Temperature(usize),
}

impl TemperatureProgram {
    /// The program through points of time [s] and temperature [K].
    ///
    /// # Errors
    /// There is no point, times do not grow, or a temperature is not above absolute zero.
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, InvalidProgram> {
        let mut before = f64::NEG_INFINITY;
        for (index, &(time, temperature)) in points.iter().enumerate() {
            let grows = time > before && time.is_finite();
            if !grows {
                return Err(InvalidProgram::Time(index));
            }
            let positive = temperature > 0.0 && temperature.is_finite();
            if !positive {
                return Err(InvalidProgram::Temperature(index));
            }
            before = time;
        }
        if points.is_empty() { Err(InvalidProgram::Empty) } else { Ok(Self { points }) }
    }

    /// The points: times [s] and temperatures [K].
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The temperature at a time [K].
    pub fn at(&self, time: f64) -> f64 {
        let next = self.points.partition_point(|(point, _)| *point <= time);
        let of = |index: usize| self.points.get(index).copied();
        match (next.checked_sub(1).and_then(of), of(next)) {
            (Some((start, from)), Some((end, to))) => from + (to - from) * ((time - start) / (end - start)),
            (Some((_, temperature)), None) | (None, Some((_, temperature))) => temperature,
            // There is at least one point.
            (None, None) => f64::NAN,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn temperatures_are_straight_between_points_and_constant_outside() {
        let program = TemperatureProgram::new(vec![(0.0, 300.0), (1e-3, 505.0), (2e-3, 405.0)]);
        let at = |time: f64| program.as_ref().map(|program| program.at(time));
        for (time, temperature) in
            [(-1.0, 300.0), (0.0, 300.0), (0.5e-3, 402.5), (1e-3, 505.0), (1.5e-3, 455.0), (9.0, 405.0)]
        {
            assert_eq!(at(time), Ok(temperature), "{time} s");
        }
        let constant = TemperatureProgram::new(vec![(0.0, 300.0)]).map(|program| program.at(7.0));
        assert_eq!(constant, Ok(300.0));
    }

    #[test]
    fn points_that_make_no_program_are_refused() {
        let refused = |points: &[(f64, f64)]| TemperatureProgram::new(points.to_vec()).err();
        assert_eq!(refused(&[]), Some(InvalidProgram::Empty));
        assert_eq!(refused(&[(0.0, 300.0), (0.0, 310.0)]), Some(InvalidProgram::Time(1)));
        assert_eq!(refused(&[(f64::NAN, 300.0)]), Some(InvalidProgram::Time(0)));
        assert_eq!(refused(&[(0.0, 300.0), (1.0, 0.0)]), Some(InvalidProgram::Temperature(1)));
        assert_eq!(refused(&[(0.0, f64::INFINITY)]), Some(InvalidProgram::Temperature(0)));
    }
}
