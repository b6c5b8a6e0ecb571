//! Statistics of a mesh's edges, each edge counted once.

use super::{Scale, distance};
use crate::mesh::Mesh;

/// Edge lengths and size of a mesh, in units of its [`Scale`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct EdgeStats {
    /// ē, the mean edge length.
    pub(crate) mean: f64,
    /// σ, the population standard deviation of the edge lengths.
    pub(crate) sigma: f64,
    /// The diagonal of the bounding box over the vertices that some triangle uses.
    pub(crate) diagonal: f64,
}

/// The bounding-box diagonal of the paper's meshes.
const PAPER_DIAGONAL: f64 = 24.976;

/// The length of each edge of the input mesh.
pub(crate) fn edge_lengths(mesh: &Mesh, positions: &[[f64; 3]]) -> impl Iterator<Item = f64> {
    mesh.topology().edges.iter().map(|&[a, b]| distance(positions[a as usize], positions[b as usize]))
}

impl EdgeStats {
    /// Over the edges of the input mesh, whatever triangulation is computed on later; None where there is no edge.
    pub(crate) fn of(mesh: &Mesh, scale: Scale) -> Option<EdgeStats> {
        let edges = &mesh.topology().edges;
        if edges.is_empty() {
            return None;
        }
        let positions = scale.unit_positions(mesh);
        let lengths: Vec<f64> = edge_lengths(mesh, &positions).collect();
        let count = edges.len() as f64;
        let mean = lengths.iter().sum::<f64>() / count;
        let sigma = (lengths.iter().map(|e| (e - mean) * (e - mean)).sum::<f64>() / count).sqrt();
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for p in edges.iter().flatten().map(|&v| positions[v as usize]) {
            low = [0, 1, 2].map(|k| low[k].min(p[k]));
            high = [0, 1, 2].map(|k| high[k].max(p[k]));
        }
        Some(EdgeStats { mean, sigma, diagonal: distance(low, high) })
    }

    /// s, the factor from units to the paper's size.
    pub(crate) fn paper_scale(&self) -> f64 {
        PAPER_DIAGONAL / self.diagonal
    }
}
