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
    let (starts, rows) = below_diagonal(&metric.triangles, vertex_count);
    let mut values = vec![0.0; vertex_count + rows.len()];
    let mut diagonal = vec![0.0; vertex_count];
    for ((triangle, lengths, weight), &area) in metric.weighted().zip(areas) {
        let cotangents = cotangents(lengths, area);
        for ([column, row], cot) in edges(triangle).into_iter().zip(cotangents).filter(|([i, j], _)| i != j) {
            let half = weight / 2.0 * cot;
            let (i, j) = (column as usize, row as usize);
            diagonal[i] += half;
            diagonal[j] += half;
            let start = starts[i] as usize;
            let entry = start + rows[start..starts[i + 1] as usize].partition_point(|&r| r < row);
            values[entry + i + 1] -= half; // behind the diagonal entries of the columns up to this one
        }
    }
    let offsets: Vec<usize> = starts.iter().enumerate().map(|(column, &start)| start as usize + column).collect();
    offsets.iter().zip(diagonal).for_each(|(&offset, diagonal)| values[offset] = diagonal);
    let mut with_diagonal = Vec::with_capacity(values.len());
    for (column, ends) in starts.windows(2).enumerate() {
        with_diagonal.push(column);
        with_diagonal.extend(rows[ends[0] as usize..ends[1] as usize].iter().map(|&row| row as usize));
    }
    let pattern = SparsityPattern::try_from_offsets_and_indices(vertex_count, vertex_count, offsets, with_diagonal);
    CscMatrix::try_from_pattern_and_values(pattern.expect("rows ascend"), values).expect("as many values as rows")
}

/// The edges of a triangle, from the smaller vertex to the larger: column and row of their entries. An edge from a vertex
/// to itself has none, as there is no difference to weigh.
fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]].map(|[i, j]| [i.min(j), i.max(j)])
}

/// Where each column begins, and the rows of its entries below the diagonal, ascending: in 32-bit numbers, as the search
/// for entries is a matter of memory.
fn below_diagonal(triangles: &[[u32; 3]], vertex_count: usize) -> (Vec<u32>, Vec<u32>) {
    let entries = || triangles.iter().flat_map(|&triangle| edges(triangle)).filter(|[i, j]| i != j);
    // Every half-edge has an entry of its own at first; half-edges have 32-bit numbers.
    let mut ends = vec![0u32; vertex_count + 1];
    entries().for_each(|[column, _]| ends[column as usize + 1] += 1);
    (0..vertex_count).for_each(|column| ends[column + 1] += ends[column]);
    let mut rows = vec![0; ends[vertex_count] as usize];
    for [column, row] in entries() {
        let end = &mut ends[column as usize];
        rows[*end as usize] = row;
        *end += 1;
    }
    // Sorts each column and moves it to the front, each row once.
    let mut starts = Vec::with_capacity(vertex_count + 1);
    let (mut from, mut kept) = (0, 0);
    for &end in &ends[..vertex_count] {
        starts.push(kept as u32);
        let column = from..end as usize;
        rows[column.clone()].sort_unstable();
        for i in column.clone() {
            if i == column.start || rows[i] != rows[kept - 1] {
                rows[kept] = rows[i];
                kept += 1;
            }
        }
        from = column.end;
    }
    starts.push(kept as u32);
    rows.truncate(kept);
    (starts, rows)
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
