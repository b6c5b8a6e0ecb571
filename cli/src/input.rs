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

/// The distances of a file that must have one for each vertex of the mesh.
pub(crate) fn distances(path: &Path, mesh: &Mesh) -> Result<Vec<f64>> {
    let distances = numbers::distances(path)?;
    let [given, needed] = [distances.len(), mesh.vertex_count()];
    if given == needed {
        return Ok(distances);
    }
    Err(format!("{}: has {given} distances, but the mesh has {needed} vertices", path.display()))
}
