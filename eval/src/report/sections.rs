//! The sections of the page, in its order.

use super::colours::{self, INK, ORDERED, SOFT, TREND};
use super::content::{Cell, Claim, Content, Counts, Finding, Picture, Table, Tone};
use super::numbers::{fixed, gain, significant};
use super::page::{Key, badge, figure, legend, small_figure, table};
use super::pick::{self, FIGURES, Over};
use super::plots::{self, laplacian_name, measure_name, shown_formulas};
use crate::gain::{Interval, Verdict};
use crate::names::{FORMULAS, SCALES, equation};
use crate::study::{LaplacianStudy, Study};
use crate::sweep::Measure;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};
use taut::{Laplacian, TimeFormula, TimeScale};

/// What stands above the sections.
pub(super) fn summary(content: &Content) -> Markup {
    let findings = [Finding::Holds, Finding::Partly, Finding::Fails, Finding::Open];
    let count = |finding| content.claims.iter().filter(|claim| claim.verdict == finding).count();
    html! {
        p class="lead" { (content.summary) }
        @if !content.claims.is_empty() {
            div class="tally" {
                @for finding in findings.into_iter().filter(|&finding| count(finding) > 0) {
                    span { (count(finding)) " " (badge(finding)) }
                }
            }
        }
    }
}

pub(super) fn claims(claims: &[Claim]) -> Markup {
    html! {
        @if claims.is_empty() { (nothing("No claim was tried.")) } @else {
            p { "Each claim of the paper, its figures and ours. The reasons are " a href="#verdicts" { "at the end" } "." }
            div class="scroll verdicts" tabindex="0" role="group" aria-label="Verdicts" {
                table class="claims" {
                    thead {
                        tr {
                            @for name in ["", "verdict", "claim", "paper", "ours"] { th scope="col" { (name) } }
                        }
                    }
                    tbody { @for claim in claims { (claim_row(claim)) } }
                }
            }
        }
    }
}

fn claim_row(claim: &Claim) -> Markup {
    html! {
        tr {
            th scope="row" { a href={ "#" (anchor(claim)) } { (claim.id) } }
            td { (badge(claim.verdict)) }
            td { (claim.text) }
            td data-name="paper" { (claim.paper) }
            td data-name="ours" { (claim.ours) }
        }
    }
}

/// A name for links to a claim.
fn anchor(claim: &Claim) -> String {
    let letters = claim.id.chars().map(|c| if c.is_alphanumeric() { c } else { '-' });
    format!("claim-{}", letters.collect::<String>())
}

pub(super) fn verdicts(claims: &[Claim]) -> Markup {
    html! {
        @if claims.is_empty() { (nothing("No claim was tried.")) }
        @for claim in claims {
            div class="claim" id=(anchor(claim)) {
                p { strong { (claim.id) } " " (claim.text) " " (badge(claim.verdict)) }
                dl { dt { "paper" } dd { (claim.paper) } dt { "ours" } dd { (claim.ours) } }
                @if !claim.reason.is_empty() { p { (claim.reason) } }
            }
        }
    }
}

fn nothing(why: &str) -> Markup {
    html! { p class="soft" { (why) } }
}

fn tables(tables: &[Table]) -> Markup {
    html! { @for one in tables { (table(one)) } }
}

pub(super) fn making(content: &Content) -> Markup {
    let text = |formula| match formula {
        TimeFormula::MeanEdge => "t = ē²",
        TimeFormula::Sigma => "t = σ",
        TimeFormula::MeanSigma => "t = (ē² + σ) / 2",
        TimeFormula::MedianFit => "t = 1.01204 σ − 0.0001",
        TimeFormula::MedianMean => "t = (ē² + 1.01204 σ − 0.0001) / 2",
    };
    let formulas = FORMULAS.map(|(_, formula)| {
        let name = format!("{}: {}", equation(formula), text(formula));
        (Key::Dot, colours::of_formula(formula), name)
    });
    let keys: Vec<_> = formulas.iter().map(|(key, colour, name)| (*key, *colour, name.as_str())).collect();
    html! {
        p {
            "The heat method gives distances from a source; exact distances tell how far they are off. The error of a vertex is "
            "relative, in percent; the source counts as 0. Every t is at the paper's size, that is, of the model scaled to a "
            "bounding box whose diagonal is 24.976. ē is the mean length of its edges, σ their standard deviation."
        }
        (legend(&keys))
        p {
            "Each model is computed with two Laplacians: with the cotangents of its own triangles, as in the paper (“plain "
            "cotangents”), and with those of its intrinsic Delaunay triangulation, which no obtuse triangle spoils."
        }
        @if !content.making.is_empty() {
            div class="scroll" tabindex="0" role="group" aria-label="How it was made" {
                table class="facts" {
                    tbody { @for [name, value] in &content.making { tr { th scope="row" { (name) } td { (value) } } } }
                }
            }
        }
    }
}

