//! The properties that the paper lists for its meshes.
//!
//! ```text
//! g = mean over faces of  (p/2 · e_max) / (2√3 · A)      anisotropy: 1 for an equilateral triangle
//! ```
//!
//! p perimeter, e_max longest edge, A area. Every edge counts once; deviations are those of the population.
//!
//! O(E log E) time, for the quartiles.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019), Tables 1 to 4. What its Table 2 calls the median absolute deviation is the mean absolute deviation.

use super::used_triangles;
use crate::mesh::Mesh;
use crate::metric::stats::{EdgeStats, edge_lengths};
use crate::metric::{Scale, area, cross, distance, dot, minus};

/// Properties of a mesh's edges and angles. Lengths are in mesh units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Properties {
    /// N_v, unreferenced vertices included.
    pub vertices: usize,
    /// N_e: pairs of vertices that some triangle joins.
    pub edges: usize,
    /// N_f: triangles, ignored ones included; a polygon of n corners counts n - 2.
    pub faces: usize,
    /// ē, the mean edge length.
    pub mean_edge: f64,
    /// Var(e), the population variance of the edge lengths, in squared units.
    pub variance_edge: f64,
    /// σ, its square root.
    pub sigma_edge: f64,
    /// The mean of |e - ē|; D_e of the paper.
    pub mean_absolute_deviation: f64,
    /// The median of |e - Q₂|.
    pub median_absolute_deviation: f64,
    /// The shortest edge.
    pub min_edge: f64,
    /// The longest edge.
    pub max_edge: f64,
    /// Shortest over longest edge.
    pub edge_ratio: f64,
    /// Q₁, the lower quartile of the edge lengths, between neighbours by linear interpolation.
    pub q1: f64,
    /// Q₂, their median.
    pub q2: f64,
    /// Q₃, their upper quartile.
    pub q3: f64,
    /// (Q₃ - Q₁) / 2.
    pub quartile_deviation: f64,
    /// The smallest interior angle, in radians.
    pub min_angle: f64,
    /// The largest interior angle, in radians.
    pub max_angle: f64,
    /// g, the anisotropy, over the faces that have an area; NaN if none has.
    pub anisotropy: f64,
    /// The factor that brings the mesh to the paper's size, a bounding box of the diagonal 24.976.
    pub paper_scale: f64,
}

/// An interior angle of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Angle {
    /// The triangle.
    pub face: u32,
    /// The vertex it is at.
    pub vertex: u32,
    /// Its size.
    pub radians: f64,
}

impl Properties {
    /// The properties of a mesh; None where it has no edge.
    #[must_use]
    pub fn of(mesh: &Mesh) -> Option<Properties> {
        let scale = Scale::of(mesh);
        let stats = EdgeStats::of(mesh, scale)?;
        let positions = scale.unit_positions(mesh);
        let [min_angle, max_angle] = extreme_angles(mesh, &positions);
        let sorted = sorted(edge_lengths(mesh, &positions).collect());
        let [min, q1, q2, q3, max] = [0, 1, 2, 3, 4].map(|quarter| quartile(&sorted, quarter));
        let mean_deviation = sorted.iter().map(|e| (e - stats.mean).abs()).sum::<f64>() / sorted.len() as f64;
        let median_deviation = quartile(&self::sorted(sorted.iter().map(|e| (e - q2).abs()).collect()), 2);
        let length = |units: f64| scale.to_mesh(units);
        Some(Properties {
            vertices: mesh.vertex_count(),
            edges: sorted.len(),
            faces: mesh.triangle_count(),
            mean_edge: length(stats.mean),
            variance_edge: length(length(stats.sigma * stats.sigma)),
            sigma_edge: length(stats.sigma),
            mean_absolute_deviation: length(mean_deviation),
            median_absolute_deviation: length(median_deviation),
            min_edge: length(min),
            max_edge: length(max),
            edge_ratio: min / max,
            q1: length(q1),
            q2: length(q2),
            q3: length(q3),
            quartile_deviation: length((q3 - q1) / 2.0),
            min_angle: min_angle?.radians,
            max_angle: max_angle?.radians,
            anisotropy: anisotropy(mesh, &positions),
            paper_scale: scale.to_unit(stats.paper_scale()),
        })
    }
}

fn sorted(mut values: Vec<f64>) -> Vec<f64> {
    values.sort_unstable_by(f64::total_cmp);
    values
}

/// The value below which `quarter` quarters of the sorted values lie, between two by linear interpolation.
fn quartile(sorted: &[f64], quarter: usize) -> f64 {
    let place = (sorted.len() - 1) * quarter;
    let (below, above) = (sorted[place / 4], sorted[place.div_ceil(4)]);
    below + (above - below) * (place % 4) as f64 / 4.0
}

/// The smallest and the largest interior angle; the first of equals.
pub(super) fn extreme_angles(mesh: &Mesh, positions: &[[f64; 3]]) -> [Option<Angle>; 2] {
    let angles = used_triangles(mesh).flat_map(|(face, triangle)| {
        let corners = triangle.map(|v| positions[v as usize]);
        [0, 1, 2].map(|k| {
            let [p, q] = [1, 2].map(|step| minus(corners[(k + step) % 3], corners[k]));
            let normal = cross(p, q);
            // The arc tangent is as exact for needles as for any angle, which the arc cosine is not.
            Angle { face, vertex: triangle[k], radians: dot(normal, normal).sqrt().atan2(dot(p, q)) }
        })
    });
    angles.fold([None, None], |[least, most]: [Option<Angle>; 2], angle| {
        [
            Some(least.filter(|least| least.radians <= angle.radians).unwrap_or(angle)),
            Some(most.filter(|most| most.radians >= angle.radians).unwrap_or(angle)),
        ]
    })
}

fn anisotropy(mesh: &Mesh, positions: &[[f64; 3]]) -> f64 {
    let ratio = |triangle: [u32; 3]| {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let lengths = [distance(a, b), distance(b, c), distance(c, a)];
        let longest = lengths.into_iter().fold(0.0, f64::max);
        lengths.iter().sum::<f64>() / 2.0 * longest / (2.0 * 3f64.sqrt() * area(lengths))
    };
    let ratios = used_triangles(mesh).map(|(_, triangle)| ratio(triangle)).filter(|ratio| ratio.is_finite());
    let (sum, count) = ratios.fold((0.0, 0.0), |(sum, count), ratio| (sum + ratio, count + 1.0));
    sum / count
}
