/* The place on the surface that is nearest to a point in space. */
#include "contract.h"

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

const test tests[] = {
    TEST(closest_points),
    TEST(closest_points_fill_all_views_or_none),
    TEST(from_click_to_click),
    {0},
};
