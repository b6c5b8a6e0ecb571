//! Wavefront OBJ: the statements `v` and `f`; points, lines, curves, groups and materials mean nothing here.
//!
//! The crate tobj reads the faces. It numbers vertices anew by first use, begins again at each group or material, and
//! drops what no face uses; but the file's vertex order is ours. So it is given a shadow of the file: the `f` statements
//! as they are, and in the place of the `i`-th `v` statement the vertex `v i 0 0`. Relative indices resolve as in the
//! file, nothing splits the mesh, and the first coordinate of whatever position tobj hands back *is* the file's index
//! (an integer below 2³², exact in `f64`). The coordinates, comments and continued lines we read ourselves: tobj divides
//! by a fourth coordinate and knows neither a comment behind a statement nor a continuation.
//!
//! Linear in the size of the file.
//!
//! References: Wavefront Technologies, "Advanced Visualizer Manual", appendix B1, object files (1992).

use super::Polygons;
use super::text::{Line, Lines, number, position, words};
use crate::error::{Element, Error, Reason, Result};
use std::borrow::Cow;
use std::collections::HashMap;
use std::io::Write;

pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let mut polygons = Polygons::default();
    let shadow = shadow(bytes, &mut polygons.positions)?;
    if polygons.positions.is_empty() {
        return Err(Error::at(Reason::Malformed, Element::Line(1), "an OBJ file has vertices; this file has none"));
    }
    let no_materials = |_: &std::path::Path| Ok((Vec::new(), HashMap::new()));
    let (models, _) = tobj::load_obj_buf(&mut shadow.as_slice(), &tobj::LoadOptions::default(), no_materials)
        .map_err(|error| first_bad_face(bytes, polygons.positions.len(), &error))?;
    for model in models {
        add_faces(&mut polygons, &model.mesh)?;
    }
    Ok(polygons)
}

/// Collects the positions and returns what tobj is to read in the place of the file.
fn shadow(bytes: &[u8], positions: &mut Vec<[f64; 3]>) -> Result<Vec<u8>> {
    let mut shadow = Vec::with_capacity(bytes.len());
    for (line, statement) in statements(bytes) {
        let mut words = words(&statement);
        let written = match words.next() {
            Some(b"v") => {
                let position = position(words).ok_or_else(|| line.malformed("a vertex needs three numbers"))?;
                positions.push(position);
                writeln!(shadow, "v {} 0 0", positions.len() - 1)
            }
            Some(b"f") => shadow.write_all(&statement).and_then(|()| shadow.write_all(b"\n")),
            _ => Ok(()),
        };
        written.map_err(|error| Error::new(Reason::Io, error.to_string()))?;
    }
    Ok(shadow)
}

/// The statements of the file, each with its first line: comments cut off, continued lines (`\`) joined.
fn statements(bytes: &[u8]) -> impl Iterator<Item = (Line<'_>, Cow<'_, [u8]>)> {
    let mut lines = Lines::new(bytes);
    std::iter::from_fn(move || {
        let line = lines.next()?;
        let mut statement = Cow::Borrowed(line.content());
        while statement.ends_with(b"\\") {
            let joined = statement.to_mut();
            joined.pop();
            joined.push(b' ');
            joined.extend(lines.next().map_or(&b""[..], |line| line.content()));
        }
        Some((line, statement))
    })
}

/// The faces as tobj read them; it leaves `face_arities` empty where all are triangles.
fn add_faces(polygons: &mut Polygons, mesh: &tobj::Mesh) -> Result<()> {
    let triangles = if mesh.face_arities.is_empty() { mesh.indices.len() / 3 } else { 0 };
    let mut corners = mesh.indices.iter();
    for arity in mesh.face_arities.iter().copied().chain(std::iter::repeat_n(3, triangles)) {
        for &corner in corners.by_ref().take(arity as usize) {
            // Exact: the shadow's first coordinates are small integers.
            polygons.add_corner(mesh.positions[3 * corner as usize] as i64)?;
        }
        polygons.end_face()?;
    }
    Ok(())
}

/// The error of the first face that tobj refuses: its own errors name neither face nor line.
fn first_bad_face(bytes: &[u8], vertices: usize, error: &tobj::LoadError) -> Error {
    let (mut before, mut face) = (0, 0);
    for (line, statement) in statements(bytes) {
        let mut words = words(&statement);
        match words.next() {
            Some(b"v") => before += 1,
            Some(b"f") => {
                if let Some(error) = words.find_map(|word| bad_corner(word, before, vertices, face, &line)) {
                    return error;
                }
                face += 1;
            }
            _ => {}
        }
    }
    Error::new(Reason::Malformed, error.to_string())
}

/// What is wrong with a corner `v/vt/vn`, which may count back from the `before` vertices that stand before its face.
fn bad_corner(word: &[u8], before: i64, vertices: usize, face: u64, line: &Line<'_>) -> Option<Error> {
    let parts: Vec<Option<i64>> = word.split(|&byte| byte == b'/').map(number).collect();
    let Some(&Some(index)) = parts.first() else {
        return Some(line.malformed("a face needs vertex indices"));
    };
    let vertex = if index < 0 { before + index } else { index - 1 };
    if !(0..vertices as i64).contains(&vertex) {
        let message = format!("names vertex {index}, but the file has {vertices}, from 1 on (line {})", line.number);
        return Some(Error::at(Reason::IndexOutOfRange, Element::Face(face), message));
    }
    let readable =
        parts.len() <= 3 && word.split(|&byte| byte == b'/').zip(&parts).all(|(p, i)| p.is_empty() || i.is_some());
    (!readable).then(|| line.malformed("a face has corners of the form v, v/vt, v//vn or v/vt/vn"))
}
