//! `taut_curves`: polylines on the surface, and how to copy them out.

use super::guard::{free, guard, guard_value, required};
use super::types::taut_output;
use crate::{Curve, Error, Mesh, Reason, Result, Status};

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
    /// Where each curve leads.
    sources: Vec<Option<u32>>,
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
            sources: Vec::new(),
        }
    }

    /// Adds the line or path of what was asked: a level or a target. A path may be none, and leads to a source.
    pub(super) fn push(&mut self, mesh: &Mesh, level: u32, curve: Option<&Curve>, source: Option<u32>) -> Result<()> {
        let (points, is_closed) = curve.map_or((&[][..], false), |curve| (&curve.points, curve.is_closed));
        for point in points {
            self.positions.push(point.position(mesh)?);
            self.faces.push([point.face]);
            self.barycentrics.push(point.barycentric);
        }
        self.closed.push([u32::from(is_closed)]);
        self.levels.push([level]);
        self.sources.push(source);
        let end = u32::try_from(self.faces.len());
        self.offsets.push([end.map_err(|_| Error::new(Reason::TooManyElements, "the points exceed 32-bit indices"))?]);
        Ok(())
    }
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

/// Copies out what each curve answers to: which level an isoline belongs to, which target a path is from.
///
/// - `curves`: not NULL.
/// - `out`: rows of one index, at least `taut_curves_count` of them: the number of the level, never decreasing; of paths,
///   which are one for each target, just 0, 1, 2 and so on; of a curve through points 0.
///
/// Errors: as for `taut_curves_offsets`. Cost: linear in the curves. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_levels(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_indices(&required(curves, "curves")?.levels, "out") })
}

/// Copies out at which source each path ends, by its number among the sources.
///
/// - `curves`: not NULL.
/// - `out`: rows of one index, at least `taut_curves_count` of them: no index where a curve has no points or is no path, and
///   where a path of steepest descent ends at no source.
///
/// Errors: as for `taut_curves_offsets`. Cost: linear in the curves. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_curves_sources(curves: Option<&taut_curves>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_optional_indices(&required(curves, "curves")?.sources, "out") })
}

/// Frees curves; NULL is fine.
#[unsafe(no_mangle)]
pub extern "C" fn taut_curves_free(curves: Option<Box<taut_curves>>) {
    free(curves);
}
