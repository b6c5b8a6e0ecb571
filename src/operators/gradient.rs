//! The gradient per triangle, and the divergence of the normalised field X = -∇u / |∇u|.
//!
//! The divergence integrated around vertex i is Σ ½ (cot θ₁ (e₁ · X) + cot θ₂ (e₂ · X)) over its triangles, where e₁, e₂
//! are the edges that leave i and θ₁, θ₂ the angles opposite them. The field X is constant on a triangle, and along an
//! edge e from i to j of it ∇u · e = u_j - u_i; so e · X = (u_i - u_j) / |∇u|, and of the gradient only its length is
//! needed, in a frame of the triangle's own.

use super::Operators;
use nalgebra::Vector2;

/// A triangle laid into the plane: corner 0 at the origin, corner 1 at (base, 0), corner 2 at the apex.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    base: f64,
    apex: Vector2<f64>,
}

impl Frame {
    pub(super) fn of(lengths: [f64; 3]) -> Frame {
        let [base, from_1, from_0] = lengths;
        let x = (base + (from_0 - from_1) / base * (from_0 + from_1)) / 2.0;
        Frame { base, apex: Vector2::new(x, 2.0 * crate::metric::area(lengths) / base) }
    }

    /// The gradient of the linear function that grows by `along_base` to corner 1 and by `to_apex` to corner 2.
    fn gradient(&self, along_base: f64, to_apex: f64) -> Vector2<f64> {
        let x = along_base / self.base;
        Vector2::new(x, (to_apex - x * self.apex.x) / self.apex.y)
    }
}

impl Operators {
    /// The integrated divergence of X = -∇u / |∇u| at each vertex; X = 0 on a triangle where u does not vary.
    pub(crate) fn divergence_of_direction(&self, u: &[f64]) -> Vec<f64> {
        let mut divergence = vec![0.0; u.len()];
        for ((triangle, frame), weights) in self.triangles.iter().zip(&self.frames).zip(&self.half_cotangents) {
            let [a, b, c] = triangle.map(|v| u[v as usize]);
            let rises = [b - a, c - b, a - c];
            // Far from the source u is tiny, and its square zero: so the largest rise becomes 1 first.
            let largest = rises.iter().fold(0.0f64, |largest, rise| largest.max(rise.abs()));
            if largest == 0.0 {
                continue;
            }
            let rises = rises.map(|rise| rise / largest);
            let slope = frame.gradient(rises[0], -rises[2]).norm();
            for k in 0..3 {
                let flux = weights[k] * (-rises[k] / slope); // ½ cot θ (e · X)
                divergence[triangle[k] as usize] += flux;
                divergence[triangle[(k + 1) % 3] as usize] -= flux;
            }
        }
        divergence
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Metric;

    /// On the unit square u = x has X = (-1, 0), which flows in through the side x = 1 and out through x = 0.
    #[test]
    fn divergence_of_a_plane_wave_is_its_flux() {
        let diagonal = 2f64.sqrt();
        let lengths = vec![[1.0, 1.0, diagonal], [diagonal, 1.0, 1.0]];
        let metric = Metric { triangles: vec![[0, 1, 2], [0, 2, 3]], lengths, single: 2 };
        let operators = Operators::new(metric, 4);
        for size in [1.0, 1e-300] {
            let divergence = operators.divergence_of_direction(&[0.0, size, size, 0.0]);
            for (value, expected) in divergence.iter().zip([-0.5, 0.5, 0.5, -0.5]) {
                assert!((value - expected).abs() < 1e-15, "{divergence:?}");
            }
        }
    }
}
