//! `taut evaluate properties`: the properties of meshes that the paper sets beside the best t.

use super::models::{FormatArgs, ModelArgs};
use crate::Result;
use clap::Args;
use serde::Serialize;
use taut_eval::report::write_properties;
use taut_eval::{ModelProperties, tables};

const EXAMPLES: &str = "\
Examples:
  taut evaluate properties bunny.obj
      the 18 properties, at the paper's size and in the units of the mesh
  taut evaluate properties meshes/ --format csv
      those of all meshes of a folder, a line for each

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// The 18 properties of the paper for each mesh: counts, edge lengths, angles, anisotropy g
///
/// Both at the paper's size and in the units of the mesh. What the paper calls the median absolute
/// deviation is the mean absolute deviation; the median one is told too.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct PropertiesArgs {
    #[command(flatten)]
    models: ModelArgs,

    #[command(flatten)]
    format: FormatArgs,
}

/// The properties of one model.
#[derive(Serialize)]
struct Named {
    model: String,
    #[serde(flatten)]
    properties: ModelProperties,
}

pub(crate) fn run(args: &PropertiesArgs) -> Result<()> {
    let mut all = Vec::new();
    for model in args.models.read()? {
        let properties = ModelProperties::of(&model).map_err(|error| error.to_string())?;
        all.push(Named { model: model.name, properties });
    }
    args.format.print(
        &all,
        || all.iter().map(|of| tables::properties(&of.model, &of.properties)).collect(),
        |out| write_properties(all.iter().map(|of| (&*of.model, &of.properties)), out),
    )
}
