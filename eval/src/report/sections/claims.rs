//! The verdicts: in short at the top of the page, in full at its end.

use super::nothing;
use crate::report::content::Claim;
use crate::report::page::badge;
use maud::{Markup, html};

pub(in crate::report) fn claims(claims: &[Claim]) -> Markup {
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

pub(in crate::report) fn verdicts(claims: &[Claim]) -> Markup {
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
