/* Many exact fields in one call: rows, distances within a radius, farthest points. */
#include "contract.h"

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
    taut_mesh *mesh = hills(SQUARES);
    taut_exact *exact = NULL;
    taut_exact_field *field = NULL;
    taut_sparse_distances *sparse = NULL;
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
    const uint32_t starts[ROWS] = {0, HILL_VERTICES - 1, HILL_VERTICES / 2};
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

const test tests[] = {
    TEST(distance_rows),
    TEST(distance_rows_all_or_none),
    TEST(rows_of_sets),
    TEST(distances_within),
    TEST(distances_within_a_radius_that_is_special),
    TEST(farthest_points),
    TEST(long_batches),
    {0},
};
