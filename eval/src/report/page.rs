//! The pieces of the page: tables, figures, legends.

use super::colours::hex;
use super::content::{Cell, Table, Tone};
use crate::claims::Finding;
use maud::{Markup, PreEscaped, html};
use plotters::style::RGBColor;

/// Longer tables scroll in a window of their own.
const TALL: usize = 24;

/// The page around its sections: (anchor, name, what stands there).
pub(super) fn page(title: &str, summary: Markup, sections: &[(&str, &str, Markup)]) -> Markup {
    html! {
        (maud::DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body {
                div class="layout" {
                    nav aria-label="Contents" {
                        @for (anchor, name, _) in sections { a href={ "#" (anchor) } { (name) } }
                    }
                    main {
                        h1 { (title) }
                        (summary)
                        @for (anchor, name, section) in sections {
                            section id=(anchor) { h2 { (name) } (section) }
                        }
                    }
                }
            }
        }
    }
}

/// A table with its title and note.
pub(super) fn table(table: &Table) -> Markup {
    html! {
        @if !table.title.is_empty() { h3 { (table.title) } }
        @if !table.note.is_empty() { p class="note" { (table.note) } }
        (bare_table(table))
    }
}

/// A table whose title opens it.
pub(super) fn folded(table: &Table, is_open: bool) -> Markup {
    html! {
        details open[is_open] {
            summary { (table.title) }
            @if !table.note.is_empty() { p class="note" { (table.note) } }
            (bare_table(table))
        }
    }
}

fn bare_table(table: &Table) -> Markup {
    let is_number = numeric_columns(table);
    let starts: Vec<usize> = group_starts(table);
    let class = |column: usize| {
        let number = if is_number.get(column) == Some(&true) { "number" } else { "" };
        format!("{number}{}", if starts.contains(&column) { " start" } else { "" })
    };
    html! {
        div class={ "scroll" @if table.rows.len() > TALL { " tall" } } tabindex="0" role="group" aria-label=(table.title) {
            table {
                thead {
                    @if !table.groups.is_empty() {
                        tr { @for (name, columns) in &table.groups { th class="over" colspan=(columns) { (name) } } }
                    }
                    tr { @for (column, name) in table.head.iter().enumerate() { th class=[some(class(column).trim())] scope="col" { (name) } } }
                }
                tbody {
                    @for row in &table.rows {
                        tr {
                            @for (column, cell) in row.iter().enumerate() { (self::cell(cell, &class(column), column == 0)) }
                        }
                    }
                }
            }
        }
    }
}

/// The columns a group starts with, but the first column of all.
fn group_starts(table: &Table) -> Vec<usize> {
    let mut next = 0;
    let ends = table.groups.iter().map(|&(_, columns)| {
        next += columns;
        next
    });
    ends.collect()
}

fn cell(cell: &Cell, class: &str, is_first: bool) -> Markup {
    let tone = match cell.tone {
        Tone::Plain => "",
        Tone::Pale => "pale",
        Tone::Good => "good",
        Tone::Bad => "bad",
    };
    let classes = format!("{class} {tone}");
    let classes = some(classes.trim());
    html! {
        @if is_first { th class=[classes] scope="row" { (cell.text) } } @else { td class=[classes] { (cell.text) } }
    }
}

/// An attribute that is left out when empty.
fn some(text: &str) -> Option<&str> {
    Some(text).filter(|text| !text.is_empty())
}

/// Whether a column holds numbers, that is, each cell starts as one or says that there is none.
fn numeric_columns(table: &Table) -> Vec<bool> {
    let starts_as_number = |text: &str| {
        let text = text.trim_start_matches(['+', '−', '-', '±', '<', '>', '≈', '≤', '≥', ' ']);
        text.is_empty() || text == "–" || text.starts_with('∞') || text.starts_with(|c: char| c.is_ascii_digit())
    };
    let is_number =
        |column| table.rows.iter().all(|row| row.get(column).is_none_or(|cell: &Cell| starts_as_number(&cell.text)));
    (0..table.head.len()).map(|column| column > 0 && !table.rows.is_empty() && is_number(column)).collect()
}

/// What a sign in a legend looks like.
#[derive(Debug, Clone, Copy)]
pub(super) enum Key {
    Dot,
    Ring,
    Diamond,
    Line,
    Dashed,
    Tick,
}

/// What the signs of a figure mean.
pub(super) fn legend(entries: &[(Key, RGBColor, &str)]) -> Markup {
    let class = |key| match key {
        Key::Dot => "key",
        Key::Ring => "key ring",
        Key::Diamond => "key diamond",
        Key::Line => "key line",
        Key::Dashed => "key dashed",
        Key::Tick => "key tick",
    };
    html! {
        ul class="legend" {
            @for (key, colour, name) in entries {
                li { span class=(class(*key)) style={ "background:" (hex(*colour)) ";border-color:" (hex(*colour)) } {} (name) }
            }
        }
    }
}

/// Plots with what they show above them.
pub(super) fn figure(name: &str, caption: &str, legend: Markup, plots: &[String]) -> Markup {
    figure_of("plots", name, caption, legend, plots)
}

/// The same with many small plots.
pub(super) fn small_figure(name: &str, caption: &str, legend: Markup, plots: &[String]) -> Markup {
    figure_of("plots small", name, caption, legend, plots)
}

fn figure_of(class: &str, name: &str, caption: &str, legend: Markup, plots: &[String]) -> Markup {
    html! {
        figure {
            figcaption { strong { (name) } " " (caption) (legend) }
            div class=(class) { @for plot in plots { div class="plot" { (PreEscaped(plot)) } } }
        }
    }
}

/// A verdict as a badge.
pub(super) fn badge(finding: Finding) -> Markup {
    let (class, name) = match finding {
        Finding::Holds => ("badge holds", "holds"),
        Finding::HoldsPartly => ("badge partly", "holds in part"),
        Finding::DoesNotHold => ("badge fails", "does not hold"),
        Finding::CannotTell => ("badge", "open"),
    };
    html! { span class=(class) { (name) } }
}
