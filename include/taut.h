/*
 * taut: geodesic distances on triangle meshes. This header is the manual; its sections stand in the order of use.
 *
 * Two methods. Exact: the length of the shortest way over the flat triangles, right to rounding. Heat: an approximation
 * within a percent or two on good meshes; it is prepared once per mesh and then answers each set of sources fast.
 *
 * A whole program, which tells how far it is across a square:
 *
 *     #include <stdio.h>
 *     #include <taut.h>
 *
 *     int main(void) {
 *         const double xyz[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
 *         const uint32_t corners[2][3] = {{0, 1, 3}, {1, 2, 3}}, vertex = 0;
 *         const taut_sources from = {.struct_size = sizeof from, .vertices = {.data = &vertex, .count = 1}};
 *         taut_mesh *mesh = NULL;
 *         taut_exact *exact = NULL;
 *         taut_exact_field *field = NULL;
 *         double d[4];
 *
 *         taut_status status = taut_mesh_new((taut_input){.data = xyz, .count = 4},
 *                                            (taut_input){.data = corners, .count = 2}, &mesh);
 *         if (!status) status = taut_exact_new(mesh, &exact);
 *         if (!status) status = taut_exact_field_new(exact, &from, NULL, NULL, &field);
 *         if (!status) status = taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 4});
 *         if (status) fprintf(stderr, "%s\n", taut_last_error(NULL));
 *         else printf("%g\n", d[2]);
 *
 *         taut_exact_field_free(field);
 *         taut_exact_free(exact);
 *         taut_mesh_free(mesh);
 *         return status ? 1 : 0;
 *     }
 *
 * By the heat method: taut_heat_new(mesh, NULL, NULL, &heat), then for each set of sources taut_heat_field_new(heat, &from,
 * NULL, &field) and taut_heat_field_distances(field, out). In the end each handle is freed by its _free.
 *
 * From C++17 on, taut.hpp says all of this with classes, exceptions and containers, over these functions alone.
 *
 * A place on the surface that is no vertex is a triangle and the weights of its three corners, in two buffers: a row of one
 * index and a row of three real numbers. taut_closest_points() finds the places of clicks; each is a source or a target as
 * it stands. The shortest path from the second of two clicks back to the first:
 *
 *     // const double clicks[2][3]; uint32_t faces[2]; double weights[2][3], off[2];
 *     status = taut_closest_points(closest, (taut_input){.data = clicks, .count = 2}, NULL,
 *                                  (taut_output){.data = faces, .count = 2},
 *                                  (taut_output){.data = weights, .count = 2}, (taut_output){.data = off, .count = 2});
 *     taut_sources first = {.struct_size = sizeof first, .faces = {.data = faces, .count = 1},
 *                           .barycentrics = {.data = weights, .count = 1}};
 *     taut_targets second = {.struct_size = sizeof second, .faces = {.data = faces + 1, .count = 1},
 *                            .barycentrics = {.data = weights + 1, .count = 1}};
 *     taut_exact_options options = {.struct_size = sizeof options, .targets = &second, .keep_windows = 1};
 *     if (!status) status = taut_exact_field_new(exact, &first, &options, NULL, &field);
 *     if (!status) status = taut_exact_field_paths(field, &second, NULL, &path);
 *
 * Then taut_curves_point_count(path) tells how many points it has, taut_curves_positions() where they are.
 *
 * Ownership. A call that makes a handle writes it through its last parameter; free it once with the _free of its type.
 * Handles may be freed in any order: what was made from a mesh keeps what it needs of it. Buffers and structs that are
 * passed in stay the caller's; a call reads them while it runs and keeps nothing.
 *
 * Errors. Every call that can fail returns a taut_status, 0 on success. On failure a handle that the call should have
 * made is NULL and no output is written. taut_last_error() then tells what went wrong, and with which vertex, face or
 * source. Calls that return a plain value return 0 on failure. Descriptions name what is particular to a call; any may
 * fail with TAUT_REASON_NULL_POINTER, with TAUT_REASON_BAD_ARGUMENT for a struct or buffer that makes no sense, and with
 * TAUT_REASON_TOO_MANY_ELEMENTS for one larger than memory. No call ends the process or prints, but for two cases: a lack
 * of memory ends it, and a defect of the library (TAUT_STATUS_INTERNAL) leaves a note on standard error.
 *
 * NULL. A pointer may be NULL only where its description says so; elsewhere NULL is an error, not a crash. Freeing NULL
 * is fine. A buffer of 0 rows may have data NULL.
 *
 * Zero is the default. A field that is 0 asks for the default, so clear a struct and set what you need: in C by
 * designated initialisers, in C++ by `taut_sources from = {};`. The enums of parameters are integers whose values start
 * at 1; a value that the library does not know is an error.
 *
 * Threads. Handles never change once they are made, but for taut_control: any number of threads may use one at once,
 * and results do not depend on it. Only freeing needs care: no other call may be using the handle. No thread of the
 * library outlives a call, and none calls a function of yours: a callback runs on the thread that made the call.
 *
 * Limits. A call that takes a taut_control consults it now and then, as its description says: it tells its progress,
 * and ends there if it was cancelled or has reached a limit of time or memory. Then it writes nothing, unless its
 * options let it succeed with a part (allow_partial). A call that takes none is short: about a second at most for a
 * million triangles.
 *
 * Units. Coordinates, distances and start distances are in mesh units, a time step in mesh units squared, angles in
 * radians; progress is in [0, 1]. V, E and F are the numbers of vertices, edges and triangles. Indices count from 0; where
 * there is none to tell, which descriptions call no index, all of its bits are set: -1 in a signed type, the largest value
 * of an unsigned one.
 *
 * Versions. A struct that starts with struct_size grows at its end only: set it to sizeof it. Programs compiled
 * with an older or newer header keep working; setting a field that the running library does not know is an error.
 * Values of enums are never reused. Before version 1.0 a minor version, after it a major version, may break the
 * interface; then TAUT_ABI and the library's soname change.
 */


#ifndef TAUT_H
#define TAUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** Version of this header; taut_version() tells that of the library. */
#define TAUT_VERSION_MAJOR 0
#define TAUT_VERSION_MINOR 1
#define TAUT_VERSION_PATCH 0

/** The binary interface of this header; taut_abi() tells that of the library. */
#define TAUT_ABI (TAUT_VERSION_MAJOR > 0 ? TAUT_VERSION_MAJOR * 65536 : TAUT_VERSION_MINOR)

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/* ---------------------------------------------------- Handles ----------------------------------------------------- */

/** Watches, limits and cancels a long call from any thread. */
typedef struct taut_control taut_control;

/** A mesh, checked once and then immutable: any soup of triangles. Vertex v of the mesh is vertex v of its input. */
typedef struct taut_mesh taut_mesh;

/** A mesh prepared for questions of what is nearest to a point in space. Serves any number of calls. */
typedef struct taut_closest taut_closest;

/** A mesh prepared for exact distances. Serves any number of calls. */
typedef struct taut_exact taut_exact;

/** The exact distances from one set of sources, and the shortest paths to them. */
typedef struct taut_exact_field taut_exact_field;

/**
 * The distances of what lies within a radius of each of several sources: a sparse matrix in compressed rows, one row for
 * each source, one entry for each vertex that it reaches.
 */
typedef struct taut_sparse_distances taut_sparse_distances;

/** The heat method prepared for one mesh and one time step: operators and their factors. Serves any number of calls. */
typedef struct taut_heat taut_heat;

/** The distances from one set of sources by the heat method. */
typedef struct taut_heat_field taut_heat_field;

/**
 * Polylines on the surface of a mesh: isolines, shortest paths, or paths of steepest descent. Their points stand one after
 * another, those of the first curve first.
 *
 * The segment from a point to the next one lies in the triangle that the point names. A closed curve has one more, from
 * its last point to its first, which is not repeated; the last point of an open one names the last segment's triangle.
 */
typedef struct taut_curves taut_curves;

/** The diagnosis of a mesh. */
typedef struct taut_report taut_report;

/* ---------------------------------------------------- Versions ---------------------------------------------------- */

/**
 * Tells the version of the library that runs, for example "0.1.0".
 *
 * Returns a string that is valid for ever. Errors: none. Cost: O(1). Threads: any.
 */
const char *taut_version(void);

/**
 * Tells the binary interface of the library that runs; a plug-in that loads it by hand compares it to `TAUT_ABI`.
 *
 * Returns the `TAUT_ABI` that the library was built with. Errors: none. Cost: O(1). Threads: any.
 */
uint32_t taut_abi(void);

/**
 * Names a status, for example "invalid mesh".
 *
 * - `status`: any number, so that a status of a newer library is fine.
 *
 * Returns a string that is valid for ever; "unknown" for a number that is no status. Errors: none. Cost: O(1).
 * Threads: any.
 */
const char *taut_status_name(int32_t status);

/* ----------------------------------------------------- Errors ----------------------------------------------------- */

