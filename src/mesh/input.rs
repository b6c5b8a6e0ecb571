//! The caller's buffers: rows of scalars or indices in any stride and type, at any alignment.

use crate::error::{Element, Error, Reason, Result};

/// Type of a coordinate in a caller's buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ScalarType {
    /// 32-bit IEEE float.
    F32,
    /// 64-bit IEEE float.
    F64,
}

/// Type of an index in a caller's buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IndexType {
    /// Unsigned 16 bit.
    U16,
    /// Unsigned 32 bit.
    U32,
    /// Unsigned 64 bit.
    U64,
    /// Signed 32 bit; a negative value is an error.
    I32,
    /// Signed 64 bit; a negative value is an error.
    I64,
}

/// Something with a size in bytes: the types of buffer elements.
pub trait ElementType: Copy {
    /// Bytes of one element.
    fn size(self) -> usize;
}

impl ElementType for ScalarType {
    fn size(self) -> usize {
        match self {
            ScalarType::F32 => 4,
            ScalarType::F64 => 8,
        }
    }
}

impl ElementType for IndexType {
    fn size(self) -> usize {
        match self {
            IndexType::U16 => 2,
            IndexType::U32 | IndexType::I32 => 4,
            IndexType::U64 | IndexType::I64 => 8,
        }
    }
}

/// A view of `count` rows of `width` elements each, `stride` bytes apart, in native byte order and at any alignment.
#[derive(Debug, Clone, Copy)]
pub struct Rows<'a, T> {
    bytes: &'a [u8],
    count: usize,
    width: usize,
    stride: usize,
    kind: T,
}

impl<'a, T: ElementType> Rows<'a, T> {
    /// How many bytes such a view spans: from the first byte of the first row to the last byte of the last.
    ///
    /// # Errors
    /// [`Reason::TooManyElements`] where that overflows.
    pub fn span(count: usize, width: usize, stride: usize, kind: T) -> Result<usize> {
        let overflow = || Error::new(Reason::TooManyElements, "count * stride of a buffer overflows");
        let row = width.checked_mul(kind.size()).ok_or_else(overflow)?;
        match count {
            0 => Ok(0),
            n => (n - 1).checked_mul(stride).and_then(|to_last| to_last.checked_add(row)).ok_or_else(overflow),
        }
    }

    /// The view; a `stride` of 0 means tightly packed.
    ///
    /// # Errors
    /// [`Reason::BufferTooSmall`] where `bytes` is shorter than [`Rows::span`].
    pub fn new(bytes: &'a [u8], count: usize, width: usize, stride: usize, kind: T) -> Result<Rows<'a, T>> {
        let stride = if stride == 0 { width * kind.size() } else { stride };
        if bytes.len() < Rows::span(count, width, stride, kind)? {
            return Err(Error::new(Reason::BufferTooSmall, "a buffer is shorter than its count and stride say"));
        }
        Ok(Rows { bytes, count, width, stride, kind })
    }

    /// How many rows there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// The bytes from element `column` of row `row` on, as many as one element has.
    fn element<const N: usize>(&self, row: usize, column: usize) -> [u8; N] {
        debug_assert!(column < self.width);
        let at = row * self.stride + column * self.kind.size();
        let mut out = [0; N];
        out.copy_from_slice(&self.bytes[at..at + N]);
        out
    }
}

impl Rows<'_, ScalarType> {
    pub(crate) fn positions(&self) -> Vec<[f64; 3]> {
        (0..self.count).map(|row| std::array::from_fn(|column| self.scalar(row, column))).collect()
    }

    pub(crate) fn scalar(&self, row: usize, column: usize) -> f64 {
        match self.kind {
            ScalarType::F32 => f64::from(f32::from_ne_bytes(self.element(row, column))),
            ScalarType::F64 => f64::from_ne_bytes(self.element(row, column)),
        }
    }
}

