//! The boundary, and systems whose solution is held at some vertices.
//!
//! Holding x at the vertices D turns A x = b into the same system with identity rows and columns at D and, at every
//! other vertex i, the right-hand side b_i - Σ A_ij x_j over j in D. It stays symmetric, and as zeros are kept it keeps
//! its pattern: one symbolic analysis serves the Neumann, Dirichlet and Poisson systems.

use crate::mesh::Mesh;
use nalgebra_sparse::pattern::SparsityPattern;

/// Which vertices lie on the boundary: the ends of the input's edges that have exactly one triangle.
pub(super) fn boundary_vertices(mesh: &Mesh) -> Vec<bool> {
    let topology = mesh.topology();
    let mut on_boundary = vec![false; mesh.vertex_count()];
    for (e, edge) in (0..).zip(&topology.edges) {
        if topology.is_boundary(e) {
            edge.iter().for_each(|&v| on_boundary[v as usize] = true);
        }
    }
    on_boundary
}

/// Gives the lower triangle (`pattern`, `values`) identity rows and columns where `is_held`.
pub(super) fn hold(pattern: &SparsityPattern, values: &mut [f64], is_held: impl Fn(usize) -> bool) {
    for ((row, column), value) in entries(pattern).zip(values) {
        if is_held(row) || is_held(column) {
            *value = f64::from(row == column);
        }
    }
}

/// Moves the held values, which stand in `b` at their vertices, to the right-hand side of the other vertices.
pub(super) fn move_held(pattern: &SparsityPattern, values: &[f64], held: &[bool], b: &mut [f64]) {
    for ((row, column), value) in entries(pattern).zip(values) {
        match (held[row], held[column]) {
            (true, false) => b[column] -= value * b[row],
            (false, true) => b[row] -= value * b[column],
            _ => {}
        }
    }
}

/// Row and column of every entry, in the order of the values.
fn entries(pattern: &SparsityPattern) -> impl Iterator<Item = (usize, usize)> {
    (0..pattern.major_dim()).flat_map(|column| pattern.lane(column).iter().map(move |&row| (row, column)))
}
