//! The gains of the formulas over Eq. 1, and where the best t is.

use super::nothing;
use crate::gain::Over;
use crate::gain::{Counts, Verdict};
use crate::names::equation;
use crate::paper::{FIGURE_11, Figure, HEADLINES, Places};
use crate::report::colours::{self, INK, SOFT};
use crate::report::content::{Cell, Content, Table, Tone};
use crate::report::page::{Key, figure, legend, table};
use crate::report::pick;
use crate::report::plots::{self, laplacian_name, shown_formulas};
use crate::sweep::Measure;
use maud::{Markup, html};

pub(in crate::report) fn verification(content: &Content) -> Markup {
    if content.models.is_empty() {
        return nothing("No model was studied.");
    }
    let verdict = |verdict| colours::of_verdict(verdict);
    let gain_keys = [
        (Key::Dot, verdict(Verdict::Better), "better than Eq. 1"),
        (Key::Dot, verdict(Verdict::Worse), "worse"),
        (Key::Dot, verdict(Verdict::Unsure), "unsure: the interval holds 0"),
        (Key::Dot, INK, "upper, thick: bootstrap over vertices, from the model's source"),
        (Key::Ring, INK, "lower, thin: bootstrap over sources"),
    ];
    html! {
        p {
            "The gain of a formula is 100 (1 − ratio) percent, with the ratio of its error to that of Eq. 1 on the same model. "
            "The whiskers are 95 % confidence intervals; the paper does not say how it made its own."
        }
        (table(&headline(content)))
        (table(&placing(content)))
        @for of in &HEADLINES { (gain_figure(content, of, legend(&gain_keys))) }
        @for (number, measure) in [(11, Measure::Mean), (14, Measure::Median)] { (step_figure(content, number, measure)) }
    }
}

fn gain_figure(content: &Content, of: &Figure, keys: Markup) -> Markup {
    let Figure { number, formula, measure, .. } = *of;
    let name = format!("Figure {number}.");
    let caption = format!(
        "Gain of {} over Eq. 1 in the {} error. Models are in the order of their gain in the first panel, in both. \
         Gains below −100 % are at the edge, with an arrow and their number.",
        equation(formula),
        measure.name()
    );
    figure(&name, &caption, keys, &[plots::gains(content.models, formula, measure)])
}

fn step_figure(content: &Content, number: u32, measure: Measure) -> Markup {
    let formulas = shown_formulas(measure).map(|formula| (Key::Dot, colours::of_formula(formula), equation(formula)));
    let best = [(Key::Diamond, INK, "best t"), (Key::Tick, SOFT, "maximum t")];
    let caption = format!(
        "Best t for the {} error, the original t (Eq. 1) and the proposed ones, at the paper's size on a logarithmic axis. The \
         thin line goes from the best to the maximum t. Models with the longest edges come first.",
        measure.name()
    );
    let keys = legend(&[&best[..], &formulas].concat());
    figure(&format!("Figure {number}."), &caption, keys, &[plots::steps(content.models, measure)])
}

/// On how many models which formula is better, the paper's counts and ours.
fn headline(content: &Content) -> Table {
    let laplacians = plots::laplacians(content.models);
    let ways = || laplacians.iter().flat_map(|&laplacian| [(laplacian, Over::Vertices), (laplacian, Over::Sources)]);
    let rows = HEADLINES.iter().map(|&Figure { number, formula, measure, counts }| {
        let what = format!("Figure {number}: {}, {}", equation(formula), measure.name());
        let ours = ways().map(|(laplacian, over)| {
            let ratio = |study| pick::paper_ratio(study, laplacian, formula, measure, over);
            Cell::from(Counts::of(content.models.iter().filter_map(ratio).map(|ratio| ratio.verdict())).to_string())
        });
        [what.into(), Cell::new(counts.to_string(), Tone::Pale)].into_iter().chain(ours).collect()
    });
    let Counts { better, worse, unsure } = HEADLINES[0].counts;
    let name = |laplacian| (laplacian_name(laplacian).to_owned(), 2);
    let ours = laplacians.iter().flat_map(|_| ["over vertices", "over sources"]);
    Table {
        title: "On how many models a formula is better than Eq. 1".to_owned(),
        note: format!(
            "Better, worse and unsure, with 95 % confidence by the bootstrap over vertices or over sources. The paper counts {} \
             models, we {}.",
            better + worse + unsure,
            content.models.len()
        ),
        groups: [(String::new(), 2)].into_iter().chain(laplacians.iter().map(|&laplacian| name(laplacian))).collect(),
        head: ["", "paper"].into_iter().chain(ours).map(str::to_owned).collect(),
        rows: rows.collect(),
    }
}

fn placing(content: &Content) -> Table {
    let cells = |name: &str, places: Places, tone| {
        let numbers = [places.between, places.below, places.above].map(|count| Cell::new(count.to_string(), tone));
        [vec![name.into()], numbers.to_vec()].concat()
    };
    let ours = plots::laplacians(content.models);
    let ours = ours.into_iter().map(|of| cells(laplacian_name(of), pick::places(content.models, of), Tone::Plain));
    Table {
        title: "Where the best t is".to_owned(),
        note: "The best t for the mean error, beside those of Eq. 1 and Eq. 2.".to_owned(),
        head: ["", "between", "below both", "above both"].map(str::to_owned).to_vec(),
        rows: std::iter::once(cells("paper", FIGURE_11, Tone::Pale)).chain(ours).collect(),
        ..Table::default()
    }
}
