//! What the best t goes with over the basic set, and the line to Eq. 4.

use super::{nothing, tables};
use crate::report::colours::{self, INK, SOFT};
use crate::report::content::{Cell, Content, Table, Tone};
use crate::report::numbers::fixed;
use crate::report::page::{Key, figure, legend, table};
use crate::report::plots::{self, laplacian_name};
use crate::sweep::Measure;
use maud::{Markup, html};
use taut::TimeFormula;

pub(in crate::report) fn correlation(content: &Content) -> Markup {
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
        (tables(&content.draws))
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
    let caption =
        format!("Correlation of the best t for the {} error with each property over the basic set.", measure.name());
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
    let name = format!("The fit for the {} error.", measure.name());
    let caption =
        "Best t over the standard deviation σ of the edges. Eq. 4 is the paper's regression for the median error.";
    figure(&name, caption, legend(&keys), fits)
}
