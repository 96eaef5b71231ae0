//! Numbers of a message in their order.

use pulvis_math::Vector3;
use pulvis_parallel::exchange::ExchangeError;

/// Reads what another rank has written, in the same order.
#[derive(Debug)]
pub(crate) struct Numbers<'a>(&'a [f64]);

type Read<T> = Result<T, ExchangeError>;

impl<'a> Numbers<'a> {
    pub(crate) fn of(message: &'a [f64]) -> Self {
        Self(message)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn next(&mut self) -> Read<f64> {
        self.take(1).map(|one| one[0])
    }

    pub(crate) fn next_index(&mut self) -> Read<usize> {
        self.next().map(|number| number as usize)
    }

    pub(crate) fn next_vector(&mut self) -> Read<Vector3> {
        self.take(3).map(|three| Vector3::new(three[0], three[1], three[2]))
    }

    pub(crate) fn take(&mut self, count: usize) -> Read<&'a [f64]> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or_else(|| ExchangeError {
            reason: format!(
                "a message ends {} numbers too early; are all ranks the same version of the program?",
                count - self.0.len()
            ),
        })?;
        self.0 = rest;
        Ok(taken)
    }
}

/// Appends the components of a vector.
#[inline(always)]
pub(crate) fn tell_vector(vector: Vector3, message: &mut Vec<f64>) {
    message.extend_from_slice(&vector.to_array());
}
