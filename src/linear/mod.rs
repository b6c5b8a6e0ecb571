//! Symmetric positive definite sparse systems A x = b, solved by factorising A.
//!
//! A pattern is analysed once (an approximate minimum degree ordering, and where the factor will have entries); every
//! matrix with that pattern is then factorised without that work; a factor solves any number of right-hand sides. Only
//! the lower triangle of A is given: a nalgebra-sparse pattern in columns, and its values in the same order.
//!
//! This is the only place that names a solver crate. Both backends run on the calling thread, so the bits of a solution
//! do not depend on how many threads there are.
//!
//! Cost, for a mesh of V vertices: about V log V entries in the factor, and V^1.5 time to compute them.
//!
//! References: P. R. Amestoy, T. A. Davis, I. S. Duff: An Approximate Minimum Degree Ordering Algorithm. SIAM Journal on
//! Matrix Analysis and Applications, 1996. T. A. Davis: Direct Methods for Sparse Linear Systems. SIAM, 2006.

mod faer;
#[cfg(feature = "ldl")]
mod ldl;

use crate::error::{Error, Reason, Result};
use nalgebra_sparse::pattern::SparsityPattern;
use std::fmt::Debug;
use std::sync::Arc;

/// Which library factorises the matrices.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Solver {
    /// faer: supernodal or simplicial Cholesky, A = L Lᵀ. The fast one, and the default.
    Faer,
    /// sprs-ldl: up-looking A = L D Lᵀ, an independent second opinion. Needs the feature `ldl`, without which
    /// [`Reason::MissingFeature`] is returned.
    Ldl,
}

/// A pattern that was analysed.
pub(crate) trait Symbolic: Debug + Send + Sync {
    /// Factorises the matrix with this pattern and the given lower triangle.
    ///
    /// # Errors
    /// [`Reason::NotPositiveDefinite`], [`Reason::OutOfMemory`].
    fn factor(&self, values: &[f64]) -> Result<Arc<dyn Factor>>;
}

/// A factorised matrix; any number of threads may solve with it.
pub(crate) trait Factor: Debug + Send + Sync {
    /// Replaces b by x = A⁻¹ b.
    ///
    /// # Errors
    /// [`Reason::OutOfMemory`].
    fn solve_in_place(&self, x: &mut [f64]) -> Result<()>;
}

/// Analyses the lower triangle `pattern` of a square matrix; every diagonal entry must be in it.
///
/// # Errors
/// [`Reason::MissingFeature`], [`Reason::OutOfMemory`], and [`Reason::TooManyElements`] where 32-bit indices do not
/// suffice.
pub(crate) fn analyze(solver: Solver, pattern: &SparsityPattern) -> Result<Arc<dyn Symbolic>> {
    match solver {
        Solver::Faer => Ok(Arc::new(faer::Analysis::new(pattern)?)),
        #[cfg(feature = "ldl")]
        Solver::Ldl => Ok(Arc::new(ldl::Analysis::new(pattern)?)),
        #[cfg(not(feature = "ldl"))]
        Solver::Ldl => Err(Error::new(Reason::MissingFeature, "solver: this build lacks the feature `ldl` (sprs-ldl)")),
    }
}

/// `len` zeros, or an error where they do not fit in memory.
fn zeros(len: usize) -> Result<Vec<f64>> {
    let mut values = Vec::new();
    values.try_reserve_exact(len).map_err(|_| out_of_memory())?;
    values.resize(len, 0.0);
    Ok(values)
}

fn out_of_memory() -> Error {
    Error::new(Reason::OutOfMemory, "no memory for the factor of the matrix")
}

fn not_positive_definite() -> Error {
    Error::new(Reason::NotPositiveDefinite, "the matrix is not positive definite in floating point")
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOLVERS: &[Solver] = if cfg!(feature = "ldl") { &[Solver::Faer, Solver::Ldl] } else { &[Solver::Faer] };

    /// The lower triangle of a tridiagonal matrix.
    fn tridiagonal(n: usize) -> SparsityPattern {
        let offsets = (0..=n).map(|i| (2 * i).min((2 * n).saturating_sub(1))).collect();
        let rows = (0..n).flat_map(|i| [i, i + 1]).take((2 * n).saturating_sub(1)).collect();
        SparsityPattern::try_from_offsets_and_indices(n, n, offsets, rows).unwrap()
    }

    #[test]
    fn solves_what_was_multiplied() {
        for &solver in SOLVERS {
            let n = 500;
            let symbolic = analyze(solver, &tridiagonal(n)).unwrap();
            for diagonal in [2.0, 3.0] {
                let values: Vec<f64> = (0..2 * n - 1).map(|i| if i % 2 == 0 { diagonal } else { -1.0 }).collect();
                let factor = symbolic.factor(&values).unwrap();
                let x = |i: usize| if i < n { (i as f64).sin() } else { 0.0 };
                let mut b: Vec<f64> =
                    (0..n).map(|i| diagonal * x(i) - x(i + 1) - x(if i == 0 { n } else { i - 1 })).collect();
                factor.solve_in_place(&mut b).unwrap();
                assert!(b.iter().enumerate().all(|(i, b)| (b - x(i)).abs() < 1e-9), "{solver:?}");
            }
        }
    }

    #[test]
    fn matrices_of_no_and_of_one_row() {
        for &solver in SOLVERS {
            let one = analyze(solver, &tridiagonal(1)).unwrap();
            let mut x = [6.0];
            one.factor(&[2.0]).unwrap().solve_in_place(&mut x).unwrap();
            assert!((x[0] - 3.0).abs() < 1e-15);
            assert!(one.factor(&[-2.0]).is_err());
            let factor = analyze(solver, &tridiagonal(0)).unwrap().factor(&[]).unwrap();
            factor.solve_in_place(&mut []).unwrap();
        }
    }

    #[test]
    fn a_pivot_that_is_not_positive_is_an_error() {
        for &solver in SOLVERS {
            let symbolic = analyze(solver, &tridiagonal(3)).unwrap();
            for values in [[0.0; 5], [1.0, -2.0, 1.0, -2.0, 1.0], [-1.0, 0.0, 1.0, 0.0, 1.0], [f64::NAN; 5]] {
                let error = symbolic.factor(&values).unwrap_err();
                assert_eq!(error.reason(), Reason::NotPositiveDefinite, "{solver:?} {values:?}");
            }
        }
    }

    #[cfg(not(feature = "ldl"))]
    #[test]
    fn a_solver_that_is_not_built_in_is_named() {
        assert_eq!(analyze(Solver::Ldl, &tridiagonal(3)).unwrap_err().reason(), Reason::MissingFeature);
    }
}