pub(super) fn properties(content: &Content) -> Markup {
    let plots: Vec<String> = content.trends.iter().map(plots::trend).collect();
    let keys = [(Key::Dot, INK, "ours"), (Key::Ring, SOFT, "the paper's"), (Key::Dashed, TREND, "regression line")];
    html! {
        @if content.properties.is_empty() && plots.is_empty() { (nothing("The basic set was not made.")) }
        (tables(&content.properties))
        @if !plots.is_empty() {
            (figure(
                "Figure 5.",
                "The paper removes 3 % more of the vertices from each mesh to the next, and finds that anisotropy and standard \
                 deviation grow along a line. R² = 1 would be exactly a line.",
                legend(&keys),
                &plots,
            ))
        }
    }
}

pub(super) fn best(content: &Content) -> Markup {
    let laplacians = plots::laplacians(content.basic);
    let curves: Vec<String> = laplacians.iter().map(|&laplacian| plots::curves(content.basic, laplacian)).collect();
    let named = content.basic.iter().zip(ORDERED.into_iter().cycle());
    let keys: Vec<_> = named.map(|(study, colour)| (Key::Line, colour, study.model.as_str())).collect();
    let small: Vec<String> = content.models.iter().map(plots::small_curves).collect();
    html! {
        (tables(&content.best))
        @if curves.is_empty() { (nothing("No mesh of the basic set was studied.")) } @else {
            (figure(
                "Figure 9.",
                "Mean error over t; the dot is the best t. Both axes are logarithmic. The paper calls these curves similar to \
                 |log t|, with one minimum.",
                legend(&keys),
                &curves,
            ))
        }
        @if !small.is_empty() {
            (small_figure(
                "The same for each model.",
                "Mean error in percent over t / ē², so that Eq. 1 is at 1, the grey line; the dot is the best t. A flat valley \
                 means that t hardly matters. Where the two curves are far apart, the triangles matter more than t.",
                laplacian_legend(&plots::laplacians(content.models)),
                &small,
            ))
        }
    }
}

fn laplacian_legend(laplacians: &[Laplacian]) -> Markup {
    let key = |laplacian| (Key::Line, colours::of_laplacian(laplacian), laplacian_name(laplacian));
    legend(&laplacians.iter().map(|&laplacian| key(laplacian)).collect::<Vec<_>>())
}

pub(super) fn search(content: &Content) -> Markup {
    let studies: Vec<&Study> = content.basic.iter().chain(content.models).collect();
    let mut rows = Vec::new();
    let (mut same, mut all, mut probes) = (0, 0, [0, 0]);
    for study in unique(&studies) {
        for of in &study.laplacians {
            for (measure, found) in Measure::ALL.into_iter().zip(&of.search) {
                let best = of.sweep.best(measure);
                all += 1;
                same += usize::from(best.t == found.t);
                probes = [probes[0] + best.probes, probes[1] + found.probes];
                rows.push(search_row(study, of, measure));
            }
        }
    }
    let head =
        ["model", "Laplacian", "error", "t", "least, %", "tried", "t", "least, %", "tried", "maximum t", "over best"];
    let groups = [("", 3), ("sweep", 3), ("search", 3), ("maximum", 2)];
    let of_all = Table {
        title: "Every search".to_owned(),
        note: "The search goes up from the lowest t and stops at the maximum t. Where it finds another t than the sweep it is \
               marked. “≥” or “≤”: the best t is at the end of the range."
            .to_owned(),
        groups: groups.map(|(name, columns)| (name.to_owned(), columns)).to_vec(),
        head: head.map(str::to_owned).to_vec(),
        rows,
    };
    let mean = |probes: usize| fixed(probes as f64 / all.max(1) as f64, 1);
    html! {
        p {
            "The maximum t, as the paper has it, is the least t beyond the best one at which half of the vertices have three "
            "times the least error; the paper proposes it as the stop of a search for the best t."
        }
        @if all == 0 { (nothing("Nothing was searched.")) } @else {
            p {
                "The search finds the t of the sweep in " strong { (same) " of " (all) } " cases, with " (mean(probes[1]))
                " values of t tried instead of " (mean(probes[0])) " on average."
            }
            (table(&of_all))
        }
    }
}

