//! `taut_exact` and `taut_exact_field`: exact distances, nearest sources, shortest paths.

use super::control::taut_control;
use super::curves::taut_curves;
use super::guard::{control_or_new, error_detail, free, guard, guard_new, guard_value, required, taut_error};
use super::mesh::taut_mesh;
use super::places::{sources, surface_points, targets, taut_sources, taut_targets};
use super::types::{SizedStruct, bad_enum, read_sized, taut_input, taut_output, write_sized};
use crate::{Element, Error, ExactField, ExactOptions, ExactSolver, Mesh, Result, Status, Target};
use std::borrow::Cow;

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
    /// The places whose distances are wanted; the work stops when all of these are final. NULL, or no place, means every
    /// vertex.
    pub targets: *const taut_targets,
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

// SAFETY: repr(C), starts with its size; pointers and numbers are valid for any bytes, and no padding follows them.
unsafe impl SizedStruct for taut_exact_options {}

/// Prepares a mesh for exact distances.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `out`: receives the prepared mesh, to be freed with `taut_exact_free`; NULL on failure.
///
/// Errors: none in particular. Cost: O(V + F) time, 0.1 kB for each triangle. Threads: any. Cannot be cancelled.
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
        (options, targets(options.targets, "options.targets")?.unwrap_or_default())
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

/// Tells the distance of each of some places, or of every vertex.
///
/// - `field`: not NULL; made with `keep_windows`, unless all targets are vertices.
/// - `targets`: NULL means every vertex.
/// - `out`: rows of one real number, at least one for each target; mesh units. +INFINITY where no source reaches, and
///   beyond `taut_exact_field_final_radius`.
///
/// Errors: TAUT_REASON_VERTEX_OUT_OF_RANGE names the target; TAUT_REASON_BAD_ARGUMENT names the one that is no place on the
/// mesh, or no vertex where the field keeps no windows; TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the targets, and a
/// look at each window of the triangle of a point. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_distances(
    field: Option<&taut_exact_field>,
    targets: *const taut_targets,
    out: taut_output,
) -> Status {
    guard(|| {
        let field = &required(field, "field")?.field;
        // SAFETY: the header asks for NULL or a struct of the size that it states, and views of readable memory.
        let distances: Cow<[f64]> = match unsafe { self::targets(targets, "targets")? } {
            None => field.distances().into(),
            Some(targets) => of_each(&targets, |target| field.distance(target))?.into(),
        };
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalars(distances.as_chunks::<1>().0, "out") }
    })
}

/// Tells the nearest source of each of some places, by its number among the sources.
///
/// - `field`, `targets`: as for `taut_exact_field_distances`.
/// - `out`: rows of one index, at least one for each target; no index where no source reaches, and beyond
///   `taut_exact_field_final_radius`.
///
/// Errors: as for `taut_exact_field_distances`; TAUT_REASON_BAD_ARGUMENT where a number exceeds the type. Cost: as for
/// `taut_exact_field_distances`. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_nearest_sources(
    field: Option<&taut_exact_field>,
    targets: *const taut_targets,
    out: taut_output,
) -> Status {
    guard(|| {
        let field = &required(field, "field")?.field;
        // SAFETY: the header asks for NULL or a struct of the size that it states, and views of readable memory.
        let nearest = match unsafe { self::targets(targets, "targets")? } {
            None => field.nearest_sources().collect(),
            Some(targets) => of_each(&targets, |target| field.nearest_source(target))?,
        };
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_optional_indices(&nearest, "out") }
    })
}

