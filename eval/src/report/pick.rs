//! What the page asks of studies.

use super::content::{Counts, Places};
use crate::gain::{Interval, Outcome, Verdict};
use crate::study::{LaplacianStudy, Study};
use crate::sweep::Measure;
use taut::{Laplacian, TimeFormula, TimeScale};

/// A figure of the paper: its number, whose gain it shows, and by which error.
pub(super) const FIGURES: [(u32, TimeFormula, Measure); 4] = [
    (10, TimeFormula::Sigma, Measure::Mean),
    (12, TimeFormula::MeanSigma, Measure::Mean),
    (13, TimeFormula::MedianFit, Measure::Median),
    (15, TimeFormula::MedianMean, Measure::Median),
];

/// What a bootstrap draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Over {
    Vertices,
    Sources,
}

pub(super) fn with(study: &Study, laplacian: Laplacian) -> Option<&LaplacianStudy> {
    study.laplacians.iter().find(|of| of.laplacian == laplacian)
}

/// What a formula gives; `None` where it is refused or was not asked for.
pub(super) fn outcome(study: &Study, laplacian: Laplacian, formula: TimeFormula, scale: TimeScale) -> Option<&Outcome> {
    let mut formulas = with(study, laplacian)?.formulas.iter();
    formulas.find(|gain| gain.formula == formula && gain.scale == scale)?.outcome.as_ref().ok()
}

/// The ratio of its error to that of Eq. 1.
pub(super) fn ratio(outcome: &Outcome, measure: Measure, over: Over) -> Option<Interval> {
    let ratios = match over {
        Over::Vertices => outcome.over_vertices,
        Over::Sources => outcome.over_sources?,
    };
    Some(match measure {
        Measure::Mean => ratios.mean,
        Measure::Median => ratios.median,
    })
}

/// The same at the paper's size.
pub(super) fn paper_ratio(
    study: &Study,
    laplacian: Laplacian,
    formula: TimeFormula,
    measure: Measure,
    over: Over,
) -> Option<Interval> {
    outcome(study, laplacian, formula, TimeScale::Paper).and_then(|outcome| ratio(outcome, measure, over))
}

/// On how many models which formula is better.
pub(super) fn counts(intervals: impl Iterator<Item = Interval>) -> Counts {
    intervals.fold(Counts::default(), |counts, interval| match interval.verdict() {
        Verdict::Better => Counts { better: counts.better + 1, ..counts },
        Verdict::Worse => Counts { worse: counts.worse + 1, ..counts },
        Verdict::Unsure => Counts { unsure: counts.unsure + 1, ..counts },
    })
}

/// Where the best t for the mean error is, beside those of Eq. 1 and Eq. 2.
pub(super) fn places(models: &[Study], laplacian: Laplacian) -> Places {
    let t = |study, formula| Some(outcome(study, laplacian, formula, TimeScale::Paper)?.t);
    models.iter().fold(Places::default(), |places, study| {
        let best = with(study, laplacian).map(|of| of.sweep.mean.t);
        match (best, t(study, TimeFormula::MeanEdge), t(study, TimeFormula::Sigma)) {
            (Some(best), Some(a), Some(b)) if best < a.min(b) => Places { below: places.below + 1, ..places },
            (Some(best), Some(a), Some(b)) if best > a.max(b) => Places { above: places.above + 1, ..places },
            (Some(_), Some(_), Some(_)) => Places { between: places.between + 1, ..places },
            _ => places,
        }
    })
}

/// ē² at the paper's size: the t of Eq. 1.
pub(super) fn mean_edge_squared(study: &Study) -> f64 {
    study.properties.mean_edge * study.properties.mean_edge
}
