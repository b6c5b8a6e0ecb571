//! The error of the heat method at any time step, against exact distances.
//!
//! Every t in this crate is at the paper's size: of the mesh scaled to a bounding box of the diagonal 24.976, whose factor
//! is s. In mesh units squared it is t / s².
//!
//! Exact distances once; the systems once for each Laplacian; then a factorisation and a solve for each t.

use crate::accuracy::Errors;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::properties::ModelProperties;
use crate::sweep::Point;
use taut::{Control, ExactOptions, ExactSolver, HeatOptions, HeatSolver, Laplacian, Reason, Shift, Source, TimeStep};

/// A model with its exact distances and the heat method ready for any t.
pub struct Probe<'a> {
    model: &'a Model,
    exact: &'a [f64],
    solver: HeatSolver,
    /// s².
    area_scale: f64,
    control: &'a Control,
}

/// The paper's setting, but for the Laplacian: its tool moves the least distance to 0, and reflects heat at boundaries.
#[must_use]
pub fn setting(laplacian: Laplacian) -> HeatOptions {
    HeatOptions { laplacian, shift: Shift::Min, boundary: 0.0, ..HeatOptions::default() }
}

/// Exact distances from the source of `model`; +inf where it does not lead.
///
/// # Errors
/// [`Error::Model`], as [`ExactSolver::field`].
pub fn exact(model: &Model, source: u32, control: &Control) -> Result<Vec<f64>> {
    let field = ExactSolver::new(&model.mesh)
        .and_then(|solver| solver.field(&[Source::vertex(source)], &ExactOptions::default(), control));
    field.map(|field| field.distances().to_vec()).map_err(Error::of_model(&model.name))
}

impl<'a> Probe<'a> {
    /// Builds the systems; the time step of `options` is not used.
    ///
    /// # Errors
    /// [`Error::Model`], as [`HeatSolver::new`].
    pub fn new(model: &'a Model, exact: &'a [f64], options: &HeatOptions, control: &'a Control) -> Result<Probe<'a>> {
        let scale = ModelProperties::of(model)?.scale;
        let options = HeatOptions { time_step: HeatOptions::default().time_step, ..*options };
        let solver = HeatSolver::new(&model.mesh, &options, control).map_err(Error::of_model(&model.name))?;
        Ok(Probe { model, exact, solver, area_scale: scale * scale, control })
    }

    /// The distances of the heat method at t, and how far they are off.
    ///
    /// # Errors
    /// [`Error::Model`], as [`HeatSolver::with_time_step`] and [`HeatSolver::field`].
    pub fn distances(&self, t: f64) -> Result<Vec<f64>> {
        let step = TimeStep::Value(t / self.area_scale);
        let solver = self.solver.with_time_step(&step, self.control);
        let field = solver.and_then(|solver| solver.field(&[Source::vertex(self.model.source)], self.control));
        field.map(taut::HeatField::into_distances).map_err(Error::of_model(&self.model.name))
    }

    /// How far they are off.
    ///
    /// # Errors
    /// As [`Probe::distances`].
    pub fn errors(&self, t: f64) -> Result<Errors> {
        Ok(Errors::new(&self.distances(t)?, self.exact))
    }

    /// The errors at t as a point of the curve; `None` where there are no distances, or an error is not finite.
    ///
    /// # Errors
    /// As [`Probe::distances`], but for [`Reason::NotPositiveDefinite`] and [`Reason::BadTimeStep`].
    pub fn point(&self, t: f64) -> Result<Option<Point>> {
        match self.errors(t) {
            Ok(Errors { mean_percent: mean, median_percent: median, .. }) => {
                Ok(Some(Point { t, mean, median }).filter(|_| mean.is_finite() && median.is_finite()))
            }
            Err(Error::Model { error, .. })
                if matches!(error.reason(), Reason::NotPositiveDefinite | Reason::BadTimeStep) =>
            {
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        self.model
    }
}
