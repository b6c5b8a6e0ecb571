//! Exact distances by brute force: every straight line from every vertex, over every strip of triangles.
//!
//! From a vertex each triangle on it is laid flat, and across each edge every other triangle on that edge, again and
//! again, whatever the orientations. Of the directions that reach an edge a cone is kept; a vertex inside it is seen
//! along a straight line, a *leg*. A shortest path is straight between the vertices it passes, so the distances are
//! shortest paths over the legs (Floyd, Warshall).
//!
//! *A strip has no triangle twice*: what a shortest path does between two visits to a triangle can be replaced by a
//! chord of the triangle, which is flat and convex, so no longer; some shortest path visits each triangle once.
//!
//! *Rounding*: an end of a cone is a ray through a vertex of the strip, and legs start from that vertex too. Where
//! rounding ε sees a vertex beside such a ray, or misses it, the leg and the way by the vertex on the ray differ by
//! about ε² over the shorter of its halves. So cones are closed without a tolerance, and neither a cone of less than
//! [`NARROW`] nor an edge without length is followed. Not narrow is the half plane that a vertex sees if it lies on the
//! far edge of its own triangle without area; that is decided rightly where cross products are exact, as on a lattice.
//!
//! Cost: the number of strips that a straight line passes, exponential in the number of triangles on shared edges.

use std::collections::HashMap;

type Point = [f64; 3];
type Flat = [f64; 2];

/// The sine of an angle beyond which a cone is worth following: far above rounding, and its square far below.
const NARROW: f64 = 1e-12;

/// The distance from each vertex to each: +inf where no triangle leads.
pub(crate) fn distances(points: &[Point], triangles: &[[u32; 3]]) -> Vec<Vec<f64>> {
    let faces: Vec<[usize; 3]> = triangles
        .iter()
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .map(|triangle| triangle.map(|v| v as usize))
        .collect();
    let mut on_edge: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    for (f, &[a, b, c]) in faces.iter().enumerate() {
        for edge in [[a, b], [b, c], [c, a]] {
            on_edge.entry(sorted(edge)).or_default().push(f);
        }
    }
    let mut along_edges = vec![vec![f64::INFINITY; points.len()]; points.len()];
    for &[a, b] in on_edge.keys() {
        let length = norm(minus(points[a], points[b]));
        [along_edges[a][b], along_edges[b][a]] = [length, length];
    }
    let mut legs = along_edges.clone();
    join(&mut along_edges);
    for v in 0..points.len() {
        let farthest = along_edges[v].iter().copied().filter(|d| d.is_finite()).fold(0.0, f64::max);
        let in_strip = vec![false; faces.len()];
        Search { points, faces: &faces, on_edge: &on_edge, farthest, in_strip, legs: &mut legs[v] }.from(v);
    }
    join(&mut legs);
    legs
}

/// From lengths of legs to shortest paths over them; a leg holds both ways.
fn join(legs: &mut [Vec<f64>]) {
    let n = legs.len();
    let pairs = || (0..n).flat_map(|a| (0..n).map(move |b| (a, b)));
    for (a, b) in pairs() {
        legs[a][b] = if a == b { 0.0 } else { legs[a][b].min(legs[b][a]) };
    }
    for over in 0..n {
        for (a, b) in pairs() {
            legs[a][b] = legs[a][b].min(legs[a][over] + legs[over][b]);
        }
    }
}

/// The straight lines from one vertex, which lies at the origin of the plane.
struct Search<'a> {
    points: &'a [Point],
    faces: &'a [[usize; 3]],
    on_edge: &'a HashMap<[usize; 2], Vec<usize>>,
    /// No leg of a shortest path is longer.
    farthest: f64,
    in_strip: Vec<bool>,
    /// The shortest leg to each vertex so far.
    legs: &'a mut [f64],
}

