//! `taut_mesh`: from buffers or a file.

use super::guard::{free, guard, guard_new, guard_value, null, required};
use super::types::{bad_enum, taut_input, taut_output};
use crate::{Error, Faces, Mesh, MeshFormat, Reason, Result, Status};
use libc::{c_char, c_void};
use std::ffi::CStr;

/// A mesh, checked once and then immutable: any soup of triangles. Vertex v of the mesh is vertex v of its input.
pub struct taut_mesh(pub(super) Mesh);

/// A mesh file format; there is no default.
pub type taut_format = u32;
/// Binary glTF 2.0: all triangles of the default scene, each where its nodes place it. Vertices of equal position are one
/// vertex, numbered by first appearance.
pub const TAUT_FORMAT_GLB: taut_format = 1;
/// Wavefront OBJ.
pub const TAUT_FORMAT_OBJ: taut_format = 2;
/// Geomview OFF in text.
pub const TAUT_FORMAT_OFF: taut_format = 3;
/// Stanford PLY, text or binary.
pub const TAUT_FORMAT_PLY: taut_format = 4;
/// STL, text or binary. Vertices of equal position are one vertex, numbered by first appearance.
pub const TAUT_FORMAT_STL: taut_format = 5;

/// Makes a mesh of triangles.
///
/// - `positions`: rows of three real numbers, the vertices in mesh units. A vertex that a triangle uses must be finite.
/// - `triangles`: rows of three vertex indices, each less than the number of vertices. A triangle that repeats an index
///   is kept but ignored: nothing travels over it.
/// - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
///
/// Errors: TAUT_REASON_INDEX_OUT_OF_RANGE names the face, TAUT_REASON_NON_FINITE_COORDINATE the vertex;
/// TAUT_REASON_TOO_MANY_ELEMENTS where the vertices or the 3 F corners exceed 32-bit indices. Cost: O(V + F) time and
/// memory. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_new(
    positions: taut_input,
    triangles: taut_input,
    out: *mut *mut taut_mesh,
) -> Status {
    let body = || {
        // SAFETY: the header asks for views of readable memory.
        let (positions, triangles) =
            unsafe { (positions.scalars(3, "positions")?, triangles.indices(3, "triangles")?) };
        Ok(taut_mesh(Mesh::from_buffers(positions, Faces::Triangles(triangles))?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Makes a mesh of polygons; each becomes a fan of triangles from its first corner.
///
/// - `positions`: as for `taut_mesh_new`.
/// - `offsets`: rows of one index, one more than there are faces, or none at all. Face f has the corners from
///   offsets[f] up to, not including, offsets[f + 1]: at least three. The first is 0, the last the number of corners.
/// - `corners`: rows of one vertex index, the corners of all faces one after another.
/// - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
///
/// Errors: as for `taut_mesh_new`; TAUT_REASON_BAD_OFFSETS and TAUT_REASON_FACE_TOO_SMALL name the face. Cost: O(V + F)
/// time and memory. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_new_polygons(
    positions: taut_input,
    offsets: taut_input,
    corners: taut_input,
    out: *mut *mut taut_mesh,
) -> Status {
    let body = || {
        // SAFETY: the header asks for views of readable memory.
        let (positions, offsets, corners) = unsafe {
            (positions.scalars(3, "positions")?, offsets.indices(1, "offsets")?, corners.indices(1, "corners")?)
        };
        Ok(taut_mesh(Mesh::from_buffers(positions, Faces::Polygons { offsets, corners })?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Makes a mesh of the same triangles with its vertices in other places: a mesh that moves.
///
/// What connects the triangles is not computed again; `taut_heat_with_mesh` saves more.
///
/// - `mesh`: not NULL; it stays as it is and may be freed before the new one.
/// - `positions`: rows of three real numbers, as many as there are vertices; mesh units.
/// - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
///
/// Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer positions than vertices;
/// TAUT_REASON_NON_FINITE_COORDINATE names the vertex. Cost: O(V + F). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_with_positions(
    mesh: Option<&taut_mesh>,
    positions: taut_input,
    out: *mut *mut taut_mesh,
) -> Status {
    let body = || {
        let mesh = required(mesh, "mesh")?;
        // SAFETY: the header asks for a view of readable memory.
        let positions = unsafe { positions.scalars(3, "positions")? };
        Ok(taut_mesh(mesh.0.with_positions(&positions.positions())?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Reads a mesh file. Polygons become fans as in `taut_mesh_new_polygons`.
///
/// - `path`: not NULL, UTF-8, ended by a zero byte; the suffix tells the format: .glb, .obj, .off, .ply, .stl, or these
///   and .gz.
/// - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
///
/// Errors: TAUT_STATUS_IO where the file cannot be read; TAUT_REASON_UNKNOWN_FORMAT where its suffix tells no format; else
/// as for `taut_mesh_read_bytes`. Cost: linear in the file. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_read(path: *const c_char, out: *mut *mut taut_mesh) -> Status {
    let body = || {
        // SAFETY: the header asks for a string that ends.
        let path = unsafe { utf8(path, "path")? };
        Ok(taut_mesh(Mesh::read(path)?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// Reads a mesh from the content of a file, compressed by gzip or not. Polygons become fans as in
/// `taut_mesh_new_polygons`.
///
/// - `data`: the content; may be NULL if `size` is 0.
/// - `size`: how many bytes it has.
/// - `format`: its format, which must be told.
/// - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
///
/// Errors: TAUT_REASON_MALFORMED and TAUT_REASON_TRUNCATED name the line, vertex or face where the content stops following
/// its format; TAUT_REASON_UNKNOWN_FORMAT where it uses a part of the format that is not read; TAUT_REASON_BAD_ARGUMENT
/// where there is no such format; else as for `taut_mesh_new_polygons`. Cost: linear in the content. Threads: any. Cannot be
/// cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_read_bytes(
    data: *const c_void,
    size: usize,
    format: taut_format,
    out: *mut *mut taut_mesh,
) -> Status {
    let body = || {
        let format = match format {
            TAUT_FORMAT_GLB => MeshFormat::Glb,
            TAUT_FORMAT_OBJ => MeshFormat::Obj,
            TAUT_FORMAT_OFF => MeshFormat::Off,
            TAUT_FORMAT_PLY => MeshFormat::Ply,
            TAUT_FORMAT_STL => MeshFormat::Stl,
            other => return Err(bad_enum("format", other)),
        };
        // SAFETY: the header asks for so many readable bytes.
        let content = unsafe { bytes(data, size)? };
        Ok(taut_mesh(Mesh::read_bytes(content, format)?))
    };
    // SAFETY: the header asks for a writable `out`.
    unsafe { guard_new(out, body) }
}

/// # Safety
/// `data` points to `size` readable bytes, or is NULL.
unsafe fn bytes<'a>(data: *const c_void, size: usize) -> Result<&'a [u8]> {
    match (size, isize::try_from(size)) {
        (0, _) => Ok(&[]),
        _ if data.is_null() => Err(null("data")),
        (_, Err(_)) => Err(Error::new(Reason::TooManyElements, "`data` spans more memory than there can be")),
        // SAFETY: as the caller promises, and the size is one that a slice can have.
        (_, Ok(_)) => Ok(unsafe { std::slice::from_raw_parts(data.cast(), size) }),
    }
}

/// # Safety
/// `text` is NULL or ends with a zero byte.
unsafe fn utf8<'a>(text: *const c_char, name: &str) -> Result<&'a str> {
    if text.is_null() {
        return Err(null(name));
    }
    // SAFETY: it is not NULL, and the caller promises its end.
    let text = unsafe { CStr::from_ptr(text) };
    text.to_str().map_err(|_| Error::new(Reason::BadArgument, format!("`{name}` is not UTF-8")))
}

/// Tells how many vertices the mesh has, those that no triangle uses included.
///
/// - `mesh`: not NULL.
///
/// Returns 0 if `mesh` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_mesh_vertex_count(mesh: Option<&taut_mesh>) -> usize {
    guard_value(0, || Ok(required(mesh, "mesh")?.0.vertex_count()))
}

/// Tells how many triangles the mesh has, ignored ones included; a polygon of n corners counts n - 2.
///
/// - `mesh`: not NULL.
///
/// Returns 0 if `mesh` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_mesh_triangle_count(mesh: Option<&taut_mesh>) -> usize {
    guard_value(0, || Ok(required(mesh, "mesh")?.0.triangle_count()))
}

/// Tells how many triangles are ignored because they repeat a vertex index.
///
/// - `mesh`: not NULL.
///
/// Returns 0 if `mesh` is NULL. Cost: O(1). Threads: any.
#[unsafe(no_mangle)]
pub extern "C" fn taut_mesh_ignored_count(mesh: Option<&taut_mesh>) -> usize {
    guard_value(0, || Ok(required(mesh, "mesh")?.0.ignored_triangles().len()))
}

/// Copies the vertex positions out.
///
/// - `mesh`: not NULL.
/// - `out`: rows of three real numbers, at least as many as there are vertices; mesh units.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(V). Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_positions(mesh: Option<&taut_mesh>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_scalars(required(mesh, "mesh")?.0.positions(), "out") })
}

/// Copies the triangles out.
///
/// - `mesh`: not NULL.
/// - `out`: rows of three vertex indices, at least as many as there are triangles.
///
/// Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an index exceeds the type. Cost: O(F).
/// Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_triangles(mesh: Option<&taut_mesh>, out: taut_output) -> Status {
    // SAFETY: the header asks for a view of writable memory.
    guard(|| unsafe { out.write_indices(required(mesh, "mesh")?.0.triangles(), "out") })
}

/// Copies the numbers of the ignored triangles out, ascending.
///
/// - `mesh`: not NULL.
/// - `out`: rows of one index, at least `taut_mesh_ignored_count` of them.
///
/// Errors: as for `taut_mesh_triangles`. Cost: linear in their number. Threads: any. Cannot be cancelled.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn taut_mesh_ignored_triangles(mesh: Option<&taut_mesh>, out: taut_output) -> Status {
    guard(|| {
        let ignored = required(mesh, "mesh")?.0.ignored_triangles();
        // SAFETY: the header asks for a view of writable memory.
        unsafe { out.write_indices(ignored.as_chunks::<1>().0, "out") }
    })
}

/// Frees a mesh; NULL is fine. What was made from it stays valid.
#[unsafe(no_mangle)]
pub extern "C" fn taut_mesh_free(mesh: Option<Box<taut_mesh>>) {
    free(mesh);
}
