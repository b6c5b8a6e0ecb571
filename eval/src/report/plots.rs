//! The plots: from studies to pictures.

use super::chart::{Axis, Mark, Panel, Shape, shortened, svg};
use super::colours::{self, INK, ORDERED, SOFT, TREND};
use super::content::{CorrelationTable, FitFigure, Trend};
use super::numbers::{fixed, gain, significant};
use super::pick;
use crate::fit::Fit;
use crate::gain::Interval;
use crate::gain::Over;
use crate::names::{LAPLACIANS, equation};
use crate::paper;
use crate::study::Study;
use crate::sweep::{Measure, Point, Sweep};
use plotters::style::RGBColor;
use plotters::style::text_anchor::HPos;
use taut::{Laplacian, TimeFormula, TimeScale};

/// Of plots with a row for each model, in pixels.
const WIDTH: i32 = 960;
const NAMES: i32 = 190;
const SYMBOLS: i32 = 100;
const ROW: i32 = 22;

/// Gains below this are drawn at the edge, with their number.
const LEAST_GAIN: f64 = -100.0;

/// No error at all.
const MOST_GAIN: f64 = 100.0;

fn point(at: [f64; 2], shape: Shape, colour: RGBColor) -> Mark {
    Mark::Point { at, shape, colour }
}

fn line(points: Vec<[f64; 2]>, colour: RGBColor, width: f64) -> Mark {
    Mark::Line { points, colour, width }
}

pub(super) fn laplacian_name(laplacian: Laplacian) -> &'static str {
    match laplacian {
        Laplacian::Plain => "plain cotangents",
        Laplacian::Intrinsic => "intrinsic Delaunay",
    }
}

/// Figure 5: a property along the basic set, with the line through ours.
pub(super) fn trend(trend: &Trend) -> String {
    let numbered = |values: &[f64]| -> Vec<[f64; 2]> { (1..).zip(values).map(|(n, &y)| [f64::from(n), y]).collect() };
    let [paper, ours] = [numbered(&trend.paper), numbered(&trend.ours)];
    let all = || [&paper[..], &ours].concat().into_iter();
    let x = Axis::linear("mesh of the basic set", all().map(|[x, _]| x), 5);
    let through = along(x.range(), coefficients(&trend.line));
    let y = Axis::linear("", all().chain(through.clone()).map(|[_, y]| y), 5);
    let mut marks = vec![Mark::Dashed { points: through, colour: TREND }];
    marks.extend(paper.iter().map(|&at| point(at, Shape::Ring, SOFT)));
    marks.extend(ours.iter().map(|&at| point(at, Shape::Dot, INK)));
    let (name, symbol) = (trend.property.name(), trend.property.symbol());
    let head = format!("{name} {symbol}, R² = {}", fixed(trend.line.r_squared, 4));
    let title = format!("{name} of each mesh of the basic set, with the regression line");
    svg(&title, [462, 316], &[Panel { head, left: 58, top: 30, width: 390, height: 240, x, y, marks }])
}

/// The ends of a line.
fn coefficients(line: &Fit) -> [f64; 2] {
    [line.slope.value, line.intercept.value]
}

fn along(ends: [f64; 2], [slope, constant]: [f64; 2]) -> Vec<[f64; 2]> {
    ends.map(|x| [x, slope * x + constant]).to_vec()
}

/// Figure 9: the mean error over t for each mesh of the basic set.
pub(super) fn curves(basic: &[Study], laplacian: Laplacian) -> String {
    let sweeps: Vec<&Sweep> = basic.iter().filter_map(|study| Some(&study.with(laplacian)?.sweep)).collect();
    let points = || sweeps.iter().flat_map(|sweep| &sweep.points);
    let x = Axis::logarithmic("t", points().map(|point| point.t), 6);
    let y = Axis::logarithmic("", points().map(|point| point.mean), 5);
    let mut marks = Vec::new();
    for (sweep, colour) in sweeps.iter().zip(ORDERED.into_iter().cycle()) {
        marks.push(line(sweep.points.iter().map(|point| [point.t, point.mean]).collect(), colour, 1.5));
    }
    for (sweep, colour) in sweeps.iter().zip(ORDERED.into_iter().cycle()) {
        marks.push(point([sweep.mean.t, sweep.mean.error], Shape::Dot, colour));
    }
    let name = laplacian_name(laplacian);
    let head = format!("mean error in %, {name}");
    let title = format!("mean error over t for each mesh of the basic set, {name}");
    svg(&title, [462, 376], &[Panel { head, left: 54, top: 30, width: 384, height: 300, x, y, marks }])
}