/** Coarse classes of failure; bindings map them one to one to exceptions. */
enum taut_status
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /** No failure. */
    TAUT_STATUS_OK = 0,
    /** A parameter is outside its documented range. */
    TAUT_STATUS_INVALID_ARGUMENT = 1,
    /** The mesh cannot be used: a bad index or coordinate. */
    TAUT_STATUS_INVALID_MESH = 2,
    /** A file could not be opened, read or written. */
    TAUT_STATUS_IO = 3,
    /** A file's content is not what its format asks for. */
    TAUT_STATUS_FORMAT = 4,
    /** A valid request that this build or version does not serve. */
    TAUT_STATUS_UNSUPPORTED = 5,
    /** The computation broke down numerically. */
    TAUT_STATUS_NUMERIC = 6,
    /** The caller cancelled the work. */
    TAUT_STATUS_CANCELLED = 7,
    /** A size exceeds what the library can address or allocate. */
    TAUT_STATUS_TOO_LARGE = 8,
    /** A defect of the library; please report it. */
    TAUT_STATUS_INTERNAL = 9,
    /** The work reached a limit that the caller set. */
    TAUT_STATUS_LIMIT_REACHED = 10,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum taut_status taut_status;
#else
typedef int32_t taut_status;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/** What went wrong, finer than the status. */
enum taut_reason
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /** A required pointer was NULL. */
    TAUT_REASON_NULL_POINTER = 1,
    /** An argument has a value that its documentation excludes. */
    TAUT_REASON_BAD_ARGUMENT = 2,
    /** No source was given. */
    TAUT_REASON_NO_SOURCE = 3,
    /** A source or target names a vertex that the mesh does not have. */
    TAUT_REASON_VERTEX_OUT_OF_RANGE = 4,
    /** A buffer is too small for its count and stride. */
    TAUT_REASON_BUFFER_TOO_SMALL = 5,
    /** The time step t is not positive and finite. */
    TAUT_REASON_BAD_TIME_STEP = 6,
    /** With pure Dirichlet conditions a source lies on the boundary. */
    TAUT_REASON_SOURCE_ON_BOUNDARY = 7,
    /** A face names a vertex that the mesh does not have. */
    TAUT_REASON_INDEX_OUT_OF_RANGE = 20,
    /** A vertex that a face uses has a coordinate that is NaN or infinite. */
    TAUT_REASON_NON_FINITE_COORDINATE = 21,
    /** Polygon offsets do not start at 0, decrease, or do not end at the corner count. */
    TAUT_REASON_BAD_OFFSETS = 22,
    /** A face has fewer than three corners. */
    TAUT_REASON_FACE_TOO_SMALL = 23,
    /** The file could not be opened, read or written. */
    TAUT_REASON_IO = 40,
    /** The file's content does not follow its format. */
    TAUT_REASON_MALFORMED = 41,
    /** The file ends before its content does. */
    TAUT_REASON_TRUNCATED = 42,
    /** The file's format is not one that the library reads. */
    TAUT_REASON_UNKNOWN_FORMAT = 43,
    /** This build lacks the requested feature. */
    TAUT_REASON_MISSING_FEATURE = 50,
    /** A factorisation met a pivot that is not positive. */
    TAUT_REASON_NOT_POSITIVE_DEFINITE = 60,
    /** Rounding leaves a path undetermined, among triangles without area that lie upon each other. */
    TAUT_REASON_PATH_LOST = 61,
    /** The caller cancelled. */
    TAUT_REASON_CANCELLED = 70,
    /** The time limit of the control is over. */
    TAUT_REASON_TIME_LIMIT = 71,
    /** The work uses more memory than the control allows. */
    TAUT_REASON_MEMORY_LIMIT = 72,
    /** More vertices, faces or half-edges than 32-bit indices address. */
    TAUT_REASON_TOO_MANY_ELEMENTS = 80,
    /** An allocation failed. */
    TAUT_REASON_OUT_OF_MEMORY = 81,
    /** A panic was caught at the C border. */
    TAUT_REASON_PANIC = 90,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum taut_reason taut_reason;
#else
typedef int32_t taut_reason;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/** What kind of element an error is about. */
enum taut_element
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : int32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
    /** No single element. */
    TAUT_ELEMENT_NONE = 0,
    /** A vertex of the mesh. */
    TAUT_ELEMENT_VERTEX = 1,
    /** A face of the input. */
    TAUT_ELEMENT_FACE = 2,
    /** A row of the sources. */
    TAUT_ELEMENT_SOURCE = 3,
    /** A row of the targets. */
    TAUT_ELEMENT_TARGET = 4,
    /** A line of a text file, counted from 1. */
    TAUT_ELEMENT_LINE = 5,
    /** A row of the levels. */
    TAUT_ELEMENT_LEVEL = 6,
    /** A row of the points. */
    TAUT_ELEMENT_POINT = 7,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum taut_element taut_element;
#else
typedef int32_t taut_element;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

/** The last failure in detail. */
typedef struct {
    /** `sizeof(taut_error)`, set by the caller. */
    size_t struct_size;
    /** What the failing call returned. */
    taut_status status;
    /** What went wrong, finer than the status. */
    taut_reason reason;
    /** What kind of element is at fault. */
    taut_element element;
    /** 0. */
    uint32_t reserved;
    /** Which one: counted from 0, a line from 1; 0 where `element` is `TAUT_ELEMENT_NONE`. */
    uint64_t index;
} taut_error;

/**
 * Tells what the last failed call on this thread ran into.
 *
 * Success never clears it, so look here only after a call has failed.
 *
 * - `detail`: NULL, or receives the failure in detail; set `struct_size` before the call. All zero but the size if no
 *   call has failed on this thread.
 *
 * Returns the message for people, UTF-8, in English, naming the parameter and the element; "" if no call has failed.
 * It stays valid until the next failure on this thread or the thread's end.
 *
 * Errors: none. Cost: O(1). Threads: any; each has its own last failure.
 */
const char *taut_last_error(taut_error *detail);

/* ---------------------------------------------------- Buffers ----------------------------------------------------- */

/** Element type of a buffer; 0 means `double` where real numbers are asked for and `uint32_t` where indices are. */
typedef uint32_t taut_type;
/** `float`. */
#define TAUT_TYPE_F32 1
/** `double`. */
#define TAUT_TYPE_F64 2
/** `uint16_t`. */
#define TAUT_TYPE_U16 3
/** `uint32_t`. */
#define TAUT_TYPE_U32 4
/** `uint64_t`. */
#define TAUT_TYPE_U64 5
/** `int32_t`; a negative index is an error. */
#define TAUT_TYPE_I32 6
/** `int64_t`; a negative index is an error. */
#define TAUT_TYPE_I64 7

/**
 * A buffer that a call reads: `count` rows, `stride` bytes apart, of as many elements as the parameter says.
 *
 * A plain `const double *xyz` with n vertices is `{ .data = xyz, .count = n }`; a numpy array is its data, shape,
 * stride and type. Alignment does not matter, and nothing of the buffer is kept after the call.
 */
typedef struct {
    /** The first row; may be NULL if `count` is 0. */
    const void *data;
    /** How many rows there are. */
    size_t count;
    /** Bytes from one row to the next; 0 means that rows follow each other without a gap. */
    size_t stride;
    /** Type of an element; 0 means `double` or `uint32_t`. */
    taut_type type;
    /** 0. */
    uint32_t reserved;
} taut_input;

/**
 * A buffer that a call fills, laid out like `taut_input`.
 *
 * A call fills all the rows it has or, on failure, none. Bytes between rows are left alone. The rows must not overlap, nor
 * the outputs of a call; an output may lie over its inputs, which are read before anything is written.
 */
typedef struct {
    /** The first row; may be NULL if `count` is 0. */
    void *data;
    /** How many rows there is room for; more than needed is fine, the rest is left alone. */
    size_t count;
    /** Bytes from one row to the next; 0 means that rows follow each other without a gap. */
    size_t stride;
    /** Type of an element; 0 means `double` or `uint32_t`. A `float` receives the nearest value. */
    taut_type type;
    /** 0. */
    uint32_t reserved;
} taut_output;

/* --------------------------------------- Progress, cancellation and limits ---------------------------------------- */

/**
 * A function of yours that is told the progress, in [0, 1], and the `user` that was set with it.
 *
 * It returns 0 to go on; any other number cancels the call. It must return: no exception, no `longjmp`.
 */
typedef int (*taut_callback)(double progress, void *user);

/**
 * Makes a control, at progress 0, not cancelled, without limits or callback.
 *
 * Use a new one for each call, or one for several calls that share a limit.
 *
 * - `out`: receives the control; free it with `taut_control_free` once the call that uses it has returned.
 *
 * Errors: none in particular. Cost: O(1). Threads: any.
 */
taut_status taut_control_new(taut_control **out);

/**
 * Asks the call that uses the control to stop: at its next check it ends with TAUT_STATUS_CANCELLED.
 *
 * A call that starts with a cancelled control stops at once; one that has just ended is not undone.
 *
 * - `control`: not NULL.
 *
 * Errors: none in particular. Cost: O(1). Threads: any.
 */
void taut_control_cancel(const taut_control *control);

/**
 * Tells whether `taut_control_cancel` was called or a callback has cancelled.
 *
 * - `control`: not NULL.
 *
 * Returns false if `control` is NULL. Cost: O(1). Threads: any.
 */
bool taut_control_is_cancelled(const taut_control *control);

/**
 * Tells the share of the work that is done, in [0, 1].
 *
 * - `control`: not NULL.
 *
 * Returns 0 if `control` is NULL. Cost: O(1). Threads: any.
 */
double taut_control_progress(const taut_control *control);

/**
 * Limits the time: a call that uses the control ends with TAUT_REASON_TIME_LIMIT at its first check after so many seconds
 * from now.
 *
 * A later limit takes the place of an earlier one, also while a call runs.
 *
 * - `control`: not NULL.
 * - `seconds`: not negative; 0 means no limit, as does +INFINITY.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where `seconds` is negative or NaN. Cost: O(1). Threads: any.
 */
