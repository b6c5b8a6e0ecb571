//! What a formula gains over Eq. 1: the ratio of its error to that of Eq. 1 at the paper's size, with a 95 % confidence
//! interval.
//!
//! ```text
//! ratio = error of the heat method at the formula's t / error at the t of Eq. 1        below 1: the formula is better
//! ```
//!
//! for the mean error and for the median error. The paper does not say what its intervals are over. It has one source for
//! each model, so they can only be over vertices; both kinds are here:
//!
//! - *Over vertices*: the vertices that the model's source reaches, itself included, are resampled. Errors of neighbours are
//!   much alike, and a resample takes them for independent: this interval is too narrow, the more so the finer the mesh,
//!   and it says nothing about another source.
//! - *Over sources*: the ratio is that of the mean over all [`Sources`] of their mean (or median) errors, and sources are
//!   resampled. It says what to expect from any source on this model.
//!
//! On 14 meshes of 507 to 537,374 vertices, with 16 sources, the second is seven times as wide in the median. Of 103
//! verdicts over vertices that are not unsure, 14 are unsure over sources, and 10 the opposite: the first vertex is a source
//! unlike others.
//!
//! Cost: exact distances from each source, once; a factorisation for each formula in each unit, a solve for each
//! source; the resamples. With 16 sources and 1000 resamples 3, 16 and 99 s for the exact ones of lucy, igea and igea_x4
//! (50,000, 134,000 and 537,000 vertices), and 2, 10 and 45 s for each Laplacian.
//!
//! References: "Wave propagation time optimization for geodesic distances calculation using the Heat Method", Open
//! Physics 17 (2019), section 5.

mod bootstrap;
mod sources;

pub use bootstrap::Bootstrap;
pub use sources::Sources;

use crate::accuracy::{Errors, percents};
use crate::error::{Error, Result};
use crate::names::{self, FORMULAS, SCALES};
use crate::properties::ModelProperties;
use crate::sweep::Measure;
use serde::{Deserialize, Serialize};
use std::fmt;
use taut::{Control, HeatOptions, HeatSolver, Reason, Source, TimeFormula, TimeScale, TimeStep};

/// What the others are compared to.
const EQUATION_1: (TimeFormula, TimeScale) = (TimeFormula::MeanEdge, TimeScale::Paper);

/// Why there are no ratios.
const NO_RATIO: &str = "its ratio to the error of Eq. 1 is no number on some resample: too few vertices have an error";

/// A formula in one unit on one model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FormulaGain {
    /// Which formula.
    #[serde(with = "names::formula")]
    pub formula: TimeFormula,
    /// In which units it is evaluated.
    #[serde(with = "names::scale")]
    pub scale: TimeScale,
    /// What it gives; `Err` says why the formula is refused on this model, or cannot be compared to Eq. 1.
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

/// On how many models which is better.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// The formula.
    pub better: usize,
    /// Eq. 1.
    pub worse: usize,
    /// Neither for sure.
    pub unsure: usize,
}

impl Counts {
    /// Of some verdicts.
    #[must_use]
    pub fn of(verdicts: impl IntoIterator<Item = Verdict>) -> Counts {
        let mut counts = Counts::default();
        for verdict in verdicts {
            *match verdict {
                Verdict::Better => &mut counts.better,
                Verdict::Worse => &mut counts.worse,
                Verdict::Unsure => &mut counts.unsure,
            } += 1;
        }
        counts
    }
}

impl fmt::Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{} / {} / {}", self.better, self.worse, self.unsure)
    }
}

/// What a bootstrap draws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Over {
    Vertices,
    Sources,
}

impl Outcome {
    /// The ratio to Eq. 1 of one of the errors; `None` where it was not looked at so.
    pub(crate) fn ratio(&self, measure: Measure, over: Over) -> Option<Interval> {
        let ratios = match over {
            Over::Vertices => self.over_vertices,
            Over::Sources => self.over_sources?,
        };
        Some(ratios.of(measure))
    }
}

impl Ratios {
    /// That of one of the errors.
    #[must_use]
    pub fn of(&self, measure: Measure) -> Interval {
        match measure {
            Measure::Mean => self.mean,
            Measure::Median => self.median,
        }
    }
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

/// What each formula gains in each unit; Eq. 1, the same in both, comes once and first. The time step of `options` is not
/// used. All that is drawn is the same for the same seed, whatever the options.
///
/// The memory is twice that of the sources, and 12 bytes for each vertex and formula. Progress is that of each step by
/// itself.
///
/// # Errors
/// [`Error::Input`] if there are no resamples, or the model has no size; [`Error::Model`], as [`HeatSolver::new`] and
/// [`HeatSolver::distance_rows`].
pub fn gains(
    sources: &Sources,
    options: &HeatOptions,
    bootstrap: &Bootstrap,
    control: &Control,
) -> Result<Vec<FormulaGain>> {
    if bootstrap.resamples == 0 {
        return Err(Error::Input("no resamples, but an interval needs some".to_owned()));
    }
    let solvers = Solvers::new(sources, options, control)?;
    let choices = SCALES.iter().flat_map(|&(_, scale)| FORMULAS.iter().map(move |&(_, formula)| (formula, scale)));
    let choices: Vec<_> = choices.filter(|choice| choice.0 != EQUATION_1.0 || *choice == EQUATION_1).collect();
    let trials = choices.iter().map(|&choice| solvers.trial(choice)).collect::<Result<Vec<_>>>()?;
    let outcomes = outcomes(trials, bootstrap, control).map_err(Error::of_model(&sources.model.name))?;
    let of = |((formula, scale), outcome)| FormulaGain { formula, scale, outcome };
    Ok(choices.into_iter().zip(outcomes).map(of).collect())
}

/// What there is to say of a formula, or why there is nothing to say.
type OrReason<T> = std::result::Result<T, String>;

/// The errors that a formula's t gives, in percent.
#[derive(Default)]
struct Trial {
    /// At the paper's size.
    t: f64,
    /// Of the vertices that the model's source reaches.
    errors: Vec<f64>,
    /// Their means and their medians from each source.
    averages: [Vec<f64>; 2],
}

/// The heat method on one model with one Laplacian.
struct Solvers<'a> {
    sources: &'a Sources<'a>,
    /// The factor to the paper's size.
    scale: f64,
    /// With the t of Eq. 1.
    of_equation_1: HeatSolver,
    control: &'a Control,
}

