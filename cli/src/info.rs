//! `taut info`: what a mesh is and what is unusual about it, for people or as JSON.

use crate::output;
use crate::{Result, input};
use clap::Args;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::PathBuf;
use taut::{Angle, Component, Mesh, MeshReport, Properties, TimeFormula, TimeScale, TimeStep};
use taut_eval::FORMULAS;

const EXAMPLES: &str = "\
Examples:
  taut info scan.ply
      what a person wants to know before measuring on this mesh
  taut info scan.ply --json
      the same with all indices, for a program

Exit code: 0 success, 1 failure, 2 a command line that makes no sense.";

/// Diagnosis of a mesh: its parts, holes, defects, edge lengths, angles and time steps
///
/// Every mesh can be measured on, whatever stands here; but a distance that surprises often has
/// its reason in one of these lines. Vertices and faces count from 0; lengths are in the units of
/// the mesh, a time step t in their square.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, verbatim_doc_comment)]
pub(crate) struct InfoArgs {
    /// Mesh file: .obj, .off or .ply, also with .gz behind it
    mesh: PathBuf,

    /// Print one JSON object with every index of every list
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &InfoArgs) -> Result<()> {
    let mesh = input::read(&args.mesh)?.0;
    let report = MeshReport::new(&mesh);
    let properties = Properties::of(&mesh);
    if args.json {
        return output::json(&Object::new(&mesh, &report, properties.as_ref()));
    }
    output::print(&text(&mesh, &report, properties.as_ref()))
}

/// t by a formula, in mesh units squared; None where the formula says nothing about this mesh.
fn time_step(mesh: &Mesh, formula: TimeFormula, scale: TimeScale) -> Option<f64> {
    TimeStep::Formula { formula, scale, factor: 1.0 }.value(mesh).ok()
}

// For people.

fn text(mesh: &Mesh, report: &MeshReport, properties: Option<&Properties>) -> String {
    let mut text = String::new();
    let mut line = |head: &str, tail: &str| {
        let _ = writeln!(text, "{head:<24}{tail}"); // writing to a string cannot fail
    };
    let edges = properties.map_or(0, |properties| properties.edges);
    let counts = [(mesh.vertex_count(), "vertices"), (edges, "edges"), (mesh.triangle_count(), "triangles")];
    line("mesh", &counts.map(|(count, what)| format!("{count} {what}")).join(", "));
    components(report, &mut line);
    line("boundary loops", &boundary(report));
    for Finding { name, list, meaning } in findings(report) {
        let tail = if list.count == 0 { "none".to_owned() } else { format!("{}; {meaning}", list.text()) };
        line(name, &tail);
    }
    if let (Some(smallest), Some(largest)) = (report.smallest_angle, report.largest_angle) {
        line("angles", &format!("{} to {}", angle(smallest), angle(largest)));
    }
    if let Some(properties) = properties {
        lengths(mesh, properties, &mut line);
    }
    text
}

fn components(report: &MeshReport, line: &mut impl FnMut(&str, &str)) {
    const SHOWN: usize = 5;
    line("components", &report.components.len().to_string());
    for (i, component) in report.components.iter().take(SHOWN).enumerate() {
        line(&format!("  component {i}"), &describe(component));
    }
    if report.components.len() > SHOWN {
        line("", &format!("and {} more", report.components.len() - SHOWN));
    }
}

fn describe(component: &Component) -> String {
    let mut text = format!("{} triangles from vertex {}", component.faces, component.first_vertex);
    text += match (component.is_manifold, component.is_orientable) {
        (true, true) => "",
        (true, false) => ", not orientable",
        (false, true) => ", not manifold",
        (false, false) => ", not manifold, not orientable",
    };
    if let Some(genus) = component.genus() {
        let _ = write!(text, ", genus {genus}");
    }
    match component.boundary_loops {
        0 => text,
        1 => text + ", 1 boundary loop",
        loops => format!("{text}, {loops} boundary loops"),
    }
}

fn boundary(report: &MeshReport) -> String {
    let chains = &report.boundary_loops;
    if chains.is_empty() {
        return "none: closed".to_owned();
    }
    let open = chains.iter().filter(|chain| !chain.is_closed).count();
    let longest = chains.iter().max_by_key(|chain| chain.vertices.len()).map_or(0, |chain| chain.vertices.len());
    let open = if open == 0 { String::new() } else { format!("; {open} of them end at non-manifold edges") };
    format!("{}; the longest has {longest} vertices{open}", chains.len())
}

