//! Each triangle laid flat along each of its edges: all the geometry that exact distances need.
//!
//! The chart of half-edge h puts its start at the origin, its end on the positive x axis and the third corner, the
//! *apex*, at (tx, ty) with ty > 0. It is taken from the coordinates, not from three lengths: in a triangle with an angle
//! of 1e-7 the height would lose half of its digits to cancellation in the lengths, but only a third in the cross
//! product.
//!
//! O(V + F) time; 32 bytes per half-edge.

use crate::mesh::Mesh;
use crate::mesh::topology::{NONE, next, prev};
use crate::metric::{Scale, cross, dot, minus};

/// A triangle laid flat along one of its half-edges, and what is around: one record, because they are needed together.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Chart {
    /// Length of the half-edge.
    pub(crate) length: f64,
    /// Coordinates of the apex.
    pub(crate) tx: f64,
    pub(crate) ty: f64,
    /// The vertex where it starts.
    pub(crate) start: u32,
    /// The other half-edge on the edge, NONE at the boundary, or SEVERAL.
    pub(crate) twin: u32,
}

impl Chart {
    /// Where the point of its triangle with these weights lies in the chart of half-edge h.
    pub(crate) fn place(&self, h: u32, weights: [f64; 3]) -> [f64; 2] {
        let [at_end, at_apex] = [next(h), prev(h)].map(|corner| weights[(corner % 3) as usize]);
        [at_end * self.length + at_apex * self.tx, at_apex * self.ty]
    }
}

/// In place of a twin where an edge has more than two triangles.
pub(crate) const SEVERAL: u32 = NONE - 1;

/// The sine of the angle between the two shorter sides is raised to this: then a triangle without area still conducts
/// along its edges and no ray is parallel to an edge. It moves nothing by more than the rounding of the coordinates, and
/// changes no length by a bit, so that a short edge turns what crosses it but does not stretch it.
const LEAST_SINE: f64 = 1.0 / (1u64 << 48) as f64;

/// The chart of every half-edge, in units of `scale`; those of ignored triangles are never used.
pub(crate) fn charts(mesh: &Mesh, scale: Scale) -> Vec<Chart> {
    let positions = scale.unit_positions(mesh);
    let flat = mesh.triangles().iter().flat_map(|&t| triangle_charts(t, t.map(|v| positions[v as usize])));
    let topology = mesh.topology();
    let twin = |h: u32, e: u32| match topology.halfedges.row(e) {
        [_] => NONE,
        &[a, b] => a ^ b ^ h,
        _ => SEVERAL,
    };
    let used = |(h, &e): (u32, &u32)| if e == NONE { NONE } else { twin(h, e) };
    flat.zip((0..).zip(&topology.edge_of)).map(|(chart, edge)| Chart { twin: used(edge), ..chart }).collect()
}

fn triangle_charts(triangle: [u32; 3], [a, b, c]: [[f64; 3]; 3]) -> [Chart; 3] {
    let sides = [minus(b, a), minus(c, b), minus(a, c)];
    let lengths = sides.map(|side| dot(side, side).sqrt());
    let double_area = double_area(sides, lengths);
    std::array::from_fn(|k| {
        let length = lengths[k];
        let to_apex = sides[(k + 2) % 3].map(|x| -x);
        let [tx, ty] = if length == 0.0 {
            [0.0, lengths[(k + 1) % 3]]
        } else {
            [dot(to_apex, sides[k]) / length, double_area / length]
        };
        Chart { length, tx, ty, start: triangle[k], twin: NONE }
    })
}

/// Cross product of the two shorter sides: its rounding error is proportional to the product of their lengths. An edge
/// without length counts as one of the length LEAST_SINE of the others.
fn double_area(sides: [[f64; 3]; 3], lengths: [f64; 3]) -> f64 {
    let longest = (0..3).fold(0, |k, l| if lengths[l] > lengths[k] { l } else { k });
    let shorter = [(longest + 1) % 3, (longest + 2) % 3];
    let cross = cross(sides[shorter[0]], sides[shorter[1]]);
    let [a, b] = shorter.map(|k| lengths[k].max(LEAST_SINE * lengths[longest]));
    dot(cross, cross).sqrt().max(LEAST_SINE * a * b)
}

/// Which triangles are *slivers*: lower than this share of one of their edges. A straight line turns so little in them
/// that it may cross very many of them, or the same ones again and again, before it grows longer.
const SLIVER_HEIGHT: f64 = 1e-6;

pub(crate) fn slivers(charts: &[Chart]) -> Vec<bool> {
    charts.chunks_exact(3).map(|triangle| is_lower(triangle, SLIVER_HEIGHT)).collect()
}

/// Whether a triangle is lower than this share of one of its edges.
fn is_lower(triangle: &[Chart], share: f64) -> bool {
    triangle.iter().any(|chart| chart.ty <= share * chart.length)
}

/// A triangle lower than this share of one of its edges remembers what crossed it: a straight line may wind π / share
/// times around such triangles.
const LOW: f64 = 1e-2;

/// Which triangles must remember what crossed them: low ones, and those on an edge that has more than two triangles,
/// where every crossing multiplies the windows.
pub(crate) fn remembering(mesh: &Mesh, charts: &[Chart]) -> Vec<bool> {
    let mut remembers: Vec<bool> = charts.chunks_exact(3).map(|triangle| is_lower(triangle, LOW)).collect();
    let halfedges = &mesh.topology().halfedges;
    for h in (0..halfedges.rows()).map(|e| halfedges.row(e)).filter(|row| row.len() > 2).flatten() {
        remembers[(h / 3) as usize] = true;
    }
    remembers
}
