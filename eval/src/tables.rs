//! Results as tables for people.

use crate::correlate::{Correlation, Undefined, correlations};
use crate::fit::Fit;
use crate::gain::{Counts, FormulaGain, Interval, Outcome, Ratios, Verdict};
use crate::names::{self, FORMULAS, LAPLACIANS, SCALES, equation, name};
use crate::paper::{BASIC, HEADLINES, TABLES};
use crate::properties::{ModelProperties, Property};
use crate::report::numbers::{digits, fixed, gain, significant};
use crate::report::{Cell, Table};
use crate::study::Study;
use crate::sweep::{Best, Measure};
use serde::Serialize;
use taut::{Laplacian, TimeFormula, TimeScale};

/// How many digits properties are printed with.
const DIGITS: usize = 6;

/// The properties of one model, at the paper's size and in the units of the mesh.
#[must_use]
pub fn properties(model: &str, of: &ModelProperties) -> Table {
    let row = |name: &str, symbol: &str, cells: [String; 2]| -> Vec<Cell> {
        [name.to_owned(), symbol.to_owned()].into_iter().chain(cells).map(Cell::from).collect()
    };
    let in_mesh = |value: f64, power: i32| digits(value / of.scale.powi(power), DIGITS);
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for property in Property::ALL {
        let value = of.value(property);
        let cells = match is_count(property) {
            true => [fixed(value, 0), fixed(value, 0)],
            false => [digits(value, DIGITS), in_mesh(value, property.power())],
        };
        rows.push(row(property.name(), property.symbol(), cells));
    }
    let deviation = of.median_absolute_deviation;
    let cells = [digits(deviation, DIGITS), in_mesh(deviation, 1)];
    rows.push(row("median absolute deviation of the edges", "", cells));
    rows.push(row("from mesh units to the paper's size", "s", [digits(of.scale, DIGITS), String::new()]));
    Table {
        title: model.to_owned(),
        head: ["property", "", "at the paper's size", "in mesh units"].map(str::to_owned).into(),
        rows,
        ..Table::default()
    }
}

