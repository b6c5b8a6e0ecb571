//! Solutions of a singular system that have given values at a few rows.
//!
//! L is symmetric, L 1 = 0, and A is L with one diagonal entry raised, so that it can be factorised. Wanted is the x that
//! minimises ½ xᵀ L x - bᵀ x, for a b that sums to 0, with xᵢ = vᵢ at some rows i ∈ S. With one multiplier for each of
//! them,
//!
//! ```text
//! L x = b + Σ λᵢ eᵢ,   Σ λᵢ = 0:      x = A⁻¹ (b + Σ λᵢ eᵢ) + c
//! G λ + c = v - (A⁻¹ b) at S,   Gᵢⱼ = (A⁻¹)ᵢⱼ = yᵢ · yⱼ,   yᵢ = L⁻¹ P eᵢ (here L is the factor of A)
//! ```
//!
//! The yᵢ are short, so that k rows cost k short forward solves, k² short products and one backward solve, where the
//! factorisation of a matrix with these rows held costs as much as that of A.

use super::{Factor, not_positive_definite};
use crate::error::Result;
use nalgebra::{Cholesky, DMatrix, DVector};

/// A row of the system, and the value that the solution has there.
pub(crate) type Pin = (u32, f64);

impl Factor {
    /// For each of K right-hand sides, the solution with its pins in each of several blocks of the system that do not
    /// touch, up to a constant in each block. A single pin in a block asks for that constant only, none for nothing.
    ///
    /// # Errors
    /// [`Reason::NotPositiveDefinite`](crate::Reason) where rounding makes pins depend on each other.
    pub(crate) fn solve_pinned<const K: usize>(&self, b: &[[f64; K]], pins: &[&[&[Pin]]; K]) -> Result<Vec<[f64; K]>> {
        let mut y = self.forward(b);
        let mut scratch = vec![[0.0]; self.size()];
        for (k, blocks) in pins.iter().enumerate() {
            for pins in blocks.iter().filter(|pins| pins.len() > 1) {
                self.pull(&mut y, k, pins, &mut scratch)?;
            }
        }
        self.backward(&mut y);
        Ok(self.in_given_order(&y))
    }

    /// Adds L⁻¹ P Σ λᵢ eᵢ to the right-hand side k.
    fn pull<const K: usize>(&self, y: &mut [[f64; K]], k: usize, pins: &[Pin], scratch: &mut [[f64; 1]]) -> Result<()> {
        let columns: Vec<Vec<(u32, f64)>> = pins.iter().map(|&(row, _)| self.inverse_column(row, scratch)).collect();
        let g = products(&columns, scratch);
        let free = |column: &[(u32, f64)]| column.iter().map(|&(i, entry)| entry * y[i as usize][k]).sum::<f64>();
        let missing = columns.iter().zip(pins).map(|(column, &(_, value))| value - free(column));
        let missing = DVector::from_iterator(pins.len(), missing);
        let g = Cholesky::new(g).ok_or_else(not_positive_definite)?;
        let (for_missing, for_one) = (g.solve(&missing), g.solve(&DVector::from_element(pins.len(), 1.0)));
        let constant = for_missing.sum() / for_one.sum();
        let multipliers = for_missing - for_one * constant;
        for (column, &multiplier) in columns.iter().zip(&multipliers) {
            column.iter().for_each(|&(i, entry)| y[i as usize][k] += multiplier * entry);
        }
        Ok(())
    }
}

/// The products of all pairs of sparse columns.
fn products(columns: &[Vec<(u32, f64)>], scratch: &mut [[f64; 1]]) -> DMatrix<f64> {
    let mut products = DMatrix::zeros(columns.len(), columns.len());
    for (i, column) in columns.iter().enumerate() {
        column.iter().for_each(|&(row, entry)| scratch[row as usize] = [entry]);
        for (j, other) in columns.iter().enumerate().skip(i) {
            let product = other.iter().map(|&(row, entry)| entry * scratch[row as usize][0]).sum();
            products[(i, j)] = product;
            products[(j, i)] = product;
        }
        column.iter().for_each(|&(row, _)| scratch[row as usize] = [0.0]);
    }
    products
}
