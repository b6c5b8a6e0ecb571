//! A mesh to be evaluated, and from where distances on it are measured.

use crate::error::{Error, Result};
use crate::paper;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use taut::Mesh;

/// A mesh with a name and a source.
#[derive(Debug, Clone)]
pub struct Model {
    /// What it is called in tables: its file's name without what says how it is written.
    pub name: String,
    /// Its triangles.
    pub mesh: Mesh,
    /// The vertex distances are measured from.
    pub source: u32,
}

impl Model {
    /// The mesh of a file, with `source`, or else the one that [`Model::obj`] wrote into it, or else the
    /// [default source](Model::default_source).
    ///
    /// # Errors
    /// [`Error::Model`] if the mesh cannot be read; [`Error::Input`] if it has no triangle, or does not have the source.
    pub fn read(path: &Path, source: Option<u32>) -> Result<Model> {
        let mesh = Mesh::read(path).map_err(Error::of_model(&path.display().to_string()))?;
        Model::new(name(path), mesh, source.or_else(|| written_source(path)))
    }

    /// A mesh with `source` or else the [default source](Model::default_source).
    ///
    /// # Errors
    /// [`Error::Input`] if it has no triangle, or does not have the source.
    pub fn new(name: String, mesh: Mesh, source: Option<u32>) -> Result<Model> {
        let source = source.or_else(|| Model::default_source(&mesh));
        match source {
            None => Err(Error::Input(format!("{name}: has no triangle to measure on"))),
            Some(v) if v as usize >= mesh.vertex_count() => {
                let vertices = mesh.vertex_count();
                Err(Error::Input(format!("{name}: the source is vertex {v}, but the mesh has {vertices} vertices")))
            }
            Some(source) => Ok(Model { name, mesh, source }),
        }
    }

    /// Its mesh as an OBJ file; coordinates are the shortest decimals that read back to the same numbers. Its first line is
    /// a comment that tells the source, so that [`Model::read`] gives the same model.
    #[must_use]
    pub fn obj(&self) -> String {
        let head = std::iter::once(format!("{SOURCE}{}\n", self.source));
        let vertices = self.mesh.positions().iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
        let faces = self.mesh.triangles().iter().map(|t| t.map(|v| (u64::from(v) + 1).to_string()));
        head.chain(vertices).chain(faces.map(|[a, b, c]| format!("f {a} {b} {c}\n"))).collect()
    }

    /// Where the paper measures from: on the first mesh of its basic set the vertex of its Table 1, else the first vertex,
    /// that is, the first one some triangle uses. `None` where there is no triangle.
    #[must_use]
    pub fn default_source(mesh: &Mesh) -> Option<u32> {
        if paper::is_basic(mesh) {
            return Some(paper::BASIC_SOURCE);
        }
        let mut ignored = mesh.ignored_triangles().iter().copied().peekable();
        let used = (0..).zip(mesh.triangles()).filter(|&(f, _)| ignored.next_if_eq(&f).is_none());
        used.flat_map(|(_, triangle)| *triangle).min()
    }
}

/// What stands before the source in the first line of an OBJ file of ours.
const SOURCE: &str = "# taut source ";

/// The source in the first line of a file; `None` where it tells none.
fn written_source(path: &Path) -> Option<u32> {
    let mut line = String::new();
    let longest = SOURCE.len() as u64 + 12; // ten digits and the end of the line
    BufReader::new(File::open(path).ok()?.take(longest)).read_line(&mut line).ok()?;
    line.strip_prefix(SOURCE)?.trim_end().parse().ok()
}

/// The name of a file without `.gz` and without what stands behind its last dot.
pub(crate) fn name(path: &Path) -> String {
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let file = file.strip_suffix(".gz").unwrap_or(&file);
    file.rsplit_once('.').map_or(file, |(name, _)| name).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_what_people_call_it() {
        for (path, expected) in [("a/lucy.obj.gz", "lucy"), ("1.obj", "1"), ("bare", "bare"), ("v1.2.ply", "v1.2")] {
            assert_eq!(name(Path::new(path)), expected);
        }
    }

    #[test]
    fn the_first_vertex_in_use_is_the_source() {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [9.0; 3], [2.0, 2.0, 0.0]];
        let source = |triangles: &[[u32; 3]]| {
            let mesh = Mesh::from_triangles(&positions, triangles).unwrap();
            Model::new("m".to_owned(), mesh, None).map(|model| model.source).ok()
        };
        assert_eq!(source(&[[4, 2, 1]]), Some(1));
        assert_eq!(source(&[[0, 0, 1], [4, 2, 1]]), Some(1));
        assert_eq!(source(&[[0, 0, 1]]), None);
        assert_eq!(source(&[]), None);
        let mesh = Mesh::from_triangles(&positions, &[[0, 1, 2]]).unwrap();
        assert!(Model::new("m".to_owned(), mesh, Some(5)).unwrap_err().to_string().contains("vertex 5"));
    }
}
