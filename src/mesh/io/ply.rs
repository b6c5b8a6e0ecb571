//! Stanford PLY: a text header that declares elements and their properties, then their values in text or binary.
//!
//! Every scalar type of PLY (8 to 32-bit integers, 32 and 64-bit floats) fits into `f64` without loss, so one reader of
//! scalars serves all files: a word of the text, or some bytes in either order. The walk is the header's: element by
//! element, row by row, property by property; what is not a vertex coordinate or a face's corner list is read past.
//!
//! Linear in the size of the file: a row without properties takes no bytes and no time, any other takes some, so a
//! header that promises too much ends at the end of the file.
//!
//! Why not a crate: of ply-rs-bw 4.0.1, the one that is kept up, the text grammar has no `nan`, `inf`, `.5` nor `5.`,
//! which other programs write, a header of 80 bytes makes it build 40 million property-less vertices in 1.6 s and 1 GB,
//! and it brings a parser generator. On 270 000 binary faces it takes 27 ms.
//!
//! References: G. Turk, "The PLY Polygon File Format" (1994).

use super::Polygons;
use super::text::{Line, Lines, number, words};
use crate::error::{Element, Error, Reason, Result};

pub(super) fn polygons(bytes: &[u8]) -> Result<Polygons> {
    let mut lines = Lines::new(bytes);
    let (encoding, elements) = header(&mut lines)?;
    let mut body = Body { encoding, rest: lines.rest(), line: lines.taken() + 1, row: None };
    let mut polygons = Polygons::default();
    for element in elements.iter().filter(|element| !element.properties.is_empty()) {
        for row in 0..element.count {
            body.row = element.row(row);
            add_row(&mut polygons, element, &mut body)?;
        }
    }
    Ok(polygons)
}

fn add_row(polygons: &mut Polygons, element: &ElementDef, body: &mut Body<'_>) -> Result<()> {
    let mut position = [0.0; 3];
    for property in &element.properties {
        let count = property.length.map_or(Ok(1), |scalar| body.count(scalar))?;
        for _ in 0..count {
            let value = body.scalar(property.scalar)?;
            match property.role {
                Role::Coordinate(axis) => position[axis] = value,
                Role::Corners => polygons.add_corner(body.integer(value)?)?,
                Role::Ignored => {}
            }
        }
    }
    match element.kind {
        Kind::Vertex => polygons.positions.push(position),
        Kind::Face => polygons.end_face()?,
        Kind::Other => {}
    }
    Ok(())
}

/// How the values behind the header are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// A type of PLY's scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// What is to become of a property.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Role {
    Coordinate(usize),
    Corners,
    Ignored,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Vertex,
    Face,
    Other,
}

#[derive(Debug)]
struct ElementDef {
    kind: Kind,
    line: u64,
    count: u64,
    properties: Vec<Property>,
}

#[derive(Debug)]
struct Property {
    role: Role,
    /// The type of a list's length, where the property is a list.
    length: Option<Scalar>,
    scalar: Scalar,
}

fn header(lines: &mut Lines<'_>) -> Result<(Encoding, Vec<ElementDef>)> {
    let mut encoding = None;
    let mut elements: Vec<ElementDef> = Vec::new();
    if lines.next().is_none_or(|line| line.text != b"ply") {
        return Err(Error::at(Reason::Malformed, Element::Line(1), "a PLY file begins with the line ply"));
    }
    for line in lines.by_ref() {
        let mut words = words(line.text);
        match words.next().unwrap_or_default() {
            b"format" => encoding = Some(self::encoding(words.next().unwrap_or_default(), &line)?),
            b"element" => elements.push(element(words, &line)?),
            b"property" => {
                let element = elements.last_mut().ok_or_else(|| line.malformed("a property needs an element"))?;
                element.properties.push(property(element.kind, words, &line)?);
            }
            b"end_header" => {
                elements.iter().try_for_each(ElementDef::check)?;
                return Ok((encoding.ok_or_else(|| line.malformed("the header has no format"))?, elements));
            }
            b"comment" | b"obj_info" | b"" => {}
            _ => return Err(line.malformed("the header has no such keyword")),
        }
    }
    Err(Error::at(Reason::Truncated, Element::Line(lines.taken()), "the file ends within its header"))
}

fn encoding(word: &[u8], line: &Line<'_>) -> Result<Encoding> {
    match word {
        b"ascii" => Ok(Encoding::Text),
        b"binary_little_endian" => Ok(Encoding::LittleEndian),
        b"binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(line.malformed("the format is none of ascii, binary_little_endian and binary_big_endian")),
    }
}

fn element<'a>(mut words: impl Iterator<Item = &'a [u8]>, line: &Line<'_>) -> Result<ElementDef> {
    let (Some(name), Some(count)) = (words.next(), words.next().and_then(number)) else {
        return Err(line.malformed("an element needs a name and a count"));
    };
    let kind = match name {
        b"vertex" => Kind::Vertex,
        b"face" => Kind::Face,
        b"tristrips" => {
            return Err(Error::at(Reason::UnknownFormat, Element::Line(line.number), "triangle strips are not read"));
        }
        _ => Kind::Other,
    };
    Ok(ElementDef { kind, line: line.number, count, properties: Vec::new() })
}

