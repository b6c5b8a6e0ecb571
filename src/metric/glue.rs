//! Gluing: which half-edge lies on the other side of which, after the triangles were oriented alike as far as possible.
//!
//! An edge is glued if exactly two triangles lie on it and they run along it in opposite directions. Where the input's
//! triangles do not, a flood fill over the edges of two triangles reverses some of them; a seam remains where the surface
//! is one-sided.
//!
//! O(F) time.

use super::Metric;
use crate::mesh::Mesh;
use crate::mesh::topology::start;

/// Orients the triangles alike as far as they can be, and returns the half-edge on the other side of each half-edge,
/// which then runs the opposite way. Where there is none: the number of half-edges plus the half-edge of `mesh` that
/// this one is, so that [`super::tufted`] knows it however the triangles around it change; or `u32::MAX` where that sum
/// does not fit.
pub(super) fn glue(metric: &mut Metric, mesh: &Mesh) -> Vec<u32> {
    let ignored = mesh.ignored_triangles();
    // The metric leaves ignored triangles out.
    let renumbered = |h: u32| h - 3 * ignored.partition_point(|&f| f < h / 3) as u32;
    let (twin, oriented) = twins(metric, mesh, renumbered);
    if oriented {
        return twin;
    }
    let is_reversed = to_reverse(mesh);
    for (f, _) in (0..).zip(&is_reversed).filter(|(_, reversed)| **reversed) {
        let f = (renumbered(3 * f) / 3) as usize;
        metric.triangles[f].swap(1, 2);
        metric.lengths[f].swap(0, 2);
    }
    twins(metric, mesh, |h| renumbered(if is_reversed[(h / 3) as usize] { reversed(h) } else { h })).0
}

/// The number of a half-edge when its triangle names its second and third corner in the other order.
pub(super) fn reversed(h: u32) -> u32 {
    h - h % 3 + (2 - h % 3)
}

/// The other half-edge of each, `placed` telling where the metric has a half-edge of the mesh; and whether, on every edge of
/// two triangles, these run along it in opposite directions.
fn twins(metric: &Metric, mesh: &Mesh, placed: impl Fn(u32) -> u32) -> (Vec<u32>, bool) {
    let count = 3 * metric.triangles.len() as u32; // fits: half-edges of the mesh
    let mut twin = vec![0; count as usize];
    let mut oriented = true;
    let halfedges = &mesh.topology().halfedges;
    for row in (0..halfedges.rows()).map(|e| halfedges.row(e)) {
        if let &[h, g] = row {
            let (h, g) = (placed(h), placed(g));
            if start(&metric.triangles, h) != start(&metric.triangles, g) {
                twin[h as usize] = g;
                twin[g as usize] = h;
                continue;
            }
            oriented = false;
        }
        row.iter().for_each(|&h| twin[placed(h) as usize] = count.saturating_add(h));
    }
    (twin, oriented)
}

/// Which triangles to reverse so that neighbours run the same way round: flood fill over the edges of two triangles.
fn to_reverse(mesh: &Mesh) -> Vec<bool> {
    let (triangles, topology) = (mesh.triangles(), mesh.topology());
    let mut reversed = vec![false; triangles.len()];
    let mut seen = vec![false; triangles.len()];
    mesh.ignored_triangles().iter().for_each(|&f| seen[f as usize] = true);
    let mut stack = Vec::new();
    for seed in 0..triangles.len() as u32 {
        if !std::mem::replace(&mut seen[seed as usize], true) {
            stack.push(seed);
        }
        while let Some(f) = stack.pop() {
            for h in 3 * f..3 * f + 3 {
                let &[x, y] = topology.halfedges.row(topology.edge_of[h as usize]) else { continue };
                let g = if x == h { y } else { x };
                if !std::mem::replace(&mut seen[(g / 3) as usize], true) {
                    let same_way = start(triangles, h) == start(triangles, g);
                    reversed[(g / 3) as usize] = reversed[f as usize] ^ same_way;
                    stack.push(g / 3);
                }
            }
        }
    }
    reversed
}
