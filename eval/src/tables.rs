//! Results as tables for people.

use crate::correlate::{Correlation, Undefined, correlations};
use crate::fit::Fit;
use crate::gain::{Counts, FormulaGain, Interval, Outcome, Ratios, Verdict};
use crate::names::{self, FORMULAS, LAPLACIANS, SCALES, equation};
use crate::paper::{BASIC, HEADLINES, TABLES};
use crate::properties::{ModelProperties, Property};
use crate::report::numbers::{fixed, gain, significant};
use crate::report::{Cell, Table, Tone};
use crate::study::{LaplacianStudy, Study};
use crate::sweep::{Best, Measure};
use serde::Serialize;
use taut::{Laplacian, TimeFormula, TimeScale};

/// The properties of one model, at the paper's size and in the units of the mesh.
#[must_use]
pub fn properties(model: &str, of: &ModelProperties) -> Table {
    let row = |symbol: &str, name: &str, value: f64, power: i32| -> Vec<Cell> {
        let in_mesh = significant(value / of.scale.powi(power));
        vec![name.into(), symbol.into(), significant(value).into(), in_mesh.into()]
    };
    let mut rows: Vec<Vec<Cell>> =
        Property::ALL.iter().map(|&p| row(p.symbol(), p.name(), of.value(p), p.power())).collect();
    rows.push(row("", "median absolute deviation of the edges", of.median_absolute_deviation, 1));
    rows.push(row("s", "from mesh units to the paper's size", of.scale, 1));
    Table {
        title: model.to_owned(),
        head: ["property", "", "at the paper's size", "in mesh units"].map(str::to_owned).into(),
        rows,
        ..Table::default()
    }
}

/// Each model's best t with each Laplacian, by the sweep or by the search.
#[must_use]
pub fn best(studies: &[Study], search: bool) -> Table {
    let head = ["model", "Laplacian", "error", "least %", "at t", "t/ē²", "t in mesh units²", "maximum t", "t tried"];
    let each = studies.iter().flat_map(|study| study.laplacians.iter().map(move |of| (study, of)));
    let rows = each.flat_map(|(study, of)| {
        let row = move |measure: Measure| {
            let found = if search { of.searched(measure) } else { of.sweep.best(measure) };
            best_row(study, of.laplacian, measure, found)
        };
        Measure::ALL.map(row)
    });
    Table {
        title: if search { "Best t by the search that stops at the maximum t" } else { "Best t by the sweep" }
            .to_owned(),
        note: "t is at the paper's size where nothing else is said; at an end of the range it is marked by *"
            .to_owned(),
        head: head.map(str::to_owned).into(),
        rows: rows.collect(),
        ..Table::default()
    }
}

fn best_row(study: &Study, laplacian: Laplacian, measure: Measure, found: Best) -> Vec<Cell> {
    let properties = &study.properties;
    let shares = found.t / (properties.mean_edge * properties.mean_edge);
    let mark = if found.at_end { "*" } else { "" };
    vec![
        study.model.as_str().into(),
        laplacian_name(laplacian).into(),
        measure.name().into(),
        fixed(found.error, 5).into(),
        (significant(found.t) + mark).into(),
        significant(shares).into(),
        significant(found.t / properties.scale / properties.scale).into(),
        found.maximum_t.map_or("beyond".to_owned(), significant).into(),
        found.probes.to_string().into(),
    ]
}

/// How the best t goes with each property, for one error and one Laplacian.
#[derive(Debug, Clone, Serialize)]
pub struct Correlated {
    /// With which Laplacian t is the best.
    #[serde(with = "names::laplacian")]
    pub laplacian: Laplacian,
    /// For which error.
    pub measure: Measure,
    /// How many models there are.
    pub models: usize,
    /// The largest r first.
    pub properties: Vec<(Property, Result<Correlation, Undefined>)>,
}

/// Pearson's r of the best t with each property, for each Laplacian and each error.
#[must_use]
pub fn correlate(studies: &[Study]) -> Vec<Correlated> {
    let of = |(laplacian, measure)| {
        let rows = best_rows(studies, laplacian, measure);
        Correlated { laplacian, measure, models: rows.len(), properties: correlations(&rows) }
    };
    each(studies).map(of).collect()
}

/// The same as a table.
#[must_use]
pub fn correlated(of: &Correlated) -> Table {
    let rows = of.properties.iter().map(|(property, r)| {
        [vec![property.name().into(), property.symbol().into()], correlation_cells(r).to_vec()].concat()
    });
    Table {
        title: format!(
            "r with the best t for the {} error, {} Laplacian, {} models",
            of.measure.name(),
            laplacian_name(of.laplacian),
            of.models
        ),
        head: ["property", "", "r", "95 %"].map(str::to_owned).into(),
        rows: rows.collect(),
        ..Table::default()
    }
}

