//! Curves that follow a field on the mesh: isolines and their levels, and paths of steepest descent.

use super::control::taut_control;
use super::curves::taut_curves;
use super::guard::{control_or_new, guard, guard_new, null, required};
use super::mesh::taut_mesh;
use super::places::{sources, targets, taut_sources, taut_targets};
use super::types::{taut_input, taut_output};
use crate::{Isoline, Mesh, Result, Status, Target, descent_paths, even_levels, isolines, spaced_levels};

/// The most levels that `taut_even_levels` and `taut_spaced_levels` give.
pub const TAUT_MAX_LEVELS: usize = 10_000;
const _: () = assert!(TAUT_MAX_LEVELS == crate::MAX_LEVELS);

/// Spreads levels evenly between the least and the greatest value of a field, for `taut_isolines_new`.
///
/// Only the values at triangles that can have lines count: those whose corners are all finite.
///
/// - `mesh`: not NULL.
/// - `values`: as for `taut_isolines_new`.
/// - `count`: how many levels are wanted, `TAUT_MAX_LEVELS` at most.
/// - `levels`: rows of one real number, at least as many as there are levels: never more than `count`. They ascend, and lie
///   strictly between the least and the greatest value.
/// - `written`: not NULL; receives how many levels there are: fewer than `count` where so many numbers do not fit in
///   between, and none where the field is constant.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where `count` is too large, or there are more or fewer values than vertices;
/// TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(F). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_even_levels(
    mesh: Option<&taut_mesh>,
    values: taut_input,
    count: usize,
    levels: taut_output,
    written: *mut usize,
) -> Status {
    let choose = |mesh: &Mesh, values: &[f64]| even_levels(mesh, values, count);
    // SAFETY: as the header asks.
    unsafe { choose_levels(mesh, values, choose, levels, written) }
}

/// Finds the multiples of a number that lie between the least and the greatest value of a field, for `taut_isolines_new`.
///
/// Only the values at triangles that can have lines count: those whose corners are all finite.
///
/// - `mesh`: not NULL.
/// - `values`: as for `taut_isolines_new`.
/// - `spacing`: positive and finite, in the unit of the values.
/// - `levels`: rows of one real number, at least as many as there are levels: never more than `TAUT_MAX_LEVELS`. They
///   ascend, and lie strictly between the least and the greatest value.
/// - `written`: not NULL; receives how many levels there are.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where `spacing` is not positive and finite, or so small that there would be more than
/// `TAUT_MAX_LEVELS`, or where there are more or fewer values than vertices; TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(F).
/// Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_spaced_levels(
    mesh: Option<&taut_mesh>,
    values: taut_input,
    spacing: f64,
    levels: taut_output,
    written: *mut usize,
) -> Status {
    let choose = |mesh: &Mesh, values: &[f64]| spaced_levels(mesh, values, spacing);
    // SAFETY: as the header asks.
    unsafe { choose_levels(mesh, values, choose, levels, written) }
}

/// # Safety
/// The views describe memory that is readable and writable, `written` is NULL or may be written.
unsafe fn choose_levels(
    mesh: Option<&taut_mesh>,
    values: taut_input,
    choose: impl FnOnce(&Mesh, &[f64]) -> Result<Vec<f64>>,
    levels: taut_output,
    written: *mut usize,
) -> Status {
    guard(|| {
        let mesh = &required(mesh, "mesh")?.0;
        if written.is_null() {
            return Err(null("written"));
        }
        // SAFETY: as the caller promises; `written` is not NULL.
        unsafe {
            let chosen = choose(mesh, &values.numbers("values")?)?;
            levels.write_scalars(chosen.as_chunks::<1>().0, "levels")?;
            written.write_unaligned(chosen.len());
        }
        Ok(())
    })
}

