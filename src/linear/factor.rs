//! A Cholesky factor, and the triangular systems that solve A x = b with it.
//!
//! ```text
//! P A Pᵀ = L Lᵀ      L y = P b      Lᵀ P x = y
//! ```
//!
//! P is the ordering. A right-hand side with few entries fills y only on the way from their supernodes up to the root, so
//! that forward solve is short.
//!
//! K right-hand sides are solved at once, side by side: each entry of L is then fetched once for all. What is computed for
//! one of them does not depend on the others nor on K, to the bit.
//!
//! Cost: forward solve, for a sparse right-hand side, the blocks on its way to the root, a few percent of L; otherwise
//! all of L, as for the backward solve.
//!
//! References: T. A. Davis: Direct Methods for Sparse Linear Systems. SIAM, 2006.

use super::structure::Structure;
use pulp::{Arch, NullaryFnOnce};
use std::array;
use std::sync::Arc;

/// The factor L of a matrix; any number of threads may solve with it.
#[derive(Debug)]
pub(crate) struct Factor {
    structure: Arc<Structure>,
    /// The blocks.
    values: Vec<f64>,
}

/// How many sums a product of vectors is added up in.
const LANES: usize = 4;

/// How many columns are taken at a time, so that what they are multiplied with is fetched once.
const PANEL: usize = 4;

/// Subtracts C columns times `y` from `t`, one after the other.
#[inline(always)]
fn subtract<const C: usize, const K: usize>(t: &mut [[f64; K]], columns: [&[f64]; C], y: &[[f64; K]]) {
    let columns = columns.map(|column| &column[..t.len()]);
    let y: [[f64; K]; C] = array::from_fn(|c| y[c]);
    for i in 0..t.len() {
        for c in 0..C {
            for k in 0..K {
                t[i][k] -= columns[c][i] * y[c][k];
            }
        }
    }
}

/// The products of C columns with `t`, added up in the same order for any C and K.
#[inline(always)]
fn products<const C: usize, const K: usize>(columns: [&[f64]; C], t: &[[f64; K]]) -> [[f64; K]; C] {
    let (chunks, rest) = t.as_chunks::<LANES>();
    let whole = columns.map(|column| &column.as_chunks::<LANES>().0[..chunks.len()]);
    let mut sums = [[[0.0; K]; LANES]; C];
    for (i, t) in chunks.iter().enumerate() {
        for (sums, column) in sums.iter_mut().zip(whole) {
            for lane in 0..LANES {
                for k in 0..K {
                    sums[lane][k] += column[i][lane] * t[lane][k];
                }
            }
        }
    }
    for (sums, column) in sums.iter_mut().zip(columns) {
        for ((sums, l), t) in sums.iter_mut().zip(&column[LANES * chunks.len()..]).zip(rest) {
            for k in 0..K {
                sums[k] += l * t[k];
            }
        }
    }
    sums.map(|sums| array::from_fn(|k| (sums[0][k] + sums[1][k]) + (sums[2][k] + sums[3][k])))
}

/// One supernode of a factor.
struct Supernode<'a> {
    /// Its first column.
    first: usize,
    /// How many columns it has.
    width: usize,
    /// The rows below its diagonal block.
    rows: &'a [u32],
    block: &'a [f64],
}

