//! Which choice would give other numbers than the paper's? One is changed at a time.
//!
//! The *paper's setting* is that of its heat tool: plain cotangents, distances shifted by their minimum, no heat through the
//! boundary, and as errors the mean and the median over all vertices, the source among them. Each row changes one thing
//! and tells the errors at the same t: where the paper's setting has its least mean and its least median error, and at
//! Eq. 1 to 5.
//!
//! With the paper's setting the library gives what that tool gives, to 3e-7 of the largest distance on all meshes of 57 that
//! have no triangle without area (it adds 1e-10 to the diagonal of L). That holds for the second step too: the
//! tool takes the magnitude of u. A program that keeps the sign, as the algorithm is printed, has 11.8 % on camel and 6.3 %
//! on homer from the first vertex with Eq. 1, where tool and library have 3.4 % and 3.7 %.
//!
//! Nine systems at most, a factorisation and a solve for each of seven t with each, exact distances from five more sources.
//!
//! References: K. Crane: libgeodesic 0.1, the reference code of "Geodesics in Heat"; "Wave propagation time optimization
//! for geodesic distances calculation using the Heat Method", Open Physics 17 (2019), section 3.1.

use crate::accuracy::median;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::names::FORMULAS;
use crate::probe::{self, Probe};
use crate::properties::ModelProperties;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use std::fmt;
use taut::{Control, HeatOptions, Laplacian, MeshReport, Shift, TimeScale, TimeStep};

/// What differs from the paper's setting.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Choice {
    /// Nothing.
    Paper,
    /// The mean is over the vertices but the source.
    SourceLeftOut,
    /// The root of the mean square of the errors takes the place of the mean.
    RootMeanSquare,
    /// |φ - exact| is divided by the mean exact distance, not by that of the vertex.
    OverMeanDistance,
    /// The largest error takes the place of the mean.
    Largest,
    /// The intrinsic Delaunay Laplacian.
    Intrinsic,
    /// Distances are pinned at the source.
    Pinned,
    /// Another boundary blend: 0 reflects heat, 1 absorbs it.
    Boundary(f64),
    /// Another source vertex.
    Source(u32),
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Choice::Paper => f.write_str("the paper's setting"),
            Choice::SourceLeftOut => f.write_str("source not counted"),
            Choice::RootMeanSquare => f.write_str("root mean square error"),
            Choice::OverMeanDistance => f.write_str("absolute error over the mean distance"),
            Choice::Largest => f.write_str("largest error"),
            Choice::Intrinsic => f.write_str("intrinsic Delaunay Laplacian"),
            Choice::Pinned => f.write_str("distance 0 held at the source"),
            Choice::Boundary(b) => write!(f, "boundary {b}"),
            Choice::Source(v) => write!(f, "source {v}"),
        }
    }
}

/// Errors in percent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ErrorPair {
    /// The mean error, or what takes its place.
    pub mean: f64,
    /// The median error; `None` where there is no median of its kind.
    pub median: Option<f64>,
}

/// The errors with one choice.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// At the t where the paper's setting has its least mean error.
    pub at_best_mean: ErrorPair,
    /// At the t where the paper's setting has its least median error.
    pub at_best_median: ErrorPair,
    /// At Eq. 1 to 5 at the paper's size; `None` where the formula is refused on this model.
    pub at_formulas: Vec<Option<ErrorPair>>,
}

/// One choice and what comes of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What is changed.
    pub choice: Choice,
    /// The errors; `Err` says why there are none.
    pub outcome: std::result::Result<Figures, String>,
}

/// One model with each choice.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ablation {
    /// Its name.
    pub model: String,
    /// Its source, but in the rows that change it.
    pub source: u32,
    /// Whether it has a boundary.
    pub has_boundary: bool,
    /// Where the paper's setting has its least mean and its least median error, at the paper's size.
    pub best_t: [f64; 2],
    /// The paper's setting first.
    pub rows: Vec<Row>,
}

/// How errors are put into numbers.
const DEFINITIONS: [Choice; 4] =
    [Choice::SourceLeftOut, Choice::RootMeanSquare, Choice::OverMeanDistance, Choice::Largest];

/// How many sources are drawn, and from what.
const DRAWN: usize = 3;
const SEED: u64 = 2019;

