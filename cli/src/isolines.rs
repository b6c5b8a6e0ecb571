//! `taut isolines`: lines of equal distance, or of equal value of any field, into a file.

use crate::args::FieldArgs;
use crate::drawing;
use crate::field::Field;
use crate::measured::{Seconds, measured};
use crate::output::{self, Timing};
use crate::picture::{Picture, PictureArgs, Quantity};
use crate::{Cli, Result, input};
use clap::builder::{PathBufValueParser, TypedValueParser as _};
use clap::error::ErrorKind;
use clap::{ArgGroup, Args, CommandFactory as _};
use serde::Serialize;
use std::path::PathBuf;
use taut::{Isoline, Mesh};

const EXAMPLES: &str = "\
Examples:
  taut isolines bunny.obj --source 0 --count 20 --picture lines.png
      twenty lines of equal distance from vertex 0 on the surface, as a picture
  taut isolines bunny.obj --source 0 --count 20 -o lines.svg
      the lines alone, as a drawing
  taut isolines bunny.obj --source 0 --method exact --spacing 0.01 -o lines.obj
      a line at every hundredth of a unit of exact distance, as polylines in space
  taut isolines bunny.obj --values heights.txt --count 9 -o lines.obj
      the lines of a field of your own

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// Lines of equal distance on a mesh, or of equal value of any field
///
/// A line runs where the field, linear in each triangle, takes a level. Triangles that no source
/// reaches have no lines. In the file each level with a line has its own object (.obj) or group
/// (.svg).
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
#[command(group = ArgGroup::new("levels").required(true).args(["count", "spacing"]))]
#[command(group = ArgGroup::new("written").required(true).multiple(true).args(["output", "picture"]))]
pub(crate) struct IsolinesArgs {
    #[command(flatten)]
    field: FieldArgs,

    /// Take the field from this file instead, one number a line for each vertex; inf where there
    /// is none
    #[arg(verbatim_doc_comment, long, value_name = "FILE", conflicts_with_all = ["source", "sources", "method"])]
    values: Option<PathBuf>,

    /// This many levels, evenly spread between the least and the greatest value
    #[arg(long, value_name = "N")]
    count: Option<usize>,

    /// Levels at the multiples of this between the least and the greatest value
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    spacing: Option<f64>,

    /// Write the lines to this file: .obj, polylines in space, or .svg, a flat drawing without
    /// what the surface hides
    #[arg(
        verbatim_doc_comment,
        short,
        long,
        value_name = "FILE",
        value_parser = PathBufValueParser::new().try_map(LinesOut::new)
    )]
    output: Option<LinesOut>,

    /// Print one JSON object on standard output: counts, levels, seconds of work
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    picture: PictureArgs,
}

/// A file to write, and what its name says that it is.
#[derive(Debug, Clone)]
struct LinesOut {
    path: PathBuf,
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Format {
    Obj,
    Svg,
}

impl LinesOut {
    fn new(path: PathBuf) -> std::result::Result<LinesOut, &'static str> {
        let suffix = path.extension().unwrap_or_default().to_ascii_lowercase();
        let format = match suffix.to_str() {
            Some("obj") => Format::Obj,
            Some("svg") => Format::Svg,
            _ => return Err("the name must end in .obj or .svg"),
        };
        Ok(LinesOut { path, format })
    }
}

impl IsolinesArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        let conflict = |message: &str| Err(Cli::command().error(ErrorKind::ArgumentConflict, message));
        let is_drawn = self.output.as_ref().is_some_and(|output| output.format == Format::Svg);
        if let (false, Some(option)) = (is_drawn, self.picture.useless()) {
            return conflict(&format!("{option} belongs to a drawing or picture, and none is asked for"));
        }
        match (&self.values, self.field.heat.first_given().or(self.field.exact.first_given())) {
            (None, _) => self.field.check(),
            (Some(_), Some(option)) => {
                conflict(&format!("{option} is about distances and means nothing with --values"))
            }
            (Some(_), None) => Ok(()),
        }
    }
}

/// The lines of a field, ready to be drawn.
pub(crate) struct Lines {
    /// Ascending.
    pub(crate) levels: Vec<f64>,
    /// In the order of their levels.
    pub(crate) polylines: Vec<Polyline>,
}

