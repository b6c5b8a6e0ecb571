//! `taut distance`: reads, computes, and only then writes, so that a failure leaves nothing behind.

use crate::Result;
use crate::args::FieldArgs;
use crate::field::Field;
use crate::input::{self, Places};
use crate::measured::Seconds;
use crate::mesh_out::MeshOut;
use crate::numbers::DISTANCE;
use crate::output::{self, Output, Report, Timing};
use crate::picture::{Picture, PictureArgs, Quantity};
use clap::Args;
use std::path::PathBuf;
use taut::{Mesh, Source, Target};
use taut_eval::{Errors, percents};

const EXAMPLES: &str = "\
Examples:
  taut distance bunny.obj --source 0
      the distance of every vertex from vertex 0, one a line, on standard output
  taut distance bunny.obj --source 0 --method exact -o exact.txt
      the exact distances, into a file
  taut distance bunny.obj --source 0 --reference exact.txt --json
      how far the heat method is from them, and how long it took
  taut distance bunny.obj --source 0 -o distances.txt --mesh-out distances.ply
      the mesh with colours, for MeshLab or Blender
  taut distance bunny.obj --source 0 -o distances.txt --picture bunny.png
      a picture of them
  taut distance bunny.obj --source 0 --method exact --target 4711
      the distance of one vertex
  taut distance bunny.obj --source 0 --method exact --radius 0.05
      the distances up to 0.05, and inf for what is farther

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// Distance of each vertex of a mesh from one or more source vertices
///
/// Writes one distance a line, in the order of the vertices and in the units of the mesh:
/// the shortest decimal that reads back to the same number, or inf where no source can be reached.
/// Vertices count from 0.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct DistanceArgs {
    #[command(flatten)]
    field: FieldArgs,

    /// Write only the distance of this vertex; the exact method stops as soon as it knows it
    #[arg(long, value_name = "V")]
    target: Option<u32>,

    /// Compare with the distances of this file, one a line:
    /// mean, median and maximum error in percent, on standard error
    #[arg(verbatim_doc_comment, long, value_name = "FILE")]
    reference: Option<PathBuf>,

    /// Write the distances to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Write the mesh with its distances to this file too. The suffix tells how:
    ///   .ply  the distance as the property `quality`, and as a colour; grey where unreachable
    ///   .obj  the distance as texture coordinate, from 0 at the least to 1 at the largest
    #[arg(verbatim_doc_comment, long, value_name = "FILE", value_parser = MeshOut::parser())]
    mesh_out: Option<MeshOut>,

    /// Print one JSON object on standard output: counts, time step, largest distance, seconds of
    /// work, what the heat method met with, and with --reference the errors; distances are then
    /// written to --output only
    #[arg(verbatim_doc_comment, long)]
    json: bool,

    #[command(flatten)]
    picture: PictureArgs,
}

impl DistanceArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        self.picture.check()?;
        self.field.check()
    }
}

pub(crate) fn run(args: &DistanceArgs) -> Result<()> {
    let (mesh, read) = input::mesh(&args.field.mesh)?;
    let sources = input::sources(&args.field.sources, &mesh)?;
    input::check_targets(args.target.as_slice(), &mesh)?;
    let reference = args.reference.as_deref().map(|path| input::numbers(path, DISTANCE, &mesh)).transpose()?;

    // Errors, the JSON object, the mesh and the picture are about every vertex.
    let is_all_wanted =
        args.json || args.reference.is_some() || args.mesh_out.is_some() || args.picture.picture.is_some();
    let targets = args.target.filter(|_| !is_all_wanted).into_iter().map(Target::Vertex).collect();
    let field = Field::compute(&args.field, &mesh, &sources, targets).map_err(|error| error.to_string())?;

    let picture = draw(args, &mesh, &sources, &field.distances, reference.as_deref())?;
    let errors = reference.map(|reference| Errors::new(&field.distances, &reference));
    let text = match args.target {
        Some(target) => output::lines(&[field.distances[target as usize]]),
        None => output::lines(&field.distances),
    };
    let mesh_out = args.mesh_out.as_ref().map(|out| (&*out.path, out.content(&mesh, &field.distances)));
    let (distances, printed) = match args.output.as_deref() {
        Some(path) => (Some((path, text.into_bytes())), None),
        None => (None, Some(text).filter(|_| !args.json)),
    };
    output::write(&distances.into_iter().chain(mesh_out).chain(picture).collect::<Vec<_>>())?;
    printed.map_or(Ok(()), |text| output::print(&text))?;
    if args.json {
        return output::json(&report(&mesh, &field, read, errors));
    }
    if let Some(Errors { mean_percent, median_percent, max_percent, .. }) = errors {
        eprintln!(
            "mean error {mean_percent:.5} %, median error {median_percent:.5} %, maximum error {max_percent:.5} %"
        );
    }
    Ok(())
}

/// The picture of the distances or, with a reference, of their errors.
fn draw<'a>(
    args: &'a DistanceArgs,
    mesh: &Mesh,
    sources: &[Source],
    distances: &[f64],
    reference: Option<&[f64]>,
) -> Result<Option<Output<'a>>> {
    let places = Places::new(sources, mesh)?;
    let errors = reference.map(|reference| percents(distances, reference));
    let (quantity, values) = match &errors {
        Some(errors) => (Quantity::Error { top: None }, &errors[..]),
        None => (Quantity::Distance, distances),
    };
    let Places { points: sources, lines } = &places;
    args.picture.draw(&Picture { mesh, quantity, values, sources, levels: None, lines })
}

fn report(mesh: &Mesh, field: &Field, read: Seconds, error: Option<Errors>) -> Report {
    let is_finite = |distance: &&f64| distance.is_finite();
    Report {
        vertices: mesh.vertex_count(),
        faces: mesh.triangle_count(),
        time_step: field.time_step,
        largest_distance: field.distances.iter().filter(is_finite).copied().reduce(f64::max),
        unreachable: field.distances.len() - field.distances.iter().filter(is_finite).count(),
        final_radius: Some(field.final_radius).filter(|radius| radius.is_finite()),
        timing: Timing { read, setup: field.setup, solve: field.solve },
        heat: field.heat,
        error,
    }
}
