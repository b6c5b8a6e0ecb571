/* Cancelling and limiting: before the call, from its callback, from another thread. */
#include "contract.h"

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

    /* With a rest that outlasts the work it is told the first check and the end. */
    seen = (witness){0};
    it = new_job(exact, 0);
    CHECK(taut_control_set_callback(it.control, watch, &seen) == TAUT_STATUS_OK);
    CHECK(taut_control_set_callback_interval(it.control, INFINITY) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_control_set_callback_interval(it.control, -1), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_control_set_callback_interval(it.control, NAN), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    work(&it);
    CHECK(it.status == TAUT_STATUS_OK && seen.calls == 2 && seen.progress == 1);
    CHECK(taut_control_progress(it.control) == 1);
    taut_exact_field_free(it.field);
    taut_control_free(it.control);

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

/* A callback that uses its control: for another call, in which it is not called, and to take itself away. */
typedef struct {
    taut_exact *exact;
    taut_control *control;
    int calls, depth;
} user;

static int use(double progress, void *data) {
    user *it = data;
    taut_exact_field *field = NULL;
    CHECK(it->depth++ == 0 && progress == taut_control_progress(it->control));
    CHECK(taut_exact_field_new(it->exact, &from_zero, NULL, it->control, &field) == TAUT_STATUS_OK);
    taut_exact_field_free(field);
    it->depth--;
    if (++it->calls == 3) CHECK(taut_control_set_callback(it->control, NULL, NULL) == TAUT_STATUS_OK);
    return 0;
}

static void callbacks_that_use_their_control(const taut_exact *exact) {
    job it = new_job(exact, 0);
    user seen = {.exact = exact_rectangle(), .control = it.control};
    CHECK(taut_control_set_callback(it.control, use, &seen) == TAUT_STATUS_OK);
    work(&it);
    CHECK(it.status == TAUT_STATUS_OK && seen.calls == 3 && !taut_control_is_cancelled(it.control));
    taut_exact_field_free(it.field);
    taut_control_free(it.control);
    taut_exact_free(seen.exact);
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
    taut_mesh *mesh = hills(SQUARES);
    taut_exact *exact = NULL;
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    callbacks(exact);
    callbacks_that_use_their_control(exact);
    cancelled_from_another_thread(exact);
    limits(exact);
    heat_is_interrupted(mesh);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
}

static void what_grows_with_what_is_asked_can_be_cancelled(void) {
    enum { POINTS_ASKED = 1000 };
    taut_mesh *mesh = hills(SQUARES);
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

const test tests[] = {
    TEST(cancelled_before_the_start),
    TEST(long_calls),
    TEST(what_grows_with_what_is_asked_can_be_cancelled),
    {0},
};
