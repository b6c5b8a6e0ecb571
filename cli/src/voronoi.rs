//! `taut voronoi`: the nearest source of each vertex, and the cells of the surface that belong to each.

use crate::Result;
use crate::args::{ExactArgs, HeatArgs, Method, SourceArgs, check_method};
use crate::cells::Cells;
use crate::field::{exact_field, heat_field};
use crate::input::{self, Places};
use crate::measured::{Seconds, measured};
use crate::output::{self, Output, Timing};
use crate::picture::{CELL_COLOURS, Picture, PictureArgs, Quantity};
use clap::Args;
use serde::Serialize;
use std::fmt::Write as _;
use std::path::PathBuf;
use taut::{ExactField, ExactOptions, Mesh, Source};

const EXAMPLES: &str = "\
Examples:
  taut voronoi bunny.obj --source 0 --source 99 --source 4711
      for each vertex 0, 1 or 2, whichever of the three is nearest, on standard output
  taut voronoi bunny.obj --sources seeds.txt -o nearest.txt --picture cells.png
      the same for a file of sources, and the cells in colours
  taut voronoi bunny.obj --sources seeds.txt --json
      how many vertices and how much area each cell has
  taut voronoi bunny.obj --sources seeds.txt --method heat
      by the heat method, approximately

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// The nearest source of each vertex of a mesh: a Voronoi diagram on the surface
///
/// Writes one number a line, in the order of the vertices: that of the source, from 0, those of
/// --source before those of --source-at, or by the lines of the file; -1 where no source reaches. A
/// start distance counts as part of the way. Cells are cut where two sources are equally near, by heat
/// in the middle of each edge between two cells.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct VoronoiArgs {
    /// Mesh file: .glb, .obj, .off, .ply or .stl, also with .gz behind it
    mesh: PathBuf,

    #[command(flatten)]
    sources: SourceArgs,

    /// How distances are found
    #[arg(long, value_enum, default_value_t = Method::Exact)]
    method: Method,

    /// Write the numbers to this file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output: for each source the vertices and the area of its
    /// cell; numbers are then written to --output only
    #[arg(verbatim_doc_comment, long)]
    json: bool,

    #[command(flatten)]
    heat: HeatArgs,

    #[command(flatten)]
    exact: ExactArgs,

    #[command(flatten)]
    picture: PictureArgs,
}

impl VoronoiArgs {
    /// Refuses what clap cannot see by itself.
    pub(crate) fn check(&self) -> std::result::Result<(), clap::Error> {
        self.picture.check()?;
        self.sources.check()?;
        check_method(self.method, &self.heat, &self.exact)
    }

    /// Vertices alone need no cells.
    fn wants_cells(&self) -> bool {
        self.json || self.picture.picture.is_some()
    }
}

/// What a method found.
struct Found {
    /// The nearest source of each vertex.
    nearest: Vec<Option<u32>>,
    cells: Option<Cells>,
    /// Of set-up, solve and cells.
    seconds: [Seconds; 3],
}

pub(crate) fn run(args: &VoronoiArgs) -> Result<()> {
    let (mesh, read) = input::mesh(&args.mesh)?;
    let sources = input::sources(&args.sources, &mesh)?;
    let found = match args.method {
        Method::Heat => by_heat(args, &mesh, &sources),
        Method::Exact => by_windows(args, &mesh, &sources),
    };
    let Found { nearest, cells, seconds: [setup, solve, seconds] } = found.map_err(|error| error.to_string())?;

    let picture = cells.as_ref().map(|cells| draw(args, cells, &mesh, &sources)).transpose()?.flatten();
    let (file, printed) = match args.output.as_deref() {
        Some(path) => (Some((path, lines(&nearest).into_bytes())), None),
        None => (None, (!args.json).then(|| lines(&nearest))),
    };
    output::write(&file.into_iter().chain(picture).collect::<Vec<_>>())?;
    printed.map_or(Ok(()), |text| output::print(&text))?;
    let Some(cells) = cells.filter(|_| args.json) else { return Ok(()) };
    let timing = CellTiming { field: Timing { read, setup, solve }, cells: seconds };
    output::json(&Report::new(&mesh, &nearest, cells.areas(sources.len()), timing))
}

