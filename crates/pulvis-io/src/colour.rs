//! Colours and colour maps.

/// A colour of the screen (sRGB).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour {
    /// Red, 0 to 255.
    pub red: u8,
    /// Green, 0 to 255.
    pub green: u8,
    /// Blue, 0 to 255.
    pub blue: u8,
}

impl Colour {
    pub(crate) const WHITE: Self = Self::new(255, 255, 255);

    /// A colour from its three parts.
    pub const fn new(red: u8, green: u8, blue: u8) -> Self {
        Self { red, green, blue }
    }

    /// A shade of grey, 0 (black) to 255 (white).
    pub const fn grey(shade: u8) -> Self {
        Self::new(shade, shade, shade)
    }

    /// Colour `number` of the palette of Okabe and Ito (2008, "Color universal design"), which readers with any colour
    /// vision can tell apart; its yellow is left out since it vanishes on paper. Repeats after seven.
    pub fn palette(number: usize) -> Self {
        const PALETTE: [Colour; 7] = [
            Colour::new(0x00, 0x72, 0xB2),
            Colour::new(0xD5, 0x5E, 0x00),
            Colour::new(0x00, 0x9E, 0x73),
            Colour::new(0xCC, 0x79, 0xA7),
            Colour::new(0xE6, 0x9F, 0x00),
            Colour::new(0x56, 0xB4, 0xE9),
            Colour::new(0x30, 0x30, 0x30),
        ];
        PALETTE[number % PALETTE.len()]
    }

    fn mix(self, other: Self, share: f64) -> Self {
        let part = |a: u8, b: u8| (f64::from(a) + share * (f64::from(b) - f64::from(a))).round() as u8;
        Self::new(part(self.red, other.red), part(self.green, other.green), part(self.blue, other.blue))
    }
}

/// A way from numbers to colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum ColourMap {
    /// Viridis (S. van der Walt and N. Smith 2015, public domain): even steps look even, also in grey and to the
    /// colour-blind. For quantities that have an order.
    #[default]
    Viridis,
    /// Blue over light grey to red, for quantities with a sign; give a symmetric range.
    BlueRed,
}

impl ColourMap {
    /// Colour at `share` of the range: 0 the low end, 1 the high end; grey for not-a-number.
    pub fn at(self, share: f64) -> Colour {
        if share.is_nan() {
            return Colour::grey(0xB0);
        }
        let stops = self.stops();
        let place = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
        let below = (place.floor() as usize).min(stops.len() - 2);
        stops[below].mix(stops[below + 1], place - below as f64)
    }

    /// Colours at even distances; linear mixing between them is off by less than two of 255 steps.
    fn stops(self) -> &'static [Colour] {
        const VIRIDIS: [Colour; 17] = [
            Colour::new(68, 1, 84),
            Colour::new(72, 24, 106),
            Colour::new(71, 45, 123),
            Colour::new(66, 64, 134),
            Colour::new(59, 82, 139),
            Colour::new(51, 99, 141),
            Colour::new(44, 114, 142),
            Colour::new(38, 130, 142),
            Colour::new(33, 145, 140),
            Colour::new(31, 160, 136),
            Colour::new(40, 174, 128),
            Colour::new(63, 188, 115),
            Colour::new(94, 201, 98),
            Colour::new(132, 212, 75),
            Colour::new(173, 220, 48),
            Colour::new(216, 226, 25),
            Colour::new(253, 231, 37),
        ];
        const BLUE_RED: [Colour; 5] = [
            Colour::new(0x05, 0x3A, 0x7A),
            Colour::new(0x56, 0x9B, 0xD0),
            Colour::new(0xEE, 0xEE, 0xEE),
            Colour::new(0xDE, 0x7A, 0x5C),
            Colour::new(0x8A, 0x0C, 0x25),
        ];
        match self {
            Self::Viridis => &VIRIDIS,
            Self::BlueRed => &BLUE_RED,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_map_ends_where_it_should_and_bears_strange_numbers() {
        assert_eq!(ColourMap::Viridis.at(0.0), Colour::new(68, 1, 84));
        assert_eq!(ColourMap::Viridis.at(f64::INFINITY), Colour::new(253, 231, 37));
        assert_eq!(ColourMap::BlueRed.at(0.5), Colour::grey(0xEE));
        assert_eq!(ColourMap::Viridis.at(f64::NAN), Colour::grey(0xB0));
    }
}
