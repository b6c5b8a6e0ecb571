//! Intrinsic Delaunay triangulation: flips edges on lengths alone, the surface stays as it is.
//!
//! An edge between two triangles is Delaunay if the angles α, β opposite it satisfy α + β ≤ π, that is
//! cot α + cot β ≥ 0: then its cotangent weight is not negative, and heat obeys a maximum principle. While an edge is
//! not, it is replaced by the other diagonal of its two triangles laid out flat. This ends (Bobenko, Springborn), in
//! practice after fewer flips than there are edges; rounding on needles could make it go on, so flips are bounded.
//!
//! Triangles are glued by half-edges, not by vertex pairs: self-edges and multiple edges are ordinary. An edge is glued
//! if exactly two triangles lie on it and they can be oriented alike; boundaries, edges with three or more triangles
//! and the seam that remains in a one-sided surface cannot flip.
//!
//! O(F) time per sweep over the edges; typically one or two.
//!
//! References: M. Fisher, B. Springborn, P. Schröder, A. I. Bobenko: An Algorithm for the Construction of Intrinsic
//! Delaunay Triangulations with Applications to Digital Geometry Processing. Computing, 2007.
//! A. I. Bobenko, B. A. Springborn: A Discrete Laplace-Beltrami Operator for Simplicial Surfaces. Discrete &
//! Computational Geometry, 2007.

use super::{Metric, area, cotangents};
use crate::mesh::Mesh;
use crate::mesh::topology::{NONE, next, start};
use std::collections::VecDeque;

/// An edge flips if cot α + cot β is below minus this share of |cot α| + |cot β| + 1, so that ties of four points on a
/// circle do not flip back and forth.
const TIE: f64 = 1e-10;

/// The flips end after this many per edge.
const FLIPS_PER_EDGE: usize = 50;

/// What the flips came to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Flips {
    /// How many edges were flipped.
    pub(crate) flips: u64,
    /// How many edges are not Delaunay but cannot flip. An edge that is not glued counts once for each triangle on it
    /// whose opposite angle is obtuse.
    pub(crate) stuck: u64,
}

/// Flips the edges of `metric`, which was made from `mesh`, until every edge that can flip is Delaunay.
pub(crate) fn make_delaunay(metric: &mut Metric, mesh: &Mesh) -> Flips {
    let twin = glue(metric, mesh);
    let cot = metric.lengths.iter().flat_map(|&lengths| cotangents(lengths)).collect();
    let mut triangulation = Triangulation { metric, twin, cot };
    let flips = triangulation.flip_all();
    let halfedges = 0..triangulation.twin.len() as u32; // fits: half-edges of the mesh
    // A glued edge is counted at its smaller half-edge; NONE is greater than any.
    let stuck = halfedges.filter(|&h| triangulation.twin[h as usize] > h && !triangulation.is_delaunay(h)).count();
    Flips { flips, stuck: stuck as u64 }
}

/// Orients the triangles alike as far as they can be, and returns the half-edge on the other side of each half-edge,
/// which then runs the opposite way; NONE where there is none.
fn glue(metric: &mut Metric, mesh: &Mesh) -> Vec<u32> {
    let pairs = pairs(mesh);
    let reversed = reversed(metric, &pairs);
    for (f, _) in reversed.iter().enumerate().filter(|&(_, &reversed)| reversed) {
        metric.triangles[f].swap(1, 2);
        metric.lengths[f].swap(0, 2);
    }
    let moved = |h: u32| if reversed[(h / 3) as usize] { h - h % 3 + (2 - h % 3) } else { h };
    let mut twin = vec![NONE; 3 * metric.triangles.len()];
    for [h, g] in pairs.iter().map(|pair| pair.map(moved)) {
        if start(&metric.triangles, h) != start(&metric.triangles, g) {
            twin[h as usize] = g;
            twin[g as usize] = h;
        }
    }
    twin
}

/// The two half-edges of every edge that has exactly two, numbered as in the metric, which leaves ignored triangles out.
fn pairs(mesh: &Mesh) -> Vec<[u32; 2]> {
    let halfedges = &mesh.topology().halfedges;
    let ignored = mesh.ignored_triangles();
    let renumbered = |h: u32| h - 3 * ignored.partition_point(|&f| f < h / 3) as u32;
    let two = (0..halfedges.rows()).filter_map(|e| <[u32; 2]>::try_from(halfedges.row(e)).ok());
    two.map(|pair| pair.map(renumbered)).collect()
}