fn property<'a>(kind: Kind, mut words: impl Iterator<Item = &'a [u8]>, line: &Line<'_>) -> Result<Property> {
    let first = words.next().unwrap_or_default();
    let list = first == b"list";
    let scalar = |word: Option<&[u8]>| {
        word.and_then(Scalar::named).ok_or_else(|| line.malformed("a property needs a type of PLY"))
    };
    let (length, scalar) =
        if list { (Some(scalar(words.next())?), scalar(words.next())?) } else { (None, scalar(Some(first))?) };
    let role = match (kind, list, words.next().unwrap_or_default()) {
        (Kind::Vertex, false, b"x") => Role::Coordinate(0),
        (Kind::Vertex, false, b"y") => Role::Coordinate(1),
        (Kind::Vertex, false, b"z") => Role::Coordinate(2),
        (Kind::Face, true, b"vertex_indices" | b"vertex_index") => Role::Corners,
        _ => Role::Ignored,
    };
    Ok(Property { role, length, scalar })
}

impl ElementDef {
    /// Whether each property that makes a mesh is there, once.
    fn check(&self) -> Result<()> {
        let needed: &[Role] = match self.kind {
            Kind::Vertex => &[Role::Coordinate(0), Role::Coordinate(1), Role::Coordinate(2)],
            Kind::Face => &[Role::Corners],
            Kind::Other => &[],
        };
        let once = |role: &Role| self.properties.iter().filter(|property| property.role == *role).count() == 1;
        if needed.iter().all(once) {
            return Ok(());
        }
        let message = "a vertex needs the properties x, y and z, a face the list vertex_indices, each once";
        Err(Error::at(Reason::Malformed, Element::Line(self.line), message))
    }

    /// The element of an error about one row.
    fn row(&self, row: u64) -> Option<Element> {
        match self.kind {
            Kind::Vertex => Some(Element::Vertex(row)),
            Kind::Face => Some(Element::Face(row)),
            Kind::Other => None,
        }
    }
}

impl Scalar {
    fn named(name: &[u8]) -> Option<Scalar> {
        Some(match name {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }
}

/// The values behind the header.
#[derive(Debug)]
struct Body<'a> {
    encoding: Encoding,
    rest: &'a [u8],
    /// In text, the line that `rest` begins in.
    line: u64,
    /// The vertex or face that is being read.
    row: Option<Element>,
}

impl Body<'_> {
    fn scalar(&mut self, scalar: Scalar) -> Result<f64> {
        if self.encoding == Encoding::Text {
            return self.word();
        }
        Ok(match scalar {
            Scalar::I8 => i8::from_le_bytes(self.bytes()?).into(),
            Scalar::U8 => u8::from_le_bytes(self.bytes()?).into(),
            Scalar::I16 => i16::from_le_bytes(self.bytes()?).into(),
            Scalar::U16 => u16::from_le_bytes(self.bytes()?).into(),
            Scalar::I32 => i32::from_le_bytes(self.bytes()?).into(),
            Scalar::U32 => u32::from_le_bytes(self.bytes()?).into(),
            Scalar::F32 => f32::from_le_bytes(self.bytes()?).into(),
            Scalar::F64 => f64::from_le_bytes(self.bytes()?),
        })
    }

    /// The next `N` bytes, the least significant first.
    fn bytes<const N: usize>(&mut self) -> Result<[u8; N]> {
        let (&(mut bytes), rest) = self.rest.split_first_chunk().ok_or_else(|| self.truncated())?;
        self.rest = rest;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// The next word as a number; white space of any kind parts words.
    fn word(&mut self) -> Result<f64> {
        let is_space = |byte: &u8| byte.is_ascii_whitespace();
        let start = self.rest.iter().position(|byte| !is_space(byte)).ok_or_else(|| self.truncated())?;
        self.line += self.rest[..start].iter().filter(|&&byte| byte == b'\n').count() as u64;
        let word = &self.rest[start..];
        let word = &word[..word.iter().position(is_space).unwrap_or(word.len())];
        self.rest = &self.rest[start + word.len()..];
        number(word).ok_or_else(|| if self.rest.is_empty() { self.truncated() } else { self.malformed("is no number") })
    }

    fn count(&mut self, scalar: Scalar) -> Result<u32> {
        let value = self.scalar(scalar)?;
        u32::try_from(self.integer(value)?).map_err(|_| self.malformed("is no length of a list"))
    }

    fn integer(&self, value: f64) -> Result<i64> {
        // Up to 2^53 the conversion is exact.
        if value.fract() == 0.0 && value.abs() < 9_007_199_254_740_992.0 {
            Ok(value as i64)
        } else {
            Err(self.malformed("is no integer"))
        }
    }

    fn malformed(&self, what: &str) -> Error {
        let message = format!("a value {what}");
        match self.row {
            _ if self.encoding == Encoding::Text => Error::at(Reason::Malformed, Element::Line(self.line), message),
            Some(row) => Error::at(Reason::Malformed, row, message),
            None => Error::new(Reason::Malformed, message),
        }
    }

    fn truncated(&self) -> Error {
        let message = "the file ends before all its values";
        self.row
            .map_or_else(|| Error::new(Reason::Truncated, message), |row| Error::at(Reason::Truncated, row, message))
    }
}
