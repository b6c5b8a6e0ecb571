/* What taut.h promises to every caller, checked from C99. */
#include "taut.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define CHECK(condition)                                                                                          \
    do {                                                                                                          \
        if (!(condition)) {                                                                                       \
            fprintf(stderr, "%s:%d: %s [%s]\n", __FILE__, __LINE__, #condition, taut_last_error(NULL));           \
            failures++;                                                                                           \
        }                                                                                                         \
    } while (0)

/* A call that must fail for `why`, about element `kind` number `which`. */
#define CHECK_FAILS(call, why, kind, which) CHECK((call) != TAUT_STATUS_OK && last_is(why, kind, which))

static bool last_is(taut_reason reason, taut_element element, uint64_t index) {
    taut_error error = {.struct_size = sizeof error};
    taut_last_error(&error);
    return error.reason == reason && error.element == element && error.index == index;
}

/* A rectangle of 3 by 4, diagonal 5, and a vertex that no triangle uses. */
static const double xyz[] = {0, 0, 0, 3, 0, 0, 3, 4, 0, 0, 4, 0, 7, 7, 7};
static const uint32_t corners[] = {0, 1, 3, 1, 2, 3};
static const taut_input positions = {.data = xyz, .count = 5};
static const taut_input triangles = {.data = corners, .count = 2};
static const uint32_t zero = 0;
/* Each source makes a set of its own. */
static const taut_input each = {0};
/* Of each vertex, its distance along x; none for the last. */
static const double along_x[] = {0, 3, 3, 0, INFINITY};
static const taut_input values = {.data = along_x, .count = 5};
/* Targets in a call. */
#define VERTICES(v) (&(const taut_targets){.struct_size = sizeof(taut_targets), .vertices = (v)})
#define POINTS(f, b) (&(const taut_targets){.struct_size = sizeof(taut_targets), .faces = (f), .barycentrics = (b)})

static const taut_sources from_zero = {.struct_size = sizeof from_zero, .vertices = {.data = &zero, .count = 1}};

static taut_mesh *rectangle(void) {
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new(positions, triangles, &mesh) == TAUT_STATUS_OK);
    return mesh;
}

static taut_exact *exact_rectangle(void) {
    taut_mesh *mesh = rectangle();
    taut_exact *exact = NULL;
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return exact;
}

static taut_status field_of(const taut_exact *exact, const taut_sources *sources, double *d) {
    taut_exact_field *field = NULL;
    taut_status status = taut_exact_field_new(exact, sources, NULL, NULL, &field);
    if (!status) status = taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5});
    taut_exact_field_free(field);
    return status;
}

static bool is_rectangle_field(const double *d) {
    return d[0] == 0 && d[1] == 3 && d[2] == 5 && d[3] == 4 && d[4] == INFINITY;
}

/* Must run first: nothing has failed yet. */
static void before_any_failure(void) {
    taut_error error;
    memset(&error, 0xff, sizeof error);
    error.struct_size = sizeof error;
    CHECK(strcmp(taut_last_error(&error), "") == 0);
    CHECK(error.status == TAUT_STATUS_OK && error.reason == 0 && error.element == 0 && error.index == 0);
}

static void versions_and_names(void) {
    char version[32];
    sprintf(version, "%d.%d.%d", TAUT_VERSION_MAJOR, TAUT_VERSION_MINOR, TAUT_VERSION_PATCH);
    CHECK(strcmp(taut_version(), version) == 0);
    CHECK(taut_abi() == TAUT_ABI);
    CHECK(strcmp(taut_status_name(TAUT_STATUS_INVALID_MESH), "invalid mesh") == 0);
    for (int32_t status = TAUT_STATUS_OK; status <= TAUT_STATUS_LIMIT_REACHED; status++)
        CHECK(strcmp(taut_status_name(status), "unknown") != 0);
    CHECK(strcmp(taut_status_name(-1), "unknown") == 0);
    CHECK(strcmp(taut_status_name(TAUT_STATUS_LIMIT_REACHED + 1), "unknown") == 0);
}

static void errors_stay_until_the_next(void) {
    taut_mesh *mesh = rectangle();
    CHECK(taut_mesh_new(positions, triangles, NULL) == TAUT_STATUS_INVALID_ARGUMENT);
    CHECK(strstr(taut_last_error(NULL), "`out` is NULL") != NULL);
    CHECK(taut_mesh_vertex_count(mesh) == 5); /* a success */
    CHECK(last_is(TAUT_REASON_NULL_POINTER, TAUT_ELEMENT_NONE, 0));
    taut_mesh_free(mesh);

    /* A caller with an older struct, which ends after `reason`; and one with a newer struct. */
    struct {
        taut_error error;
        uint64_t newer;
    } detail;
    memset(&detail, 0xff, sizeof detail);
    detail.error.struct_size = offsetof(taut_error, element);
    taut_last_error(&detail.error);
    CHECK(detail.error.struct_size == offsetof(taut_error, element));
    CHECK(detail.error.status == TAUT_STATUS_INVALID_ARGUMENT && detail.error.reason == TAUT_REASON_NULL_POINTER);
    CHECK(detail.error.element == -1 && detail.newer == UINT64_MAX);
    detail.error.struct_size = sizeof detail;
    taut_last_error(&detail.error);
    CHECK(detail.error.element == TAUT_ELEMENT_NONE && detail.newer == 0);
}

