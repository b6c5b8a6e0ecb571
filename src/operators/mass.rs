//! The lumped mass matrix: each triangle gives a third of its area to each corner, M_ii = Σ A(i j k) / 3.

use crate::metric::Metric;

/// The diagonal of M, for triangles of these areas; zero at a vertex that no triangle uses.
pub(super) fn lumped_mass(metric: &Metric, areas: &[f64], vertex_count: usize) -> Vec<f64> {
    let mut mass = vec![0.0; vertex_count];
    for ((triangle, _, weight), area) in metric.weighted().zip(areas) {
        let third = weight * area / 3.0;
        triangle.iter().for_each(|&v| mass[v as usize] += third);
    }
    mass
}
