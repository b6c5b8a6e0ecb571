//! `taut path`: shortest paths over the surface, from targets back to their nearest sources, and paths down any field.

use crate::args::{ExactArgs, HeatArgs, Method, SourceArgs, check_method, position};
use crate::drawing::{Group, LinesOut, Polyline};
use crate::field::{exact_field, heat_field};
use crate::input::{self, Places};
use crate::measured::{Seconds, measured};
use crate::output::{self, Timing};
use crate::picture::{Picture, PictureArgs, Quantity};
use crate::{Cli, Result};
use clap::error::ErrorKind;
use clap::{ArgGroup, Args, CommandFactory as _};
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;
use taut::{Control, Curve, DescentPath, ExactField, ExactOptions, Mesh, Source, SurfacePoint, Target};

const EXAMPLES: &str = "\
Examples:
  taut path bunny.obj --source 0 --target 4711
      the points of the shortest path from vertex 4711 to vertex 0, on standard output
  taut path bunny.obj --source-at 0,1,0 --target-at 1,0,0.5 -o path.obj
      the path between the places of the surface nearest to two points, as a polyline in space
  taut path bunny.obj --source 0 --source 99 --target 4711 --target 15 --picture paths.png
      the path from each of two targets to the source that is nearer, as a picture
  taut path bunny.obj --source 0 --target 4711 --method heat
      the path down the distances by heat, much faster and a little longer
  taut path bunny.obj --values heights.txt --target 4711
      the path down a field of your own

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// Shortest paths on a mesh, from each target back to its nearest source
///
/// Paths are exact, as long as the exact distance; those by heat follow steepest descent, and so do
/// those down a field of --values, to where it has a minimum. For each target, vertices before
/// points, a comment tells the path's source, or `no source` where it ends at another minimum, and
/// its length; then its points follow, down from the target, one `x y z` a line. An empty line
/// separates targets. One that no source reaches has a comment only. Vertices, sources and targets
/// count from 0, sources vertices before points.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
#[command(group = ArgGroup::new("targets").required(true).multiple(true).args(["target", "target_at"]))]
pub(crate) struct PathArgs {
    /// Mesh file: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    mesh: PathBuf,

    #[command(flatten)]
    sources: SourceArgs,

    /// Follow the field of this file down instead, one number a line for each vertex; inf where
    /// there is none
    #[arg(verbatim_doc_comment, long, value_name = "FILE", conflicts_with_all = ["source", "source_at", "sources", "source_curve", "method"])]
    values: Option<PathBuf>,

    /// How paths are found: by heat they follow steepest descent
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    method: Method,

    /// Target vertex; may be given several times
    #[arg(long, value_name = "V")]
    target: Vec<u32>,

    /// Target on the surface where it is nearest to this point; may be given several times
    #[arg(long, value_name = "X,Y,Z", value_parser = position, allow_hyphen_values = true)]
    target_at: Vec<[f64; 3]>,

    /// Write the paths to this file instead of standard output: .obj, polylines in space, or .svg,
    /// a flat drawing without what the surface hides
    #[arg(verbatim_doc_comment, short, long, value_name = "FILE", value_parser = LinesOut::parser())]
    output: Option<LinesOut>,

    /// Print one JSON object on standard output: for each target its source, distance (with --values
    /// the field's value), length and points, each by its triangle, the weights of the corners, and
    /// its position
    #[arg(verbatim_doc_comment, long)]
    json: bool,

    #[command(flatten)]
    heat: HeatArgs,

    #[command(flatten)]
    exact: ExactArgs,

    #[command(flatten)]
    picture: PictureArgs,
}

impl PathArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        let is_drawn = self.output.as_ref().is_some_and(LinesOut::is_drawn);
        self.picture.check_beside(is_drawn)?;
        match (&self.values, self.heat.first_given().or(self.exact.first_given())) {
            (None, _) => {
                self.sources.check()?;
                check_method(self.method, &self.heat, &self.exact)
            }
            (Some(_), Some(option)) => {
                let message = format!("{option} is about distances and means nothing with --values");
                Err(Cli::command().error(ErrorKind::ArgumentConflict, message))
            }
            (Some(_), None) => Ok(()),
        }
    }
}

