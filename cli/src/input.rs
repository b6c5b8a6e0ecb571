//! What the commands read.

use crate::Result;
use crate::args::FieldArgs;
use crate::measured::{Seconds, measured};
use crate::numbers;
use std::path::Path;
use taut::{Mesh, Source};

/// The mesh of a file.
pub(crate) fn read(path: &Path) -> Result<(Mesh, Seconds)> {
    let (mesh, seconds) = measured("read", |_| Mesh::read(path));
    Ok((mesh.map_err(|error| format!("{}: {error}", path.display()))?, seconds))
}

/// The mesh of a file to measure on; warns of triangles that are ignored.
pub(crate) fn mesh(path: &Path) -> Result<(Mesh, Seconds)> {
    let (mesh, seconds) = read(path)?;
    if let [first, ..] = mesh.ignored_triangles() {
        let count = mesh.ignored_triangles().len();
        eprintln!("taut: warning: {count} triangles repeat a vertex and are ignored, the first is triangle {first}");
    }
    Ok((mesh, seconds))
}

/// The sources of a command line.
pub(crate) fn sources(args: &FieldArgs) -> Result<Vec<Source>> {
    match &args.sources {
        Some(path) => numbers::sources(path),
        None => Ok(args.source.iter().map(|&vertex| Source::vertex(vertex)).collect()),
    }
}

/// Where the sources lie.
pub(crate) fn places(sources: &[Source], mesh: &Mesh) -> Result<Vec<[f64; 3]>> {
    sources.iter().map(|source| source.position(mesh).map_err(|error| error.to_string())).collect()
}

/// The numbers of a file that must have one for each vertex of the mesh; `what` each is called in messages.
pub(crate) fn numbers(path: &Path, what: &str, mesh: &Mesh) -> Result<Vec<f64>> {
    let numbers = numbers::numbers(path, what)?;
    let [given, needed] = [numbers.len(), mesh.vertex_count()];
    if given == needed {
        return Ok(numbers);
    }
    Err(format!("{}: has {given} numbers, but the mesh has {needed} vertices", path.display()))
}