fn correlation_cells(of: &Result<Correlation, Undefined>) -> [Cell; 2] {
    match of {
        Ok(of) => {
            let interval = of.interval.map(|[low, high]| format!("{} … {}", fixed(low, 3), fixed(high, 3)));
            [fixed(of.r, 4).into(), interval.unwrap_or("–".to_owned()).into()]
        }
        Err(reason) => [reason.to_string().into(), Cell::default()],
    }
}

/// The Laplacians that were asked for, each with both errors.
fn each(studies: &[Study]) -> impl Iterator<Item = (Laplacian, Measure)> {
    let is_there = |&laplacian: &Laplacian| studies.iter().any(|study| study.with(laplacian).is_some());
    let laplacians = LAPLACIANS.map(|(_, laplacian)| laplacian).into_iter().filter(is_there).collect::<Vec<_>>();
    laplacians.into_iter().flat_map(|laplacian| Measure::ALL.map(|measure| (laplacian, measure)))
}

/// The properties of the models, each with its best t.
pub(crate) fn best_rows(studies: &[Study], laplacian: Laplacian, measure: Measure) -> Vec<(&ModelProperties, f64)> {
    let best = |study: &Study| study.with(laplacian).map(|of| of.sweep.best(measure).t);
    studies.iter().filter_map(|study| Some((&study.properties, best(study)?))).collect()
}

/// The lines through the best t, for one error and one Laplacian.
#[derive(Debug, Clone, Serialize)]
pub struct Fitted {
    /// With which Laplacian t is the best.
    #[serde(with = "names::laplacian")]
    pub laplacian: Laplacian,
    /// For which error.
    pub measure: Measure,
    /// How many models there are.
    pub models: usize,
    /// t over σ, as the paper's Eq. 4.
    pub over_sigma: Result<Fit, Undefined>,
    /// t / ē² over σ / ē, which depends on no unit.
    pub invariant: Result<Fit, Undefined>,
}

/// The lines through the best t, for each Laplacian and each error.
#[must_use]
pub fn fit(studies: &[Study]) -> Vec<Fitted> {
    let of = |(laplacian, measure)| {
        let rows = best_rows(studies, laplacian, measure);
        let over_sigma = Fit::of_property(Property::Sigma, &rows);
        Fitted { laplacian, measure, models: rows.len(), over_sigma, invariant: Fit::invariant(&rows) }
    };
    each(studies).map(of).collect()
}

/// The same as a table.
#[must_use]
pub fn fitted(fits: &[Fitted]) -> Table {
    let rows = fits.iter().flat_map(|of| {
        [("t over σ", of.over_sigma), ("t/ē² over σ/ē", of.invariant)].map(|(line, fit)| {
            [vec![laplacian_name(of.laplacian).into(), of.measure.name().into(), line.into()], fit_cells(fit)].concat()
        })
    });
    let head = ["Laplacian", "error", "line", "slope", "95 %", "constant", "95 %", "R²"];
    Table {
        title: format!("Lines through the best t of {} models", fits.first().map_or(0, |of| of.models)),
        note: "the paper's Eq. 4, for the median error: t = 1.01204 σ − 0.0001".to_owned(),
        head: head.map(str::to_owned).into(),
        rows: rows.collect(),
        ..Table::default()
    }
}

fn fit_cells(fit: Result<Fit, Undefined>) -> Vec<Cell> {
    let interval = |[low, high]: [f64; 2]| Cell::from(format!("{} … {}", significant(low), significant(high)));
    match fit {
        Ok(fit) => vec![
            fixed(fit.slope.value, 5).into(),
            interval(fit.slope.interval),
            fixed(fit.intercept.value, 5).into(),
            interval(fit.intercept.interval),
            fixed(fit.r_squared, 4).into(),
        ],
        Err(reason) => std::iter::once(reason.to_string().into()).chain(vec![Cell::default(); 4]).collect(),
    }
}

/// What each formula gains over Eq. 1 on each model.
#[must_use]
pub fn gains(studies: &[Study]) -> Table {
    let head = [
        "model",
        "Laplacian",
        "formula",
        "units",
        "t",
        "t/ē²",
        "mean %",
        "gain",
        "over vertices",
        "over sources",
        "median %",
        "gain",
        "over vertices",
        "over sources",
    ];
    let mut rows = Vec::new();
    for study in studies {
        for of in &study.laplacians {
            rows.extend(of.formulas.iter().map(|gain| gain_row(study, of, gain)));
        }
    }
    Table {
        title: "Gain of each formula over Eq. 1".to_owned(),
        note: "1 - (error with the formula) / (error with Eq. 1), its 95 % interval by the bootstrap over vertices and over sources, and what it says: + better, - worse, ? unsure".to_owned(),
        head: head.map(str::to_owned).into(),
        rows,
        ..Table::default()
    }
}

