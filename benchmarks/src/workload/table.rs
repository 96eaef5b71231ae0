//! Particles from a plain table.

use std::path::Path;

use pulvis_core::Particle;
use pulvis_math::Vector3;

use super::sphere;
use crate::failure::Failure;

/// Reads a table with the columns x y z r vx vy vz (SI).
pub(super) fn read(path: &Path) -> Result<Vec<Particle>, Failure> {
    let text =
        std::fs::read_to_string(path).map_err(|cause| Failure::Read { path: path.to_owned(), cause })?;
    let mut particles = Vec::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty()) {
        let particle = parse(line).ok_or_else(|| Failure::Line {
            path: path.to_owned(),
            line: number + 1,
            found: format!("`{line}`"),
        })?;
        particles.push(particle);
    }
    if particles.is_empty() {
        return Err(Failure::Empty { path: path.to_owned() });
    }
    Ok(particles)
}

fn parse(line: &str) -> Option<Particle> {
    let numbers: Vec<f64> = line.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let &[x, y, z, radius, vx, vy, vz] = &numbers[..] else { return None };
    let valid = radius > 0.0 && numbers.iter().all(|number| number.is_finite());
    valid.then(|| sphere(Vector3::new(x, y, z), radius, Vector3::new(vx, vy, vz)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

    use super::*;

    #[test]
    fn a_line_is_seven_finite_numbers_with_a_positive_radius() {
        let particle = parse("1e-3 2e-3 3e-3 5e-4 0 -1 0.5").unwrap();
        assert_eq!(particle.position.z, 3e-3);
        assert_eq!(particle.velocity.y, -1.0);
        // 4/3 π 2500 kg/m³ (0.5 mm)³
        assert!((particle.mass / 1.308_996_938_995_747e-6 - 1.0).abs() < 1e-12);
        for wrong in ["1 2 3", "1 2 3 0 0 0 0", "1 2 nan 1 0 0 0", "1 2 3 x 0 0 0", "1 2 3 4 5 6 7 8"] {
            assert!(parse(wrong).is_none(), "{wrong}");
        }
    }
}
