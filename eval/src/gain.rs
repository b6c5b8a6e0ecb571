//! What a formula gains over Eq. 1.

use crate::names;
use serde::{Deserialize, Serialize};
use taut::{TimeFormula, TimeScale};

/// A formula in one unit on one model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FormulaGain {
    /// Which formula.
    #[serde(with = "names::formula")]
    pub formula: TimeFormula,
    /// In which units it is evaluated.
    #[serde(with = "names::scale")]
    pub scale: TimeScale,
    /// What it gives; `Err` says why the formula is refused on this model.
    pub outcome: std::result::Result<Outcome, String>,
}

/// The t of a formula, its errors, and their ratios to those of Eq. 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// At the paper's size.
    pub t: f64,
    /// The mean error from the model's source, in percent.
    pub mean: f64,
    /// The median error from the model's source, in percent.
    pub median: f64,
    /// By the bootstrap over vertices, from the model's source.
    pub over_vertices: Ratios,
    /// By the bootstrap over sources; `None` with one source only.
    pub over_sources: Option<Ratios>,
}

/// Ratios of errors: below 1 the formula is better than Eq. 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ratios {
    /// Of the mean errors.
    pub mean: Interval,
    /// Of the median errors.
    pub median: Interval,
}

/// A ratio with its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// The ratio itself.
    pub ratio: f64,
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// Which is better, as far as 95 % confidence goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The formula: the whole interval is below 1.
    Better,
    /// Eq. 1: the whole interval is above 1.
    Worse,
    /// The interval holds 1.
    Unsure,
}

impl Interval {
    /// What it says.
    #[must_use]
    pub fn verdict(&self) -> Verdict {
        match (self.low, self.high) {
            (_, high) if high < 1.0 => Verdict::Better,
            (low, _) if low > 1.0 => Verdict::Worse,
            _ => Verdict::Unsure,
        }
    }
}