fn angle(angle: Angle) -> String {
    format!("{:.4}° (face {}, vertex {})", angle.radians.to_degrees(), angle.face, angle.vertex)
}

fn lengths(mesh: &Mesh, properties: &Properties, line: &mut impl FnMut(&str, &str)) {
    let Properties { mean_edge, sigma_edge, min_edge, max_edge, anisotropy, paper_scale, .. } = *properties;
    let spread = format!("mean {mean_edge:.6e}, σ {sigma_edge:.6e}, from {min_edge:.6e} to {max_edge:.6e}");
    line("edge lengths", &spread);
    line("anisotropy", &format!("{anisotropy:.4}"));
    line("paper scale", &format!("{paper_scale:.6e}"));
    line("time step t", "at the paper's size    on the numbers as they stand");
    for (name, formula) in FORMULAS {
        let [paper, raw] = [TimeScale::Paper, TimeScale::Raw].map(|scale| {
            time_step(mesh, formula, scale).map_or("says nothing here".to_owned(), |t| format!("{t:.6e}"))
        });
        line(&format!("  {name}"), &format!("{paper:<22} {raw}"));
    }
}

/// One kind of unusual elements, what it is called and what it means for distances.
struct Finding {
    name: &'static str,
    list: List,
    meaning: &'static str,
}

/// A list as it is told: how many entries it has, and the first few.
struct List {
    count: usize,
    first: Vec<String>,
}

impl List {
    fn new<T: Copy>(entries: &[T], show: impl Fn(T) -> String) -> List {
        const SHOWN: usize = 5;
        List { count: entries.len(), first: entries.iter().take(SHOWN).map(|&entry| show(entry)).collect() }
    }

    fn of(entries: &[u32]) -> List {
        List::new(entries, |i| i.to_string())
    }

    fn edges(entries: &[[u32; 2]]) -> List {
        List::new(entries, |[a, b]| format!("{a}-{b}"))
    }

    fn copies(entries: &[[u32; 2]]) -> List {
        List::new(entries, |[copy, of]| format!("{copy} as {of}"))
    }

    fn text(&self) -> String {
        let more = if self.count > self.first.len() { ", …" } else { "" };
        format!("{}: {}{more}", self.count, self.first.join(", "))
    }
}

fn findings(report: &MeshReport) -> [Finding; 9] {
    let finding = |name, list, meaning| Finding { name, list, meaning };
    [
        finding(
            "one-sided components",
            List::of(&report.nonorientable_components()),
            "no choice of sides suits all their triangles",
        ),
        finding(
            "non-manifold edges",
            List::edges(&report.nonmanifold_edges),
            "ways lead from each triangle to all others",
        ),
        finding(
            "non-manifold vertices",
            List::of(&report.nonmanifold_vertices),
            "parts touch in a point, and ways lead through it",
        ),
        finding(
            "inconsistent edges",
            List::edges(&report.inconsistent_edges),
            "a neighbour is turned over, which changes no distance",
        ),
        finding("zero-area faces", List::of(&report.zero_area_faces), "ways lead along their edges"),
        finding("repeated-index faces", List::of(&report.repeated_index_faces), "ignored"),
        finding("duplicate faces", List::copies(&report.duplicate_faces), "ways lead over one as over the other"),
        finding("duplicate vertices", List::copies(&report.duplicate_vertices), "the surface is cut where they lie"),
        finding("unreferenced vertices", List::of(&report.unreferenced_vertices), "out of reach"),
    ]
}

// For programs.

#[derive(Serialize)]
struct Object<'a> {
    properties: Option<PropertiesObject>,
    /// t of each formula, in both units; null where a formula says nothing about the mesh.
    time_steps: BTreeMap<&'static str, TimeSteps>,
    components: Vec<ComponentObject>,
    boundary_loops: Vec<LoopObject<'a>>,
    nonmanifold_edges: &'a [[u32; 2]],
    nonmanifold_vertices: &'a [u32],
    inconsistent_edges: &'a [[u32; 2]],
    zero_area_faces: &'a [u32],
    repeated_index_faces: &'a [u32],
    duplicate_faces: &'a [[u32; 2]],
    duplicate_vertices: &'a [[u32; 2]],
    unreferenced_vertices: &'a [u32],
    smallest_angle: Option<AngleObject>,
    largest_angle: Option<AngleObject>,
}

