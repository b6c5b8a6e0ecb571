//! Symmetric positive definite sparse systems A x = b, solved by factorising A.
//!
//! A pattern is analysed once (an ordering that keeps the factor sparse, and where the factor will have entries); every
//! matrix with that pattern is then factorised without that work; a factor solves any number of right-hand sides. Only
//! the lower triangle of A is given: a nalgebra-sparse pattern in columns, and its values in the same order.
//!
//! This is the only place that names a solver crate. Both codes run on the calling thread, so the bits of a solution
//! do not depend on how many threads there are.
//!
//! Cost, for a mesh of V vertices: about V log V entries in the factor, and V^1.5 time to compute them.
//!
//! References: T. A. Davis: Direct Methods for Sparse Linear Systems. SIAM, 2006.

mod cholesky;
mod constrained;
mod dissection;
mod factor;
mod faer;
mod graph;
#[cfg(feature = "ldl")]
mod ldl;
mod ordering;
mod separator;
mod structure;

use crate::control::Piece;
use crate::error::{Error, Reason, Result};
use nalgebra_sparse::pattern::SparsityPattern;
use std::fmt::Debug;
use std::sync::Arc;

pub(crate) use constrained::Pin;
pub(crate) use factor::Factor;
pub(crate) use ordering::Ordering;

/// Which code factorises the matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Solver {
    /// Supernodal Cholesky, A = L Lᵀ. The fast one, and the default.
    Supernodal,
    /// sprs-ldl: up-looking A = L D Lᵀ, an independent second opinion. Needs the feature `ldl`, without which
    /// [`Reason::MissingFeature`] is returned.
    Ldl,
}

/// A pattern that was analysed.
pub(crate) trait Symbolic: Debug + Send + Sync {
    /// Factorises the matrix with this pattern and the given lower triangle.
    ///
    /// # Errors
    /// [`Reason::NotPositiveDefinite`], [`Reason::OutOfMemory`], and those of a checkpoint.
    fn factor(&self, values: &[f64], piece: &Piece) -> Result<Factor>;

    /// The ordering of its rows, which may serve other patterns.
    fn ordering(&self) -> &Arc<Ordering>;
}

/// Orders the rows of the lower triangle `pattern` of a square matrix; every diagonal entry must be in it.
///
/// # Errors
/// [`Reason::OutOfMemory`], and [`Reason::TooManyElements`] where 32-bit indices do not suffice.
pub(crate) fn order(pattern: &SparsityPattern) -> Result<Arc<Ordering>> {
    Ok(Arc::new(dissection::order(pattern)?))
}

/// Tells where the factor of a matrix with the lower triangle `pattern` will have entries.
///
/// # Errors
/// [`Reason::MissingFeature`], [`Reason::OutOfMemory`], and [`Reason::TooManyElements`] where 32-bit indices do not
/// suffice.
pub(crate) fn analyze(solver: Solver, pattern: &SparsityPattern, ordering: Arc<Ordering>) -> Result<Arc<dyn Symbolic>> {
    match solver {
        Solver::Supernodal => Ok(Arc::new(cholesky::Analysis::new(pattern, ordering)?)),
        #[cfg(feature = "ldl")]
        Solver::Ldl => Ok(Arc::new(ldl::Analysis::new(pattern, ordering))),
        #[cfg(not(feature = "ldl"))]
        Solver::Ldl => Err(Error::new(Reason::MissingFeature, "solver: this build lacks the feature `ldl` (sprs-ldl)")),
    }
}

/// `len` zeros, or an error where they do not fit in memory.
fn zeros(len: usize) -> Result<Vec<f64>> {
    // Asked for and given back first: that makes a lack an error, and leaves zeroing to the system, page by page.
    Vec::<f64>::new().try_reserve_exact(len).map_err(|_| out_of_memory())?;
    Ok(vec![0.0; len])
}

fn out_of_memory() -> Error {
    Error::new(Reason::OutOfMemory, "no memory for the factor of the matrix")
}

fn too_large() -> Error {
    Error::new(Reason::TooManyElements, "the matrix or its factor exceeds 32-bit indices")
}