taut_status taut_control_set_time_limit(const taut_control *control, double seconds);

/**
 * Limits the memory that a call takes beyond its mesh and what was prepared: it ends with TAUT_REASON_MEMORY_LIMIT at its
 * first check beyond the limit.
 *
 * Only calls that compute exact distances count their memory: each of their threads by itself, and without the rows
 * that they gather. To other calls this makes no difference.
 *
 * - `control`: not NULL.
 * - `bytes`: 0 means no limit.
 *
 * Errors: none in particular. Cost: O(1). Threads: any.
 */
taut_status taut_control_set_memory_limit(const taut_control *control, size_t bytes);

/**
 * Lets a call that uses the control tell its progress to a function of yours, at each of its checks or, after
 * `taut_control_set_callback_interval`, less often; on the thread that makes the call and no other.
 *
 * - `control`: not NULL.
 * - `callback`: may use the control; it is not called again while it runs. NULL means none.
 * - `user`: handed to the callback as it is; may be NULL. It must stay valid until the callback is replaced or the
 *   control freed, and no call uses the control any more.
 *
 * Errors: none in particular. Cost: O(1). Threads: any.
 */
taut_status taut_control_set_callback(const taut_control *control, taut_callback callback, void *user);

/**
 * Lets the callback rest: from one time that it is called to the next at least so long goes by, but for the end of the work,
 * at progress 1, which is always told. For a callback that is not done within a microsecond.
 *
 * - `control`: not NULL.
 * - `seconds`: not negative; 0, which is the default, means that it is called at each check.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where `seconds` is negative or NaN. Cost: O(1). Threads: any.
 */
taut_status taut_control_set_callback_interval(const taut_control *control, double seconds);

/** Frees a control; NULL is fine. */
void taut_control_free(taut_control *control);

/* ----------------------------------------------------- Meshes ----------------------------------------------------- */

/** A mesh file format; there is no default. */
typedef uint32_t taut_format;
/**
 * Binary glTF 2.0: all triangles of the default scene, each where its nodes place it. Vertices of equal position are one
 * vertex, numbered by first appearance.
 */
#define TAUT_FORMAT_GLB 1
/** Wavefront OBJ. */
#define TAUT_FORMAT_OBJ 2
/** Geomview OFF in text. */
#define TAUT_FORMAT_OFF 3
/** Stanford PLY, text or binary. */
#define TAUT_FORMAT_PLY 4
/** STL, text or binary. Vertices of equal position are one vertex, numbered by first appearance. */
#define TAUT_FORMAT_STL 5

/**
 * Makes a mesh of triangles.
 *
 * - `positions`: rows of three real numbers, the vertices in mesh units. A vertex that a triangle uses must be finite.
 * - `triangles`: rows of three vertex indices, each less than the number of vertices. A triangle that repeats an index
 *   is kept but ignored: nothing travels over it.
 * - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_INDEX_OUT_OF_RANGE names the face, TAUT_REASON_NON_FINITE_COORDINATE the vertex;
 * TAUT_REASON_TOO_MANY_ELEMENTS where the vertices or the 3 F corners exceed 32-bit indices. Cost: O(V + F) time and
 * memory. Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_new(taut_input positions, taut_input triangles, taut_mesh **out);

/**
 * Makes a mesh of polygons; each becomes a fan of triangles from its first corner.
 *
 * - `positions`: as for `taut_mesh_new`.
 * - `offsets`: rows of one index, one more than there are faces, or none at all. Face f has the corners from
 *   offsets[f] up to, not including, offsets[f + 1]: at least three. The first is 0, the last the number of corners.
 * - `corners`: rows of one vertex index, the corners of all faces one after another.
 * - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
 *
 * Errors: as for `taut_mesh_new`; TAUT_REASON_BAD_OFFSETS and TAUT_REASON_FACE_TOO_SMALL name the face. Cost: O(V + F)
 * time and memory. Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_new_polygons(taut_input positions, taut_input offsets, taut_input corners, taut_mesh **out);

/**
 * Makes a mesh of the same triangles with its vertices in other places: a mesh that moves.
 *
 * What connects the triangles is not computed again; `taut_heat_with_mesh` saves more.
 *
 * - `mesh`: not NULL; it stays as it is and may be freed before the new one.
 * - `positions`: rows of three real numbers, as many as there are vertices; mesh units.
 * - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer positions than vertices;
 * TAUT_REASON_NON_FINITE_COORDINATE names the vertex. Cost: O(V + F). Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_with_positions(const taut_mesh *mesh, taut_input positions, taut_mesh **out);

/**
 * Reads a mesh file. Polygons become fans as in `taut_mesh_new_polygons`.
 *
 * - `path`: not NULL, UTF-8, ended by a zero byte; the suffix tells the format: .glb, .obj, .off, .ply, .stl, or these
 *   and .gz.
 * - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
 *
 * Errors: TAUT_STATUS_IO where the file cannot be read; TAUT_REASON_UNKNOWN_FORMAT where its suffix tells no format; else
 * as for `taut_mesh_read_bytes`. Cost: linear in the file. Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_read(const char *path, taut_mesh **out);

/**
 * Reads a mesh from the content of a file, compressed by gzip or not. Polygons become fans as in
 * `taut_mesh_new_polygons`.
 *
 * - `data`: the content; may be NULL if `size` is 0.
 * - `size`: how many bytes it has.
 * - `format`: its format, which must be told.
 * - `out`: receives the mesh, to be freed with `taut_mesh_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_MALFORMED and TAUT_REASON_TRUNCATED name the line, vertex or face where the content stops following
 * its format; TAUT_REASON_UNKNOWN_FORMAT where it uses a part of the format that is not read; TAUT_REASON_BAD_ARGUMENT
 * where there is no such format; else as for `taut_mesh_new_polygons`. Cost: linear in the content. Threads: any. Cannot be
 * cancelled.
 */
taut_status taut_mesh_read_bytes(const void *data, size_t size, taut_format format, taut_mesh **out);

/**
 * Tells how many vertices the mesh has, those that no triangle uses included.
 *
 * - `mesh`: not NULL.
 *
 * Returns 0 if `mesh` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_mesh_vertex_count(const taut_mesh *mesh);

/**
 * Tells how many triangles the mesh has, ignored ones included; a polygon of n corners counts n - 2.
 *
 * - `mesh`: not NULL.
 *
 * Returns 0 if `mesh` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_mesh_triangle_count(const taut_mesh *mesh);

/**
 * Tells how many triangles are ignored because they repeat a vertex index.
 *
 * - `mesh`: not NULL.
 *
 * Returns 0 if `mesh` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_mesh_ignored_count(const taut_mesh *mesh);

/**
 * Copies the vertex positions out.
 *
 * - `mesh`: not NULL.
 * - `out`: rows of three real numbers, at least as many as there are vertices; mesh units.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(V). Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_positions(const taut_mesh *mesh, taut_output out);

/**
 * Copies the triangles out.
 *
 * - `mesh`: not NULL.
 * - `out`: rows of three vertex indices, at least as many as there are triangles.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an index exceeds the type. Cost: O(F).
 * Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_triangles(const taut_mesh *mesh, taut_output out);

/**
 * Copies the numbers of the ignored triangles out, ascending.
 *
 * - `mesh`: not NULL.
 * - `out`: rows of one index, at least `taut_mesh_ignored_count` of them.
 *
 * Errors: as for `taut_mesh_triangles`. Cost: linear in their number. Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_ignored_triangles(const taut_mesh *mesh, taut_output out);

/** Frees a mesh; NULL is fine. What was made from it stays valid. */
void taut_mesh_free(taut_mesh *mesh);

/* --------------------------------------------- Places on the surface ---------------------------------------------- */

/**
 * Where distances are measured from: vertices, points of the surface and curves on it, each at its own start distance.
 *
 * Sources are numbered from 0, the vertices first, then the points, then the curves: offsets are given, errors named, and
 * nearest sources told by this number.
 */
typedef struct {
    /** `sizeof(taut_sources)`. */
    size_t struct_size;
    /** Rows of one vertex index. */
    taut_input vertices;
    /**
     * Rows of one real number, the start distance of each source in mesh units: finite, of any sign. As many as there
     * are sources of all kinds together, or none, which means 0 for all.
     */
    taut_input offsets;
    /** Rows of one index, the points: the triangle in which each lies. */
    taut_input faces;
    /**
     * Rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, not negative,
     * their sum 1 up to 1e-6.
     */
    taut_input barycentrics;
    /**
     * Rows of one index, where the points of each curve begin and, at last, where they end, as from
     * `taut_curves_offsets`: curve i has the points from curve_offsets[i] up to, not including, curve_offsets[i + 1], one
     * at least. The first is 0, the last the number of `curve_faces`. No rows mean no curves.
     */
    taut_input curve_offsets;
    /**
     * Rows of one index, the points of all curves: the triangle in which each lies, and the segment to the next one with
     * it. A point on an edge or at a vertex may name any triangle there.
     */
    taut_input curve_faces;
    /** Rows of three real numbers, as many as there are `curve_faces`: the weights of the triangle's corners, as above. */
    taut_input curve_barycentrics;
    /**
     * Rows of one index for each curve, 1 if its last point is joined to its first, else 0; or none, which means 0 for
     * all.
     */
    taut_input curve_closed;
} taut_sources;

