//! Columns of numbers as bytes: all first bytes of the numbers, then all second ones, and so on.
//!
//! Signs and exponents of neighbours are alike and digits are not. Side by side, the former are compressed away.

use serde::de::{Error, Visitor};
use serde::{Deserializer, Serializer};
use std::fmt;
use std::marker::PhantomData;

/// Something of a fixed number of bytes.
pub(super) trait Fixed: Copy {
    /// How many.
    const WIDTH: usize;
    /// Puts them, little endian, into as many bytes.
    fn put(self, bytes: &mut [u8]);
    /// From as many bytes; `None` where no value has them.
    fn take(bytes: &[u8]) -> Option<Self>;
}

macro_rules! fixed_number {
    ($($number:ty),*) => {$(
        impl Fixed for $number {
            const WIDTH: usize = size_of::<$number>();

            fn put(self, bytes: &mut [u8]) {
                bytes.copy_from_slice(&self.to_le_bytes());
            }

            fn take(bytes: &[u8]) -> Option<Self> {
                bytes.try_into().ok().map(<$number>::from_le_bytes)
            }
        }
    )*};
}

fixed_number!(f64, u32, u16);

impl Fixed for bool {
    const WIDTH: usize = 1;

    fn put(self, bytes: &mut [u8]) {
        bytes[0] = u8::from(self);
    }

    fn take(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0] => Some(false),
            [1] => Some(true),
            _ => None,
        }
    }
}

impl Fixed for [f64; 3] {
    const WIDTH: usize = 24;

    fn put(self, bytes: &mut [u8]) {
        bytes.chunks_exact_mut(8).zip(self).for_each(|(bytes, value)| value.put(bytes));
    }

    fn take(bytes: &[u8]) -> Option<Self> {
        let mut vector = [0.0; 3];
        for (value, bytes) in vector.iter_mut().zip(bytes.chunks_exact(8)) {
            *value = f64::take(bytes)?;
        }
        Some(vector)
    }
}

/// The widest of all.
const WIDEST: usize = 24;

pub(super) fn serialize<T: Fixed, S: Serializer>(values: &[T], serializer: S) -> Result<S::Ok, S::Error> {
    let count = values.len();
    let mut planes = vec![0; count * T::WIDTH];
    let mut bytes = [0; WIDEST];
    for (index, value) in values.iter().enumerate() {
        value.put(&mut bytes[..T::WIDTH]);
        for (plane, &byte) in bytes[..T::WIDTH].iter().enumerate() {
            planes[plane * count + index] = byte;
        }
    }
    serializer.serialize_bytes(&planes)
}

pub(super) fn deserialize<'de, T: Fixed, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<T>, D::Error> {
    deserializer.deserialize_bytes(Planes(PhantomData))
}

struct Planes<T>(PhantomData<T>);

impl<T: Fixed> Visitor<'_> for Planes<T> {
    type Value = Vec<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{} planes of bytes", T::WIDTH)
    }

    fn visit_bytes<E: Error>(self, planes: &[u8]) -> Result<Vec<T>, E> {
        if !planes.len().is_multiple_of(T::WIDTH) {
            return Err(E::invalid_length(planes.len(), &self));
        }
        let count = planes.len() / T::WIDTH;
        let mut bytes = [0; WIDEST];
        let value = |index: usize| {
            for (plane, byte) in bytes[..T::WIDTH].iter_mut().enumerate() {
                *byte = planes[plane * count + index];
            }
            T::take(&bytes[..T::WIDTH])
        };
        (0..count).map(value).collect::<Option<_>>().ok_or_else(|| E::custom("a byte that no value has"))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]
    use serde::{Deserialize, Serialize};

    #[derive(Debug, Serialize, Deserialize)]
    struct Columns {
        #[serde(with = "super")]
        vectors: Vec<[f64; 3]>,
        #[serde(with = "super")]
        numbers: Vec<u16>,
        #[serde(with = "super")]
        flags: Vec<bool>,
    }

    #[test]
    fn every_bit_comes_back_and_bytes_that_are_no_values_are_refused() {
        let special = [0.0, -0.0, f64::NAN, f64::INFINITY, 5e-324, -1.0 / 3.0];
        let vectors: Vec<[f64; 3]> = (0..6).map(|index| [special[index], special[5 - index], 7.0]).collect();
        let columns = Columns { vectors, numbers: vec![0, 256, 65_535], flags: vec![true, false] };
        let bytes = postcard::to_stdvec(&columns).unwrap();
        let back: Columns = postcard::from_bytes(&bytes).unwrap();
        let bits = |vectors: &[[f64; 3]]| -> Vec<u64> {
            vectors.iter().flatten().map(|value| value.to_bits()).collect()
        };
        assert_eq!(bits(&back.vectors), bits(&columns.vectors));
        assert_eq!((back.numbers, back.flags), (columns.numbers, columns.flags));
        let mut wrong = bytes.clone();
        *wrong.last_mut().unwrap() = 2;
        assert!(postcard::from_bytes::<Columns>(&wrong).is_err(), "2 is neither true nor false");
        // 145 bytes are no vectors.
        let odd = [&[145, 1][..], &[0; 150]].concat();
        assert!(postcard::from_bytes::<Columns>(&odd).is_err());
    }
}
