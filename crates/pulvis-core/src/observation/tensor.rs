//! Tensors of rank two in space.

/// Components by row and column.
pub type Tensor = [[f64; 3]; 3];

/// A tensor out of its components.
pub(crate) fn from_fn(component: impl Fn(usize, usize) -> f64) -> Tensor {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| component(row, column)))
}

/// A tensor times a number.
pub(super) fn scaled(tensor: &Tensor, factor: f64) -> Tensor {
    from_fn(|row, column| tensor[row][column] * factor)
}

/// Sum of the diagonal.
pub(crate) fn trace(tensor: &Tensor) -> f64 {
    tensor[0][0] + tensor[1][1] + tensor[2][2]
}

/// Adds `share` times one ⊗ other.
pub(crate) fn add_product(sum: &mut Tensor, one: [f64; 3], other: [f64; 3], share: f64) {
    for (row, one) in sum.iter_mut().zip(one) {
        for (component, other) in row.iter_mut().zip(other) {
            *component += share * one * other;
        }
    }
}

/// A third of the trace: of a stress the pressure.
pub fn pressure(tensor: &Tensor) -> f64 {
    trace(tensor) / 3.0
}

/// √(3/2 s : s) of the symmetric traceless part s: of a stress what von Mises compares.
pub fn deviator(tensor: &Tensor) -> f64 {
    let mean = pressure(tensor);
    let part = from_fn(|row, column| {
        let symmetric = 0.5 * (tensor[row][column] + tensor[column][row]);
        symmetric - if row == column { mean } else { 0.0 }
    });
    (1.5 * part.iter().flatten().map(|component| component * component).sum::<f64>()).sqrt()
}

/// Eigenvalues of the symmetric part, the largest first; NaN if a component is not finite. By Jacobi rotations (Golub, Van
/// Loan, Matrix Computations, sec. 8.5.2).
pub fn eigenvalues(tensor: &Tensor) -> [f64; 3] {
    if !tensor.iter().flatten().all(|component| component.is_finite()) {
        return [f64::NAN; 3];
    }
    let mut matrix = from_fn(|row, column| 0.5 * (tensor[row][column] + tensor[column][row]));
    // Convergence is quadratic: a handful of sweeps is enough for all bits.
    for _ in 0..16 {
        let off = [(0, 1), (0, 2), (1, 2)].map(|(row, column)| matrix[row][column].abs());
        if off.iter().sum::<f64>() == 0.0 {
            break;
        }
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut matrix, p, q);
        }
    }
    let mut values = [matrix[0][0], matrix[1][1], matrix[2][2]];
    values.sort_by(|one, other| other.total_cmp(one));
    values
}

/// The rotation in the plane of two axes that makes their common component zero.
fn rotate(matrix: &mut Tensor, p: usize, q: usize) {
    let off = matrix[p][q];
    if off == 0.0 {
        return;
    }
    let theta = (matrix[q][q] - matrix[p][p]) / (2.0 * off);
    let tangent = if theta.is_finite() {
        let sign = if theta < 0.0 { -1.0 } else { 1.0 };
        sign / (theta.abs() + (theta * theta + 1.0).sqrt())
    } else {
        0.0
    };
    let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
    let sine = tangent * cosine;
    matrix[p][p] -= tangent * off;
    matrix[q][q] += tangent * off;
    matrix[p][q] = 0.0;
    matrix[q][p] = 0.0;
    let other = 3 - p - q;
    let (at_p, at_q) = (matrix[other][p], matrix[other][q]);
    matrix[other][p] = cosine * at_p - sine * at_q;
    matrix[other][q] = sine * at_p + cosine * at_q;
    matrix[p][other] = matrix[other][p];
    matrix[q][other] = matrix[other][q];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_of_a_rotated_diagonal_are_those_of_the_diagonal() {
        // 3, 2, -5 along (1, 1, 0)/√2, (1, -1, 0)/√2, z; then turned about x by the angle of 3-4-5.
        let axes = [[1.0, 0.8 * 1.0, 0.6 * 1.0], [1.0, -0.8, -0.6], [0.0, -0.6, 0.8]];
        let mut matrix = [[0.0; 3]; 3];
        for (axis, value) in axes.into_iter().zip([1.5, 1.0, -5.0]) {
            add_product(&mut matrix, axis, axis, value);
        }
        let values = eigenvalues(&matrix);
        for (value, expected) in values.into_iter().zip([3.0, 2.0, -5.0]) {
            assert!((value - expected).abs() < 1e-14, "{values:?}");
        }
        assert_eq!(eigenvalues(&[[2.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, -1.0]]), [7.0, 2.0, -1.0]);
        assert!(eigenvalues(&[[f64::NAN; 3]; 3]).iter().all(|value| value.is_nan()));
    }

    #[test]
    fn a_uniaxial_stress_is_three_times_its_pressure_and_its_own_deviator() {
        let mut stress = [[0.0; 3]; 3];
        stress[2][2] = 6.0;
        assert_eq!((pressure(&stress), deviator(&stress)), (2.0, 6.0));
        // Simple shear: q = √3 τ.
        let shear = [[4.0, 1.0, 0.0], [1.0, 4.0, 0.0], [0.0, 0.0, 4.0]];
        assert!((deviator(&shear) - 3.0_f64.sqrt()).abs() < 1e-15);
    }
}
