//! Places on the surface: sources and targets, which cross the border as views of vertices, points and curves.

use super::guard::{guard, null, required};
use super::mesh::taut_mesh;
use super::types::{SizedStruct, read_sized, taut_input, taut_output};
use crate::{Curve, Element, Error, IndexType, Reason, Result, Rows, Source, Status, SurfacePoint, Target};
use std::ops::Range;

/// Where distances are measured from: vertices, points of the surface and curves on it, each at its own start distance.
///
/// Sources are numbered from 0, the vertices first, then the points, then the curves: offsets are given, errors named, and
/// nearest sources told by this number.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_sources {
    /// `sizeof(taut_sources)`.
    pub struct_size: usize,
    /// Rows of one vertex index.
    pub vertices: taut_input,
    /// Rows of one real number, the start distance of each source in mesh units: finite, of any sign. As many as there
    /// are sources of all kinds together, or none, which means 0 for all.
    pub offsets: taut_input,
    /// Rows of one index, the points: the triangle in which each lies.
    pub faces: taut_input,
    /// Rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, not negative,
    /// their sum 1 up to 1e-6.
    pub barycentrics: taut_input,
    /// Rows of one index, where the points of each curve begin and, at last, where they end, as from
    /// `taut_curves_offsets`: curve i has the points from curve_offsets[i] up to, not including, curve_offsets[i + 1], one
    /// at least. The first is 0, the last the number of `curve_faces`. No rows mean no curves.
    pub curve_offsets: taut_input,
    /// Rows of one index, the points of all curves: the triangle in which each lies, and the segment to the next one with
    /// it. A point on an edge or at a vertex may name any triangle there.
    pub curve_faces: taut_input,
    /// Rows of three real numbers, as many as there are `curve_faces`: the weights of the triangle's corners, as above.
    pub curve_barycentrics: taut_input,
    /// Rows of one index for each curve, 1 if its last point is joined to its first, else 0; or none, which means 0 for
    /// all.
    pub curve_closed: taut_input,
}

// SAFETY: repr(C), starts with its size; views are valid for any bytes, and a later field begins after the last one.
unsafe impl SizedStruct for taut_sources {}

/// Places that are asked about: vertices, points of the surface, or both.
///
/// Targets are numbered from 0, the vertices first and the points after them: answers are given and errors named by this
/// number. A NULL pointer to targets means every vertex of the mesh.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_targets {
    /// `sizeof(taut_targets)`.
    pub struct_size: usize,
    /// Rows of one vertex index.
    pub vertices: taut_input,
    /// Rows of one index, the points: the triangle in which each lies.
    pub faces: taut_input,
    /// Rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, not negative,
    /// their sum 1 up to 1e-6.
    pub barycentrics: taut_input,
}

// SAFETY: as for taut_sources.
unsafe impl SizedStruct for taut_targets {}

/// Tells where points of the surface lie in space.
///
/// - `mesh`: not NULL.
/// - `faces`: rows of one index, the triangle of each point.
/// - `barycentrics`: rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, as in
///   `taut_sources`.
/// - `out`: rows of three real numbers, at least as many as there are points; mesh units.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT names the point that is no place, or the face that the mesh does not have;
/// TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the points. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_point_positions(
    mesh: Option<&taut_mesh>,
    faces: taut_input,
    barycentrics: taut_input,
    out: taut_output,
) -> Status {
    guard(|| {
        let mesh = &required(mesh, "mesh")?.0;
        // SAFETY: the header asks for views of readable memory.
        let points = unsafe { surface_points(faces, barycentrics, "", Element::Point)? };
        let position = |(i, point): (u64, &SurfacePoint)| {
            let about = |error: Error| match error.element() {
                None => error.about(Element::Point(i)),
                Some(_) => error,
            };
            point.position(mesh).map_err(about)
        };
        let positions = (0..).zip(&points).map(position).collect::<Result<Vec<_>>>()?;
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalars(&positions, "out") }
    })
}