/**
 * Places that are asked about: vertices, points of the surface, or both.
 *
 * Targets are numbered from 0, the vertices first and the points after them: answers are given and errors named by this
 * number. A NULL pointer to targets means every vertex of the mesh.
 */
typedef struct {
    /** `sizeof(taut_targets)`. */
    size_t struct_size;
    /** Rows of one vertex index. */
    taut_input vertices;
    /** Rows of one index, the points: the triangle in which each lies. */
    taut_input faces;
    /**
     * Rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, not negative,
     * their sum 1 up to 1e-6.
     */
    taut_input barycentrics;
} taut_targets;

/**
 * Tells where points of the surface lie in space.
 *
 * - `mesh`: not NULL.
 * - `faces`: rows of one index, the triangle of each point.
 * - `barycentrics`: rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, as in
 *   `taut_sources`.
 * - `out`: rows of three real numbers, at least as many as there are points; mesh units.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT names the point that is no place, or the face that the mesh does not have;
 * TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the points. Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_point_positions(const taut_mesh *mesh,
                                      taut_input faces,
                                      taut_input barycentrics,
                                      taut_output out);

/**
 * Prepares a mesh for questions of what is nearest to a point in space, such as a click or a cursor.
 *
 * - `mesh`: not NULL; it may be freed afterwards.
 * - `out`: receives the prepared mesh, to be freed with `taut_closest_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the mesh has no triangles, or only ignored ones. Cost: O(F log F) time, 0.1 kB
 * for each triangle. Threads: any. Cannot be cancelled.
 */
taut_status taut_closest_new(const taut_mesh *mesh, taut_closest **out);

/**
 * Finds the place on the surface that is nearest to each of some points in space.
 *
 * Of places that are equally near, one inside a triangle goes before one on an edge, that before a vertex; then the least
 * triangle counts. So a point nearest to an edge or a vertex gets the least of its triangles.
 *
 * - `closest`: not NULL.
 * - `points`: rows of three real numbers, in mesh units, finite.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `faces`: rows of one index, at least as many as there are points: the triangle in which the place lies.
 * - `barycentrics`: rows of three real numbers, at least as many: the weights of the triangle's corners, not negative,
 *   their sum 1; 0 at the corner opposite the edge on which the place lies, and at both others if it is a vertex.
 * - `distances`: rows of one real number, at least as many: the straight distance in mesh units, INFINITY where it
 *   exceeds the largest `double`.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT naming the point that is not finite, or where a face exceeds the type;
 * TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: about
 * O(log F) for a point, O(F log F) for one with all triangles equally near. Threads: any. The control is consulted every
 * 64 points.
 */
taut_status taut_closest_points(const taut_closest *closest,
                                taut_input points,
                                const taut_control *control,
                                taut_output faces,
                                taut_output barycentrics,
                                taut_output distances);

/** Frees a prepared mesh; NULL is fine. */
void taut_closest_free(taut_closest *closest);

/* ------------------------------------------------ Exact distances ------------------------------------------------- */

/** Options of `taut_exact_field_new`. All zero but the size is the default. */
typedef struct {
    /** `sizeof(taut_exact_options)`. */
    size_t struct_size;
    /**
     * The places whose distances are wanted; the work stops when all of these are final. NULL, or no place, means every
     * vertex.
     */
    const taut_targets *targets;
    /**
     * The largest distance wanted, start distances included, in mesh units, not negative; vertices that are farther get
     * +INFINITY, and the work stops when all others are final. 0 means no limit, as does +INFINITY.
     */
    double radius;
    /**
     * 1: work that is cancelled or reaches a limit of its control succeeds with the distances that are final by then,
     * up to `taut_exact_field_final_radius`. 0: it fails.
     */
    uint32_t allow_partial;
    /**
     * 1: the field keeps what it needs to answer for points that are no vertices: distances, nearest sources and paths
     * of these; 1 to 2 kB for a triangle of a scan, and twice that while the field is made. 0: it answers for vertices
     * only.
     */
    uint32_t keep_windows;
} taut_exact_options;

/**
 * Prepares a mesh for exact distances.
 *
 * - `mesh`: not NULL; it may be freed afterwards.
 * - `out`: receives the prepared mesh, to be freed with `taut_exact_free`; NULL on failure.
 *
 * Errors: none in particular. Cost: O(V + F) time, 0.1 kB for each triangle. Threads: any. Cannot be cancelled.
 */
taut_status taut_exact_new(const taut_mesh *mesh, taut_exact **out);

/** Frees a prepared mesh; NULL is fine. Fields made from it stay valid. */
void taut_exact_free(taut_exact *exact);

/**
 * Computes the exact distances from a set of sources.
 *
 * - `exact`: not NULL.
 * - `sources`: where to measure from; not NULL, at least one.
 * - `options`: NULL means the default.
 * - `control`: progress, cancellation and limits, or NULL.
 * - `out`: receives the field, to be freed with `taut_exact_field_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_NO_SOURCE; TAUT_REASON_VERTEX_OUT_OF_RANGE names the source or target; TAUT_REASON_BAD_ARGUMENT
 * names the source that is no place on the mesh, or the option; and, unless `allow_partial` is set,
 * TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT, TAUT_REASON_MEMORY_LIMIT. Cost: about 20 windows per triangle on
 * scanned surfaces, O(V^2) at worst, and with targets or a radius in proportion to the area within; memory for the
 * moving front, 48 bytes a vertex and 12 a triangle, and with `keep_windows` about 50 bytes a window. Threads: any, also
 * on one `exact` at once. The control is consulted every few thousand windows, about a millisecond apart, in which the
 * memory grows by a few hundred kB at most.
 */
taut_status taut_exact_field_new(const taut_exact *exact,
                                 const taut_sources *sources,
                                 const taut_exact_options *options,
                                 const taut_control *control,
                                 taut_exact_field **out);

/**
 * Tells the distance of each of some places, or of every vertex.
 *
 * - `field`: not NULL; made with `keep_windows`, unless all targets are vertices.
 * - `targets`: NULL means every vertex.
 * - `out`: rows of one real number, at least one for each target; mesh units. +INFINITY where no source reaches, and
 *   beyond `taut_exact_field_final_radius`.
 *
 * Errors: TAUT_REASON_VERTEX_OUT_OF_RANGE names the target; TAUT_REASON_BAD_ARGUMENT names the one that is no place on the
 * mesh, or no vertex where the field keeps no windows; TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the targets, and a
 * look at each window of the triangle of a point. Threads: any. Cannot be cancelled.
 */
taut_status taut_exact_field_distances(const taut_exact_field *field, const taut_targets *targets, taut_output out);

/**
 * Tells the nearest source of each of some places, by its number among the sources.
 *
 * - `field`, `targets`: as for `taut_exact_field_distances`.
 * - `out`: rows of one index, at least one for each target; no index where no source reaches, and beyond
 *   `taut_exact_field_final_radius`.
 *
 * Errors: as for `taut_exact_field_distances`; TAUT_REASON_BAD_ARGUMENT where a number exceeds the type. Cost: as for
 * `taut_exact_field_distances`. Threads: any. Cannot be cancelled.
 */
taut_status taut_exact_field_nearest_sources(const taut_exact_field *field,
                                             const taut_targets *targets,
                                             taut_output out);

/**
 * Draws the shortest path from each of some places back to its nearest source.
 *
 * A path is as long as the distance less the start distance of the source. It begins at the target and ends at the
 * source; a target that is a source has one point. No two points that follow each other are at one position.
 *
 * - `field`, `targets`: as for `taut_exact_field_distances`.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: receives one curve for each target, in their order, to be freed with `taut_curves_free`; NULL on failure. A
 *   curve has no points where no source reaches, beyond `taut_exact_field_final_radius`, and for a vertex that no
 *   triangle uses.
 *
 * Errors: as for `taut_exact_field_distances`; TAUT_REASON_PATH_LOST names the target; TAUT_REASON_TOO_MANY_ELEMENTS where
 * the points exceed 32-bit indices; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: linear in the triangles that the
 * paths cross, and a look at each window of the triangle of a point. Threads: any. The control is consulted before each
 * path.
 */
taut_status taut_exact_field_paths(const taut_exact_field *field,
                                   const taut_targets *targets,
                                   const taut_control *control,
                                   taut_curves **out);

/**
 * Tells up to which distance the field is complete: distances up to this one are there and final, beyond it all are
 * +INFINITY.
 *
 * It is +INFINITY unless the work stopped at its targets or its radius, or was interrupted. Work that was interrupted early
 * may know no distance for certain; then it is below the least start distance.
 *
 * - `field`: not NULL.
 *
 * Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
 */
double taut_exact_field_final_radius(const taut_exact_field *field);

/**
 * Tells what interrupted the work before it had all that was asked for, where `allow_partial` let it succeed all the same.
 *
 * - `field`: not NULL.
 * - `detail`: NULL, or receives the failure that its call would have been; set `struct_size` before the call. All zero but
 *   the size if nothing interrupted it.
 *
 * Returns TAUT_STATUS_OK if nothing did, TAUT_STATUS_CANCELLED or TAUT_STATUS_LIMIT_REACHED;
 * TAUT_STATUS_INVALID_ARGUMENT if `field` is NULL or `detail` without its size. Cost: O(1). Threads: any.
 */
taut_status taut_exact_field_interruption(const taut_exact_field *field, taut_error *detail);

