//! Intrinsic Delaunay triangulation: flips edges on lengths alone, the surface stays as it is.
//!
//! An edge between two triangles is Delaunay if the angles α, β opposite it satisfy α + β ≤ π, that is
//! cot α + cot β ≥ 0: then its cotangent weight is not negative, and heat obeys a maximum principle. While an edge is
//! not, it is replaced by the other diagonal of its two triangles laid out flat. This ends (Bobenko, Springborn), in
//! practice after fewer flips than there are edges; rounding on needles could make it go on, so flips are bounded.
//!
//! Triangles are glued by half-edges, not by vertex pairs ([`super::glue`]): self-edges and multiple edges are ordinary.
//! An edge that is not glued (at a boundary, between three or more triangles, along the seam of a one-sided surface)
//! cannot flip. Where one of them should, the triangulation is doubled, so that every edge can ([`super::tufted`]).
//! What is left are edges that rounding on needles does not let flip, and those beyond the bound.
//!
//! O(F) time per sweep over the edges; typically one or two.
//!
//! References: M. Fisher, B. Springborn, P. Schröder, A. I. Bobenko: An Algorithm for the Construction of Intrinsic
//! Delaunay Triangulations with Applications to Digital Geometry Processing. Computing, 2007.
//! A. I. Bobenko, B. A. Springborn: A Discrete Laplace-Beltrami Operator for Simplicial Surfaces. Discrete &
//! Computational Geometry, 2007.

use super::glue::glue;
use super::{Metric, Scale, acuteness, area};
use crate::mesh::Mesh;
use crate::mesh::topology::{next, start};
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
    /// How many triangles are there twice, one for each side of the surface.
    pub(crate) doubled: u64,
    /// How many edges are not Delaunay in the end; an edge of doubled triangles counts once for each side.
    pub(crate) stuck: u64,
    /// Whether the flips ended by their bound, not because nothing was left to flip.
    pub(crate) bound_reached: bool,
}

/// Flips the edges of `metric`, which was made from `mesh` with `scale`, until every edge is Delaunay.
pub(crate) fn make_delaunay(metric: &mut Metric, mesh: &Mesh, scale: Scale) -> Flips {
    let twin = glue(metric, mesh);
    let mut triangulation = Triangulation { metric, twin };
    let mut flips = Flips::default();
    let mut stuck = triangulation.flip_all(triangulation.not_delaunay(), &mut flips);
    if triangulation.has_obtuse_rim(mesh) {
        stuck.extend(triangulation.double(mesh, scale, &stuck));
        stuck = triangulation.flip_all(stuck.into(), &mut flips);
        flips.doubled = triangulation.merge_sides();
    }
    flips.stuck = stuck.len() as u64;
    flips
}

/// A triangulation whose edges can flip.
pub(super) struct Triangulation<'a> {
    pub(super) metric: &'a mut Metric,
    /// The half-edge on the other side; where it is not glued, a number beyond all half-edges.
    pub(super) twin: Vec<u32>,
}

