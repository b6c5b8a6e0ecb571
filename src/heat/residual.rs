//! How well the two systems of a query are solved: what is left of their right-hand sides.

use super::flow::finite;
use super::place::Placed;
use super::{HeatSolver, Shift};
use crate::control::{Control, Piece};
use crate::error::Result;
use crate::surface::source::Source;

/// The largest entry of b - A x, as a share of the largest entry of b, for both systems of a query.
///
/// Rounding leaves about 1e-15 times the number of edges at a vertex; much more means that the matrix is close to singular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatResiduals {
    /// Of (M + t L) u = δ.
    pub heat: f64,
    /// Of L φ = -∇·X, at the vertices whose distance is not known beforehand.
    pub poisson: f64,
}

impl HeatSolver {
    /// Computes a field once more and tells how well its systems are solved.
    ///
    /// # Errors
    /// As [`HeatSolver::field`].
    pub fn residuals(&self, sources: &[Source], control: &Control) -> Result<HeatResiduals> {
        let seeds = Source::checked(sources, &self.systems.mesh)?;
        let placed = [Placed::new((0, &seeds), &self.systems, self.time_step)?];
        let piece = Piece::whole(control);
        piece.checkpoint(0.0)?;
        let operators = &self.systems.operators;
        let charges = self.charges(&placed);
        let u = finite(self.neumann.solve_sparse(&charges))?;
        let mut left = vec![0.0; u.len()];
        charges.iter().for_each(|&(v, [charge])| left[v as usize] += charge);
        let heat_put_in = largest(left.iter());
        for (((left, flux), mass), [u]) in
            left.iter_mut().zip(operators.stiffness_times(&u)).zip(&operators.mass).zip(&u)
        {
            *left -= mass * u + self.time_step * flux;
        }
        piece.checkpoint(0.5)?;
        let flows = self.flows(&placed)?;
        let phi = self.systems.potentials(&flows, &placed, &piece.part(0.5, 1.0))?;
        let divergence = &flows[0].divergence;
        let mut of_phi: Vec<f64> = divergence
            .iter()
            .zip(operators.stiffness_times(&phi))
            .map(|(divergence, flux)| -divergence - flux)
            .collect();
        if self.systems.options.shift == Shift::Pinned {
            let pins = placed[0].parts.iter().flat_map(|part| &part.pins);
            pins.for_each(|&(v, _)| of_phi[v as usize] = 0.0);
        }
        piece.checkpoint(1.0)?;
        Ok(HeatResiduals {
            heat: share(largest(left.iter()), heat_put_in),
            poisson: share(largest(of_phi.iter()), largest(divergence.iter())),
        })
    }
}

fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.fold(0.0, |largest, value| largest.max(value.abs()))
}

fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}
