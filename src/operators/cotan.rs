//! The cotangent stiffness matrix: L_ij = -Σ ½ cot θ over the angles θ opposite the edges i j, L_ii = -Σ L_ij.
//!
//! L is positive semidefinite: uᵀ L u = ∫ |∇u|².

use crate::metric::{Metric, cotangents};
use nalgebra_sparse::{CooMatrix, CscMatrix};

/// Half the cotangent of the angle opposite each half-edge.
pub(super) fn half_cotangents(metric: &Metric) -> Vec<[f64; 3]> {
    let weighted = |(f, &lengths)| cotangents(lengths).map(|cot| metric.weight(f) / 2.0 * cot);
    metric.lengths.iter().enumerate().map(weighted).collect()
}

/// The lower triangle of L, with every diagonal entry.
pub(super) fn stiffness(metric: &Metric, half_cotangents: &[[f64; 3]], vertex_count: usize) -> CscMatrix<f64> {
    let mut diagonal = vec![0.0; vertex_count];
    let entries = 3 * metric.triangles.len() + vertex_count;
    let [mut rows, mut columns] = [(); 2].map(|()| Vec::with_capacity(entries));
    let mut values = Vec::with_capacity(entries);
    for (triangle, weights) in metric.triangles.iter().zip(half_cotangents) {
        for k in 0..3 {
            let (i, j) = (triangle[k] as usize, triangle[(k + 1) % 3] as usize);
            // An edge from a vertex to itself has no difference to weigh.
            if i != j {
                diagonal[i] += weights[k];
                diagonal[j] += weights[k];
                rows.push(i.max(j));
                columns.push(i.min(j));
                values.push(-weights[k]);
            }
        }
    }
    rows.extend(0..vertex_count);
    columns.extend(0..vertex_count);
    values.extend(diagonal);
    let triplets = CooMatrix::try_from_triplets(vertex_count, vertex_count, rows, columns, values);
    CscMatrix::from(&triplets.expect("every index is a vertex"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two right isosceles triangles make a unit square: the diagonal has weight 0, each side ½.
    #[test]
    fn unit_square() {
        let diagonal = 2f64.sqrt();
        let lengths = vec![[1.0, 1.0, diagonal], [diagonal, 1.0, 1.0]];
        let metric = Metric { triangles: vec![[0, 1, 2], [0, 2, 3]], lengths, single: 2 };
        let matrix = stiffness(&metric, &half_cotangents(&metric), 4);
        let expected = [(0, 0, 1.0), (1, 0, -0.5), (2, 0, 0.0), (3, 0, -0.5), (1, 1, 1.0), (2, 1, -0.5)];
        for (row, column, value) in expected {
            let entry = matrix.get_entry(row, column).expect("in range").into_value();
            assert!((entry - value).abs() < 1e-15, "({row}, {column}): {entry}");
        }
    }
}
