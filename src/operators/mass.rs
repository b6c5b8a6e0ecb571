//! The lumped mass matrix: each triangle gives a third of its area to each corner, M_ii = Σ A(i j k) / 3.

use crate::metric::{Metric, area};

/// The diagonal of M; zero at a vertex that no triangle uses.
pub(super) fn lumped_mass(metric: &Metric, vertex_count: usize) -> Vec<f64> {
    let mut mass = vec![0.0; vertex_count];
    for (f, (triangle, &lengths)) in metric.triangles.iter().zip(&metric.lengths).enumerate() {
        let third = metric.weight(f) * area(lengths) / 3.0;
        triangle.iter().for_each(|&v| mass[v as usize] += third);
    }
    mass
}
