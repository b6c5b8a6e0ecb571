//! Each triangle laid flat along each of its edges: all the geometry that exact distances need.
//!
//! The chart of half-edge h puts its start at the origin, its end on the positive x axis and the third corner, the
//! *apex*, at (tx, ty) with ty > 0. It is taken from the coordinates, not from three lengths: in a triangle with an angle
//! of 1e-7 the height would lose half of its digits to cancellation in the lengths, but only a third in the cross
//! product. No angle is needed but the sum at each vertex.
//!
//! A vertex is a *pseudo-source* where a shortest path can bend: its angles sum to more than 2π (π at a boundary), or
//! its triangles do not form one closed or one open fan, or one of them is a sliver: there rounding decides on which side
//! of the vertex a straight line passes, and neither side may be left out. A pseudo-source too many costs time only.
//!
//! O(V + F) time; 24 bytes per half-edge.

use crate::mesh::Mesh;
use crate::mesh::topology::{Topology, next, prev, start};
use crate::metric::Scale;
use std::f64::consts::PI;

/// A triangle laid flat along one of its half-edges.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chart {
    /// Length of the half-edge.
    pub(crate) length: f64,
    /// Coordinates of the apex.
    pub(crate) tx: f64,
    pub(crate) ty: f64,
}

/// A height below this share of the longest edge is raised to it: then a triangle without area still conducts along
/// its edges and no ray is parallel to an edge. It moves nothing by more than the rounding of the coordinates.
const LEAST_HEIGHT: f64 = 1.0 / (1u64 << 48) as f64;

/// Angles are summed to about this accuracy; a vertex that is flat up to it is not a pseudo-source.
const ANGLE_TOLERANCE: f64 = 1e-9;

/// The chart of every half-edge, in units of `scale`; those of ignored triangles are never used.
pub(crate) fn charts(mesh: &Mesh, scale: Scale) -> Vec<Chart> {
    let positions = scale.unit_positions(mesh);
    mesh.triangles().iter().flat_map(|t| triangle_charts(t.map(|v| positions[v as usize]))).collect()
}

fn triangle_charts([a, b, c]: [[f64; 3]; 3]) -> [Chart; 3] {
    let sides = [minus(b, a), minus(c, b), minus(a, c)];
    let lengths = sides.map(|side| dot(side, side).sqrt());
    let longest = lengths[0].max(lengths[1]).max(lengths[2]);
    let double_area = double_area(sides, lengths);
    std::array::from_fn(|k| {
        let length = lengths[k];
        let to_apex = sides[(k + 2) % 3].map(|x| -x);
        if length == 0.0 {
            return Chart { length, tx: 0.0, ty: lengths[(k + 1) % 3].max(longest * LEAST_HEIGHT) };
        }
        let ty = (double_area / length).max(longest * LEAST_HEIGHT);
        Chart { length, tx: dot(to_apex, sides[k]) / length, ty }
    })
}

/// Cross product of the two shorter sides: its rounding error is proportional to the product of their lengths.
fn double_area(sides: [[f64; 3]; 3], lengths: [f64; 3]) -> f64 {
    let longest = (0..3).fold(0, |k, l| if lengths[l] > lengths[k] { l } else { k });
    let cross = cross(sides[(longest + 1) % 3], sides[(longest + 2) % 3]);
    dot(cross, cross).sqrt()
}

/// Which triangles are *slivers*: lower than this share of one of their edges. A straight line turns so little in them
/// that it may cross very many of them, or the same ones again and again, before it grows longer.
const SLIVER_HEIGHT: f64 = 1e-6;

pub(crate) fn slivers(charts: &[Chart]) -> Vec<bool> {
    charts
        .chunks_exact(3)
        .map(|triangle| triangle.iter().any(|chart| chart.ty <= SLIVER_HEIGHT * chart.length))
        .collect()
}

/// Which triangles must remember what crossed them: slivers, and those on an edge that has more than two triangles, where
/// every crossing multiplies the windows.
pub(crate) fn remembering(mesh: &Mesh, sliver: &[bool]) -> Vec<bool> {
    let mut remembers = sliver.to_vec();
    let halfedges = &mesh.topology().halfedges;
    for h in (0..halfedges.rows()).map(|e| halfedges.row(e)).filter(|row| row.len() > 2).flatten() {
        remembers[(h / 3) as usize] = true;
    }
    remembers
}

/// Which vertices are pseudo-sources.
pub(crate) fn pseudo_sources(mesh: &Mesh, charts: &[Chart], sliver: &[bool]) -> Vec<bool> {
    let is_pseudo_source = |v: u32| {
        let corners = mesh.topology().corners.row(v);
        if corners.iter().any(|&h| sliver[(h / 3) as usize]) {
            return true;
        }
        let flat = match fan(mesh, v) {
            Fan::Closed => 2.0 * PI,
            Fan::Open => PI,
            Fan::Other => return true,
        };
        corners.iter().map(|&h| corner_angle(&charts[h as usize])).sum::<f64>() > flat + ANGLE_TOLERANCE
    };
    (0..mesh.topology().corners.rows()).map(is_pseudo_source).collect()
}

/// The angle where the chart's half-edge starts.
fn corner_angle(chart: &Chart) -> f64 {
    chart.ty.atan2(chart.tx)
}

/// How the triangles at a vertex lie around it.
enum Fan {
    /// They form one cycle.
    Closed,
    /// They form one chain between two boundary edges.
    Open,
    /// There are none, several fans, or an edge with more than two triangles.
    Other,
}

fn fan(mesh: &Mesh, v: u32) -> Fan {
    let corners = mesh.topology().corners.row(v);
    let Some(&first) = corners.first() else { return Fan::Other };
    let (turn, end) = walk(mesh, v, first, first);
    match end {
        WalkEnd::Closed if turn == corners.len() => Fan::Closed,
        WalkEnd::Boundary => match walk(mesh, v, first, prev(first)) {
            (back, WalkEnd::Boundary) if turn + back - 1 == corners.len() => Fan::Open,
            _ => Fan::Other,
        },
        _ => Fan::Other,
    }
}

enum WalkEnd {
    Closed,
    Boundary,
    NonManifold,
}

/// Walks around `v` from the corner at half-edge `first`, leaving each triangle by the edge at `v` it was not entered
/// by, `leave` first: how many corners were visited, and what ended it.
fn walk(mesh: &Mesh, v: u32, first: u32, leave: u32) -> (usize, WalkEnd) {
    let topology = mesh.topology();
    let (mut leave, mut visited) = (leave, 1);
    loop {
        let beyond = match topology.others(leave) {
            Others::None => return (visited, WalkEnd::Boundary),
            Others::One(h) => h,
            Others::Many => return (visited, WalkEnd::NonManifold),
        };
        // In the next triangle the two half-edges at v are the corner's own and the one before it.
        let starts_here = start(mesh.triangles(), beyond) == v;
        let (corner, exit) = if starts_here { (beyond, prev(beyond)) } else { (next(beyond), next(beyond)) };
        if corner == first {
            return (visited, WalkEnd::Closed);
        }
        visited += 1;
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

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