/// An edge laid flat, and the directions that reach it; seen from the origin its first end is on the right.
#[derive(Clone, Copy)]
struct Reached {
    ends: [usize; 2],
    at: [Flat; 2],
    cone: [Flat; 2],
}

impl Search<'_> {
    fn from(&mut self, v: usize) {
        for f in 0..self.faces.len() {
            let Some(k) = self.faces[f].iter().position(|&corner| corner == v) else { continue };
            let ends = [self.faces[f][(k + 1) % 3], self.faces[f][(k + 2) % 3]];
            let [q, p] = ends.map(|end| minus(self.points[end], self.points[v]));
            if norm(q) == 0.0 || norm(p) == 0.0 {
                continue; // that vertex sees the rest
            }
            let at = [[norm(q), 0.0], [dot(q, p) / norm(q), norm(cross(q, p)) / norm(q)]];
            self.in_strip[f] = true;
            self.cross(Reached { ends, at, cone: at });
            self.in_strip[f] = false;
        }
    }

    /// Lays every triangle flat that lies across an edge.
    fn cross(&mut self, edge: Reached) {
        let is_point = self.points[edge.ends[0]] == self.points[edge.ends[1]];
        if is_point || is_narrow(edge.cone) || distance_to(edge.at) > self.farthest {
            return;
        }
        for &f in &self.on_edge[&sorted(edge.ends)] {
            if !self.in_strip[f] {
                self.in_strip[f] = true;
                self.enter(f, edge);
                self.in_strip[f] = false;
            }
        }
    }

    fn enter(&mut self, f: usize, Reached { ends: [q, p], at: [at_q, at_p], cone: [right, left] }: Reached) {
        let Some(c) = self.faces[f].into_iter().find(|&corner| corner != q && corner != p) else { return };
        let at_c = self.beyond([q, p, c], at_q, at_p);
        let [is_left_of_right, is_right_of_left] = [turn(right, at_c) >= 0.0, turn(at_c, left) >= 0.0];
        if is_left_of_right && is_right_of_left {
            self.legs[c] = self.legs[c].min(at_c[0].hypot(at_c[1]));
        }
        if at_c == [0.0; 2] {
            return; // that vertex sees the rest
        }
        if is_left_of_right {
            let cone = [right, if is_right_of_left { at_c } else { left }];
            self.cross(Reached { ends: [q, c], at: [at_q, at_c], cone });
        }
        if is_right_of_left {
            let cone = [if is_left_of_right { at_c } else { right }, left];
            self.cross(Reached { ends: [c, p], at: [at_c, at_p], cone });
        }
    }

    /// Where c comes to lie beyond the edge from q (right) to p (left).
    fn beyond(&self, [q, p, c]: [usize; 3], at_q: Flat, at_p: Flat) -> Flat {
        let [edge, side] = [p, c].map(|v| minus(self.points[v], self.points[q]));
        let [along, away] = [dot(side, edge) / norm(edge), norm(cross(side, edge)) / norm(edge)];
        let [x, y] = [at_p[0] - at_q[0], at_p[1] - at_q[1]];
        // A unit vector, so that rounding on a short edge turns the rest of the strip but does not stretch it.
        let length = x.hypot(y);
        let [x, y] = [x / length, y / length];
        [at_q[0] + along * x + away * y, at_q[1] + along * y - away * x]
    }
}

/// Positive where b is to the left of a, both seen from the origin.
fn turn(a: Flat, b: Flat) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn is_narrow([right, left]: [Flat; 2]) -> bool {
    let along = right[0] * left[0] + right[1] * left[1];
    along > 0.0 && turn(right, left) <= NARROW * along
}

/// How far a segment is from the origin.
fn distance_to([q, p]: [Flat; 2]) -> f64 {
    let [x, y] = [p[0] - q[0], p[1] - q[1]];
    let along = (-(q[0] * x + q[1] * y) / (x * x + y * y)).clamp(0.0, 1.0);
    (q[0] + along * x).hypot(q[1] + along * y)
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}
