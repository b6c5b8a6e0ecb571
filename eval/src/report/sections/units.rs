//! What the formulas give at the paper's size and in the units of a file.

use super::nothing;
use crate::gain::Over;
use crate::names::{SCALES, equation};
use crate::report::colours;
use crate::report::content::{Cell, Content, Table, Tone};
use crate::report::numbers::significant;
use crate::report::page::{Key, figure, legend, table};
use crate::report::plots;
use crate::study::Study;
use crate::sweep::Measure;
use maud::{Markup, html};
use taut::{Laplacian, TimeFormula, TimeScale};

pub(in crate::report) fn units(content: &Content) -> Markup {
    let laplacians = plots::laplacians(content.models);
    let Some(&laplacian) = laplacians.last() else { return nothing("No model was studied.") };
    let colour = colours::of_formula(TimeFormula::Sigma);
    let keys = [(Key::Dot, colour, "Eq. 2 at the paper's size"), (Key::Ring, colour, "Eq. 2 in the units of the file")];
    let caption = "Left: t in units of ē²; right: its mean error over that of Eq. 1; the grey line is Eq. 1. Models are in the \
                   order of t in the units of their file. Computed with intrinsic Delaunay where it is there.";
    html! {
        p {
            "Eq. 1 is a squared length, as t must be. Eq. 2 to 5 set t to a length: the same model in millimetres or in metres "
            "gets another t. They mean what the paper says only at its size. Here each is evaluated at the paper's size and on "
            "the numbers as they stand in the file."
        }
        (figure("Units.", caption, legend(&keys), &[plots::units(content.models, TimeFormula::Sigma, laplacian)]))
        (table(&units_table(content.models, laplacian)))
    }
}

fn units_table(models: &[Study], laplacian: Laplacian) -> Table {
    let formulas = [TimeFormula::Sigma, TimeFormula::MeanSigma, TimeFormula::MedianFit, TimeFormula::MedianMean];
    let cells = |study: &Study, formula, scale| match study.outcome(laplacian, formula, scale) {
        None => [Cell::new("refused", Tone::Pale), Cell::new("–", Tone::Pale)],
        Some(outcome) => {
            let mean = outcome.ratio(Measure::Mean, Over::Vertices).map_or(f64::NAN, |interval| interval.ratio);
            let tone = if scale == TimeScale::Raw { Tone::Plain } else { Tone::Pale };
            [outcome.t / study.properties.mean_edge_squared(), mean].map(|value| Cell::new(significant(value), tone))
        }
    };
    let row = |study: &Study| {
        let cells = formulas
            .iter()
            .flat_map(|&formula| SCALES.iter().flat_map(move |&(_, scale)| cells(study, formula, scale)));
        let first: [Cell; 2] = [study.model.as_str().into(), significant(study.properties.scale).into()];
        first.into_iter().chain(cells).collect()
    };
    let groups = formulas
        .iter()
        .flat_map(|&formula| ["paper's size", "raw"].map(|name| (format!("{}, {name}", equation(formula)), 2)));
    let head = std::iter::repeat_n(["t / ē²", "ratio"], 8).flatten();
    Table {
        title: "Every formula in both units".to_owned(),
        note: "t / ē² and the ratio of the mean error to that of Eq. 1. The scale takes the units of the file to the paper's \
               size. A formula is refused where it gives no positive t."
            .to_owned(),
        groups: [(String::new(), 2)].into_iter().chain(groups).collect(),
        head: ["model", "scale"].into_iter().chain(head).map(str::to_owned).collect(),
        rows: models.iter().map(row).collect(),
    }
}
