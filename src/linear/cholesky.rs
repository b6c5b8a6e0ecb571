//! The values of a Cholesky factor A = L Lᵀ, one supernode after the other.
//!
//! ```text
//! L_s L_ssᵀ = A_s - Σ L_d (L_d at the columns of s)ᵀ,   d: the supernodes before s with rows among its columns
//! ```
//!
//! Each block is made of its entries of A, less the products of the supernodes before it (left-looking), and then
//! factorised as a dense matrix. Both work in *tiles* of 8 rows and 4 columns, whose sums stay in registers.
//!
//! Cost: Σ cⱼ² operations, cⱼ the entries of column j: V^1.5 for a mesh of V vertices.
//!
//! References: E. G. Ng, B. W. Peyton: Block sparse Cholesky algorithms on advanced uniprocessor computers. SIAM Journal
//! on Scientific Computing, 1993.

use super::factor::Factor;
use super::ordering::Ordering;
use super::structure::Structure;
use super::{Symbolic, faer, not_positive_definite, too_large, zeros};
use crate::control::Piece;
use crate::error::Result;
use nalgebra_sparse::pattern::SparsityPattern;
use pulp::{Arch, NullaryFnOnce, Simd, WithSimd};
use std::array;
use std::mem::replace;
use std::sync::Arc;

/// The rows of a tile.
const ROWS: usize = 8;

/// The columns of a tile.
const COLUMNS: usize = 4;

/// How many columns of a supernode are taken at once, so that they stay in the cache.
const DEPTH: usize = 64;

/// How many entries of L are computed between two checkpoints.
const STRIDE: usize = 1 << 18;

const NONE: u32 = u32::MAX;

/// A pattern with the structure of its factor.
#[derive(Debug)]
pub(super) struct Analysis {
    pub(super) structure: Arc<Structure>,
    /// Where among the values of the factor each entry of the matrix goes.
    places: Vec<u32>,
}

impl Analysis {
    pub(super) fn new(pattern: &SparsityPattern, ordering: Arc<Ordering>) -> Result<Analysis> {
        let structure = Arc::new(faer::structure(pattern, ordering)?);
        if structure.value_count() > u32::MAX as usize {
            return Err(too_large());
        }
        let mut places = Vec::with_capacity(pattern.nnz());
        for (column, rows) in
            (0..).zip(pattern.major_offsets().windows(2).map(|range| &pattern.minor_indices()[range[0]..range[1]]))
        {
            places.extend(rows.iter().map(|&row| structure.place([row as u32, column]) as u32)); // fits, as just checked
        }
        Ok(Analysis { structure, places })
    }
}

impl Symbolic for Analysis {
    fn factor(&self, entries: &[f64], piece: &Piece) -> Result<Factor> {
        let structure = &*self.structure;
        let mut values = zeros(structure.value_count())?;
        self.places.iter().zip(entries).for_each(|(&place, &entry)| values[place as usize] = entry);
        factorise(structure, &mut values, piece, Arch::new())?;
        Ok(Factor::new(Arc::clone(&self.structure), values))
    }

    fn ordering(&self) -> &Arc<Ordering> {
        &self.structure.ordering
    }
}

/// Replaces the entries of A by those of L.
fn factorise(structure: &Structure, values: &mut [f64], piece: &Piece, arch: Arch) -> Result<()> {
    let mut waiting = Waiting::new(structure);
    let mut row_in_block = vec![0; structure.size()];
    let mut rows = Vec::new();
    let mut next_stop = STRIDE;
    for s in 0..structure.count() {
        let range = structure.block(s);
        if range.start >= next_stop {
            piece.checkpoint(range.start as f64 / structure.value_count() as f64)?;
            next_stop = range.start + STRIDE;
        }
        for (i, row) in (0..).zip(structure.columns(s).chain(structure.rows(s).iter().copied())) {
            row_in_block[row as usize] = i;
        }
        let (done, rest) = values.split_at_mut(range.start);
        let (block, height) = (&mut rest[..range.len()], structure.height(s));
        while let Some((d, first)) = waiting.next_for(s) {
            rows.clear();
            rows.extend(structure.rows(d)[first..].iter().map(|&row| row_in_block[row as usize]));
            let count = rows.iter().take_while(|&&row| (row as usize) < structure.width(s)).count();
            let (columns, first_row) = (&done[structure.block(d)], structure.width(d) + first);
            let products = Products { columns, height: structure.height(d), first_row };
            arch.dispatch(Subtraction { columns: block, height, before: 0, products, rows: &rows, count });
            waiting.put(structure, d, first + count);
        }
        factorise_block(block, height, arch)?;
        waiting.put(structure, s, 0);
    }
    Ok(())
}

/// For each supernode the ones whose next row below is among its columns, as a list.
struct Waiting {
    head: Vec<u32>,
    next: Vec<u32>,
    /// The first of the rows of each supernode that is not served yet.
    first: Vec<u32>,
}

impl Waiting {
    fn new(structure: &Structure) -> Waiting {
        let count = structure.count();
        Waiting { head: vec![NONE; count], next: vec![NONE; count], first: vec![0; count] }
    }