impl Triangulation<'_> {
    fn length(&self, h: u32) -> f64 {
        self.metric.lengths[(h / 3) as usize][(h % 3) as usize]
    }

    fn is_glued(&self, h: u32) -> bool {
        (self.twin[h as usize] as usize) < self.twin.len()
    }

    /// Whether cot α + cot β ≥ 0 up to rounding; a half-edge that is not glued has no β.
    pub(super) fn is_delaunay(&self, h: u32) -> bool {
        let (alpha, beta) =
            (self.acuteness(h), if self.is_glued(h) { self.acuteness(self.twin[h as usize]) } else { 0.0 });
        // Most edges need no areas, which cost a root.
        if alpha >= 0.0 && beta >= 0.0 {
            return true;
        }
        let (a, b) = (self.area(h), if self.is_glued(h) { self.area(self.twin[h as usize]) } else { 1.0 });
        let (alpha, beta) = (alpha * b, beta * a);
        alpha + beta >= -TIE * (alpha.abs() + beta.abs() + 4.0 * a * b)
    }

    /// 4 A cot θ for the angle θ opposite `h`.
    fn acuteness(&self, h: u32) -> f64 {
        acuteness(self.metric.lengths[(h / 3) as usize], (h % 3) as usize)
    }

    /// The area A of the triangle of `h`.
    fn area(&self, h: u32) -> f64 {
        area(self.metric.lengths[(h / 3) as usize])
    }

    /// The glued edges that are not Delaunay, each by its smaller half-edge, in ascending order.
    fn not_delaunay(&self) -> VecDeque<u32> {
        let halfedges = 0..self.twin.len() as u32; // fits: half-edges of the mesh
        // One of the two angles is obtuse; most triangles have none, and their neighbours need not be looked at.
        let glued = halfedges.filter(|&h| self.acuteness(h) < 0.0 && self.is_glued(h) && !self.is_delaunay(h));
        let mut edges: Vec<u32> = glued.map(|h| h.min(self.twin[h as usize])).collect();
        edges.sort_unstable();
        edges.dedup();
        edges.into()
    }

    /// Flips the edges in `queue`, and what these make flip, until all that can flip are Delaunay, and counts the flips.
    /// Returns the glued edges that are not Delaunay then, each by its smaller half-edge.
    fn flip_all(&mut self, mut queue: VecDeque<u32>, flips: &mut Flips) -> Vec<u32> {
        let most = flips.flips + (FLIPS_PER_EDGE * self.twin.len() / 2) as u64;
        let mut stuck = Vec::new();
        while let Some(h) = queue.pop_front() {
            // Since it was queued the edge may have become Delaunay, or the half-edge part of another one.
            if !self.is_glued(h) || self.is_delaunay(h) {
                continue;
            }
            if flips.flips == most || !self.flip(h) {
                flips.bound_reached |= flips.flips == most;
                stuck.push(h);
                continue;
            }
            flips.flips += 1;
            let g = self.twin[h as usize];
            let around = [next(h), next(next(h)), next(g), next(next(g))];
            queue.extend(around.iter().filter(|&&x| self.is_glued(x) && !self.is_delaunay(x)));
        }
        // The half-edges may belong to other edges by now, which were queued when these came to be.
        stuck.iter_mut().for_each(|h| *h = self.twin[*h as usize].min(*h));
        stuck.sort_unstable();
        stuck.dedup();
        stuck.retain(|&h| self.is_glued(h) && !self.is_delaunay(h));
        stuck
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
        let f = (h / 3) as usize;
        for (i, x) in [h, next(h), next(next(h))].into_iter().enumerate() {
            self.metric.triangles[f][(x % 3) as usize] = corners[i];
            self.metric.lengths[f][(x % 3) as usize] = lengths[i];
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
            if let Some(back) = self.twin.get_mut(twin as usize) {
                *back = new;
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
        let scale = Scale::of(&mesh);
        let mut metric = Metric::of(&mesh, scale);
        let before = total_area(&metric);
        let flips = make_delaunay(&mut metric, &mesh, scale);
        assert!((total_area(&metric) - before).abs() < 1e-12 * before);
        (metric, flips)
    }

    fn total_area(metric: &Metric) -> f64 {
        metric.weighted().map(|(_, lengths, weight)| weight * area(lengths)).sum()
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

    /// The obtuse triangle a b c over its own other side: a b flips to an edge from c to c, twice the height long.
    #[test]
    fn a_boundary_edge_flips_on_the_cover() {
        let positions = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.25, 0.0]];
        let (metric, flips) = flipped(&positions, &[[0, 1, 2]]);
        assert_eq!(flips, Flips { flips: 1, doubled: 1, stuck: 0, bound_reached: false });
        assert_eq!((metric.single, metric.triangles.len()), (0, 2));
        let mut corners = metric.triangles.clone();
        corners.iter_mut().for_each(|triangle| triangle.sort_unstable());
        corners.sort_unstable();
        assert_eq!(corners, [[0, 2, 2], [1, 2, 2]]);
        let shortest = metric.lengths.iter().flatten().copied().fold(f64::INFINITY, f64::min);
        assert!((shortest - 0.25).abs() < 1e-15); // 0.5 mesh units; one unit is 2
    }

    /// Three obtuse triangles on their long edge: between each two of them it flips.
    #[test]
    fn an_edge_of_three_triangles_flips_on_the_cover() {
        let positions = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, -0.1, 0.0], [0.0, 0.0, 0.1]];
        for triangles in [[[0, 1, 2], [1, 0, 3], [0, 1, 4]], [[2, 1, 0], [4, 1, 0], [3, 1, 0]]] {
            let (metric, flips) = flipped(&positions, &triangles);
            assert_eq!(flips, Flips { flips: 3, doubled: 3, stuck: 0, bound_reached: false });
            assert!(metric.triangles.iter().all(|corners| !(corners.contains(&0) && corners.contains(&1))));
        }
    }

    /// Where no angle at the boundary is obtuse all triangles stay single, and else those away from it.
    #[test]
    fn only_what_flips_is_doubled() {
        let (mut positions, triangles) = sheared([12, 12], -0.3);
        let (metric, flips) = flipped(&positions, &triangles);
        assert_eq!((flips.flips, flips.doubled, metric.single), (0, 0, triangles.len()));
        positions[13 + 6][1] = 0.3; // sees the edge below it under an obtuse angle
        let (metric, flips) = flipped(&positions, &triangles);
        assert!(flips.doubled > 0 && flips.doubled < 4, "{flips:?}");
        assert_eq!(metric.triangles.len(), triangles.len() + flips.doubled as usize);
    }

    /// A plane of needles: afterwards all is Delaunay, also at the boundary.
    #[test]
    fn needles_become_delaunay() {
        let (positions, triangles) = sheared([12, 12], 7.3);
        let (_, flips) = flipped(&positions, &triangles);
        assert!(flips.flips > 144 && flips.doubled > 0);
        assert_eq!((flips.stuck, flips.bound_reached), (0, false));
    }

    /// Each edge between two rows would flip about a thousand times.
    #[test]
    fn flips_end_at_their_bound() {
        let (positions, triangles) = sheared([1000, 1], 1000.0);
        let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
        let scale = Scale::of(&mesh);
        let mut metric = Metric::of(&mesh, scale);
        let flips = make_delaunay(&mut metric, &mesh, scale);
        assert!(flips.bound_reached && flips.stuck > 0, "{flips:?}");
        assert!(metric.lengths.iter().all(|&lengths| area(lengths) > 0.0));
    }

    /// Cells in columns and rows, each row shifted by `shear` cells.
    fn sheared([columns, rows]: [u32; 2], shear: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let at = |x: u32, y: u32| y * (columns + 1) + x;
        let positions = (0..=rows)
            .flat_map(|y| (0..=columns).map(move |x| [f64::from(x) + shear * f64::from(y), f64::from(y), 0.0]))
            .collect();
        let cells = (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y)));
        let triangles = cells
            .flat_map(|(x, y)| [[at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x + 1, y + 1), at(x, y + 1)]])
            .collect();
        (positions, triangles)
    }

    /// However the flips went, twins are each other's twins, run opposite ways and are equally long.
    #[test]
    fn twins_stay_consistent() {
        let (positions, triangles) = sheared([12, 12], 7.3);
        let mesh = Mesh::from_triangles(&positions, &triangles).unwrap();
        let scale = Scale::of(&mesh);
        let mut metric = Metric::of(&mesh, scale);
        let twin = glue(&mut metric, &mesh);
        let mut triangulation = Triangulation { metric: &mut metric, twin };
        let mut flips = Flips::default();
        triangulation.flip_all(triangulation.not_delaunay(), &mut flips);
        let rim = triangulation.double(&mesh, scale, &[]);
        assert!(triangulation.flip_all(rim.into(), &mut flips).is_empty());
        assert_eq!(triangulation.twin.len(), 6 * triangles.len());
        for h in 0..triangulation.twin.len() as u32 {
            let g = triangulation.twin[h as usize];
            let [from, to] = [h, next(h)].map(|x| start(&triangulation.metric.triangles, x));
            assert_eq!([next(g), g].map(|x| start(&triangulation.metric.triangles, x)), [from, to]);
            assert_eq!(triangulation.twin[g as usize], h);
            assert_eq!(triangulation.length(g), triangulation.length(h));
            assert!(triangulation.is_delaunay(h));
        }
    }
}