/// Studies by their names, each once.
fn unique<'a>(studies: &[&'a Study]) -> Vec<&'a Study> {
    let mut seen = std::collections::HashSet::new();
    studies.iter().copied().filter(|study| seen.insert(study.model.as_str())).collect()
}

fn search_row(study: &Study, of: &LaplacianStudy, measure: Measure) -> Vec<Cell> {
    let best = of.sweep.best(measure);
    let found = of.search[Measure::ALL.iter().position(|&one| one == measure).unwrap_or(0)];
    let is_low = of.sweep.points.first().is_some_and(|point| best.t <= point.t);
    let end = if !best.at_end {
        ""
    } else if is_low {
        "≤ "
    } else {
        "≥ "
    };
    let tone = if found.t == best.t { Tone::Plain } else { Tone::Bad };
    let over = best.maximum_t.map_or("–".to_owned(), |most| significant(most / best.t));
    vec![
        study.model.as_str().into(),
        Cell::new(laplacian_name(of.laplacian), Tone::Pale),
        Cell::new(measure_name(measure), Tone::Pale),
        format!("{end}{}", significant(best.t)).into(),
        fixed(best.error, 5).into(),
        Cell::new(best.probes.to_string(), Tone::Pale),
        Cell::new(significant(found.t), tone),
        Cell::new(fixed(found.error, 5), tone),
        Cell::new(found.probes.to_string(), Tone::Pale),
        best.maximum_t.map_or("–".to_owned(), significant).into(),
        over.into(),
    ]
}

pub(super) fn correlation(content: &Content) -> Markup {
    let keys = [(Key::Dot, INK, "ours (coloured), with its 95 % interval"), (Key::Ring, INK, "the paper's")];
    html! {
        p {
            "Five meshes carry these correlations, and they are made one from the other by removing vertices: nearly every "
            "property grows or falls along them, so nearly every coefficient is large. The intervals say how little five points tell."
        }
        @for measure in Measure::ALL {
            @if content.correlations.iter().any(|of| of.measure == measure) {
                (correlation_of(content, measure, legend(&keys)))
            }
        }
        @if content.correlations.is_empty() { (nothing("Nothing was correlated.")) }
        @for measure in Measure::ALL {
            @let fits: Vec<String> = content.fits.iter().filter(|fit| fit.measure == measure).map(plots::fit).collect();
            @if !fits.is_empty() { (fit_of(measure, &fits)) }
        }
    }
}

fn table_number(measure: Measure) -> u32 {
    match measure {
        Measure::Mean => 7,
        Measure::Median => 9,
    }
}

fn correlation_of(content: &Content, measure: Measure, keys: Markup) -> Markup {
    let of_measure: Vec<_> = content.correlations.iter().filter(|of| of.measure == measure).collect();
    let number = |value: Option<f64>| value.map_or("–".to_owned(), |value| fixed(value, 4));
    let first = of_measure.first().map_or(&[][..], |of| &of.rows);
    let rows = first.iter().enumerate().map(|(row, of)| {
        let mut cells: Vec<Cell> = vec![
            of.property.symbol().into(),
            Cell::new(of.property.name(), Tone::Pale),
            Cell::new(number(of.paper), Tone::Pale),
        ];
        for ours in of_measure.iter().filter_map(|of| of.rows.get(row)) {
            cells.push(number(ours.ours).into());
            let interval =
                ours.interval.map_or("–".to_owned(), |[low, high]| format!("{} … {}", fixed(low, 3), fixed(high, 3)));
            cells.push(Cell::new(interval, Tone::Pale));
        }
        cells
    });
    let columns = of_measure.iter().map(|of| (laplacian_name(of.laplacian).to_owned(), 2));
    let name = format!("Table {}.", table_number(measure));
    let numbers = Table {
        title: format!("{name} Pearson's coefficients in numbers"),
        note: "A property that does not vary over the basic set has none.".to_owned(),
        groups: [(String::new(), 3)].into_iter().chain(columns).collect(),
        head: ["property", "", "paper"]
            .into_iter()
            .chain(of_measure.iter().flat_map(|_| ["ours", "95 % interval"]))
            .map(str::to_owned)
            .collect(),
        rows: rows.collect(),
    };
    let caption = format!(
        "Correlation of the best t for the {} error with each property over the basic set.",
        measure_name(measure)
    );
    html! {
        (figure(&name, &caption, keys, &[plots::correlations(measure, &content.correlations)]))
        (table(&numbers))
    }
}

