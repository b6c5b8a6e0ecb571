//! The tufted cover: both sides of every triangle, glued so that every edge lies between exactly two.
//!
//! ```text
//!        f₁                     each triangle becomes two, its sides, which share its vertices;
//!        ‖                      around an edge, the side of f₁ that faces f₂ is glued to the side
//!    f₂ ═╬═ f₄                  of f₂ that faces f₁, and so on; at a boundary a triangle's own two
//!        ‖                      sides are glued to each other
//!        f₃
//! ```
//!
//! The cover is closed, oriented and edge-manifold, whatever the soup, so every edge can flip. Heat spreads on it as on
//! the surface: a function on the vertices has the same value on both sides, and each side counts half. Along manifold
//! edges it is two copies of the surface, which is why it is made only after the edges that are glued have been flipped:
//! then only triangles near the others flip differently on their two sides, and all the rest are put together again.
//!
//! The order of three or more triangles around an edge is that of their angles in space, so that sides that face each
//! other are glued. Any order would do for the maximum principle, and before flips the operators do not see it at all; it
//! only says over which triangles flips may run. Triangles at the same angle (copies of one) lie like sheets of paper, in
//! the order of their numbers.
//!
//! O(F) time, and memory for twice the triangles until the sides are put together again; edges of three and more triangles
//! cost d log d.
//!
//! References: N. Sharp, K. Crane: A Laplacian for Nonmanifold Triangle Meshes. Computer Graphics Forum (SGP), 2020.

use super::delaunay::Triangulation;
use super::{Scale, cross, distance, dot, minus};
use crate::mesh::Mesh;
use crate::mesh::topology::{prev, start};

/// A triangle at an edge that is not glued.
struct Leaf {
    /// The edge of the mesh.
    e: u32,
    /// Where it lies around the edge, as seen against the edge's direction, which is from its smaller vertex.
    angle: f64,
    /// Its place among leaves of the same angle.
    rank: i64,
    /// The half-edge of the triangulation.
    h: u32,
}

