//! `taut evaluate`: the paper's evaluation of the time step t, on any meshes.

mod basic_set;
mod best_t;
mod correlate;
mod models;
mod properties;
mod reproduce;
mod verify;
mod watch;

use crate::Result;
use clap::{Args, Subcommand};

/// How good is a time step: the evaluation of the heat method's t, on any meshes
///
/// What the paper "Wave propagation time optimization for geodesic distances calculation using the
/// Heat Method" (2019) did to propose its formulas for t, word by word; `reproduce` does all of it.
/// Every t is given at the paper's size, that is, of the mesh scaled to a bounding box of the
/// diagonal 24.976; errors are in percent of the exact distance.
#[derive(Debug, Args)]
#[command(verbatim_doc_comment)]
pub(crate) struct EvaluateArgs {
    #[command(subcommand)]
    word: Word,
}

#[derive(Debug, Subcommand)]
enum Word {
    Properties(properties::PropertiesArgs),
    BasicSet(basic_set::BasicSetArgs),
    BestT(best_t::BestTArgs),
    Correlate(correlate::CorrelateArgs),
    Fit(correlate::FitArgs),
    Verify(verify::VerifyArgs),
    Reproduce(reproduce::ReproduceArgs),
}

impl EvaluateArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        match &self.word {
            Word::BestT(args) => args.check(),
            _ => Ok(()),
        }
    }
}

pub(crate) fn run(args: &EvaluateArgs) -> Result<()> {
    match &args.word {
        Word::Properties(args) => properties::run(args),
        Word::BasicSet(args) => basic_set::run(args),
        Word::BestT(args) => best_t::run(args),
        Word::Correlate(args) => correlate::run(args),
        Word::Fit(args) => correlate::fit(args),
        Word::Verify(args) => verify::run(args),
        Word::Reproduce(args) => reproduce::run(args),
    }
}

/// So many of something.
fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
