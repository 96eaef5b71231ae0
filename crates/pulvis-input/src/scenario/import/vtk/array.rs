//! The numbers of an array: text, base64 or bytes, compressed or not.
//!
//! # Source
//! VTK documentation, "VTK XML file formats": an array that is not compressed is its length [byte] and its numbers, in base64 one
//! text. A compressed one is a header (number of blocks, bytes of a block, bytes of a last block that is not full, bytes of each
//! compressed block) and the blocks; in base64 header and blocks are texts of their own.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::read::ZlibDecoder;
use std::borrow::Cow;
use std::io::Read;

/// What the whole file has in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoding {
    /// Bytes of a number of a header: 4 or 8.
    pub(super) header: usize,
    /// Whether zlib has compressed the arrays.
    pub(super) compressed: bool,
}

/// Where the numbers stand.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stored<'a> {
    /// As decimals.
    Text(&'a [u8]),
    /// As base64, from here on.
    Base64(&'a [u8]),
    /// As bytes, from here on.
    Bytes(&'a [u8]),
}

/// The numbers of an array of so many, of the type that VTK calls `kind`.
pub(super) fn numbers(
    stored: Stored<'_>,
    encoding: Encoding,
    kind: &str,
    count: usize,
) -> Result<Vec<f64>, String> {
    let (width, convert) = type_of(kind)?;
    if let Stored::Text(text) = stored {
        return decimals(text, count);
    }
    let expected = count.checked_mul(width).ok_or_else(|| format!("has {count} numbers"))?;
    let bytes = if encoding.compressed {
        inflated(stored, encoding.header, expected)?
    } else {
        let length = number(&take(stored, 0, encoding.header)?.0, encoding.header, 0);
        announced(length, expected)?;
        let (bytes, _) = take(stored, 0, expected.saturating_add(encoding.header))?;
        bytes[encoding.header..].to_vec()
    };
    Ok(bytes.chunks_exact(width).map(convert).collect())
}

/// Makes a number of its bytes.
type Convert = fn(&[u8]) -> f64;

/// Bytes of a number, and what makes one of them.
fn type_of(kind: &str) -> Result<(usize, Convert), String> {
    /// The first bytes, of which there are enough.
    fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
        bytes.first_chunk().copied().unwrap_or([0; N])
    }
    #[allow(clippy::cast_precision_loss)] // numbers of materials are small
    Ok(match kind {
        "Float64" => (8, |bytes| f64::from_le_bytes(first(bytes))),
        "Float32" => (4, |bytes| f32::from_le_bytes(first(bytes)).into()),
        "Int64" => (8, |bytes| i64::from_le_bytes(first(bytes)) as f64),
        "UInt64" => (8, |bytes| u64::from_le_bytes(first(bytes)) as f64),
        "Int32" => (4, |bytes| i32::from_le_bytes(first(bytes)).into()),
        "UInt32" => (4, |bytes| u32::from_le_bytes(first(bytes)).into()),
        "Int16" => (2, |bytes| i16::from_le_bytes(first(bytes)).into()),
        "UInt16" => (2, |bytes| u16::from_le_bytes(first(bytes)).into()),
        "Int8" => (1, |bytes| i8::from_le_bytes(first(bytes)).into()),
        "UInt8" => (1, |bytes| first::<1>(bytes)[0].into()),
        other => return Err(format!("has numbers of the type {other:?}; expected one like Float64")),
    })
}

fn decimals(text: &[u8], count: usize) -> Result<Vec<f64>, String> {
    let text = std::str::from_utf8(text).map_err(|_| "is no text".to_owned())?;
    let number = |word: &str| word.parse::<f64>().map_err(|_| format!("has {word:?}; expected a number"));
    let numbers = text.split_ascii_whitespace().map(number).collect::<Result<Vec<_>, _>>()?;
    if numbers.len() != count {
        return Err(format!("has {} numbers; expected {count}", numbers.len()));
    }
    Ok(numbers)
}

/// Bytes from a position on, and where what follows begins.
fn take(stored: Stored<'_>, at: usize, count: usize) -> Result<(Cow<'_, [u8]>, usize), String> {
    let breaks_off = || format!("breaks off: {count} bytes should follow");
    match stored {
        Stored::Text(_) => Err("has no bytes".to_owned()),
        Stored::Bytes(bytes) => {
            let end = at.saturating_add(count);
            Ok((Cow::Borrowed(bytes.get(at..end).ok_or_else(breaks_off)?), end))
        }
        Stored::Base64(text) => {
            let end = at.saturating_add(count.div_ceil(3).saturating_mul(4));
            let text = text.get(at..end).ok_or_else(breaks_off)?;
            let mut bytes = STANDARD.decode(text).map_err(|error| format!("is no base64 text: {error}"))?;
            if bytes.len() < count {
                return Err(breaks_off());
            }
            bytes.truncate(count);
            Ok((Cow::Owned(bytes), end))
        }
    }
}

/// A number of a header; one that no memory can hold is as good as the largest.
fn number(bytes: &[u8], width: usize, index: usize) -> usize {
    let word = bytes.chunks_exact(width).nth(index).unwrap_or_default();
    let value = word.iter().rev().fold(0_u64, |value, &byte| value << 8 | u64::from(byte));
    usize::try_from(value).unwrap_or(usize::MAX)
}

fn announced(found: usize, expected: usize) -> Result<(), String> {
    if found == expected {
        return Ok(());
    }
    Err(format!("announces {found} bytes; expected {expected}, as there are particles"))
}

/// The bytes of a compressed array.
fn inflated(stored: Stored<'_>, width: usize, expected: usize) -> Result<Vec<u8>, String> {
    let blocks = number(&take(stored, 0, width)?.0, width, 0);
    let (header, data) = take(stored, 0, blocks.saturating_add(3).saturating_mul(width))?;
    let (full, last) = (number(&header, width, 1), number(&header, width, 2));
    let length = |block: usize| if block + 1 == blocks && last > 0 { last } else { full };
    let total = (0..blocks).fold(0_usize, |total, block| total.saturating_add(length(block)));
    announced(total, expected)?;
    let sizes: Vec<usize> = (0..blocks).map(|block| number(&header, width, 3 + block)).collect();
    let (packed, _) = take(stored, data, sizes.iter().fold(0, |sum: usize, &size| sum.saturating_add(size)))?;
    let (mut bytes, mut at) = (Vec::new(), 0);
    for (block, size) in sizes.into_iter().enumerate() {
        // No more than is announced, whatever is in it; the checksum stands behind the last byte.
        let most = (length(block) as u64).saturating_add(1);
        let mut decoder = ZlibDecoder::new(&packed[at..at + size]).take(most);
        let found = decoder.read_to_end(&mut bytes);
        let found = found.map_err(|error| format!("cannot be unpacked in block {block}: {error}"))?;
        announced(found, length(block))?;
        at += size;
    }
    Ok(bytes)
}
