/* What taut.h promises to every caller, checked from C99. */
#include "contract.h"

int failures = 0;

bool last_is(taut_reason reason, taut_element element, uint64_t index) {
    taut_error error = {.struct_size = sizeof error};
    taut_last_error(&error);
    return error.reason == reason && error.element == element && error.index == index;
}

const double xyz[15] = {0, 0, 0, 3, 0, 0, 3, 4, 0, 0, 4, 0, 7, 7, 7};
const uint32_t corners[6] = {0, 1, 3, 1, 2, 3};
const taut_input positions = {.data = xyz, .count = 5};
const taut_input triangles = {.data = corners, .count = 2};
const double along_x[5] = {0, 3, 3, 0, INFINITY};
const taut_input values = {.data = along_x, .count = 5};
const uint32_t zero = 0;
const taut_input each = {0};
const taut_sources from_zero = {.struct_size = sizeof from_zero, .vertices = {.data = &zero, .count = 1}};
const taut_exact_options keeping = {.struct_size = sizeof keeping, .keep_windows = 1};
const uint32_t face_zero = 0;
const double inside[3] = {0.5, 0.25, 0.25};
const uint32_t two_faces[2] = {1, 1};
const double two_weights[6] = {0, 1, 0, 0.25, 0.5, 0.25};

taut_mesh *rectangle(void) {
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new(positions, triangles, &mesh) == TAUT_STATUS_OK);
    return mesh;
}

taut_exact *exact_rectangle(void) {
    taut_mesh *mesh = rectangle();
    taut_exact *exact = NULL;
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return exact;
}

taut_curves *two_lines(void) {
    taut_mesh *mesh = rectangle();
    taut_curves *curves = NULL;
    const float levels[] = {1.5f, 9, 0.75f};
    const taut_input as_floats = {.data = levels, .count = 3, .type = TAUT_TYPE_F32};
    CHECK(taut_isolines_new(mesh, values, as_floats, &curves) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return curves;
}

taut_status field_of(const taut_exact *exact, const taut_sources *sources, double *d) {
    taut_exact_field *field = NULL;
    taut_status status = taut_exact_field_new(exact, sources, NULL, NULL, &field);
    if (!status) status = taut_exact_field_distances(field, NULL, (taut_output){.data = d, .count = 5});
    taut_exact_field_free(field);
    return status;
}

bool is_rectangle_field(const double *d) {
    return d[0] == 0 && d[1] == 3 && d[2] == 5 && d[3] == 4 && d[4] == INFINITY;
}

taut_status heat_distances(const taut_heat *heat, const taut_sources *from, double *d) {
    taut_heat_field *field = NULL;
    taut_status status = taut_heat_field_new(heat, from, NULL, &field);
    if (!status) status = taut_heat_field_distances(field, (taut_output){.data = d, .count = 5});
    CHECK((status == TAUT_STATUS_OK) == (field != NULL));
    taut_heat_field_free(field);
    return status;
}

taut_exact_field *field_with(const taut_sources *sources, const taut_exact_options *options) {
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    CHECK(taut_exact_field_new(exact, sources, options, NULL, &field) == TAUT_STATUS_OK);
    taut_exact_free(exact); /* before the use of what was made from it */
    return field;
}

taut_mesh *hills(uint32_t squares) {
    const size_t vertices = (size_t)(squares + 1) * (squares + 1);
    double *points = malloc(sizeof *points * 3 * vertices);
    uint32_t *sides = malloc(sizeof *sides * 6 * squares * squares);
    uint32_t v = 0;
    size_t corner = 0;
    for (uint32_t j = 0; j <= squares; j++) {
        for (uint32_t i = 0; i <= squares; i++, v++) {
            points[3 * v] = i;
            points[3 * v + 1] = j;
            points[3 * v + 2] = 3 * sin(0.3 * i + 0.1 * j) * cos(0.2 * j - 0.05 * i);
            if (i == squares || j == squares) continue;
            const uint32_t up = v + squares + 1, square[] = {v, v + 1, up, v + 1, up + 1, up};
            for (size_t k = 0; k < 6; k++) sides[corner++] = square[k];
        }
    }
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){.data = points, .count = vertices},
                        (taut_input){.data = sides, .count = 2 * squares * squares}, &mesh) == TAUT_STATUS_OK);
    free(points);
    free(sides);
    return mesh;
}

int watch(double progress, void *user) {
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

drawing drawn(taut_curves *curves) {
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

bool is_at(const double *position, double x, double y) {
    return fabs(position[0] - x) < 1e-15 && fabs(position[1] - y) < 1e-15 && position[2] == 0;
}

int main(void) {
    for (const test *it = tests; it->name; it++) {
        const int before = failures;
        it->run();
        if (failures > before) fprintf(stderr, "%s: %d checks failed\n", it->name, failures - before);
    }
    return failures ? 1 : 0;
}
