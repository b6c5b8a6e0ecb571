/* Isolines and paths of steepest descent. */
#include "contract.h"

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

const test tests[] = {
    TEST(lines),
    TEST(lines_that_make_no_sense),
    TEST(curves_fill_views_whole_or_not_at_all),
    TEST(levels_of_lines),
    TEST(paths_of_descent),
    TEST(a_curve_through_points),
    {0},
};
