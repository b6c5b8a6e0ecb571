//! `taut_closest`: the surface point nearest to a point in space.

use super::control::taut_control;
use super::guard::{control_or_new, free, guard, guard_new, required};
use super::mesh::taut_mesh;
use super::types::{taut_input, taut_output};
use crate::{Closest, Status};

/// A mesh prepared for questions of what is nearest to a point in space. Serves any number of calls.
pub struct taut_closest(Closest);

/// Prepares a mesh for questions of what is nearest to a point in space, such as a click or a cursor.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `out`: receives the prepared mesh, to be freed with `taut_closest_free`; NULL on failure.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where the mesh has no triangles, or only ignored ones. Cost: O(F log F) time, 0.1 kB
/// for each triangle. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_closest_new(mesh: Option<&taut_mesh>, out: *mut *mut taut_closest) -> Status {
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, || Ok(taut_closest(Closest::new(&required(mesh, "mesh")?.0)?))) }
}

/// Finds the place on the surface that is nearest to each of some points in space.
///
/// Of places that are equally near, one inside a triangle goes before one on an edge, that before a vertex; then the least
/// triangle counts. So a point nearest to an edge or a vertex gets the least of its triangles.
///
/// - `closest`: not NULL.
/// - `points`: rows of three real numbers, in mesh units, finite.
/// - `control`: progress, cancellation and a time limit, or NULL.
/// - `faces`: rows of one index, at least as many as there are points: the triangle in which the place lies.
/// - `barycentrics`: rows of three real numbers, at least as many: the weights of the triangle's corners, not negative,
///   their sum 1; 0 at the corner opposite the edge on which the place lies, and at both others if it is a vertex.
/// - `distances`: rows of one real number, at least as many: the straight distance in mesh units, INFINITY where it
///   exceeds the largest `double`.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT naming the point that is not finite, or where a face exceeds the type;
/// TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: about
/// O(log F) for a point, O(F log F) for one with all triangles equally near. Threads: any. The control is consulted every
/// 64 points.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_closest_points(
    closest: Option<&taut_closest>,
    points: taut_input,
    control: Option<&taut_control>,
    faces: taut_output,
    barycentrics: taut_output,
    distances: taut_output,
) -> Status {
    guard(|| {
        let closest = &required(closest, "closest")?.0;
        // SAFETY: the header asks for a view of readable memory.
        let points = unsafe { points.scalars(3, "points")?.positions() };
        // All three or none: what can fail about the others is asked before the first is written, and before the work.
        faces.index_layout(points.len(), 1, "faces")?;
        barycentrics.scalar_layout(points.len(), 3, "barycentrics")?;
        distances.scalar_layout(points.len(), 1, "distances")?;
        let found = closest.points(&points, &control_or_new(control))?;
        let face_rows: Vec<[u32; 1]> = found.iter().map(|closest| [closest.point.face]).collect();
        let barycentric_rows: Vec<[f64; 3]> = found.iter().map(|closest| closest.point.barycentric).collect();
        let distance_rows: Vec<[f64; 1]> = found.iter().map(|closest| [closest.distance]).collect();
        // SAFETY: the header asks for views of writable memory.
        unsafe {
            faces.write_indices(&face_rows, "faces")?;
            barycentrics.write_scalars(&barycentric_rows, "barycentrics")?;
            distances.write_scalars(&distance_rows, "distances")
        }
    })
}

/// Frees a prepared mesh; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_closest_free(closest: Option<Box<taut_closest>>) {
    free(closest);
}
