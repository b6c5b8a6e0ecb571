//! Finished studies as a page to read and as tables to compute with.
//!
//! [`html`] makes one page that needs no other file and no network: style, plots (SVG) and pictures (PNG) are inside. The
//! same content gives the same bytes. [`write_properties`] and the others write the numbers of all studies as CSV.

use crate::study::Study;
use taut::Laplacian;

mod chart;
mod colours;
mod content;
pub(crate) mod numbers;
mod page;
mod pick;
mod plots;
mod sections;
mod tables;
mod text;

pub use content::{Beside, Cell, Content, CorrelationRow, CorrelationTable, FitFigure, Picture, Table, Tone, Trend};
pub use tables::{write_best, write_correlations, write_fits, write_gains, write_properties, write_sweeps};

/// The errors over t of some models with one Laplacian, as Figure 9 has them: an SVG file.
#[must_use]
pub fn curves(models: &[Study], laplacian: Laplacian) -> String {
    plots::curves(models, laplacian)
}

/// The page.
#[must_use]
pub fn html(content: &Content) -> String {
    let parts = [
        ("claims", "Verdicts", sections::claims(content.claims)),
        ("making", "How it was made", sections::making(content)),
        ("properties", "Properties", sections::properties(content)),
        ("best", "The best t", sections::best(content)),
        ("search", "Search and maximum t", sections::search(content)),
        ("correlation", "Correlation and fit", sections::correlation(content)),
        ("verification-set", "Verification set", sections::verification_set(content)),
        ("verification", "Verification", sections::verification(content)),
        ("units", "Units", sections::units(content)),
        ("why", "Why numbers differ", sections::why(content)),
        ("pictures", "Where the errors are", sections::pictures(&content.pictures)),
        ("models", "All models", sections::models(content)),
        ("slips", "Slips in the paper", sections::slips(content)),
        ("verdicts", "Verdicts in full", sections::verdicts(content.claims)),
    ];
    page::page(&content.title, sections::summary(content), &parts).into_string()
}