/**
 * Tells how many windows crossed a triangle: a measure of the work that does not depend on the machine.
 *
 * - `field`: not NULL.
 *
 * Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
 */
uint64_t taut_exact_field_windows(const taut_exact_field *field);

/** Frees a field; NULL is fine. */
void taut_exact_field_free(taut_exact_field *field);

/**
 * Draws the open curve that goes through points in their order: straight from one to the next where a triangle holds both,
 * else along a shortest path. What the `taut_curves_` functions copy out of it is a curve among `taut_sources`.
 *
 * - `exact`: not NULL.
 * - `faces`: rows of one index, the points: the triangle in which each lies.
 * - `barycentrics`: rows of three real numbers, as many as there are `faces`: the weights of the triangle's corners, as in
 *   `taut_sources`.
 * - `control`: progress, cancellation and limits, or NULL.
 * - `out`: receives one curve, to be freed with `taut_curves_free`; NULL on failure. Of points that follow each other at
 *   one place it has one; without points it has none.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT names the point that is no place on the mesh, or to which no way leads from the one
 * before it; TAUT_REASON_PATH_LOST; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT, TAUT_REASON_MEMORY_LIMIT. Cost: a
 * straight piece nothing, a shortest path that of a field as far as the next point, with `keep_windows`. Threads: any,
 * also on one `exact` at once. The control is consulted at each point, and as by `taut_exact_field_new`.
 */
taut_status taut_exact_curve_through(const taut_exact *exact,
                                     taut_input faces,
                                     taut_input barycentrics,
                                     const taut_control *control,
                                     taut_curves **out);

/* ----------------------------------- Exact distances from many sources at once ------------------------------------ */

/**
 * Computes the exact distances of every vertex from each of several sources, or sets of sources: one field for each.
 *
 * - `exact`: not NULL.
 * - `sources`: where to measure from; not NULL.
 * - `set_offsets`: rows of one index, where each set begins among the sources and, at last, where they end: row i is about
 *   the sources from set_offsets[i] up to, not including, set_offsets[i + 1], one at least. The first is 0, the last the
 *   number of sources. No rows, as of `(taut_input){0}`, mean that each source is a set.
 * - `threads`: how many threads compute rows: 1 for the calling one only, 0 for as many as the machine has, 1024 at most.
 *   The distances are the same, to the bit, for any number.
 * - `control`: progress, cancellation and limits, or NULL.
 * - `out`: rows of as many real numbers as there are vertices, at least one row for each set, in their order; mesh units.
 *   +INFINITY where the set does not reach.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the offsets are no such numbers; TAUT_REASON_NO_SOURCE where a set has none;
 * TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; else as for `taut_exact_field_new`. Cost: that of
 * `taut_exact_field_new` for each set, shared by the threads, each with the memory of one field; and 8 bytes for each
 * number until all are there. Threads: any, also on one `exact` at once. The control is consulted as by
 * `taut_exact_field_new`, on every thread, but tells its progress on the calling one only, which may wait at the end for
 * the last row of another; a memory limit holds for each thread, without the rows.
 */
taut_status taut_exact_distance_rows(const taut_exact *exact,
                                     const taut_sources *sources,
                                     taut_input set_offsets,
                                     size_t threads,
                                     const taut_control *control,
                                     taut_output out);

/**
 * Computes the exact distances up to a radius from each of several sources.
 *
 * - `exact`: not NULL.
 * - `sources`: where to measure from; not NULL. No source means no rows.
 * - `radius`: the largest distance wanted, start distances included, in mesh units, not negative. It counts as it is: 0
 *   leaves what is no farther than 0, +INFINITY everything that a source reaches.
 * - `threads`: as for `taut_exact_distance_rows`.
 * - `control`: progress, cancellation and limits, or NULL.
 * - `out`: receives the distances, to be freed with `taut_sparse_distances_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the radius is negative or NaN; else as for `taut_exact_field_new`. Cost: time
 * and memory in proportion to what is reached, and for each thread 50 bytes a vertex and 12 a triangle. Threads: any, also
 * on one `exact` at once. The control is consulted as by `taut_exact_distance_rows`.
 */
taut_status taut_exact_distances_within(const taut_exact *exact,
                                        const taut_sources *sources,
                                        double radius,
                                        size_t threads,
                                        const taut_control *control,
                                        taut_sparse_distances **out);

/**
 * Tells how many rows there are: one for each source.
 *
 * - `distances`: not NULL.
 *
 * Returns 0 if `distances` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_sparse_distances_row_count(const taut_sparse_distances *distances);

/**
 * Tells how many entries all rows have together.
 *
 * - `distances`: not NULL.
 *
 * Returns 0 if `distances` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_sparse_distances_count(const taut_sparse_distances *distances);

/**
 * Copies out where the entries of each row begin: row i has the entries from offsets[i] up to, not including,
 * offsets[i + 1].
 *
 * - `distances`: not NULL.
 * - `out`: rows of one index, at least `taut_sparse_distances_row_count` + 1; the first is 0, the last the number of
 *   entries.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an offset exceeds the type. Cost: linear in the
 * rows. Threads: any. Cannot be cancelled.
 */
taut_status taut_sparse_distances_offsets(const taut_sparse_distances *distances, taut_output out);

/**
 * Copies out which vertex each entry is about, in ascending order in each row.
 *
 * - `distances`: not NULL.
 * - `out`: rows of one index, at least `taut_sparse_distances_count` of them.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an index exceeds the type. Cost: linear in the
 * entries. Threads: any. Cannot be cancelled.
 */
taut_status taut_sparse_distances_vertices(const taut_sparse_distances *distances, taut_output out);

/**
 * Copies out the distance of each entry, as `taut_exact_distance_rows` has it, to the bit.
 *
 * - `distances`: not NULL.
 * - `out`: rows of one real number, at least `taut_sparse_distances_count` of them; mesh units.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the entries. Threads: any. Cannot be cancelled.
 */
taut_status taut_sparse_distances_values(const taut_sparse_distances *distances, taut_output out);

/** Frees sparse distances; NULL is fine. */
void taut_sparse_distances_free(taut_sparse_distances *distances);

/**
 * Spreads vertices evenly over the surface, by farthest point sampling: each is the vertex that is farthest from the
 * sources and from all before it; of equally far ones the first.
 *
 * - `exact`: not NULL.
 * - `sources`: what to begin with; not NULL, at least one.
 * - `count`: how many vertices are wanted.
 * - `control`: progress, cancellation and limits, or NULL.
 * - `vertices`: rows of one index, at least `count` of them; no index once no vertex of a triangle is farther than 0, as
 *   when all are taken.
 * - `distances`: rows of one real number, at least `count` of them: how far each vertex was when it was taken, in mesh
 *   units; +INFINITY for the first one in a component without any, 0 where there is no vertex.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; TAUT_REASON_BAD_ARGUMENT where a vertex exceeds the
 * type; else as for `taut_exact_field_new`. Cost: the first vertex as much as a field, each
 * further one about as much as the area that it takes, and O(V). Threads: any, also on one `exact` at once. The control is
 * consulted as by `taut_exact_field_new`.
 */
taut_status taut_exact_farthest_points(const taut_exact *exact,
                                       const taut_sources *sources,
                                       size_t count,
                                       const taut_control *control,
                                       taut_output vertices,
                                       taut_output distances);

/* ------------------------------------------------ The heat method ------------------------------------------------- */

/**
 * A formula for the time step t, from the edge lengths: their mean e and standard deviation s. 0 means
 * `TAUT_TIME_FORMULA_MEAN_EDGE`. Eq. 1 is Crane, Weischedel and Wardetzky's (Geodesics in Heat, 2013), the others are
 * from "Wave propagation time optimization for geodesic distances calculation using the Heat Method" (2019).
 */
typedef uint32_t taut_time_formula;
/** t = e^2 (Eq. 1). */
#define TAUT_TIME_FORMULA_MEAN_EDGE 1
/** t = s (Eq. 2). */
#define TAUT_TIME_FORMULA_SIGMA 2
/** t = (e^2 + s) / 2 (Eq. 3). */
#define TAUT_TIME_FORMULA_MEAN_SIGMA 3
/** t = 1.01204 s - 0.0001 (Eq. 4). */
#define TAUT_TIME_FORMULA_MEDIAN_FIT 4
/** t = (e^2 + 1.01204 s - 0.0001) / 2 (Eq. 5). */
#define TAUT_TIME_FORMULA_MEDIAN_MEAN 5

/**
 * The size that a formula is evaluated at, which matters because Eq. 2 to 5 set an area to lengths. t itself is always
 * in mesh units squared. 0 means `TAUT_TIME_SCALE_PAPER`.
 */
typedef uint32_t taut_time_scale;
/** A bounding box with the diagonal 24.976, for which Eq. 2 to 5 were found. */
#define TAUT_TIME_SCALE_PAPER 1
/** The mesh's own units. */
#define TAUT_TIME_SCALE_RAW 2

/** The time step t of the heat flow: a formula times a factor, or a value. All zero is the default. */
typedef struct {
    /** The formula; must be 0 if `value` is set. */
    taut_time_formula formula;
    /** Its scale; must be 0 if `value` is set. */
    taut_time_scale scale;
    /** Multiplies what the formula gives, positive; 0 means 1. Must be 0 if `value` is set. */
    double factor;
    /** t itself in mesh units squared, positive; 0 means to use the formula. */
    double value;
} taut_time_step;