impl Supernode<'_> {
    /// The entries of column `j` of the supernode from the diagonal on.
    #[inline(always)]
    fn column(&self, j: usize) -> &[f64] {
        let height = self.width + self.rows.len();
        &self.block[j * height + j..(j + 1) * height]
    }

    /// The entries of `x` in its columns and rows, for a while side by side.
    #[inline(always)]
    fn gather<const K: usize>(&self, x: &[[f64; K]], t: &mut Vec<[f64; K]>) {
        t.clear();
        t.extend_from_slice(&x[self.first..self.first + self.width]);
        t.extend(self.rows.iter().map(|&row| x[row as usize]));
    }

    #[inline(always)]
    fn forward<const K: usize>(&self, x: &mut [[f64; K]], t: &mut Vec<[f64; K]>) {
        self.gather(x, t);
        for start in (0..self.width).step_by(PANEL) {
            let end = self.width.min(start + PANEL);
            for j in start..end {
                let column = self.column(j);
                t[j] = t[j].map(|x| x / column[0]);
                let y = t[j];
                subtract(&mut t[j + 1..end], [&column[1..end - j]], &[y]);
            }
            let (y, t) = t[start..].split_at_mut(end - start);
            match end - start {
                4 => subtract(t, self.below::<4>(start), y),
                3 => subtract(t, self.below::<3>(start), y),
                2 => subtract(t, self.below::<2>(start), y),
                _ => subtract(t, self.below::<1>(start), y),
            }
        }
        x[self.first..self.first + self.width].copy_from_slice(&t[..self.width]);
        for (&row, &t) in self.rows.iter().zip(&t[self.width..]) {
            x[row as usize] = t;
        }
    }

    #[inline(always)]
    fn backward<const K: usize>(&self, x: &mut [[f64; K]], t: &mut Vec<[f64; K]>) {
        self.gather(x, t);
        for start in (0..self.width).step_by(PANEL).rev() {
            let end = self.width.min(start + PANEL);
            let known = self.products_below(start, &t[end..], end - start);
            for j in (start..end).rev() {
                let column = self.column(j);
                let [inside] = products([&column[1..end - j]], &t[j + 1..end]);
                t[j] = array::from_fn(|k| (t[j][k] - known[j - start][k] - inside[k]) / column[0]);
            }
        }
        x[self.first..self.first + self.width].copy_from_slice(&t[..self.width]);
    }

    /// C columns from `start` on, below the last of them.
    #[inline(always)]
    fn below<const C: usize>(&self, start: usize) -> [&[f64]; C] {
        array::from_fn(|c| &self.column(start + c)[C - c..])
    }

    /// The products of the `count` columns of a panel, below it, with `t`.
    #[inline(always)]
    fn products_below<const K: usize>(&self, start: usize, t: &[[f64; K]], count: usize) -> [[f64; K]; PANEL] {
        let mut all = [[0.0; K]; PANEL];
        match count {
            // Several columns at once need as many sums for each right-hand side: for more than one there is no room.
            4 if K == 1 => all = products(self.below::<4>(start), t),
            3 if K == 1 => all[..3].copy_from_slice(&products(self.below::<3>(start), t)),
            2 if K == 1 => all[..2].copy_from_slice(&products(self.below::<2>(start), t)),
            _ => {
                for (c, product) in all[..count].iter_mut().enumerate() {
                    [*product] = products([&self.column(start + c)[count - c..]], t);
                }
            }
        }
        all
    }
}

/// The forward or the backward solve over some supernodes, with the instructions that the machine has. These change no
/// bit: no sum is reordered, no product fused.
struct Sweep<'a, I, const FORWARD: bool, const K: usize> {
    factor: &'a Factor,
    supernodes: I,
    y: &'a mut [[f64; K]],
}

impl<I: Iterator<Item = usize>, const FORWARD: bool, const K: usize> NullaryFnOnce for Sweep<'_, I, FORWARD, K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let mut t = Vec::new();
        for s in self.supernodes {
            let supernode = self.factor.supernode(s);
            match FORWARD {
                true => supernode.forward(self.y, &mut t),
                false => supernode.backward(self.y, &mut t),
            }
        }
    }
}

impl Factor {
    pub(super) fn new(structure: Arc<Structure>, values: Vec<f64>) -> Factor {
        Factor { structure, values }
    }

    /// How many rows the matrix has.
    pub(crate) fn size(&self) -> usize {
        self.structure.size()
    }

