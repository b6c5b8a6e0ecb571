//! The sections of the page, in its order; those that need more than a few lines are in files of their own.

mod claims;
mod correlation;
mod models;
mod search;
mod units;
mod verification;

pub(super) use claims::{claims, verdicts};
pub(super) use correlation::correlation;
pub(super) use models::models;
pub(super) use search::search;
pub(super) use units::units;
pub(super) use verification::verification;

use super::colours::{self, INK, ORDERED, SOFT, TREND};
use super::content::{Content, Picture, Table};
use super::numbers::significant;
use super::page::{Key, badge, figure, folded, legend, small_figure, table};
use super::plots::{self, laplacian_name};
use crate::claims::Finding;
use crate::names::{FORMULAS, equation};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};
use taut::{Laplacian, TimeFormula};

/// What stands above the sections.
pub(super) fn summary(content: &Content) -> Markup {
    let findings = [Finding::Holds, Finding::HoldsPartly, Finding::DoesNotHold, Finding::CannotTell];
    let laplacians = content.claims.first().map_or(&[][..], |claim| &claim.judgements).iter().map(|of| of.laplacian);
    let count = |laplacian, finding| {
        let all = content.claims.iter().flat_map(|claim| &claim.judgements);
        all.filter(|of| of.laplacian == laplacian && of.finding == finding).count()
    };
    html! {
        p class="lead" { (content.summary) }
        @for laplacian in laplacians {
            div class="tally" {
                span { (laplacian_name(laplacian)) ":" }
                @for finding in findings.into_iter().filter(|&finding| count(laplacian, finding) > 0) {
                    span { (count(laplacian, finding)) " " (badge(finding)) }
                }
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

pub(super) fn verification_set(content: &Content) -> Markup {
    html! {
        @if content.verification.is_empty() { (nothing("No model of the paper's verification set is there.")) }
        (tables(&content.verification))
    }
}

pub(super) fn why(content: &Content) -> Markup {
    html! {
        p {
            "The paper's numbers come from plain cotangents, the magnitude of u, distances moved so that the least is 0, heat that "
            "is reflected at boundaries, and as error the mean (or median) of |φ − exact| / exact over all vertices, where the "
            "source counts as 0. On its own 1.obj that gives its Tables 6 and 8 to all five digits. Its other meshes are random, so "
            "that only their kind can be made again. Each row below changes one of these choices; where a row has another number "
            "than the first, that choice was not the paper's."
        }
        @if content.why.is_empty() { (nothing("Nothing was tried.")) }
        @for (i, one) in content.why.iter().enumerate() { (folded(one, i == 0)) }
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

pub(super) fn slips(content: &Content) -> Markup {
    html! {
        @if content.slips.is_empty() { (nothing("None was looked for.")) }
        (tables(&content.slips))
    }
}