impl<'a> Solvers<'a> {
    fn new(sources: &'a Sources, options: &HeatOptions, control: &'a Control) -> Result<Solvers<'a>> {
        let scale = ModelProperties::of(sources.model)?.scale;
        let options = HeatOptions { time_step: time_step(EQUATION_1), ..*options };
        let solver = HeatSolver::new(&sources.model.mesh, &options, control);
        let of_equation_1 = solver.map_err(Error::of_model(&sources.model.name))?;
        Ok(Solvers { sources, scale, of_equation_1, control })
    }

    /// Tries a formula; `Err` inside where the model does not take it.
    fn trial(&self, choice: (TimeFormula, TimeScale)) -> Result<OrReason<Trial>> {
        match self.distances(choice) {
            Ok((t, rows)) => Ok(self.judged(self.scale * (self.scale * t), &rows)),
            Err(error) if matches!(error.reason(), Reason::BadTimeStep | Reason::NotPositiveDefinite) => {
                Ok(Err(error.to_string()))
            }
            Err(error) => Err(Error::of_model(&self.sources.model.name)(error)),
        }
    }

    /// t in mesh units squared, and the distances from each source.
    fn distances(&self, choice: (TimeFormula, TimeScale)) -> taut::Result<(f64, Vec<Vec<f64>>)> {
        let step = time_step(choice);
        let t = step.value(&self.sources.model.mesh)?;
        let solver = match choice {
            EQUATION_1 => self.of_equation_1.clone(),
            _ => self.of_equation_1.with_time_step(&step, self.control)?,
        };
        let sets: Vec<Vec<Source>> = self.sources.vertices.iter().map(|&v| vec![Source::vertex(v)]).collect();
        Ok((t, solver.distance_rows(&sets, 1, self.control)?))
    }

    fn judged(&self, t: f64, rows: &[Vec<f64>]) -> OrReason<Trial> {
        let exact = &self.sources.exact;
        let all = rows.iter().zip(exact).map(|(row, exact)| Errors::new(row, exact));
        let averages: (Vec<f64>, Vec<f64>) = all.map(|errors| (errors.mean_percent, errors.median_percent)).unzip();
        let averages: [Vec<f64>; 2] = averages.into();
        let errors: Vec<f64> = percents(&rows[0], &exact[0]).into_iter().filter(|error| !error.is_nan()).collect();
        match [t].iter().chain(&errors).chain(averages.iter().flatten()).all(|number| number.is_finite()) {
            true => Ok(Trial { t, errors, averages }),
            false => Err("its errors are not finite".to_owned()),
        }
    }
}

fn time_step((formula, scale): (TimeFormula, TimeScale)) -> TimeStep {
    TimeStep::Formula { formula, scale, factor: 1.0 }
}

/// Compares all to the first, which is that of Eq. 1.
fn outcomes(
    mut trials: Vec<OrReason<Trial>>,
    bootstrap: &Bootstrap,
    control: &Control,
) -> taut::Result<Vec<OrReason<Outcome>>> {
    if let Some(Err(reason)) = trials.first() {
        let without = format!("Eq. 1, to compare to: {reason}");
        trials.iter_mut().filter(|trial| trial.is_ok()).for_each(|trial| *trial = Err(without.clone()));
    }
    // A formula that is refused has no errors; nobody asks for their ratios.
    let none = Trial::default();
    let told = || trials.iter().map(|trial| trial.as_ref().unwrap_or(&none));
    let over_vertices =
        bootstrap.of_values(&told().map(|trial| trial.errors.as_slice()).collect::<Vec<_>>(), control)?;
    let over_sources = bootstrap.of_averages(&told().map(|trial| &trial.averages).collect::<Vec<_>>(), control)?;
    let ratios = over_vertices.into_iter().zip(over_sources);
    Ok(trials.into_iter().zip(ratios).map(|(trial, ratios)| outcome(&trial?, ratios)).collect())
}

fn outcome(trial: &Trial, (over_vertices, over_sources): (Option<Ratios>, Option<Ratios>)) -> OrReason<Outcome> {
    let Trial { t, averages: [means, medians], .. } = trial;
    let over_sources = if means.len() > 1 { Some(over_sources.ok_or(NO_RATIO)?) } else { None };
    let over_vertices = over_vertices.ok_or(NO_RATIO)?;
    Ok(Outcome { t: *t, mean: means[0], median: medians[0], over_vertices, over_sources })
}