/** Which Laplacian diffuses the heat. 0 means `TAUT_LAPLACIAN_INTRINSIC`. */
typedef uint32_t taut_laplacian;
/** Cotangents of the intrinsic Delaunay triangulation: the same surface with better triangles. */
#define TAUT_LAPLACIAN_INTRINSIC 1
/** Cotangents of the mesh's own triangles. */
#define TAUT_LAPLACIAN_PLAIN 2

/** How the distances get their zero. 0 means `TAUT_SHIFT_PINNED`. */
typedef uint32_t taut_shift;
/**
 * Each source has its start distance, unless another one reaches it sooner along edges; at the corners around a point or
 * a curve the distance is the straight way.
 */
#define TAUT_SHIFT_PINNED 1
/** The least distance of each component is moved to the least start distance. */
#define TAUT_SHIFT_MIN 2

/** Which code factors the sparse matrices. 0 means `TAUT_SOLVER_SUPERNODAL`. */
typedef uint32_t taut_solver;
/** Supernodal Cholesky, A = L Lᵀ. */
#define TAUT_SOLVER_SUPERNODAL 1
/** sprs-ldl; only where the library was built with it, else TAUT_REASON_MISSING_FEATURE. */
#define TAUT_SOLVER_LDL 2

/** Options of `taut_heat_new`. All zero but the size is the default. */
typedef struct {
    /** `sizeof(taut_heat_options)`. */
    size_t struct_size;
    /** The time step. */
    taut_time_step time_step;
    /** Heat at the mesh's boundary: from 0, no flow across (Neumann), to 1, kept at zero (Dirichlet). */
    double boundary;
    /** The Laplacian. */
    taut_laplacian laplacian;
    /** The zero of the distances. */
    taut_shift shift;
    /** The solver. */
    taut_solver solver;
    /** 0. */
    uint32_t reserved;
} taut_heat_options;

/**
 * What preparing the heat method did to the triangulation, and how long its stages took, by the clock; 0 seconds for those
 * that another `taut_heat` had done.
 */
typedef struct {
    /** `sizeof(taut_heat_report)`, set by the caller. */
    size_t struct_size;
    /** How many edges were flipped; 0 with `TAUT_LAPLACIAN_PLAIN`. */
    uint64_t flips;
    /**
     * How many triangles are there twice, once for each side of the surface, because an edge had to flip near a boundary,
     * near more than two triangles on an edge, or near the seam of a one-sided surface; 0 with `TAUT_LAPLACIAN_PLAIN`.
     */
    uint64_t doubled_triangles;
    /**
     * How many edges are not Delaunay in the end, because rounding on needles does not let them flip, or because flips
     * ended; 0 with `TAUT_LAPLACIAN_PLAIN`.
     */
    uint64_t stuck_edges;
    /** 1 if flips were ended by their bound, 50 per edge, before nothing was left to flip; else 0. */
    uint32_t flip_bound_reached;
    /** 1 if all edges were lengthened a little, because some triangle had (almost) no area; else 0. */
    uint32_t mollified;
    /** Edge lengths, mollification and edge flips. */
    double delaunay_seconds;
    /** The matrices. */
    double assembly_seconds;
    /** Their fill-reducing ordering. */
    double order_seconds;
    /** Where their factors have entries. */
    double symbolic_seconds;
    /** The factor for the distances. */
    double poisson_seconds;
    /** The factor for the heat; two with a boundary blend. */
    double heat_seconds;
} taut_heat_report;

/**
 * How well the two systems of a field are solved: the largest entry of b - A x, as a share of the largest entry of b.
 * Rounding leaves about 1e-15 times the number of edges at a vertex; much more means that the matrix is close to singular.
 */
typedef struct {
    /** `sizeof(taut_heat_residuals)`, set by the caller. */
    size_t struct_size;
    /** Of the heat: (M + t L) u = δ. */
    double heat;
    /** Of the distances: L φ = -∇·X, where they are not known beforehand. */
    double poisson;
} taut_heat_residuals;

/**
 * Tells the time step t that a mesh gets, without preparing anything.
 *
 * - `mesh`: not NULL.
 * - `time_step`: all zero means the default.
 * - `out`: not NULL; receives t in mesh units squared.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the fields of the time step exclude each other; TAUT_REASON_BAD_TIME_STEP where t
 * is not positive and finite, or a formula says nothing about this mesh. Cost: O(F). Threads:
 * any. Cannot be cancelled.
 */
taut_status taut_time_step_value(const taut_mesh *mesh, taut_time_step time_step, double *out);

/**
 * Prepares the heat method for a mesh.
 *
 * - `mesh`: not NULL; it may be freed afterwards.
 * - `options`: NULL means the default.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: receives the prepared method, to be freed with `taut_heat_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT names the option; TAUT_REASON_BAD_TIME_STEP; TAUT_REASON_MISSING_FEATURE where the
 * library was built without the solver; TAUT_REASON_NOT_POSITIVE_DEFINITE where a factorisation breaks down;
 * TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: two sparse Cholesky
 * factorisations, about O(V^1.5) time and O(V log V) memory. Threads: any. The control is consulted between the steps
 * and, some milliseconds apart, inside the factorisations (`TAUT_SOLVER_LDL`: not inside).
 */
taut_status taut_heat_new(const taut_mesh *mesh,
                          const taut_heat_options *options,
                          const taut_control *control,
                          taut_heat **out);

/**
 * Prepares the heat method for another time step, sharing everything that does not depend on it.
 *
 * - `heat`: not NULL; it stays as it is and may be freed before the new one.
 * - `time_step`: all zero means the default, not that of `heat`.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: receives the prepared method, to be freed with `taut_heat_free`; NULL on failure.
 *
 * Errors: as for `taut_time_step_value`; TAUT_REASON_NOT_POSITIVE_DEFINITE where the factorisation breaks down;
 * TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: one numeric factorisation, a fraction of `taut_heat_new`.
 * Threads: any. The control is consulted as by `taut_heat_new`.
 */
taut_status taut_heat_with_time_step(const taut_heat *heat,
                                     taut_time_step time_step,
                                     const taut_control *control,
                                     taut_heat **out);

/**
 * Prepares the heat method for the same triangles in another place, with the options of `taut_heat_new`: its time step as
 * well, not one of `taut_heat_with_time_step`.
 *
 * - `heat`: not NULL; it stays as it is and may be freed before the new one.
 * - `mesh`: not NULL; as `taut_mesh_with_positions` makes it. It may be freed afterwards.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: receives the prepared method, to be freed with `taut_heat_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the mesh has other triangles; else as for `taut_heat_new`. Cost: that of
 * `taut_heat_new` less the ordering of the matrices and, where no other edges are flipped than before, less their
 * analysis. Threads: any. The control is consulted as by `taut_heat_new`.
 */
taut_status taut_heat_with_mesh(const taut_heat *heat,
                                const taut_mesh *mesh,
                                const taut_control *control,
                                taut_heat **out);

/**
 * Tells the time step t that a method was prepared for, in mesh units squared.
 *
 * - `heat`: not NULL.
 *
 * Returns 0 if `heat` is NULL. Cost: O(1). Threads: any.
 */
double taut_heat_time_step(const taut_heat *heat);

/**
 * Tells what the preparation did to the triangulation, and how long its stages took.
 *
 * - `heat`: not NULL.
 * - `out`: not NULL; receives it; set `struct_size` before the call.
 *
 * Errors: none in particular. Cost: O(1). Threads: any. Cannot be cancelled.
 */
taut_status taut_heat_report_of(const taut_heat *heat, taut_heat_report *out);

/** Frees a prepared heat method; NULL is fine. */
void taut_heat_free(taut_heat *heat);

/**
 * Computes the distances from a set of sources by the heat method: approximate, smooth, fast for many calls.
 *
 * - `heat`: not NULL.
 * - `sources`: where to measure from; not NULL, at least one.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: receives the field, to be freed with `taut_heat_field_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_NO_SOURCE; TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_REASON_BAD_ARGUMENT and, with `boundary` 1,
 * TAUT_REASON_SOURCE_ON_BOUNDARY name the source; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: a few sparse
 * triangular solves, about O(V log V); with `TAUT_SHIFT_PINNED` also a short one for each vertex of a source or, for more
 * than 256 in one component, a factorisation. Threads: any, also on one `heat` at once. The control is consulted between
 * the steps, not inside a solve.
 */
taut_status taut_heat_field_new(const taut_heat *heat,
                                const taut_sources *sources,
                                const taut_control *control,
                                taut_heat_field **out);

/**
 * Tells the distance of every vertex.
 *
 * - `field`: not NULL.
 * - `out`: rows of one real number, at least as many as there are vertices; mesh units. +INFINITY where no source
 *   reaches.
 *
 * `taut_descent_paths_new` follows these distances back to a source.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(V). Threads: any. Cannot be cancelled.
 */
taut_status taut_heat_field_distances(const taut_heat_field *field, taut_output out);

/**
 * Tells the nearest source of every vertex, by its number among the sources: the one to which steepest descent leads.
 *
 * - `field`: not NULL.
 * - `out`: rows of one index, at least as many as there are vertices; no index where no source reaches.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where a number exceeds the type. Cost: O(V log V).
 * Threads: any. Cannot be cancelled.
 */
taut_status taut_heat_field_nearest_sources(const taut_heat_field *field, taut_output out);