fn is_count(property: Property) -> bool {
    matches!(property, Property::Vertices | Property::Edges | Property::Faces | Property::Source)
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
    let shares = found.t / properties.mean_edge_squared();
    let mark = if found.at_end { "*" } else { "" };
    vec![
        study.model.as_str().into(),
        name(&LAPLACIANS, laplacian).into(),
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
    let rows = of
        .properties
        .iter()
        .map(|(property, r)| [vec![property.name().into(), property.symbol().into()], correlation_cells(r)].concat());
    Table {
        title: format!(
            "r with the best t for the {} error, {} Laplacian, {} models",
            of.measure.name(),
            name(&LAPLACIANS, of.laplacian),
            of.models
        ),
        head: ["property", "", "r", "95 %"].map(str::to_owned).into(),
        rows: rows.collect(),
        ..Table::default()
    }
}

fn correlation_cells(of: &Result<Correlation, Undefined>) -> Vec<Cell> {
    match of {
        Ok(of) => {
            let interval = of.interval.map(|[low, high]| format!("{} … {}", fixed(low, 3), fixed(high, 3)));
            vec![fixed(of.r, 4).into(), interval.unwrap_or("–".to_owned()).into()]
        }
        Err(reason) => vec![reason.to_string().into()],
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
            let first = [name(&LAPLACIANS, of.laplacian), of.measure.name(), line].map(Cell::from);
            [first.to_vec(), fit_cells(fit)].concat()
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
        Err(reason) => vec![reason.to_string().into()],
    }
}

/// What each formula gains over Eq. 1 on each model: a table for each Laplacian and each error.
#[must_use]
pub fn gains(studies: &[Study]) -> Vec<Table> {
    let head = ["model", "formula", "units", "t", "t/ē²", "error %", "gain", "over vertices", "over sources"];
    let mut tables = Vec::new();
    for (laplacian, measure) in each(studies) {
        let gains = |study: &Study| study.with(laplacian).map_or(Vec::new(), |of| of.formulas.clone());
        let rows = studies
            .iter()
            .flat_map(|study| gains(study).into_iter().map(|gain| gain_row(study, measure, &gain)).collect::<Vec<_>>());
        tables.push(Table {
            title: format!("{} error, {} Laplacian", capitalised(measure.name()), name(&LAPLACIANS, laplacian)),
            note: String::new(),
            head: head.map(str::to_owned).into(),
            rows: rows.collect(),
            ..Table::default()
        });
    }
    if let [first, ..] = &mut tables[..] {
        "Gain: 1 - (error with the formula) / (error with Eq. 1); its 95 % intervals by the bootstrap, over\n\
         vertices and over sources, and what they say: + better, − worse, ? unsure"
            .clone_into(&mut first.note);
    }
    tables
}

fn gain_row(study: &Study, measure: Measure, gain: &FormulaGain) -> Vec<Cell> {
    let head = [study.model.as_str(), equation(gain.formula), name(&SCALES, gain.scale)].map(Cell::from);
    let tail = match &gain.outcome {
        Ok(outcome) => outcome_cells(study, measure, gain.formula, outcome),
        Err(reason) => vec![reason.as_str().into()],
    };
    [head.to_vec(), tail].concat()
}

fn outcome_cells(study: &Study, measure: Measure, formula: TimeFormula, outcome: &Outcome) -> Vec<Cell> {
    let shares = outcome.t / study.properties.mean_edge_squared();
    let error = match measure {
        Measure::Mean => outcome.mean,
        Measure::Median => outcome.median,
    };
    let first = [significant(outcome.t), significant(shares), fixed(error, 3)].map(Cell::from).to_vec();
    let gains = match formula {
        TimeFormula::MeanEdge => vec![Cell::default(); 3], // which the others are compared to
        _ => {
            let over = [Some(&outcome.over_vertices), outcome.over_sources.as_ref()];
            let intervals = over.map(|ratios| interval_cell(ratios, measure));
            [vec![gain(outcome.over_vertices.of(measure).ratio).into()], intervals.to_vec()].concat()
        }
    };
    [first, gains].concat()
}

fn interval_cell(ratios: Option<&Ratios>, measure: Measure) -> Cell {
    let Some(ratios) = ratios else { return Cell::default() };
    let of @ Interval { low, high, .. } = ratios.of(measure);
    let sign = match of.verdict() {
        Verdict::Better => "+",
        Verdict::Worse => "−",
        Verdict::Unsure => "?",
    };
    format!("{} … {} {sign}", gain(high), gain(low)).into()
}

fn capitalised(word: &str) -> String {
    let mut letters = word.chars();
    letters.next().map(|first| first.to_uppercase().chain(letters).collect()).unwrap_or_default()
}

/// The basic set: a row for each property with its values from 1.obj to 5.obj, beside the paper's if it is the paper's.
#[must_use]
pub fn basic_set(set: &[ModelProperties], is_papers: bool) -> Vec<Table> {
    let shown = |of: &ModelProperties, property| match is_papers {
        true => fixed(of.value(property), BASIC[0].printed(property).decimals()),
        false if is_count(property) => fixed(of.value(property), 0),
        false => digits(of.value(property), DIGITS),
    };
    let row = |&property: &Property| -> Vec<Cell> {
        let ours = set.iter().map(|of| shown(of, property));
        let paper = BASIC.iter().filter(|_| is_papers).map(|mesh| mesh.printed(property).to_string());
        [property.symbol().to_owned()].into_iter().chain(ours).chain(paper).map(Cell::from).collect()
    };
    let table = |(number, properties): (usize, &&[Property])| {
        let names = || BASIC.iter().map(|mesh| mesh.name);
        let groups = [("", 1), ("ours", 5), ("paper", 5)].map(|(name, count)| (name.to_owned(), count));
        let paper = names().filter(|_| is_papers);
        Table {
            title: format!("Table {number}"),
            note: String::new(),
            groups: if is_papers { groups.into() } else { Vec::new() },
            head: [""].into_iter().chain(names()).chain(paper).map(str::to_owned).collect(),
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
            let first = [name(&LAPLACIANS, laplacian), equation(formula), measure.name()].map(Cell::from);
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
