//! The search for the best t beside the sweep, and the maximum t.

use super::nothing;
use crate::report::content::{Cell, Content, Table, Tone};
use crate::report::numbers::{fixed, significant};
use crate::report::page::table;
use crate::report::plots::laplacian_name;
use crate::study::{LaplacianStudy, Study};
use crate::sweep::Measure;
use maud::{Markup, html};
use std::collections::HashSet;

pub(in crate::report) fn search(content: &Content) -> Markup {
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
    let mut seen = HashSet::new();
    studies.iter().copied().filter(|study| seen.insert(study.model.as_str())).collect()
}

fn search_row(study: &Study, of: &LaplacianStudy, measure: Measure) -> Vec<Cell> {
    let best = of.sweep.best(measure);
    let found = of.searched(measure);
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
        Cell::new(measure.name(), Tone::Pale),
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