/// Draws the shortest path from each of some places back to its nearest source.
///
/// A path is as long as the distance less the start distance of the source. It begins at the target and ends at the
/// source; a target that is a source has one point. No two points that follow each other are at one position.
///
/// - `field`, `targets`: as for `taut_exact_field_distances`.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: receives one curve for each target, in their order, to be freed with `taut_curves_free`; NULL on failure. A
///   curve has no points where no source reaches, beyond `taut_exact_field_final_radius`, and for a vertex that no
///   triangle uses.
///
/// Errors: as for `taut_exact_field_distances`; TAUT_REASON_PATH_LOST names the target; TAUT_REASON_TOO_MANY_ELEMENTS where
/// the points exceed 32-bit indices; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: linear in the triangles that the
/// paths cross, and a look at each window of the triangle of a point. Threads: any. The control is consulted before each
/// path.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_paths(
    field: Option<&taut_exact_field>,
    targets: *const taut_targets,
    control: Option<&taut_control>,
    out: *mut *mut taut_curves,
) -> Status {
    let body = || {
        let taut_exact_field { field, mesh } = required(field, "field")?;
        // SAFETY: the header asks for NULL or a struct of the size that it states, and views of readable memory.
        let targets = match unsafe { self::targets(targets, "targets")? } {
            None => (0..).take(mesh.vertex_count()).map(Target::Vertex).collect(),
            Some(targets) => targets,
        };
        let paths = field.paths(&targets, &control_or_new(control))?;
        let mut curves = taut_curves::new();
        for (i, (path, &target)) in (0..).zip(paths.iter().zip(&targets)) {
            let source = if path.is_some() { field.nearest_source(target)? } else { None };
            curves.push(mesh, i, path.as_ref(), source)?;
        }
        Ok(curves)
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// What `answer` says of each target; an error names the target.
fn of_each<A>(targets: &[Target], answer: impl Fn(Target) -> Result<A>) -> Result<Vec<A>> {
    let answer = |(i, &target)| answer(target).map_err(|error| error.about(Element::Target(i)));
    (0..).zip(targets).map(answer).collect()
}

/// Tells up to which distance the field is complete: distances up to this one are there and final, beyond it all are
/// +INFINITY.
///
/// It is +INFINITY unless the work stopped at its targets or its radius, or was interrupted. Work that was interrupted early
/// may know no distance for certain; then it is below the least start distance.
///
/// - `field`: not NULL.
///
/// Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_final_radius(field: Option<&taut_exact_field>) -> f64 {
    guard_value(0.0, || Ok(required(field, "field")?.field.final_radius()))
}

/// Tells what interrupted the work before it had all that was asked for, where `allow_partial` let it succeed all the same.
///
/// - `field`: not NULL.
/// - `detail`: NULL, or receives the failure that its call would have been; set `struct_size` before the call. All zero but
///   the size if nothing interrupted it.
///
/// Returns TAUT_STATUS_OK if nothing did, TAUT_STATUS_CANCELLED or TAUT_STATUS_LIMIT_REACHED;
/// TAUT_STATUS_INVALID_ARGUMENT if `field` is NULL or `detail` without its size. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_field_interruption(
    field: Option<&taut_exact_field>,
    detail: *mut taut_error,
) -> Status {
    guard_value(Status::InvalidArgument, || {
        let interruption = required(field, "field")?.field.interruption();
        if !detail.is_null() {
            // SAFETY: it is not NULL, and the header asks for a struct of at least the size that it states.
            unsafe { write_sized(detail, interruption.map(error_detail).as_ref(), "detail")? };
        }
        Ok(interruption.map_or(Status::Ok, Error::status))
    })
}

/// Tells how many windows crossed a triangle: a measure of the work that does not depend on the machine.
///
/// - `field`: not NULL.
///
/// Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_windows(field: Option<&taut_exact_field>) -> u64 {
    guard_value(0, || Ok(required(field, "field")?.field.windows()))
}

/// Frees a field; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_free(field: Option<Box<taut_exact_field>>) {
    free(field);
}

/// Draws the open curve that goes through points in their order: straight from one to the next where a triangle holds both,
/// else along a shortest path. What the `taut_curves_` functions copy out of it is a curve among `taut_sources`.
///
/// - `exact`: not NULL.
/// - `faces`: rows of one index, the points: the triangle in which each lies.
/// - `barycentrics`: rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, as in
///   `taut_sources`.
/// - `control`: progress, cancellation and limits, or NULL.
/// - `out`: receives one curve, to be freed with `taut_curves_free`; NULL on failure. Of points that follow each other at
///   one place it has one; without points it has none.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT names the point that is no place on the mesh, or to which no way leads from the one
/// before it; TAUT_REASON_PATH_LOST; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT, TAUT_REASON_MEMORY_LIMIT. Cost: a
/// straight piece nothing, a shortest path that of a field as far as the next point, with `keep_windows`. Threads: any,
/// also on one `exact` at once. The control is consulted at each point, and as by `taut_exact_field_new`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_curve_through(
    exact: Option<&taut_exact>,
    faces: taut_input,
    barycentrics: taut_input,
    control: Option<&taut_control>,
    out: *mut *mut taut_curves,
) -> Status {
    let body = || {
        let taut_exact { solver, mesh } = required(exact, "exact")?;
        // SAFETY: the header asks for views of readable memory.
        let points = unsafe { surface_points(faces, barycentrics, "", Element::Point)? };
        let curve = solver.curve_through(&points, &control_or_new(control))?;
        let mut curves = taut_curves::new();
        curves.push(mesh, 0, Some(&curve), None)?;
        Ok(curves)
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}
