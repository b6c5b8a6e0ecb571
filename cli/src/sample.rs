//! `taut sample`: vertices spread evenly over the surface.

use crate::Result;
use crate::args::SourceArgs;
use crate::input::{self, Places};
use crate::measured::measured;
use crate::output::{self, Timing};
use crate::picture::{Picture, PictureArgs, Quantity};
use clap::Args;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;
use taut::{Control, ExactOptions, ExactSolver, Mesh, Source};

const EXAMPLES: &str = "\
Examples:
  taut sample bunny.obj --count 100
      100 vertices, one a line, each as far as can be from those before it
  taut sample bunny.obj --count 50 --source 4711 -o samples.txt --picture samples.png
      the same, beginning far from vertex 4711; a file that --sources reads, and a picture

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// Vertices spread evenly over a mesh: farthest point sampling
///
/// Each is the vertex that is farthest, by exact distance along the surface, from the sources and from
/// all before it. Writes one vertex a line, with its distance from these as a comment. Without sources
/// the first vertex of the first triangle is the source, and the first sample.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct SampleArgs {
    /// Mesh file: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    mesh: PathBuf,

    /// How many vertices, at most
    #[arg(long, value_name = "N")]
    count: usize,

    #[command(flatten)]
    sources: SourceArgs,

    /// Write the vertices to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output: each vertex with its distance, null where it is the
    /// first of its part; vertices are then written to --output only
    #[arg(verbatim_doc_comment, long)]
    json: bool,

    #[command(flatten)]
    picture: PictureArgs,
}

impl SampleArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        self.picture.check()
    }
}

pub(crate) fn run(args: &SampleArgs) -> Result<()> {
    let (mesh, read) = input::mesh(&args.mesh)?;
    let given = input::sources(&args.sources, &mesh)?;
    let (solver, setup) = measured("setup", |_| ExactSolver::new(&mesh));
    let solver = solver.map_err(|error| error.to_string())?;
    let (samples, solve) = measured("solve", |control| samples(&solver, &mesh, &given, args.count, control));
    let samples = samples.map_err(|error| error.to_string())?;

    let picture = if args.picture.picture.is_some() {
        let all: Vec<Source> = given.iter().cloned().chain(samples.iter().map(|&(v, _)| Source::vertex(v))).collect();
        let field = solver.field(&all, &ExactOptions::default(), &Control::new()).map_err(|error| error.to_string())?;
        let places = Places::new(&all, &mesh)?;
        let (quantity, sources) = (Quantity::Distance, &places.points[..]);
        let values = field.distances();
        args.picture.draw(&Picture { mesh: &mesh, quantity, values, sources, levels: None, lines: &places.lines })?
    } else {
        None
    };
    let (file, printed) = match args.output.as_deref() {
        Some(path) => (Some((path, lines(&samples).into_bytes())), None),
        None => (None, (!args.json).then(|| lines(&samples))),
    };
    output::write(&file.into_iter().chain(picture).collect::<Vec<_>>())?;
    printed.map_or(Ok(()), |text| output::print(&text))?;
    if !args.json {
        return Ok(());
    }
    let samples = samples.iter().map(|&(vertex, d)| Sample { vertex, distance: Some(d).filter(|d| d.is_finite()) });
    let timing = Timing { read, setup, solve };
    output::json(&Report {
        vertices: mesh.vertex_count(),
        faces: mesh.triangle_count(),
        samples: samples.collect(),
        timing,
    })
}

/// The samples with their distances; without sources the first vertex on the surface is one, infinitely far from nothing.
fn samples(
    solver: &ExactSolver,
    mesh: &Mesh,
    given: &[Source],
    count: usize,
    control: &Control,
) -> taut::Result<Vec<(u32, f64)>> {
    if !given.is_empty() {
        return solver.farthest_points(given, count, control);
    }
    let Some(first) = mesh.triangles().first().map(|triangle| triangle[0]).filter(|_| count > 0) else {
        return Ok(Vec::new());
    };
    let others = solver.farthest_points(&[Source::vertex(first)], count - 1, control)?;
    Ok([(first, f64::INFINITY)].into_iter().chain(others).collect())
}

fn lines(samples: &[(u32, f64)]) -> String {
    let mut text = String::new();
    for (vertex, distance) in samples {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{vertex} # {distance}");
    }
    text
}

/// The object of `--json`, key by key.
#[derive(Debug, Serialize)]
struct Report {
    vertices: usize,
    faces: usize,
    samples: Vec<Sample>,
    timing: Timing,
}

#[derive(Debug, Serialize)]
struct Sample {
    vertex: u32,
    distance: Option<f64>,
}
