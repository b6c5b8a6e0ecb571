//! Backend sprs-ldl: up-looking A = L D Lᵀ, simplicial, in the same ordering.
//!
//! sprs-ldl is LGPL-2.1; it takes the whole matrix, so the lower triangle is mirrored.

use super::factor::Factor;
use super::ordering::Ordering;
use super::structure::Structure;
use super::{Symbolic, not_positive_definite};
use crate::control::Piece;
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
    ordering: Arc<Ordering>,
}

impl Analysis {
    pub(super) fn new(pattern: &SparsityPattern, ordering: Arc<Ordering>) -> Analysis {
        let n = pattern.major_dim();
        let order = PermOwned::new(ordering.rows().iter().map(|&row| row as usize).collect());
        let (column_starts, rows, entry) = mirrored(pattern);
        // The symbolic analysis looks at no value, but its type asks for some.
        let matrix = CsMatView::new_csc((n, n), &column_starts, &rows, &entry);
        let symbolic = LdlSymbolic::new_perm(matrix, order, SymmetryCheck::DontCheckSymmetry);
        Analysis { column_starts, rows, entry, symbolic, ordering }
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
    fn factor(&self, values: &[f64], _: &Piece) -> Result<Factor> {
        let n = self.column_starts.len() - 1;
        if n < 2 {
            return self.of_one_row(values);
        }
        let values: Vec<f64> = self.entry.iter().map(|&i| values[i]).collect();
        let matrix = CsMatView::new_csc((n, n), &self.column_starts, &self.rows, &values);
        let numeric = self.symbolic.clone().factor(matrix).map_err(|_| not_positive_definite())?;
        // sprs-ldl stops only at a pivot that is exactly 0; NaN is not positive either.
        if numeric.d().iter().all(|&pivot| pivot > 0.0) {
            Ok(self.simplicial(&numeric))
        } else {
            Err(not_positive_definite())
        }
    }

    fn ordering(&self) -> &Arc<Ordering> {
        &self.ordering
    }
}

impl Analysis {
    /// L D Lᵀ as L √D (L √D)ᵀ: each column is a supernode of its own.
    fn simplicial(&self, numeric: &LdlNumeric<f64, usize>) -> Factor {
        let (l, d) = (numeric.l(), numeric.d());
        let mut columns = Columns::default();
        for (j, column) in l.outer_iterator().enumerate() {
            let mut below: Vec<(usize, f64)> = column.iter().map(|(row, &value)| (row, value)).collect();
            below.sort_unstable_by_key(|&(row, _)| row);
            columns.push(d[j].sqrt(), &below);
        }
        columns.factor(Arc::clone(&self.ordering))
    }

    /// A matrix of at most one row, which sprs-ldl does not take.
    fn of_one_row(&self, values: &[f64]) -> Result<Factor> {
        let mut columns = Columns::default();
        for &pivot in values {
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(not_positive_definite());
            }
            columns.push(pivot.sqrt(), &[]);
        }
        Ok(columns.factor(Arc::clone(&self.ordering)))
    }
}

/// The columns of a factor, as they come.
#[derive(Default)]
struct Columns {
    row_start: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Columns {
    /// A column of `diagonal` times 1 and what is below.
    fn push(&mut self, diagonal: f64, below: &[(usize, f64)]) {
        self.row_start.push(self.rows.len() as u32);
        self.values.push(diagonal);
        self.values.extend(below.iter().map(|&(_, value)| value * diagonal));
        self.rows.extend(below.iter().map(|&(row, _)| row as u32));
    }

    fn factor(mut self, ordering: Arc<Ordering>) -> Factor {
        let count = self.row_start.len() as u32;
        self.row_start.push(self.rows.len() as u32);
        let Columns { row_start, rows, values } = self;
        let structure = Structure::new(ordering, (0..=count).collect(), rows, row_start);
        Factor::new(Arc::new(structure), values)
    }
}
