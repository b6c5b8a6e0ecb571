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
    let renumbered = renumbering(mesh);
    if is_oriented(mesh) {
        return twins(metric, mesh, renumbered);
    }
    let reversed = reversed(mesh);
    for f in (0..).zip(&reversed).filter(|(_, reversed)| **reversed).map(|(f, _)| renumbered(3 * f) as usize / 3) {
        metric.triangles[f].swap(1, 2);
        metric.lengths[f].swap(0, 2);
    }
    twins(metric, mesh, |h| renumbered(if reversed[(h / 3) as usize] { h - h % 3 + (2 - h % 3) } else { h }))
}

/// The half-edge of the metric, which leaves ignored triangles out, for one of the mesh.
fn renumbering(mesh: &Mesh) -> impl Fn(u32) -> u32 + Copy {
    let ignored = mesh.ignored_triangles();
    move |h| h - 3 * ignored.partition_point(|&f| f < h / 3) as u32
}

/// Whether the triangles on each edge of two run along it in opposite directions.
fn is_oriented(mesh: &Mesh) -> bool {
    let halfedges = &mesh.topology().halfedges;
    let origin = |h| start(mesh.triangles(), h);
    (0..halfedges.rows()).all(|e| match *halfedges.row(e) {
        [h, g] => origin(h) != origin(g),
        _ => true,
    })
}

/// The other half-edge of each, `placed` being where the metric has a half-edge of the mesh.
fn twins(metric: &Metric, mesh: &Mesh, placed: impl Fn(u32) -> u32) -> Vec<u32> {
    let count = 3 * metric.triangles.len() as u32; // fits: half-edges of the mesh
    let mut twin = vec![0; count as usize];
    let halfedges = &mesh.topology().halfedges;
    for row in (0..halfedges.rows()).map(|e| halfedges.row(e)) {
        if let &[h, g] = row {
            let (h, g) = (placed(h), placed(g));
            if start(&metric.triangles, h) != start(&metric.triangles, g) {
                twin[h as usize] = g;
                twin[g as usize] = h;
                continue;
            }
        }
        row.iter().for_each(|&h| twin[placed(h) as usize] = count.saturating_add(h));
    }
    twin
}

/// Which triangles to reverse so that neighbours run the same way round: flood fill over the edges of two triangles.
fn reversed(mesh: &Mesh) -> Vec<bool> {
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