/// Draws the lines along which a field takes given values: points on edges of the mesh, joined through triangles.
///
/// A vertex counts as above a level that it has itself, so the lines are the border of all that is at the level or above:
/// a plateau has a line where it meets lower ground. Lines end at the boundary, beside triangles with a corner that is not
/// finite, which have no lines, and on edges of three or more triangles, from where each triangle's line goes by itself.
/// Higher ground is on a line's left in the first triangle that it crosses, seen from where the triangle's corners go
/// round counter-clockwise.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `values`: rows of one real number, as many as there are vertices, in any unit; not finite where there is no value.
/// - `levels`: rows of one real number, finite; in any order, and each has the same lines as if it were alone.
/// - `out`: receives the curves, those of the first level first, to be freed with `taut_curves_free`; NULL on failure.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer values than vertices, or naming the level that is not
/// finite; TAUT_REASON_TOO_MANY_ELEMENTS where the points exceed 32-bit indices. Cost: O(F log n + output) time for n
/// levels together, O(F + output) memory. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_isolines_new(
    mesh: Option<&taut_mesh>,
    values: taut_input,
    levels: taut_input,
    out: *mut *mut taut_curves,
) -> Status {
    let body = || {
        let mesh = &required(mesh, "mesh")?.0;
        // SAFETY: the header asks for views of readable memory.
        let (values, levels) = unsafe { (values.numbers("values")?, levels.numbers("levels")?) };
        let mut curves = taut_curves::new();
        for Isoline { level, curve } in isolines(mesh, &values, &levels)? {
            curves.push(mesh, level, Some(&curve), None)?;
        }
        Ok(curves)
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Draws the paths along which a field falls steepest, one from each of some places.
///
/// Down distances, of whatever origin, they lead back to the sources, and come near to the shortest paths. The field is
/// linear in each triangle, and never rises along a path. Without sources a path ends at a vertex that has no lower
/// neighbour, which may be the target itself. With sources it ends at one of them, also inside a triangle or on a curve;
/// where distances have a minimum that is no source, as where triangles are obtuse, it goes on over the lowest pass. No two
/// points that follow each other are at one position.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `values`: rows of one real number, as many as there are vertices, in any unit; not finite where there is no value.
/// - `sources`: what the values are the distances from; NULL, or none, for a field that is no distance.
/// - `targets`: where the paths begin; NULL means every vertex.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `out`: receives one curve for each target, in their order, to be freed with `taut_curves_free`; NULL on failure. A
///   curve has no points where the field is not finite, and for a vertex that no triangle uses.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer values than vertices; it and
/// TAUT_REASON_VERTEX_OUT_OF_RANGE name the source or target that the mesh does not have; TAUT_REASON_TOO_MANY_ELEMENTS
/// where the points exceed 32-bit indices; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: O(V log V) for all paths
/// together, and linear in the triangles that they cross. Threads: any. The control is consulted before each path.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_descent_paths_new(
    mesh: Option<&taut_mesh>,
    values: taut_input,
    sources: *const taut_sources,
    targets: *const taut_targets,
    control: Option<&taut_control>,
    out: *mut *mut taut_curves,
) -> Status {
    let body = || {
        let mesh = &required(mesh, "mesh")?.0;
        // SAFETY: the header asks for NULL or structs of the size that they state, and views of readable memory.
        let (values, sources, targets) = unsafe {
            let values = values.numbers("values")?;
            let sources = if sources.is_null() { Vec::new() } else { self::sources(sources)? };
            (values, sources, self::targets(targets, "targets")?)
        };
        let targets = targets.unwrap_or_else(|| (0..).take(mesh.vertex_count()).map(Target::Vertex).collect());
        let mut curves = taut_curves::new();
        let paths = descent_paths(mesh, &values, &sources, &targets, &control_or_new(control))?;
        for (target, path) in (0..).zip(&paths) {
            let source = path.as_ref().and_then(|path| path.source);
            curves.push(mesh, target, path.as_ref().map(|path| &path.curve), source)?;
        }
        Ok(curves)
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}
