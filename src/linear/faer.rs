//! From faer: approximate minimum degree, and the supernodes of a factor.

use super::graph::Graph;
use super::ordering::Ordering;
use super::structure::Structure;
use super::{out_of_memory, too_large};
use crate::error::Result;
use ::faer::Side;
use ::faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use ::faer::perm::PermRef;
use ::faer::sparse::linalg::SupernodalThreshold;
use ::faer::sparse::linalg::amd;
use ::faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use ::faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use ::faer::sparse::{FaerError, SymbolicSparseColMatRef};
use nalgebra_sparse::pattern::SparsityPattern;
use std::sync::Arc;

/// Where the factor of a matrix with this lower triangle has entries.
pub(super) fn structure(pattern: &SparsityPattern, ordering: Arc<Ordering>) -> Result<Structure> {
    let (column_starts, rows) = narrow(pattern)?;
    let order = PermRef::new_checked(ordering.rows(), ordering.columns(), ordering.rows().len());
    let parameters = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..CholeskySymbolicParams::default()
    };
    let pattern = matrix_pattern(&column_starts, &rows);
    let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Custom(order), parameters)
        .map_err(|error| if matches!(error, FaerError::IndexOverflow) { too_large() } else { out_of_memory() })?;
    Ok(match symbolic.raw() {
        SymbolicCholeskyRaw::Supernodal(supernodal) => copied(supernodal, ordering),
        // A matrix without rows has no supernodes either.
        SymbolicCholeskyRaw::Simplicial(_) => Structure::new(ordering, vec![0], Vec::new(), vec![0]),
    })
}

fn copied(supernodal: &SymbolicSupernodalCholesky<u32>, ordering: Arc<Ordering>) -> Structure {
    let mut first_columns = supernodal.supernode_begin().to_vec();
    first_columns.push(supernodal.ncols() as u32); // fits: the ordering counts by u32
    let mut row_starts = vec![0];
    let mut rows = Vec::with_capacity(supernodal.row_idx().len());
    for s in 0..supernodal.n_supernodes() {
        rows.extend_from_slice(supernodal.supernode(s).pattern());
        row_starts.push(rows.len() as u32); // fits: fewer than values, which faer counts by u32
    }
    Structure::new(ordering, first_columns, rows, row_starts)
}

/// The vertices of a graph in the order of approximate minimum degree.
pub(super) fn minimum_degree(graph: &Graph) -> Result<Vec<u32>> {
    let (starts, neighbours) = graph.adjacency();
    let (mut forward, mut inverse) = (vec![0; graph.size()], vec![0; graph.size()]);
    let mut scratch = scratch(amd::order_scratch::<u32>(graph.size(), neighbours.len()))?;
    let (pattern, stack) = (matrix_pattern(starts, neighbours), MemStack::new(&mut scratch));
    amd::order(&mut forward, &mut inverse, pattern, amd::Control::default(), stack).map_err(|_| too_large())?;
    Ok(forward)
}

/// The arrays of a pattern with indices of 32 bits.
fn narrow(pattern: &SparsityPattern) -> Result<(Vec<u32>, Vec<u32>)> {
    if pattern.nnz() > i32::MAX as usize {
        return Err(too_large());
    }
    let narrow = |numbers: &[usize]| numbers.iter().map(|&i| i as u32).collect(); // fits, as just checked
    Ok((narrow(pattern.major_offsets()), narrow(pattern.minor_indices())))
}

fn matrix_pattern<'a>(column_starts: &'a [u32], rows: &'a [u32]) -> SymbolicSparseColMatRef<'a, u32> {
    let n = column_starts.len() - 1;
    SymbolicSparseColMatRef::new_checked(n, n, column_starts, None, rows)
}

fn scratch(request: StackReq) -> Result<MemBuffer> {
    MemBuffer::try_new(request).map_err(|_| out_of_memory())
}
