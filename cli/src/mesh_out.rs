//! `--mesh-out`: the mesh with its distances, for programs that show meshes.
//!
//! Vertices and triangles are those of the mesh, in its order, vertices that no triangle uses included; a polygon of the
//! input is its fan. Positions are written in full, so that [`taut::Mesh::read`] has the same mesh back bit for bit.
//!
//! - PLY, binary little endian: the distance is the property `quality`, which MeshLab takes for its vertex quality and
//!   Blender for an attribute; `red`, `green` and `blue` are its colour in pictures, from the least to the largest, and grey
//!   where no source reaches. There `quality` is inf, which MeshLab leaves out of its statistics and Blender 4.2 reads as
//!   0; only the colour tells.
//! - OBJ: the texture coordinates `vt u 0` have u from 0 at the least distance to 1 at the largest, so that an image of
//!   stripes draws isolines, whatever the unit of the mesh; a comment tells the two distances. Where no source reaches it
//!   is `vt 0 1`, the image's upper edge. (libgeodesic 0.1 wrote `vt d d` with the distance itself: its stripes repeat
//!   once a unit of length.)
//!
//! O(V + F).

use crate::picture::{Encoder, Quantity};
use clap::builder::{PathBufValueParser, TypedValueParser};
use std::io::Write;
use std::path::PathBuf;
use taut::Mesh;

/// Where the mesh goes and how.
#[derive(Debug, Clone)]
pub(crate) struct MeshOut {
    pub(crate) path: PathBuf,
    format: Format,
}

#[derive(Debug, Clone, Copy)]
enum Format {
    Obj,
    Ply,
}

impl MeshOut {
    /// Reads the option's value; the suffix of the file tells the format.
    pub(crate) fn parser() -> impl TypedValueParser<Value = MeshOut> {
        PathBufValueParser::new().try_map(|path| {
            let suffix = path.extension().map(|suffix| suffix.to_string_lossy().to_ascii_lowercase());
            match suffix.as_deref() {
                Some("obj") => Ok(MeshOut { path, format: Format::Obj }),
                Some("ply") => Ok(MeshOut { path, format: Format::Ply }),
                _ => Err("the suffix is neither .ply nor .obj"),
            }
        })
    }

    /// The content of the file.
    pub(crate) fn content(&self, mesh: &Mesh, distances: &[f64]) -> Vec<u8> {
        let mut content = Vec::new();
        let written = match self.format {
            Format::Obj => write_obj(&mut content, mesh, &Range::new(distances), distances),
            Format::Ply => write_ply(&mut content, mesh, &Range::new(distances), distances),
        };
        // Writing to memory cannot fail.
        debug_assert!(written.is_ok());
        content
    }
}

/// The least and the largest finite distance.
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    fn new(distances: &[f64]) -> Range {
        let finite = || distances.iter().copied().filter(|distance| distance.is_finite());
        Range { low: finite().reduce(f64::min).unwrap_or(0.0), high: finite().reduce(f64::max).unwrap_or(0.0) }
    }

    /// Where in the range a distance lies, from 0 to 1; `None` where no source reaches.
    fn part(&self, distance: f64) -> Option<f64> {
        // Halves, because the difference of two finite distances may overflow.
        let length = 0.5 * self.high - 0.5 * self.low;
        let part = if length > 0.0 { (0.5 * distance - 0.5 * self.low) / length } else { 0.0 };
        distance.is_finite().then_some(part)
    }
}

fn write_ply(out: &mut Vec<u8>, mesh: &Mesh, range: &Range, distances: &[f64]) -> std::io::Result<()> {
    let [vertices, triangles] = [mesh.vertex_count(), mesh.triangle_count()];
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\ncomment quality: distance in units of the mesh, inf is unreachable\n\
         element vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\nproperty double quality\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {triangles}\nproperty list uchar uint vertex_indices\nend_header\n"
    )?;
    let colours = colours(distances.iter().map(|&distance| range.part(distance)));
    for ((position, distance), colour) in mesh.positions().iter().zip(distances).zip(colours) {
        out.extend(position.iter().chain([distance]).flat_map(|number| number.to_le_bytes()));
        out.extend(colour);
    }
    for triangle in mesh.triangles() {
        out.push(3);
        out.extend(triangle.iter().flat_map(|vertex| vertex.to_le_bytes()));
    }
    Ok(())
}

/// The colours of pictures; grey for `None`.
fn colours(parts: impl Iterator<Item = Option<f64>>) -> impl Iterator<Item = [u8; 3]> {
    const GREY: [u8; 3] = [128; 3];
    let map = Quantity::Distance.map();
    let encoder = Encoder::new();
    // The cast rounds; the map has a thousand steps.
    parts.map(move |part| part.map_or(GREY, |part| encoder.bytes(map.at(part as f32))))
}

fn write_obj(out: &mut Vec<u8>, mesh: &Mesh, range: &Range, distances: &[f64]) -> std::io::Result<()> {
    writeln!(out, "# vt u 0: u is 0 at the distance {:?} and 1 at {:?}; vt 0 1 is unreachable", range.low, range.high)?;
    for [x, y, z] in mesh.positions() {
        // Debug writes the shortest decimal that reads back, with an exponent where that is long.
        writeln!(out, "v {x:?} {y:?} {z:?}")?;
    }
    for &distance in distances {
        match range.part(distance) {
            Some(part) => writeln!(out, "vt {part:?} 0")?,
            None => writeln!(out, "vt 0 1")?,
        }
    }
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|vertex| u64::from(vertex) + 1);
        writeln!(out, "f {a}/{a} {b}/{b} {c}/{c}")?;
    }
    Ok(())
}
