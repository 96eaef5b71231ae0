//! Changes of texts that keep most of their structure, so that what is wrong lies deep.

use pulvis_testkit::Draw;

/// Choices of one case: every case has its own, whichever cases came before.
pub struct Dice(Draw);

impl Dice {
    pub fn of_case(seed: u64, case: u64) -> Self {
        // No slow run has as many cases.
        Self(Draw::new(seed.wrapping_mul(1 << 32).wrapping_add(case)))
    }

    /// A number below `most`, which must not be zero.
    pub fn below(&mut self, most: usize) -> usize {
        (self.0.unit() * most as f64) as usize
    }

    pub fn pick<'a, T>(&mut self, items: &'a [T]) -> &'a T {
        self.0.one_of(items)
    }
}

/// Values that readers trip over.
const VALUES: &[&str] = &[
    "0",
    "-1",
    "1",
    "2.5",
    "-0.0",
    "1e308",
    "1e309",
    "-1e-320",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "92233720368547758080",
    "0x7fffffffffffffff",
    "1_000_000",
    "true",
    "\"\"",
    "\" \"",
    "\"1 m\"",
    "\"-1 mm\"",
    "\"0 N/m\"",
    "\"1e400 N\"",
    "\"nan m\"",
    "\"inf s\"",
    "\"1e-320 m\"",
    "\"1e300 m\"",
    "\"1 m^9999999999\"",
    "\"1 kg/m/m/m//\"",
    "\"1 µm\"",
    "\"\\u0000\"",
    "\"../../elsewhere\"",
    "\"/\"",
    "\"none\"",
    "\"auto\"",
    "[]",
    "[[]]",
    "[1, 2, 3]",
    "[\"1 m\", \"2 m\", \"3 m\"]",
    "[nan, inf, 0]",
    "{}",
    "{ a = 1 }",
    "1979-05-27T07:32:00Z",
    "'''\ntext\n'''",
    "\"é̂🙂\u{202e}\"",
];

/// Numbers of texts with units.
const NUMBERS: &[&str] = &[
    "0", "-1", "1e-30", "1e30", "1e308", "-1e308", "5e-324", "nan", "inf", "1e", "0x10", "1e999", "0.1",
    "1000000",
];

const JUNK: &[&str] = &["=", "[", "]", "{", "}", "\"", "'", "#", "\n", ",", "\u{feff}", "[[a]]\n"];

/// A text after one change or some; `others` lends lines.
pub fn mutated(text: &str, others: &[String], dice: &mut Dice) -> String {
    let mut text = text.to_owned();
    // Mostly one: what is wrong in several ways is refused for the first of them.
    let changes = [1, 1, 1, 2, 3, 4][dice.below(6)];
    for _ in 0..changes {
        text = match dice.below(12) {
            0..=3 => with_value(&text, dice),
            4 | 5 => with_number(&text, dice),
            6 => with_lines(&text, dice),
            7 => with_key(&text, dice),
            8 => spliced(&text, dice.pick(others).clone(), dice),
            9 => cut(&text, dice),
            10 => with_junk(&text, dice),
            _ => nested(&text, dice),
        };
    }
    text
}

/// Another value behind an equals sign.
fn with_value(text: &str, dice: &mut Dice) -> String {
    let places: Vec<usize> = text.match_indices(" = ").map(|(place, _)| place + 3).collect();
    if places.is_empty() {
        return text.to_owned();
    }
    let place = *dice.pick(&places);
    let rest = &text[place..];
    let end = rest.find(['\n', ',', '}']).unwrap_or(rest.len());
    format!("{}{}{}", &text[..place], dice.pick(VALUES), &rest[end..])
}

/// Another number, where one begins in a text with a unit, a list or a row of a table.
fn with_number(text: &str, dice: &mut Dice) -> String {
    let bytes = text.as_bytes();
    let begins = |place: &usize| {
        let before = place.checked_sub(1).map(|before| bytes[before]);
        bytes[*place].is_ascii_digit()
            && before.is_none_or(|before| !before.is_ascii_alphanumeric() && before != b'.' && before != b'_')
    };
    let places: Vec<usize> = (0..bytes.len()).filter(begins).collect();
    if places.is_empty() {
        return text.to_owned();
    }
    let place = *dice.pick(&places);
    let rest = &text[place..];
    let end = rest.find(|letter: char| !letter.is_ascii_digit() && letter != '.').unwrap_or(rest.len());
    format!("{}{}{}", &text[..place], dice.pick(NUMBERS), &rest[end..])
}

