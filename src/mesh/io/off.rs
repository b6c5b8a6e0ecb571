//! Geomview OFF in text: a keyword, three counts, then one vertex and one face a line.
//!
//! What follows the three coordinates of a vertex (normal, colour, texture) and the corners of a face (colour) is
//! skipped. `#` begins a comment. Linear in the size of the file.
//!
//! References: the manual of Geomview 1.9, "OFF Files" (The Geometry Center, 1996).

use super::Polygons;
use super::text::{Line, Lines, number, position, words};
use crate::error::{Element, Error, Reason, Result};

pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let mut lines = Lines::new(bytes);
    let [vertices, faces] = counts(&mut lines)?;
    let mut polygons = Polygons::default();
    for v in 0..vertices {
        let line = next(&mut lines).ok_or_else(|| truncated(Element::Vertex(v as u64), vertices))?;
        let position = position(words(line.content())).ok_or_else(|| line.malformed("a vertex needs three numbers"))?;
        polygons.positions.push(position);
    }
    for _ in 0..faces {
        let line = next(&mut lines).ok_or_else(|| truncated(polygons.face(), faces))?;
        add_face(&mut polygons, &line)?;
    }
    Ok(polygons)
}

/// How many vertices and faces the head of the file promises.
fn counts(lines: &mut Lines<'_>) -> Result<[usize; 2]> {
    let end = || Error::at(Reason::Truncated, Element::Line(1), "the file ends within its head");
    let mut line = next(lines).ok_or_else(end)?;
    let mut head = words(line.content());
    keyword(head.next().unwrap_or_default(), &line)?;
    let mut head = head.peekable();
    match head.peek() {
        Some(&b"BINARY") => return Err(refused(&line, "binary OFF is not read")),
        Some(_) => {}
        None => {
            line = next(lines).ok_or_else(end)?;
            head = words(line.content()).peekable();
        }
    }
    let mut count = || head.next().and_then(number);
    match (count(), count()) {
        (Some(vertices), Some(faces)) => Ok([vertices, faces]),
        _ => Err(line.malformed("the counts of vertices and faces should stand here")),
    }
}

/// Checks the keyword: OFF behind any of ST (texture), C (colour) and N (normal), in this order.
fn keyword(word: &[u8], line: &Line<'_>) -> Result<()> {
    let prefix = word.strip_suffix(b"OFF").ok_or_else(|| line.malformed("an OFF file begins with the word OFF"))?;
    if prefix.contains(&b'4') || prefix.contains(&b'n') {
        return Err(refused(line, "vertices of other than three dimensions are not read"));
    }
    let prefix = prefix.strip_prefix(b"ST").unwrap_or(prefix);
    let prefix = prefix.strip_prefix(b"C").unwrap_or(prefix);
    let prefix = prefix.strip_prefix(b"N").unwrap_or(prefix);
    if prefix.is_empty() { Ok(()) } else { Err(line.malformed("an OFF file begins with OFF, COFF, NOFF or STOFF")) }
}

fn add_face(polygons: &mut Polygons, line: &Line<'_>) -> Result<()> {
    let mut words = words(line.content());
    let corners: u32 =
        words.next().and_then(number).ok_or_else(|| line.malformed("a face begins with its number of corners"))?;
    for _ in 0..corners {
        let corner = words.next().and_then(number);
        polygons.add_corner(corner.ok_or_else(|| line.malformed("a face needs as many vertex indices as it says"))?)?;
    }
    polygons.end_face()
}

/// The next line that is neither blank nor a comment.
fn next<'a>(lines: &mut Lines<'a>) -> Option<Line<'a>> {
    lines.find(|line| !line.content().is_empty())
}

fn truncated(element: Element, count: usize) -> Error {
    Error::at(Reason::Truncated, element, format!("is missing; the head of the file promises {count}"))
}

fn refused(line: &Line<'_>, message: &str) -> Error {
    Error::at(Reason::UnknownFormat, Element::Line(line.number), message)
}
