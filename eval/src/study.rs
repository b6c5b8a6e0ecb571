//! All that is found out about one model.

use crate::error::{Error, Result};
use crate::gain::{self, Bootstrap, FormulaGain, Outcome, Sources};
use crate::model::Model;
use crate::names;
use crate::probe::{Probe, setting};
use crate::properties::ModelProperties;
use crate::sweep::{Best, ErrorCurve, Measure, Range, Sweep};
use serde::{Deserialize, Serialize};
use std::time::Instant;
use taut::{Control, Laplacian, TimeFormula, TimeScale};

/// All about one model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Its name.
    pub model: String,
    /// Its properties.
    pub properties: ModelProperties,
    /// How many vertices the source reaches, itself included.
    pub reached: usize,
    /// The sources of the gains, the model's own first; empty where gains were not asked for.
    pub sources: Vec<u32>,
    /// With each Laplacian.
    pub laplacians: Vec<LaplacianStudy>,
    /// How long this took, in seconds of one thread.
    pub seconds: f64,
}

/// How many vertices a source has to reach for a model to count in claims and figures: where it reaches fewer, as on a
/// small part of a mesh in many parts, the errors are of a few edges.
pub const LEAST_REACHED: usize = 100;

/// What one Laplacian gives.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LaplacianStudy {
    /// Which.
    #[serde(with = "names::laplacian")]
    pub laplacian: Laplacian,
    /// The best t.
    pub sweep: Sweep,
    /// The same found by the search that the maximum t stops, for the mean and for the median error.
    pub search: [Best; 2],
    /// Each formula in each unit, Eq. 1 at the paper's size first; empty where they were not asked for.
    pub formulas: Vec<FormulaGain>,
}

impl Study {
    /// Studies a model in the paper's setting with some Laplacians; `exact` are the distances from its source. The gains of
    /// the formulas need more sources. `progress` is told the share that is done.
    ///
    /// # Errors
    /// [`Error::Input`] where the heat method has no distances on the model at any t; [`Error::Model`], as [`Probe::new`].
    pub fn new(
        model: &Model,
        exact: &[f64],
        laplacians: &[Laplacian],
        gains: Option<(&Sources, &Bootstrap)>,
        control: &Control,
        progress: &dyn Fn(f64),
    ) -> Result<Study> {
        let start = Instant::now();
        let properties = ModelProperties::of(model)?;
        let mut studied = Vec::new();
        for (done, &laplacian) in (0..).zip(laplacians) {
            let done = |share: f64| progress((f64::from(done) + share) / laplacians.len() as f64);
            let probe = Probe::new(model, exact, &setting(laplacian), control)?;
            let (sweep, search) = best(&probe, Range::around(properties.mean_edge))?;
            done(0.7);
            let formulas = match gains {
                Some((sources, bootstrap)) => gain::gains(sources, &setting(laplacian), bootstrap, control)?,
                None => Vec::new(),
            };
            done(1.0);
            studied.push(LaplacianStudy { laplacian, sweep, search, formulas });
        }
        let reached = exact.iter().filter(|distance| distance.is_finite()).count();
        let seconds = start.elapsed().as_secs_f64();
        let sources = gains.map_or(Vec::new(), |(sources, _)| sources.vertices().to_vec());
        Ok(Study { model: model.name.clone(), properties, reached, sources, laplacians: studied, seconds })
    }

    /// Whether the model counts in claims and figures: its source reaches at least [`LEAST_REACHED`] vertices.
    #[must_use]
    pub fn counts(&self) -> bool {
        self.reached >= LEAST_REACHED
    }

    /// What one of the Laplacians gives; `None` where it was not asked for.
    #[must_use]
    pub fn with(&self, laplacian: Laplacian) -> Option<&LaplacianStudy> {
        self.laplacians.iter().find(|study| study.laplacian == laplacian)
    }

    /// What a formula gives; `None` where it is refused or was not asked for.
    #[must_use]
    pub fn outcome(&self, laplacian: Laplacian, formula: TimeFormula, scale: TimeScale) -> Option<&Outcome> {
        self.with(laplacian)?.outcome(formula, scale)
    }
}

impl LaplacianStudy {
    /// What a formula gives; `None` where it is refused or was not asked for.
    #[must_use]
    pub fn outcome(&self, formula: TimeFormula, scale: TimeScale) -> Option<&Outcome> {
        let mut formulas = self.formulas.iter();
        formulas.find(|gain| gain.formula == formula && gain.scale == scale)?.outcome.as_ref().ok()
    }

    /// The best t for one of the errors, by the search.
    #[must_use]
    pub fn searched(&self, measure: Measure) -> Best {
        let [mean, median] = self.search;
        match measure {
            Measure::Mean => mean,
            Measure::Median => median,
        }
    }
}

/// The best t by a sweep, and by a search for each error.
fn best(probe: &Probe, range: Range) -> Result<(Sweep, [Best; 2])> {
    let nowhere = || Error::Input(format!("{}: the heat method has no distances at any t", probe.model().name));
    let mut curve = ErrorCurve::new(|t| probe.point(t));
    let sweep = curve.sweep(range)?.ok_or_else(nowhere)?;
    let mut search = |measure| curve.search(range, measure)?.ok_or_else(nowhere);
    Ok((sweep, [search(Measure::Mean)?, search(Measure::Median)?]))
}
