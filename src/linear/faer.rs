//! Backend faer: supernodal sparse Cholesky A = L Lᵀ, and approximate minimum degree.

use super::factor::{Factor, Structure};
use super::graph::Graph;
use super::ordering::Ordering;
use super::{Symbolic, not_positive_definite, out_of_memory, too_large, zeros};
use crate::error::Result;
use ::faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use ::faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use ::faer::perm::PermRef;
use ::faer::sparse::linalg::SupernodalThreshold;
use ::faer::sparse::linalg::amd;
use ::faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use ::faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use ::faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use ::faer::{Par, Side};
use nalgebra_sparse::pattern::SparsityPattern;
use std::sync::Arc;

/// A pattern with the structure of its factor.
#[derive(Debug)]
pub(super) struct Analysis {
    column_starts: Vec<u32>,
    rows: Vec<u32>,
    symbolic: SymbolicCholesky<u32>,
    pub(super) structure: Arc<Structure>,
}

impl Analysis {
    pub(super) fn new(pattern: &SparsityPattern, ordering: Arc<Ordering>) -> Result<Analysis> {
        let (column_starts, rows) = narrow(pattern)?;
        let order = PermRef::new_checked(ordering.rows(), ordering.columns(), ordering.rows().len());
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let pattern = matrix_pattern(&column_starts, &rows);
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Custom(order), parameters)
            .map_err(|error| if matches!(error, FaerError::IndexOverflow) { too_large() } else { out_of_memory() })?;
        let structure = match symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(supernodal) => structure(supernodal, ordering),
            // A matrix without rows has no supernodes either.
            SymbolicCholeskyRaw::Simplicial(_) => Structure::new(ordering, vec![0], Vec::new(), vec![0], Vec::new()),
        };
        Ok(Analysis { column_starts, rows, symbolic, structure: Arc::new(structure) })
    }
}

fn structure(supernodal: &SymbolicSupernodalCholesky<u32>, ordering: Arc<Ordering>) -> Structure {
    let count = supernodal.n_supernodes();
    let mut columns = supernodal.supernode_begin().to_vec();
    columns.push(supernodal.ncols() as u32); // fits: the ordering counts by u32
    let mut row_start = vec![0];
    let mut rows = Vec::with_capacity(supernodal.row_idx().len());
    for s in 0..count {
        rows.extend_from_slice(supernodal.supernode(s).pattern());
        row_start.push(rows.len() as u32); // fits: fewer than values, which faer counts by u32
    }
    let value_start = supernodal.col_ptr_for_val()[..count].iter().map(|&start| start as usize).collect();
    Structure::new(ordering, columns, rows, row_start, value_start)
}

impl Symbolic for Analysis {
    fn factor(&self, values: &[f64]) -> Result<Factor> {
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
            Ok(_) => Ok(Factor::new(Arc::clone(&self.structure), factor)),
            Err(LltError::NonPositivePivot { .. }) => Err(not_positive_definite()),
        }
    }

    fn ordering(&self) -> &Arc<Ordering> {
        &self.structure.ordering
    }
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
