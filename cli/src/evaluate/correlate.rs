//! `taut evaluate correlate` and `taut evaluate fit`: what the best t depends on.

use super::best_t::studies;
use super::models::{FormatArgs, LaplacianArgs, ModelArgs};
use crate::Result;
use clap::Args;
use taut_eval::report::{write_correlations, write_fits};
use taut_eval::{Study, tables};

const CORRELATE: &str = "\
Examples:
  taut evaluate basic-set bunny.obj -o basic
  taut evaluate correlate basic
      Tables 7 and 9 of the paper

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// How the best t goes with each property of the meshes: Pearson's r, as the paper's Tables 7 and 9
///
/// With 95 % confidence intervals by Fisher's z. A property that does not vary has no r, and says so.
/// Takes three meshes at least.
#[derive(Debug, Args)]
#[command(after_help = CORRELATE, verbatim_doc_comment)]
pub(crate) struct CorrelateArgs {
    #[command(flatten)]
    models: ModelArgs,

    #[command(flatten)]
    laplacian: LaplacianArgs,

    #[command(flatten)]
    format: FormatArgs,
}

pub(crate) fn run(args: &CorrelateArgs) -> Result<()> {
    let studies = three_at_least(&args.models, &args.laplacian)?;
    let found = tables::correlate(&studies);
    args.format.print(&found, || found.iter().map(tables::correlated).collect(), |out| write_correlations(&found, out))
}

const FIT: &str = "\
Examples:
  taut evaluate basic-set bunny.obj -o basic
  taut evaluate fit basic
      the line that the paper has as Eq. 4

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// The line through the best t of meshes over the standard deviation of their edges, as the paper's Eq. 4
///
/// Also the line through t / ē² over σ / ē, which depends on no unit. With 95 % confidence intervals
/// by Student's t. Takes three meshes at least.
#[derive(Debug, Args)]
#[command(after_help = FIT, verbatim_doc_comment)]
pub(crate) struct FitArgs {
    #[command(flatten)]
    models: ModelArgs,

    #[command(flatten)]
    laplacian: LaplacianArgs,

    #[command(flatten)]
    format: FormatArgs,
}

pub(crate) fn fit(args: &FitArgs) -> Result<()> {
    let studies = three_at_least(&args.models, &args.laplacian)?;
    let found = tables::fit(&studies);
    args.format.print(&found, || vec![tables::fitted(&found)], |out| write_fits(&found, out))
}

/// The best t of each model, of which a correlation and a line need three.
fn three_at_least(models: &ModelArgs, laplacian: &LaplacianArgs) -> Result<Vec<Study>> {
    match &models.read()?[..] {
        models @ [_, _, _, ..] => studies(models, &laplacian.all()),
        [one] => Err(format!("fewer than three points: {} is the only mesh", one.name)),
        few => Err(format!("fewer than three points: {} meshes", few.len())),
    }
}
