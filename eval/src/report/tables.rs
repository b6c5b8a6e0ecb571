//! The numbers of all studies as CSV: a row for each model, or for each number of it.
//!
//! t is at the paper's size, errors are in percent. Numbers have all their digits; what is not there is empty.

use crate::gain::{FormulaGain, Interval, Outcome, Verdict};
use crate::names::{FORMULAS, LAPLACIANS, SCALES, name};
use crate::properties::{ModelProperties, Property};
use crate::study::{LaplacianStudy, Study};
use crate::sweep::{Best, Measure};
use crate::tables::{Correlated, Fitted};
use std::io::{self, Write};

/// The columns of the 18 properties, in the order of [`Property::ALL`].
const PROPERTIES: [&str; 18] = [
    "vertices",
    "edges",
    "faces",
    "source",
    "anisotropy",
    "mean_edge",
    "variance",
    "sigma",
    "mean_absolute_deviation",
    "min_edge",
    "max_edge",
    "edge_ratio",
    "min_angle",
    "max_angle",
    "q1",
    "q2",
    "q3",
    "quartile_deviation",
];

/// A row for each model: its 18 properties, the true median absolute deviation and the scale to the paper's size.
///
/// # Errors
/// Those of `out`.
pub fn write_properties<'a>(
    models: impl IntoIterator<Item = (&'a str, &'a ModelProperties)>,
    out: impl Write,
) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let more = ["median_absolute_deviation", "scale"];
    table.write_record(["model"].into_iter().chain(PROPERTIES).chain(more))?;
    for (model, p) in models {
        let values = Property::ALL.map(|property| number(p.value(property)));
        let more = [p.median_absolute_deviation, p.scale].map(number);
        table.write_record([model.to_owned()].into_iter().chain(values).chain(more))?;
    }
    table.flush()
}

/// A row for each t that a sweep tried.
///
/// # Errors
/// Those of `out`.
pub fn write_sweeps(studies: &[Study], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(["model", "laplacian", "t", "mean_error_percent", "median_error_percent"])?;
    for (study, of) in each(studies) {
        for point in &of.sweep.points {
            let [t, mean, median] = [point.t, point.mean, point.median].map(number);
            table.write_record([&study.model, name(&LAPLACIANS, of.laplacian), &t, &mean, &median])?;
        }
    }
    table.flush()
}

/// A row for each best t: of the sweep and of the search, for the mean and for the median error.
///
/// # Errors
/// Those of `out`.
pub fn write_best(studies: &[Study], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let head = ["model", "laplacian", "measure", "method", "t", "t_over_mean_edge_squared", "error_percent"];
    table.write_record(head.into_iter().chain(["at_end", "maximum_t", "probes"]))?;
    for (study, of) in each(studies) {
        for (measure, found) in Measure::ALL.into_iter().zip(of.search) {
            for (method, best) in [("sweep", of.sweep.best(measure)), ("search", found)] {
                let first = [&study.model, name(&LAPLACIANS, of.laplacian), measure.name(), method];
                table.write_record(first.into_iter().map(str::to_owned).chain(best_cells(study, best)))?;
            }
        }
    }
    table.flush()
}

fn best_cells(study: &Study, best: Best) -> [String; 6] {
    [
        number(best.t),
        number(best.t / study.properties.mean_edge_squared()),
        number(best.error),
        best.at_end.to_string(),
        best.maximum_t.map_or(String::new(), number),
        best.probes.to_string(),
    ]
}

/// A row for each property of each correlation: r with its 95 % confidence interval, or why there is none.
///
/// # Errors
/// Those of `out`.
pub fn write_correlations(correlations: &[Correlated], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(["laplacian", "measure", "models", "property", "r", "low", "high", "undefined"])?;
    for of in correlations {
        for (property, r) in &of.properties {
            let first = [name(&LAPLACIANS, of.laplacian), of.measure.name(), &of.models.to_string()].map(str::to_owned);
            let column = Property::ALL.iter().position(|other| other == property).map_or("", |k| PROPERTIES[k]);
            let numbers = match r {
                Ok(r) => {
                    let [low, high] = r.interval.unwrap_or([f64::NAN; 2]);
                    [number(r.r), number(low), number(high), String::new()]
                }
                Err(reason) => [String::new(), String::new(), String::new(), reason.to_string()],
            };
            table.write_record(first.into_iter().chain([column.to_owned()]).chain(numbers))?;
        }
    }
    table.flush()
}