    /// Takes one that waits for `s`, and its first row.
    fn next_for(&mut self, s: usize) -> Option<(usize, usize)> {
        let d = self.head[s];
        (d != NONE).then(|| {
            self.head[s] = self.next[d as usize];
            (d as usize, self.first[d as usize] as usize)
        })
    }

    /// Lets `d` wait for the supernode that owns the first of its rows from `first` on, if there is one.
    fn put(&mut self, structure: &Structure, d: usize, first: usize) {
        if let Some(&row) = structure.rows(d).get(first) {
            self.first[d] = first as u32; // fits: a row below
            self.next[d] = replace(&mut self.head[structure.supernode_of(row)], d as u32);
        }
    }
}

/// The products of pairs of rows of some columns.
#[derive(Clone, Copy)]
struct Products<'a> {
    columns: &'a [f64],
    height: usize,
    /// The rows from this one on are multiplied.
    first_row: usize,
}

/// Subtracts products from columns of a block, with the instructions that the machine has.
struct Subtraction<'a> {
    columns: &'a mut [f64],
    height: usize,
    /// How many columns of the block are left of these.
    before: usize,
    products: Products<'a>,
    /// Where the rows of the products are in the block.
    rows: &'a [u32],
    /// Of how many of them there is a column too.
    count: usize,
}

impl WithSimd for Subtraction<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        // Machines with vectors of numbers have fused products too. Elsewhere these would be slow.
        match size_of::<S::f64s>() > size_of::<f64>() {
            true => self.run::<true>(),
            false => self.run::<false>(),
        }
    }
}

impl Subtraction<'_> {
    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        let Products { columns, height, .. } = self.products;
        for columns in columns.chunks(DEPTH * height) {
            self.products.columns = columns;
            for j in (0..self.count).step_by(COLUMNS) {
                match self.count - j {
                    1 => self.subtract_columns::<FUSED, 1>(j),
                    2 => self.subtract_columns::<FUSED, 2>(j),
                    3 => self.subtract_columns::<FUSED, 3>(j),
                    _ => self.subtract_columns::<FUSED, COLUMNS>(j),
                }
            }
        }
    }

    /// C columns from that of the product `j` on.
    #[inline(always)]
    fn subtract_columns<const FUSED: bool, const C: usize>(&mut self, j: usize) {
        let mut i = j;
        while i < self.rows.len() {
            i += match self.products.height < ROWS {
                true => self.subtract_tile::<FUSED, 1, C>(i, j),
                false => self.subtract_tile::<FUSED, ROWS, C>(i, j),
            };
        }
    }

    /// One tile; returns how many of its rows count.
    #[inline(always)]
    fn subtract_tile<const FUSED: bool, const R: usize, const C: usize>(&mut self, i: usize, j: usize) -> usize {
        let Products { height, first_row, .. } = self.products;
        // The last tile begins earlier, and what it has twice is left out.
        let row = (first_row + i).min(height - R);
        let twice = first_row + i - row;
        let sums = self.products.tile::<FUSED, R, C>(row, first_row + j);
        let places = &self.rows[i..i + R - twice];
        let is_run = twice == 0 && places[R - 1] - places[0] == R as u32 - 1;
        for (c, sums) in sums.iter().enumerate() {
            let start = (self.rows[j + c] as usize - self.before) * self.height;
            let column = &mut self.columns[start..start + self.height];
            if is_run {
                let column = &mut column[places[0] as usize..][..R];
                column.iter_mut().zip(sums).for_each(|(x, sum)| *x -= sum);
            } else {
                places.iter().zip(&sums[twice..]).for_each(|(&place, sum)| column[place as usize] -= sum);
            }
        }
        R - twice
    }
}

impl Products<'_> {
    /// Those of R rows with C rows.
    #[inline(always)]
    fn tile<const FUSED: bool, const R: usize, const C: usize>(&self, i: usize, j: usize) -> [[f64; R]; C] {
        let mut sums = [[0.0; R]; C];
        for column in self.columns.chunks_exact(self.height) {
            let a: [f64; R] = array::from_fn(|r| column[i..i + R][r]);
            let b: [f64; C] = array::from_fn(|c| column[j..j + C][c]);
            for c in 0..C {
                for r in 0..R {
                    sums[c][r] = match FUSED {
                        true => a[r].mul_add(b[c], sums[c][r]),
                        false => sums[c][r] + a[r] * b[c],
                    };
                }
            }
        }
        sums
    }
}

/// Replaces the columns of a block, from the diagonal down, by those of its factor.
fn factorise_block(columns: &mut [f64], height: usize, arch: Arch) -> Result<()> {
    let width = columns.len() / height;
    let rows: Vec<u32> = (0..height as u32).collect();
    for start in (0..width).step_by(COLUMNS) {
        let end = width.min(start + COLUMNS);
        arch.dispatch(Panel { columns: &mut columns[start * height..end * height], height, start })?;
        if end < width {
            // As a binary counter counts up: the last 2ᵏ panels go into the next 2ᵏ. So each panel goes into each later one
            // once, and mostly together with many others.
            let depth = COLUMNS << (end / COLUMNS).trailing_zeros();
            let (done, columns) = columns.split_at_mut(end * height);
            let products = Products { columns: &done[(end - depth) * height..], height, first_row: end };
            let count = depth.min(width - end);
            arch.dispatch(Subtraction { columns, height, before: end, products, rows: &rows[end..], count });
        }
    }
    Ok(())
}

