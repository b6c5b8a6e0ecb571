//! `taut_curves`: polylines on the surface, isolines, shortest paths and paths of steepest descent.

use super::guard::{free, guard, guard_new, guard_value, required};
use super::mesh::taut_mesh;
use super::types::{sources, targets, taut_input, taut_output, taut_sources, taut_targets};
use crate::{Curve, Error, Isoline, Mesh, Reason, Result, Status, Target, descent_paths, isolines};

/// Polylines on the surface of a mesh: isolines, shortest paths, or paths of steepest descent. Their points stand one after
/// another, those of the first curve first.
///
/// The segment from a point to the next one lies in the triangle that the point names. A closed curve has one more, from
/// its last point to its first, which is not repeated; the last point of an open one names the last segment's triangle.
pub struct taut_curves {
    /// Where the points of each curve begin, and where all end.
    offsets: Vec<[u32; 1]>,
    positions: Vec<[f64; 3]>,
    faces: Vec<[u32; 1]>,
    barycentrics: Vec<[f64; 3]>,
    /// 1 for a closed curve, else 0.
    closed: Vec<[u32; 1]>,
    levels: Vec<[u32; 1]>,
}

impl taut_curves {
    /// No curves yet.
    pub(super) fn new() -> taut_curves {
        taut_curves {
            offsets: vec![[0]],
            positions: Vec::new(),
            faces: Vec::new(),
            barycentrics: Vec::new(),
            closed: Vec::new(),
            levels: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, mesh: &Mesh, level: u32, curve: &Curve) -> Result<()> {
        self.positions.extend(curve.positions(mesh)?);
        self.faces.extend(curve.points.iter().map(|point| [point.face]));
        self.barycentrics.extend(curve.points.iter().map(|point| point.barycentric));
        self.closed.push([u32::from(curve.is_closed)]);
        self.levels.push([level]);
        let end = u32::try_from(self.faces.len());
        self.offsets.push([end.map_err(|_| Error::new(Reason::TooManyElements, "the points exceed 32-bit indices"))?]);
        Ok(())
    }
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
            curves.push(mesh, level, &curve)?;
        }
        Ok(curves)
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Draws the paths along which a field falls steepest, one from each of some places: down distances, of whatever origin,
/// they lead back to the sources, and come near to the shortest paths.
///
/// The field is linear in each triangle, and never rises along a path. Without sources a path ends at a vertex that has no
/// lower neighbour, which may be the target itself. With sources it ends at one of them, also inside a triangle or on a
/// curve; where distances have a minimum that is no source, as where triangles are obtuse, it goes on over the lowest pass.
/// No two points that follow each other are at one position.
///
/// - `mesh`: not NULL; it may be freed afterwards.
/// - `values`: rows of one real number, as many as there are vertices, in any unit; not finite where there is no value.
/// - `sources`: what the values are the distances from; NULL, or none, for a field that is no distance.
/// - `targets`: where the paths begin; NULL means every vertex.
/// - `out`: receives one curve for each target, in their order, to be freed with `taut_curves_free`; NULL on failure. A
///   curve has no points where the field is not finite, and for a vertex that no triangle uses.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer values than vertices; it and
/// TAUT_REASON_VERTEX_OUT_OF_RANGE name the source or target that the mesh does not have; TAUT_REASON_TOO_MANY_ELEMENTS
/// where the points exceed 32-bit indices. Cost: O(V log V) for all paths together, and linear in the triangles that they
/// cross. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_descent_paths_new(
    mesh: Option<&taut_mesh>,
    values: taut_input,
    sources: *const taut_sources,
    targets: *const taut_targets,
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
        for (target, path) in (0..).zip(descent_paths(mesh, &values, &sources, &targets)?) {
            let nothing = Curve { points: Vec::new(), is_closed: false };
            curves.push(mesh, target, &path.map_or(nothing, |path| path.curve))?;
        }
        Ok(curves)
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Tells how many curves there are.
///
/// - `curves`: not NULL.
///
/// Returns 0 if `curves` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_curves_count(curves: Option<&taut_curves>) -> usize {
    guard_value(0, || Ok(required(curves, "curves")?.levels.len()))
}

/// Tells how many points all curves have together.
///
/// - `curves`: not NULL.
///
/// Returns 0 if `curves` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_curves_point_count(curves: Option<&taut_curves>) -> usize {
    guard_value(0, || Ok(required(curves, "curves")?.faces.len()))
}

/// Copies out where the points of each curve begin: curve i has the points from offsets[i] up to, not including,
/// offsets[i + 1]: at least two, but for a path of length 0, which has one, and where there is no path, none.
///
/// - `curves`: not NULL.
/// - `out`: rows of one index, at least `taut_curves_count` + 1; the first is 0, the last the number of points.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an index exceeds the type. Cost: linear in the
/// curves. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_offsets(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_indices(&required(curves, "curves")?.offsets, "out") })
}

/// Copies the positions of the points out.
///
/// - `curves`: not NULL.
/// - `out`: rows of three real numbers, at least `taut_curves_point_count` of them; mesh units.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the points. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_positions(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_scalars(&required(curves, "curves")?.positions, "out") })
}

/// Copies the triangles of the points out.
///
/// - `curves`: not NULL.
/// - `out`: rows of one index, at least `taut_curves_point_count` of them.
///
/// Errors: as for `taut_curves_offsets`. Cost: linear in the points. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_faces(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_indices(&required(curves, "curves")?.faces, "out") })
}

/// Copies out where in its triangle each point lies: the weights of the corners.
///
/// - `curves`: not NULL.
/// - `out`: rows of three real numbers, at least `taut_curves_point_count` of them: not negative, their sum 1, and 0 at
///   the corner opposite the edge on which the point lies.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the points. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_barycentrics(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_scalars(&required(curves, "curves")?.barycentrics, "out") })
}

/// Copies out which curves are closed.
///
/// - `curves`: not NULL.
/// - `out`: rows of one index, at least `taut_curves_count` of them: 1 for a closed curve, else 0.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the curves. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_closed(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_indices(&required(curves, "curves")?.closed, "out") })
}

/// Copies out which level each curve belongs to, or which target or point each path is from.
///
/// - `curves`: not NULL.
/// - `out`: rows of one index, at least `taut_curves_count` of them: the place among the levels, never decreasing; of
///   paths, which are one for each target or point, just 0, 1, 2 and so on.
///
/// Errors: as for `taut_curves_offsets`. Cost: linear in the curves. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_levels(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_indices(&required(curves, "curves")?.levels, "out") })
}

/// Frees curves; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_curves_free(curves: Option<Box<taut_curves>>) {
    free(curves);
}
