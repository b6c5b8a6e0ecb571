//! Backend faer: sparse Cholesky A = L Lᵀ, supernodal where the factor is dense enough, with its AMD ordering.

use super::{Factor, Symbolic, not_positive_definite, out_of_memory, zeros};
use crate::error::{Error, Reason, Result};
use ::faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use ::faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use ::faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use ::faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use ::faer::{Conj, MatMut, Par, Side};
use nalgebra_sparse::pattern::SparsityPattern;
use std::sync::Arc;

/// A pattern with its ordering and the structure of its factor.
#[derive(Debug)]
pub(super) struct Analysis {
    column_starts: Vec<u32>,
    rows: Vec<u32>,
    symbolic: Arc<SymbolicCholesky<u32>>,
}

impl Analysis {
    pub(super) fn new(pattern: &SparsityPattern) -> Result<Analysis> {
        if pattern.nnz() > i32::MAX as usize {
            return Err(too_large());
        }
        let to_u32 = |numbers: &[usize]| numbers.iter().map(|&i| i as u32).collect::<Vec<u32>>(); // fits, as just checked
        let (column_starts, rows) = (to_u32(pattern.major_offsets()), to_u32(pattern.minor_indices()));
        let symbolic = factorize_symbolic_cholesky(
            matrix_pattern(&column_starts, &rows),
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .map_err(|error| if matches!(error, FaerError::IndexOverflow) { too_large() } else { out_of_memory() })?;
        Ok(Analysis { column_starts, rows, symbolic: Arc::new(symbolic) })
    }
}

impl Symbolic for Analysis {
    fn factor(&self, values: &[f64]) -> Result<Arc<dyn Factor>> {
        let mut scratch =
            scratch(self.symbolic.factorize_numeric_llt_scratch::<f64>(Par::Seq, ::faer::Spec::default()))?;
        let mut factor = zeros(self.symbolic.len_val())?;
        let factorised = self.symbolic.factorize_numeric_llt(
            &mut factor,
            SparseColMatRef::new(matrix_pattern(&self.column_starts, &self.rows), values),
            Side::Lower,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut scratch),
            ::faer::Spec::default(),
        );
        match factorised {
            Ok(_) => Ok(Arc::new(Cholesky { symbolic: Arc::clone(&self.symbolic), values: factor })),
            Err(LltError::NonPositivePivot { .. }) => Err(not_positive_definite()),
        }
    }
}

/// The factor L.
#[derive(Debug)]
struct Cholesky {
    symbolic: Arc<SymbolicCholesky<u32>>,
    values: Vec<f64>,
}

impl Factor for Cholesky {
    fn solve_in_place(&self, x: &mut [f64]) -> Result<()> {
        let mut scratch = scratch(self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))?;
        let n = x.len();
        LltRef::new(&self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, n, 1),
            Par::Seq,
            MemStack::new(&mut scratch),
        );
        Ok(())
    }
}

fn matrix_pattern<'a>(column_starts: &'a [u32], rows: &'a [u32]) -> SymbolicSparseColMatRef<'a, u32> {
    let n = column_starts.len() - 1;
    SymbolicSparseColMatRef::new_checked(n, n, column_starts, None, rows)
}

fn scratch(request: StackReq) -> Result<MemBuffer> {
    MemBuffer::try_new(request).map_err(|_| out_of_memory())
}

fn too_large() -> Error {
    Error::new(Reason::TooManyElements, "the matrix or its factor exceeds 32-bit indices")
}

/// A fill-reducing ordering: row i of the reordered matrix is row `ordering[i]` of the given one.
#[cfg(feature = "ldl")]
pub(super) fn amd_ordering(pattern: &SparsityPattern) -> Result<Vec<usize>> {
    use ::faer::sparse::linalg::amd;
    let n = pattern.major_dim();
    let (mut forward, mut inverse) = (vec![0; n], vec![0; n]);
    let lower = SymbolicSparseColMatRef::new_checked(n, n, pattern.major_offsets(), None, pattern.minor_indices());
    let mut scratch = scratch(amd::order_maybe_unsorted_scratch::<usize>(n, pattern.nnz()))?;
    let stack = MemStack::new(&mut scratch);
    amd::order_maybe_unsorted(&mut forward, &mut inverse, lower, amd::Control::default(), stack)
        .map_err(|_| too_large())?;
    Ok(forward)
}
