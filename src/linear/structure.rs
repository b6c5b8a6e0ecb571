//! Where the entries of a Cholesky factor are.
//!
//! L is kept in *supernodes*: neighbouring columns whose entries lie in the same rows, as one dense block each. The parent
//! of a supernode owns the first row below its block.

use super::ordering::Ordering;
use std::ops::Range;
use std::sync::Arc;

/// The supernodes of a factor.
#[derive(Debug)]
pub(crate) struct Structure {
    pub(super) ordering: Arc<Ordering>,
    /// The first column of each supernode, and at last the number of columns.
    first_columns: Vec<u32>,
    /// The rows below the diagonal block of each supernode, ascending.
    rows: Vec<u32>,
    /// Where those of each supernode begin, and at last where they end.
    row_starts: Vec<u32>,
    /// Where the block of each supernode begins among the values, and at last how many these are.
    value_starts: Vec<usize>,
    /// The supernode of each column.
    supernodes: Vec<u32>,
}

impl Structure {
    /// For each supernode its first column, and where its rows begin; at last the number of columns and that of `rows`.
    pub(super) fn new(
        ordering: Arc<Ordering>,
        first_columns: Vec<u32>,
        rows: Vec<u32>,
        row_starts: Vec<u32>,
    ) -> Structure {
        let mut supernodes = Vec::with_capacity(ordering.rows().len());
        let mut value_starts = vec![0];
        for (columns, row_range) in first_columns.windows(2).zip(row_starts.windows(2)) {
            supernodes.resize(columns[1] as usize, value_starts.len() as u32 - 1); // fits: fewer than columns
            let width = (columns[1] - columns[0]) as usize;
            value_starts
                .push(value_starts[value_starts.len() - 1] + width * (width + (row_range[1] - row_range[0]) as usize));
        }
        Structure { ordering, first_columns, rows, row_starts, value_starts, supernodes }
    }

    /// How many rows the matrix has.
    pub(super) fn size(&self) -> usize {
        self.supernodes.len()
    }

    /// How many supernodes there are.
    pub(super) fn count(&self) -> usize {
        self.first_columns.len() - 1
    }

    /// The supernode of a column.
    #[inline]
    pub(super) fn supernode_of(&self, column: u32) -> usize {
        self.supernodes[column as usize] as usize
    }

    /// The columns of a supernode.
    #[inline]
    pub(super) fn columns(&self, s: usize) -> Range<u32> {
        self.first_columns[s]..self.first_columns[s + 1]
    }

    /// How many columns a supernode has.
    #[inline]
    pub(super) fn width(&self, s: usize) -> usize {
        self.columns(s).len()
    }

    /// The rows below the diagonal block of a supernode, ascending.
    #[inline]
    pub(super) fn rows(&self, s: usize) -> &[u32] {
        &self.rows[self.row_starts[s] as usize..self.row_starts[s + 1] as usize]
    }

    /// How many rows the block of a supernode has.
    #[inline]
    pub(super) fn height(&self, s: usize) -> usize {
        self.width(s) + self.rows(s).len()
    }

    /// Where the block of a supernode is among the values. It is kept in columns: the rows of its diagonal block first
    /// (only the lower triangle counts), then those below.
    #[inline]
    pub(super) fn block(&self, s: usize) -> Range<usize> {
        self.value_starts[s]..self.value_starts[s + 1]
    }

    /// How many values a factor has.
    pub(super) fn value_count(&self) -> usize {
        self.value_starts[self.count()]
    }

    /// Where among the values the entry of A is, in the given row and column, that the factor begins with.
    pub(super) fn place(&self, [row, column]: [u32; 2]) -> usize {
        let [a, b] = [row, column].map(|row| self.ordering.columns()[row as usize]);
        let (row, column) = (a.max(b), a.min(b));
        let s = self.supernode_of(column);
        let columns = self.columns(s);
        let row = match columns.contains(&row) {
            true => (row - columns.start) as usize,
            false => columns.len() + self.rows(s).partition_point(|&other| other < row),
        };
        self.value_starts[s] + (column - columns.start) as usize * self.height(s) + row
    }

    /// How many entries each column has from the diagonal on.
    #[cfg(test)]
    pub(super) fn column_counts(&self) -> impl Iterator<Item = usize> {
        (0..self.count()).flat_map(|s| (self.rows(s).len() + 1..=self.height(s)).rev())
    }
}