    #[inline(always)]
    fn supernode(&self, s: usize) -> Supernode<'_> {
        let structure = &*self.structure;
        Supernode {
            first: structure.columns(s).start as usize,
            width: structure.width(s),
            rows: structure.rows(s),
            block: &self.values[structure.block(s)],
        }
    }

    /// Solves A x = b.
    pub(crate) fn solve<const K: usize>(&self, b: &[[f64; K]]) -> Vec<[f64; K]> {
        let mut y = self.forward(b);
        self.backward(&mut y);
        self.in_given_order(&y)
    }

    /// Solves A x = b for a b that is zero but at the given rows; rows may repeat, their entries add up.
    pub(crate) fn solve_sparse<const K: usize>(&self, b: &[(u32, [f64; K])]) -> Vec<[f64; K]> {
        let mut y = vec![[0.0; K]; self.size()];
        self.forward_from(b, &mut y);
        self.backward(&mut y);
        self.in_given_order(&y)
    }

    /// y = L⁻¹ P b.
    pub(super) fn forward<const K: usize>(&self, b: &[[f64; K]]) -> Vec<[f64; K]> {
        let mut y: Vec<[f64; K]> = self.structure.ordering.rows().iter().map(|&row| b[row as usize]).collect();
        self.forward_over(0..self.structure.count(), &mut y);
        y
    }

    /// The forward solve over supernodes in ascending order.
    fn forward_over<const K: usize>(&self, supernodes: impl Iterator<Item = usize>, y: &mut [[f64; K]]) {
        Arch::new().dispatch(Sweep::<_, true, K> { factor: self, supernodes, y });
    }

    /// Replaces y by L⁻ᵀ y.
    pub(super) fn backward<const K: usize>(&self, y: &mut [[f64; K]]) {
        let supernodes = (0..self.structure.count()).rev();
        Arch::new().dispatch(Sweep::<_, false, K> { factor: self, supernodes, y });
    }

    /// Pᵀ x.
    pub(super) fn in_given_order<const K: usize>(&self, x: &[[f64; K]]) -> Vec<[f64; K]> {
        self.structure.ordering.columns().iter().map(|&column| x[column as usize]).collect()
    }

    /// The column of L⁻¹ P that belongs to a row of the given matrix: where it may be other than zero, ascending, and its
    /// entries there. `scratch` is as long as the matrix, and zero before and after.
    pub(super) fn inverse_column(&self, row: u32, scratch: &mut [[f64; 1]]) -> Vec<(u32, f64)> {
        let reach = self.forward_from(&[(row, [1.0])], scratch);
        let columns = reach.iter().flat_map(|&s| self.structure.columns(s as usize));
        columns.map(|column| (column, std::mem::take(&mut scratch[column as usize])[0])).collect()
    }

    /// Replaces y, which is zero, by L⁻¹ P b for a sparse b; returns the supernodes that b reaches, ascending.
    fn forward_from<const K: usize>(&self, b: &[(u32, [f64; K])], y: &mut [[f64; K]]) -> Vec<u32> {
        let column = |row: u32| self.structure.ordering.columns()[row as usize];
        for &(row, entry) in b {
            let y = &mut y[column(row) as usize];
            (0..K).for_each(|k| y[k] += entry[k]);
        }
        let reach = self.reach(b.iter().map(|&(row, _)| column(row)));
        self.forward_over(reach.iter().map(|&s| s as usize), y);
        reach
    }

    /// The supernodes on the ways from these columns to the root, in ascending order.
    fn reach(&self, columns: impl Iterator<Item = u32>) -> Vec<u32> {
        let structure = &*self.structure;
        let mut is_reached = vec![false; structure.count()];
        let mut reach = Vec::new();
        for column in columns {
            let mut s = structure.supernode_of(column);
            while !std::mem::replace(&mut is_reached[s], true) {
                reach.push(s as u32); // fits: fewer than columns
                match structure.rows(s).first() {
                    Some(&row) => s = structure.supernode_of(row),
                    None => break,
                }
            }
        }
        reach.sort_unstable();
        reach
    }
}