/// Replaces a few columns of a block, whose diagonal begins in the row `start`, by those of its factor.
struct Panel<'a> {
    columns: &'a mut [f64],
    height: usize,
    start: usize,
}

impl NullaryFnOnce for Panel<'_> {
    type Output = Result<()>;

    #[inline(always)]
    fn call(self) -> Result<()> {
        let Panel { columns, height, start } = self;
        for c in 0..columns.len() / height {
            let (before, column) = columns.split_at_mut(c * height);
            let column = &mut column[start + c..height];
            for other in before.chunks_exact(height) {
                let other = &other[start + c..];
                let factor = other[0];
                column.iter_mut().zip(other).for_each(|(x, y)| *x -= y * factor);
            }
            let pivot = column[0];
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(not_positive_definite());
            }
            let root = pivot.sqrt();
            let inverse = 1.0 / root;
            column.iter_mut().for_each(|x| *x *= inverse);
            column[0] = root;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use nalgebra::{Cholesky, DMatrix};
    use proptest::prelude::*;

    /// A matrix with these edges, and more on the diagonal than beside it.
    fn matrix(size: usize, edges: &[(usize, usize)]) -> DMatrix<f64> {
        let mut matrix = DMatrix::identity(size, size);
        for (k, &(a, b)) in edges.iter().enumerate().filter(|(_, (a, b))| a != b) {
            let value = (k as f64).sin();
            matrix[(a, b)] -= value;
            matrix[(b, a)] -= value;
            matrix[(a, a)] += value.abs();
            matrix[(b, b)] += value.abs();
        }
        matrix
    }

    /// Its lower triangle with the diagonal first, and the values.
    fn lower(matrix: &DMatrix<f64>) -> (SparsityPattern, Vec<f64>) {
        let size = matrix.nrows();
        let (mut offsets, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for column in 0..size {
            let entries = (column..size).filter(|&row| row == column || matrix[(row, column)] != 0.0);
            entries.for_each(|row| {
                rows.push(row);
                values.push(matrix[(row, column)]);
            });
            offsets.push(rows.len());
        }
        (SparsityPattern::try_from_offsets_and_indices(size, size, offsets, rows).unwrap(), values)
    }

    /// The largest difference between the factor of a reordered matrix and nalgebra's, which knows no zeros.
    fn error(arch: Arch, matrix: &DMatrix<f64>, order: &[u32]) -> f64 {
        let (pattern, entries) = lower(matrix);
        let analysis = Analysis::new(&pattern, Arc::new(Ordering::new(order.to_vec()))).unwrap();
        let structure = &*analysis.structure;
        let mut values = vec![0.0; structure.value_count()];
        analysis.places.iter().zip(&entries).for_each(|(&place, &entry)| values[place as usize] = entry);
        factorise(structure, &mut values, &Piece::whole(&Control::new()), arch).unwrap();
        let at = |i: usize| order[i] as usize;
        let reordered = DMatrix::from_fn(order.len(), order.len(), |i, j| matrix[(at(i), at(j))]);
        let mut left = Cholesky::new(reordered).unwrap().l();
        for s in 0..structure.count() {
            let rows: Vec<u32> = structure.columns(s).chain(structure.rows(s).iter().copied()).collect();
            let block = &values[structure.block(s)];
            for (c, column) in structure.columns(s).enumerate() {
                for (i, &row) in rows.iter().enumerate().skip(c) {
                    left[(row as usize, column as usize)] -= block[c * rows.len() + i];
                }
            }
        }
        left.amax()
    }

    proptest! {
        #[test]
        fn as_dense_matrices_have_it(
            size in 1..90_usize,
            edges in prop::collection::vec((0..90_usize, 0..90_usize), 0..400),
            key in any::<u64>(),
        ) {
            let edges: Vec<_> = edges.into_iter().map(|(a, b)| (a % size, b % size)).collect();
            let mut order: Vec<u32> = (0..size as u32).collect();
            order.sort_by_key(|&v| (u64::from(v) + 1).wrapping_mul(key | 1));
            let matrix = matrix(size, &edges);
            for arch in [Arch::Scalar, Arch::new()] {
                prop_assert!(error(arch, &matrix, &order) < 1e-13);
            }
        }
    }

    /// One supernode that is wider than what is taken at once.
    #[test]
    fn a_matrix_without_zeros() {
        for size in [7, 64, 65, 203] {
            let edges: Vec<_> = (0..size).flat_map(|a| (0..a).map(move |b| (a, b))).collect();
            let matrix = matrix(size, &edges);
            let order: Vec<u32> = (0..size as u32).rev().collect();
            for arch in [Arch::Scalar, Arch::new()] {
                assert!(error(arch, &matrix, &order) < 1e-12, "{size} {arch:?}");
            }
        }
    }
}
