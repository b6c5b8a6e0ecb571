//! The boundary: edges with one triangle, chained.
//!
//! At a vertex a boundary edge goes on to the boundary edge at the other end of its fan of triangles; so where two holes
//! touch in a vertex, they stay two.

use crate::mesh::Mesh;
use crate::mesh::fan::{WalkEnd, walk};
use crate::mesh::topology::{next, prev, start};

/// A chain of boundary edges.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoundaryLoop {
    /// Its vertices in order; the first is not repeated at the end. Where fans touch, a vertex may occur twice.
    pub vertices: Vec<u32>,
    /// Whether the last vertex is joined to the first; a chain that is not closed ends at edges of more than two
    /// triangles.
    pub is_closed: bool,
}

/// The chains, ordered by their smallest half-edge.
pub(super) fn loops(mesh: &Mesh) -> Vec<BoundaryLoop> {
    let topology = mesh.topology();
    let mut is_open: Vec<bool> = (0..topology.halfedges.rows()).map(|e| topology.is_boundary(e)).collect();
    let mut loops = Vec::new();
    for (h, &e) in (0..).zip(&topology.edge_of) {
        // An ignored triangle has no edges.
        if is_open.get(e as usize) == Some(&true) {
            loops.push(chain(mesh, h, &mut is_open));
        }
    }
    loops
}

/// The chain of half-edge `first`; its edges are taken out of `is_open`.
fn chain(mesh: &Mesh, first: u32, is_open: &mut [bool]) -> BoundaryLoop {
    let [tail, head] = [first, next(first)].map(|h| start(mesh.triangles(), h));
    let (mut vertices, is_closed) = follow(mesh, first, head, is_open);
    if !is_closed {
        let (back, _) = follow(mesh, first, tail, is_open);
        vertices = back.into_iter().rev().chain(vertices).collect();
    } else {
        vertices.rotate_right(1); // begins with `tail`, which came last
    }
    BoundaryLoop { vertices, is_closed }
}

/// Goes along the boundary from edge `first` towards its end `v`: the vertices that are met, `v` first, and whether the
/// way came back to `first`.
fn follow(mesh: &Mesh, first: u32, v: u32, is_open: &mut [bool]) -> (Vec<u32>, bool) {
    let (mut h, mut v) = (first, v);
    let mut vertices = Vec::new();
    loop {
        is_open[mesh.topology().edge_of[h as usize] as usize] = false;
        vertices.push(v);
        // The corner at v of the triangle of h, and the triangle's other edge there.
        let (corner, leave) = if start(mesh.triangles(), h) == v { (h, prev(h)) } else { (next(h), next(h)) };
        match walk(mesh, v, corner, leave, |_| {}) {
            WalkEnd::Boundary(end) if end == first => return (vertices, true),
            WalkEnd::Boundary(end) => h = end,
            WalkEnd::Closed | WalkEnd::NonManifold => return (vertices, false),
        }
        let [a, b] = [h, next(h)].map(|h| start(mesh.triangles(), h));
        v = if a == v { b } else { a };
    }
}