/// Figure 9 for one model, small: the mean error over t / ē², with both Laplacians, between the same ends for all.
pub(super) fn small_curves(study: &Study) -> String {
    let unit = study.properties.mean_edge_squared();
    let x = Axis::logarithmic("", [0.01, 1000.0], 5);
    let [least, most] = x.range();
    let inside = |point: &&Point| (least..=most).contains(&(point.t / unit));
    let points = || study.laplacians.iter().flat_map(|of| of.sweep.points.iter().filter(inside));
    let y = Axis::logarithmic("", points().map(|point| point.mean), 3);
    let mut marks = vec![line(y.range().map(|y| [1.0, y]).to_vec(), SOFT, 1.0)];
    for of in &study.laplacians {
        let colour = colours::of_laplacian(of.laplacian);
        let curve = of.sweep.points.iter().filter(inside).map(|point| [point.t / unit, point.mean]).collect();
        marks.push(line(curve, colour, 1.5));
        marks.push(point([of.sweep.mean.t / unit, of.sweep.mean.error], Shape::Dot, colour));
    }
    let title = format!("mean error over t / ē² on {}", study.model);
    let panel = Panel { head: shortened(&study.model, 21), left: 42, top: 22, width: 178, height: 110, x, y, marks };
    svg(&title, [228, 154], &[panel])
}

/// Panels side by side with a row for each name.
struct Rows<'a> {
    title: String,
    names: Vec<&'a str>,
    /// How wide the names are.
    left: i32,
    panels: Vec<(String, Axis, Vec<Mark>)>,
}

impl Rows<'_> {
    fn svg(self) -> String {
        let height = ROW * self.names.len().max(1) as i32;
        let width = (WIDTH - self.left) / self.panels.len().max(1) as i32;
        let rows = Axis::rows(self.names.iter().copied());
        let panels = self.panels.into_iter().enumerate().map(|(i, (head, x, marks))| {
            let y = if i == 0 { rows.clone() } else { rows.clone().unnamed() };
            Panel { head, left: self.left + i as i32 * width, top: 42, width: width - 20, height, x, y, marks }
        });
        svg(&self.title, [WIDTH, height + 90], &panels.collect::<Vec<_>>())
    }
}

/// The laplacians that some study has.
pub(super) fn laplacians(studies: &[Study]) -> Vec<Laplacian> {
    let is_there = |laplacian: &Laplacian| studies.iter().any(|study| study.with(*laplacian).is_some());
    LAPLACIANS.into_iter().map(|(_, laplacian)| laplacian).filter(is_there).collect()
}

/// Studies with the greatest value first, those without one last.
fn sorted(models: &[Study], value: impl Fn(&Study) -> Option<f64>) -> Vec<&Study> {
    let mut keyed: Vec<(f64, &Study)> = models
        .iter()
        .map(|study| (value(study).filter(|value| !value.is_nan()).unwrap_or(f64::NEG_INFINITY), study))
        .collect();
    keyed.sort_by(|a, b| b.0.total_cmp(&a.0));
    keyed.into_iter().map(|(_, study)| study).collect()
}

/// Figures 10, 12, 13 and 15: the gain of a formula over Eq. 1 for each model, with its confidence intervals; sorted by the
/// gain with the first Laplacian.
pub(super) fn gains(models: &[Study], formula: TimeFormula, measure: Measure) -> String {
    let laplacians = laplacians(models);
    let first = |study: &Study| pick::paper_ratio(study, *laplacians.first()?, formula, measure, Over::Vertices);
    let models = sorted(models, |study| first(study).map(|interval| -interval.ratio));
    let interval = |study, laplacian, over| pick::paper_ratio(study, laplacian, formula, measure, over);
    let shown = |laplacian: Laplacian| {
        let marks = models.iter().enumerate().flat_map(move |(row, study)| {
            let row = -(row as f64);
            let vertices = interval(study, laplacian, Over::Vertices).map(|of| whisker(&of, row + 0.2, true));
            let sources = interval(study, laplacian, Over::Sources).map(|of| whisker(&of, row - 0.22, false));
            vertices.into_iter().chain(sources).flatten()
        });
        let zero = vec![[0.0, 0.5], [0.0, 0.5 - models.len() as f64]];
        std::iter::once(line(zero, SOFT, 1.5)).chain(marks).collect()
    };
    let panels = laplacians.iter().map(|&laplacian| {
        let x = Axis::linear("gain over Eq. 1, %", [LEAST_GAIN, MOST_GAIN], 5);
        (laplacian_name(laplacian).to_owned(), x, shown(laplacian))
    });
    Rows {
        title: format!("gain of {} in the {} error over Eq. 1 for each model", equation(formula), measure.name()),
        names: models.iter().map(|study| study.model.as_str()).collect(),
        left: NAMES,
        panels: panels.collect(),
    }
    .svg()
}

