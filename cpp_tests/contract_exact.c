/* Exact fields: distances, nearest sources and paths. */
#include "contract.h"

static void exact_distances(void) {
    taut_exact *exact = exact_rectangle();
    double d[5];
    CHECK(field_of(exact, &from_zero, d) == TAUT_STATUS_OK);
    CHECK(is_rectangle_field(d));
    taut_exact_free(exact);
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

const test tests[] = {
    TEST(exact_distances),
    TEST(strided_output),
    TEST(a_radius),
    TEST(nearest_sources),
    TEST(points_of_a_field),
    TEST(paths),
    TEST(all_paths),
    TEST(where_paths_end),
    TEST(what_interrupted_a_field),
    {0},
};