fn by_heat(args: &VoronoiArgs, mesh: &Mesh, sources: &[Source]) -> taut::Result<Found> {
    let (_, field, [setup, solve]) = heat_field(&args.heat, mesh, sources)?;
    let (found, seconds) = measured("cells", |_| cells(args, mesh, field.nearest_sources(), None));
    let (nearest, cells) = found?;
    Ok(Found { nearest, cells, seconds: [setup, solve, seconds] })
}

fn by_windows(args: &VoronoiArgs, mesh: &Mesh, sources: &[Source]) -> taut::Result<Found> {
    let options = ExactOptions { keep_windows: args.wants_cells(), ..args.exact.options() };
    let (field, [setup, solve]) = exact_field(&args.exact, mesh, sources, &options)?;
    let (found, seconds) = measured("cells", |_| cells(args, mesh, field.nearest_sources().collect(), Some(&field)));
    let (nearest, cells) = found?;
    Ok(Found { nearest, cells, seconds: [setup, solve, seconds] })
}

/// Nearest sources with their cells, if these are wanted.
fn cells(
    args: &VoronoiArgs,
    mesh: &Mesh,
    nearest: Vec<Option<u32>>,
    field: Option<&ExactField>,
) -> taut::Result<(Vec<Option<u32>>, Option<Cells>)> {
    let cells = args.wants_cells().then(|| Cells::new(mesh, &nearest, field)).transpose()?;
    Ok((nearest, cells))
}

/// One number a line, -1 for none.
fn lines(nearest: &[Option<u32>]) -> String {
    let mut text = String::new();
    for source in nearest {
        // Writing to a string cannot fail.
        let _ = match source {
            Some(source) => writeln!(text, "{source}"),
            None => writeln!(text, "-1"),
        };
    }
    text
}

fn draw<'a>(args: &'a VoronoiArgs, cells: &Cells, mesh: &Mesh, sources: &[Source]) -> Result<Option<Output<'a>>> {
    let cut = cells.mesh().map_err(|error| error.to_string())?;
    let colours = cells.colours(sources.len(), CELL_COLOURS);
    let colour = |source: &Option<u32>| source.map_or(f64::NAN, |source| colours[source as usize] as f64);
    let places = Places::new(sources, mesh)?;
    args.picture.draw(&Picture {
        mesh: &cut,
        quantity: Quantity::Cell,
        values: &cells.nearest.iter().map(colour).collect::<Vec<_>>(),
        sources: &places.points,
        levels: None,
        lines: &places.lines,
    })
}

/// The object of `--json`, key by key.
#[derive(Debug, Serialize)]
struct Report {
    vertices: usize,
    faces: usize,
    unreachable: usize,
    /// One for each source.
    cells: Vec<Cell>,
    timing: CellTiming,
}

#[derive(Debug, Serialize)]
struct Cell {
    vertices: usize,
    /// In mesh units squared.
    area: f64,
}

#[derive(Debug, Serialize)]
struct CellTiming {
    #[serde(flatten)]
    field: Timing,
    cells: Seconds,
}

impl Report {
    fn new(mesh: &Mesh, nearest: &[Option<u32>], areas: Vec<f64>, timing: CellTiming) -> Report {
        let mut cells: Vec<Cell> = areas.into_iter().map(|area| Cell { vertices: 0, area }).collect();
        for &source in nearest.iter().flatten() {
            cells[source as usize].vertices += 1;
        }
        let unreachable = nearest.iter().filter(|source| source.is_none()).count();
        Report { vertices: mesh.vertex_count(), faces: mesh.triangle_count(), unreachable, cells, timing }
    }
}