/// An interval of ratios as gains, coloured by what it says.
fn whisker(interval: &Interval, row: f64, is_first: bool) -> Vec<Mark> {
    let colour = colours::of_verdict(interval.verdict());
    let percent = |ratio: f64| (100.0 * (1.0 - ratio)).clamp(LEAST_GAIN, MOST_GAIN);
    let (width, shape) = if is_first { (2.5, Shape::Dot) } else { (1.25, Shape::Ring) };
    let mut marks = vec![line(vec![[percent(interval.high), row], [percent(interval.low), row]], colour, width)];
    if percent(interval.ratio) > LEAST_GAIN || interval.ratio.is_nan() {
        marks.push(point([percent(interval.ratio), row], shape, colour));
        return marks;
    }
    marks.push(point([LEAST_GAIN, row], Shape::Left, colour));
    if is_first {
        let text = format!("\u{a0}\u{a0}{}", gain(interval.ratio));
        marks.push(Mark::Label { at: [percent(interval.low), row - 0.2], text, side: HPos::Left, colour });
    }
    marks
}

/// Figures 11 and 14: the best, the original and the proposed t for each model, and how far t may go.
pub(super) fn steps(models: &[Study], measure: Measure) -> String {
    let laplacians = laplacians(models);
    let models = sorted(models, |study| Some(study.properties.mean_edge_squared()));
    let mut all = Vec::new();
    let mut marks = |laplacian| -> Vec<Mark> {
        let rows = models.iter().enumerate();
        rows.flat_map(|(row, study)| step_marks(study, laplacian, measure, -(row as f64), &mut all)).collect()
    };
    let marks: Vec<_> = laplacians.iter().map(|&laplacian| (laplacian, marks(laplacian))).collect();
    let x = Axis::logarithmic("t", all, 6);
    let panels = marks.into_iter().map(|(laplacian, marks)| (laplacian_name(laplacian).to_owned(), x.clone(), marks));
    Rows {
        title: format!("best t for the {} error, original t and proposed t for each model", measure.name()),
        names: models.iter().map(|study| study.model.as_str()).collect(),
        left: NAMES,
        panels: panels.collect(),
    }
    .svg()
}

/// One row of these; its values of t go to `all`.
fn step_marks(study: &Study, laplacian: Laplacian, measure: Measure, row: f64, all: &mut Vec<f64>) -> Vec<Mark> {
    let Some(best) = study.with(laplacian).map(|of| of.sweep.best(measure)) else { return Vec::new() };
    let mut marks = Vec::new();
    if let Some(most) = best.maximum_t {
        all.push(most);
        marks.push(line(vec![[best.t, row], [most, row]], SOFT, 1.0));
        marks.push(point([most, row], Shape::Tick, SOFT));
    }
    for formula in shown_formulas(measure) {
        if let Some(outcome) = study.outcome(laplacian, formula, TimeScale::Paper) {
            all.push(outcome.t);
            marks.push(point([outcome.t, row], Shape::Dot, colours::of_formula(formula)));
        }
    }
    all.push(best.t);
    marks.push(point([best.t, row], Shape::Diamond, INK));
    marks
}

/// The original formula and the two that are made for an error.
pub(super) fn shown_formulas(measure: Measure) -> [TimeFormula; 3] {
    match measure {
        Measure::Mean => [TimeFormula::MeanEdge, TimeFormula::Sigma, TimeFormula::MeanSigma],
        Measure::Median => [TimeFormula::MeanEdge, TimeFormula::MedianFit, TimeFormula::MedianMean],
    }
}