/// Which triangles to reverse so that neighbours run the same way round: flood fill over the pairs.
fn reversed(metric: &Metric, pairs: &[[u32; 2]]) -> Vec<bool> {
    let triangles = &metric.triangles;
    let mut across = vec![NONE; 3 * triangles.len()];
    for &[h, g] in pairs {
        across[h as usize] = g;
        across[g as usize] = h;
    }
    let mut reversed = vec![false; triangles.len()];
    let mut seen = vec![false; triangles.len()];
    let mut stack = Vec::new();
    for seed in 0..triangles.len() as u32 {
        if !std::mem::replace(&mut seen[seed as usize], true) {
            stack.push(seed);
        }
        while let Some(f) = stack.pop() {
            for h in 3 * f..3 * f + 3 {
                let g = across[h as usize];
                if g != NONE && !std::mem::replace(&mut seen[(g / 3) as usize], true) {
                    let same_way = start(triangles, h) == start(triangles, g);
                    reversed[(g / 3) as usize] = reversed[f as usize] ^ same_way;
                    stack.push(g / 3);
                }
            }
        }
    }
    reversed
}

/// A triangulation whose edges can flip.
struct Triangulation<'a> {
    metric: &'a mut Metric,
    /// The half-edge on the other side, or NONE.
    twin: Vec<u32>,
    /// The cotangent of the angle opposite each half-edge.
    cot: Vec<f64>,
}

