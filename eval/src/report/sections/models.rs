//! A row for each model.

use super::nothing;
use crate::gain::Over;
use crate::gain::{Interval, Verdict};
use crate::paper::{Figure, HEADLINES};
use crate::report::content::{Cell, Content, Table, Tone};
use crate::report::numbers::{gain, significant};
use crate::report::page::table;
use crate::report::pick;
use crate::report::plots::{self, laplacian_name};
use crate::study::Study;
use maud::Markup;
use taut::{Laplacian, TimeFormula, TimeScale};

pub(in crate::report) fn models(content: &Content) -> Markup {
    if content.models.is_empty() {
        return nothing("No model was studied.");
    }
    let laplacians = plots::laplacians(content.models);
    let row = |study: &Study| {
        let p = &study.properties;
        let counts = [p.vertices, p.faces].map(|count| Cell::from(count.to_string()));
        let shape = [p.anisotropy.unwrap_or(f64::NAN), p.mean_edge, p.sigma, p.sigma / p.mean_edge, p.max_angle];
        let shape = shape.map(|value| Cell::from(significant(value)));
        let found = laplacians.iter().flat_map(|&laplacian| model_cells(study, laplacian));
        let seconds = Cell::from(significant(study.seconds));
        [Cell::from(study.model.as_str())]
            .into_iter()
            .chain(counts)
            .chain(shape)
            .chain(found)
            .chain([seconds])
            .collect()
    };
    let groups = laplacians.iter().map(|&laplacian| (laplacian_name(laplacian).to_owned(), 8));
    let head = laplacians
        .iter()
        .flat_map(|_| ["best t", "t / ē²", "least, %", "Eq. 1, %", "Eq. 2", "Eq. 3", "Eq. 4", "Eq. 5"]);
    let of_all = Table {
        title: String::new(),
        note: "For each Laplacian: the best t for the mean error and the error there, the mean error at Eq. 1, and the gains of \
               Eq. 2 and 3 in the mean and of Eq. 4 and 5 in the median error; coloured where 95 % confidence over the vertices \
               says better or worse. At the end the seconds that one thread worked on it."
            .to_owned(),
        groups: [(String::new(), 8)].into_iter().chain(groups).chain([(String::new(), 1)]).collect(),
        head: ["model", "vertices", "triangles", "g", "ē", "σ", "σ / ē", "max angle"].into_iter().chain(head).chain(["seconds"]).map(str::to_owned).collect(),
        rows: content.models.iter().map(row).collect(),
    };
    table(&of_all)
}

fn model_cells(study: &Study, laplacian: Laplacian) -> Vec<Cell> {
    let best = study.with(laplacian).map(|of| of.sweep.mean);
    let original = study.outcome(laplacian, TimeFormula::MeanEdge, TimeScale::Paper).map(|outcome| outcome.mean);
    let unit = study.properties.mean_edge_squared();
    let found = [best.map(|best| best.t), best.map(|best| best.t / unit), best.map(|best| best.error), original];
    let found = found.map(|value| Cell::from(significant(value.unwrap_or(f64::NAN))));
    let gains = HEADLINES.map(|Figure { formula, measure, .. }| {
        let interval = pick::paper_ratio(study, laplacian, formula, measure, Over::Vertices);
        interval.map_or(Cell::new("–", Tone::Pale), |interval| gain_cell(&interval))
    });
    found.into_iter().chain(gains).collect()
}

fn gain_cell(interval: &Interval) -> Cell {
    let tone = match interval.verdict() {
        Verdict::Better => Tone::Good,
        Verdict::Worse => Tone::Bad,
        Verdict::Unsure => Tone::Pale,
    };
    Cell::new(gain(interval.ratio), tone)
}
