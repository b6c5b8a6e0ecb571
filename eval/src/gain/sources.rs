//! From where the distances of a model are measured, with the exact ones.

use super::Bootstrap;
use crate::error::{Error, Result};
use crate::model::Model;
use rand::{SeedableRng, seq::SliceRandom};
use rand_pcg::Pcg64Mcg;
use taut::{Control, ExactSolver, Source};

/// Sources of one model, its own first, each with its exact distances: what both Laplacians share.
///
/// The others are drawn, without replacement, from the vertices that the model's own source reaches: so all of them reach
/// the same vertices, and each of those is as likely a source. Only the first, which the model names, is not drawn.
#[derive(Debug, Clone)]
pub struct Sources<'a> {
    pub(super) model: &'a Model,
    pub(super) vertices: Vec<u32>,
    pub(super) exact: Vec<Vec<f64>>,
}

impl<'a> Sources<'a> {
    /// As many as `bootstrap` says, where the model's source reaches that many vertices; at least its own, from which
    /// `exact` are the distances.
    ///
    /// The time is that of so many exact fields; the memory 8 bytes for each source and vertex.
    ///
    /// # Errors
    /// [`Error::Input`] if `exact` is not of the mesh; [`Error::Model`], as [`ExactSolver::distance_rows`].
    pub fn new(model: &'a Model, exact: &[f64], bootstrap: &Bootstrap, control: &Control) -> Result<Sources<'a>> {
        if exact.len() != model.mesh.vertex_count() {
            let message = format!("{}: {} exact distances are not those of the mesh", model.name, exact.len());
            return Err(Error::Input(message));
        }
        let mut reached: Vec<u32> =
            (0..).zip(exact).filter(|&(v, d)| v != model.source && d.is_finite()).map(|(v, _)| v).collect();
        let mut random = Pcg64Mcg::seed_from_u64(bootstrap.seed);
        let (others, _) = reached.partial_shuffle(&mut random, bootstrap.sources.saturating_sub(1));
        let sets: Vec<Vec<Source>> = others.iter().map(|&v| vec![Source::vertex(v)]).collect();
        let rows = ExactSolver::new(&model.mesh).and_then(|solver| solver.distance_rows(&sets, 1, control));
        let rows = rows.map_err(Error::of_model(&model.name))?;
        let vertices = std::iter::once(model.source).chain(others.iter().copied()).collect();
        Ok(Sources { model, vertices, exact: std::iter::once(exact.to_vec()).chain(rows).collect() })
    }

    /// The sources, the model's own first.
    #[must_use]
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }
}
