//! `taut evaluate reproduce`: everything, as one report.

use super::counted;
use super::models::BootstrapArgs;
use super::watch::{Bar, cancelled_by_user};
use crate::picture::{Picture, Quantity};
use crate::{Result, output};
use clap::Args;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use taut::Mesh;
use taut_eval::{Options, Reproduction};

const EXAMPLES: &str = "\
Examples:
  taut evaluate reproduce meshes/ -o evaluation
      evaluation/report.html, which needs nothing else, with data.json and tables as .csv beside it

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// The whole evaluation on all meshes of a folder, as one HTML page with plots and pictures
///
/// Where the folder has the first mesh of the paper's basic set, the other four are made from it;
/// where it has models of the paper's Table 5, they are set beside it. Ctrl-C stops; the same
/// command goes on with what is left. 77 real meshes, one of them of a million triangles, took half
/// an hour of processor time.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct ReproduceArgs {
    /// Folder of meshes: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    meshes: PathBuf,

    /// Folder of the report; what is in it is used where it fits
    #[arg(short, long, value_name = "DIR", default_value = "evaluation")]
    output: PathBuf,

    /// Seed of the meshes made from the paper's first one
    #[arg(long, value_name = "N", default_value_t = 1)]
    basic_seed: u64,

    #[command(flatten)]
    bootstrap: BootstrapArgs,

    /// How many models are worked on at once [default: as many as there are processors]
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

pub(crate) fn run(args: &ReproduceArgs) -> Result<()> {
    let control = cancelled_by_user();
    let bar = Bar::new();
    let threads = args.threads.or_else(|| std::thread::available_parallelism().ok()).map_or(1, NonZeroUsize::get);
    let options = Options { basic_seed: args.basic_seed, bootstrap: args.bootstrap.options() };
    let (meshes, out) = (&*args.meshes, &*args.output);
    let work = Reproduction { meshes, out, options, threads, draw: &draw, observer: &bar, control: &control };
    let summary = taut_eval::reproduce(&work);
    bar.end();
    let summary = summary.map_err(|error| match error.is_cancelled() {
        true => format!("stopped; the same command goes on from what is in {}", out.display()),
        false => error.to_string(),
    })?;
    for (name, reason) in &summary.failed {
        eprintln!("taut: warning: {name} is not in the report: {reason}");
    }
    output::print(&format!("{}: {}\n", summary.report.display(), counted(summary.models, "model", "models")))
}

const SIZE: [u32; 2] = [480, 360];

/// The errors of several fields, in the same colours and from the same side.
fn draw(mesh: &Mesh, source: u32, exact: &[f64], errors: &[Vec<f64>]) -> Result<Vec<Vec<u8>>> {
    let sources = &[mesh.positions()[source as usize]];
    let picture = Picture { mesh, quantity: Quantity::Distance, values: exact, sources, levels: None, lines: &[] };
    let view = picture.best_view();
    let quantity = Quantity::Error { top: errors.iter().map(|errors| usual(errors)).reduce(f64::max) };
    errors.iter().map(|errors| Picture { quantity, values: errors, ..picture }.png(view, SIZE)).collect()
}

/// What 95 % of the errors do not exceed.
fn usual(errors: &[f64]) -> f64 {
    let mut finite: Vec<f64> = errors.iter().copied().filter(|error| error.is_finite()).collect();
    finite.sort_by(f64::total_cmp);
    finite.get(finite.len() * 95 / 100).copied().unwrap_or(0.0)
}