/// The errors of `model` with each choice. `exact` are its exact distances, `best_t` where the paper's setting has its
/// least mean and its least median error, at the paper's size.
///
/// # Errors
/// [`Error::Input`] if the model has no size; [`Error::Model`] if the work is cancelled or exact distances from
/// another source cannot be had. All else is told in its row.
pub fn ablation(model: &Model, exact: &[f64], best_t: [f64; 2], control: &Control) -> Result<Ablation> {
    let has_boundary = !MeshReport::new(&model.mesh).boundary_loops.is_empty();
    let steps = Steps::new(model, best_t)?;
    let mut rows = definitions(model, exact, &steps, control)?;
    for choice in [Choice::Intrinsic, Choice::Pinned, Choice::Boundary(0.5), Choice::Boundary(1.0)] {
        let outcome = match choice {
            Choice::Boundary(_) if !has_boundary => Err("no boundary: no effect".to_owned()),
            _ => figures(steps.fields(model, exact, &options(choice), control)?, exact, choice),
        };
        rows.push(Row { choice, outcome });
    }
    for source in other_sources(model.source, exact) {
        let (moved, choice) = (Model { source, ..model.clone() }, Choice::Source(source));
        let exact = probe::exact(&moved, source, control)?;
        let outcome = figures(steps.fields(&moved, &exact, &options(choice), control)?, &exact, choice);
        rows.push(Row { choice, outcome });
    }
    Ok(Ablation { model: model.name.clone(), source: model.source, has_boundary, best_t, rows })
}

/// The rows of the paper's setting and of other definitions of the error, which share their distances.
fn definitions(model: &Model, exact: &[f64], steps: &Steps, control: &Control) -> Result<Vec<Row>> {
    let fields = steps.fields(model, exact, &options(Choice::Paper), control)?;
    let choices = [Choice::Paper].into_iter().chain(DEFINITIONS);
    Ok(choices.map(|choice| Row { choice, outcome: figures(fields.clone(), exact, choice) }).collect())
}

/// The options of the paper's setting, but for `choice`.
fn options(choice: Choice) -> HeatOptions {
    let paper = HeatOptions { laplacian: Laplacian::Plain, shift: Shift::Min, boundary: 0.0, ..HeatOptions::default() };
    match choice {
        Choice::Intrinsic => HeatOptions { laplacian: Laplacian::Intrinsic, ..paper },
        Choice::Pinned => HeatOptions { shift: Shift::Pinned, ..paper },
        Choice::Boundary(boundary) => HeatOptions { boundary, ..paper },
        _ => paper,
    }
}

/// The vertices before and after `source`, as by counting from 1, and some that are drawn: all those that it reaches.
fn other_sources(source: u32, exact: &[f64]) -> Vec<u32> {
    let is_reached = |v: &u32| exact.get(*v as usize).is_some_and(|d| d.is_finite());
    let beside = [source.checked_sub(1), source.checked_add(1)].into_iter().flatten();
    let mut sources: Vec<u32> = beside.filter(is_reached).collect();
    let mut others: Vec<u32> = (0..exact.len() as u32).filter(is_reached).collect(); // a mesh counts its vertices in u32
    others.retain(|v| *v != source && !sources.contains(v));
    let mut random = Pcg64::seed_from_u64(SEED);
    for _ in 0..DRAWN.min(others.len()) {
        sources.push(others.swap_remove(random.random_range(0..others.len())));
    }
    sources
}

/// The t that each choice is tried with.
struct Steps {
    best: [f64; 2],
    formulas: Vec<Option<f64>>,
}

/// Distances at the best t and at those of the formulas.
#[derive(Clone)]
struct Fields {
    best: [Vec<f64>; 2],
    formulas: Vec<Option<Vec<f64>>>,
}

impl Steps {
    fn new(model: &Model, best: [f64; 2]) -> Result<Steps> {
        let s = ModelProperties::of(model)?.scale;
        let at_paper_size = |(_, formula)| {
            let step = TimeStep::Formula { formula, scale: TimeScale::Paper, factor: 1.0 };
            step.value(&model.mesh).ok().map(|t| s * s * t)
        };
        Ok(Steps { best, formulas: FORMULAS.into_iter().map(at_paper_size).collect() })
    }

    /// The distances at each t; `Ok(Err)` says why there are none, `Err` is for cancelled work.
    fn fields(
        &self,
        model: &Model,
        exact: &[f64],
        options: &HeatOptions,
        control: &Control,
    ) -> Result<std::result::Result<Fields, String>> {
        let fields = Probe::new(model, exact, options, control).and_then(|probe| {
            let [mean, median] = self.best;
            let best = [probe.distances(mean)?, probe.distances(median)?];
            let formulas = self.formulas.iter().map(|t| t.map(|t| probe.distances(t)).transpose());
            Ok(Fields { best, formulas: formulas.collect::<Result<_>>()? })
        });
        match fields {
            Ok(fields) => Ok(Ok(fields)),
            Err(error) if error.is_cancelled() => Err(error),
            Err(Error::Model { error, .. }) => Ok(Err(error.to_string())),
            Err(error) => Ok(Err(error.to_string())),
        }
    }
}

