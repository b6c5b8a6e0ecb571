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

use crate::metric::{Metric, area};
use gradient::Frame;
use nalgebra_sparse::CscMatrix;

/// The operators, in units of the metric.
#[derive(Debug)]
pub(crate) struct Operators {
    triangles: Vec<[u32; 3]>,
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
        let areas: Vec<f64> = metric.lengths.iter().map(|&lengths| area(lengths)).collect();
        Operators {
            mass: mass::lumped_mass(&metric, &areas, vertex_count),
            stiffness: cotan::stiffness(&metric, &areas, vertex_count),
            frames: gradient::frames(&metric, &areas),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::metric::{Scale, delaunay, mollify};

    /// Numbers in [0, 1), always the same.
    struct Random(u64);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64
        }

        fn below(&mut self, n: u32) -> u32 {
            (self.next() * f64::from(n)) as u32
        }
    }

    /// Random triangles on random points or, full of ties, needles and copies, on the points of a lattice.
    fn soup(random: &mut Random, on_lattice: bool) -> Mesh {
        let n = 4 + random.below(9);
        let mut coordinate = || if on_lattice { (3.0 * random.next()).floor() } else { random.next() };
        let positions: Vec<[f64; 3]> = (0..n).map(|_| [coordinate(), coordinate(), coordinate()]).collect();
        let triangles: Vec<[u32; 3]> = (0..1 + random.below(24)).map(|_| [n; 3].map(|n| random.below(n))).collect();
        Mesh::from_triangles(&positions, &triangles).unwrap()
    }

    /// L as a full matrix.
    fn full(stiffness: &CscMatrix<f64>) -> Vec<Vec<f64>> {
        let mut full = vec![vec![0.0; stiffness.ncols()]; stiffness.nrows()];
        for (row, column, &value) in stiffness.triplet_iter() {
            full[row][column] = value;
            full[column][row] = value;
        }
        full
    }

    /// Weights at least 0, constants in the null space, the mass is the area.
    #[test]
    fn operators_of_any_soup() {
        let mut random = Random(1);
        for round in 0..4000 {
            let mesh = soup(&mut random, round % 2 == 0);
            let scale = Scale::of(&mesh);
            let mut metric = Metric::of(&mesh, scale);
            mollify::mollify(&mut metric);
            let total: f64 = metric.lengths.iter().map(|&lengths| area(lengths)).sum();
            let flips = delaunay::make_delaunay(&mut metric, &mesh, scale);
            // On the lattice rounding keeps an edge between needles of 1e-10 from flipping now and then.
            let rounds_badly = round % 2 == 0;
            assert!((flips.stuck == 0 || rounds_badly) && !flips.bound_reached, "round {round}: {flips:?}");
            let operators = Operators::new(metric, mesh.vertex_count());
            let stiffness = full(&operators.stiffness);
            let largest = stiffness.iter().flatten().fold(0.0, |largest: f64, value| largest.max(value.abs()));
            for (i, row) in stiffness.iter().enumerate() {
                assert!(row.iter().sum::<f64>().abs() <= 1e-12 * largest, "round {round}");
                assert!(row.iter().enumerate().all(|(j, &value)| i == j || value <= 1e-9 * largest), "round {round}");
            }
            assert!((operators.mass.iter().sum::<f64>() - total).abs() <= 1e-6 * total, "round {round}");
        }
    }

    /// Heat from any vertex is positive at all vertices that it can reach: by elimination, without the solvers.
    #[test]
    fn heat_is_positive() {
        let mut random = Random(2);
        for round in 0..500 {
            let mesh = soup(&mut random, false);
            let scale = Scale::of(&mesh);
            let mut metric = Metric::of(&mesh, scale);
            mollify::mollify(&mut metric);
            delaunay::make_delaunay(&mut metric, &mesh, scale);
            let operators = Operators::new(metric, mesh.vertex_count());
            let mut system = full(&operators.stiffness);
            let component = &mesh.topology().component;
            for (i, row) in system.iter_mut().enumerate() {
                row.iter_mut().for_each(|value| *value *= 0.01);
                row[i] += operators.mass[i].max(f64::from(u8::from(component[i] == u32::MAX)));
                row.extend((0..component.len()).map(|j| f64::from(u8::from(i == j))));
            }
            for (i, row) in inverted(system).iter().enumerate() {
                for (j, &u) in row.iter().enumerate() {
                    assert_eq!(
                        u > 0.0,
                        component[i] == component[j] && (i == j || component[i] != u32::MAX),
                        "{round}"
                    );
                }
            }
        }
    }

    /// Gauss and Jordan's elimination of a symmetric positive definite matrix beside the identity; returns the inverse.
    fn inverted(mut system: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        for k in 0..system.len() {
            let pivot = system[k][k];
            system[k].iter_mut().for_each(|value| *value /= pivot);
            let pivot_row = system[k].clone();
            for row in system.iter_mut().enumerate().filter(|(i, _)| *i != k).map(|(_, row)| row) {
                let factor = row[k];
                row.iter_mut().zip(&pivot_row).for_each(|(value, pivot)| *value -= factor * pivot);
            }
        }
        let n = system.len();
        system.into_iter().map(|row| row[n..].to_vec()).collect()
    }
}
