//! `taut evaluate basic-set`: the paper's meshes, made from its first one.

use super::models::text;
use crate::{Result, output};
use clap::Args;
use std::path::PathBuf;
use taut_eval::paper::is_basic;
use taut_eval::{Model, ModelProperties, tables};

const EXAMPLES: &str = "\
Examples:
  taut evaluate basic-set bunny.obj -o basic
      basic/1.obj to basic/5.obj, and their properties beside the paper's Tables 1 to 4
  taut evaluate correlate basic
      what the best t of these five depends on; each file tells the source in its first line
  taut evaluate basic-set torus.obj --source 0 --seed 7 -o rough
      the same of any mesh

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// Makes 2.obj to 5.obj from a mesh by the paper's recipe: vertices are removed, holes are filled
///
/// Each takes away more vertices at random, 3.1, 6.2, 10.0 and 12.7 % as the paper's tables have it,
/// fills each hole with triangles that keep the shape, and makes no sliver above 179°. The source, the
/// ends of the shortest edge and what spans the bounding box stay. The same seed gives the same meshes.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct BasicSetArgs {
    /// Mesh file: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    mesh: PathBuf,

    /// Source vertex, which stays [default: the first vertex; on the paper's mesh its source, 7649]
    #[arg(long, value_name = "V")]
    source: Option<u32>,

    /// Seed of the random numbers
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,

    /// Folder of the meshes
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

pub(crate) fn run(args: &BasicSetArgs) -> Result<()> {
    let told = |error: taut_eval::Error| error.to_string();
    let first = Model::read(&args.mesh, args.source).map_err(told)?;
    let set = taut_eval::basic_set(&first, args.seed).map_err(told)?;
    std::fs::create_dir_all(&args.output).map_err(|error| format!("{}: {error}", args.output.display()))?;
    let paths: Vec<PathBuf> = (1..=5).map(|i| args.output.join(format!("{i}.obj"))).collect();
    let mut files = vec![(&*paths[0], first.obj().into_bytes())];
    files.extend(paths[1..].iter().zip(&set).map(|(path, made)| (&**path, made.model.obj().into_bytes())));
    output::write(&files)?;
    let models = std::iter::once(&first).chain(set.iter().map(|made| &made.model));
    let properties = models.map(|model| ModelProperties::of(model).map_err(told)).collect::<Result<Vec<_>>>()?;
    output::print(&text(&tables::basic_set(&properties, is_basic(&first.mesh))))
}