/// Vertex indices; one that does not fit in 32 bits names its row by `element`.
///
/// # Safety
/// As [`taut_input::scalars`].
unsafe fn vertices(view: taut_input, name: &str, element: fn(u64) -> Element) -> Result<Vec<u32>> {
    // SAFETY: as the caller promises.
    let rows = unsafe { view.indices(1, name)? };
    let vertex = |row: usize| {
        let message = "is a vertex index that is negative or beyond 32 bits";
        rows.index(row, 0).ok_or_else(|| Error::at(Reason::VertexOutOfRange, element(row as u64), message))
    };
    (0..rows.count()).map(vertex).collect()
}

/// Points of the surface; a face that does not fit in 32 bits names its row by `element`. In messages the names of the
/// views begin with `owner`.
///
/// # Safety
/// The views describe readable memory.
pub(super) unsafe fn surface_points(
    faces: taut_input,
    barycentrics: taut_input,
    owner: &str,
    element: impl Fn(u64) -> Element,
) -> Result<Vec<SurfacePoint>> {
    let [faces_name, weights_name] = ["faces", "barycentrics"].map(|name| format!("{owner}{name}"));
    // SAFETY: as the caller promises.
    let (faces, weights) = unsafe { (faces.indices(1, &faces_name)?, barycentrics.scalars(3, &weights_name)?) };
    if faces.count() != weights.count() {
        let message =
            format!("`{faces_name}` has {} rows, but `{weights_name}` has {}", faces.count(), weights.count());
        return Err(Error::new(Reason::BadArgument, message));
    }
    let point = |row: usize| match faces.index(row, 0) {
        Some(face) => Ok(SurfacePoint { face, barycentric: [0, 1, 2].map(|k| weights.scalar(row, k)) }),
        None => {
            let message = "lies in a triangle whose index is negative or beyond 32 bits";
            Err(Error::at(Reason::BadArgument, element(row as u64), message))
        }
    };
    (0..faces.count()).map(point).collect()
}

/// The vertices, then the points; errors and messages as by [`vertices`] and [`surface_points`].
///
/// # Safety
/// The views describe readable memory.
unsafe fn places(
    vertices: taut_input,
    faces: taut_input,
    barycentrics: taut_input,
    owner: &str,
    element: fn(u64) -> Element,
) -> Result<Vec<Target>> {
    // SAFETY: as the caller promises.
    let (vertices, points) = unsafe {
        let vertices = self::vertices(vertices, &format!("{owner}.vertices"), element)?;
        let behind = |row| element(vertices.len() as u64 + row);
        let points = surface_points(faces, barycentrics, &format!("{owner}."), behind)?;
        (vertices, points)
    };
    Ok(vertices.into_iter().map(Target::Vertex).chain(points.into_iter().map(Target::Point)).collect())
}

/// The caller's targets; None for NULL, which means every vertex.
///
/// # Safety
/// `targets` is NULL or points to a struct of the size it states, whose views describe readable memory.
pub(super) unsafe fn targets(targets: *const taut_targets, name: &str) -> Result<Option<Vec<Target>>> {
    if targets.is_null() {
        return Ok(None);
    }
    // SAFETY: as the caller promises.
    unsafe {
        let taut_targets { vertices, faces, barycentrics, .. } = read_sized(targets, name)?;
        places(vertices, faces, barycentrics, name, Element::Target).map(Some)
    }
}

/// The caller's sources: the vertices, then the points, then the curves.
///
/// # Safety
/// As [`targets`].
pub(super) unsafe fn sources(sources: *const taut_sources) -> Result<Vec<Source>> {
    if sources.is_null() {
        return Err(null("sources"));
    }
    // SAFETY: as the caller promises.
    let (places, offsets, curves) = unsafe {
        let sources = read_sized(sources, "sources")?;
        let taut_sources { vertices, offsets, faces, barycentrics, .. } = sources;
        let places = places(vertices, faces, barycentrics, "sources", Element::Source)?;
        let curves = curves(&sources, places.len())?;
        (places, offsets.numbers("sources.offsets")?, curves)
    };
    let source = |place| match place {
        Target::Vertex(v) => Source::vertex(v),
        Target::Point(point) => Source::point(point),
    };
    let sources: Vec<Source> = places.into_iter().map(source).chain(curves.into_iter().map(Source::curve)).collect();
    if offsets.is_empty() {
        return Ok(sources);
    }
    if offsets.len() != sources.len() {
        let message = format!("`sources` has {} sources, but {} offsets", sources.len(), offsets.len());
        return Err(Error::new(Reason::BadArgument, message));
    }
    Ok(sources.into_iter().zip(offsets).map(|(source, offset)| source.with_offset(offset)).collect())
}

