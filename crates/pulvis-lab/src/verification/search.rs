//! Where a quantity of a contact changes, and where it is least.

/// The border between `inside`, where `holds` is true, and `outside`, where it is not, to the last bit; `None` where that
/// is not so at the ends.
pub(super) fn border(inside: f64, outside: f64, holds: impl Fn(f64) -> bool) -> Option<f64> {
    if !holds(inside) || holds(outside) {
        return None;
    }
    let (mut inside, mut outside) = (inside, outside);
    loop {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            return Some(inside);
        }
        if holds(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
}

/// The place and the value of the one minimum between `low` and `high`: golden section.
pub(super) fn lowest(low: f64, high: f64, value: impl Fn(f64) -> f64) -> (f64, f64) {
    let share = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (low, high);
    let inner = |low: f64, high: f64| (high - share * (high - low), low + share * (high - low));
    // 0.618^100 is 1e-21 of the interval.
    for _ in 0..100 {
        let (first, second) = inner(low, high);
        if value(first) < value(second) {
            high = second;
        } else {
            low = first;
        }
    }
    let place = 0.5 * (low + high);
    (place, value(place))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_and_minima_are_found() {
        assert_eq!(border(0.0, 2.0, |x| x * x < 2.0).map(|x| (x - 2.0_f64.sqrt()).abs() < 1e-15), Some(true));
        assert_eq!(border(2.0, 0.0, |x| x * x < 2.0), None);
        let (place, least) = lowest(-1.0, 3.0, |x: f64| (x - 0.7).abs() + 0.2);
        assert!((place - 0.7).abs() < 1e-14 && (least - 0.2).abs() < 1e-14, "{place} {least}");
    }
}
