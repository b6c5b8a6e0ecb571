//! All that is found out about one model.

use crate::gain::FormulaGain;
use crate::names;
use crate::properties::ModelProperties;
use crate::sweep::{Best, Sweep};
use serde::{Deserialize, Serialize};
use taut::Laplacian;

/// All about one model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Its name.
    pub model: String,
    /// Its properties.
    pub properties: ModelProperties,
    /// How many vertices the source reaches, itself included.
    pub reached: usize,
    /// With each Laplacian.
    pub laplacians: Vec<LaplacianStudy>,
    /// How long all this took, in seconds of one thread.
    pub seconds: f64,
}

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
    /// Each formula in each unit, Eq. 1 at the paper's size first.
    pub formulas: Vec<FormulaGain>,
}
