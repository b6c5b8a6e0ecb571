//! How the triangles at a vertex lie around it.
//!
//! Triangles that follow each other across edges at the vertex form a *fan*; one fan, closed or between two boundary
//! edges, is what a manifold vertex has. O(d) for a vertex of degree d.

use super::Mesh;
use super::topology::{Topology, next, prev, start};

/// The triangles at a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Fan {
    /// They form one cycle.
    Closed,
    /// They form one chain between two boundary edges.
    Open,
    /// There are none, several fans, or an edge with more than two triangles.
    Other,
}

/// How the triangles at `v` lie around it. If they form one fan `order` gets its corners, each beside the one before.
pub(crate) fn fan(mesh: &Mesh, v: u32, order: &mut Vec<u32>) -> Fan {
    let corners = mesh.topology().corners.row(v);
    order.clear();
    let Some(&first) = corners.first() else { return Fan::Other };
    order.push(first);
    let mut fan = match walk(mesh, v, first, first, |corner| order.push(corner)) {
        WalkEnd::Closed => Fan::Closed,
        WalkEnd::Boundary(_) => Fan::Open,
        WalkEnd::NonManifold => Fan::Other,
    };
    if fan == Fan::Open {
        order.reverse();
        let end = walk(mesh, v, first, prev(first), |corner| order.push(corner));
        fan = if matches!(end, WalkEnd::Boundary(_)) { Fan::Open } else { Fan::Other };
    }
    if order.len() == corners.len() { fan } else { Fan::Other }
}

/// What ends a walk around a vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WalkEnd {
    /// The corner where it began.
    Closed,
    /// This half-edge, which has no other triangle.
    Boundary(u32),
    /// An edge with more than two triangles.
    NonManifold,
}

/// Walks around `v` from the corner at half-edge `first`, leaving each triangle by the edge at `v` it was not entered
/// by, `leave` first. Tells the corners behind the first, and returns what ended it.
pub(crate) fn walk(mesh: &Mesh, v: u32, first: u32, leave: u32, mut tell: impl FnMut(u32)) -> WalkEnd {
    let topology = mesh.topology();
    let mut leave = leave;
    loop {
        let beyond = match topology.others(leave) {
            Others::None => return WalkEnd::Boundary(leave),
            Others::One(h) => h,
            Others::Many => return WalkEnd::NonManifold,
        };
        // In the next triangle the two half-edges at v are the corner's own and the one before it.
        let starts_here = start(mesh.triangles(), beyond) == v;
        let (corner, exit) = if starts_here { (beyond, prev(beyond)) } else { (next(beyond), next(beyond)) };
        if corner == first {
            return WalkEnd::Closed;
        }
        tell(corner);
        leave = exit;
    }
}

enum Others {
    None,
    One(u32),
    Many,
}

impl Topology {
    /// The half-edges on the edge of `h` besides `h`.
    fn others(&self, h: u32) -> Others {
        match self.halfedges.row(self.edge_of[h as usize]) {
            [_] => Others::None,
            &[a, b] => Others::One(if a == h { b } else { a }),
            _ => Others::Many,
        }
    }
}
