//! `taut distance`: reads, computes, and only then writes, so that a failure leaves nothing behind.

use crate::Result;
use crate::args::{DistanceArgs, Method};
use crate::comparison::Errors;
use crate::measured::{Seconds, measured};
use crate::numbers;
use crate::output::{self, Report, Timing};
use std::path::Path;
use taut::{Element, Error, ExactOptions, ExactSolver, HeatSolver, Mesh, Reason, Source};

pub(crate) fn run(args: &DistanceArgs) -> Result<()> {
    let sources = sources(args)?;
    let (mesh, read) = measured("read", |_| Mesh::read(&args.mesh));
    let mesh = mesh.map_err(|error| format!("{}: {error}", args.mesh.display()))?;
    warn_of_ignored(&mesh);
    args.target.map_or(Ok(()), |target| check_target(target, &mesh))?;
    let reference = args.reference.as_deref().map(|path| reference(path, &mesh)).transpose()?;

    let field = match args.method {
        Method::Heat => heat(args, &mesh, &sources),
        Method::Exact => exact(args, &mesh, &sources),
    }
    .map_err(|error| error.to_string())?;

    let errors = reference.map(|reference| Errors::new(&field.distances, &reference));
    write(args, &field.distances)?;
    if args.json {
        return report(&mesh, &field, read, errors).print();
    }
    if let Some(Errors { mean_percent, median_percent, max_percent }) = errors {
        eprintln!(
            "mean error {mean_percent:.5} %, median error {median_percent:.5} %, maximum error {max_percent:.5} %"
        );
    }
    Ok(())
}

/// What a method found, and what it took.
struct Field {
    distances: Vec<f64>,
    time_step: Option<f64>,
    setup: Seconds,
    solve: Seconds,
}

fn heat(args: &DistanceArgs, mesh: &Mesh, sources: &[Source]) -> taut::Result<Field> {
    let options = args.heat.options();
    let (solver, setup) = measured("setup", |control| HeatSolver::new(mesh, &options, control));
    let solver = solver?;
    let (distances, solve) = measured("solve", |control| solver.distances(sources, control));
    Ok(Field { distances: distances?, time_step: Some(solver.time_step()), setup, solve })
}

fn exact(args: &DistanceArgs, mesh: &Mesh, sources: &[Source]) -> taut::Result<Field> {
    // Errors and the JSON object are about every vertex.
    let is_all_wanted = args.json || args.reference.is_some();
    let targets = args.target.filter(|_| !is_all_wanted).into_iter().collect();
    let (solver, setup) = measured("setup", |_| ExactSolver::new(mesh));
    let solver = solver?;
    let options = ExactOptions { targets };
    let (field, solve) = measured("solve", |control| solver.field(sources, &options, control));
    Ok(Field { distances: field?.distances().to_vec(), time_step: None, setup, solve })
}

fn sources(args: &DistanceArgs) -> Result<Vec<Source>> {
    match &args.sources {
        Some(path) => numbers::sources(path),
        None => Ok(args.source.iter().map(|&vertex| Source::vertex(vertex)).collect()),
    }
}

fn warn_of_ignored(mesh: &Mesh) {
    if let [first, ..] = mesh.ignored_triangles() {
        let count = mesh.ignored_triangles().len();
        eprintln!("taut: warning: {count} triangles repeat a vertex and are ignored, the first is triangle {first}");
    }
}

fn check_target(target: u32, mesh: &Mesh) -> Result<()> {
    let vertices = mesh.vertex_count();
    if (target as usize) < vertices {
        return Ok(());
    }
    let message = format!("is vertex {target}, but the mesh has {vertices} vertices");
    Err(Error::at(Reason::VertexOutOfRange, Element::Target(0), message).to_string())
}

fn reference(path: &Path, mesh: &Mesh) -> Result<Vec<f64>> {
    let reference = numbers::distances(path)?;
    let [given, needed] = [reference.len(), mesh.vertex_count()];
    if given == needed {
        return Ok(reference);
    }
    Err(format!("{}: has {given} distances, but the mesh has {needed} vertices", path.display()))
}

/// Writes all distances or the target's to the file or, unless JSON goes there, to standard output.
fn write(args: &DistanceArgs, distances: &[f64]) -> Result<()> {
    let text = match args.target {
        Some(target) => output::lines(&[distances[target as usize]]),
        None => output::lines(distances),
    };
    match &args.output {
        Some(path) => output::write(path, &text),
        None if args.json => Ok(()),
        None => output::print(&text),
    }
}

fn report(mesh: &Mesh, field: &Field, read: Seconds, error: Option<Errors>) -> Report {
    let is_finite = |distance: &&f64| distance.is_finite();
    Report {
        vertices: mesh.vertex_count(),
        faces: mesh.triangle_count(),
        time_step: field.time_step,
        largest_distance: field.distances.iter().filter(is_finite).copied().reduce(f64::max),
        unreachable: field.distances.len() - field.distances.iter().filter(is_finite).count(),
        timing: Timing { read, setup: field.setup, solve: field.solve },
        error,
    }
}
