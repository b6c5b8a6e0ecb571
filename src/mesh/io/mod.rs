//! Mesh files: OBJ, OFF, PLY, STL and binary glTF, each also compressed by gzip.
//!
//! Vertex `v` and face `f` of the file are vertex `v` and face `f` of the mesh: nothing is merged, dropped or renumbered,
//! whatever groups, materials or unreferenced vertices the file has. STL and glTF repeat a position wherever faces or
//! seams meet; there, equal positions become one vertex, numbered by first appearance ([`weld`]). A text number is read
//! to the nearest `f64` (17 digits come back bit for bit), whatever type its file declares; `nan` and `inf` are numbers
//! too. Normals, colours and texture coordinates are skipped.
//!
//! Cost: linear in the size of the file; no count that a file declares is believed before the bytes that bear it out are
//! read. Errors name the line, or the vertex or face by its number in the file.

mod glb;
mod obj;
mod off;
mod ply;
mod stl;
mod text;
mod weld;

use super::Mesh;
use super::input::fans;
use crate::error::{Element, Error, Reason, Result};
use std::borrow::Cow;
use std::io::{self, Read};
use std::path::Path;

/// A mesh file format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MeshFormat {
    /// Binary glTF 2.0: all triangles of the default scene, each where its nodes place it. Vertices of equal position are
    /// one vertex, numbered by first appearance.
    Glb,
    /// Wavefront OBJ: the `v` and `f` statements, negative (relative) indices included; points and lines are skipped.
    Obj,
    /// Geomview OFF in text, also as STOFF, COFF, NOFF and their combinations; one vertex or face a line.
    Off,
    /// Stanford PLY: text, binary little or big endian. Faces are polygons; a file of triangle strips is refused.
    Ply,
    /// STL, binary or text. Corners of equal position are one vertex, numbered by first appearance.
    Stl,
}

impl MeshFormat {
    /// The format that a file's name tells: `.glb`, `.obj`, `.off`, `.ply` or `.stl` in any case, with or without `.gz`
    /// behind it.
    #[must_use]
    pub fn of(path: &Path) -> Option<MeshFormat> {
        let name = path.file_name()?.to_string_lossy().to_ascii_lowercase();
        match name.strip_suffix(".gz").unwrap_or(&name).rsplit_once('.')?.1 {
            "glb" => Some(MeshFormat::Glb),
            "obj" => Some(MeshFormat::Obj),
            "off" => Some(MeshFormat::Off),
            "ply" => Some(MeshFormat::Ply),
            "stl" => Some(MeshFormat::Stl),
            _ => None,
        }
    }
}

impl Mesh {
    /// The mesh in a file; the suffix tells the format: `.glb`, `.obj`, `.off`, `.ply` or `.stl`, also with `.gz` behind
    /// it.
    ///
    /// The messages of errors leave the path to the caller, as those of `std::fs` do.
    ///
    /// # Errors
    /// [`Reason::Io`] where the file cannot be read, [`Reason::UnknownFormat`] where the suffix is none of these, and
    /// as [`Mesh::read_bytes`].
    pub fn read(path: impl AsRef<Path>) -> Result<Mesh> {
        let path = path.as_ref();
        let format = MeshFormat::of(path).ok_or_else(|| {
            let message = "the suffix is none of .glb, .obj, .off, .ply and .stl, nor one of these and .gz";
            Error::new(Reason::UnknownFormat, message)
        })?;
        let bytes = std::fs::read(path).map_err(|error| Error::new(io_reason(&error), error.to_string()))?;
        Mesh::read_bytes(&bytes, format)
    }