/// A path from a target.
struct Path {
    /// The number of its source; None where it ends at another minimum.
    source: Option<u32>,
    /// The distance of the target, or the field's value there.
    distance: f64,
    curve: Curve,
    /// Where its points lie.
    positions: Vec<[f64; 3]>,
}

/// A field and the paths down it.
struct Found {
    quantity: Quantity,
    values: Vec<f64>,
    /// One for each target; `None` where the field is not finite.
    paths: Vec<Option<Path>>,
    /// Of set-up, solve and paths.
    seconds: [Seconds; 3],
}

impl Path {
    fn length(&self) -> f64 {
        let step = |ends: &[[f64; 3]]| {
            let [x, y, z] = [0, 1, 2].map(|axis| ends[1][axis] - ends[0][axis]);
            x.hypot(y).hypot(z)
        };
        0.0 + self.positions.windows(2).map(step).sum::<f64>() // the sum of nothing is -0
    }
}

pub(crate) fn run(args: &PathArgs) -> Result<()> {
    let (mesh, read) = input::mesh(&args.mesh)?;
    let sources = input::sources(&args.sources, &mesh)?;
    input::check_targets(&args.target, &mesh)?;
    let points = input::nearest(&args.target_at, &mesh)?;
    let vertices = args.target.iter().copied().map(Target::Vertex);
    let targets: Vec<Target> = vertices.chain(points.into_iter().map(Target::Point)).collect();

    let found = match (&args.values, args.method) {
        (Some(path), _) => {
            let values = input::numbers(path, "a value", &mesh)?;
            by_descent(Quantity::Value, values, <[Seconds; 2]>::default(), &mesh, &[], &targets)
        }
        (None, Method::Heat) => by_heat(args, &mesh, &sources, &targets),
        (None, Method::Exact) => by_windows(args, &mesh, &sources, &targets),
    };
    let found = found.map_err(|error| error.to_string())?;

    write(args, &mesh, &found, Places::new(&sources, &mesh)?)?;
    if args.json {
        let [setup, solve, paths] = found.seconds;
        let timing = PathTiming { field: Timing { read, setup, solve }, paths };
        return output::json(&Report::new(&mesh, &found.paths, timing));
    }
    if args.output.is_none() { output::print(&text(&found.paths)) } else { Ok(()) }
}

fn by_heat(args: &PathArgs, mesh: &Mesh, sources: &[Source], targets: &[Target]) -> taut::Result<Found> {
    let (_, field, seconds) = heat_field(&args.heat, mesh, sources)?;
    by_descent(Quantity::Distance, field.into_distances(), seconds, mesh, sources, targets)
}

/// The paths down a field that comes from these sources and took these seconds.
fn by_descent(
    quantity: Quantity,
    values: Vec<f64>,
    [setup, solve]: [Seconds; 2],
    mesh: &Mesh,
    sources: &[Source],
    targets: &[Target],
) -> taut::Result<Found> {
    let (found, paths) = measured("paths", |control| taut::descent_paths(mesh, &values, sources, targets, control));
    let path = |found: Option<DescentPath>| {
        let Some(DescentPath { curve, source }) = found else { return Ok(None) };
        let positions = curve.positions(mesh)?;
        Ok(Some(Path { source, distance: value(&values, &curve.points[0], mesh), curve, positions }))
    };
    let found = found?.into_iter().map(path).collect::<taut::Result<_>>()?;
    Ok(Found { quantity, values, paths: found, seconds: [setup, solve, paths] })
}

/// The value of a field at a point where it is finite.
fn value(values: &[f64], point: &SurfacePoint, mesh: &Mesh) -> f64 {
    let corners = mesh.triangles()[point.face as usize].into_iter().zip(point.barycentric);
    corners.filter(|&(_, weight)| weight != 0.0).map(|(v, weight)| weight * values[v as usize]).sum()
}