/// Tables 7 and 9: Pearson's coefficient for each property, the paper's and ours.
pub(super) fn correlations(measure: Measure, correlations: &[CorrelationTable]) -> String {
    let of_measure: Vec<&CorrelationTable> = correlations.iter().filter(|of| of.measure == measure).collect();
    let first = of_measure.first().map_or(&[][..], |of| &of.rows);
    let panels = of_measure.iter().map(|of| {
        let colour = colours::of_laplacian(of.laplacian);
        let mut marks = vec![line(vec![[0.0, 0.5], [0.0, 0.5 - first.len() as f64]], SOFT, 1.5)];
        for (row, of) in of.rows.iter().enumerate() {
            let row = -(row as f64);
            if let Some([low, high]) = of.interval {
                marks.push(line(vec![[low, row], [high, row]], colour, 2.5));
            }
            match of.ours {
                Some(ours) => marks.push(point([ours, row], Shape::Dot, colour)),
                None => {
                    let text = "does not vary".to_owned();
                    marks.push(Mark::Label { at: [0.0, row], text, side: HPos::Left, colour: SOFT });
                }
            }
            marks.extend(of.paper.map(|paper| point([paper, row], Shape::Ring, INK)));
        }
        (laplacian_name(of.laplacian).to_owned(), Axis::linear("Pearson's coefficient", [-1.0, 1.0], 5), marks)
    });
    Rows {
        title: format!("correlation of the best t for the {} error with each property", measure.name()),
        names: first.iter().map(|row| row.property.symbol()).collect(),
        left: SYMBOLS,
        panels: panels.collect(),
    }
    .svg()
}

/// The best t over σ, with the line through ours and Eq. 4.
pub(super) fn fit(fit: &FitFigure) -> String {
    let all = || [&fit.ours[..], &fit.paper].concat().into_iter();
    let x = Axis::linear("σ of the edges", all().map(|[x, _]| x).chain([0.0]), 5);
    let [proposed, ours] = [paper::EQUATION_4.map(paper::Printed::value), coefficients(&fit.line)]
        .map(|line| along([0.0, x.range()[1]], line));
    let y = Axis::linear("", all().chain(proposed.clone()).chain(ours.clone()).map(|[_, y]| y), 5);
    let colour = colours::of_laplacian(fit.laplacian);
    let mut marks =
        vec![line(proposed, colours::of_formula(TimeFormula::MedianFit), 1.5), Mark::Dashed { points: ours, colour }];
    marks.extend(fit.paper.iter().map(|&at| point(at, Shape::Ring, SOFT)));
    marks.extend(fit.ours.iter().map(|&at| point(at, Shape::Dot, colour)));
    let [slope, constant] = coefficients(&fit.line);
    let sign = if constant < 0.0 { '−' } else { '+' };
    let equation = format!("t = {} σ {sign} {}", significant(slope), significant(constant.abs()));
    let name = laplacian_name(fit.laplacian);
    let head = format!("{name}: {equation}, R² = {}", fixed(fit.line.r_squared, 3));
    let title = format!("best t for the {} error over the standard deviation, {name}", fit.measure.name());
    svg(&title, [462, 336], &[Panel { head, left: 58, top: 30, width: 390, height: 260, x, y, marks }])
}

/// What a formula gives at the paper's size and in the units of the file: t / ē², and its error over that of Eq. 1.
pub(super) fn units(models: &[Study], formula: TimeFormula, laplacian: Laplacian) -> String {
    let t =
        |study: &Study, scale| Some(study.outcome(laplacian, formula, scale)?.t / study.properties.mean_edge_squared());
    let error = |study: &Study, scale| {
        let outcome = study.outcome(laplacian, formula, scale)?;
        outcome.ratio(Measure::Mean, Over::Vertices).map(|interval| interval.ratio)
    };
    let models = sorted(models, |study| t(study, TimeScale::Raw));
    let panel = |name: &str, value: &dyn Fn(&Study, TimeScale) -> Option<f64>| {
        let mut marks = vec![line(vec![[1.0, 0.5], [1.0, 0.5 - models.len() as f64]], SOFT, 1.5)];
        let mut all = vec![1.0];
        for (row, study) in models.iter().enumerate() {
            let row = -(row as f64);
            let [paper, raw] = [TimeScale::Paper, TimeScale::Raw].map(|scale| value(study, scale));
            all.extend(paper.into_iter().chain(raw));
            marks.extend(paper.zip(raw).map(|(paper, raw)| line(vec![[paper, row], [raw, row]], SOFT, 0.75)));
            marks.extend(raw.map(|value| point([value, row], Shape::Ring, colours::of_formula(formula))));
            marks.extend(paper.map(|value| point([value, row], Shape::Dot, colours::of_formula(formula))));
        }
        (name.to_owned(), Axis::logarithmic(name, all, 6), marks)
    };
    Rows {
        title: format!("t / ē² and error of {} at the paper's size and in the units of the file", equation(formula)),
        names: models.iter().map(|study| study.model.as_str()).collect(),
        left: NAMES,
        panels: vec![panel("t / ē²", &t), panel("mean error over that of Eq. 1", &error)],
    }
    .svg()
}
