//! `taut_exact` and `taut_exact_field`: exact distances, nearest sources, shortest paths.

use super::control::taut_control;
use super::guard::{control_or_new, free, guard, guard_new, guard_value, required};
use super::mesh::taut_mesh;
use super::surface::taut_curves;
use super::types::{
    SizedStruct, bad_enum, read_sized, sources, surface_points, taut_input, taut_output, taut_sources, vertices,
};
use crate::{Curve, Element, Error, ExactField, ExactOptions, ExactSolver, Mesh, Result, Status};

/// A mesh prepared for exact distances. Serves any number of calls.
pub struct taut_exact {
    pub(super) solver: ExactSolver,
    pub(super) mesh: Mesh,
}

/// The exact distances from one set of sources, and the shortest paths to them.
pub struct taut_exact_field {
    field: ExactField,
    mesh: Mesh,
}

/// Options of `taut_exact_field_new`. All zero but the size is the default.
#[repr(C)]
#[derive(Clone, Copy)]
pub struct taut_exact_options {
    /// `sizeof(taut_exact_options)`.
    pub struct_size: usize,
    /// Rows of one vertex index: the vertices whose distances are wanted; the work stops when all of these are final.
    /// None means every vertex.
    pub targets: taut_input,
    /// The largest distance wanted, start distances included, in mesh units, not negative; vertices that are farther get
    /// +INFINITY, and the work stops when all others are final. 0 means no limit, as does +INFINITY.
    pub radius: f64,
    /// 1: work that is cancelled or reaches a limit of its control succeeds with the distances that are final by then,
    /// up to `taut_exact_field_final_radius`. 0: it fails.
    pub allow_partial: u32,
    /// 1: the field keeps what it needs to answer for points that are no vertices: distances, nearest sources and paths
    /// of these; 1 to 2 kB for a triangle of a scan, and twice that while the field is made. 0: it answers for vertices
    /// only.
    pub keep_windows: u32,
}

// SAFETY: repr(C), starts with its size; views and numbers are valid for any bytes, and no padding follows them.
unsafe impl SizedStruct for taut_exact_options {}

/// Prepares a mesh for exact distances.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `out`: receives the prepared mesh, to be freed with `taut_exact_free`; NULL on failure.
///
/// Errors: `mesh` or `out` is NULL. Cost: O(V + F) time and memory. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_new(mesh: Option<&taut_mesh>, out: *mut *mut taut_exact) -> Status {
    let body = || {
        let mesh = &required(mesh, "mesh")?.0;
        Ok(taut_exact { solver: ExactSolver::new(mesh)?, mesh: mesh.clone() })
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Frees a prepared mesh; NULL is fine. Fields made from it stay valid.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_free(exact: Option<Box<taut_exact>>) {
    free(exact);
}

/// Computes the exact distances from a set of sources.
///
/// - `exact`: not NULL.
/// - `sources`: where to measure from; not NULL, at least one.
/// - `options`: NULL means the default.
/// - `control`: progress, cancellation and limits, or NULL.
/// - `out`: receives the field, to be freed with `taut_exact_field_free`; NULL on failure.
///
/// Errors: TAUT_REASON_NO_SOURCE; TAUT_REASON_VERTEX_OUT_OF_RANGE names the source or target; TAUT_REASON_BAD_ARGUMENT
/// names the source that is no place on the mesh, or the option; and, unless `allow_partial` is set,
/// TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT, TAUT_REASON_MEMORY_LIMIT. Cost: about 20 windows per triangle on
/// scanned surfaces, O(V^2) at worst, and with targets or a radius in proportion to the area within; memory for the
/// moving front, 48 bytes a vertex and 12 a triangle, and with `keep_windows` about 50 bytes a window. Threads: any, also
/// on one `exact` at once. The control is consulted every few thousand windows, about a millisecond apart, in which the
/// memory grows by a few hundred kB at most.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_new(
    exact: Option<&taut_exact>,
    sources: *const taut_sources,
    options: *const taut_exact_options,
    control: Option<&taut_control>,
    out: *mut *mut taut_exact_field,
) -> Status {
    let body = || {
        let exact = required(exact, "exact")?;
        // SAFETY: the header asks for structs of the size that they state, and views of readable memory.
        let (sources, options) = unsafe { (self::sources(sources)?, options_of(options)?) };
        let field = exact.solver.field(&sources, &options, &control_or_new(control))?;
        Ok(taut_exact_field { field, mesh: exact.mesh.clone() })
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// # Safety
/// As [`read_sized`], and the targets are readable memory.
unsafe fn options_of(options: *const taut_exact_options) -> Result<ExactOptions> {
    // SAFETY: as the caller promises.
    let (options, targets) = unsafe {
        let options = read_sized(options, "options")?;
        (options, vertices(options.targets, "options.targets", Element::Target)?)
    };
    if options.allow_partial > 1 {
        return Err(bad_enum("options.allow_partial", options.allow_partial));
    }
    if options.keep_windows > 1 {
        return Err(bad_enum("options.keep_windows", options.keep_windows));
    }
    let radius = if options.radius == 0.0 { f64::INFINITY } else { options.radius };
    let [allow_partial, keep_windows] = [options.allow_partial, options.keep_windows].map(|flag| flag == 1);
    Ok(ExactOptions { targets, radius, allow_partial, keep_windows })
}

/// Copies the distances out.
///
/// - `field`: not NULL.
/// - `out`: rows of one real number, at least as many as there are vertices; mesh units. +INFINITY where no source
///   reaches, and beyond `taut_exact_field_final_radius`.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(V). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_distances(field: Option<&taut_exact_field>, out: taut_output) -> Status {
    guard(|| {
        let distances = required(field, "field")?.field.distances();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalars(distances.as_chunks::<1>().0, "out") }
    })
}

