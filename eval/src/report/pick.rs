//! What the page asks of studies.

use crate::gain::{Interval, Over};
use crate::paper::Places;
use crate::study::Study;
use crate::sweep::Measure;
use taut::{Laplacian, TimeFormula, TimeScale};

/// The ratio of a formula's error to that of Eq. 1 at the paper's size.
pub(super) fn paper_ratio(
    study: &Study,
    laplacian: Laplacian,
    formula: TimeFormula,
    measure: Measure,
    over: Over,
) -> Option<Interval> {
    study.outcome(laplacian, formula, TimeScale::Paper).and_then(|outcome| outcome.ratio(measure, over))
}

/// Where the best t for the mean error is, beside those of Eq. 1 and Eq. 2.
pub(super) fn places(models: &[Study], laplacian: Laplacian) -> Places {
    let t = |study: &Study, formula| Some(study.outcome(laplacian, formula, TimeScale::Paper)?.t);
    models.iter().fold(Places::default(), |places, study| {
        let best = study.with(laplacian).map(|of| of.sweep.mean.t);
        match (best, t(study, TimeFormula::MeanEdge), t(study, TimeFormula::Sigma)) {
            (Some(best), Some(a), Some(b)) if best < a.min(b) => Places { below: places.below + 1, ..places },
            (Some(best), Some(a), Some(b)) if best > a.max(b) => Places { above: places.above + 1, ..places },
            (Some(_), Some(_), Some(_)) => Places { between: places.between + 1, ..places },
            _ => places,
        }
    })
}
