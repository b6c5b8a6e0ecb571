//! Backend sprs-ldl: up-looking A = L D Lᵀ, simplicial, in the same AMD ordering.
//!
//! sprs-ldl is LGPL-2.1; it takes the whole matrix, so the lower triangle is mirrored.

use super::{Factor, Symbolic, faer::amd_ordering, not_positive_definite};
use crate::error::Result;
use nalgebra_sparse::pattern::SparsityPattern;
use sprs::{CsMatView, PermOwned, SymmetryCheck};
use sprs_ldl::{LdlNumeric, LdlSymbolic};
use std::sync::Arc;

/// A pattern with its ordering and elimination tree.
#[derive(Debug)]
pub(super) struct Analysis {
    column_starts: Vec<usize>,
    rows: Vec<usize>,
    /// Where in the lower triangle each entry of the whole matrix is.
    entry: Vec<usize>,
    symbolic: LdlSymbolic<usize>,
}

impl Analysis {
    pub(super) fn new(pattern: &SparsityPattern) -> Result<Analysis> {
        let n = pattern.major_dim();
        let ordering = PermOwned::new(amd_ordering(pattern)?);
        let (column_starts, rows, entry) = mirrored(pattern);
        // The symbolic analysis looks at no value, but its type asks for some.
        let matrix = CsMatView::new_csc((n, n), &column_starts, &rows, &entry);
        let symbolic = LdlSymbolic::new_perm(matrix, ordering, SymmetryCheck::DontCheckSymmetry);
        Ok(Analysis { column_starts, rows, entry, symbolic })
    }
}

/// The whole matrix of a lower triangle: (column starts, rows ascending in each column, where each value comes from).
fn mirrored(pattern: &SparsityPattern) -> (Vec<usize>, Vec<usize>, Vec<usize>) {
    let n = pattern.major_dim();
    let entries = || (0..n).flat_map(|column| pattern.lane(column).iter().map(move |&row| (row, column))).enumerate();
    let mut starts = vec![0; n + 1];
    for (_, (row, column)) in entries() {
        starts[column + 1] += 1;
        starts[row + 1] += usize::from(row != column);
    }
    for column in 0..n {
        starts[column + 1] += starts[column];
    }
    let mut next = starts.clone();
    let (mut rows, mut source) = (vec![0; starts[n]], vec![0; starts[n]]);
    let mut put = |row: usize, column: usize, i: usize| {
        rows[next[column]] = row;
        source[next[column]] = i;
        next[column] += 1;
    };
    // The upper triangle first: it has the smaller rows of each column.
    entries().filter(|(_, (row, column))| row != column).for_each(|(i, (row, column))| put(column, row, i));
    entries().for_each(|(i, (row, column))| put(row, column, i));
    (starts, rows, source)
}

impl Symbolic for Analysis {
    fn factor(&self, values: &[f64]) -> Result<Arc<dyn Factor>> {
        let n = self.column_starts.len() - 1;
        if n < 2 {
            return Diagonal::factor(values);
        }
        let values: Vec<f64> = self.entry.iter().map(|&i| values[i]).collect();
        let matrix = CsMatView::new_csc((n, n), &self.column_starts, &self.rows, &values);
        let numeric = self.symbolic.clone().factor(matrix).map_err(|_| not_positive_definite())?;
        // sprs-ldl stops only at a pivot that is exactly 0; NaN is not positive either.
        if numeric.d().iter().all(|&pivot| pivot > 0.0) {
            Ok(Arc::new(Ldl(numeric)))
        } else {
            Err(not_positive_definite())
        }
    }
}

/// The factors L and D.
#[derive(Debug)]
struct Ldl(LdlNumeric<f64, usize>);

impl Factor for Ldl {
    fn solve_in_place(&self, x: &mut [f64]) -> Result<()> {
        x.copy_from_slice(&self.0.solve(&*x));
        Ok(())
    }
}

/// A matrix of at most one row, which sprs-ldl does not take.
#[derive(Debug)]
struct Diagonal(Vec<f64>);

impl Diagonal {
    fn factor(values: &[f64]) -> Result<Arc<dyn Factor>> {
        if values.iter().all(|&pivot| pivot > 0.0) {
            Ok(Arc::new(Diagonal(values.to_vec())))
        } else {
            Err(not_positive_definite())
        }
    }
}

impl Factor for Diagonal {
    fn solve_in_place(&self, x: &mut [f64]) -> Result<()> {
        x.iter_mut().zip(&self.0).for_each(|(x, pivot)| *x /= pivot);
        Ok(())
    }
}
