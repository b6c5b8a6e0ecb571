//! `taut evaluate verify`: what each formula gains over Eq. 1.

use super::models::{BootstrapArgs, FormatArgs, LaplacianArgs, ModelArgs};
use super::watch::watched;
use crate::Result;
use clap::Args;
use taut_eval::report::write_gains;
use taut_eval::{Sources, Study, exact, tables};

const EXAMPLES: &str = "\
Examples:
  taut evaluate verify bunny.obj
      the error with each formula, and how sure it is that it is less than with Eq. 1
  taut evaluate verify meshes/ --laplacian plain --format csv
      on all meshes of a folder, as the paper did it

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// What each formula for t gains over Eq. 1, with its 95 % confidence interval: better, worse or unsure
///
/// The gain is 1 - (error with the formula) / (error with Eq. 1), for the mean and for the median
/// error. Its interval comes from the bootstrap, in two ways: over the vertices of the mesh, with one
/// source, as the paper may have done it; and over sources. Errors of neighbouring vertices go
/// together, so the first is too narrow; it speaks of that one source only. Both units of the formulas
/// stand side by side: at the paper's size, and on the numbers of the mesh as they are.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct VerifyArgs {
    #[command(flatten)]
    models: ModelArgs,

    #[command(flatten)]
    laplacian: LaplacianArgs,

    #[command(flatten)]
    bootstrap: BootstrapArgs,

    #[command(flatten)]
    format: FormatArgs,
}

pub(crate) fn run(args: &VerifyArgs) -> Result<()> {
    let (laplacians, bootstrap) = (args.laplacian.all(), args.bootstrap.options());
    let studies = watched(&args.models.read()?, |model, control, progress| {
        let exact = exact(model, model.source, control)?;
        let sources = Sources::new(model, &exact, &bootstrap, control)?;
        Study::new(model, &exact, &laplacians, Some((&sources, &bootstrap)), control, progress)
    })?;
    args.format.print(
        &studies,
        || {
            let headline = (studies.len() > 1).then(|| tables::headline(&studies));
            tables::gains(&studies).into_iter().chain(headline).collect()
        },
        |out| write_gains(&studies, out),
    )
}
