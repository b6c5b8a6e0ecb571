//! `taut evaluate best-t`: where the error of the heat method is least.

use super::models::{FormatArgs, LaplacianArgs, ModelArgs};
use super::watch::watched;
use crate::{Cli, Result, output};
use clap::error::ErrorKind;
use clap::{Args, CommandFactory};
use std::path::PathBuf;
use taut::Laplacian;
use taut_eval::report::{self, write_best};
use taut_eval::{Model, Study, exact, tables};

const EXAMPLES: &str = "\
Examples:
  taut evaluate best-t bunny.obj
      the best t for the mean and for the median error, with each Laplacian
  taut evaluate best-t bunny.obj --source 7649 --laplacian plain --curve bunny.svg
      from this vertex, as the paper does it, and a drawing of the error over t
  taut evaluate best-t meshes/ --search --format csv
      the search that stops at the maximum t, beside the sweep, on all meshes of a folder

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// The t at which the mean, and that at which the median error is least; the maximum t
///
/// Tries t from a hundredth of ē², the square of the mean edge, to a thousand times it, at last each
/// number of three digits around the best. The maximum t is where half of the vertices have three
/// times the least error.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct BestTArgs {
    #[command(flatten)]
    models: ModelArgs,

    #[command(flatten)]
    laplacian: LaplacianArgs,

    /// Search from below, stopped by the maximum t, and tell how many t that took
    #[arg(long)]
    search: bool,

    /// Draw the errors over t to this SVG file
    #[arg(long, value_name = "FILE")]
    curve: Option<PathBuf>,

    #[command(flatten)]
    format: FormatArgs,
}

impl BestTArgs {
    /// Refuses what clap cannot see by itself.
    pub(super) fn check(&self) -> std::result::Result<(), clap::Error> {
        if self.curve.is_none() || self.laplacian.all().len() == 1 {
            return Ok(());
        }
        let message = "--curve draws one Laplacian: give --laplacian plain or intrinsic";
        Err(Cli::command().error(ErrorKind::ArgumentConflict, message))
    }
}

pub(crate) fn run(args: &BestTArgs) -> Result<()> {
    let laplacians = args.laplacian.all();
    let studies = studies(&args.models.read()?, &laplacians)?;
    if let (Some(path), &[laplacian]) = (&args.curve, &laplacians[..]) {
        output::write(&[(path, report::curves(&studies, laplacian).into_bytes())])?;
    }
    args.format.print(&studies, || vec![tables::best(&studies, args.search)], |out| write_best(&studies, out))
}

/// The best t of each model with each Laplacian.
pub(super) fn studies(models: &[Model], laplacians: &[Laplacian]) -> Result<Vec<Study>> {
    watched(models, |model, control, progress| {
        let exact = exact(model, model.source, control)?;
        Study::new(model, &exact, laplacians, None, control, progress)
    })
}
