/* The heat method: options, time steps, fields, meshes that move. */
#include "contract.h"

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
    taut_heat_free(again);
    CHECK_FAILS(taut_heat_with_mesh(heat, NULL, NULL, &again), TAUT_REASON_NULL_POINTER, 0, 0);
    xyz[1][1] = NAN;
    CHECK_FAILS(taut_mesh_with_positions(mesh, twice, &broken), TAUT_REASON_NON_FINITE_COORDINATE, TAUT_ELEMENT_VERTEX, 1);
    taut_mesh_free(moved);
    taut_heat_free(heat);
    taut_mesh_free(mesh);
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

const test tests[] = {
    TEST(heat_options),
    TEST(time_steps),
    TEST(heat_fields),
    TEST(residuals),
    {0},
};
