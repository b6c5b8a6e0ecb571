//! Many exact fields in one call, over one prepared mesh: rows of distances, dense or within a radius, and farthest points.

use super::control::taut_control;
use super::exact::taut_exact;
use super::guard::{control_or_new, free, guard, guard_new, guard_value, required};
use super::places::{source_sets, sources, taut_sources};
use super::types::{taut_input, taut_output};
use crate::{SparseDistances, Status};

/// The distances of what lies within a radius of each of several sources: a sparse matrix in compressed rows, one row for
/// each source, one entry for each vertex that it reaches.
pub struct taut_sparse_distances(SparseDistances);

/// Computes the exact distances of every vertex from each of several sources, or sets of sources: one field for each.
///
/// - `exact`: not NULL.
/// - `sources`: where to measure from; not NULL.
/// - `set_offsets`: rows of one index, where each set begins among the sources and, at last, where they end: row i is about
///   the sources from set_offsets[i] up to, not including, set_offsets[i + 1], one at least. The first is 0, the last the
///   number of sources. No rows, as of `(taut_input){0}`, mean that each source is a set.
/// - `threads`: how many threads compute rows: 1 for the calling one only, 0 for as many as the machine has, 1024 at most.
///   The distances are the same, to the bit, for any number.
/// - `control`: progress, cancellation and limits, or NULL.
/// - `out`: rows of as many real numbers as there are vertices, at least one row for each set, in their order; mesh units.
///   +INFINITY where the set does not reach.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the offsets are no such numbers; TAUT_REASON_NO_SOURCE where a set has none;
/// TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; else as for `taut_exact_field_new`. Cost: that of
/// `taut_exact_field_new` for each set, shared by the threads, each with the memory of one field; and 8 bytes for each
/// number until all are there. Threads: any, also on one `exact` at once. The control is consulted as by
/// `taut_exact_field_new`, on every thread, but tells its progress on the calling one only, which may wait at the end for
/// the last row of another; a memory limit holds for each thread, without the rows.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_distance_rows(
    exact: Option<&taut_exact>,
    sources: *const taut_sources,
    set_offsets: taut_input,
    threads: usize,
    control: Option<&taut_control>,
    out: taut_output,
) -> Status {
    guard(|| {
        let taut_exact { solver, mesh } = required(exact, "exact")?;
        // SAFETY: the header asks for a struct of the size that it states, and views of readable memory.
        let sets = unsafe { source_sets(sources, set_offsets)? };
        out.scalar_layout(sets.len(), mesh.vertex_count(), "out")?;
        let rows = solver.distance_rows(&sets, threads, &control_or_new(control))?;
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalar_rows(&rows, mesh.vertex_count(), "out") }
    })
}

/// Computes the exact distances up to a radius from each of several sources.
///
/// - `exact`: not NULL.
/// - `sources`: where to measure from; not NULL. No source means no rows.
/// - `radius`: the largest distance wanted, start distances included, in mesh units, not negative. It counts as it is: 0
///   leaves what is no farther than 0, +INFINITY everything that a source reaches.
/// - `threads`: as for `taut_exact_distance_rows`.
/// - `control`: progress, cancellation and limits, or NULL.
/// - `out`: receives the distances, to be freed with `taut_sparse_distances_free`; NULL on failure.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the radius is negative or NaN; else as for `taut_exact_field_new`. Cost: time
/// and memory in proportion to what is reached, and for each thread 50 bytes a vertex and 12 a triangle. Threads: any, also
/// on one `exact` at once. The control is consulted as by `taut_exact_distance_rows`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_distances_within(
    exact: Option<&taut_exact>,
    sources: *const taut_sources,
    radius: f64,
    threads: usize,
    control: Option<&taut_control>,
    out: *mut *mut taut_sparse_distances,
) -> Status {
    let body = || {
        let solver = &required(exact, "exact")?.solver;
        // SAFETY: the header asks for a struct of the size that it states, and views of readable memory.
        let sources = unsafe { self::sources(sources)? };
        Ok(taut_sparse_distances(solver.distances_within(&sources, radius, threads, &control_or_new(control))?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Tells how many rows there are: one for each source.
///
/// - `distances`: not NULL.
///
/// Returns 0 if `distances` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_sparse_distances_row_count(distances: Option<&taut_sparse_distances>) -> usize {
    guard_value(0, || Ok(required(distances, "distances")?.0.rows()))
}

/// Tells how many entries all rows have together.
///
/// - `distances`: not NULL.
///
/// Returns 0 if `distances` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_sparse_distances_count(distances: Option<&taut_sparse_distances>) -> usize {
    guard_value(0, || Ok(required(distances, "distances")?.0.vertices().len()))
}

/// Copies out where the entries of each row begin: row i has the entries from offsets[i] up to, not including,
/// offsets[i + 1].
///
/// - `distances`: not NULL.
/// - `out`: rows of one index, at least `taut_sparse_distances_row_count` + 1; the first is 0, the last the number of
///   entries.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an offset exceeds the type. Cost: linear in the
/// rows. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_sparse_distances_offsets(
    distances: Option<&taut_sparse_distances>,
    out: taut_output,
) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_offsets(required(distances, "distances")?.0.row_start(), "out") })
}