/// A line taken away, doubled, or moved elsewhere.
fn with_lines(text: &str, dice: &mut Dice) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return text.to_owned();
    }
    let (from, to) = (dice.below(lines.len()), dice.below(lines.len()));
    match dice.below(3) {
        0 => drop(lines.remove(from)),
        1 => lines.insert(to, lines[from]),
        _ => lines.swap(from, to),
    }
    lines.join("\n") + "\n"
}

/// A key misspelled, or called as another one.
fn with_key(text: &str, dice: &mut Dice) -> String {
    let keys: Vec<&str> =
        text.lines().filter_map(|line| line.split_once(" = ").map(|(key, _)| key.trim())).collect();
    if keys.is_empty() {
        return text.to_owned();
    }
    let (old, new) = (*dice.pick(&keys), *dice.pick(&keys));
    let new = if dice.below(2) == 0 { new.to_owned() } else { format!("{old}s") };
    text.replacen(&format!("{old} = "), &format!("{new} = "), 1)
}

/// Some lines of another text.
fn spliced(text: &str, other: String, dice: &mut Dice) -> String {
    let (mut lines, others): (Vec<&str>, Vec<&str>) = (text.lines().collect(), other.lines().collect());
    if others.is_empty() {
        return text.to_owned();
    }
    let first = dice.below(others.len());
    let last = (first + 1 + dice.below(6)).min(others.len());
    let place = dice.below(lines.len() + 1);
    lines.splice(place..place, others[first..last].iter().copied());
    lines.join("\n") + "\n"
}

/// Cut off.
fn cut(text: &str, dice: &mut Dice) -> String {
    let places: Vec<usize> = text.char_indices().map(|(place, _)| place).collect();
    if places.is_empty() { String::new() } else { text[..*dice.pick(&places)].to_owned() }
}

/// Something between two characters.
fn with_junk(text: &str, dice: &mut Dice) -> String {
    let places: Vec<usize> = text.char_indices().map(|(place, _)| place).collect();
    let place = if places.is_empty() { 0 } else { *dice.pick(&places) };
    format!("{}{}{}", &text[..place], dice.pick(JUNK).repeat(1 + dice.below(3)), &text[place..])
}

/// A value deep inside others, or very long.
fn nested(text: &str, dice: &mut Dice) -> String {
    let depth = [3, 70, 90, 3000][dice.below(4)];
    let value = match dice.below(4) {
        0 => format!("{}1{}", "[".repeat(depth), "]".repeat(depth)),
        1 => format!("{}1{}", "{ a = ".repeat(depth), " }".repeat(depth)),
        2 => format!("\"{} m\"", "9".repeat(depth)),
        _ => format!("\"1 {}m\"", "m^2*".repeat(depth)),
    };
    let places: Vec<usize> = text.match_indices(" = ").map(|(place, _)| place + 3).collect();
    if places.is_empty() {
        return value;
    }
    let place = *dice.pick(&places);
    let end = text[place..].find('\n').map_or(text.len(), |end| place + end);
    format!("{}{value}{}", &text[..place], &text[end..])
}

/// Bytes after one to four changes.
pub fn mutated_bytes(bytes: &[u8], dice: &mut Dice) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=dice.below(4) {
        if bytes.is_empty() {
            return bytes;
        }
        let place = dice.below(bytes.len());
        match dice.below(5) {
            0 => bytes[place] ^= 1 << dice.below(8),
            1 => bytes[place] = [0, 1, 0x7f, 0x80, 0xff][dice.below(5)],
            2 => bytes.truncate(place),
            3 => drop(bytes.splice(place..place, [0xff, 0xff, 0xff, 0xff, 0x0f])),
            _ => drop(bytes.drain(place..(place + 1 + dice.below(16)).min(bytes.len()))),
        }
    }
    bytes
}
