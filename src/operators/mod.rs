//! Discrete differential operators of a [`Metric`]: mass M, stiffness L, gradient and divergence.
//!
//! Piecewise linear functions u, one value per vertex. M u is the integral of u around each vertex, L u minus the
//! integrated Laplacian (L is positive semidefinite), ∇u is constant on each triangle.
//!
//! O(F) time and memory.
//!
//! References: M. Meyer, M. Desbrun, P. Schröder, A. H. Barr: Discrete Differential-Geometry Operators for Triangulated
//! 2-Manifolds. Visualization and Mathematics III, 2003. K. Crane, C. Weischedel, M. Wardetzky: Geodesics in Heat: A New
//! Approach to Computing Distance Based on Heat Flow. ACM Transactions on Graphics, 2013.

mod cotan;
mod gradient;
mod mass;

use crate::metric::Metric;
use gradient::Frame;
use nalgebra_sparse::CscMatrix;

/// The operators, in units of the metric.
#[derive(Debug)]
pub(crate) struct Operators {
    triangles: Vec<[u32; 3]>,
    /// Half the cotangent of the angle opposite each half-edge.
    half_cotangents: Vec<[f64; 3]>,
    /// Each triangle laid into the plane.
    frames: Vec<Frame>,
    /// Lumped mass M: the diagonal.
    pub(crate) mass: Vec<f64>,
    /// Stiffness L: the lower triangle. Every column begins with its diagonal entry, also where it is zero.
    pub(crate) stiffness: CscMatrix<f64>,
}

impl Operators {
    /// The operators of `metric` on the vertices 0..`vertex_count`.
    pub(crate) fn new(metric: Metric, vertex_count: usize) -> Operators {
        let half_cotangents = cotan::half_cotangents(&metric);
        Operators {
            mass: mass::lumped_mass(&metric, vertex_count),
            stiffness: cotan::stiffness(&metric, &half_cotangents, vertex_count),
            frames: metric.lengths.iter().map(|&lengths| Frame::of(lengths)).collect(),
            half_cotangents,
            triangles: metric.triangles,
        }
    }

    /// L x.
    pub(crate) fn stiffness_times(&self, x: &[[f64; 1]]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        for (i, j, &value) in self.stiffness.triplet_iter() {
            product[i] += value * x[j][0];
            if i != j {
                product[j] += value * x[i][0];
            }
        }
        product
    }

    /// How many triangles there are.
    pub(crate) fn triangle_count(&self) -> usize {
        self.triangles.len()
    }
}