/// The errors of the distances by the definition of `choice`; `Err` also where one is no number.
fn figures(
    fields: std::result::Result<Fields, String>,
    exact: &[f64],
    choice: Choice,
) -> std::result::Result<Figures, String> {
    let fields = fields?;
    let errors = |distances: &Vec<f64>| errors(distances, exact, choice);
    let formulas = fields.formulas.iter().map(|distances| distances.as_ref().map(errors).transpose());
    Ok(Figures {
        at_best_mean: errors(&fields.best[0])?,
        at_best_median: errors(&fields.best[1])?,
        at_formulas: formulas.collect::<std::result::Result<_, _>>()?,
    })
}

/// The mean and the median error by the definition of `choice`, over what both reach.
fn errors(distances: &[f64], exact: &[f64], choice: Choice) -> std::result::Result<ErrorPair, String> {
    let reached = distances.iter().zip(exact).filter(|(phi, exact)| phi.is_finite() || exact.is_finite());
    let pairs: Vec<(f64, f64)> = reached.map(|(&phi, &exact)| (phi, exact)).collect();
    let n = pairs.len().max(1) as f64;
    let relative = |&(phi, exact): &(f64, f64)| if exact == 0.0 { 0.0 } else { (phi - exact).abs() / exact.abs() };
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    let all: Vec<f64> = pairs.iter().map(relative).collect();
    if !all.iter().all(|error| error.is_finite()) {
        return Err("a vertex has no distance by one of the methods".to_owned());
    }
    let (mean, median) = match choice {
        Choice::SourceLeftOut => {
            let others: Vec<f64> = pairs.iter().filter(|(_, exact)| *exact != 0.0).map(relative).collect();
            (mean(&others), Some(median(others)))
        }
        Choice::RootMeanSquare => ((all.iter().map(|e| e * e).sum::<f64>() / n).sqrt(), None),
        Choice::OverMeanDistance => {
            let distance = pairs.iter().map(|(_, exact)| exact).sum::<f64>() / n;
            let shares: Vec<f64> = pairs
                .iter()
                .map(|(phi, exact)| if distance == 0.0 { 0.0 } else { (phi - exact).abs() / distance })
                .collect();
            (mean(&shares), Some(median(shares)))
        }
        Choice::Largest => (all.iter().copied().fold(0.0, f64::max), None),
        _ => (mean(&all), Some(median(all))),
    };
    Ok(ErrorPair { mean: 100.0 * mean, median: median.map(|median| 100.0 * median) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use taut::{Mesh, shapes};

    fn ablated(mesh: Mesh, source: u32) -> Ablation {
        let model = Model::new("m".to_owned(), mesh, Some(source)).unwrap();
        let exact = probe::exact(&model, source, &Control::new()).unwrap();
        ablation(&model, &exact, [0.5, 1.0], &Control::new()).unwrap()
    }

    fn row(ablation: &Ablation, choice: Choice) -> &Row {
        ablation.rows.iter().find(|row| row.choice == choice).unwrap()
    }

    fn means(row: &Row) -> Vec<f64> {
        let figures = row.outcome.as_ref().unwrap();
        let best = [figures.at_best_mean.mean, figures.at_best_median.mean];
        best.into_iter().chain(figures.at_formulas.iter().flatten().map(|errors| errors.mean)).collect()
    }

    #[test]
    fn definitions_are_what_they_say() {
        let (distances, exact) = ([0.5, 1.5, 3.0, 4.0, f64::INFINITY], [0.0, 1.0, 4.0, 4.0, f64::INFINITY]);
        let by = |choice| {
            let pair = errors(&distances, &exact, choice).unwrap();
            (pair.mean, pair.median)
        };
        assert_eq!(by(Choice::Paper), (75.0 / 4.0, Some(12.5)));
        assert_eq!(by(Choice::SourceLeftOut), (25.0, Some(25.0)));
        assert_eq!(by(Choice::RootMeanSquare), (100.0 * (0.3125f64 / 4.0).sqrt(), None));
        // |φ - exact| are 0.5, 0.5, 1, 0, the mean distance is 9/4.
        let (mean, median) = by(Choice::OverMeanDistance);
        assert!((mean - 200.0 / 9.0).abs() < 1e-12 && (median.unwrap() - 200.0 / 9.0).abs() < 1e-12);
        assert_eq!(by(Choice::Largest), (50.0, None));
        assert!(errors(&[f64::INFINITY], &[1.0], Choice::Paper).is_err());
        assert!(errors(&[f64::NAN, 1.0], &[1.0, 1.0], Choice::Largest).is_err());
    }

    #[test]
    fn a_choice_changes_what_it_should() {
        let ablation = ablated(shapes::terrain(12, 3.0).mesh().unwrap(), 70);
        assert!(ablation.has_boundary);
        let paper = means(row(&ablation, Choice::Paper));
        for Row { choice, outcome } in ablation.rows.iter().filter(|row| row.choice != Choice::Paper) {
            let Ok(_) = outcome else { panic!("{choice}: {outcome:?}") };
            let others = means(row(&ablation, *choice));
            let differs = others.iter().zip(&paper).any(|(other, paper)| (other - paper).abs() > 1e-9 * paper);
            assert!(differs, "{choice}: {others:?} {paper:?}");
        }
        assert_eq!(ablation.rows.len(), 9 + 2 + DRAWN);
    }

    #[test]
    fn no_boundary_has_no_effect() {
        let mesh = shapes::icosphere(2).mesh().unwrap();
        let ablation = ablated(mesh.clone(), 3);
        assert!(!ablation.has_boundary);
        for b in [0.5, 1.0] {
            assert_eq!(row(&ablation, Choice::Boundary(b)).outcome, Err("no boundary: no effect".to_owned()));
            let model = Model::new("m".to_owned(), mesh.clone(), Some(3)).unwrap();
            let (exact, control) = (probe::exact(&model, 3, &Control::new()).unwrap(), Control::new());
            let probe = Probe::new(&model, &exact, &options(Choice::Boundary(b)), &control).unwrap();
            let paper = row(&ablation, Choice::Paper).outcome.as_ref().unwrap().at_best_mean.mean;
            assert!((probe.errors(0.5).unwrap().mean_percent - paper).abs() < 1e-12 * paper);
        }
        // Eq. 2 is refused nowhere here, but where all edges are equal it is.
        let equal = ablated(
            Mesh::from_triangles(
                &[[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]],
                &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
            )
            .unwrap(),
            0,
        );
        let figures = row(&equal, Choice::Paper).outcome.as_ref().unwrap();
        assert!(figures.at_formulas[0].is_some() && figures.at_formulas[1].is_none());
    }

    #[test]
    fn a_source_on_a_boundary_that_absorbs_is_refused_in_its_row() {
        let ablation = ablated(shapes::grid(6, 6).mesh().unwrap(), 0);
        let outcome = &row(&ablation, Choice::Boundary(1.0)).outcome;
        assert!(outcome.as_ref().unwrap_err().contains("boundary"), "{outcome:?}");
        assert!(row(&ablation, Choice::Boundary(0.5)).outcome.is_ok());
    }

    #[test]
    fn sources_are_others_and_the_same_every_time() {
        let ablation = ablated(shapes::icosphere(1).mesh().unwrap(), 0);
        let sources: Vec<Choice> = ablation.rows[9..].iter().map(|row| row.choice).collect();
        assert_eq!(sources.len(), 1 + DRAWN);
        assert_eq!(sources[0], Choice::Source(1));
        assert!(!sources.contains(&Choice::Source(0)));
        assert_eq!(other_sources(0, &[0.0, f64::INFINITY, 2.0]), [2]);
        assert_eq!(other_sources(5, &[1.0; 9])[..2], [4, 6]);
        assert_eq!(other_sources(5, &[1.0; 9]), other_sources(5, &[1.0; 9]));
    }

    #[test]
    fn it_is_written_and_read_back() {
        let ablation = ablated(shapes::grid(6, 6).mesh().unwrap(), 0);
        let text = serde_json::to_string(&ablation).unwrap();
        assert_eq!(serde_json::from_str::<Ablation>(&text).unwrap(), ablation);
    }

    #[test]
    fn cancelled_work_is_no_row() {
        let model = Model::new("m".to_owned(), shapes::grid(6, 6).mesh().unwrap(), None).unwrap();
        let exact = probe::exact(&model, 0, &Control::new()).unwrap();
        let control = Control::new();
        control.cancel();
        assert!(ablation(&model, &exact, [0.5, 1.0], &control).unwrap_err().is_cancelled());
    }
}