impl Triangulation<'_> {
    fn length(&self, h: u32) -> f64 {
        self.metric.lengths[(h / 3) as usize][(h % 3) as usize]
    }

    /// Whether cot α + cot β ≥ 0 up to rounding; a half-edge that is not glued has no β.
    fn is_delaunay(&self, h: u32) -> bool {
        let (alpha, beta) = (self.cot[h as usize], self.cot.get(self.twin[h as usize] as usize).unwrap_or(&0.0));
        alpha + beta >= -TIE * (alpha.abs() + beta.abs() + 1.0)
    }

    /// Flips until no glued edge that can flip is left that is not Delaunay; returns the number of flips.
    fn flip_all(&mut self) -> u64 {
        let halfedges = self.twin.len() as u32; // fits: half-edges of the mesh
        let glued = |&h: &u32| self.twin[h as usize] != NONE && self.twin[h as usize] > h;
        let mut queue: VecDeque<u32> = (0..halfedges).filter(glued).filter(|&h| !self.is_delaunay(h)).collect();
        let most = FLIPS_PER_EDGE * self.twin.len() / 2;
        let mut flips = 0;
        while let Some(h) = queue.pop_front() {
            // The edge may have become Delaunay since it was queued.
            if flips < most && !self.is_delaunay(h) && self.flip(h) {
                flips += 1;
                let g = self.twin[h as usize];
                let around = [next(h), next(next(h)), next(g), next(next(g))];
                queue.extend(around.iter().filter(|&&x| self.twin[x as usize] != NONE && !self.is_delaunay(x)));
            }
        }
        flips as u64
    }

    /// Replaces edge a b, between triangles a b c and b a d, by c d, where both new triangles are proper.
    fn flip(&mut self, h: u32) -> bool {
        let g = self.twin[h as usize];
        let ([bc, ca], [ad, db]) = ([next(h), next(next(h))], [next(g), next(next(g))]);
        if h / 3 == g / 3 {
            return false;
        }
        let cd = self.diagonal(h, g);
        let lengths_h = [cd, self.length(ca), self.length(ad)];
        let lengths_g = [cd, self.length(db), self.length(bc)];
        // Not so where rounding spoils a needle; NaN is not greater either.
        if !(area(lengths_h) > 0.0 && area(lengths_g) > 0.0) {
            return false;
        }
        let origin = |x: u32| start(&self.metric.triangles, x);
        let [a, b, c, d] = [origin(h), origin(g), origin(ca), origin(db)];
        self.set_triangle(h, [d, c, a], lengths_h);
        self.set_triangle(g, [c, d, b], lengths_g);
        self.reglue([(ca, bc), (ad, ca), (db, ad), (bc, db)]);
        true
    }

    /// The length of the other diagonal when the triangles of `h` and `g` lie flat side by side.
    fn diagonal(&self, h: u32, g: u32) -> f64 {
        let base = self.length(h);
        // Apex over a at the origin and b at (base, 0).
        let apex = |from_a: f64, from_b: f64| {
            let x = (base + (from_a - from_b) / base * (from_a + from_b)) / 2.0;
            (x, 2.0 * area([base, from_a, from_b]) / base)
        };
        let c = apex(self.length(next(next(h))), self.length(next(h)));
        let d = apex(self.length(next(g)), self.length(next(next(g))));
        (c.0 - d.0).hypot(c.1 + d.1)
    }

    /// Fills the triangle of `h`, beginning at `h`.
    fn set_triangle(&mut self, h: u32, corners: [u32; 3], lengths: [f64; 3]) {
        let cot = cotangents(lengths);
        let f = (h / 3) as usize;
        for (i, x) in [h, next(h), next(next(h))].into_iter().enumerate() {
            self.metric.triangles[f][(x % 3) as usize] = corners[i];
            self.metric.lengths[f][(x % 3) as usize] = lengths[i];
            self.cot[x as usize] = cot[i];
        }
    }

    /// Gives each new half-edge the twin that its old one had; the four may be glued to each other.
    fn reglue(&mut self, moves: [(u32, u32); 4]) {
        let twins = moves.map(|(old, _)| {
            let twin = self.twin[old as usize];
            moves.iter().find(|&&(old, _)| old == twin).map_or(twin, |&(_, new)| new)
        });
        for ((_, new), twin) in moves.into_iter().zip(twins) {
            self.twin[new as usize] = twin;
            if twin != NONE {
                self.twin[twin as usize] = new;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Scale;

    fn flipped(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Metric, Flips) {
        let mesh = Mesh::from_triangles(positions, triangles).unwrap();
        let mut metric = Metric::of(&mesh, Scale::of(&mesh));
        let before = total_area(&metric);
        let flips = make_delaunay(&mut metric, &mesh);
        assert!((total_area(&metric) - before).abs() < 1e-12 * before);
        (metric, flips)
    }

    fn total_area(metric: &Metric) -> f64 {
        metric.lengths.iter().map(|&lengths| area(lengths)).sum()
    }

    /// The long diagonal of a flat rhombus becomes the short one, whichever way the triangles run.
    #[test]
    fn a_rhombus_gets_its_short_diagonal() {
        let positions = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.25, 0.0], [0.0, -0.25, 0.0]];
        for second in [[1, 0, 3], [0, 1, 3]] {
            let (metric, flips) = flipped(&positions, &[[0, 1, 2], second]);
            assert_eq!(flips.flips, 1);
            let mut corners = metric.triangles.clone();
            corners.iter_mut().for_each(|triangle| triangle.sort_unstable());
            corners.sort_unstable();
            assert_eq!(corners, [[0, 2, 3], [1, 2, 3]]);
            let shortest = metric.lengths.iter().flatten().copied().fold(f64::INFINITY, f64::min);
            assert!((shortest - 0.25).abs() < 1e-15); // 0.5 mesh units; one unit is 2
        }
    }

    /// A triangle glued to its mirror image along all edges: the edge opposite the obtuse angle flips to one that joins
    /// their common apex to itself.
    #[test]
    fn an_edge_may_join_a_vertex_to_itself() {
        let positions = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.25, 0.0]];
        let (metric, flips) = flipped(&positions, &[[0, 1, 2], [2, 1, 0]]);
        assert_eq!((flips.flips, flips.stuck), (1, 0));
        assert!(metric.triangles.iter().all(|&[a, b, c]| a == b || b == c || c == a));
    }

    #[test]
    fn edges_of_boundaries_and_of_three_triangles_stay() {
        let positions = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, -0.1, 0.0], [0.0, 0.0, 0.1]];
        let (_, flips) = flipped(&positions, &[[0, 1, 2]]);
        assert_eq!((flips.flips, flips.stuck), (0, 1));
        let (_, flips) = flipped(&positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
        assert_eq!((flips.flips, flips.stuck), (0, 3));
    }

    /// A plane sheared to needles: afterwards all is Delaunay but at the boundary.
    #[test]
    fn needles_become_delaunay() {
        let n = 12u32;
        let at = |x: u32, y: u32| y * (n + 1) + x;
        let positions: Vec<[f64; 3]> = (0..=n)
            .flat_map(|y| (0..=n).map(move |x| [f64::from(x) + 7.3 * f64::from(y), f64::from(y), 0.0]))
            .collect();
        let cells = (0..n).flat_map(|y| (0..n).map(move |x| (x, y)));
        let triangles: Vec<[u32; 3]> = cells
            .flat_map(|(x, y)| [[at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x + 1, y + 1), at(x, y + 1)]])
            .collect();
        let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
        let mut metric = Metric::of(&mesh, Scale::of(&mesh));
        let twin = glue(&mut metric, &mesh);
        let cot = metric.lengths.iter().flat_map(|&lengths| cotangents(lengths)).collect();
        let mut triangulation = Triangulation { metric: &mut metric, twin, cot };
        assert!(triangulation.flip_all() > u64::from(n * n));
        for h in 0..triangulation.twin.len() as u32 {
            let g = triangulation.twin[h as usize];
            if g != NONE {
                assert!(triangulation.is_delaunay(h));
                assert_eq!(triangulation.twin[g as usize], h);
                assert_eq!(triangulation.length(g), triangulation.length(h));
            }
        }
    }
}