/**
 * Tells at how many vertices that a source reaches heat was not positive. There the direction is doubtful: cotangents are
 * negative nearby, by `TAUT_LAPLACIAN_PLAIN` or at edges that could not be flipped.
 *
 * - `field`: not NULL.
 *
 * Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
 */
uint64_t taut_heat_field_nonpositive_heat(const taut_heat_field *field);

/**
 * Tells how often heat had to start anew, because it had faded below the numbers that there are.
 *
 * - `field`: not NULL.
 *
 * Returns 0 if `field` is NULL. Cost: O(1). Threads: any.
 */
uint32_t taut_heat_field_restarts(const taut_heat_field *field);

/** Frees a field; NULL is fine. */
void taut_heat_field_free(taut_heat_field *field);

/**
 * Computes a field once more, and tells how well its systems are solved.
 *
 * - `heat`, `sources`, `control`: as for `taut_heat_field_new`.
 * - `out`: not NULL; receives the residuals; set `struct_size` before the call.
 *
 * Errors: as for `taut_heat_field_new`. Cost: about twice that of `taut_heat_field_new`. Threads: any, also on one `heat`
 * at once. The control is consulted between the steps.
 */
taut_status taut_heat_residuals_of(const taut_heat *heat,
                                   const taut_sources *sources,
                                   const taut_control *control,
                                   taut_heat_residuals *out);

/**
 * Computes the distances of every vertex from each of several sources, or sets of sources, by the heat method: one field
 * for each.
 *
 * - `heat`: not NULL.
 * - `sources`, `set_offsets`, `threads`: as for `taut_exact_distance_rows`. The distances are the same, to the bit, as
 *   those of `taut_heat_field_new`.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: rows of as many real numbers as there are vertices, at least one row for each set, in their order; mesh units.
 *   +INFINITY where the set does not reach.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the offsets are no such numbers; TAUT_REASON_NO_SOURCE where a set has none;
 * TAUT_REASON_BUFFER_TOO_SMALL, before anything is computed; else as for `taut_heat_field_new`. Cost: half of that of
 * `taut_heat_field_new` for each set, as eight are solved for at once; and 8 bytes for each number until all are there.
 * Threads: any, also on one `heat` at once. The control is consulted between the steps.
 */
taut_status taut_heat_distance_rows(const taut_heat *heat,
                                    const taut_sources *sources,
                                    taut_input set_offsets,
                                    size_t threads,
                                    const taut_control *control,
                                    taut_output out);

/* ----------------------------------------------------- Curves ----------------------------------------------------- */

/** The most levels that `taut_even_levels` and `taut_spaced_levels` give. */
#define TAUT_MAX_LEVELS 10000

/**
 * Spreads levels evenly between the least and the greatest value of a field, for `taut_isolines_new`.
 *
 * Only the values at triangles that can have lines count: those whose corners are all finite.
 *
 * - `mesh`: not NULL.
 * - `values`: as for `taut_isolines_new`.
 * - `count`: how many levels are wanted, `TAUT_MAX_LEVELS` at most.
 * - `levels`: rows of one real number, at least as many as there are levels: never more than `count`. They ascend, and lie
 *   strictly between the least and the greatest value.
 * - `written`: not NULL; receives how many levels there are: fewer than `count` where so many numbers do not fit in
 *   between, and none where the field is constant.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where `count` is too large, or there are more or fewer values than vertices;
 * TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(F). Threads: any. Cannot be cancelled.
 */
taut_status taut_even_levels(const taut_mesh *mesh,
                             taut_input values,
                             size_t count,
                             taut_output levels,
                             size_t *written);

/**
 * Finds the multiples of a number that lie between the least and the greatest value of a field, for `taut_isolines_new`.
 *
 * Only the values at triangles that can have lines count: those whose corners are all finite.
 *
 * - `mesh`: not NULL.
 * - `values`: as for `taut_isolines_new`.
 * - `spacing`: positive and finite, in the unit of the values.
 * - `levels`: rows of one real number, at least as many as there are levels: never more than `TAUT_MAX_LEVELS`. They
 *   ascend, and lie strictly between the least and the greatest value.
 * - `written`: not NULL; receives how many levels there are.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where `spacing` is not positive and finite, or so small that there would be more than
 * `TAUT_MAX_LEVELS`, or where there are more or fewer values than vertices; TAUT_REASON_BUFFER_TOO_SMALL. Cost: O(F).
 * Threads: any. Cannot be cancelled.
 */
taut_status taut_spaced_levels(const taut_mesh *mesh,
                               taut_input values,
                               double spacing,
                               taut_output levels,
                               size_t *written);

/**
 * Draws the lines along which a field takes given values: points on edges of the mesh, joined through triangles.
 *
 * A vertex counts as above a level that it has itself, so the lines are the border of all that is at the level or above:
 * a plateau has a line where it meets lower ground. Lines end at the boundary, beside triangles with a corner that is not
 * finite, which have no lines, and on edges of three or more triangles, from where each triangle's line goes by itself.
 * Higher ground is on a line's left in the first triangle that it crosses, seen from where the triangle's corners go
 * round counter-clockwise.
 *
 * - `mesh`: not NULL; it may be freed afterwards.
 * - `values`: rows of one real number, as many as there are vertices, in any unit; not finite where there is no value.
 * - `levels`: rows of one real number, finite; in any order, and each has the same lines as if it were alone.
 * - `out`: receives the curves, those of the first level first, to be freed with `taut_curves_free`; NULL on failure.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer values than vertices, or naming the level that is not
 * finite; TAUT_REASON_TOO_MANY_ELEMENTS where the points exceed 32-bit indices. Cost: O(F log n + output) time for n
 * levels together, O(F + output) memory. Threads: any. Cannot be cancelled.
 */
taut_status taut_isolines_new(const taut_mesh *mesh, taut_input values, taut_input levels, taut_curves **out);

/**
 * Draws the paths along which a field falls steepest, one from each of some places.
 *
 * Down distances, of whatever origin, they lead back to the sources, and come near to the shortest paths. The field is
 * linear in each triangle, and never rises along a path. Without sources a path ends at a vertex that has no lower
 * neighbour, which may be the target itself. With sources it ends at one of them, also inside a triangle or on a curve;
 * where distances have a minimum that is no source, as where triangles are obtuse, it goes on over the lowest pass. No two
 * points that follow each other are at one position.
 *
 * - `mesh`: not NULL; it may be freed afterwards.
 * - `values`: rows of one real number, as many as there are vertices, in any unit; not finite where there is no value.
 * - `sources`: what the values are the distances from; NULL, or none, for a field that is no distance.
 * - `targets`: where the paths begin; NULL means every vertex.
 * - `control`: progress, cancellation and a time limit, or NULL.
 * - `out`: receives one curve for each target, in their order, to be freed with `taut_curves_free`; NULL on failure. A
 *   curve has no points where the field is not finite, and for a vertex that no triangle uses.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where there are more or fewer values than vertices; it and
 * TAUT_REASON_VERTEX_OUT_OF_RANGE name the source or target that the mesh does not have; TAUT_REASON_TOO_MANY_ELEMENTS
 * where the points exceed 32-bit indices; TAUT_REASON_CANCELLED, TAUT_REASON_TIME_LIMIT. Cost: O(V log V) for all paths
 * together, and linear in the triangles that they cross. Threads: any. The control is consulted before each path.
 */
taut_status taut_descent_paths_new(const taut_mesh *mesh,
                                   taut_input values,
                                   const taut_sources *sources,
                                   const taut_targets *targets,
                                   const taut_control *control,
                                   taut_curves **out);

/**
 * Tells how many curves there are.
 *
 * - `curves`: not NULL.
 *
 * Returns 0 if `curves` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_curves_count(const taut_curves *curves);

/**
 * Tells how many points all curves have together.
 *
 * - `curves`: not NULL.
 *
 * Returns 0 if `curves` is NULL. Cost: O(1). Threads: any.
 */
size_t taut_curves_point_count(const taut_curves *curves);

/**
 * Copies out where the points of each curve begin: curve i has the points from offsets[i] up to, not including,
 * offsets[i + 1]: at least two, but for a path of length 0, which has one, and where there is no path, none.
 *
 * - `curves`: not NULL.
 * - `out`: rows of one index, at least `taut_curves_count` + 1; the first is 0, the last the number of points.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where an index exceeds the type. Cost: linear in the
 * curves. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_offsets(const taut_curves *curves, taut_output out);

/**
 * Copies the positions of the points out.
 *
 * - `curves`: not NULL.
 * - `out`: rows of three real numbers, at least `taut_curves_point_count` of them; mesh units.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the points. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_positions(const taut_curves *curves, taut_output out);

/**
 * Copies the triangles of the points out.
 *
 * - `curves`: not NULL.
 * - `out`: rows of one index, at least `taut_curves_point_count` of them.
 *
 * Errors: as for `taut_curves_offsets`. Cost: linear in the points. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_faces(const taut_curves *curves, taut_output out);

/**
 * Copies out where in its triangle each point lies: the weights of the corners.
 *
 * - `curves`: not NULL.
 * - `out`: rows of three real numbers, at least `taut_curves_point_count` of them: not negative, their sum 1, and 0 at
 *   the corner opposite the edge on which the point lies.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the points. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_barycentrics(const taut_curves *curves, taut_output out);

/**
 * Copies out which curves are closed.
 *
 * - `curves`: not NULL.
 * - `out`: rows of one index, at least `taut_curves_count` of them: 1 for a closed curve, else 0.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL. Cost: linear in the curves. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_closed(const taut_curves *curves, taut_output out);

/**
 * Copies out what each curve answers to: which level an isoline belongs to, which target a path is from.
 *
 * - `curves`: not NULL.
 * - `out`: rows of one index, at least `taut_curves_count` of them: the number of the level, never decreasing; of paths,
 *   which are one for each target, just 0, 1, 2 and so on; of a curve through points 0.
 *
 * Errors: as for `taut_curves_offsets`. Cost: linear in the curves. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_levels(const taut_curves *curves, taut_output out);

/**
 * Copies out at which source each path ends, by its number among the sources.
 *
 * - `curves`: not NULL.
 * - `out`: rows of one index, at least `taut_curves_count` of them: no index where a curve has no points or is no path, and
 *   where a path of steepest descent ends at no source.
 *
 * Errors: as for `taut_curves_offsets`. Cost: linear in the curves. Threads: any. Cannot be cancelled.
 */
