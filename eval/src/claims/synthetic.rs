//! Made-up studies of which most claims are true.

use super::{Evidence, Judged, judge};
use crate::gain::{FormulaGain, Interval, Outcome, Ratios};
use crate::names::{FORMULAS, SCALES};
use crate::paper::{BASIC, BasicMesh};
use crate::properties::{ModelProperties, Property};
use crate::study::{LaplacianStudy, Study};
use crate::sweep::{Best, Measure, Point, Sweep};
use taut::Laplacian;

/// One claim on some models and a basic set, with plain cotangents.
pub(super) fn judged(id: &str, studies: &[Study], basic: &[Study]) -> Judged {
    let all = judge(&Evidence { studies, basic, ..Evidence::default() }, Laplacian::Plain);
    all.into_iter().find(|claim| claim.id == id).unwrap()
}

/// The ratio of a formula's errors to those of Eq. 1, certain to a tenth.
pub(super) fn ratios(ratio: f64) -> Ratios {
    let interval = Interval { ratio, low: 0.9 * ratio, high: 1.1 * ratio };
    Ratios { mean: interval, median: interval }
}

/// A model whose errors are like |log t|: the best t is 0.1, Eq. 1 gives 0.05, Eq. 2 to 5 give 0.2, with 0.6 of its error.
pub(super) fn study(name: &str) -> Study {
    let times = (-30..=30).map(|k| 0.1 * 1.3f64.powi(k));
    let error = |t: f64| 1.0 + (t / 0.1).ln().abs();
    let points = times.map(|t| Point { t, mean: error(t), median: error(t) }).collect();
    let best = Best { t: 0.1, error: 1.0, at_end: false, maximum_t: Some(0.7), probes: 60 };
    let search = Best { probes: 30, ..best };
    let formulas = SCALES.iter().flat_map(|&(_, scale)| {
        FORMULAS.iter().enumerate().map(move |(place, &(_, formula))| {
            let (t, ratio) = if place == 0 { (0.05, 1.0) } else { (0.2, 0.6) };
            let over = ratios(ratio);
            let outcome =
                Outcome { t, mean: 2.0 * ratio, median: ratio, over_vertices: over, over_sources: Some(over) };
            FormulaGain { formula, scale, outcome: Ok(outcome) }
        })
    });
    let plain = LaplacianStudy {
        laplacian: Laplacian::Plain,
        sweep: Sweep { points, mean: best, median: best },
        search: [search; 2],
        formulas: formulas.collect(),
    };
    Study {
        model: name.to_owned(),
        properties: properties(),
        reached: 100,
        sources: Vec::new(),
        laplacians: vec![plain],
        seconds: 0.0,
    }
}

/// The basic set as the paper prints it; what it does not need is the same for all.
pub(super) fn basic() -> Vec<Study> {
    let mesh = |printed: &BasicMesh| {
        let mut study = study("basic");
        let (p, value) = (&mut study.properties, |property| printed.printed(property).value());
        (p.vertices, p.sigma) = (value(Property::Vertices) as usize, value(Property::Sigma));
        (p.variance, p.anisotropy) = (p.sigma * p.sigma, Some(value(Property::Anisotropy)));
        let sweep = &mut study.laplacians[0].sweep;
        (sweep.mean.t, sweep.mean.error) =
            (printed.best(Measure::Mean).t.value(), printed.best(Measure::Mean).error.value());
        sweep.median.t = printed.best(Measure::Median).t.value();
        study
    };
    BASIC.iter().map(mesh).collect()
}

fn properties() -> ModelProperties {
    ModelProperties {
        scale: 1.0,
        vertices: 10,
        edges: 24,
        faces: 16,
        source: 0,
        anisotropy: Some(1.1),
        mean_edge: 0.2,
        variance: 0.01,
        sigma: 0.1,
        mean_absolute_deviation: 0.1,
        median_absolute_deviation: 0.1,
        min_edge: 0.1,
        max_edge: 0.5,
        edge_ratio: 0.2,
        min_angle: 20.0,
        max_angle: 100.0,
        q1: 0.1,
        q2: 0.2,
        q3: 0.3,
        quartile_deviation: 0.1,
    }
}
