//! The basic set again with other random numbers: how much of what five meshes say is chance.

use crate::basic_set::basic_set;
use crate::correlate::correlations;
use crate::error::Result;
use crate::fit::Fit;
use crate::model::Model;
use crate::names;
use crate::probe;
use crate::properties::{ModelProperties, Property};
use crate::study::Study;
use crate::sweep::Measure;
use serde::{Deserialize, Serialize};
use taut::{Control, Laplacian};

/// What the five meshes of one seed say, for one Laplacian and one error.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drawn {
    /// The seed of the meshes.
    pub seed: u64,
    /// With which Laplacian t is the best.
    #[serde(with = "names::laplacian")]
    pub laplacian: Laplacian,
    /// For which error.
    pub measure: Measure,
    /// The least errors, 1.obj first, in percent.
    pub errors: Vec<f64>,
    /// The t that gives them.
    pub times: Vec<f64>,
    /// Pearson's r of t with the standard deviation of the edges; `None` where it is not defined.
    pub sigma: Option<f64>,
    /// The property with the largest |r|, and its r.
    pub strongest: Option<(Property, f64)>,
    /// The line through t over the standard deviation; `None` where there is none.
    pub line: Option<Fit>,
}

/// Makes the basic set of `first` with a seed and finds the best t of its meshes; `best` is that of `first` itself.
///
/// # Errors
/// As [`basic_set`] and [`Study::new`].
pub(crate) fn draw(first: &Model, best: &Study, seed: u64, control: &Control) -> Result<Vec<Drawn>> {
    let laplacians: Vec<Laplacian> = best.laplacians.iter().map(|of| of.laplacian).collect();
    let mut studies = vec![best.clone()];
    for made in basic_set(first, seed)? {
        let exact = probe::exact(&made.model, made.model.source, control)?;
        studies.push(Study::new(&made.model, &exact, &laplacians, None, control, &|_| {})?);
    }
    Ok(judge(&studies, seed))
}

/// What the meshes of a seed say, for each Laplacian and each error.
pub(crate) fn judge(studies: &[Study], seed: u64) -> Vec<Drawn> {
    let laplacians = studies.first().map_or(&[][..], |study| &study.laplacians).iter().map(|of| of.laplacian);
    let each = laplacians.flat_map(|laplacian| Measure::ALL.map(|measure| (laplacian, measure)));
    each.map(|(laplacian, measure)| Drawn::of(studies, seed, laplacian, measure)).collect()
}

impl Drawn {
    fn of(studies: &[Study], seed: u64, laplacian: Laplacian, measure: Measure) -> Drawn {
        let best = studies.iter().filter_map(|study| Some((study, study.with(laplacian)?.sweep.best(measure))));
        let (studies, best): (Vec<_>, Vec<_>) = best.unzip();
        let rows: Vec<(&ModelProperties, f64)> =
            studies.iter().zip(&best).map(|(study, best)| (&study.properties, best.t)).collect();
        let r: Vec<(Property, f64)> =
            correlations(&rows).into_iter().filter_map(|(property, r)| Some((property, r.ok()?.r))).collect();
        Drawn {
            seed,
            laplacian,
            measure,
            errors: best.iter().map(|best| best.error).collect(),
            times: best.iter().map(|best| best.t).collect(),
            sigma: r.iter().find(|(property, _)| *property == Property::Sigma).map(|&(_, r)| r),
            strongest: r.into_iter().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())),
            line: Fit::of_property(Property::Sigma, &rows).ok(),
        }
    }
}