taut_status taut_curves_sources(const taut_curves *curves, taut_output out);

/** Frees curves; NULL is fine. */
void taut_curves_free(taut_curves *curves);

/* ------------------------------------------ What is unusual about a mesh ------------------------------------------ */

/** A kind of findings; `taut_report_count` tells how many there are, `taut_report_list` lists them. */
typedef uint32_t taut_finding;
/** Connected parts; a row is the part's smallest vertex. Triangles that share a vertex index belong together. */
#define TAUT_FINDING_COMPONENTS 1
/** Parts whose triangles cannot be turned so that neighbours agree; a row is the part's place among the components. */
#define TAUT_FINDING_NONORIENTABLE_COMPONENTS 2
/**
 * Chains of edges with one triangle; a row is the number of vertices and 1 if the chain is closed, else 0: then it ends
 * at edges of more than two triangles. `taut_report_boundary_vertices` tells the vertices.
 */
#define TAUT_FINDING_BOUNDARY_LOOPS 3
/** Edges of more than two triangles; a row is the two vertices. */
#define TAUT_FINDING_NONMANIFOLD_EDGES 4
/** Vertices whose triangles fall into several fans that touch in the vertex alone. */
#define TAUT_FINDING_NONMANIFOLD_VERTICES 5
/** Edges between two triangles of which one is turned over; a row is the two vertices. */
#define TAUT_FINDING_INCONSISTENT_EDGES 6
/** Triangles without area, up to the rounding of their coordinates. */
#define TAUT_FINDING_ZERO_AREA_FACES 7
/** Triangles that repeat a vertex index, which nothing travels over. */
#define TAUT_FINDING_REPEATED_INDEX_FACES 8
/** Triangles with the three vertices of an earlier one; a row is the triangle and that one. */
#define TAUT_FINDING_DUPLICATE_FACES 9
/** Vertices at the very place of an earlier one, where the surface is cut; a row is the vertex and that one. */
#define TAUT_FINDING_DUPLICATE_VERTICES 10
/** Vertices that no triangle uses. */
#define TAUT_FINDING_UNREFERENCED_VERTICES 11

/** A connected part of a mesh. */
typedef struct {
    /** `sizeof(taut_component)`, set by the caller. */
    size_t struct_size;
    /** V, E and F: its vertices, edges, and triangles that do not repeat an index. V - E + F is its Euler characteristic. */
    uint32_t vertices;
    /** See `vertices`. */
    uint32_t edges;
    /** See `vertices`. */
    uint32_t faces;
    /** Its smallest vertex. */
    uint32_t first_vertex;
    /** How many closed boundary loops it has. */
    uint32_t boundary_loops;
    /** 1 if its edges have two triangles at most and its vertices one fan each, else 0. */
    uint32_t manifold;
    /** 1 if its triangles can be turned so that neighbours agree, else 0. */
    uint32_t orientable;
    /** How many handles it has; 0 as well where it is not manifold or not orientable. */
    uint32_t genus;
} taut_component;

/** An interior angle of a triangle. */
typedef struct {
    /** Its size; NaN where the mesh has no triangle. */
    double radians;
    /** The triangle. */
    uint32_t face;
    /** The vertex it is at. */
    uint32_t vertex;
} taut_angle;

/**
 * Statistics of a mesh's edges and angles, those of the paper "Wave propagation time optimization for geodesic distances
 * calculation using the Heat Method" (2019). Each edge counts once; lengths in mesh units, angles in radians.
 */
typedef struct {
    /** `sizeof(taut_properties)`, set by the caller. */
    size_t struct_size;
    /** Vertices, those that no triangle uses included. */
    uint64_t vertices;
    /** Edges. */
    uint64_t edges;
    /** Triangles, ignored ones included. */
    uint64_t faces;
    /** Mean length of the edges. */
    double mean_edge;
    /** Population variance of the lengths, in squared units. */
    double variance_edge;
    /** Its square root, the standard deviation. */
    double sigma_edge;
    /** Mean distance of a length from the mean. */
    double mean_absolute_deviation;
    /** Median distance of a length from the median. */
    double median_absolute_deviation;
    /** Length of the shortest edge. */
    double min_edge;
    /** Length of the longest edge. */
    double max_edge;
    /** Shortest over longest. */
    double edge_ratio;
    /** Lower quartile of the lengths. */
    double q1;
    /** Their median. */
    double q2;
    /** Their upper quartile. */
    double q3;
    /** (q3 - q1) / 2. */
    double quartile_deviation;
    /** Smallest interior angle. */
    double min_angle;
    /** Largest interior angle. */
    double max_angle;
    /**
     * Mean over the triangles with an area of (half the perimeter * longest edge) / (2 sqrt(3) * area): 1 if all are
     * equilateral. NaN if none has an area.
     */
    double anisotropy;
    /** Factor that brings the mesh to the paper's size, a bounding box of the diagonal 24.976. */
    double paper_scale;
} taut_properties;

/**
 * Looks a mesh over. Nothing that is found is an error: both methods answer on every mesh.
 *
 * - `mesh`: not NULL; it may be freed afterwards.
 * - `out`: receives the report, to be freed with `taut_report_free`; NULL on failure.
 *
 * Errors: none in particular. Cost: O(V log V + F log F). Threads: any. Cannot be cancelled.
 */
taut_status taut_report_new(const taut_mesh *mesh, taut_report **out);

/**
 * Tells how many findings of a kind there are.
 *
 * - `report`: not NULL.
 * - `finding`: the kind.
 *
 * Returns 0 if `report` is NULL or there is no such kind. Cost: linear in their number. Threads: any.
 */
size_t taut_report_count(const taut_report *report, taut_finding finding);

/**
 * Lists the findings of a kind, ascending.
 *
 * - `report`: not NULL.
 * - `finding`: the kind.
 * - `out`: rows of one index, or of two where the kind's description says so, at least `taut_report_count` of them.
 *
 * Errors: TAUT_REASON_BUFFER_TOO_SMALL; TAUT_REASON_BAD_ARGUMENT where there is no such kind or an index exceeds the
 * type. Cost: linear in their number. Threads: any. Cannot be cancelled.
 */
taut_status taut_report_list(const taut_report *report, taut_finding finding, taut_output out);

/**
 * Tells the vertices of all boundary loops, one loop after the other; TAUT_FINDING_BOUNDARY_LOOPS tells how many each
 * has. The first vertex of a closed loop is not repeated.
 *
 * - `report`: not NULL.
 * - `out`: rows of one index, at least as many as all loops have vertices.
 *
 * Errors: as for `taut_report_list`. Cost: linear in their number. Threads: any. Cannot be cancelled.
 */
taut_status taut_report_boundary_vertices(const taut_report *report, taut_output out);

/**
 * Describes one component.
 *
 * - `report`: not NULL.
 * - `component`: its place, less than `taut_report_count` of TAUT_FINDING_COMPONENTS.
 * - `out`: not NULL; receives the description; set `struct_size` before the call.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where there is no such component. Cost: O(1). Threads: any. Cannot be cancelled.
 */
taut_status taut_report_component(const taut_report *report, size_t component, taut_component *out);

/**
 * Tells the component of each vertex.
 *
 * - `report`: not NULL.
 * - `out`: rows of one index, at least as many as there are vertices; no index for a vertex that no triangle uses.
 *
 * Errors: as for `taut_report_list`. Cost: O(V). Threads: any. Cannot be cancelled.
 */
taut_status taut_report_component_of(const taut_report *report, taut_output out);

/**
 * Tells the smallest and the largest interior angle of a triangle that does not repeat an index, and where they are.
 *
 * - `report`: not NULL.
 * - `smallest`, `largest`: receive the angles; not NULL.
 *
 * Errors: none in particular. Cost: O(1). Threads: any. Cannot be cancelled.
 */
taut_status taut_report_angles(const taut_report *report, taut_angle *smallest, taut_angle *largest);

/** Frees a report; NULL is fine. */
void taut_report_free(taut_report *report);

/**
 * Computes statistics of a mesh's edges and angles.
 *
 * - `mesh`: not NULL.
 * - `out`: not NULL; receives them; set `struct_size` before the call.
 *
 * Errors: TAUT_REASON_BAD_ARGUMENT where the mesh has no edge. Cost: O(E log E). Threads: any. Cannot be cancelled.
 */
taut_status taut_mesh_properties(const taut_mesh *mesh, taut_properties *out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* TAUT_H */