/// A line in space.
pub(crate) struct Polyline {
    /// Which of the levels it belongs to.
    pub(crate) level: usize,
    pub(crate) points: Vec<[f64; 3]>,
    /// Whether the last point is joined to the first.
    pub(crate) is_closed: bool,
}

impl Polyline {
    /// Its points, the first again at the end of a closed one.
    pub(crate) fn path(&self) -> impl Iterator<Item = [f64; 3]> {
        let back = self.is_closed.then(|| self.points[0]);
        self.points.iter().copied().chain(back)
    }
}

impl Lines {
    /// The lines of a field at the levels that the options ask for.
    fn new(args: &IsolinesArgs, mesh: &Mesh, values: &[f64]) -> taut::Result<Lines> {
        let levels = match (args.count, args.spacing) {
            (Some(count), _) => taut::even_levels(mesh, values, count)?,
            (None, Some(spacing)) => taut::spaced_levels(mesh, values, spacing)?,
            (None, None) => Vec::new(), // clap asks for one of them
        };
        let polyline = |line: &Isoline| {
            let points = line.curve.positions(mesh)?;
            Ok(Polyline { level: line.level as usize, points, is_closed: line.curve.is_closed })
        };
        let polylines = taut::isolines(mesh, values, &levels)?.iter().map(polyline).collect::<taut::Result<_>>()?;
        Ok(Lines { levels, polylines })
    }

    /// Each level that has lines, and these.
    pub(crate) fn by_level(&self) -> impl Iterator<Item = (f64, &[Polyline])> {
        let same_level = |a: &Polyline, b: &Polyline| a.level == b.level;
        self.polylines.chunk_by(same_level).map(|lines| (self.levels[lines[0].level], lines))
    }
}

pub(crate) fn run(args: &IsolinesArgs) -> Result<()> {
    let sources = input::sources(&args.field)?;
    let (mesh, read) = input::mesh(&args.field.mesh)?;
    let (quantity, values, [setup, solve]) = match &args.values {
        Some(path) => (Quantity::Value, input::numbers(path, "a value", &mesh)?, <[Seconds; 2]>::default()),
        None => {
            let field = Field::compute(&args.field, &mesh, &sources, Vec::new()).map_err(|error| error.to_string())?;
            (Quantity::Distance, field.distances, [field.setup, field.solve])
        }
    };
    let (found, seconds) = measured("lines", |_| Lines::new(args, &mesh, &values));
    let found = found.map_err(|error| error.to_string())?;
    write(
        args,
        &found,
        &Picture {
            mesh: &mesh,
            quantity,
            values: &values,
            sources: &input::places(&sources, &mesh)?,
            levels: Some(&found.levels),
            lines: &[],
        },
    )?;
    if !args.json {
        return Ok(());
    }
    output::json(&Report {
        vertices: mesh.vertex_count(),
        faces: mesh.triangle_count(),
        levels: &found.levels,
        lines: found.polylines.len(),
        closed_lines: found.polylines.iter().filter(|line| line.is_closed).count(),
        points: found.polylines.iter().map(|line| line.points.len()).sum(),
        timing: LinesTiming { field: Timing { read, setup, solve }, lines: seconds },
    })
}

fn write(args: &IsolinesArgs, lines: &Lines, picture: &Picture) -> Result<()> {
    let content = |format| match format {
        Format::Obj => drawing::obj(lines),
        Format::Svg => drawing::svg(lines, picture, &args.picture),
    };
    let lines = args.output.as_ref().map(|LinesOut { path, format }| (&**path, content(*format).into_bytes()));
    output::write(&lines.into_iter().chain(args.picture.draw(picture)?).collect::<Vec<_>>())
}

/// The object of `--json`, key by key.
#[derive(Debug, Serialize)]
struct Report<'a> {
    vertices: usize,
    faces: usize,
    levels: &'a [f64],
    lines: usize,
    closed_lines: usize,
    points: usize,
    timing: LinesTiming,
}

#[derive(Debug, Serialize)]
struct LinesTiming {
    #[serde(flatten)]
    field: Timing,
    lines: Seconds,
}
