//! `taut isolines`: lines of equal distance, or of equal value of any field, into a file.

use crate::args::FieldArgs;
use crate::drawing::{self, Axis};
use crate::field::Field;
use crate::measured::{Seconds, measured};
use crate::output::{self, Timing};
use crate::{Cli, Result, input};
use clap::builder::{PathBufValueParser, TypedValueParser as _};
use clap::error::ErrorKind;
use clap::{ArgGroup, Args, CommandFactory as _};
use serde::Serialize;
use std::path::PathBuf;
use taut::{Isoline, Mesh};

const EXAMPLES: &str = "\
Examples:
  taut isolines bunny.obj --source 0 --count 20 -o lines.svg
      twenty lines of equal distance from vertex 0, as a drawing
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

    /// Write the lines to this file: .obj, polylines in space, or .svg, a flat drawing
    #[arg(short, long, value_name = "FILE", value_parser = PathBufValueParser::new().try_map(Output::new))]
    output: Output,

    /// Axis along which an .svg looks at the mesh, from its positive end; what is behind shows
    /// through [default: that of the shortest side of the lines' bounding box]
    #[arg(verbatim_doc_comment, long, value_enum)]
    view: Option<Axis>,

    /// Print one JSON object on standard output: counts, levels, seconds of work
    #[arg(long)]
    json: bool,
}

/// A file to write, and what its name says that it is.
#[derive(Debug, Clone)]
struct Output {
    path: PathBuf,
    format: Format,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Format {
    Obj,
    Svg,
}

impl Output {
    fn new(path: PathBuf) -> std::result::Result<Output, &'static str> {
        let suffix = path.extension().unwrap_or_default().to_ascii_lowercase();
        let format = match suffix.to_str() {
            Some("obj") => Format::Obj,
            Some("svg") => Format::Svg,
            _ => return Err("the name must end in .obj or .svg"),
        };
        Ok(Output { path, format })
    }
}

impl IsolinesArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        let conflict = |message: &str| Err(Cli::command().error(ErrorKind::ArgumentConflict, message));
        if self.output.format == Format::Obj && self.view.is_some() {
            return conflict("--view belongs to a drawing and means nothing with an .obj file");
        }
        match (&self.values, self.field.heat.first_given()) {
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
    let (values, [setup, solve]) = match &args.values {
        Some(path) => (input::distances(path, &mesh)?, <[Seconds; 2]>::default()),
        None => {
            let field = Field::compute(&args.field, &mesh, &sources, Vec::new()).map_err(|error| error.to_string())?;
            (field.distances, [field.setup, field.solve])
        }
    };
    let (found, seconds) = measured("lines", |_| Lines::new(args, &mesh, &values));
    let found = found.map_err(|error| error.to_string())?;
    let text = match args.output.format {
        Format::Obj => drawing::obj(&found),
        Format::Svg => drawing::svg(&found, args.view),
    };
    output::write(&[(&args.output.path, text.into_bytes())])?;
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