/// The caller's curves; errors name them as sources, of which there are `before` others.
///
/// # Safety
/// As [`sources`].
unsafe fn curves(sources: &taut_sources, before: usize) -> Result<Vec<Curve>> {
    let name = |row: usize| Element::Source((before + row) as u64);
    // SAFETY: as the caller promises.
    let (offsets, closed, points) = unsafe {
        let taut_sources { curve_offsets, curve_faces, curve_barycentrics, curve_closed, .. } = *sources;
        let offsets = curve_offsets.indices(1, "sources.curve_offsets")?;
        // A face that is no index names the curve that it would belong to.
        let curve = |point: u64| {
            let begins = |row: &usize| offsets.index(*row, 0).is_some_and(|first| u64::from(first) <= point);
            name((0..offsets.count()).take_while(begins).count().saturating_sub(1))
        };
        let points = surface_points(curve_faces, curve_barycentrics, "sources.curve_", curve)?;
        (offsets, curve_closed.indices(1, "sources.curve_closed")?, points)
    };
    let error = |row: usize, message: &str| Error::at(Reason::BadArgument, name(row), message);
    let spans = spans(&offsets, points.len(), "sources.curve_offsets", |row| {
        error(row, "is a curve that ends before it begins")
    })?;
    if closed.count() != 0 && closed.count() != spans.len() {
        let message = format!("`sources` has {} curves, but {} rows in `curve_closed`", spans.len(), closed.count());
        return Err(Error::new(Reason::BadArgument, message));
    }
    let curve = |(row, span): (usize, Range<usize>)| {
        let is_closed = match closed.count() {
            0 => false,
            _ => match closed.index(row, 0) {
                Some(flag @ 0..=1) => flag == 1,
                _ => return Err(error(row, "is a curve whose `curve_closed` is neither 0 nor 1")),
            },
        };
        Ok(Curve { points: points.get(span).unwrap_or_default().to_vec(), is_closed })
    };
    spans.into_iter().enumerate().map(curve).collect()
}

/// The caller's sources in sets, which are whole and in order; without `set_offsets` each source is a set.
///
/// # Safety
/// As [`sources`], and `set_offsets` describes readable memory.
pub(super) unsafe fn source_sets(sources: *const taut_sources, set_offsets: taut_input) -> Result<Vec<Vec<Source>>> {
    // SAFETY: as the caller promises.
    let (sources, offsets) = unsafe { (self::sources(sources)?, set_offsets.indices(1, "set_offsets")?) };
    if offsets.count() == 0 {
        return Ok(sources.into_iter().map(|source| vec![source]).collect());
    }
    let spans = spans(&offsets, sources.len(), "set_offsets", |row| {
        Error::new(Reason::BadArgument, format!("`set_offsets` decreases after row {row}"))
    })?;
    Ok(spans.into_iter().map(|span| sources.get(span).unwrap_or_default().to_vec()).collect())
}

/// What lies between each offset and the next, of `total` things: all of them, in order. `decreases` is the error of a row
/// that is followed by a smaller one.
fn spans(
    offsets: &Rows<'_, IndexType>,
    total: usize,
    name: &str,
    decreases: impl Fn(usize) -> Error,
) -> Result<Vec<Range<usize>>> {
    let offset = |row: usize| offsets.index(row, 0).map_or(usize::MAX, |offset| offset as usize);
    let count = offsets.count().saturating_sub(1);
    let is_whole = if offsets.count() == 0 { total == 0 } else { offset(0) == 0 && offset(count) == total };
    if !is_whole {
        return Err(Error::new(
            Reason::BadArgument,
            format!("`{name}` must lead from 0 to {total}, the number of rows"),
        ));
    }
    let span = |row: usize| {
        let span = offset(row)..offset(row + 1);
        if span.start <= span.end && span.end <= total { Ok(span) } else { Err(decreases(row)) }
    };
    (0..count).map(span).collect()
}