/// Tells the nearest source of each vertex, by its number among the sources.
///
/// - `field`: not NULL.
/// - `out`: rows of one index, at least as many as there are vertices. Where no source reaches, and beyond
///   `taut_exact_field_final_radius`, all bits are set: -1 in a signed type, the largest value of an unsigned one.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where a number exceeds the type. Cost: O(V). Threads:
/// any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_nearest_sources(
    field: Option<&taut_exact_field>,
    out: taut_output,
) -> Status {
    guard(|| {
        let nearest: Vec<Option<u32>> = required(field, "field")?.field.nearest_sources().collect();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_optional_indices(&nearest, "out") }
    })
}

/// Tells the distance of points of the surface.
///
/// - `field`: not NULL; made with `keep_windows`, unless all points are vertices.
/// - `faces`: rows of one index: the triangle in which each point lies.
/// - `barycentrics`: rows of three real numbers, as many as there are faces: the weights of the triangle's corners, not
///   negative, their sum 1 up to 1e-6.
/// - `out`: rows of one real number, at least as many as there are faces; mesh units. +INFINITY where no source reaches,
///   and beyond `taut_exact_field_final_radius`.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT names the point that the mesh does not have, or that is no vertex where the field
/// keeps no windows; TAUT_REASON_BUFFER_TOO_SMALL. Cost: a look at each window of a point's triangle. Threads: any.
/// Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_point_distances(
    field: Option<&taut_exact_field>,
    faces: taut_input,
    barycentrics: taut_input,
    out: taut_output,
) -> Status {
    guard(|| {
        let field = &required(field, "field")?.field;
        // SAFETY: the header asks for views of readable memory.
        let points = unsafe { surface_points(faces, barycentrics, "", Element::Point)? };
        let distances = of_each(&points, Element::Point, |point| field.distance(point));
        let distances = distances.collect::<Result<Vec<f64>>>()?;
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalars(distances.as_chunks::<1>().0, "out") }
    })
}

/// Tells the nearest source of points of the surface, by its number among the sources.
///
/// - `field`, `faces`, `barycentrics`: as for `taut_exact_field_point_distances`.
/// - `out`: rows of one index, at least as many as there are faces, filled as by `taut_exact_field_nearest_sources`.
///
/// Errors: as for `taut_exact_field_point_distances`; TAUT_REASON_BAD_ARGUMENT where a number exceeds the type. Cost: a
/// look at each window of a point's triangle. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_point_nearest_sources(
    field: Option<&taut_exact_field>,
    faces: taut_input,
    barycentrics: taut_input,
    out: taut_output,
) -> Status {
    guard(|| {
        let field = &required(field, "field")?.field;
        // SAFETY: the header asks for views of readable memory.
        let points = unsafe { surface_points(faces, barycentrics, "", Element::Point)? };
        let nearest = of_each(&points, Element::Point, |point| field.nearest_source(point));
        let nearest = nearest.collect::<Result<Vec<Option<u32>>>>()?;
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_optional_indices(&nearest, "out") }
    })
}

