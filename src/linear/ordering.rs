//! A fill-reducing ordering of rows and columns: approximate minimum degree.
//!
//! It fits any matrix whose pattern is much the same; only the fill grows with the difference.
//!
//! References: P. R. Amestoy, T. A. Davis, I. S. Duff: An Approximate Minimum Degree Ordering Algorithm. SIAM Journal on
//! Matrix Analysis and Applications, 1996.

/// A permutation of the rows of a symmetric matrix, and of its columns.
#[derive(Debug)]
pub(crate) struct Ordering {
    /// Which row of the given matrix each row of the reordered one is.
    rows: Vec<u32>,
    /// Where each row of the given matrix went.
    columns: Vec<u32>,
}

impl Ordering {
    /// Of two arrays that are each other's inverse.
    pub(super) fn new(rows: Vec<u32>, columns: Vec<u32>) -> Ordering {
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
