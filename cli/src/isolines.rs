//! `taut isolines`: lines of equal distance, or of equal value of any field, into a file.

use crate::args::FieldArgs;
use crate::drawing::{Group, LinesOut, Polyline};
use crate::field::Field;
use crate::input::{self, Places};
use crate::measured::{Seconds, measured};
use crate::output::{self, Timing};
use crate::picture::{Picture, PictureArgs, Quantity};
use crate::{Cli, Result};
use clap::error::ErrorKind;
use clap::{ArgGroup, Args, CommandFactory as _};
use serde::Serialize;
use std::path::PathBuf;
use taut::Mesh;

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
    #[arg(verbatim_doc_comment, long, value_name = "FILE", conflicts_with_all = ["source", "source_at", "sources", "source_curve", "method"])]
    values: Option<PathBuf>,

    /// This many levels, evenly spread between the least and the greatest value
    #[arg(long, value_name = "N")]
    count: Option<usize>,

    /// Levels at the multiples of this between the least and the greatest value
    #[arg(long, value_name = "D", allow_negative_numbers = true)]
    spacing: Option<f64>,

    /// Write the lines to this file: .obj, polylines in space, or .svg, a flat drawing without
    /// what the surface hides
    #[arg(verbatim_doc_comment, short, long, value_name = "FILE", value_parser = LinesOut::parser())]
    output: Option<LinesOut>,

    /// Print one JSON object on standard output: counts, levels, seconds of work
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    picture: PictureArgs,
}

impl IsolinesArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        let conflict = |message: &str| Err(Cli::command().error(ErrorKind::ArgumentConflict, message));
        let is_drawn = self.output.as_ref().is_some_and(LinesOut::is_drawn);
        self.picture.check_beside(is_drawn)?;
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
struct Lines {
    /// Ascending.
    levels: Vec<f64>,
    /// One for each level that has lines.
    groups: Vec<Group>,
}

impl Lines {
    /// The lines of a field at the levels that the options ask for.
    fn new(args: &IsolinesArgs, mesh: &Mesh, values: &[f64]) -> taut::Result<Lines> {
        let levels = match (args.count, args.spacing) {
            (Some(count), _) => taut::even_levels(mesh, values, count)?,
            (None, Some(spacing)) => taut::spaced_levels(mesh, values, spacing)?,
            (None, None) => Vec::new(), // clap asks for one of them
        };
        let lines = taut::isolines(mesh, values, &levels)?;
        let last = levels.len().saturating_sub(1).max(1) as f32;
        let group = |lines: &[taut::Isoline]| {
            let level = lines[0].level;
            let name = format!("level {}", levels[level as usize]);
            let lines = lines.iter().map(|line| Polyline::new(&line.curve, mesh)).collect::<taut::Result<_>>()?;
            Ok(Group { name, shade: level as f32 / last, lines })
        };
        let groups = lines.chunk_by(|a, b| a.level == b.level).map(group).collect::<taut::Result<_>>()?;
        Ok(Lines { levels, groups })
    }

    fn polylines(&self) -> impl Iterator<Item = &Polyline> {
        self.groups.iter().flat_map(|group| &group.lines)
    }
}

pub(crate) fn run(args: &IsolinesArgs) -> Result<()> {
    let (mesh, read) = input::mesh(&args.field.mesh)?;
    let sources = input::sources(&args.field.sources, &mesh)?;
    let (quantity, values, [setup, solve]) = match &args.values {
        Some(path) => (Quantity::Value, input::numbers(path, "a value", &mesh)?, <[Seconds; 2]>::default()),
        None => {
            let field = Field::compute(&args.field, &mesh, &sources, Vec::new()).map_err(|error| error.to_string())?;
            (Quantity::Distance, field.distances, [field.setup, field.solve])
        }
    };
    let (lines, seconds) = measured("lines", |_| Lines::new(args, &mesh, &values));
    let lines = lines.map_err(|error| error.to_string())?;
    let places = Places::new(&sources, &mesh)?;
    let picture = Picture {
        mesh: &mesh,
        quantity,
        values: &values,
        sources: &places.points,
        levels: Some(&lines.levels),
        lines: &places.lines,
    };
    let file = args.output.as_ref().map(|out| (&*out.path, out.content(&lines.groups, &picture, &args.picture)));
    output::write(&file.into_iter().chain(args.picture.draw(&picture)?).collect::<Vec<_>>())?;
    if !args.json {
        return Ok(());
    }
    output::json(&Report {
        vertices: mesh.vertex_count(),
        faces: mesh.triangle_count(),
        levels: &lines.levels,
        lines: lines.polylines().count(),
        closed_lines: lines.polylines().filter(|line| line.is_closed).count(),
        points: lines.polylines().map(|line| line.points.len()).sum(),
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