fn not_positive_definite() -> Error {
    Error::new(Reason::NotPositiveDefinite, "the matrix is not positive definite in floating point")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::Control;
    use std::array;

    const SOLVERS: &[Solver] =
        if cfg!(feature = "ldl") { &[Solver::Supernodal, Solver::Ldl] } else { &[Solver::Supernodal] };

    /// The lower triangle of a tridiagonal matrix.
    fn tridiagonal(n: usize) -> SparsityPattern {
        let offsets = (0..=n).map(|i| (2 * i).min((2 * n).saturating_sub(1))).collect();
        let rows = (0..n).flat_map(|i| [i, i + 1]).take((2 * n).saturating_sub(1)).collect();
        SparsityPattern::try_from_offsets_and_indices(n, n, offsets, rows).unwrap()
    }

    fn analyzed(solver: Solver, n: usize) -> Arc<dyn Symbolic> {
        let pattern = tridiagonal(n);
        analyze(solver, &pattern, order(&pattern).unwrap()).unwrap()
    }

    #[test]
    fn solves_what_was_multiplied() {
        for &solver in SOLVERS {
            let n = 500;
            let symbolic = analyzed(solver, n);
            for diagonal in [2.0, 3.0] {
                let values: Vec<f64> = (0..2 * n - 1).map(|i| if i % 2 == 0 { diagonal } else { -1.0 }).collect();
                let factor = symbolic.factor(&values, &Piece::whole(&Control::new())).unwrap();
                let x = |i: usize| if i < n { (i as f64).sin() } else { 0.0 };
                let b: Vec<[f64; 1]> =
                    (0..n).map(|i| [diagonal * x(i) - x(i + 1) - x(if i == 0 { n } else { i - 1 })]).collect();
                let solved = factor.solve(&b);
                assert!(solved.iter().enumerate().all(|(i, [y])| (y - x(i)).abs() < 1e-9), "{solver:?}");
            }
        }
    }

    #[test]
    fn matrices_of_no_and_of_one_row() {
        for &solver in SOLVERS {
            let one = analyzed(solver, 1);
            let x = one.factor(&[2.0], &Piece::whole(&Control::new())).unwrap().solve(&[[6.0]]);
            assert!((x[0][0] - 3.0).abs() < 1e-15);
            assert!(one.factor(&[-2.0], &Piece::whole(&Control::new())).is_err());
            let solved = analyzed(solver, 0).factor(&[], &Piece::whole(&Control::new())).unwrap().solve::<1>(&[]);
            assert!(solved.is_empty());
        }
    }

    #[test]
    fn a_pivot_that_is_not_positive_is_an_error() {
        for &solver in SOLVERS {
            let symbolic = analyzed(solver, 3);
            for values in [[0.0; 5], [1.0, -2.0, 1.0, -2.0, 1.0], [-1.0, 0.0, 1.0, 0.0, 1.0], [f64::NAN; 5]] {
                let error = symbolic.factor(&values, &Piece::whole(&Control::new())).unwrap_err();
                assert_eq!(error.reason(), Reason::NotPositiveDefinite, "{solver:?} {values:?}");
            }
        }
    }

    /// The Laplacian of a grid of `n` x `n` vertices, with `extra` on the diagonal: its pattern, and its values.
    fn grid(n: usize, extra: f64) -> (SparsityPattern, Vec<f64>) {
        let (mut offsets, mut rows, mut values) = (vec![0], Vec::new(), Vec::new());
        for (y, x) in (0..n).flat_map(|y| (0..n).map(move |x| (y, x))) {
            let neighbours = [x > 0, x + 1 < n, y > 0, y + 1 < n].iter().filter(|is_there| **is_there).count();
            rows.push(y * n + x);
            values.push(neighbours as f64 + extra);
            let after = [(x + 1 < n).then_some(y * n + x + 1), (y + 1 < n).then_some((y + 1) * n + x)];
            rows.extend(after.into_iter().flatten());
            values.resize(rows.len(), -1.0);
            offsets.push(rows.len());
        }
        (SparsityPattern::try_from_offsets_and_indices(n * n, n * n, offsets, rows).unwrap(), values)
    }

    fn grid_factor(solver: Solver, n: usize, extra: f64) -> Factor {
        let (pattern, values) = grid(n, extra);
        analyze(solver, &pattern, order(&pattern).unwrap())
            .unwrap()
            .factor(&values, &Piece::whole(&Control::new()))
            .unwrap()
    }

    /// Right-hand sides side by side have the bits that each has alone, and sparse ones those of full ones.
    #[test]
    fn side_by_side_and_sparse_are_the_same_to_the_bit() {
        for &solver in SOLVERS {
            let factor = grid_factor(solver, 30, 0.1);
            let b: Vec<[f64; 8]> = (0..900).map(|i| array::from_fn(|k| ((i * 8 + k) as f64).sin())).collect();
            let together = factor.solve(&b);
            for k in 0..8 {
                let alone = factor.solve(&b.iter().map(|b| [b[k]]).collect::<Vec<_>>());
                assert!(together.iter().zip(&alone).all(|(x, [y])| x[k].to_bits() == y.to_bits()), "{solver:?} {k}");
            }
            let entries = [(17, [1.0]), (800, [2.0]), (17, [0.5])];
            let mut full = vec![[0.0]; 900];
            entries.iter().for_each(|&(row, [entry])| full[row as usize][0] += entry);
            assert_eq!(factor.solve_sparse(&entries), factor.solve(&full), "{solver:?}");
        }
    }

    /// Far from a source a solution of an M-matrix keeps its relative accuracy: here cosh has the decay.
    #[test]
    fn tiny_entries_of_a_solution_are_accurate() {
        for &solver in SOLVERS {
            let n = 400;
            let values: Vec<f64> = (0..2 * n - 1).map(|i| if i % 2 == 0 { 3.0 } else { -1.0 }).collect();
            let x = analyzed(solver, n)
                .factor(&values, &Piece::whole(&Control::new()))
                .unwrap()
                .solve_sparse(&[(0, [1.0])]);
            // x_i = (r^(n - i) - r^-(n - i)) / (r^(n + 1) - r^-(n + 1)) with r + 1 / r = 3.
            let log_r = ((3.0 + 5f64.sqrt()) / 2.0).ln();
            let sinh = |i: usize| (log_r * i as f64).exp() - (-log_r * i as f64).exp();
            for (i, [x]) in x.iter().enumerate() {
                let expected = sinh(n - i) / sinh(n + 1);
                assert!((x / expected - 1.0).abs() < 1e-11, "{solver:?} {i}: {x:e} {expected:e}");
            }
        }
    }

    /// A grid without extra is singular: raised at one vertex it solves for any right-hand side that sums to 0, and pins
    /// hold up to a constant.
    #[test]
    fn pins_hold() {
        for &solver in SOLVERS {
            let n = 20;
            let (pattern, mut values) = grid(n, 0.0);
            values[0] += 2.0;
            let factor = analyze(solver, &pattern, order(&pattern).unwrap())
                .unwrap()
                .factor(&values, &Piece::whole(&Control::new()))
                .unwrap();
            let mut b: Vec<[f64; 1]> = (0..n * n).map(|i| [(i as f64).cos()]).collect();
            let mean = b.iter().map(|b| b[0]).sum::<f64>() / b.len() as f64;
            b.iter_mut().for_each(|b| b[0] -= mean);
            let pins: Vec<Pin> = vec![(21, 0.5), (22, 0.75), (210, -1.0), (399, 2.0)];
            let x = factor.solve_pinned(&b, &[&[&pins[..]]]).unwrap();
            let constant = 0.5 - x[21][0];
            let at = |x_: usize, y: usize| x[y * n + x_][0] + constant;
            for &(row, value) in &pins {
                assert!((x[row as usize][0] + constant - value).abs() < 1e-12, "{solver:?} {row}");
            }
            // Elsewhere the equations of the Laplacian are met.
            for (y, x_) in (0..n).flat_map(|y| (0..n).map(move |x| (y, x))) {
                let i = y * n + x_;
                if pins.iter().all(|&(row, _)| row as usize != i) {
                    let beside = [(x_ > 0, -1, 0), (x_ + 1 < n, 1, 0), (y > 0, 0, -1), (y + 1 < n, 0, 1)];
                    let differences = beside
                        .iter()
                        .filter(|beside| beside.0)
                        .map(|&(_, dx, dy)| at(x_, y) - at(x_.wrapping_add_signed(dx), y.wrapping_add_signed(dy)));
                    assert!((differences.sum::<f64>() - b[i][0]).abs() < 1e-10, "{solver:?} {i}");
                }
            }
        }
    }

    #[cfg(not(feature = "ldl"))]
    #[test]
    fn a_solver_that_is_not_built_in_is_named() {
        let pattern = tridiagonal(3);
        let error = analyze(Solver::Ldl, &pattern, order(&pattern).unwrap()).unwrap_err();
        assert_eq!(error.reason(), Reason::MissingFeature);
    }
}