/// A row for each line: slope and constant with their 95 % confidence intervals and R², or why there is none.
///
/// # Errors
/// Those of `out`.
pub fn write_fits(fits: &[Fitted], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let head = ["laplacian", "measure", "models", "line", "slope", "slope_low", "slope_high"];
    table.write_record(head.into_iter().chain([
        "constant",
        "constant_low",
        "constant_high",
        "r_squared",
        "undefined",
    ]))?;
    for of in fits {
        for (line, fit) in [("t over sigma", of.over_sigma), ("t/mean^2 over sigma/mean", of.invariant)] {
            let first =
                [name(&LAPLACIANS, of.laplacian), of.measure.name(), &of.models.to_string(), line].map(str::to_owned);
            let mut cells = match fit {
                Ok(fit) => [fit.slope, fit.intercept]
                    .iter()
                    .flat_map(|of| [of.value, of.interval[0], of.interval[1]])
                    .chain([fit.r_squared])
                    .map(number)
                    .collect(),
                Err(_) => vec![String::new(); 7],
            };
            cells.push(fit.err().map_or(String::new(), |reason| reason.to_string()));
            table.write_record(first.into_iter().chain(cells))?;
        }
    }
    table.flush()
}

/// A row for each formula in each unit: its t, its errors, their ratios to those of Eq. 1 with 95 % confidence intervals over
/// the vertices and over sources, and what these say; or why the formula is refused.
///
/// # Errors
/// Those of `out`.
pub fn write_gains(studies: &[Study], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let head = ["model", "laplacian", "formula", "scale", "refused", "t", "t_over_mean_edge_squared"];
    let head = head.into_iter().chain(["mean_error_percent", "median_error_percent"]).map(str::to_owned);
    let ratios = ["vertices", "sources"].into_iter().flat_map(|over| {
        ["mean", "median"].into_iter().flat_map(move |measure| {
            ["ratio", "low", "high", "verdict"].map(|what| format!("{measure}_{what}_over_{over}"))
        })
    });
    table.write_record(head.chain(ratios))?;
    for (study, of) in each(studies) {
        for gain in &of.formulas {
            let first = [&study.model, name(&LAPLACIANS, of.laplacian)].map(str::to_owned);
            table.write_record(first.into_iter().chain(gain_cells(study, gain)))?;
        }
    }
    table.flush()
}

fn gain_cells(study: &Study, gain: &FormulaGain) -> Vec<String> {
    let (refused, outcome) = match &gain.outcome {
        Ok(outcome) => ("", Some(outcome)),
        Err(why) => (why.as_str(), None),
    };
    let first = [name(&FORMULAS, gain.formula), name(&SCALES, gain.scale), refused].map(str::to_owned);
    let numbers = outcome.map_or_else(|| vec![String::new(); 20], |outcome| outcome_cells(study, outcome));
    [first.to_vec(), numbers].concat()
}

fn outcome_cells(study: &Study, outcome: &Outcome) -> Vec<String> {
    let Outcome { t, mean, median, over_vertices, over_sources } = *outcome;
    let ratios = [Some(over_vertices), over_sources];
    let intervals = ratios.map(|ratios| [ratios.map(|of| of.mean), ratios.map(|of| of.median)]).concat();
    let numbers = [t, t / study.properties.mean_edge_squared(), mean, median].map(number);
    numbers.into_iter().chain(intervals.into_iter().flat_map(interval_cells)).collect()
}

fn interval_cells(interval: Option<Interval>) -> [String; 4] {
    let Some(interval) = interval else { return Default::default() };
    let verdict = match interval.verdict() {
        Verdict::Better => "better",
        Verdict::Worse => "worse",
        Verdict::Unsure => "unsure",
    };
    [number(interval.ratio), number(interval.low), number(interval.high), verdict.to_owned()]
}

fn each(studies: &[Study]) -> impl Iterator<Item = (&Study, &LaplacianStudy)> {
    studies.iter().flat_map(|study| study.laplacians.iter().map(move |of| (study, of)))
}

/// Empty where there is none.
fn number(value: f64) -> String {
    if value.is_nan() { String::new() } else { value.to_string() }
}