static void null_is_an_error(void) {
    taut_mesh *mesh = (taut_mesh *)&failures; /* must be overwritten */
    taut_exact *exact = NULL;
    taut_heat *heat = NULL;
    taut_heat_field *heat_field = (taut_heat_field *)&failures;
    taut_heat_report heat_report = {.struct_size = sizeof heat_report};
    taut_exact_field *field = NULL;
    taut_curves *curves = (taut_curves *)&failures;
    taut_closest *closest = (taut_closest *)&failures;
    double d[5], t;
    const taut_output out = {.data = d, .count = 5};
    const taut_time_step step = {.value = 1};

    CHECK_FAILS(taut_mesh_new((taut_input){.count = 1}, triangles, &mesh), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(mesh == NULL);
    CHECK(strstr(taut_last_error(NULL), "positions") != NULL);
    CHECK_FAILS(taut_mesh_read(NULL, &mesh), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_positions(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_triangles(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_ignored_triangles(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_new(NULL, &exact), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_field_new(NULL, &from_zero, NULL, NULL, &field), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_field_distances(NULL, NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_new(NULL, NULL, NULL, &heat), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_with_time_step(NULL, step, NULL, &heat), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_with_mesh(NULL, NULL, NULL, &heat), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_field_new(NULL, &from_zero, NULL, &heat_field), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(heat_field == NULL);
    CHECK_FAILS(taut_heat_field_distances(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_field_nearest_sources(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_distance_rows(NULL, &from_zero, each, 1, NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_report_of(NULL, &heat_report), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_with_positions(NULL, positions, &mesh), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_time_step_value(NULL, step, &t), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_control_new(NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_control_set_time_limit(NULL, 1), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_control_set_memory_limit(NULL, 1), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_control_set_callback(NULL, NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_field_interruption(NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_field_nearest_sources(NULL, NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_field_paths(NULL, NULL, NULL, &curves), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(curves == NULL);
    curves = (taut_curves *)&failures;
    CHECK_FAILS(taut_isolines_new(NULL, values, values, &curves), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(curves == NULL);
    curves = (taut_curves *)&failures;
    CHECK_FAILS(taut_descent_paths_new(NULL, values, NULL, NULL, NULL, &curves), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(curves == NULL);
    CHECK_FAILS(taut_curves_offsets(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_curves_positions(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_curves_faces(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_curves_barycentrics(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_curves_closed(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_curves_levels(NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_closest_new(NULL, &closest), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(closest == NULL);
    CHECK_FAILS(taut_closest_points(NULL, positions, NULL, out, out, out), TAUT_REASON_NULL_POINTER, 0, 0);

    mesh = rectangle();
    CHECK_FAILS(taut_time_step_value(mesh, step, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_positions(mesh, (taut_output){.count = 5}), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_exact_field_new(exact, NULL, NULL, NULL, &field), TAUT_REASON_NULL_POINTER, 0, 0);
    taut_exact_free(exact);
    CHECK_FAILS(taut_isolines_new(mesh, (taut_input){.count = 5}, values, &curves), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "values") != NULL);
    CHECK_FAILS(taut_isolines_new(mesh, values, (taut_input){.count = 1}, &curves), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "levels") != NULL);
    CHECK_FAILS(taut_isolines_new(mesh, values, values, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_descent_paths_new(mesh, (taut_input){.count = 5}, NULL, NULL, NULL, &curves), TAUT_REASON_NULL_POINTER, 0,
                0);
    CHECK(strstr(taut_last_error(NULL), "values") != NULL);
    CHECK_FAILS(taut_descent_paths_new(mesh, values, NULL, NULL, NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_closest_new(mesh, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    taut_mesh_free(mesh);

    CHECK(taut_mesh_vertex_count(NULL) == 0 && taut_mesh_triangle_count(NULL) == 0);
    CHECK(taut_mesh_ignored_count(NULL) == 0);
    CHECK(taut_heat_time_step(NULL) == 0 && taut_exact_field_final_radius(NULL) == 0);
    CHECK(taut_curves_count(NULL) == 0 && taut_curves_point_count(NULL) == 0);
    CHECK(taut_control_progress(NULL) == 0 && !taut_control_is_cancelled(NULL));
    taut_control_cancel(NULL);
    taut_control_free(NULL);
    taut_mesh_free(NULL);
    taut_exact_free(NULL);
    taut_exact_field_free(NULL);
    taut_heat_free(NULL);
    taut_heat_field_free(NULL);
    CHECK(taut_heat_field_restarts(NULL) == 0 && taut_heat_field_nonpositive_heat(NULL) == 0);
    taut_curves_free(NULL);
    taut_closest_free(NULL);
}

static void empty_mesh(void) {
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){0}, (taut_input){0}, &mesh) == TAUT_STATUS_OK);
    CHECK(mesh != NULL && taut_mesh_vertex_count(mesh) == 0 && taut_mesh_triangle_count(mesh) == 0);
    CHECK(taut_mesh_positions(mesh, (taut_output){0}) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
}

static void bad_meshes(void) {
    taut_mesh *mesh = NULL;
    const uint32_t beyond[] = {0, 1, 3, 1, 2, 5};
    const int64_t negative[] = {0, 1, 3, 1, -2, 3};
    double nan_xyz[15];
    memcpy(nan_xyz, xyz, sizeof xyz);
    nan_xyz[3 * 4] = NAN; /* of the vertex that no triangle uses: fine */

    CHECK_FAILS(taut_mesh_new(positions, (taut_input){.data = beyond, .count = 2}, &mesh),
                TAUT_REASON_INDEX_OUT_OF_RANGE, TAUT_ELEMENT_FACE, 1);
    CHECK_FAILS(taut_mesh_new(positions, (taut_input){.data = negative, .count = 2, .type = TAUT_TYPE_I64}, &mesh),
                TAUT_REASON_INDEX_OUT_OF_RANGE, TAUT_ELEMENT_FACE, 1);
    CHECK(taut_mesh_new((taut_input){.data = nan_xyz, .count = 5}, triangles, &mesh) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
    nan_xyz[3 * 2 + 1] = INFINITY;
    CHECK_FAILS(taut_mesh_new((taut_input){.data = nan_xyz, .count = 5}, triangles, &mesh),
                TAUT_REASON_NON_FINITE_COORDINATE, TAUT_ELEMENT_VERTEX, 2);

    /* Sizes that no memory has, types that are none. */
    taut_input huge = positions;
    huge.stride = SIZE_MAX / 2;
    CHECK(taut_mesh_new(huge, triangles, &mesh) == TAUT_STATUS_TOO_LARGE);
    huge.count = SIZE_MAX;
    huge.stride = 0;
    CHECK(taut_mesh_new(huge, triangles, &mesh) == TAUT_STATUS_TOO_LARGE);
    taut_input bad_type = positions;
    bad_type.type = TAUT_TYPE_U32;
    CHECK_FAILS(taut_mesh_new(bad_type, triangles, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    bad_type = triangles;
    bad_type.type = TAUT_TYPE_F64;
    CHECK_FAILS(taut_mesh_new(positions, bad_type, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    bad_type.type = 4000000000u;
    CHECK_FAILS(taut_mesh_new(positions, bad_type, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "triangles.type") != NULL);

    CHECK(taut_mesh_read("/no/such/mesh.off", &mesh) == TAUT_STATUS_IO && mesh == NULL);
    CHECK_FAILS(taut_mesh_read("\xff.off", &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
}

static void ignored_triangles(void) {
    const uint32_t repeated[] = {0, 1, 3, 2, 2, 1, 1, 2, 3};
    taut_mesh *mesh = NULL;
    int64_t ignored[2] = {-7, -7};
    const taut_output out = {.data = ignored, .count = 2, .type = TAUT_TYPE_I64};
    CHECK(taut_mesh_new(positions, (taut_input){.data = repeated, .count = 3}, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_triangle_count(mesh) == 3 && taut_mesh_ignored_count(mesh) == 1);
    CHECK(taut_mesh_ignored_triangles(mesh, out) == TAUT_STATUS_OK);
    CHECK(ignored[0] == 1 && ignored[1] == -7);
    taut_mesh_free(mesh);
}

static bool same_as_rectangle(const taut_mesh *mesh) {
    double p[15] = {0};
    uint32_t t[6] = {0};
    CHECK(taut_mesh_positions(mesh, (taut_output){.data = p, .count = 5}) == TAUT_STATUS_OK);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = t, .count = 2}) == TAUT_STATUS_OK);
    return memcmp(p, xyz, sizeof p) == 0 && memcmp(t, corners, sizeof t) == 0;
}

/* The same mesh from every type, with gaps between rows and off alignment. */
static void every_packing_in(void) {
    enum { GAP = 41 };
    unsigned char p[1 + 5 * GAP], t[1 + 2 * GAP];
    const taut_type scalars[] = {TAUT_TYPE_F32, TAUT_TYPE_F64};
    const taut_type indices[] = {TAUT_TYPE_U16, TAUT_TYPE_U32, TAUT_TYPE_U64, TAUT_TYPE_I32, TAUT_TYPE_I64};
    for (size_t s = 0; s < 2; s++) {
        for (size_t v = 0; v < 5; v++) {
            const double *row = xyz + 3 * v;
            const float single[] = {(float)row[0], (float)row[1], (float)row[2]};
            const void *bytes = scalars[s] == TAUT_TYPE_F32 ? (const void *)single : (const void *)row;
            memcpy(p + 1 + v * GAP, bytes, scalars[s] == TAUT_TYPE_F32 ? sizeof single : 3 * sizeof *row);
        }
        for (size_t i = 0; i < 5; i++) {
            for (size_t f = 0; f < 2; f++) {
                for (size_t k = 0; k < 3; k++) {
                    const uint16_t u16 = (uint16_t)corners[3 * f + k];
                    const uint32_t u32 = u16;
                    const uint64_t u64 = u16;
                    unsigned char *row = t + 1 + f * GAP;
                    switch (indices[i]) {
                    case TAUT_TYPE_U16: memcpy(row + 2 * k, &u16, 2); break;
                    case TAUT_TYPE_U32:
                    case TAUT_TYPE_I32: memcpy(row + 4 * k, &u32, 4); break;
                    default: memcpy(row + 8 * k, &u64, 8);
                    }
                }
            }
            taut_mesh *mesh = NULL;
            CHECK(taut_mesh_new((taut_input){.data = p + 1, .count = 5, .stride = GAP, .type = scalars[s]},
                                (taut_input){.data = t + 1, .count = 2, .stride = GAP, .type = indices[i]},
                                &mesh) == TAUT_STATUS_OK);
            CHECK(same_as_rectangle(mesh));
            taut_mesh_free(mesh);
        }
    }
}

static void polygons(void) {
    const uint16_t offsets[] = {0, 4}, bad_offsets[] = {0, 5}, small[] = {0, 2, 4};
    const int32_t quad[] = {0, 1, 2, 3};
    const taut_input quads = {.data = quad, .count = 4, .type = TAUT_TYPE_I32};
    taut_mesh *mesh = NULL;
    uint32_t fan[6];
    CHECK(taut_mesh_new_polygons(positions, (taut_input){.data = offsets, .count = 2, .type = TAUT_TYPE_U16}, quads,
                                 &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_triangle_count(mesh) == 2);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = fan, .count = 2}) == TAUT_STATUS_OK);
    CHECK(fan[0] == 0 && fan[1] == 1 && fan[2] == 2 && fan[3] == 0 && fan[4] == 2 && fan[5] == 3);
    taut_mesh_free(mesh);
    CHECK_FAILS(taut_mesh_new_polygons(positions, (taut_input){.data = bad_offsets, .count = 2, .type = TAUT_TYPE_U16},
                                       quads, &mesh), TAUT_REASON_BAD_OFFSETS, TAUT_ELEMENT_FACE, 0);
    CHECK_FAILS(taut_mesh_new_polygons(positions, (taut_input){.data = small, .count = 3, .type = TAUT_TYPE_U16}, quads,
                                       &mesh), TAUT_REASON_FACE_TOO_SMALL, TAUT_ELEMENT_FACE, 0);
    CHECK(taut_mesh_new_polygons(positions, (taut_input){0}, (taut_input){0}, &mesh) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
}

/* A float in each row of 7 bytes, off alignment; the bytes between stay as they were. */
static void strided_output(void) {
    enum { GAP = 7 };
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    unsigned char bytes[1 + 6 * GAP];
    const float expected[] = {0, 3, 5, 4, INFINITY};
    memset(bytes, 0xab, sizeof bytes);
    CHECK(taut_exact_field_new(exact, &from_zero, NULL, NULL, &field) == TAUT_STATUS_OK);
    taut_exact_free(exact); /* before the field that was made from it */
    const taut_output out = {.data = bytes + 1, .count = 6, .stride = GAP, .type = TAUT_TYPE_F32};
    CHECK(taut_exact_field_distances(field, NULL, out) == TAUT_STATUS_OK);
    CHECK(bytes[0] == 0xab);
    for (size_t v = 0; v < 5; v++) {
        CHECK(memcmp(bytes + 1 + v * GAP, expected + v, sizeof(float)) == 0);
        for (size_t gap = sizeof(float); gap < GAP; gap++) CHECK(bytes[1 + v * GAP + gap] == 0xab);
    }
    for (size_t i = 1 + 5 * GAP; i < sizeof bytes; i++) CHECK(bytes[i] == 0xab); /* room beyond the need */

    /* All or nothing. */
    double d[5] = {-1, -1, -1, -1, -1};
    CHECK_FAILS(taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 4}), TAUT_REASON_BUFFER_TOO_SMALL,
                0, 0);
    CHECK_FAILS(taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5, .stride = 4}),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5, .type = TAUT_TYPE_I32}),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5, .stride = SIZE_MAX / 2}) ==
          TAUT_STATUS_TOO_LARGE);
    for (size_t v = 0; v < 5; v++) CHECK(d[v] == -1);
    taut_exact_field_free(field);
}

static void indices_that_do_not_fit(void) {
    enum { COUNT = 70000 };
    double *many = calloc(3 * COUNT, sizeof *many);
    const uint32_t large[] = {0, 1, COUNT - 1};
    uint16_t narrow[] = {7, 7, 7};
    int32_t wide[3];
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){.data = many, .count = COUNT}, (taut_input){.data = large, .count = 1}, &mesh) ==
          TAUT_STATUS_OK);
    CHECK_FAILS(taut_mesh_triangles(mesh, (taut_output){.data = narrow, .count = 1, .type = TAUT_TYPE_U16}),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(narrow[0] == 7 && narrow[1] == 7 && narrow[2] == 7);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = wide, .count = 1, .type = TAUT_TYPE_I32}) == TAUT_STATUS_OK);
    CHECK(wide[0] == 0 && wide[1] == 1 && wide[2] == COUNT - 1);
    taut_mesh_free(mesh);
    free(many);
}

static void sources(void) {
    taut_exact *exact = exact_rectangle();
    double d[5] = {-1, -1, -1, -1, -1};
    const int32_t ends[] = {0, 2}, negative[] = {0, -2};
    const uint64_t beyond[] = {0, 1, 5}, far_beyond[] = {0, UINT64_C(1) << 32};
    const float offsets[] = {0, 1.5f}, no_number[] = {0, NAN};
    taut_sources from = {.struct_size = sizeof from};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_NO_SOURCE, 0, 0);

    from.vertices = (taut_input){.data = beyond, .count = 3, .type = TAUT_TYPE_U64};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_SOURCE, 2);
    from.vertices = (taut_input){.data = far_beyond, .count = 2, .type = TAUT_TYPE_U64};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_SOURCE, 1);
    from.vertices = (taut_input){.data = negative, .count = 2, .type = TAUT_TYPE_I32};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_SOURCE, 1);

    from.vertices = (taut_input){.data = ends, .count = 2, .type = TAUT_TYPE_I32};
    from.offsets = (taut_input){.data = offsets, .count = 1, .type = TAUT_TYPE_F32};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    from.offsets = (taut_input){.data = no_number, .count = 2, .type = TAUT_TYPE_F32};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    for (size_t v = 0; v < 5; v++) CHECK(d[v] == -1);

    from.offsets = (taut_input){.data = offsets, .count = 2, .type = TAUT_TYPE_F32};
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK);
    CHECK(d[0] == 0 && d[1] == 3 && d[2] == 1.5 && d[3] == 4 && d[4] == INFINITY);

    /* An older caller, whose struct ends before the offsets. */
    from.struct_size = offsetof(taut_sources, offsets);
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK && d[2] == 0);
    from.struct_size = 0;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);

    /* A newer caller, whose struct has fields that are unknown here. */
    struct {
        taut_sources known;
        unsigned char newer[24];
    } future = {.known = from_zero};
    future.known.struct_size = sizeof future;
    CHECK(field_of(exact, &future.known, d) == TAUT_STATUS_OK && is_rectangle_field(d));
    future.newer[23] = 1;
    CHECK_FAILS(field_of(exact, &future.known, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    taut_exact_free(exact);
}

static void targets(void) {
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    const uint16_t near[] = {1}, beyond[] = {1, 5};
    const uint32_t face = 0, no_face = 2;
    const double middle[] = {0.5, 0.25, 0.25};
    double d[5];
    taut_targets to = {.struct_size = sizeof to, .vertices = {.data = beyond, .count = 2, .type = TAUT_TYPE_U16}};
    taut_exact_options options = {.struct_size = sizeof options, .targets = &to};
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_VERTEX_OUT_OF_RANGE,
                TAUT_ELEMENT_TARGET, 1);
    CHECK(field == NULL);
    to.vertices = (taut_input){.data = near, .count = 1, .type = TAUT_TYPE_U16};
    CHECK(taut_exact_field_new(exact, &from_zero, &options, NULL, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_final_radius(field) >= 3);
    CHECK(taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5}) == TAUT_STATUS_OK);
    CHECK(d[0] == 0 && d[1] == 3);
    taut_exact_field_free(field);

    /* A point comes after the vertices; it is 1.25 away. */
    to.faces = (taut_input){.data = &no_face, .count = 1};
    to.barycentrics = (taut_input){.data = middle, .count = 1};
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT,
                TAUT_ELEMENT_TARGET, 1);
    to.barycentrics.count = 0;
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "options.targets.barycentrics") != NULL);
    to.barycentrics.count = 1;
    to.faces.data = &face;
    to.vertices.count = 0;
    options.keep_windows = 1;
    CHECK(taut_exact_field_new(exact, &from_zero, &options, NULL, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_final_radius(field) >= 1.25);
    CHECK(taut_exact_field_distances(field, &to, (taut_output){.data = d, .count = 1}) == TAUT_STATUS_OK);
    CHECK(d[0] == 1.25 && d[1] == 3);
    taut_exact_field_free(field);

    /* None at all means every vertex; a struct without room for its size is refused. */
    to = (taut_targets){.struct_size = sizeof to};
    CHECK(taut_exact_field_new(exact, &from_zero, &options, NULL, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_final_radius(field) == INFINITY);
    taut_exact_field_free(field);
    to.struct_size = 1;
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "options.targets.struct_size") != NULL);
    taut_exact_free(exact);
}

static void cancelled_before_the_start(void) {
    taut_mesh *mesh = rectangle();
    taut_exact *exact = exact_rectangle();
    taut_heat *heat = NULL, *again = NULL;
    taut_exact_field *field = NULL;
    taut_control *control = NULL;
    double d[5] = {-1, -1, -1, -1, -1};
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    CHECK(taut_control_progress(control) == 0 && !taut_control_is_cancelled(control));
    taut_control_cancel(control);
    CHECK(taut_control_is_cancelled(control));

    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, NULL, control, &field), TAUT_REASON_CANCELLED, 0, 0);
    CHECK(field == NULL);
    CHECK(taut_heat_new(mesh, NULL, control, &again) == TAUT_STATUS_CANCELLED && again == NULL);
    CHECK(taut_heat_with_time_step(heat, (taut_time_step){.value = 1}, control, &again) == TAUT_STATUS_CANCELLED);
    CHECK(again == NULL);
    taut_heat_field *heat_field = (taut_heat_field *)&failures;
    CHECK(taut_heat_field_new(heat, &from_zero, control, &heat_field) == TAUT_STATUS_CANCELLED && heat_field == NULL);
    const taut_output out = {.data = d, .count = 1, .stride = sizeof d};
    CHECK(taut_heat_distance_rows(heat, &from_zero, each, 1, control, out) == TAUT_STATUS_CANCELLED);
    CHECK(taut_heat_with_mesh(heat, mesh, control, &again) == TAUT_STATUS_CANCELLED && again == NULL);
    for (size_t v = 0; v < 5; v++) CHECK(d[v] == -1);
    taut_control_free(control);
    taut_heat_free(heat);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
}

static void a_radius(void) {
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    double d[5];
    taut_exact_options options = {.struct_size = sizeof options, .radius = 4};
    CHECK(taut_exact_field_new(exact, &from_zero, &options, NULL, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_final_radius(field) == 4 && taut_exact_field_interruption(field, NULL) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5}) == TAUT_STATUS_OK);
    CHECK(d[0] == 0 && d[1] == 3 && d[2] == INFINITY && d[3] == 4 && d[4] == INFINITY);
    taut_exact_field_free(field);
    options.struct_size = offsetof(taut_exact_options, radius); /* an older caller */
    CHECK(taut_exact_field_new(exact, &from_zero, &options, NULL, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_final_radius(field) == INFINITY);
    taut_exact_field_free(field);

    options = (taut_exact_options){.struct_size = sizeof options, .radius = -1};
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options.radius = NAN;
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options = (taut_exact_options){.struct_size = sizeof options, .allow_partial = 2};
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options = (taut_exact_options){.struct_size = sizeof options, .keep_windows = 2};
    CHECK_FAILS(taut_exact_field_new(exact, &from_zero, &options, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(field == NULL);
    taut_exact_free(exact);
}

/* Hills of SQUARES by SQUARES, on which the exact method works for a while. */
enum { SQUARES = 300, HILL_VERTICES = (SQUARES + 1) * (SQUARES + 1) };

static taut_mesh *hills(void) {
    double *points = malloc(sizeof *points * 3 * HILL_VERTICES);
    uint32_t *sides = malloc(sizeof *sides * 6 * SQUARES * SQUARES);
    uint32_t v = 0;
    size_t corner = 0;
    for (uint32_t j = 0; j <= SQUARES; j++) {
        for (uint32_t i = 0; i <= SQUARES; i++, v++) {
            points[3 * v] = i;
            points[3 * v + 1] = j;
            points[3 * v + 2] = 3 * sin(0.3 * i + 0.1 * j) * cos(0.2 * j - 0.05 * i);
            if (i == SQUARES || j == SQUARES) continue;
            const uint32_t up = v + SQUARES + 1, square[] = {v, v + 1, up, v + 1, up + 1, up};
            for (size_t k = 0; k < 6; k++) sides[corner++] = square[k];
        }
    }
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){.data = points, .count = HILL_VERTICES},
                        (taut_input){.data = sides, .count = 2 * SQUARES * SQUARES}, &mesh) == TAUT_STATUS_OK);
    free(points);
    free(sides);
    return mesh;
}

/* A long call, made on a thread of its own or of the caller. */
typedef struct {
    const taut_exact *exact;
    taut_control *control;
    uint32_t allow_partial;
    taut_status status;
    taut_exact_field *field;
    pthread_t thread;
} job;

static void *work(void *user) {
    job *it = user;
    taut_exact_options options = {.struct_size = sizeof options, .allow_partial = it->allow_partial};
    it->thread = pthread_self();
    it->status = taut_exact_field_new(it->exact, &from_zero, &options, it->control, &it->field);
    return NULL;
}

static job new_job(const taut_exact *exact, uint32_t allow_partial) {
    job it = {.exact = exact, .allow_partial = allow_partial, .status = TAUT_STATUS_INTERNAL};
    CHECK(taut_control_new(&it.control) == TAUT_STATUS_OK);
    return it;
}

/* The call ended with `why`, or with a part of the distances if it may; frees what it has. */
static void check_interrupted(job *it, taut_status why) {
    static double d[HILL_VERTICES];
    if (!it->allow_partial) {
        CHECK(it->status == why && it->field == NULL);
    } else {
        double radius = taut_exact_field_final_radius(it->field);
        size_t known = 0;
        CHECK(it->status == TAUT_STATUS_OK && taut_exact_field_interruption(it->field, NULL) == why);
        CHECK(radius < INFINITY);
        CHECK(taut_exact_field_distances(it->field, NULL, (taut_output){.data = d, .count = HILL_VERTICES}) ==
              TAUT_STATUS_OK);
        for (size_t v = 0; v < HILL_VERTICES; v++) {
            CHECK(d[v] <= radius || d[v] == INFINITY);
            known += d[v] < INFINITY;
        }
        CHECK(known < HILL_VERTICES && (known > 0) == (radius >= 0));
    }
    taut_exact_field_free(it->field);
    taut_control_free(it->control);
}

/* What a callback has seen. */
typedef struct {
    int calls;
    int cancel_at; /* 0: never */
    pthread_t thread;
    bool on_one_thread;
    double progress;
} witness;

static int watch(double progress, void *user) {
    witness *it = user;
    if (it->calls++ == 0) {
        it->thread = pthread_self();
        it->on_one_thread = true;
    }
    it->on_one_thread = it->on_one_thread && pthread_equal(it->thread, pthread_self());
    CHECK(progress >= it->progress && progress <= 1);
    it->progress = progress;
    return it->calls == it->cancel_at ? -7 : 0;
}

static void callbacks(const taut_exact *exact) {
    /* On the thread of the call, which is not that of the control. */
    witness seen = {0};
    job it = new_job(exact, 0);
    pthread_t thread;
    CHECK(taut_control_set_callback(it.control, watch, &seen) == TAUT_STATUS_OK);
    CHECK(pthread_create(&thread, NULL, work, &it) == 0 && pthread_join(thread, NULL) == 0);
    CHECK(it.status == TAUT_STATUS_OK && taut_exact_field_final_radius(it.field) == INFINITY);
    CHECK(seen.calls > 10 && seen.progress == 1 && seen.on_one_thread && pthread_equal(seen.thread, it.thread));
    taut_exact_field_free(it.field);
    taut_control_free(it.control);

    for (uint32_t allow_partial = 0; allow_partial <= 1; allow_partial++) {
        seen = (witness){.cancel_at = 10};
        it = new_job(exact, allow_partial);
        CHECK(taut_control_set_callback(it.control, watch, &seen) == TAUT_STATUS_OK);
        work(&it);
        CHECK(seen.calls == 10 && taut_control_is_cancelled(it.control));
        check_interrupted(&it, TAUT_STATUS_CANCELLED);
    }

    /* Taken away again. */
    seen = (witness){0};
    it = new_job(exact, 0);
    CHECK(taut_control_set_callback(it.control, watch, &seen) == TAUT_STATUS_OK);
    CHECK(taut_control_set_callback(it.control, NULL, NULL) == TAUT_STATUS_OK);
    work(&it);
    CHECK(it.status == TAUT_STATUS_OK && seen.calls == 0);
    taut_exact_field_free(it.field);
    taut_control_free(it.control);
}

static void cancelled_from_another_thread(const taut_exact *exact) {
    for (uint32_t allow_partial = 0; allow_partial <= 1; allow_partial++) {
        job it = new_job(exact, allow_partial);
        pthread_t thread;
        CHECK(pthread_create(&thread, NULL, work, &it) == 0);
        while (taut_control_progress(it.control) < 0.05) continue;
        taut_control_cancel(it.control);
        CHECK(pthread_join(thread, NULL) == 0);
        check_interrupted(&it, TAUT_STATUS_CANCELLED);
    }
}

static void limits(const taut_exact *exact) {
    for (uint32_t allow_partial = 0; allow_partial <= 1; allow_partial++) {
        job it = new_job(exact, allow_partial);
        CHECK(taut_control_set_time_limit(it.control, 0.01) == TAUT_STATUS_OK);
        work(&it);
        CHECK(allow_partial || last_is(TAUT_REASON_TIME_LIMIT, 0, 0));
        check_interrupted(&it, TAUT_STATUS_LIMIT_REACHED);

        it = new_job(exact, allow_partial);
        CHECK(taut_control_set_memory_limit(it.control, 1) == TAUT_STATUS_OK);
        work(&it);
        CHECK(allow_partial || last_is(TAUT_REASON_MEMORY_LIMIT, 0, 0));
        check_interrupted(&it, TAUT_STATUS_LIMIT_REACHED);
    }

    /* 0 takes a limit away. */
    job it = new_job(exact, 0);
    CHECK(taut_control_set_time_limit(it.control, 1e-9) == TAUT_STATUS_OK);
    CHECK(taut_control_set_time_limit(it.control, 0) == TAUT_STATUS_OK);
    CHECK(taut_control_set_memory_limit(it.control, 1) == TAUT_STATUS_OK);
    CHECK(taut_control_set_memory_limit(it.control, 0) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_control_set_time_limit(it.control, -1), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_control_set_time_limit(it.control, NAN), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    work(&it);
    CHECK(it.status == TAUT_STATUS_OK && taut_exact_field_interruption(it.field, NULL) == TAUT_STATUS_OK);
    taut_exact_field_free(it.field);
    CHECK(taut_control_set_time_limit(it.control, INFINITY) == TAUT_STATUS_OK);
    CHECK(taut_control_set_time_limit(it.control, 1e300) == TAUT_STATUS_OK);
    work(&it);
    CHECK(it.status == TAUT_STATUS_OK);
    taut_exact_field_free(it.field);
    taut_control_free(it.control);
}

static void heat_is_interrupted(const taut_mesh *mesh) {
    taut_heat *heat = NULL;
    taut_control *late = NULL, *watched = NULL;
    witness seen = {.cancel_at = 3};
    CHECK(taut_control_new(&late) == TAUT_STATUS_OK && taut_control_new(&watched) == TAUT_STATUS_OK);
    CHECK(taut_control_set_time_limit(late, 1e-9) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_heat_new(mesh, NULL, late, &heat), TAUT_REASON_TIME_LIMIT, 0, 0);
    CHECK(taut_control_set_callback(watched, watch, &seen) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_heat_new(mesh, NULL, watched, &heat), TAUT_REASON_CANCELLED, 0, 0);
    CHECK(heat == NULL && seen.calls == 3);
    taut_control_free(watched);
    taut_control_free(late);
}

static void long_calls(void) {
    taut_mesh *mesh = hills();
    taut_exact *exact = NULL;
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    callbacks(exact);
    cancelled_from_another_thread(exact);
    limits(exact);
    heat_is_interrupted(mesh);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
}

/* The distances of a field that is forgotten at once. */
static taut_status heat_distances(const taut_heat *heat, const taut_sources *from, double *d) {
    taut_heat_field *field = NULL;
    taut_status status = taut_heat_field_new(heat, from, NULL, &field);
    if (!status) status = taut_heat_field_distances(field, (taut_output){.data = d, .count = 5});
    CHECK((status == TAUT_STATUS_OK) == (field != NULL));
    taut_heat_field_free(field);
    return status;
}

static taut_status heat_with(const taut_mesh *mesh, const taut_heat_options *options, double *d) {
    taut_heat *heat = NULL;
    taut_status status = taut_heat_new(mesh, options, NULL, &heat);
    if (!status) status = heat_distances(heat, &from_zero, d);
    CHECK(status != TAUT_STATUS_OK || taut_heat_time_step(heat) > 0);
    taut_heat_free(heat);
    return status;
}

static void heat_options(void) {
    taut_mesh *mesh = rectangle();
    double by_default[5], d[5];
    taut_heat_options options = {.struct_size = sizeof options};
    CHECK(heat_with(mesh, NULL, by_default) == TAUT_STATUS_OK);
    CHECK(by_default[0] == 0 && by_default[2] > 0 && by_default[4] == INFINITY);

    /* All zero is the default, which has names too; an older caller has no options but the time step. */
    CHECK(heat_with(mesh, &options, d) == TAUT_STATUS_OK && memcmp(d, by_default, sizeof d) == 0);
    options.time_step = (taut_time_step){TAUT_TIME_FORMULA_MEAN_EDGE, TAUT_TIME_SCALE_PAPER, 1, 0};
    options.laplacian = TAUT_LAPLACIAN_INTRINSIC;
    options.shift = TAUT_SHIFT_PINNED;
    options.solver = TAUT_SOLVER_SUPERNODAL;
    CHECK(heat_with(mesh, &options, d) == TAUT_STATUS_OK && memcmp(d, by_default, sizeof d) == 0);
    options.struct_size = offsetof(taut_heat_options, boundary);
    options.boundary = -1; /* beyond its end */
    CHECK(heat_with(mesh, &options, d) == TAUT_STATUS_OK && memcmp(d, by_default, sizeof d) == 0);

    options = (taut_heat_options){.struct_size = sizeof options, .boundary = -1};
    CHECK_FAILS(heat_with(mesh, &options, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options = (taut_heat_options){.struct_size = sizeof options, .laplacian = 3};
    CHECK_FAILS(heat_with(mesh, &options, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "laplacian") != NULL);
    options = (taut_heat_options){.struct_size = sizeof options, .shift = 3};
    CHECK_FAILS(heat_with(mesh, &options, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options = (taut_heat_options){.struct_size = sizeof options, .solver = 3};
    CHECK_FAILS(heat_with(mesh, &options, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options = (taut_heat_options){.struct_size = sizeof options, .reserved = 1};
    CHECK_FAILS(heat_with(mesh, &options, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    options = (taut_heat_options){.struct_size = sizeof options, .solver = TAUT_SOLVER_LDL}; /* not in this library */
    CHECK_FAILS(heat_with(mesh, &options, d), TAUT_REASON_MISSING_FEATURE, 0, 0);
    taut_mesh_free(mesh);
}

static void time_steps(void) {
    taut_mesh *mesh = rectangle();
    taut_heat *heat = NULL, *again = NULL;
    double t = -1, d[5], fresh[5];
    /* The mean edge of the rectangle is (3 + 4 + 3 + 4 + 5) / 5. */
    const double mean = 19.0 / 5;
    CHECK(taut_time_step_value(mesh, (taut_time_step){0}, &t) == TAUT_STATUS_OK && fabs(t - mean * mean) < 1e-13);
    CHECK(taut_time_step_value(mesh, (taut_time_step){.factor = 2}, &t) == TAUT_STATUS_OK);
    CHECK(fabs(t - 2 * mean * mean) < 1e-13);
    CHECK(taut_time_step_value(mesh, (taut_time_step){.value = 0.25}, &t) == TAUT_STATUS_OK && t == 0.25);
    t = -1;
    CHECK_FAILS(taut_time_step_value(mesh, (taut_time_step){.value = -0.25}, &t), TAUT_REASON_BAD_TIME_STEP, 0, 0);
    CHECK_FAILS(taut_time_step_value(mesh, (taut_time_step){.value = NAN}, &t), TAUT_REASON_BAD_TIME_STEP, 0, 0);
    const taut_time_step both = {.value = 1, .factor = 1};
    CHECK_FAILS(taut_time_step_value(mesh, both, &t), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_time_step_value(mesh, (taut_time_step){.formula = 6}, &t), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_time_step_value(mesh, (taut_time_step){.scale = 3}, &t), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(t == -1);

    /* A solver for another time step equals a fresh one, and outlives what it was made from. */
    const taut_heat_options options = {.struct_size = sizeof options, .time_step = {.factor = 0.5}};
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    CHECK(taut_heat_with_time_step(heat, options.time_step, NULL, &again) == TAUT_STATUS_OK);
    CHECK(fabs(taut_heat_time_step(again) - mean * mean / 2) < 1e-13);
    CHECK(heat_with(mesh, &options, fresh) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
    taut_heat_free(heat);
    CHECK(heat_distances(again, &from_zero, d) == TAUT_STATUS_OK);
    CHECK(memcmp(d, fresh, sizeof d) == 0);
    taut_heat_free(again);
}

/* Nearest sources, rows, the report, and a mesh that moves. */
static void heat_fields(void) {
    taut_mesh *mesh = rectangle(), *moved = NULL, *broken = (taut_mesh *)&failures;
    taut_heat *heat = NULL, *again = (taut_heat *)&failures;
    taut_heat_field *field = NULL;
    const uint32_t ends[] = {0, 2};
    const taut_sources from = {.struct_size = sizeof from, .vertices = {.data = ends, .count = 2}};
    int32_t nearest[5] = {7, 7, 7, 7, 7};
    double rows[2][5], d[5], xyz[5][3];
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    CHECK(taut_heat_field_new(heat, &from, NULL, &field) == TAUT_STATUS_OK);
    CHECK(taut_heat_field_restarts(field) == 0 && taut_heat_field_nonpositive_heat(field) == 0);
    const taut_output to_nearest = {.data = nearest, .count = 5, .type = TAUT_TYPE_I32};
    CHECK(taut_heat_field_nearest_sources(field, to_nearest) == TAUT_STATUS_OK);
    CHECK(nearest[0] == 0 && nearest[2] == 1 && nearest[4] == -1);
    CHECK_FAILS(taut_heat_field_distances(field, (taut_output){.data = d, .count = 4}), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    taut_heat_field_free(field);

    const taut_output to_rows = {.data = rows, .count = 2, .stride = sizeof rows[0]};
    CHECK(taut_heat_distance_rows(heat, &from, each, 2, NULL, to_rows) == TAUT_STATUS_OK);
    for (size_t i = 0; i < 2; i++) {
        const taut_sources one = {.struct_size = sizeof one, .vertices = {.data = ends + i, .count = 1}};
        CHECK(heat_distances(heat, &one, d) == TAUT_STATUS_OK && memcmp(d, rows[i], sizeof d) == 0);
    }
    CHECK_FAILS(taut_heat_distance_rows(heat, &from, each, 2, NULL, (taut_output){.data = rows, .count = 1}),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);

    taut_heat_report report = {.struct_size = sizeof report};
    CHECK(taut_heat_report_of(heat, &report) == TAUT_STATUS_OK);
    CHECK(report.struct_size == sizeof report && report.heat_seconds > 0 && report.mollified == 0);
    CHECK_FAILS(taut_heat_report_of(heat, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    taut_heat_report older = {.struct_size = offsetof(taut_heat_report, mollified), .mollified = 77};
    CHECK(taut_heat_report_of(heat, &older) == TAUT_STATUS_OK && older.mollified == 77);

    /* Twice the size has twice the distances. */
    CHECK(taut_mesh_positions(mesh, (taut_output){.data = xyz, .count = 5}) == TAUT_STATUS_OK);
    for (size_t i = 0; i < 15; i++) xyz[i / 3][i % 3] *= 2;
    const taut_input twice = {.data = xyz, .count = 5};
    CHECK_FAILS(taut_mesh_with_positions(mesh, (taut_input){.data = xyz, .count = 4}, &broken), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(broken == NULL);
    CHECK(taut_mesh_with_positions(mesh, twice, &moved) == TAUT_STATUS_OK);
    CHECK(taut_heat_with_mesh(heat, moved, NULL, &again) == TAUT_STATUS_OK);
    CHECK(heat_distances(heat, &from, d) == TAUT_STATUS_OK && heat_distances(again, &from, rows[0]) == TAUT_STATUS_OK);
    for (size_t v = 0; v < 4; v++) CHECK(rows[0][v] == 2 * d[v]);
    CHECK_FAILS(taut_heat_with_mesh(heat, NULL, NULL, &again), TAUT_REASON_NULL_POINTER, 0, 0);
    xyz[1][1] = NAN;
    CHECK_FAILS(taut_mesh_with_positions(mesh, twice, &broken), TAUT_REASON_NON_FINITE_COORDINATE, TAUT_ELEMENT_VERTEX, 1);
    taut_mesh_free(moved);
    taut_heat_free(heat);
    taut_mesh_free(mesh);
}

static void exact_distances(void) {
    taut_exact *exact = exact_rectangle();
    double d[5];
    CHECK(field_of(exact, &from_zero, d) == TAUT_STATUS_OK);
    CHECK(is_rectangle_field(d));
    taut_exact_free(exact);
}

/* Two triangles that touch in vertex 2, one of them twice; a repeated index; a copy of vertex 0; a loose vertex. */
static taut_report *messy_report(void) {
    const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 1, 2, 0, 0, 0, -0.0, 5, 5, 5};
    const uint32_t faces[] = {0, 1, 2, 2, 3, 4, 1, 0, 2, 5, 5, 1};
    taut_mesh *mesh = NULL;
    taut_report *report = NULL;
    CHECK(taut_mesh_new((taut_input){.data = points, .count = 7}, (taut_input){.data = faces, .count = 4}, &mesh) ==
          TAUT_STATUS_OK);
    CHECK(taut_report_new(mesh, &report) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return report;
}

static void reports(void) {
    taut_report *report = messy_report();
    const size_t counts[] = {0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 2, 0};
    for (uint32_t finding = 0; finding < sizeof counts / sizeof *counts; finding++) {
        CHECK(taut_report_count(report, finding) == counts[finding]);
    }
    CHECK(last_is(TAUT_REASON_BAD_ARGUMENT, 0, 0)); /* kinds 0 and 12 do not exist */
    uint32_t pair[2] = {9, 9}, one = 9, chain[3];
    const taut_output pairs = {.data = pair, .count = 1}, single = {.data = &one, .count = 1};
    CHECK(taut_report_list(report, TAUT_FINDING_DUPLICATE_FACES, pairs) == TAUT_STATUS_OK && pair[0] == 2 && pair[1] == 0);
    CHECK(taut_report_list(report, TAUT_FINDING_DUPLICATE_VERTICES, pairs) == TAUT_STATUS_OK);
    CHECK(pair[0] == 5 && pair[1] == 0);
    CHECK(taut_report_list(report, TAUT_FINDING_NONMANIFOLD_VERTICES, single) == TAUT_STATUS_OK && one == 2);
    CHECK(taut_report_list(report, TAUT_FINDING_REPEATED_INDEX_FACES, single) == TAUT_STATUS_OK && one == 3);
    CHECK(taut_report_list(report, TAUT_FINDING_BOUNDARY_LOOPS, pairs) == TAUT_STATUS_OK && pair[0] == 3 && pair[1] == 1);
    CHECK(taut_report_boundary_vertices(report, (taut_output){.data = chain, .count = 3}) == TAUT_STATUS_OK);
    CHECK(chain[0] + chain[1] + chain[2] == 2 + 3 + 4);
    pair[0] = 9;
    CHECK_FAILS(taut_report_list(report, TAUT_FINDING_UNREFERENCED_VERTICES, single), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_report_boundary_vertices(report, pairs), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_report_list(report, 12, pairs), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(one == 3 && pair[0] == 9);

    uint64_t component_of[7];
    CHECK(taut_report_component_of(report, (taut_output){.data = component_of, .count = 7, .type = TAUT_TYPE_U64}) ==
          TAUT_STATUS_OK);
    CHECK(component_of[0] == 0 && component_of[4] == 0 && component_of[5] == UINT64_MAX && component_of[6] == UINT64_MAX);

    taut_component part = {.struct_size = sizeof part};
    CHECK(taut_report_component(report, 0, &part) == TAUT_STATUS_OK);
    CHECK(part.vertices == 5 && part.edges == 6 && part.faces == 3 && part.first_vertex == 0);
    CHECK(part.boundary_loops == 1 && part.manifold == 0 && part.orientable == 1 && part.genus == 0);
    part = (taut_component){.struct_size = offsetof(taut_component, faces), .faces = 77}; /* an older caller */
    CHECK(taut_report_component(report, 0, &part) == TAUT_STATUS_OK && part.edges == 6 && part.faces == 77);
    CHECK_FAILS(taut_report_component(report, 1, &part), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_report_component(report, 0, NULL), TAUT_REASON_NULL_POINTER, 0, 0);

    taut_angle smallest, largest;
    CHECK(taut_report_angles(report, &smallest, &largest) == TAUT_STATUS_OK);
    CHECK(fabs(smallest.radians - atan(1)) < 1e-15 && fabs(largest.radians - 2 * atan(1)) < 1e-15);
    CHECK(largest.face == 0 && largest.vertex == 0);
    CHECK_FAILS(taut_report_angles(report, &smallest, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_report_angles(NULL, &smallest, &largest), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(taut_report_count(NULL, 1) == 0 && last_is(TAUT_REASON_NULL_POINTER, 0, 0));
    taut_report_free(report);
    taut_report_free(NULL);
    CHECK_FAILS(taut_report_new(NULL, &report), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(report == NULL);
}

static void properties(void) {
    taut_mesh *mesh = rectangle(), *empty = NULL;
    taut_properties all = {.struct_size = sizeof all};
    CHECK(taut_mesh_properties(mesh, &all) == TAUT_STATUS_OK);
    CHECK(all.vertices == 5 && all.edges == 5 && all.faces == 2);
    CHECK(fabs(all.mean_edge - 3.8) < 1e-14 && all.min_edge == 3 && all.q2 == 4 && all.max_edge == 5);
    CHECK(fabs(all.min_angle - atan(0.75)) < 1e-15 && fabs(all.paper_scale - 24.976 / 5) < 1e-14);
    CHECK_FAILS(taut_mesh_properties(mesh, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_properties(NULL, &all), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(taut_mesh_new((taut_input){0}, (taut_input){0}, &empty) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_mesh_properties(empty, &all), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(all.vertices == 5); /* nothing was written */
    taut_mesh_free(empty);
    taut_mesh_free(mesh);
}

/* Lines at x = 1.5 and x = 0.75, each over both triangles. */
static taut_curves *two_lines(void) {
    taut_mesh *mesh = rectangle();
    taut_curves *curves = NULL;
    const float levels[] = {1.5f, 9, 0.75f};
    const taut_input as_floats = {.data = levels, .count = 3, .type = TAUT_TYPE_F32};
    CHECK(taut_isolines_new(mesh, values, as_floats, &curves) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return curves;
}

static void lines(void) {
    taut_curves *curves = two_lines();
    uint32_t offsets[3], faces[6], closed[2], levels[2];
    double p[18], w[18];
    CHECK(taut_curves_count(curves) == 2 && taut_curves_point_count(curves) == 6);
    CHECK(taut_curves_offsets(curves, (taut_output){.data = offsets, .count = 3}) == TAUT_STATUS_OK);
    CHECK(offsets[0] == 0 && offsets[1] == 3 && offsets[2] == 6);
    CHECK(taut_curves_levels(curves, (taut_output){.data = levels, .count = 2}) == TAUT_STATUS_OK);
    CHECK(levels[0] == 0 && levels[1] == 2);
    CHECK(taut_curves_closed(curves, (taut_output){.data = closed, .count = 2}) == TAUT_STATUS_OK);
    CHECK(closed[0] == 0 && closed[1] == 0);
    CHECK(taut_curves_positions(curves, (taut_output){.data = p, .count = 6}) == TAUT_STATUS_OK);
    CHECK(taut_curves_faces(curves, (taut_output){.data = faces, .count = 6}) == TAUT_STATUS_OK);
    CHECK(taut_curves_barycentrics(curves, (taut_output){.data = w, .count = 6}) == TAUT_STATUS_OK);
    for (size_t i = 0; i < 6; i++) {
        CHECK(p[3 * i] == (i < 3 ? 1.5 : 0.75));
        for (size_t axis = 0; axis < 3; axis++) {
            double sum = 0;
            for (size_t k = 0; k < 3; k++) sum += w[3 * i + k] * xyz[3 * corners[3 * faces[i] + k] + axis];
            CHECK(sum == p[3 * i + axis]);
        }
    }
    /* Higher ground is on the left, so the line goes down; its last point is in the last triangle too. */
    CHECK(p[1] == 4 && p[4] == 2 && p[7] == 0);
    CHECK(faces[0] == 1 && faces[1] == 0 && faces[2] == 0);
    taut_curves_free(curves);

    /* Around a peak the line is closed. */
    const double peak_xyz[] = {0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0}, height[] = {1, 0, 0, 0}, half = 0.5;
    const uint32_t sides[] = {0, 1, 2, 0, 2, 3, 0, 3, 1};
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){.data = peak_xyz, .count = 4}, (taut_input){.data = sides, .count = 3}, &mesh) ==
          TAUT_STATUS_OK);
    CHECK(taut_isolines_new(mesh, (taut_input){.data = height, .count = 4}, (taut_input){.data = &half, .count = 1},
                            &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 1 && taut_curves_point_count(curves) == 3);
    CHECK(taut_curves_closed(curves, (taut_output){.data = closed, .count = 1}) == TAUT_STATUS_OK && closed[0] == 1);
    taut_curves_free(curves);
    taut_mesh_free(mesh);
}

static void lines_that_make_no_sense(void) {
    taut_mesh *mesh = rectangle();
    taut_curves *curves = (taut_curves *)&failures; /* must be overwritten */
    const double levels[] = {1, NAN};
    const taut_input four = {.data = along_x, .count = 4};
    CHECK_FAILS(taut_isolines_new(mesh, four, (taut_input){0}, &curves), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(curves == NULL);
    CHECK_FAILS(taut_isolines_new(mesh, values, (taut_input){.data = levels, .count = 2}, &curves),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_LEVEL, 1);
    taut_input as_indices = values;
    as_indices.type = TAUT_TYPE_I64;
    CHECK_FAILS(taut_isolines_new(mesh, as_indices, values, &curves), TAUT_REASON_BAD_ARGUMENT, 0, 0);

    /* No levels: no curves, and the end of none. */
    uint32_t end = 7;
    CHECK(taut_isolines_new(mesh, values, (taut_input){0}, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 0 && taut_curves_point_count(curves) == 0);
    CHECK(taut_curves_offsets(curves, (taut_output){.data = &end, .count = 1}) == TAUT_STATUS_OK && end == 0);
    CHECK(taut_curves_positions(curves, (taut_output){0}) == TAUT_STATUS_OK);
    taut_curves_free(curves);
    taut_mesh_free(mesh);
}

static void curves_fill_views_whole_or_not_at_all(void) {
    enum { GAP = 29 };
    taut_curves *curves = two_lines();
    unsigned char bytes[1 + 6 * GAP];
    memset(bytes, 0xab, sizeof bytes);
    const taut_output strided = {.data = bytes + 1, .count = 6, .stride = GAP, .type = TAUT_TYPE_F32};
    CHECK(taut_curves_positions(curves, strided) == TAUT_STATUS_OK);
    for (size_t i = 0; i < 6; i++) {
        float x;
        memcpy(&x, bytes + 1 + i * GAP, sizeof x);
        CHECK(x == (i < 3 ? 1.5f : 0.75f));
        for (size_t gap = 3 * sizeof x; gap < GAP; gap++) CHECK(bytes[1 + i * GAP + gap] == 0xab);
    }

    double p[18];
    int64_t few[7];
    for (size_t i = 0; i < 18; i++) p[i] = -1;
    for (size_t i = 0; i < 7; i++) few[i] = -1;
    const taut_output five = {.data = p, .count = 5}, five_indices = {.data = few, .count = 5, .type = TAUT_TYPE_I64};
    const taut_output two = {.data = few, .count = 2, .type = TAUT_TYPE_I64}, one = {.data = few, .count = 1};
    CHECK_FAILS(taut_curves_positions(curves, five), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_barycentrics(curves, five), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_faces(curves, five_indices), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_offsets(curves, two), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_closed(curves, one), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_levels(curves, one), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_positions(curves, (taut_output){.data = p, .count = 6, .stride = 23}),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    for (size_t i = 0; i < 18; i++) CHECK(p[i] == -1);
    for (size_t i = 0; i < 7; i++) CHECK(few[i] == -1);
    CHECK(taut_curves_levels(curves, two) == TAUT_STATUS_OK && few[0] == 0 && few[1] == 2 && few[2] == -1);
    taut_curves_free(curves);
}

static taut_closest *closest_rectangle(void) {
    taut_mesh *mesh = rectangle();
    taut_closest *closest = NULL;
    CHECK(taut_closest_new(mesh, &closest) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return closest;
}

static void closest_points(void) {
    taut_closest *closest = closest_rectangle();
    /* Above the inside, above the diagonal, beside a side, beyond a corner. */
    const float points[] = {1, 1, 2, 1.5f, 2, -1, 5, 3, 0, -3, -4, 0};
    uint16_t faces[4];
    double w[12], d[4];
    CHECK(taut_closest_points(closest, (taut_input){.data = points, .count = 4, .type = TAUT_TYPE_F32}, NULL,
                              (taut_output){.data = faces, .count = 4, .type = TAUT_TYPE_U16},
                              (taut_output){.data = w, .count = 4},
                              (taut_output){.data = d, .count = 4}) == TAUT_STATUS_OK);
    CHECK(faces[0] == 0 && faces[1] == 0 && faces[2] == 1 && faces[3] == 0);
    CHECK(d[0] == 2 && d[1] == 1 && d[2] == 2 && d[3] == 5);
    CHECK(fabs(w[0] - 5.0 / 12) < 1e-15 && fabs(w[1] - 1.0 / 3) < 1e-15 && fabs(w[2] - 0.25) < 1e-15);
    CHECK(w[3] == 0 && w[4] == 0.5 && w[5] == 0.5);
    CHECK(w[6] == 0.25 && w[7] == 0.75 && w[8] == 0);
    CHECK(w[9] == 1 && w[10] == 0 && w[11] == 0);
    CHECK(taut_closest_points(closest, (taut_input){0}, NULL, (taut_output){0}, (taut_output){0}, (taut_output){0}) ==
          TAUT_STATUS_OK);
    taut_closest_free(closest);

    taut_mesh *empty = NULL;
    CHECK(taut_mesh_new((taut_input){0}, (taut_input){0}, &empty) == TAUT_STATUS_OK);
    closest = (taut_closest *)&failures; /* must be overwritten */
    CHECK_FAILS(taut_closest_new(empty, &closest), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(closest == NULL);
    taut_mesh_free(empty);
}

static void closest_points_fill_all_views_or_none(void) {
    taut_closest *closest = closest_rectangle();
    double points[] = {1, 1, 2, 5, 3, 0}, w[6], d[2];
    uint32_t f[2] = {77, 77};
    for (size_t i = 0; i < 6; i++) w[i] = -1;
    for (size_t i = 0; i < 2; i++) d[i] = -1;
    const taut_input from = {.data = points, .count = 2};
    const taut_output faces = {.data = f, .count = 2}, weights = {.data = w, .count = 2}, far = {.data = d, .count = 2};
    taut_output bad = faces;
    bad.count = 1;
    CHECK_FAILS(taut_closest_points(closest, from, NULL, bad, weights, far), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    bad = weights;
    bad.count = 1;
    CHECK_FAILS(taut_closest_points(closest, from, NULL, faces, bad, far), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "barycentrics") != NULL);
    bad = far;
    bad.type = TAUT_TYPE_U32;
    CHECK_FAILS(taut_closest_points(closest, from, NULL, faces, weights, bad), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "distances") != NULL);
    points[5] = NAN;
    CHECK_FAILS(taut_closest_points(closest, from, NULL, faces, weights, far), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_POINT,
                1);
    CHECK(f[0] == 77 && f[1] == 77 && d[0] == -1 && d[1] == -1);
    for (size_t i = 0; i < 6; i++) CHECK(w[i] == -1);
    taut_closest_free(closest);
}

/* Views without gaps. */
static taut_input scalars(const double *data, size_t count) { return (taut_input){.data = data, .count = count}; }

static taut_input indices(const uint32_t *data, size_t count) { return (taut_input){.data = data, .count = count}; }

static taut_input typed_input(const void *data, size_t count, taut_type type) {
    return (taut_input){.data = data, .count = count, .type = type};
}

static taut_output room(double *data, size_t count) { return (taut_output){.data = data, .count = count}; }

static taut_output typed(void *data, size_t count, taut_type type) {
    return (taut_output){.data = data, .count = count, .type = type};
}

static taut_exact_field *field_with(const taut_sources *sources, const taut_exact_options *options) {
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    CHECK(taut_exact_field_new(exact, sources, options, NULL, &field) == TAUT_STATUS_OK);
    taut_exact_free(exact); /* before the use of what was made from it */
    return field;
}

static const taut_exact_options keeping = {.struct_size = sizeof keeping, .keep_windows = 1};

/* At (0.75, 1) in the first triangle: 1.25 from vertex 0 and 3.75 from vertex 2. */
static const uint32_t face_zero = 0;
static const double inside[] = {0.5, 0.25, 0.25};

static void sources_in_triangles(void) {
    taut_exact *exact = exact_rectangle();
    double d[5];
    taut_sources from = {.struct_size = sizeof from, .faces = indices(&face_zero, 1), .barycentrics = scalars(inside, 1)};
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK);
    CHECK(d[0] == 1.25 && fabs(d[2] - 3.75) < 1e-15 && d[4] == INFINITY);

    /* Vertices come first: the point is source 1, and the second offset is its own. */
    const uint32_t three = 3;
    const double offsets[] = {0, -1};
    from.vertices = indices(&three, 1);
    from.offsets = scalars(offsets, 2);
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK);
    CHECK(d[0] == 0.25 && fabs(d[2] - 2.75) < 1e-15 && d[3] == 0);

    for (size_t v = 0; v < 5; v++) d[v] = -1;
    from.offsets.count = 1;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    from.offsets.count = 0;
    from.barycentrics.count = 0;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "sources.barycentrics") != NULL);
    const uint32_t beyond = 2;
    const int64_t negative = -1;
    const double heavy[] = {1, 1, 0}, below[] = {1.5, -0.5, 0}, no_number[] = {NAN, 0.5, 0.5};
    const double *bad[] = {heavy, below, no_number};
    for (size_t i = 0; i < 3; i++) {
        from.barycentrics = scalars(bad[i], 1);
        CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    }
    from.barycentrics = scalars(inside, 1);
    from.faces = indices(&beyond, 1);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    from.faces = (taut_input){.data = &negative, .count = 1, .type = TAUT_TYPE_I64};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    for (size_t v = 0; v < 5; v++) CHECK(d[v] == -1);

    /* An older caller, whose struct ends before the points. */
    from.struct_size = offsetof(taut_sources, faces);
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK && d[3] == 0 && d[0] == 4);
    taut_exact_free(exact);

    /* The heat method takes the same places. */
    taut_mesh *mesh = rectangle();
    taut_heat *heat = NULL;
    const double at_corner[] = {0, 0, 1};
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    from = (taut_sources){.struct_size = sizeof from, .faces = indices(&face_zero, 1), .barycentrics = scalars(inside, 1)};
    CHECK(heat_distances(heat, &from, d) == TAUT_STATUS_OK && d[0] > 0 && d[2] > 0 && d[4] == INFINITY);
    from.barycentrics = scalars(at_corner, 1);
    CHECK(heat_distances(heat, &from, d) == TAUT_STATUS_OK && d[3] == 0 && d[0] > 0);
    from.faces = indices(&beyond, 1);
    CHECK_FAILS(heat_distances(heat, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 0);
    taut_heat_free(heat);
    taut_mesh_free(mesh);
}

/* Isolines and paths are sources as they come. */
static void sources_along_curves(void) {
    taut_exact *exact = exact_rectangle();
    taut_curves *curves = two_lines(); /* at x = 1.5 and at x = 0.75 */
    uint32_t offsets[3], faces[6], closed[2];
    double w[18], d[5];
    CHECK(taut_curves_offsets(curves, (taut_output){.data = offsets, .count = 3}) == TAUT_STATUS_OK);
    CHECK(taut_curves_faces(curves, (taut_output){.data = faces, .count = 6}) == TAUT_STATUS_OK);
    CHECK(taut_curves_barycentrics(curves, room(w, 6)) == TAUT_STATUS_OK);
    CHECK(taut_curves_closed(curves, (taut_output){.data = closed, .count = 2}) == TAUT_STATUS_OK);
    taut_curves_free(curves);
    taut_sources from = {.struct_size = sizeof from,
                         .curve_offsets = indices(offsets, 3),
                         .curve_faces = indices(faces, 6),
                         .curve_barycentrics = scalars(w, 6),
                         .curve_closed = indices(closed, 2)};
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK);
    CHECK(d[0] == 0.75 && d[1] == 1.5 && d[2] == 1.5 && d[3] == 0.75 && d[4] == INFINITY);
    int32_t nearest[5];
    taut_exact_field *field = field_with(&from, NULL);
    const taut_output numbers = {.data = nearest, .count = 5, .type = TAUT_TYPE_I32};
    CHECK(taut_exact_field_nearest_sources(field, NULL, numbers) == TAUT_STATUS_OK);
    CHECK(nearest[0] == 1 && nearest[1] == 0 && nearest[2] == 0 && nearest[3] == 1 && nearest[4] == -1);
    taut_exact_field_free(field);

    /* The path of vertex 1 goes straight to the line. */
    const uint32_t one = 1;
    double ends[6];
    field = field_with(&from, NULL);
    const taut_targets to_one = {.struct_size = sizeof to_one, .vertices = indices(&one, 1)};
    CHECK(taut_exact_field_paths(field, &to_one, NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_point_count(curves) == 2 && taut_curves_positions(curves, room(ends, 2)) == TAUT_STATUS_OK);
    CHECK(ends[0] == 3 && ends[1] == 0 && ends[3] == 1.5 && ends[4] == 0);
    taut_curves_free(curves);
    taut_exact_field_free(field);

    /* Curves come last, and are open where nothing is said. */
    const uint32_t two = 2;
    const double starts[] = {0, 0, -1};
    from.vertices = indices(&two, 1);
    from.offsets = scalars(starts, 3);
    from.curve_closed.count = 0;
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK);
    CHECK(d[0] == -0.25 && d[1] == 1.25 && d[2] == 0 && d[3] == -0.25);

    for (size_t v = 0; v < 5; v++) d[v] = -1;
    const uint32_t around[] = {1, 0}, no_flag[] = {0, 2};
    from.curve_closed = indices(around, 2);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    from.curve_closed = indices(no_flag, 2);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 2);
    from.curve_closed.count = 1;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    from.curve_closed.count = 0;
    const uint32_t late[] = {1, 3, 6}, early[] = {0, 3, 5}, empty[] = {0, 0, 6}, back[] = {0, 7, 6};
    from.curve_offsets = indices(late, 3);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    from.curve_offsets = indices(early, 3);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    from.curve_offsets = indices(empty, 3);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    from.curve_offsets = indices(back, 3);
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    from.curve_offsets.count = 0;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    from.curve_offsets = indices(offsets, 3);
    const int64_t negative[] = {1, 0, 0, 0, -1, 0};
    from.curve_faces = (taut_input){.data = negative, .count = 6, .type = TAUT_TYPE_I64};
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 2);
    from.curve_faces = indices(faces, 6);
    w[5] = NAN;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_SOURCE, 1);
    from.curve_barycentrics.count = 5;
    CHECK_FAILS(field_of(exact, &from, d), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "sources.curve_barycentrics") != NULL);
    for (size_t v = 0; v < 5; v++) CHECK(d[v] == -1);

    /* An older caller, whose struct ends before the curves. */
    from.struct_size = offsetof(taut_sources, curve_offsets);
    from.offsets.count = 0;
    CHECK(field_of(exact, &from, d) == TAUT_STATUS_OK && d[2] == 0 && d[0] == 5);
    taut_exact_free(exact);
}

static void nearest_sources(void) {
    const uint32_t ends[] = {3, 1};
    const taut_sources from = {.struct_size = sizeof from, .vertices = indices(ends, 2)};
    taut_exact_field *field = field_with(&from, NULL);
    uint16_t u16[5];
    uint32_t u32[5];
    uint64_t u64[5];
    int32_t i32[5];
    int64_t i64[5];
    CHECK(taut_exact_field_nearest_sources(field, NULL, typed(u16, 5, TAUT_TYPE_U16)) == 0);
    CHECK(taut_exact_field_nearest_sources(field, NULL, (taut_output){.data = u32, .count = 5}) == 0);
    CHECK(taut_exact_field_nearest_sources(field, NULL, typed(u64, 5, TAUT_TYPE_U64)) == 0);
    CHECK(taut_exact_field_nearest_sources(field, NULL, typed(i32, 5, TAUT_TYPE_I32)) == 0);
    CHECK(taut_exact_field_nearest_sources(field, NULL, typed(i64, 5, TAUT_TYPE_I64)) == 0);
    const int expected[] = {1, 1, 0, 0};
    for (size_t v = 0; v < 4; v++) {
        CHECK(u16[v] == expected[v] && u32[v] == u16[v] && u64[v] == u16[v] && i32[v] == u16[v] && i64[v] == u16[v]);
    }
    CHECK(u16[4] == UINT16_MAX && u32[4] == UINT32_MAX && u64[4] == UINT64_MAX && i32[4] == -1 && i64[4] == -1);
    u32[0] = 77;
    CHECK_FAILS(taut_exact_field_nearest_sources(field, NULL, (taut_output){.data = u32, .count = 4}),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK(u32[0] == 77);
    taut_exact_field_free(field);

    /* The last of so many that in 16 bits its number would look like none. */
    enum { MANY = UINT16_MAX + 1 };
    uint32_t *same = calloc(MANY, sizeof *same);
    double *offsets = calloc(MANY, sizeof *offsets);
    offsets[MANY - 1] = -1;
    const taut_sources many = {
        .struct_size = sizeof many, .vertices = indices(same, MANY), .offsets = scalars(offsets, MANY)};
    field = field_with(&many, NULL);
    u16[0] = 77;
    CHECK_FAILS(taut_exact_field_nearest_sources(field, NULL, typed(u16, 5, TAUT_TYPE_U16)),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(u16[0] == 77);
    CHECK(taut_exact_field_nearest_sources(field, NULL, typed(i32, 5, TAUT_TYPE_I32)) == 0);
    CHECK(i32[0] == MANY - 1 && i32[2] == MANY - 1 && i32[4] == -1);
    taut_exact_field_free(field);
    free(same);
    free(offsets);
}

/* At vertex 2, and at (2.25, 3): both in the second triangle. */
static const uint32_t two_faces[] = {1, 1};
static const double two_weights[] = {0, 1, 0, 0.25, 0.5, 0.25};

static void points_of_a_field(void) {
    const uint32_t ends[] = {4, 0};
    const taut_sources from = {.struct_size = sizeof from, .vertices = indices(ends, 2)};
    const taut_input faces = indices(two_faces, 2), weights = scalars(two_weights, 2);
    const taut_targets *both = POINTS(faces, weights);
    taut_exact_field *field = field_with(&from, &keeping);
    double d[2] = {-1, -1};
    int32_t nearest[2] = {77, 77};
    const taut_output out = room(d, 2), numbers = {.data = nearest, .count = 2, .type = TAUT_TYPE_I32};
    CHECK(taut_exact_field_distances(field, both, out) == TAUT_STATUS_OK);
    CHECK(d[0] == 5 && fabs(d[1] - 3.75) < 1e-15);
    CHECK(taut_exact_field_nearest_sources(field, both, numbers) == TAUT_STATUS_OK);
    CHECK(nearest[0] == 1 && nearest[1] == 1);
    CHECK(taut_exact_field_distances(field, VERTICES((taut_input){0}), (taut_output){0}) == TAUT_STATUS_OK);

    /* Any packing: a face of 16 bits beside its weights as floats. */
    struct {
        uint16_t face;
        float weights[3];
    } packed = {1, {0.25f, 0.5f, 0.25f}};
    float single = -1;
    const taut_targets to = {
        .struct_size = sizeof to,
        .faces = {.data = &packed.face, .count = 1, .stride = sizeof packed, .type = TAUT_TYPE_U16},
        .barycentrics = {.data = packed.weights, .count = 1, .stride = sizeof packed, .type = TAUT_TYPE_F32}};
    CHECK(taut_exact_field_distances(field, &to, (taut_output){.data = &single, .count = 1, .type = TAUT_TYPE_F32}) ==
          TAUT_STATUS_OK);
    CHECK(single == 3.75f);

    /* Vertices come first. */
    double mixed[4];
    int32_t mixed_nearest[4];
    const uint32_t vertices[] = {3, 4};
    const taut_targets all = {
        .struct_size = sizeof all, .vertices = indices(vertices, 2), .faces = faces, .barycentrics = weights};
    CHECK(taut_exact_field_distances(field, &all, room(mixed, 4)) == TAUT_STATUS_OK);
    CHECK(mixed[0] == 4 && mixed[1] == 0 && mixed[2] == 5 && fabs(mixed[3] - 3.75) < 1e-15);
    CHECK(taut_exact_field_nearest_sources(
              field, &all, typed(mixed_nearest, 4, TAUT_TYPE_I32)) == TAUT_STATUS_OK);
    CHECK(mixed_nearest[0] == 1 && mixed_nearest[1] == 0 && mixed_nearest[2] == 1 && mixed_nearest[3] == 1);

    /* All or nothing. */
    const uint32_t beyond[] = {1, 2};
    const uint64_t far_beyond[] = {1, UINT64_C(1) << 32};
    const double heavy[] = {0, 1, 0, 1, 1, 1};
    const taut_input wide = {.data = far_beyond, .count = 2, .type = TAUT_TYPE_U64};
    d[0] = d[1] = -1;
    nearest[0] = nearest[1] = 77;
    CHECK_FAILS(taut_exact_field_distances(field, POINTS(indices(beyond, 2), weights), out), TAUT_REASON_BAD_ARGUMENT,
                TAUT_ELEMENT_TARGET, 1);
    CHECK_FAILS(taut_exact_field_distances(field, POINTS(wide, weights), out), TAUT_REASON_BAD_ARGUMENT,
                TAUT_ELEMENT_TARGET, 1);
    CHECK_FAILS(taut_exact_field_nearest_sources(field, POINTS(faces, scalars(heavy, 2)), numbers),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_TARGET, 1);
    CHECK_FAILS(taut_exact_field_distances(field, POINTS(faces, scalars(two_weights, 1)), out), TAUT_REASON_BAD_ARGUMENT,
                0, 0);
    CHECK_FAILS(taut_exact_field_distances(field, POINTS(faces, (taut_input){.count = 2}), out), TAUT_REASON_NULL_POINTER,
                0, 0);
    CHECK(strstr(taut_last_error(NULL), "`targets.barycentrics.data`") != NULL);
    CHECK_FAILS(taut_exact_field_distances(field, both, room(d, 1)), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_exact_field_nearest_sources(field, both, (taut_output){.data = nearest, .count = 1}),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    taut_exact_field_free(field);

    /* Without windows it knows vertices only; so for an older caller. */
    taut_exact_options older = keeping;
    older.struct_size = offsetof(taut_exact_options, keep_windows);
    field = field_with(&from, &older);
    CHECK_FAILS(taut_exact_field_distances(field, both, out), TAUT_REASON_BAD_ARGUMENT,
                TAUT_ELEMENT_TARGET, 1);
    CHECK_FAILS(taut_exact_field_nearest_sources(field, both, numbers), TAUT_REASON_BAD_ARGUMENT,
                TAUT_ELEMENT_TARGET, 1);
    CHECK(d[0] == -1 && d[1] == -1 && nearest[0] == 77 && nearest[1] == 77);
    CHECK(taut_exact_field_distances(field, POINTS(indices(two_faces, 1), scalars(two_weights, 1)), out) == 0);
    CHECK(d[0] == 5 && d[1] == -1);
    taut_exact_field_free(field);
}

/* Copies out what the curves have, at most four curves of six points together. */
typedef struct {
    uint32_t offsets[5], faces[6], closed[4], levels[4];
    double positions[18];
} drawing;

static drawing drawn(taut_curves *curves) {
    drawing it;
    memset(&it, 0xff, sizeof it);
    CHECK(taut_curves_offsets(curves, (taut_output){.data = it.offsets, .count = 5}) == TAUT_STATUS_OK);
    CHECK(taut_curves_faces(curves, (taut_output){.data = it.faces, .count = 6}) == TAUT_STATUS_OK);
    CHECK(taut_curves_closed(curves, (taut_output){.data = it.closed, .count = 4}) == TAUT_STATUS_OK);
    CHECK(taut_curves_levels(curves, (taut_output){.data = it.levels, .count = 4}) == TAUT_STATUS_OK);
    CHECK(taut_curves_positions(curves, room(it.positions, 6)) == TAUT_STATUS_OK);
    taut_curves_free(curves);
    return it;
}

static bool is_at(const double *position, double x, double y) {
    return fabs(position[0] - x) < 1e-15 && fabs(position[1] - y) < 1e-15 && position[2] == 0;
}

static void paths(void) {
    taut_exact_field *field = field_with(&from_zero, &keeping);
    /* Over the diagonal; from the source itself; from where no path leads; along a side. */
    const uint32_t targets[] = {2, 0, 4, 1}, beyond[] = {0, 5};
    const int32_t negative[] = {0, -1};
    taut_curves *curves = NULL;
    CHECK(taut_exact_field_paths(field, VERTICES(indices(targets, 4)), NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 4 && taut_curves_point_count(curves) == 6);
    drawing it = drawn(curves);
    CHECK(it.offsets[0] == 0 && it.offsets[1] == 3 && it.offsets[2] == 4 && it.offsets[3] == 4 && it.offsets[4] == 6);
    for (uint32_t i = 0; i < 4; i++) CHECK(it.closed[i] == 0 && it.levels[i] == i);
    CHECK(is_at(it.positions, 3, 4) && is_at(it.positions + 3, 1.5, 2) && is_at(it.positions + 6, 0, 0));
    CHECK(it.faces[0] == 1 && it.faces[1] == 0 && it.faces[2] == 0);
    CHECK(is_at(it.positions + 9, 0, 0));
    CHECK(is_at(it.positions + 12, 3, 0) && is_at(it.positions + 15, 0, 0));

    CHECK(taut_exact_field_paths(field, POINTS(indices(two_faces, 2), scalars(two_weights, 2)), NULL, &curves) ==
          TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 2 && taut_curves_point_count(curves) == 6);
    it = drawn(curves);
    CHECK(it.offsets[1] == 3 && it.offsets[2] == 6);
    CHECK(is_at(it.positions, 3, 4));
    CHECK(is_at(it.positions + 9, 2.25, 3) && is_at(it.positions + 12, 1.5, 2) && is_at(it.positions + 15, 0, 0));

    curves = (taut_curves *)&failures; /* must be overwritten */
    CHECK_FAILS(taut_exact_field_paths(field, VERTICES(indices(beyond, 2)), NULL, &curves),
                TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_TARGET, 1);
    CHECK(curves == NULL);
    const taut_input signed_targets = {.data = negative, .count = 2, .type = TAUT_TYPE_I32};
    CHECK_FAILS(taut_exact_field_paths(field, VERTICES(signed_targets), NULL, &curves), TAUT_REASON_VERTEX_OUT_OF_RANGE,
                TAUT_ELEMENT_TARGET, 1);
    CHECK_FAILS(taut_exact_field_paths(field, VERTICES(indices(targets, 4)), NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    curves = (taut_curves *)&failures;
    CHECK_FAILS(taut_exact_field_paths(field, POINTS(indices(beyond, 2), scalars(two_weights, 2)), NULL, &curves),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_TARGET, 1);
    CHECK(curves == NULL);
    taut_exact_field_free(field);

    /* Beyond the final radius nothing is known. */
    taut_exact_options near = keeping;
    near.radius = 4;
    field = field_with(&from_zero, &near);
    double d[2];
    uint32_t nearest[5];
    CHECK(taut_exact_field_paths(field, VERTICES(indices(targets, 4)), NULL, &curves) == TAUT_STATUS_OK);
    it = drawn(curves);
    CHECK(it.offsets[1] == 0 && it.offsets[2] == 1 && it.offsets[3] == 1 && it.offsets[4] == 3);
    CHECK(taut_exact_field_distances(field, POINTS(indices(two_faces, 2), scalars(two_weights, 2)), room(d, 2)) == 0);
    CHECK(d[0] == INFINITY && fabs(d[1] - 3.75) < 1e-15);
    CHECK(taut_exact_field_nearest_sources(field, NULL, (taut_output){.data = nearest, .count = 5}) == TAUT_STATUS_OK);
    CHECK(nearest[0] == 0 && nearest[2] == UINT32_MAX && nearest[3] == 0);
    taut_exact_field_free(field);
}

static void paths_of_descent(void) {
    taut_mesh *mesh = rectangle();
    /* Along the upper side; from where nothing is lower; from a vertex of no triangle; along the lower side. */
    const uint32_t targets[] = {2, 0, 4, 1}, beyond[] = {0, 5};
    taut_curves *curves = NULL;
    CHECK(taut_descent_paths_new(mesh, values, NULL, VERTICES(indices(targets, 4)), NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 4 && taut_curves_point_count(curves) == 5);
    drawing it = drawn(curves);
    CHECK(it.offsets[0] == 0 && it.offsets[1] == 2 && it.offsets[2] == 3 && it.offsets[3] == 3 && it.offsets[4] == 5);
    for (uint32_t i = 0; i < 4; i++) CHECK(it.closed[i] == 0 && it.levels[i] == i);
    CHECK(is_at(it.positions, 3, 4) && is_at(it.positions + 3, 0, 4) && it.faces[0] == 1 && it.faces[1] == 1);
    CHECK(is_at(it.positions + 6, 0, 0) && is_at(it.positions + 9, 3, 0) && is_at(it.positions + 12, 0, 0));

    /* All vertices; four of them have paths. */
    CHECK(taut_descent_paths_new(mesh, values, NULL, NULL, NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 5 && taut_curves_point_count(curves) == 6);
    taut_curves_free(curves);

    /* Down the distances from the middle of the lower triangle, which is no vertex: straight on where it is known. */
    const double middle[] = {0.5, 0.25, 0.25};
    const double from_middle[] = {1.25, 2.462214450449026, 3.75, 3.092329219213245, INFINITY};
    const taut_input distances = {.data = from_middle, .count = 5};
    const taut_sources source = {
        .struct_size = sizeof source, .faces = indices(&zero, 1), .barycentrics = scalars(middle, 1)};
    CHECK(taut_descent_paths_new(mesh, distances, &source, VERTICES(indices(targets, 1)), NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_point_count(curves) == 3);
    it = drawn(curves);
    CHECK(is_at(it.positions, 3, 4) && is_at(it.positions + 6, 0.75, 1) && it.faces[2] == 0);
    CHECK(taut_descent_paths_new(mesh, distances, NULL, VERTICES(indices(targets, 1)), NULL, &curves) == TAUT_STATUS_OK);
    it = drawn(curves);
    CHECK(it.offsets[1] > 1 && is_at(it.positions + 3 * (it.offsets[1] - 1), 0, 0));

    curves = (taut_curves *)&failures; /* must be overwritten */
    const taut_input four = {.data = along_x, .count = 4};
    CHECK_FAILS(taut_descent_paths_new(mesh, four, NULL, NULL, NULL, &curves), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(curves == NULL);
    CHECK_FAILS(taut_descent_paths_new(mesh, values, NULL, VERTICES(indices(beyond, 2)), NULL, &curves),
                TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_TARGET, 1);
    const taut_sources outside = {.struct_size = sizeof outside, .vertices = indices(beyond, 2)};
    CHECK_FAILS(taut_descent_paths_new(mesh, values, &outside, NULL, NULL, &curves), TAUT_REASON_VERTEX_OUT_OF_RANGE,
                TAUT_ELEMENT_SOURCE, 1);
    taut_mesh_free(mesh);
}

/* Every vertex in one call; and ends before one of them when a callback says so. */
static void all_paths(void) {
    taut_exact_field *field = field_with(&from_zero, NULL);
    taut_curves *curves = NULL;
    taut_control *control = NULL;
    uint32_t offsets[6];
    CHECK(taut_exact_field_paths(field, NULL, NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 5 && taut_curves_offsets(curves, (taut_output){.data = offsets, .count = 6}) == 0);
    CHECK(offsets[1] == 1 && offsets[2] == 3 && offsets[3] == 6 && offsets[4] == 8 && offsets[5] == 8);
    taut_curves_free(curves);

    witness seen = {.cancel_at = 3};
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    CHECK(taut_control_set_callback(control, watch, &seen) == TAUT_STATUS_OK);
    curves = (taut_curves *)&failures; /* must be overwritten */
    CHECK_FAILS(taut_exact_field_paths(field, NULL, control, &curves), TAUT_REASON_CANCELLED, 0, 0);
    CHECK(curves == NULL && seen.calls == 3 && seen.progress == 2 / 5.0 && pthread_equal(seen.thread, pthread_self()));
    taut_control_free(control);

    seen = (witness){0};
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    CHECK(taut_control_set_callback(control, watch, &seen) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_paths(field, NULL, control, &curves) == TAUT_STATUS_OK);
    CHECK(seen.calls == 6 && seen.progress == 1);
    taut_curves_free(curves);
    taut_control_free(control);
    taut_exact_field_free(field);
}

/* The manual's example: what is nearest to two clicks is a source and a target as it stands. */
static void from_click_to_click(void) {
    taut_closest *closest = closest_rectangle();
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    taut_curves *path = NULL;
    const double clicks[] = {0.75, 1, 9, 2.25, 3, -9};
    uint32_t faces[2];
    double weights[6], off[2];
    taut_status status = taut_closest_points(closest, scalars(clicks, 2), NULL, (taut_output){.data = faces, .count = 2},
                                             room(weights, 2), room(off, 2));
    const taut_sources click = {
        .struct_size = sizeof click, .faces = indices(faces, 1), .barycentrics = scalars(weights, 1)};
    if (!status) status = taut_exact_field_new(exact, &click, &keeping, NULL, &field);
    const taut_targets *to = POINTS(indices(faces + 1, 1), scalars(weights + 3, 1));
    if (!status) status = taut_exact_field_paths(field, to, NULL, &path);
    CHECK(status == TAUT_STATUS_OK && off[0] == 9 && off[1] == 9);
    CHECK(taut_curves_point_count(path) == 3);
    const drawing it = drawn(path);
    CHECK(is_at(it.positions, 2.25, 3) && is_at(it.positions + 3, 1.5, 2) && is_at(it.positions + 6, 0.75, 1));
    taut_exact_field_free(field);
    taut_exact_free(exact);
    taut_closest_free(closest);
}

/* From vertex 0, from (0.75, 1) with a start distance, and from the vertex that no triangle uses. */
static const uint32_t row_vertices[] = {0, 4};
static const double row_offsets[] = {0, 0, 0.5};

static taut_sources row_sources(void) {
    return (taut_sources){.struct_size = sizeof(taut_sources),
                          .vertices = indices(row_vertices, 2),
                          .offsets = scalars(row_offsets, 3),
                          .faces = indices(&face_zero, 1),
                          .barycentrics = scalars(inside, 1)};
}

static void distance_rows(void) {
    enum { GAP = 7 };
    taut_exact *exact = exact_rectangle();
    const taut_sources from = row_sources();
    double d[4 * 5], expected[3 * 5];
    const uint32_t face = 0;
    const taut_sources alone[] = {
        from_zero,
        {.struct_size = sizeof alone[0], .vertices = indices(row_vertices + 1, 1)},
        {.struct_size = sizeof alone[0],
         .offsets = scalars(row_offsets + 2, 1),
         .faces = indices(&face, 1),
         .barycentrics = scalars(inside, 1)}};
    for (size_t i = 0; i < 3; i++) CHECK(field_of(exact, alone + i, expected + 5 * i) == TAUT_STATUS_OK);

    const size_t threads[] = {0, 1, 2, 8, SIZE_MAX};
    for (size_t t = 0; t < 5; t++) {
        for (size_t i = 0; i < 20; i++) d[i] = -1;
        CHECK(taut_exact_distance_rows(exact, &from, each, threads[t], NULL, room(d, 4)) == TAUT_STATUS_OK);
        CHECK(memcmp(d, expected, sizeof expected) == 0);
        for (size_t v = 15; v < 20; v++) CHECK(d[v] == -1);
    }

    /* Rows of floats with a gap, off alignment. */
    unsigned char bytes[1 + 3 * (5 * sizeof(float) + GAP)];
    memset(bytes, 0xab, sizeof bytes);
    const size_t stride = 5 * sizeof(float) + GAP;
    const taut_output packed = {.data = bytes + 1, .count = 3, .stride = stride, .type = TAUT_TYPE_F32};
    CHECK(taut_exact_distance_rows(exact, &from, each, 1, NULL, packed) == TAUT_STATUS_OK);
    CHECK(bytes[0] == 0xab);
    for (size_t i = 0; i < 3; i++) {
        for (size_t v = 0; v < 5; v++) {
            float single;
            memcpy(&single, bytes + 1 + i * stride + v * sizeof single, sizeof single);
            CHECK(single == (float)expected[5 * i + v]);
        }
        for (size_t gap = 5 * sizeof(float); gap < stride; gap++) CHECK(bytes[1 + i * stride + gap] == 0xab);
    }

    /* No source has no rows. */
    const taut_sources none = {.struct_size = sizeof none};
    CHECK(taut_exact_distance_rows(exact, &none, each, 8, NULL, (taut_output){0}) == TAUT_STATUS_OK);
    taut_exact_free(exact);
}

static void distance_rows_all_or_none(void) {
    taut_exact *exact = exact_rectangle();
    taut_sources from = row_sources();
    double d[15];
    for (size_t i = 0; i < 15; i++) d[i] = -1;
    taut_output out = room(d, 3);
    CHECK_FAILS(taut_exact_distance_rows(NULL, &from, each, 1, NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_distance_rows(exact, NULL, each, 1, NULL, out), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, (taut_output){.count = 3}), TAUT_REASON_NULL_POINTER, 0,
                0);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, room(d, 2)), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, (taut_output){0}), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    out.stride = 4 * sizeof *d; /* a row has five */
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, out), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    out = typed(d, 3, TAUT_TYPE_I32);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, out), TAUT_REASON_BAD_ARGUMENT, 0, 0);

    /* More bytes than can be counted, or than there can be. */
    const size_t huge[] = {SIZE_MAX, SIZE_MAX / 8 / 5 + 1, PTRDIFF_MAX / 8 / 5 + 1};
    for (size_t i = 0; i < 3; i++) {
        CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, room(d, huge[i])), TAUT_REASON_TOO_MANY_ELEMENTS, 0,
                    0);
    }
    out = room(d, 3);
    out.stride = SIZE_MAX;
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 1, NULL, out), TAUT_REASON_TOO_MANY_ELEMENTS, 0, 0);

    const uint32_t beyond[] = {0, 5};
    from.vertices = indices(beyond, 2);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 2, NULL, room(d, 3)), TAUT_REASON_VERTEX_OUT_OF_RANGE,
                TAUT_ELEMENT_SOURCE, 1);
    from = row_sources();
    const double bad_offsets[] = {0, 0, NAN};
    from.offsets = scalars(bad_offsets, 3);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 2, NULL, room(d, 3)), TAUT_REASON_BAD_ARGUMENT,
                TAUT_ELEMENT_SOURCE, 2);
    for (size_t i = 0; i < 15; i++) CHECK(d[i] == -1);
    taut_exact_free(exact);
}

static void distances_within(void) {
    taut_exact *exact = exact_rectangle();
    taut_sparse_distances *sparse = NULL;
    const taut_sources from = row_sources();
    CHECK(taut_exact_distances_within(exact, &from, 4, 8, NULL, &sparse) == TAUT_STATUS_OK);
    taut_exact_free(exact); /* before the use of what was made from it */
    CHECK(taut_sparse_distances_row_count(sparse) == 3 && taut_sparse_distances_count(sparse) == 7);

    uint64_t offsets[4];
    uint16_t vertices[7];
    double d[7];
    const taut_output to_offsets = {.data = offsets, .count = 4, .type = TAUT_TYPE_U64};
    const taut_output to_vertices = {.data = vertices, .count = 7, .type = TAUT_TYPE_U16};
    CHECK(taut_sparse_distances_offsets(sparse, to_offsets) == TAUT_STATUS_OK);
    CHECK(taut_sparse_distances_vertices(sparse, to_vertices) == TAUT_STATUS_OK);
    CHECK(taut_sparse_distances_values(sparse, room(d, 7)) == TAUT_STATUS_OK);
    CHECK(offsets[0] == 0 && offsets[1] == 3 && offsets[2] == 4 && offsets[3] == 7);
    const uint16_t expected[] = {0, 1, 3, 4, 0, 1, 3};
    CHECK(memcmp(vertices, expected, sizeof expected) == 0);
    /* The farthest corner is 3.75 and the start distance 0.5 from the point. */
    CHECK(d[0] == 0 && d[1] == 3 && d[2] == 4 && d[3] == 0 && d[4] == 1.75 && d[5] < 4 && d[6] < 4);

    memset(offsets, 0xff, sizeof offsets);
    memset(vertices, 0xff, sizeof vertices);
    d[0] = -1;
    CHECK_FAILS(taut_sparse_distances_offsets(sparse, typed(offsets, 3, TAUT_TYPE_U64)),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_sparse_distances_vertices(sparse, typed(vertices, 6, TAUT_TYPE_U16)),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_sparse_distances_values(sparse, room(d, 6)), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK(offsets[0] == UINT64_MAX && vertices[0] == UINT16_MAX && d[0] == -1);
    taut_sparse_distances_free(sparse);
}

static void distances_within_a_radius_that_is_special(void) {
    taut_exact *exact = exact_rectangle();
    taut_sparse_distances *sparse = NULL;
    taut_sources from = row_sources();
    CHECK(taut_exact_distances_within(exact, &from, 0, 1, NULL, &sparse) == TAUT_STATUS_OK);
    CHECK(taut_sparse_distances_row_count(sparse) == 3 && taut_sparse_distances_count(sparse) == 2);
    taut_sparse_distances_free(sparse);
    CHECK(taut_exact_distances_within(exact, &from, INFINITY, 1, NULL, &sparse) == TAUT_STATUS_OK);
    CHECK(taut_sparse_distances_count(sparse) == 4 + 1 + 4);
    taut_sparse_distances_free(sparse);
    const taut_sources none = {.struct_size = sizeof none};
    uint32_t offset = 7;
    CHECK(taut_exact_distances_within(exact, &none, 1, 0, NULL, &sparse) == TAUT_STATUS_OK);
    CHECK(taut_sparse_distances_row_count(sparse) == 0 && taut_sparse_distances_count(sparse) == 0);
    CHECK(taut_sparse_distances_offsets(sparse, (taut_output){.data = &offset, .count = 1}) == TAUT_STATUS_OK);
    CHECK(taut_sparse_distances_vertices(sparse, (taut_output){0}) == TAUT_STATUS_OK && offset == 0);
    taut_sparse_distances_free(sparse);

    const double bad[] = {-1, -INFINITY, NAN};
    for (size_t i = 0; i < 3; i++) {
        sparse = (taut_sparse_distances *)&failures; /* must be overwritten */
        CHECK_FAILS(taut_exact_distances_within(exact, &from, bad[i], 1, NULL, &sparse), TAUT_REASON_BAD_ARGUMENT, 0, 0);
        CHECK(sparse == NULL);
    }
    CHECK_FAILS(taut_exact_distances_within(NULL, &from, 1, 1, NULL, &sparse), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_distances_within(exact, NULL, 1, 1, NULL, &sparse), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_distances_within(exact, &from, 1, 1, NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    const uint32_t beyond[] = {0, 5};
    from.vertices = indices(beyond, 2);
    CHECK_FAILS(taut_exact_distances_within(exact, &from, 1, 1, NULL, &sparse), TAUT_REASON_VERTEX_OUT_OF_RANGE,
                TAUT_ELEMENT_SOURCE, 1);
    taut_exact_free(exact);

    double d[1];
    CHECK(taut_sparse_distances_row_count(NULL) == 0 && taut_sparse_distances_count(NULL) == 0);
    CHECK_FAILS(taut_sparse_distances_offsets(NULL, room(d, 1)), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_sparse_distances_vertices(NULL, room(d, 1)), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_sparse_distances_values(NULL, room(d, 1)), TAUT_REASON_NULL_POINTER, 0, 0);
    taut_sparse_distances_free(NULL);
}

static void farthest_points(void) {
    taut_exact *exact = exact_rectangle();
    int64_t v[6];
    double d[6];
    taut_output to_v = {.data = v, .count = 6, .type = TAUT_TYPE_I64};
    for (size_t i = 0; i < 6; i++) v[i] = 77, d[i] = -1;
    /* Of the rectangle the far corner, the next ones; vertex 4 is on no triangle. The last row is not asked for. */
    CHECK(taut_exact_farthest_points(exact, &from_zero, 5, NULL, to_v, room(d, 6)) == TAUT_STATUS_OK);
    CHECK(v[0] == 2 && v[1] == 1 && v[2] == 3 && v[3] == -1 && v[4] == -1 && v[5] == 77);
    CHECK(d[0] == 5 && d[1] == 3 && d[2] == 3 && d[3] == 0 && d[4] == 0 && d[5] == -1);
    CHECK(taut_exact_farthest_points(exact, &from_zero, 0, NULL, (taut_output){0}, (taut_output){0}) == TAUT_STATUS_OK);

    /* All or nothing. */
    for (size_t i = 0; i < 6; i++) v[i] = 77, d[i] = -1;
    const taut_sources none = {.struct_size = sizeof none};
    CHECK_FAILS(taut_exact_farthest_points(NULL, &from_zero, 5, NULL, to_v, room(d, 6)), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_farthest_points(exact, NULL, 5, NULL, to_v, room(d, 6)), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_farthest_points(exact, &none, 5, NULL, to_v, room(d, 6)), TAUT_REASON_NO_SOURCE, 0, 0);
    CHECK_FAILS(taut_exact_farthest_points(exact, &from_zero, 5, NULL, to_v, room(d, 4)), TAUT_REASON_BUFFER_TOO_SMALL, 0,
                0);
    CHECK(strstr(taut_last_error(NULL), "distances") != NULL);
    CHECK_FAILS(taut_exact_farthest_points(exact, &from_zero, 7, NULL, to_v, room(d, 7)), TAUT_REASON_BUFFER_TOO_SMALL, 0,
                0);
    CHECK(strstr(taut_last_error(NULL), "vertices") != NULL);
    CHECK_FAILS(taut_exact_farthest_points(exact, &from_zero, SIZE_MAX, NULL, to_v, room(d, 6)),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    to_v.count = SIZE_MAX;
    CHECK_FAILS(taut_exact_farthest_points(exact, &from_zero, SIZE_MAX, NULL, to_v, room(d, SIZE_MAX)),
                TAUT_REASON_TOO_MANY_ELEMENTS, 0, 0);
    to_v = typed(v, 6, TAUT_TYPE_F64);
    CHECK_FAILS(taut_exact_farthest_points(exact, &from_zero, 5, NULL, to_v, room(d, 6)), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    for (size_t i = 0; i < 6; i++) CHECK(v[i] == 77 && d[i] == -1);
    taut_exact_free(exact);
}

/* Rows of the hills are their fields, to the bit, for any number of threads; and end when a callback says so. */
static void long_batches(void) {
    enum { ROWS = 3 };
    taut_mesh *mesh = hills();
    taut_exact *exact = NULL;
    taut_exact_field *field = NULL;
    taut_sparse_distances *sparse = NULL;
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
    const uint32_t starts[ROWS] = {0, HILL_VERTICES - 1, 45000};
    const taut_sources from = {.struct_size = sizeof from, .vertices = indices(starts, ROWS)};
    const size_t size = ROWS * HILL_VERTICES * sizeof(double);
    double *rows = malloc(size), *expected = malloc(size), d[2];
    for (size_t i = 0; i < ROWS; i++) {
        const taut_sources alone = {.struct_size = sizeof alone, .vertices = indices(starts + i, 1)};
        CHECK(taut_exact_field_new(exact, &alone, NULL, NULL, &field) == TAUT_STATUS_OK);
        CHECK(taut_exact_field_distances(field, NULL, room(expected + i * HILL_VERTICES, HILL_VERTICES)) == 0);
        taut_exact_field_free(field);
    }
    const size_t threads[] = {1, 2, 8};
    for (size_t t = 0; t < 3; t++) {
        memset(rows, 0xff, size);
        CHECK(taut_exact_distance_rows(exact, &from, each, threads[t], NULL, room(rows, ROWS)) == TAUT_STATUS_OK);
        CHECK(memcmp(rows, expected, size) == 0);
    }

    double *untouched = expected;
    memset(rows, 0xff, size);
    memset(untouched, 0xff, size);
    for (size_t t = 0; t < 3; t++) {
        uint32_t samples[2] = {77, 77};
        taut_control *controls[3];
        witness seen[3];
        for (size_t i = 0; i < 3; i++) {
            seen[i] = (witness){.cancel_at = 10};
            CHECK(taut_control_new(controls + i) == TAUT_STATUS_OK);
            CHECK(taut_control_set_callback(controls[i], watch, seen + i) == TAUT_STATUS_OK);
        }
        CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, threads[t], controls[0], room(rows, ROWS)),
                    TAUT_REASON_CANCELLED, 0, 0);
        CHECK_FAILS(taut_exact_distances_within(exact, &from, 200, threads[t], controls[1], &sparse),
                    TAUT_REASON_CANCELLED, 0, 0);
        CHECK_FAILS(taut_exact_farthest_points(exact, &from, 2, controls[2],
                                               (taut_output){.data = samples, .count = 2}, room(d, 2)),
                    TAUT_REASON_CANCELLED, 0, 0);
        CHECK(sparse == NULL && samples[0] == 77 && samples[1] == 77);
        CHECK(memcmp(rows, untouched, size) == 0);
        for (size_t i = 0; i < 3; i++) {
            CHECK(seen[i].calls == 10 && seen[i].on_one_thread && pthread_equal(seen[i].thread, pthread_self()));
            taut_control_free(controls[i]);
        }
    }

    taut_control *small = NULL;
    CHECK(taut_control_new(&small) == TAUT_STATUS_OK && taut_control_set_memory_limit(small, 1) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 2, small, room(rows, ROWS)), TAUT_REASON_MEMORY_LIMIT, 0, 0);
    CHECK_FAILS(taut_exact_distances_within(exact, &from, 5, 2, small, &sparse), TAUT_REASON_MEMORY_LIMIT, 0, 0);
    CHECK(taut_control_set_memory_limit(small, 0) == TAUT_STATUS_OK);
    CHECK(taut_control_set_time_limit(small, 0.01) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, each, 2, small, room(rows, ROWS)), TAUT_REASON_TIME_LIMIT, 0, 0);
    taut_control_free(small);
    free(rows);
    free(expected);
    taut_exact_free(exact);
}

/* A size that was never set is found, in structs that are read and in those that are filled. */
static void sizes_that_were_never_set(void) {
    taut_mesh *mesh = rectangle();
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    const size_t sizes[] = {0, sizeof(size_t) - 1, 4097, SIZE_MAX / 2, SIZE_MAX};
    for (size_t i = 0; i < 5; i++) {
        taut_sources from = from_zero;
        from.struct_size = sizes[i];
        CHECK_FAILS(taut_exact_field_new(exact, &from, NULL, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
        CHECK(strstr(taut_last_error(NULL), "sources.struct_size") != NULL);
        taut_properties properties = {.mean_edge = -1};
        properties.struct_size = sizes[i];
        CHECK_FAILS(taut_mesh_properties(mesh, &properties), TAUT_REASON_BAD_ARGUMENT, 0, 0);
        CHECK(properties.struct_size == sizes[i] && properties.mean_edge == -1);
        taut_error error = {.struct_size = sizes[i], .reason = -1};
        taut_last_error(&error); /* which tells no one */
        CHECK(error.reason == -1);
    }
    taut_exact_free(exact);
    taut_mesh_free(mesh);
}

static void what_is_reserved_is_zero(void) {
    taut_mesh *mesh = NULL;
    double d[15] = {-1};
    taut_input in = positions;
    taut_output out = room(d, 5);
    in.reserved = 1;
    CHECK_FAILS(taut_mesh_new(in, triangles, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "positions.reserved") != NULL);
    mesh = rectangle();
    out.reserved = 1;
    CHECK_FAILS(taut_mesh_positions(mesh, out), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(d[0] == -1);
    taut_mesh_free(mesh);
}

static void what_interrupted_a_field(void) {
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    taut_control *control = NULL;
    taut_exact_options options = {.struct_size = sizeof options, .allow_partial = 1};
    taut_error detail = {.struct_size = sizeof detail, .reason = -1};
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_new(exact, &from_zero, &options, control, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_interruption(field, &detail) == TAUT_STATUS_OK && detail.status == 0 && detail.reason == 0);
    CHECK(taut_exact_field_windows(field) > 0 && taut_exact_field_windows(NULL) == 0);
    taut_exact_field_free(field);

    CHECK(taut_control_set_memory_limit(control, 1) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_new(exact, &from_zero, &options, control, &field) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_interruption(field, &detail) == TAUT_STATUS_LIMIT_REACHED);
    CHECK(detail.status == TAUT_STATUS_LIMIT_REACHED && detail.reason == TAUT_REASON_MEMORY_LIMIT);
    detail.struct_size = 0;
    CHECK(taut_exact_field_interruption(field, &detail) == TAUT_STATUS_INVALID_ARGUMENT);
    CHECK(last_is(TAUT_REASON_BAD_ARGUMENT, 0, 0));
    taut_exact_field_free(field);
    taut_control_free(control);
    taut_exact_free(exact);
}

static void residuals(void) {
    taut_mesh *mesh = rectangle();
    taut_heat *heat = NULL;
    taut_control *control = NULL;
    struct {
        taut_heat_residuals known;
        uint64_t newer;
    } out;
    memset(&out, 0xff, sizeof out);
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    out.known.struct_size = offsetof(taut_heat_residuals, poisson); /* older */
    CHECK(taut_heat_residuals_of(heat, &from_zero, NULL, &out.known) == TAUT_STATUS_OK);
    CHECK(out.known.heat >= 0 && out.known.heat < 1e-12 && isnan(out.known.poisson));
    out.known.struct_size = sizeof out; /* newer */
    CHECK(taut_heat_residuals_of(heat, &from_zero, NULL, &out.known) == TAUT_STATUS_OK);
    CHECK(out.known.poisson >= 0 && out.known.poisson < 1e-12 && out.newer == 0);

    out.known.heat = -1;
    const taut_sources none = {.struct_size = sizeof none};
    CHECK_FAILS(taut_heat_residuals_of(NULL, &from_zero, NULL, &out.known), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_residuals_of(heat, NULL, NULL, &out.known), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_residuals_of(heat, &from_zero, NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_heat_residuals_of(heat, &none, NULL, &out.known), TAUT_REASON_NO_SOURCE, 0, 0);
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    taut_control_cancel(control);
    CHECK_FAILS(taut_heat_residuals_of(heat, &from_zero, control, &out.known), TAUT_REASON_CANCELLED, 0, 0);
    CHECK(out.known.heat == -1);
    taut_control_free(control);
    taut_heat_free(heat);
    taut_mesh_free(mesh);
}

static void levels_of_lines(void) {
    taut_mesh *mesh = rectangle();
    double levels[4] = {-1, -1, -1, -1};
    size_t count = 77;
    CHECK(taut_even_levels(mesh, values, 2, room(levels, 4), &count) == TAUT_STATUS_OK);
    CHECK(count == 2 && levels[0] == 1 && levels[1] == 2 && levels[2] == -1);
    float single[2];
    CHECK(taut_spaced_levels(mesh, values, 1.25, typed(single, 2, TAUT_TYPE_F32), &count) == TAUT_STATUS_OK);
    CHECK(count == 2 && single[0] == 1.25f && single[1] == 2.5f);
    CHECK(taut_even_levels(mesh, values, 0, (taut_output){0}, &count) == TAUT_STATUS_OK && count == 0);
    CHECK(taut_spaced_levels(mesh, values, 10, (taut_output){0}, &count) == TAUT_STATUS_OK && count == 0);

    count = 77;
    levels[0] = -1;
    const taut_input four = scalars(along_x, 4);
    const double bad_spacings[] = {0, -1, NAN, INFINITY, 1e-9};
    CHECK_FAILS(taut_even_levels(NULL, values, 2, room(levels, 4), &count), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_even_levels(mesh, values, 2, room(levels, 4), NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_even_levels(mesh, values, 2, room(levels, 1), &count), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_even_levels(mesh, values, TAUT_MAX_LEVELS + 1, room(levels, 4), &count), TAUT_REASON_BAD_ARGUMENT,
                0, 0);
    CHECK_FAILS(taut_even_levels(mesh, values, SIZE_MAX, room(levels, 4), &count), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_even_levels(mesh, four, 2, room(levels, 4), &count), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_spaced_levels(NULL, values, 1, room(levels, 4), &count), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_spaced_levels(mesh, values, 1, room(levels, 4), NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_spaced_levels(mesh, values, 1, room(levels, 1), &count), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_spaced_levels(mesh, four, 1, room(levels, 4), &count), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    for (size_t i = 0; i < 5; i++)
        CHECK_FAILS(taut_spaced_levels(mesh, values, bad_spacings[i], room(levels, 4), &count), TAUT_REASON_BAD_ARGUMENT,
                    0, 0);
    CHECK(count == 77 && levels[0] == -1);
    taut_mesh_free(mesh);
}

/* From (0, 0) to (3, 4) over the diagonal, and on to (3, 0): then distances from all of that. */
static void a_curve_through_points(void) {
    taut_exact *exact = exact_rectangle();
    taut_curves *curves = NULL;
    taut_control *control = NULL;
    uint32_t faces[] = {0, 1, 0, 0}, begins[2];
    const double weights[] = {1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0};
    double d[5];
    CHECK(taut_exact_curve_through(exact, indices(faces, 4), scalars(weights, 4), NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 1 && taut_curves_point_count(curves) == 4);
    uint32_t through[4], source = 77;
    double at[3 * 4];
    CHECK(taut_curves_offsets(curves, (taut_output){.data = begins, .count = 2}) == TAUT_STATUS_OK);
    CHECK(taut_curves_faces(curves, (taut_output){.data = through, .count = 4}) == TAUT_STATUS_OK);
    CHECK(taut_curves_barycentrics(curves, room(at, 4)) == TAUT_STATUS_OK);
    CHECK(taut_curves_sources(curves, (taut_output){.data = &source, .count = 1}) == TAUT_STATUS_OK);
    CHECK(source == UINT32_MAX);
    const taut_sources line = {.struct_size = sizeof line,
                               .curve_offsets = indices(begins, 2),
                               .curve_faces = indices(through, 4),
                               .curve_barycentrics = scalars(at, 4)};
    CHECK(field_of(exact, &line, d) == TAUT_STATUS_OK);
    CHECK(d[0] == 0 && d[1] == 0 && d[2] == 0 && fabs(d[3] - 2.4) < 1e-15);
    const drawing it = drawn(curves);
    CHECK(is_at(it.positions, 0, 0) && is_at(it.positions + 3, 1.5, 2) && is_at(it.positions + 6, 3, 4));
    CHECK(is_at(it.positions + 9, 3, 0));

    CHECK(taut_exact_curve_through(exact, each, each, NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_count(curves) == 1 && taut_curves_point_count(curves) == 0);
    taut_curves_free(curves);

    CHECK_FAILS(taut_exact_curve_through(NULL, each, each, NULL, &curves), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_exact_curve_through(exact, each, each, NULL, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    curves = (taut_curves *)&failures; /* must be overwritten */
    CHECK_FAILS(taut_exact_curve_through(exact, indices(faces, 4), scalars(weights, 3), NULL, &curves),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(curves == NULL && strstr(taut_last_error(NULL), "`faces`") != NULL);
    faces[2] = 2;
    CHECK_FAILS(taut_exact_curve_through(exact, indices(faces, 4), scalars(weights, 4), NULL, &curves),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_POINT, 2);
    const int64_t negative[] = {0, -1};
    CHECK_FAILS(taut_exact_curve_through(exact, (taut_input){.data = negative, .count = 2, .type = TAUT_TYPE_I64},
                                         scalars(weights, 2), NULL, &curves),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_POINT, 1);
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    taut_control_cancel(control);
    CHECK_FAILS(taut_exact_curve_through(exact, indices(faces, 2), scalars(weights, 2), control, &curves),
                TAUT_REASON_CANCELLED, 0, 0);
    CHECK(curves == NULL);
    taut_control_free(control);
    taut_exact_free(exact);
}

/* {0, inside}, {2}: by both methods, the same as each set alone. */
static void rows_of_sets(void) {
    taut_mesh *mesh = rectangle();
    taut_exact *exact = exact_rectangle();
    taut_heat *heat = NULL;
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    const uint32_t vertices[] = {2, 0};
    const int64_t offsets[] = {0, 1, 3};
    const taut_input sets = {.data = offsets, .count = 3, .type = TAUT_TYPE_I64};
    const taut_sources from = {.struct_size = sizeof from,
                               .vertices = indices(vertices, 2),
                               .faces = indices(two_faces, 1),
                               .barycentrics = scalars(inside, 1)},
                       first = {.struct_size = sizeof first, .vertices = indices(vertices, 1)};
    taut_sources second = from;
    second.vertices = indices(vertices + 1, 1);
    double rows[2 * 5], expected[2 * 5];
    CHECK(field_of(exact, &first, expected) == TAUT_STATUS_OK && field_of(exact, &second, expected + 5) == TAUT_STATUS_OK);
    CHECK(taut_exact_distance_rows(exact, &from, sets, 2, NULL, room(rows, 2)) == TAUT_STATUS_OK);
    CHECK(memcmp(rows, expected, sizeof rows) == 0);
    CHECK(heat_distances(heat, &first, expected) == TAUT_STATUS_OK);
    CHECK(heat_distances(heat, &second, expected + 5) == TAUT_STATUS_OK);
    CHECK(taut_heat_distance_rows(heat, &from, sets, 2, NULL, room(rows, 2)) == TAUT_STATUS_OK);
    CHECK(memcmp(rows, expected, sizeof rows) == 0);

    const taut_sources none = {.struct_size = sizeof none};
    const uint32_t only_end[] = {0}, from_one[] = {1, 3}, short_of[] = {0, 2}, back[] = {0, 2, 1, 3}, empty[] = {0, 0, 3};
    CHECK(taut_exact_distance_rows(exact, &none, indices(only_end, 1), 1, NULL, (taut_output){0}) == TAUT_STATUS_OK);
    memset(rows, 0xff, sizeof rows);
    memset(expected, 0xff, sizeof expected);
    const taut_input bad[] = {indices(only_end, 1), indices(from_one, 2), indices(short_of, 2), indices(back, 4),
                              typed_input(offsets, 3, TAUT_TYPE_F64)};
    for (size_t i = 0; i < 5; i++) {
        CHECK_FAILS(taut_exact_distance_rows(exact, &from, bad[i], 1, NULL, room(rows, 2)), TAUT_REASON_BAD_ARGUMENT, 0,
                    0);
        CHECK(strstr(taut_last_error(NULL), "`set_offsets") != NULL);
        CHECK_FAILS(taut_heat_distance_rows(heat, &from, bad[i], 1, NULL, room(rows, 2)), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    }
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, indices(empty, 3), 1, NULL, room(rows, 2)), TAUT_REASON_NO_SOURCE,
                0, 0);
    CHECK_FAILS(taut_exact_distance_rows(exact, &from, sets, 1, NULL, room(rows, 1)), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    const uint32_t beyond[] = {2, 5};
    second.vertices = indices(beyond, 2); /* the first of the second set */
    CHECK_FAILS(taut_heat_distance_rows(heat, &second, sets, 1, NULL, room(rows, 2)), TAUT_REASON_VERTEX_OUT_OF_RANGE,
                TAUT_ELEMENT_SOURCE, 1);
    CHECK(memcmp(rows, expected, sizeof rows) == 0);
    taut_heat_free(heat);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
}

static void meshes_from_memory(void) {
    static const char off[] = "OFF\n3 1 0\n0 0 0\n3 0 0\n0 4 0\n3 0 1 2\n", obj[] = "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n";
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_read_bytes(off, sizeof off - 1, TAUT_FORMAT_OFF, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_vertex_count(mesh) == 3 && taut_mesh_triangle_count(mesh) == 1);
    taut_mesh_free(mesh);
    CHECK(taut_mesh_read_bytes(obj, sizeof obj - 1, TAUT_FORMAT_OBJ, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_vertex_count(mesh) == 3 && taut_mesh_triangle_count(mesh) == 1);
    taut_mesh_free(mesh);

    mesh = (taut_mesh *)&failures; /* must be overwritten */
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off - 9, TAUT_FORMAT_OFF, &mesh), TAUT_REASON_TRUNCATED,
                TAUT_ELEMENT_FACE, 0);
    CHECK(mesh == NULL);
    for (taut_format format = TAUT_FORMAT_GLB; format <= TAUT_FORMAT_STL; format++)
        CHECK(taut_mesh_read_bytes(NULL, 0, format, &mesh) == TAUT_STATUS_FORMAT && mesh == NULL);
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off, 0, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off, TAUT_FORMAT_STL + 1, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(NULL, 1, TAUT_FORMAT_OFF, &mesh), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(off, SIZE_MAX, TAUT_FORMAT_OFF, &mesh), TAUT_REASON_TOO_MANY_ELEMENTS, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off, TAUT_FORMAT_OFF, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
}

static void positions_of_points(void) {
    taut_mesh *mesh = rectangle();
    const uint32_t beyond[] = {1, 2};
    const int32_t negative[] = {1, -1};
    double at[6] = {-1, -1, -1, -1, -1, -1};
    float strided[8] = {0, 0, 0, 7, 0, 0, 0, 7};
    const taut_output to_strided = {.data = strided, .count = 2, .stride = 16, .type = TAUT_TYPE_F32};
    CHECK_FAILS(taut_mesh_point_positions(NULL, each, each, (taut_output){0}), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(beyond, 2), scalars(two_weights, 2), room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_FACE, 2);
    CHECK_FAILS(taut_mesh_point_positions(mesh, typed_input(negative, 2, TAUT_TYPE_I32), scalars(two_weights, 2),
                                          room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_POINT, 1);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(two_faces, 1), scalars(two_weights, 2), room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(two_weights, 2), room(at, 1)),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK(at[0] == -1 && at[3] == -1);
    CHECK(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(two_weights, 2), room(at, 2)) == TAUT_STATUS_OK);
    CHECK(is_at(at, 3, 4) && is_at(at + 3, 2.25, 3));
    CHECK(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(two_weights, 2), to_strided) == TAUT_STATUS_OK);
    CHECK(strided[0] == 3 && strided[3] == 7 && strided[4] == 2.25f && strided[7] == 7);
    CHECK(taut_mesh_point_positions(mesh, each, each, (taut_output){0}) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
}

/* Sources 0 and 2; from 3, from where none reaches, from 1. */
static void where_paths_end(void) {
    const uint32_t two[] = {2, 0}, targets[] = {3, 4, 1};
    const taut_sources from = {.struct_size = sizeof from, .vertices = indices(two, 2)};
    taut_exact_field *field = field_with(&from, NULL);
    taut_mesh *mesh = rectangle();
    taut_curves *curves = NULL;
    double d[5];
    int32_t ends[3];
    CHECK(taut_exact_field_distances(field, NULL, room(d, 5)) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_paths(field, VERTICES(indices(targets, 3)), NULL, &curves) == TAUT_STATUS_OK);
    CHECK(taut_curves_sources(curves, typed(ends, 3, TAUT_TYPE_I32)) == TAUT_STATUS_OK);
    CHECK(ends[0] == 0 && ends[1] == -1 && ends[2] == 1);
    CHECK_FAILS(taut_curves_sources(curves, typed(ends, 2, TAUT_TYPE_I32)), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_curves_sources(NULL, typed(ends, 3, TAUT_TYPE_I32)), TAUT_REASON_NULL_POINTER, 0, 0);
    taut_curves_free(curves);

    memset(ends, 0, sizeof ends);
    CHECK(taut_descent_paths_new(mesh, scalars(d, 5), &from, VERTICES(indices(targets, 3)), NULL, &curves) == 0);
    CHECK(taut_curves_sources(curves, typed(ends, 3, TAUT_TYPE_I32)) == TAUT_STATUS_OK);
    CHECK(ends[0] == 0 && ends[1] == -1 && ends[2] == 1);
    taut_curves_free(curves);

    curves = two_lines();
    CHECK(taut_curves_sources(curves, typed(ends, 3, TAUT_TYPE_I32)) == TAUT_STATUS_OK);
    CHECK(ends[0] == -1 && ends[1] == -1);
    taut_curves_free(curves);
    taut_mesh_free(mesh);
    taut_exact_field_free(field);
}

static void what_grows_with_what_is_asked_can_be_cancelled(void) {
    enum { POINTS_ASKED = 1000 };
    taut_mesh *mesh = hills();
    taut_closest *closest = NULL;
    taut_curves *curves = NULL;
    taut_control *control = NULL;
    witness seen = {.cancel_at = 5};
    double *at = malloc(sizeof *at * 3 * HILL_VERTICES), weights[3 * POINTS_ASKED], far[POINTS_ASKED] = {-1};
    uint32_t faces[POINTS_ASKED] = {77};
    CHECK(taut_closest_new(mesh, &closest) == TAUT_STATUS_OK);
    CHECK(taut_mesh_positions(mesh, room(at, HILL_VERTICES)) == TAUT_STATUS_OK);
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    CHECK(taut_control_set_callback(control, watch, &seen) == TAUT_STATUS_OK);
    const taut_output to_faces = {.data = faces, .count = POINTS_ASKED};
    CHECK_FAILS(taut_closest_points(closest, scalars(at, POINTS_ASKED), control, to_faces, room(weights, POINTS_ASKED),
                                    room(far, POINTS_ASKED)),
                TAUT_REASON_CANCELLED, 0, 0);
    CHECK(seen.calls == 5 && seen.progress > 0 && faces[0] == 77 && far[0] == -1);
    taut_control_free(control);

    const taut_input heights = {.data = at + 2, .count = HILL_VERTICES, .stride = 3 * sizeof *at};
    seen = (witness){.cancel_at = 5};
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    CHECK(taut_control_set_callback(control, watch, &seen) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_descent_paths_new(mesh, heights, NULL, NULL, control, &curves), TAUT_REASON_CANCELLED, 0, 0);
    CHECK(curves == NULL && seen.calls == 5 && seen.progress > 0);
    taut_control_free(control);
    free(at);
    taut_closest_free(closest);
    taut_mesh_free(mesh);
}

int main(void) {
    before_any_failure();
    versions_and_names();
    errors_stay_until_the_next();
    null_is_an_error();
    empty_mesh();
    bad_meshes();
    ignored_triangles();
    every_packing_in();
    polygons();
    strided_output();
    indices_that_do_not_fit();
    sources();
    targets();
    cancelled_before_the_start();
    a_radius();
    long_calls();
    heat_options();
    time_steps();
    heat_fields();
    exact_distances();
    reports();
    properties();
    lines();
    lines_that_make_no_sense();
    curves_fill_views_whole_or_not_at_all();
    closest_points();
    closest_points_fill_all_views_or_none();
    sources_in_triangles();
    sources_along_curves();
    nearest_sources();
    points_of_a_field();
    paths();
    paths_of_descent();
    all_paths();
    from_click_to_click();
    distance_rows();
    distance_rows_all_or_none();
    distances_within();
    distances_within_a_radius_that_is_special();
    farthest_points();
    long_batches();
    sizes_that_were_never_set();
    what_is_reserved_is_zero();
    what_interrupted_a_field();
    residuals();
    levels_of_lines();
    a_curve_through_points();
    rows_of_sets();
    meshes_from_memory();
    positions_of_points();
    where_paths_end();
    what_grows_with_what_is_asked_can_be_cancelled();
    if (failures) fprintf(stderr, "%d checks failed\n", failures);
    return failures ? 1 : 0;
}