fn by_windows(args: &PathArgs, mesh: &Mesh, sources: &[Source], targets: &[Target]) -> taut::Result<Found> {
    let keep_windows = targets.iter().any(|target| matches!(target, Target::Point(_)));
    let wanted = if args.picture.picture.is_none() { targets.to_vec() } else { Vec::new() };
    let options = ExactOptions { targets: wanted, keep_windows, ..args.exact.options() };
    let (field, [setup, solve]) = exact_field(&args.exact, mesh, sources, &options)?;
    let (found, paths) = measured("paths", |control| exact_paths(&field, mesh, targets, control));
    let values = field.distances().to_vec();
    Ok(Found { quantity: Quantity::Distance, values, paths: found?, seconds: [setup, solve, paths] })
}

/// The path of each target; `None` where no source reaches.
fn exact_paths(
    field: &ExactField,
    mesh: &Mesh,
    targets: &[Target],
    control: &Control,
) -> taut::Result<Vec<Option<Path>>> {
    let path = |(&target, curve): (&Target, Option<Curve>)| {
        let (source, Some(curve)) = (field.nearest_source(target)?, curve) else { return Ok(None) };
        let positions = curve.positions(mesh)?;
        Ok(Some(Path { source, distance: field.distance(target)?, curve, positions }))
    };
    targets.iter().zip(field.paths(targets, control)?).map(path).collect()
}

/// Writes the files that are asked for.
fn write(args: &PathArgs, mesh: &Mesh, found: &Found, from: Places) -> Result<()> {
    let Places { points: mut ends, mut lines } = from;
    ends.extend(found.paths.iter().flatten().map(|path| path.positions[0]));
    lines.extend(found.paths.iter().flatten().map(|path| path.positions.clone()));
    let picture =
        Picture { mesh, quantity: found.quantity, values: &found.values, sources: &ends, levels: None, lines: &lines };
    let group = |(target, path): (usize, &Option<Path>)| {
        let points = path.as_ref()?.positions.clone();
        Some(Group { name: format!("target {target}"), shade: 1.0, lines: vec![Polyline { points, is_closed: false }] })
    };
    let groups: Vec<Group> = found.paths.iter().enumerate().filter_map(group).collect();
    let file = args.output.as_ref().map(|out| (&*out.path, out.content(&groups, &picture, &args.picture)));
    output::write(&file.into_iter().chain(args.picture.draw(&picture)?).collect::<Vec<_>>())
}

fn text(paths: &[Option<Path>]) -> String {
    let mut text = String::new();
    // Writing to a string cannot fail.
    for (target, path) in paths.iter().enumerate() {
        let gap = if target > 0 { "\n" } else { "" };
        let Some(path) = path else {
            let _ = writeln!(text, "{gap}# target {target}: no path");
            continue;
        };
        let source = path.source.map_or("no source".to_owned(), |source| format!("source {source}"));
        let _ = writeln!(text, "{gap}# target {target}: {source}, length {}", path.length());
        for [x, y, z] in &path.positions {
            let _ = writeln!(text, "{x} {y} {z}");
        }
    }
    text
}

/// The object of `--json`, key by key.
#[derive(Debug, Serialize)]
struct Report {
    vertices: usize,
    faces: usize,
    /// One for each target; null where no source reaches.
    paths: Vec<Option<PathReport>>,
    timing: PathTiming,
}

#[derive(Debug, Serialize)]
struct PathReport {
    /// null where the path ends at another minimum.
    source: Option<u32>,
    distance: f64,
    length: f64,
    points: Vec<PointReport>,
}

#[derive(Debug, Serialize)]
struct PointReport {
    face: u32,
    barycentric: [f64; 3],
    position: [f64; 3],
}

#[derive(Debug, Serialize)]
struct PathTiming {
    #[serde(flatten)]
    field: Timing,
    paths: Seconds,
}

impl Report {
    fn new(mesh: &Mesh, paths: &[Option<Path>], timing: PathTiming) -> Report {
        let point = |(point, &position): (&SurfacePoint, &[f64; 3])| PointReport {
            face: point.face,
            barycentric: point.barycentric,
            position,
        };
        let path = |path: &Path| PathReport {
            source: path.source,
            distance: path.distance,
            length: path.length(),
            points: path.curve.points.iter().zip(&path.positions).map(point).collect(),
        };
        let paths = paths.iter().map(|found| found.as_ref().map(path)).collect();
        Report { vertices: mesh.vertex_count(), faces: mesh.triangle_count(), paths, timing }
    }
}
