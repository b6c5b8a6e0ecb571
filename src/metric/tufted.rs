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
//! other are glued. Any order would do for the maximum principle, and as long as nothing flips the operators do not see it:
//! it only says over which triangles flips may run. Triangles at the same angle, copies of one for example, are glued in the
//! order of their numbers; as one is like the other, that makes no difference but at the rim of a patch of copies.
//!
//! O(F) time, and memory for twice the triangles until the sides are put together again; edges of three and more triangles
//! cost d log d.
//!
//! References: N. Sharp, K. Crane: A Laplacian for Nonmanifold Triangle Meshes. Computer Graphics Forum (SGP), 2020.

use super::delaunay::Triangulation;
use super::glue::reversed;
use super::{Scale, cross, distance, dot, minus};
use crate::mesh::Mesh;
use crate::mesh::topology::{prev, start};

/// A triangle at an edge that is not glued.
struct Leaf {
    /// The edge of the mesh.
    e: u32,
    /// Where it lies around the edge, as seen against the edge's direction, which is from its smaller vertex.
    angle: f64,
    /// The half-edge of the triangulation.
    h: u32,
}

impl Triangulation<'_> {
    /// Whether an edge that is not glued lies opposite an obtuse angle. Not asked where the half-edges of both sides would
    /// have no 32-bit numbers: no cover can be made there.
    pub(super) fn has_obtuse_rim(&self, mesh: &Mesh) -> bool {
        let count = self.twin.len() as u32; // fits: half-edges of the mesh
        let sides_fit = (3 * mesh.triangles().len() as u32).checked_add(count).is_some();
        sides_fit && (0..count).zip(&self.twin).any(|(h, &twin)| twin >= count && !self.is_delaunay(h))
    }

    /// Puts the other side of every triangle behind all of them and glues all edges. Of the edges that are new, and of the
    /// other side of `stuck`, returns those that are not Delaunay.
    pub(super) fn double(&mut self, mesh: &Mesh, scale: Scale, stuck: &[u32]) -> Vec<u32> {
        let leaves = self.leaves(mesh, scale);
        let count = self.add_other_sides();
        let opposite = |h: u32| count + reversed(h);
        let mut not_delaunay: Vec<u32> = stuck.iter().map(|&h| opposite(h)).collect();
        for around in leaves.chunk_by(|x, y| x.e == y.e) {
            let low = mesh.topology().edges[around[0].e as usize][0];
            for (this, other) in around.iter().zip(around.iter().cycle().skip(1)) {
                // The side that faces larger angles runs from `low`, the one that faces smaller angles towards it.
                let from_low = |h: u32| start(&self.metric.triangles, h) == low;
                let h = if from_low(this.h) { this.h } else { opposite(this.h) };
                let g = if from_low(other.h) { opposite(other.h) } else { other.h };
                self.twin[h as usize] = g;
                self.twin[g as usize] = h;
                not_delaunay.extend((!self.is_delaunay(h)).then_some(h));
            }
        }
        not_delaunay
    }

    /// Puts the other side of every triangle behind all of them, glued to each other as the first sides are. Returns how many
    /// half-edges there were: half-edge h is now on the other side count + [`reversed`] h.
    fn add_other_sides(&mut self) -> u32 {
        let (count, triangles) = (self.twin.len(), self.metric.triangles.len());
        self.metric.triangles.extend_from_within(..);
        self.metric.lengths.extend_from_within(..);
        self.twin.extend_from_within(..);
        self.metric.triangles[triangles..].iter_mut().for_each(|corners| corners.swap(1, 2));
        self.metric.lengths[triangles..].iter_mut().for_each(|lengths| lengths.swap(0, 2));
        let count_u32 = count as u32; // fits: half-edges of the mesh
        for twins in self.twin[count..].chunks_exact_mut(3) {
            twins.swap(0, 2);
            twins.iter_mut().filter(|g| **g < count_u32).for_each(|g| *g = count_u32 + reversed(*g));
        }
        count_u32
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
                let several = mesh.topology().halfedges.row(e).len() > 2;
                Leaf { e, angle: if several { angle(mesh, scale, [low, high], apex) } else { 0.0 }, h }
            })
            .collect();
        leaves.sort_by(|x, y| x.e.cmp(&y.e).then(x.angle.total_cmp(&y.angle)));
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Metric;
    use crate::metric::glue::glue;

    /// Around an edge of five triangles each side is glued to the one that it faces.
    #[test]
    fn sides_that_face_each_other_are_glued() {
        let mut positions = vec![[0.1, 0.2, 0.3], [1.1, 1.2, 0.5]];
        positions.extend([[0.0, 0.0, 2.0], [2.0, -1.0, 0.0], [1.0, -2.0, -1.0], [-1.0, 0.5, -3.0], [-2.0, 1.0, 0.0]]);
        let triangles = [[1, 0, 5], [0, 1, 2], [4, 0, 1], [1, 6, 0], [3, 1, 0]];
        let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
        let scale = Scale::of(&mesh);
        let mut metric = Metric::of(&mesh, scale);
        let twin = glue(&mut metric, &mesh);
        let mut triangulation = Triangulation { metric: &mut metric, twin };
        triangulation.double(&mesh, scale, &[]);
        let [origin, end] = [0, 1].map(|v: usize| positions[v]);
        let mut glued_to = Vec::new();
        for (h, &g) in (0..).zip(&triangulation.twin) {
            let apex = |h| start(&triangulation.metric.triangles, prev(h));
            if start(&triangulation.metric.triangles, h) == 0 && start(&triangulation.metric.triangles, g) == 1 {
                // Nothing is nearer to the side of `h`, turning around the edge.
                let normal = cross(minus(end, origin), minus(positions[apex(h) as usize], origin));
                let towards = |v: u32| angle(&mesh, scale, [0, 1], v) - angle(&mesh, scale, [0, 1], apex(h));
                let turn = |v: u32| towards(v).rem_euclid(std::f64::consts::TAU);
                assert!((2..7).all(|v| v == apex(h) || turn(v) >= turn(apex(g))));
                let across = minus(positions[apex(g) as usize], origin);
                assert_eq!(dot(normal, across) > 0.0, turn(apex(g)) < std::f64::consts::PI);
                glued_to.push(apex(g));
            }
        }
        glued_to.sort_unstable();
        assert_eq!(glued_to, [2, 3, 4, 5, 6]);
    }
}