/// Draws the shortest path from each of some vertices back to its nearest source.
///
/// A path is as long as the distance less the start distance of the source. It begins at the target and ends at the
/// source; a target that is a source has one point. No two points that follow each other are at one position.
///
/// - `field`: not NULL.
/// - `targets`: rows of one vertex index.
/// - `out`: receives one curve for each target, in their order, to be freed with `taut_curves_free`; NULL on failure. A
///   curve has no points where no source reaches, beyond `taut_exact_field_final_radius`, and for a vertex that no
///   triangle uses.
///
/// Errors: TAUT_REASON_VERTEX_OUT_OF_RANGE names the target; TAUT_REASON_TOO_MANY_ELEMENTS where the points exceed 32-bit
/// indices. Cost: linear in the triangles that the paths cross. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_paths(
    field: Option<&taut_exact_field>,
    targets: taut_input,
    out: *mut *mut taut_curves,
) -> Status {
    let body = || {
        let taut_exact_field { field, mesh } = required(field, "field")?;
        // SAFETY: the header asks for a view of readable memory.
        let targets = unsafe { vertices(targets, "targets", Element::Target)? };
        curves(mesh, of_each(&targets, Element::Target, |&v| field.path_from_vertex(v)))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Draws the shortest path from each of some points of the surface back to its nearest source.
///
/// - `field`, `faces`, `barycentrics`: as for `taut_exact_field_point_distances`.
/// - `out`: receives one curve for each point, as from `taut_exact_field_paths`.
///
/// Errors: as for `taut_exact_field_point_distances`; TAUT_REASON_TOO_MANY_ELEMENTS where the points exceed 32-bit
/// indices. Cost: linear in the triangles that the paths cross and the windows of the points' triangles. Threads: any.
/// Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_point_paths(
    field: Option<&taut_exact_field>,
    faces: taut_input,
    barycentrics: taut_input,
    out: *mut *mut taut_curves,
) -> Status {
    let body = || {
        let taut_exact_field { field, mesh } = required(field, "field")?;
        // SAFETY: the header asks for views of readable memory.
        let points = unsafe { surface_points(faces, barycentrics, "", Element::Point)? };
        curves(mesh, of_each(&points, Element::Point, |point| field.path(point)))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// What `answer` says of each row; an error names the row.
fn of_each<T, A>(
    rows: &[T],
    element: fn(u64) -> Element,
    answer: impl Fn(&T) -> Result<A>,
) -> impl Iterator<Item = Result<A>> {
    (0..)
        .zip(rows)
        .map(move |(i, row)| answer(row).map_err(|error| Error::at(error.reason(), element(i), error.message())))
}

/// One curve for each path, without points where there is none.
fn curves(mesh: &Mesh, paths: impl Iterator<Item = Result<Option<Curve>>>) -> Result<taut_curves> {
    let mut curves = taut_curves::new();
    for (row, path) in (0..).zip(paths) {
        curves.push(mesh, row, &path?.unwrap_or(Curve { points: Vec::new(), is_closed: false }))?;
    }
    Ok(curves)
}

/// Tells up to which distance the field is complete: distances up to this one are there and final, beyond it all are
/// +INFINITY. It is +INFINITY unless the work stopped at its targets or its radius, or was interrupted; work that was
/// interrupted early may know no distance for certain, and then this is below the least start distance.
///
/// - `field`: not NULL.
///
/// Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_final_radius(field: Option<&taut_exact_field>) -> f64 {
    guard_value(0.0, || Ok(required(field, "field")?.field.final_radius()))
}

/// Tells what interrupted the work before it had all that was asked for: the status that its call would have returned
/// without `allow_partial`.
///
/// - `field`: not NULL.
///
/// Returns TAUT_STATUS_OK if nothing did, TAUT_STATUS_CANCELLED or TAUT_STATUS_LIMIT_REACHED;
/// TAUT_STATUS_INVALID_ARGUMENT if `field` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_interruption(field: Option<&taut_exact_field>) -> Status {
    guard_value(Status::InvalidArgument, || {
        Ok(required(field, "field")?.field.interruption().map_or(Status::Ok, Error::status))
    })
}

/// Frees a field; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_free(field: Option<Box<taut_exact_field>>) {
    free(field);
}
