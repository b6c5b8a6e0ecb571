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
use crate::mesh::fan::{Fan, fan};
use crate::metric::{Scale, cross, dot, minus};
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
