//! The cotangent stiffness matrix: L_ij = -Σ ½ cot θ over the angles θ opposite the edges i j, L_ii = -Σ L_ij.
//!
//! L is positive semidefinite: uᵀ L u = ∫ |∇u|². Where every edge is Delaunay L_ij ≤ 0, and M + t L is an M-matrix.
//!
//! O(F) time: the pattern by counting sort into columns, then each value added where a search in its column finds it
//! (log d for a column of d entries).

use crate::metric::{Metric, cotangents};
use nalgebra_sparse::CscMatrix;
use nalgebra_sparse::pattern::SparsityPattern;

/// The lower triangle of L, with every diagonal entry, for triangles of these areas.
pub(super) fn stiffness(metric: &Metric, areas: &[f64], vertex_count: usize) -> CscMatrix<f64> {
    let pattern = pattern(&metric.triangles, vertex_count);
    let (offsets, rows) = (pattern.major_offsets(), pattern.minor_indices());
    let mut values = vec![0.0; pattern.nnz()];
    for ((triangle, lengths, weight), &area) in metric.weighted().zip(areas) {
        let cotangents = cotangents(lengths, area);
        for ([column, row], cot) in edges(triangle).into_iter().zip(cotangents).filter(|([i, j], _)| i != j) {
            let half = weight / 2.0 * cot;
            let diagonal = offsets[column as usize];
            values[diagonal] += half;
            values[offsets[row as usize]] += half;
            let below = &rows[diagonal + 1..offsets[column as usize + 1]];
            values[diagonal + 1 + below.partition_point(|&r| r < row as usize)] -= half;
        }
    }
    CscMatrix::try_from_pattern_and_values(pattern, values).expect("as many values as rows")
}

/// The edges of a triangle, from the smaller vertex to the larger: column and row of their entries. An edge from a vertex
/// to itself has none, as there is no difference to weigh.
fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[i, j]| [i.min(j), i.max(j)])
}

/// Columns that begin with their diagonal entry; below it are the neighbours with larger numbers.
fn pattern(triangles: &[[u32; 3]], vertex_count: usize) -> SparsityPattern {
    let entries = || triangles.iter().flat_map(|&triangle| edges(triangle)).filter(|[i, j]| i != j);
    // Where each column ends when every half-edge has an entry of its own: numbers of half-edges, which are 32-bit.
    let mut ends = vec![0u32; vertex_count + 1];
    entries().for_each(|[column, _]| ends[column as usize + 1] += 1);
    (0..vertex_count).for_each(|column| ends[column + 1] += ends[column]);
    let mut unsorted = vec![0; ends[vertex_count] as usize];
    for [column, row] in entries() {
        let end = &mut ends[column as usize];
        unsorted[*end as usize] = row;
        *end += 1;
    }
    let mut offsets = Vec::with_capacity(vertex_count + 1);
    let mut rows: Vec<usize> = Vec::with_capacity(vertex_count + unsorted.len());
    let mut start = 0;
    for (column, &end) in ends[..vertex_count].iter().enumerate() {
        let below = &mut unsorted[start..end as usize];
        below.sort_unstable();
        offsets.push(rows.len());
        rows.push(column);
        rows.extend(below.chunk_by(|x, y| x == y).map(|same| same[0] as usize));
        start = end as usize;
    }
    offsets.push(rows.len());
    rows.shrink_to_fit();
    SparsityPattern::try_from_offsets_and_indices(vertex_count, vertex_count, offsets, rows).expect("rows ascend")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::area;

    /// Two right isosceles triangles make a unit square: the diagonal has weight 0, each side ½.
    #[test]
    fn unit_square() {
        let diagonal = 2f64.sqrt();
        let lengths = vec![[1.0, 1.0, diagonal], [diagonal, 1.0, 1.0]];
        let areas: Vec<f64> = lengths.iter().map(|&lengths| area(lengths)).collect();
        let metric = Metric { triangles: vec![[0, 1, 2], [0, 2, 3]], lengths, single: 2 };
        let matrix = stiffness(&metric, &areas, 4);
        let expected = [(0, 0, 1.0), (1, 0, -0.5), (2, 0, 0.0), (3, 0, -0.5), (1, 1, 1.0), (2, 1, -0.5)];
        for (row, column, value) in expected {
            let entry = matrix.get_entry(row, column).expect("in range").into_value();
            assert!((entry - value).abs() < 1e-15, "({row}, {column}): {entry}");
        }
    }
}