#[derive(Serialize)]
struct TimeSteps {
    paper: Option<f64>,
    raw: Option<f64>,
}

#[derive(Serialize)]
struct ComponentObject {
    first_vertex: u32,
    vertices: u32,
    edges: u32,
    faces: u32,
    boundary_loops: u32,
    manifold: bool,
    orientable: bool,
    euler_characteristic: i64,
    genus: Option<u32>,
}

#[derive(Serialize)]
struct LoopObject<'a> {
    closed: bool,
    vertices: &'a [u32],
}

#[derive(Serialize)]
struct AngleObject {
    degrees: f64,
    face: u32,
    vertex: u32,
}

#[derive(Serialize)]
struct PropertiesObject {
    vertices: usize,
    edges: usize,
    faces: usize,
    mean_edge: f64,
    variance_edge: f64,
    sigma_edge: f64,
    mean_absolute_deviation: f64,
    median_absolute_deviation: f64,
    min_edge: f64,
    max_edge: f64,
    edge_ratio: f64,
    q1: f64,
    q2: f64,
    q3: f64,
    quartile_deviation: f64,
    min_angle_deg: f64,
    max_angle_deg: f64,
    anisotropy: f64,
    paper_scale: f64,
}

impl<'a> Object<'a> {
    fn new(mesh: &Mesh, report: &'a MeshReport, properties: Option<&Properties>) -> Object<'a> {
        let steps = |formula| TimeSteps {
            paper: time_step(mesh, formula, TimeScale::Paper),
            raw: time_step(mesh, formula, TimeScale::Raw),
        };
        let chain = |chain: &'a taut::BoundaryLoop| LoopObject { closed: chain.is_closed, vertices: &chain.vertices };
        Object {
            properties: properties.map(PropertiesObject::new),
            time_steps: FORMULAS.map(|(name, formula)| (name, steps(formula))).into(),
            components: report.components.iter().map(ComponentObject::new).collect(),
            boundary_loops: report.boundary_loops.iter().map(chain).collect(),
            nonmanifold_edges: &report.nonmanifold_edges,
            nonmanifold_vertices: &report.nonmanifold_vertices,
            inconsistent_edges: &report.inconsistent_edges,
            zero_area_faces: &report.zero_area_faces,
            repeated_index_faces: &report.repeated_index_faces,
            duplicate_faces: &report.duplicate_faces,
            duplicate_vertices: &report.duplicate_vertices,
            unreferenced_vertices: &report.unreferenced_vertices,
            smallest_angle: report.smallest_angle.map(AngleObject::new),
            largest_angle: report.largest_angle.map(AngleObject::new),
        }
    }
}

impl ComponentObject {
    fn new(component: &Component) -> ComponentObject {
        let &Component { first_vertex, vertices, edges, faces, boundary_loops, is_manifold, is_orientable } = component;
        ComponentObject {
            first_vertex,
            vertices,
            edges,
            faces,
            boundary_loops,
            manifold: is_manifold,
            orientable: is_orientable,
            euler_characteristic: component.euler_characteristic(),
            genus: component.genus(),
        }
    }
}

impl AngleObject {
    fn new(angle: Angle) -> AngleObject {
        AngleObject { degrees: angle.radians.to_degrees(), face: angle.face, vertex: angle.vertex }
    }
}

impl PropertiesObject {
    fn new(properties: &Properties) -> PropertiesObject {
        PropertiesObject {
            vertices: properties.vertices,
            edges: properties.edges,
            faces: properties.faces,
            mean_edge: properties.mean_edge,
            variance_edge: properties.variance_edge,
            sigma_edge: properties.sigma_edge,
            mean_absolute_deviation: properties.mean_absolute_deviation,
            median_absolute_deviation: properties.median_absolute_deviation,
            min_edge: properties.min_edge,
            max_edge: properties.max_edge,
            edge_ratio: properties.edge_ratio,
            q1: properties.q1,
            q2: properties.q2,
            q3: properties.q3,
            quartile_deviation: properties.quartile_deviation,
            min_angle_deg: properties.min_angle.to_degrees(),
            max_angle_deg: properties.max_angle.to_degrees(),
            anisotropy: properties.anisotropy,
            paper_scale: properties.paper_scale,
        }
    }
}