impl Rows<'_, IndexType> {
    /// The index at (row, column); `None` where it is negative or does not fit in 32 bits.
    pub(crate) fn index(&self, row: usize, column: usize) -> Option<u32> {
        match self.kind {
            IndexType::U16 => Some(u32::from(u16::from_ne_bytes(self.element(row, column)))),
            IndexType::U32 => Some(u32::from_ne_bytes(self.element(row, column))),
            IndexType::U64 => u32::try_from(u64::from_ne_bytes(self.element(row, column))).ok(),
            IndexType::I32 => u32::try_from(i32::from_ne_bytes(self.element(row, column))).ok(),
            IndexType::I64 => u32::try_from(i64::from_ne_bytes(self.element(row, column))).ok(),
        }
    }
}

/// The faces in a caller's buffers.
#[derive(Debug, Clone, Copy)]
pub enum Faces<'a> {
    /// Rows of three vertex indices.
    Triangles(Rows<'a, IndexType>),
    /// Polygons: face `f` has the corners `corners[offsets[f]..offsets[f + 1]]`; both are rows of one index.
    Polygons {
        /// One entry more than there are faces, or none at all.
        offsets: Rows<'a, IndexType>,
        /// Vertex index of each corner.
        corners: Rows<'a, IndexType>,
    },
}

impl Faces<'_> {
    pub(crate) fn triangles(&self) -> Result<Vec<[u32; 3]>> {
        match self {
            Faces::Triangles(rows) => (0..rows.count).map(|f| triangle(rows, f)).collect(),
            Faces::Polygons { offsets, corners } => {
                let offsets = column(offsets, |i| bad_offsets(i.saturating_sub(1)))?;
                // The face that owns a corner is known by its offsets; the search runs on failure only.
                let owner = |c: usize| offsets.partition_point(|&o| o as usize <= c).saturating_sub(1);
                let corners = column(corners, |c| index_out_of_range(owner(c)))?;
                fans(&offsets, &corners)
            }
        }
    }
}

fn triangle(rows: &Rows<'_, IndexType>, f: usize) -> Result<[u32; 3]> {
    match (rows.index(f, 0), rows.index(f, 1), rows.index(f, 2)) {
        (Some(a), Some(b), Some(c)) => Ok([a, b, c]),
        _ => Err(index_out_of_range(f)),
    }
}

fn column(rows: &Rows<'_, IndexType>, error: impl Fn(usize) -> Error) -> Result<Vec<u32>> {
    (0..rows.count).map(|row| rows.index(row, 0).ok_or_else(|| error(row))).collect()
}

fn index_out_of_range(face: usize) -> Error {
    let message = "names a vertex index that is negative or beyond 32 bits";
    Error::at(Reason::IndexOutOfRange, Element::Face(face as u64), message)
}

fn bad_offsets(face: usize) -> Error {
    let message = "polygon offsets must start at 0, never decrease, and end at the number of corners";
    Error::at(Reason::BadOffsets, Element::Face(face as u64), message)
}

/// Polygons as fans of triangles from their first corners.
pub(crate) fn fans(offsets: &[u32], corners: &[u32]) -> Result<Vec<[u32; 3]>> {
    let faces = offsets.len().saturating_sub(1);
    let ends_right = offsets.last().map_or(corners.is_empty(), |&end| end as usize == corners.len());
    if offsets.first().is_some_and(|&start| start != 0) || !ends_right {
        return Err(bad_offsets(faces.saturating_sub(1)));
    }
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2 * faces));
    for f in 0..faces {
        let (start, end) = (offsets[f] as usize, offsets[f + 1] as usize);
        let polygon = corners.get(start..end).ok_or_else(|| bad_offsets(f))?;
        let [first, rest @ ..] = polygon else { return Err(too_small(f)) };
        if rest.len() < 2 {
            return Err(too_small(f));
        }
        triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }
    Ok(triangles)
}

fn too_small(face: usize) -> Error {
    Error::at(Reason::FaceTooSmall, Element::Face(face as u64), "a face needs at least three corners")
}
