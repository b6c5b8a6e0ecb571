/* Where distances are measured from, and to which places. */
#include "contract.h"

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

const test tests[] = {
    TEST(sources),
    TEST(targets),
    TEST(sources_in_triangles),
    TEST(sources_along_curves),
    {0},
};