fn fit_of(measure: Measure, fits: &[String]) -> Markup {
    let keys = [
        (Key::Dot, INK, "our basic set (coloured)"),
        (Key::Dashed, INK, "regression through it"),
        (Key::Ring, SOFT, "the paper's tables"),
        (Key::Line, colours::of_formula(TimeFormula::MedianFit), "Eq. 4"),
    ];
    let name = format!("The fit for the {} error.", measure_name(measure));
    let caption =
        "Best t over the standard deviation σ of the edges. Eq. 4 is the paper's regression for the median error.";
    figure(&name, caption, legend(&keys), fits)
}

pub(super) fn verification_set(content: &Content) -> Markup {
    html! {
        @if content.verification.is_empty() { (nothing("No model of the paper's verification set is there.")) }
        (tables(&content.verification))
    }
}

pub(super) fn verification(content: &Content) -> Markup {
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
        @for (number, formula, measure) in FIGURES {
            (gain_figure(content, (number, formula, measure), legend(&gain_keys)))
        }
        @for (number, measure) in [(11, Measure::Mean), (14, Measure::Median)] { (step_figure(content, number, measure)) }
    }
}

fn gain_figure(content: &Content, (number, formula, measure): (u32, TimeFormula, Measure), keys: Markup) -> Markup {
    let name = format!("Figure {number}.");
    let caption = format!(
        "Gain of {} over Eq. 1 in the {} error. Models are in the order of their gain in the first panel, in both. \
         Gains below −100 % are at the edge, with an arrow and their number.",
        equation(formula),
        measure_name(measure)
    );
    figure(&name, &caption, keys, &[plots::gains(content.models, formula, measure)])
}

fn step_figure(content: &Content, number: u32, measure: Measure) -> Markup {
    let formulas = shown_formulas(measure).map(|formula| (Key::Dot, colours::of_formula(formula), equation(formula)));
    let best = [(Key::Diamond, INK, "best t"), (Key::Tick, SOFT, "maximum t")];
    let caption = format!(
        "Best t for the {} error, the original t (Eq. 1) and the proposed ones, at the paper's size on a logarithmic axis. The \
         thin line goes from the best to the maximum t. Models with the longest edges come first.",
        measure_name(measure)
    );
    let keys = legend(&[&best[..], &formulas].concat());
    figure(&format!("Figure {number}."), &caption, keys, &[plots::steps(content.models, measure)])
}

