//! Random points of a surface, distances from them, and lengths.
#![allow(dead_code, reason = "each test uses a part of it")]

use taut::{Control, ExactField, ExactOptions, ExactSolver, Mesh, Source, SurfacePoint};

/// A small deterministic generator of numbers in [0, 1).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    pub(crate) fn point(&mut self, mesh: &Mesh) -> SurfacePoint {
        let [u, v] = [self.next(), self.next()];
        let [u, v] = if u + v > 1.0 { [1.0 - u, 1.0 - v] } else { [u, v] };
        SurfacePoint { face: self.below(mesh.triangle_count()) as u32, barycentric: [u, v, 1.0 - u - v] }
    }
}

/// Distances that any point can be asked for.
pub(crate) fn field(mesh: &Mesh, sources: &[Source]) -> ExactField {
    let options = ExactOptions { keep_windows: true, ..ExactOptions::default() };
    ExactSolver::new(mesh).unwrap().field(sources, &options, &Control::new()).unwrap()
}

/// The straight way from one position to another.
pub(crate) fn euclid(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}
