//! `taut_exact` and `taut_exact_field`: exact distances.

use super::control::taut_control;
use super::guard::{control_or_new, free, guard, guard_new, guard_value, required};
use super::mesh::taut_mesh;
use super::types::{SizedStruct, bad_enum, read_sized, sources, taut_input, taut_output, taut_sources, vertices};
use crate::{Element, Error, ExactField, ExactOptions, ExactSolver, Result, Status};

/// A mesh prepared for exact distances. Serves any number of calls.
pub struct taut_exact(ExactSolver);

/// The exact distances from one set of sources.
pub struct taut_exact_field(ExactField);

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
    /// 0.
    pub reserved: u32,
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
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, || Ok(taut_exact(ExactSolver::new(&required(mesh, "mesh")?.0)?))) }
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
/// Errors: TAUT_REASON_NO_SOURCE; TAUT_REASON_VERTEX_OUT_OF_RANGE names the source or target; TAUT_REASON_BAD_ARGUMENT;
/// and, unless `allow_partial` is set, TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT, TAUT_REASON_MEMORY_LIMIT. Cost:
/// about 20 windows per triangle on scanned surfaces, O(V^2) at worst, and with targets or a radius in proportion to the
/// area within; memory for the moving front, 32 bytes a vertex and 12 a triangle. Threads: any, also on one `exact` at
/// once. The control is consulted every few thousand windows, about a millisecond apart, in which the memory grows by a
/// few hundred kB at most.
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
        Ok(taut_exact_field(exact.0.field(&sources, &options, &control_or_new(control))?))
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
    if options.reserved != 0 {
        return Err(bad_enum("options.reserved", options.reserved));
    }
    let radius = if options.radius == 0.0 { f64::INFINITY } else { options.radius };
    Ok(ExactOptions { targets, radius, allow_partial: options.allow_partial == 1, keep_windows: false })
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
        let distances = required(field, "field")?.0.distances();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalars(distances.as_chunks::<1>().0, "out") }
    })
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
    guard_value(0.0, || Ok(required(field, "field")?.0.final_radius()))
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
        Ok(required(field, "field")?.0.interruption().map_or(Status::Ok, Error::status))
    })
}

/// Frees a field; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_exact_field_free(field: Option<Box<taut_exact_field>>) {
    free(field);
}