fn gain_row(study: &Study, of: &LaplacianStudy, gain: &FormulaGain) -> Vec<Cell> {
    let scale = SCALES.iter().find(|(_, scale)| *scale == gain.scale).map_or("", |(name, _)| name);
    let head = [study.model.as_str(), laplacian_name(of.laplacian), equation(gain.formula), scale].map(Cell::from);
    let tail = match &gain.outcome {
        Ok(outcome) => outcome_cells(study, outcome),
        Err(reason) => std::iter::once(reason.as_str().into()).chain(vec![Cell::default(); 9]).collect(),
    };
    [head.to_vec(), tail].concat()
}

fn outcome_cells(study: &Study, outcome: &Outcome) -> Vec<Cell> {
    let shares = outcome.t / (study.properties.mean_edge * study.properties.mean_edge);
    let mut cells: Vec<Cell> = vec![significant(outcome.t).into(), significant(shares).into()];
    for (measure, error) in Measure::ALL.into_iter().zip([outcome.mean, outcome.median]) {
        let ratio = outcome.over_vertices.of(measure).ratio;
        cells.extend([fixed(error, 3), gain(ratio)].map(Cell::from));
        cells.extend(
            [Some(&outcome.over_vertices), outcome.over_sources.as_ref()].map(|ratios| interval_cell(ratios, measure)),
        );
    }
    cells
}

fn interval_cell(ratios: Option<&Ratios>, measure: Measure) -> Cell {
    let Some(ratios) = ratios else { return Cell::default() };
    let of @ Interval { low, high, .. } = ratios.of(measure);
    let (sign, tone) = match of.verdict() {
        Verdict::Better => ("+", Tone::Good),
        Verdict::Worse => ("−", Tone::Bad),
        Verdict::Unsure => ("?", Tone::Plain),
    };
    Cell::new(format!("{} … {} {sign}", gain(high), gain(low)), tone)
}

fn laplacian_name(laplacian: Laplacian) -> &'static str {
    LAPLACIANS.iter().find(|(_, known)| *known == laplacian).map_or("", |(name, _)| name)
}

/// The basic set: a row for each property with its values from 1.obj to 5.obj, and the paper's.
#[must_use]
pub fn basic_set(set: &[ModelProperties]) -> Vec<Table> {
    let row = |&property: &Property| -> Vec<Cell> {
        let ours = set.iter().map(|of| significant(of.value(property)).into());
        let paper = BASIC.iter().map(|mesh| Cell::new(mesh.printed(property).to_string(), Tone::Pale));
        [property.symbol().into()].into_iter().chain(ours).chain(paper).collect()
    };
    let table = |(number, properties): (usize, &&[Property])| {
        let names = || BASIC.iter().map(|mesh| mesh.name);
        Table {
            title: format!("Table {number}"),
            note: String::new(),
            groups: [("", 1), ("ours", 5), ("paper", 5)].map(|(name, count)| (name.to_owned(), count)).into(),
            head: [""].into_iter().chain(names()).chain(names()).map(str::to_owned).collect(),
            rows: properties.iter().map(row).collect(),
        }
    };
    (1..).zip(&TABLES).map(table).collect()
}

/// On how many models each formula is better than Eq. 1, worse, or neither for sure; beside the paper's counts.
#[must_use]
pub fn headline(studies: &[Study]) -> Table {
    let mut rows = Vec::new();
    for (laplacian, measure) in each(studies) {
        for (_, formula) in FORMULAS.into_iter().filter(|&(_, formula)| formula != TimeFormula::MeanEdge) {
            let printed = HEADLINES.iter().find(|figure| figure.formula == formula && figure.measure == measure);
            let outcomes = || studies.iter().filter_map(|study| study.outcome(laplacian, formula, TimeScale::Paper));
            let over_vertices = tally(outcomes().map(|of| of.over_vertices.of(measure)));
            let over_sources = tally(outcomes().filter_map(|of| Some(of.over_sources?.of(measure))));
            let paper = printed.map_or("–".to_owned(), |figure| figure.counts.to_string());
            let first = [laplacian_name(laplacian), equation(formula), measure.name()].map(Cell::from);
            rows.push([first.to_vec(), [over_vertices, over_sources, paper].map(Cell::from).to_vec()].concat());
        }
    }
    let head = ["Laplacian", "formula", "error", "over vertices", "over sources", "paper"];
    Table {
        title: format!("Better / worse / unsure, of {} models", studies.len()),
        head: head.map(str::to_owned).into(),
        rows,
        ..Table::default()
    }
}

fn tally(intervals: impl Iterator<Item = Interval>) -> String {
    Counts::of(intervals.map(|interval| interval.verdict())).to_string()
}