    /// The mesh in the content of a file, compressed by gzip or not.
    ///
    /// # Errors
    /// [`Reason::Truncated`] and [`Reason::Malformed`] name the line, vertex or face where the content stops following
    /// its format. [`Reason::IndexOutOfRange`], [`Reason::FaceTooSmall`] and [`Reason::NonFiniteCoordinate`] as
    /// [`Mesh::from_polygons`], with the face's number in the file. [`Reason::UnknownFormat`] for binary OFF,
    /// triangle strips of PLY, and what of glTF is not read: compressed or outside buffers, skins, weighted morph targets.
    pub fn read_bytes(bytes: &[u8], format: MeshFormat) -> Result<Mesh> {
        let bytes = gunzipped(bytes)?;
        match format {
            MeshFormat::Glb => glb::polygons(&bytes),
            MeshFormat::Obj => obj::polygons(&bytes),
            MeshFormat::Off => off::polygons(&bytes),
            MeshFormat::Ply => ply::polygons(&bytes),
            MeshFormat::Stl => stl::polygons(&bytes),
        }?
        .into_mesh()
    }
}

/// The bytes, decompressed where they begin as gzip does.
fn gunzipped(bytes: &[u8]) -> Result<Cow<'_, [u8]>> {
    /// No mesh is this repetitive (vertex and face numbers change), but a decompression bomb is: gzip reaches 1030.
    const MOST_EXPANSION: u64 = 256;
    if !bytes.starts_with(&[0x1f, 0x8b]) {
        return Ok(Cow::Borrowed(bytes));
    }
    let most = (bytes.len() as u64).saturating_mul(MOST_EXPANSION);
    let mut content = Vec::new();
    let mut decoder = flate2::read::MultiGzDecoder::new(bytes).take(most.saturating_add(1));
    decoder.read_to_end(&mut content).map_err(|error| Error::new(io_reason(&error), format!("gzip: {error}")))?;
    if content.len() as u64 > most {
        let message = format!("gzip: the content is more than {MOST_EXPANSION} times as large as the file");
        return Err(Error::new(Reason::Malformed, message));
    }
    Ok(Cow::Owned(content))
}

fn io_reason(error: &io::Error) -> Reason {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => Reason::Truncated,
        io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput => Reason::Malformed,
        io::ErrorKind::OutOfMemory => Reason::OutOfMemory,
        _ => Reason::Io,
    }
}

/// The vertices and faces of a file, as they come.
#[derive(Debug, Default)]
struct Polygons {
    positions: Vec<[f64; 3]>,
    /// Where each face's corners end.
    ends: Vec<u32>,
    corners: Vec<u32>,
}

impl Polygons {
    /// The number of the face whose corners are being added.
    fn face(&self) -> Element {
        Element::Face(self.ends.len() as u64)
    }

    /// Adds a corner to the current face.
    fn add_corner(&mut self, vertex: i64) -> Result<()> {
        let vertex = u32::try_from(vertex).map_err(|_| self.index_out_of_range(self.face(), vertex))?;
        self.corners.push(vertex);
        Ok(())
    }

    /// Ends the current face.
    fn end_face(&mut self) -> Result<()> {
        let end = u32::try_from(self.corners.len()).map_err(|_| {
            Error::at(Reason::TooManyElements, self.face(), "the corners of all faces exceed 32-bit indices")
        })?;
        self.ends.push(end);
        Ok(())
    }

    fn into_mesh(self) -> Result<Mesh> {
        let outside = |&corner: &u32| corner as usize >= self.positions.len();
        if let Some(c) = self.corners.iter().position(outside) {
            let face = self.ends.partition_point(|&end| end as usize <= c);
            return Err(self.index_out_of_range(Element::Face(face as u64), i64::from(self.corners[c])));
        }
        let offsets: Vec<u32> = std::iter::once(0).chain(self.ends).collect();
        Mesh::from_parts(self.positions, fans(&offsets, &self.corners)?)
    }

    fn index_out_of_range(&self, face: Element, vertex: i64) -> Error {
        let message = format!("names vertex {vertex}, counted from 0, but the file has {}", self.positions.len());
        Error::at(Reason::IndexOutOfRange, face, message)
    }
}