/// Copies out which vertex each entry is about, in ascending order in each row.
///
/// - `distances`: not NULL.
/// - `out`: rows of one index, at least `taut_sparse_distances_count` of them.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an index exceeds the type. Cost: linear in the
/// entries. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_sparse_distances_vertices(
    distances: Option<&taut_sparse_distances>,
    out: taut_output,
) -> Status {
    guard(|| {
        let vertices = required(distances, "distances")?.0.vertices();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_indices(vertices.as_chunks::<1>().0, "out") }
    })
}

/// Copies out the distance of each entry, as `taut_exact_distance_rows` has it, to the bit.
///
/// - `distances`: not NULL.
/// - `out`: rows of one real number, at least `taut_sparse_distances_count` of them; mesh units.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the entries. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_sparse_distances_values(
    distances: Option<&taut_sparse_distances>,
    out: taut_output,
) -> Status {
    guard(|| {
        let values = required(distances, "distances")?.0.distances();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_scalars(values.as_chunks::<1>().0, "out") }
    })
}

/// Frees sparse distances; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_sparse_distances_free(distances: Option<Box<taut_sparse_distances>>) {
    free(distances);
}

/// Spreads vertices evenly over the surface, by farthest point sampling: each is the vertex that is farthest from the
/// sources and from all before it; of equally far ones the first.
///
/// - `exact`: not NULL.
/// - `sources`: what to begin with; not NULL, at least one.
/// - `count`: how many vertices are wanted.
/// - `control`: progress, cancellation and limits, or NULL.
/// - `vertices`: rows of one index, at least `count` of them; no index once no vertex of a triangle is farther than 0, as
///   when all are taken.
/// - `distances`: rows of one real number, at least `count` of them: how far each vertex was when it was taken, in mesh
///   units; +INFINITY for the first one in a component without any, 0 where there is no vertex.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; TAUT_REASON_BAD_ARGUMENT where a vertex exceeds the
/// type; else as for `taut_exact_field_new`. Cost: the first vertex as much as a field, each
/// further one about as much as the area that it takes, and O(V). Threads: any, also on one `exact` at once. The control is
/// consulted as by `taut_exact_field_new`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_exact_farthest_points(
    exact: Option<&taut_exact>,
    sources: *const taut_sources,
    count: usize,
    control: Option<&taut_control>,
    vertices: taut_output,
    distances: taut_output,
) -> Status {
    guard(|| {
        let solver = &required(exact, "exact")?.solver;
        // SAFETY: the header asks for a struct of the size that it states, and views of readable memory.
        let sources = unsafe { self::sources(sources)? };
        vertices.index_layout(count, 1, "vertices")?;
        distances.scalar_layout(count, 1, "distances")?;
        let samples = solver.farthest_points(&sources, count, &control_or_new(control))?;
        let row = |i: usize| samples.get(i).map_or((None, [0.0]), |&(v, distance)| (Some(v), [distance]));
        let (vertex_rows, distance_rows): (Vec<_>, Vec<_>) = (0..count).map(row).unzip();
        // SAFETY: the header asks for views of writable memory.
        unsafe {
            vertices.write_optional_indices(&vertex_rows, "vertices")?;
            distances.write_scalars(&distance_rows, "distances")
        }
    })
}
