//! Oscillations of two bodies about their contact, whose frequency is known.

use std::f64::consts::PI;

use crate::bodies::Couple;

/// Angular frequency of the oscillation of `coordinate`, from its first and its twenty-first zero in
/// the upward direction [rad/s].
fn frequency(couple: &mut Couple, dt: f64, coordinate: impl Fn(&Couple) -> f64) -> f64 {
    let mut crossings = Vec::new();
    let (mut before, mut time) = (coordinate(couple), 0.0);
    while crossings.len() < 21 {
        couple.step(dt);
        let now = coordinate(couple);
        if before < 0.0 && now >= 0.0 {
            crossings.push(time + dt * before / (before - now));
        }
        (before, time) = (now, time + dt);
        // At a hundred steps a period.
        assert!(time < 1e4 * dt, "no oscillation");
    }
    2.0 * PI * 20.0 / (crossings[20] - crossings[0])
}

/// Checks an oscillation's frequency at two steps: second order, and right when extrapolated.
pub fn oscillates_at(expected: f64, start: impl Fn() -> Couple, coordinate: impl Fn(&Couple) -> f64 + Copy) {
    let period = 2.0 * PI / expected;
    let [coarse, fine] =
        [50.0, 100.0].map(|steps| frequency(&mut start(), period / steps, coordinate) / expected - 1.0);
    // Velocity-Verlet is fast by (ω dt)²/24.
    let leading = (2.0 * PI / 50.0) * (2.0 * PI / 50.0) / 24.0;
    assert!((coarse / leading - 1.0).abs() < 0.05, "{coarse}, expected {leading}");
    assert!((coarse / fine - 4.0).abs() < 0.1, "{coarse} falls to {fine}");
    // Left over: the next order, (ω dt)⁴, 1e-6, and the overlap 1e-7 of the radius.
    assert!((fine - 0.25 * leading).abs() < 2e-6, "{fine}");
}
