//! The verdicts: in short at the top of the page, in full at its end.

use super::nothing;
use crate::claims::{Claim, Judgement};
use crate::report::page::badge;
use crate::report::plots::laplacian_name;
use maud::{Markup, html};

pub(in crate::report) fn claims(claims: &[Claim]) -> Markup {
    let judgements = claims.first().map_or(&[][..], |claim| &claim.judgements);
    html! {
        @if claims.is_empty() { (nothing("No claim was tried.")) } @else {
            p { "Each claim of the paper and what becomes of it. The figures are " a href="#verdicts" { "at the end" } "." }
            div class="scroll verdicts" tabindex="0" role="group" aria-label="Verdicts" {
                table class="claims" {
                    thead {
                        tr {
                            th scope="col" { "" }
                            th scope="col" { "claim" }
                            @for of in judgements { th scope="col" { (laplacian_name(of.laplacian)) } }
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
            td { (claim.text) }
            @for of in &claim.judgements { td data-name=(laplacian_name(of.laplacian)) { (badge(of.finding)) } }
        }
    }
}

/// A name for links to a claim.
fn anchor(claim: &Claim) -> String {
    let letters = claim.id.chars().map(|c| if c.is_alphanumeric() { c } else { '-' });
    format!("claim-{}", letters.collect::<String>())
}

pub(in crate::report) fn verdicts(claims: &[Claim]) -> Markup {
    html! {
        @if claims.is_empty() { (nothing("No claim was tried.")) }
        @for claim in claims {
            div class="claim" id=(anchor(claim)) {
                p { strong { (claim.id) } " " (claim.text) }
                dl {
                    dt { "paper" } dd { (claim.paper) }
                    @for of in &claim.judgements { (judgement(of)) }
                    dt { "rule" } dd { (claim.rule) }
                }
            }
        }
    }
}

fn judgement(of: &Judgement) -> Markup {
    html! { dt { (laplacian_name(of.laplacian)) } dd { (badge(of.finding)) " " (of.ours) } }
}