/// On how many models which formula is better, the paper's counts and ours.
fn headline(content: &Content) -> Table {
    let laplacians = plots::laplacians(content.models);
    let ways = || laplacians.iter().flat_map(|&laplacian| [(laplacian, Over::Vertices), (laplacian, Over::Sources)]);
    let rows = FIGURES.into_iter().zip(content.printed.counts).map(|((number, formula, measure), paper)| {
        let what = format!("Figure {number}: {}, {}", equation(formula), measure_name(measure));
        let ours = ways().map(|(laplacian, over)| {
            let ratio = |study| pick::paper_ratio(study, laplacian, formula, measure, over);
            Cell::from(written(pick::counts(content.models.iter().filter_map(ratio))))
        });
        [what.into(), Cell::new(written(paper), Tone::Pale)].into_iter().chain(ours).collect()
    });
    let Counts { better, worse, unsure } = content.printed.counts[0];
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

fn written(Counts { better, worse, unsure }: Counts) -> String {
    format!("{better} / {worse} / {unsure}")
}

fn placing(content: &Content) -> Table {
    let cells = |name: &str, places: super::content::Places, tone| {
        let numbers = [places.between, places.below, places.above].map(|count| Cell::new(count.to_string(), tone));
        [vec![name.into()], numbers.to_vec()].concat()
    };
    let ours = plots::laplacians(content.models);
    let ours = ours.into_iter().map(|of| cells(laplacian_name(of), pick::places(content.models, of), Tone::Plain));
    Table {
        title: "Where the best t is".to_owned(),
        note: "The best t for the mean error, beside those of Eq. 1 and Eq. 2.".to_owned(),
        head: ["", "between", "below both", "above both"].map(str::to_owned).to_vec(),
        rows: std::iter::once(cells("paper", content.printed.places, Tone::Pale)).chain(ours).collect(),
        ..Table::default()
    }
}

pub(super) fn units(content: &Content) -> Markup {
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
    let cells = |study: &Study, formula, scale| match pick::outcome(study, laplacian, formula, scale) {
        None => [Cell::new("refused", Tone::Pale), Cell::new("–", Tone::Pale)],
        Some(outcome) => {
            let mean = pick::ratio(outcome, Measure::Mean, Over::Vertices).map_or(f64::NAN, |interval| interval.ratio);
            let tone = if scale == TimeScale::Raw { Tone::Plain } else { Tone::Pale };
            [outcome.t / pick::mean_edge_squared(study), mean].map(|value| Cell::new(significant(value), tone))
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

pub(super) fn why(content: &Content) -> Markup {
    html! {
        @if content.why.is_empty() { (nothing("Nothing was tried.")) }
        (tables(&content.why))
    }
}

pub(super) fn pictures(pictures: &[Picture]) -> Markup {
    html! {
        @if pictures.is_empty() { (nothing("No picture was made.")) } @else {
            p class="note" { "The relative error of each vertex, in percent." }
            div class="pictures" { @for picture in pictures { (self::picture(picture)) } }
        }
    }
}

fn picture(picture: &Picture) -> Markup {
    let Picture { model, laplacian, formula, mean_error, png } = picture;
    let how = format!("{}, {}", laplacian_name(*laplacian), equation(*formula));
    html! {
        figure {
            img src={ "data:image/png;base64," (STANDARD.encode(png)) } alt={ "Errors on " (model) ", " (how) };
            figcaption { strong { (model) } " " (how) ": mean error " (significant(*mean_error)) " %" }
        }
    }
}

pub(super) fn models(content: &Content) -> Markup {
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
        [Cell::from(study.model.as_str())].into_iter().chain(counts).chain(shape).chain(found).collect()
    };
    let groups = laplacians.iter().map(|&laplacian| (laplacian_name(laplacian).to_owned(), 8));
    let head = laplacians
        .iter()
        .flat_map(|_| ["best t", "t / ē²", "least, %", "Eq. 1, %", "Eq. 2", "Eq. 3", "Eq. 4", "Eq. 5"]);
    let of_all = Table {
        title: String::new(),
        note: "For each Laplacian: the best t for the mean error and the error there, the mean error at Eq. 1, and the gains of \
               Eq. 2 and 3 in the mean and of Eq. 4 and 5 in the median error; coloured where 95 % confidence over the vertices \
               says better or worse."
            .to_owned(),
        groups: [(String::new(), 8)].into_iter().chain(groups).collect(),
        head: ["model", "vertices", "triangles", "g", "ē", "σ", "σ / ē", "max angle"].into_iter().chain(head).map(str::to_owned).collect(),
        rows: content.models.iter().map(row).collect(),
    };
    table(&of_all)
}

fn model_cells(study: &Study, laplacian: Laplacian) -> Vec<Cell> {
    let best = pick::with(study, laplacian).map(|of| of.sweep.mean);
    let original = pick::outcome(study, laplacian, TimeFormula::MeanEdge, TimeScale::Paper).map(|outcome| outcome.mean);
    let unit = pick::mean_edge_squared(study);
    let found = [best.map(|best| best.t), best.map(|best| best.t / unit), best.map(|best| best.error), original];
    let found = found.map(|value| Cell::from(significant(value.unwrap_or(f64::NAN))));
    let gains = FIGURES.map(|(_, formula, measure)| {
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

pub(super) fn slips(content: &Content) -> Markup {
    html! {
        @if content.slips.is_empty() { (nothing("None was looked for.")) }
        (tables(&content.slips))
    }
}