impl Triangulation<'_> {
    /// Whether an edge that is not glued lies opposite an obtuse angle, and could be glued in a cover.
    pub(super) fn has_obtuse_rim(&self) -> bool {
        let glued = self.twin.len() as u32; // fits: half-edges of the mesh
        let sides_fit = glued.checked_mul(2).is_some();
        sides_fit && (0..glued).any(|h| self.twin[h as usize] >= glued && !self.is_delaunay(h))
    }

    /// Puts the other side of every triangle behind all of them and glues all edges. Of the edges that are new, and of the
    /// other side of `stuck`, returns those that are not Delaunay.
    pub(super) fn double(&mut self, mesh: &Mesh, scale: Scale, stuck: &[u32]) -> Vec<u32> {
        let count = self.twin.len() as u32; // fits: half-edges of the mesh
        let leaves = self.leaves(mesh, scale);
        let opposite = |h: u32| count + h - h % 3 + (2 - h % 3);
        let Triangulation { metric, twin, cot } = self;
        metric.triangles.extend_from_within(..);
        metric.lengths.extend_from_within(..);
        twin.extend_from_within(..);
        cot.extend_from_within(..);
        let triangles = metric.triangles.len() / 2;
        metric.triangles[triangles..].iter_mut().for_each(|corners| corners.swap(1, 2));
        metric.lengths[triangles..].iter_mut().for_each(|lengths| lengths.swap(0, 2));
        cot[count as usize..].chunks_exact_mut(3).for_each(|cot| cot.swap(0, 2));
        for twins in twin[count as usize..].chunks_exact_mut(3) {
            twins.swap(0, 2);
            twins.iter_mut().filter(|g| **g < count).for_each(|g| *g = opposite(*g));
        }
        let mut not_delaunay: Vec<u32> = stuck.iter().map(|&h| opposite(h)).collect();
        for around in leaves.chunk_by(|x, y| x.e == y.e) {
            let towards = mesh.topology().edges[around[0].e as usize][0];
            for (this, other) in around.iter().zip(around.iter().cycle().skip(1)) {
                // The side that is seen from larger angles runs along the edge, the other one against it.
                let sides = |h: u32| {
                    if start(&self.metric.triangles, h) == towards { [h, opposite(h)] } else { [opposite(h), h] }
                };
                let ([h, _], [_, g]) = (sides(this.h), sides(other.h));
                self.twin[h as usize] = g;
                self.twin[g as usize] = h;
                not_delaunay.extend((!self.is_delaunay(h)).then_some(h));
            }
        }
        not_delaunay
    }

    /// The triangles at all edges that are not glued, edge by edge, in their order around it.
    fn leaves(&self, mesh: &Mesh, scale: Scale) -> Vec<Leaf> {
        let glued = self.twin.len() as u32; // fits: half-edges of the mesh
        let unglued = (0..glued).zip(&self.twin).filter(|&(_, &twin)| twin >= glued);
        let mut leaves: Vec<Leaf> = unglued
            .map(|(h, twin)| {
                let origin = twin - glued;
                let e = mesh.topology().edge_of[origin as usize];
                let apex = start(mesh.triangles(), prev(origin));
                let [low, high] = mesh.topology().edges[e as usize];
                // In a pile of copies the same one is on top at all three edges, which run around it, but for the one
                // from its smallest to its largest vertex.
                let rank = if low < apex && apex < high { -i64::from(origin) } else { i64::from(origin) };
                let several = mesh.topology().halfedges.row(e).len() > 2;
                Leaf { e, angle: if several { angle(mesh, scale, [low, high], apex) } else { 0.0 }, rank, h }
            })
            .collect();
        leaves.sort_unstable_by(|x, y| x.e.cmp(&y.e).then(x.angle.total_cmp(&y.angle)).then(x.rank.cmp(&y.rank)));
        leaves
    }

    /// Makes one triangle of two sides that are still each other's mirror image. Those that are not come last, and count
    /// half; returns how many pairs they are.
    pub(super) fn merge_sides(&mut self) -> u64 {
        let metric = &mut *self.metric;
        let count = metric.triangles.len() / 2;
        let mut halves = (Vec::new(), Vec::new());
        let mut single = 0;
        for (f, g) in (0..count).zip(count..) {
            let ([a, b, c], [ab, bc, ca]) = (metric.triangles[f], metric.lengths[f]);
            if metric.triangles[g] == [a, c, b] && metric.lengths[g] == [ca, bc, ab] {
                metric.triangles[single] = [a, b, c];
                metric.lengths[single] = [ab, bc, ca];
                single += 1;
            } else {
                halves.0.extend([metric.triangles[f], metric.triangles[g]]);
                halves.1.extend([metric.lengths[f], metric.lengths[g]]);
            }
        }
        metric.single = single;
        metric.triangles.truncate(single);
        metric.lengths.truncate(single);
        metric.triangles.extend(halves.0);
        metric.lengths.extend(halves.1);
        metric.triangles.shrink_to_fit();
        (count - single) as u64
    }
}

/// The angle around the edge from `low` to `high` at which `apex` lies, counted from a direction that the edge alone
/// determines.
fn angle(mesh: &Mesh, scale: Scale, [low, high]: [u32; 2], apex: u32) -> f64 {
    let position = |v: u32| scale.unit_position(mesh.positions()[v as usize]);
    let origin = position(low);
    let (along, to_apex) = (minus(position(high), origin), minus(position(apex), origin));
    // The axis farthest from the edge's direction.
    let [i, j, k] = along.map(f64::abs);
    let axis = if i <= j && i <= k {
        [1.0, 0.0, 0.0]
    } else if j <= k {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let x = cross(along, axis);
    let y = cross(along, x);
    dot(to_apex, y).atan2(dot(to_apex, x) * distance(along, [0.0; 3]))
}
