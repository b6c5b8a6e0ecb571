//! A permutation of the rows of a symmetric matrix, and of its columns.
//!
//! It fits any matrix whose pattern is much the same; only the fill grows with the difference.

/// An ordering of rows and columns.
#[derive(Debug)]
pub(crate) struct Ordering {
    /// Which row of the given matrix each row of the reordered one is.
    rows: Vec<u32>,
    /// Where each row of the given matrix went.
    columns: Vec<u32>,
}

impl Ordering {
    /// The rows of the given matrix in order: each of them once.
    pub(super) fn new(rows: Vec<u32>) -> Ordering {
        let mut columns = vec![0; rows.len()];
        (0..).zip(&rows).for_each(|(column, &row)| columns[row as usize] = column);
        Ordering { rows, columns }
    }

    /// Which row of the given matrix each row of the reordered one is.
    pub(super) fn rows(&self) -> &[u32] {
        &self.rows
    }

    /// Where each row of the given matrix went.
    pub(super) fn columns(&self) -> &[u32] {
        &self.columns
    }
}
