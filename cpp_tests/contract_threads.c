/* Handles that many threads use at once: the same answers, to the bit, as one thread alone has. */
#define _POSIX_C_SOURCE 200112L
#include "functions.h"

#include <sys/wait.h>
#include <unistd.h>

enum { THREADS = 8 };

/* Runs `work` on all threads, with their numbers, and waits for them; true if it was true on all. */
typedef bool (*task)(size_t thread);

typedef struct {
    task work;
    size_t number;
    bool is_right;
} worker;

static void *begin(void *user) {
    worker *it = user;
    it->is_right = it->work(it->number);
    return NULL;
}

static bool on_all_threads(task work) {
    pthread_t threads[THREADS];
    worker workers[THREADS];
    bool are_right = true;
    for (size_t i = 0; i < THREADS; i++) {
        workers[i] = (worker){work, i, false};
        CHECK(pthread_create(threads + i, NULL, begin, workers + i) == 0);
    }
    for (size_t i = 0; i < THREADS; i++) {
        CHECK(pthread_join(threads[i], NULL) == 0);
        are_right = are_right && workers[i].is_right;
    }
    return are_right;
}

/* Every function, on the same handles; each thread begins with another one. */
static call *expected;

static bool call_every_function(size_t thread) {
    bool is_right = true;
    call *it = malloc(sizeof *it);
    for (size_t i = 0; i < function_count; i++) {
        const size_t which = (i + thread * function_count / THREADS) % function_count;
        prepare(it, functions + which);
        make(it);
        is_right = is_right && it->status == TAUT_STATUS_OK &&
                   memcmp(it->outputs, expected[which].outputs, sizeof it->outputs) == 0 &&
                   memcmp(it->records, expected[which].records, sizeof it->records) == 0 &&
                   memcmp(it->contents, expected[which].contents, sizeof it->contents) == 0;
    }
    for (const getter *get = getters; get < getters + getter_count; get++) {
        if (get->self != CONTROL) get->tell(handles[get->self]); /* one of these cancels what the others do */
    }
    free(it);
    return is_right;
}

static void every_function(void) {
    expected = malloc(function_count * sizeof *expected);
    make_handles();
    for (size_t i = 0; i < function_count; i++) {
        prepare(expected + i, functions + i);
        make(expected + i);
    }
    CHECK(on_all_threads(call_every_function));
    free_handles();
    free(expected);
}

/* Long work, on hills that are shared. */
enum { SIDE = 24, V = (SIDE + 1) * (SIDE + 1), ROWS = 3, CLICKS = 50, MOST_POINTS = 120000 };
static taut_mesh *mesh;
static taut_heat *heat;
static taut_exact *exact;
static taut_exact_field *kept;
static taut_closest *closest;
static const uint32_t starts[ROWS] = {0, V / 2, V - 1};
static taut_sources from; /* vertices, one after the other */

/* What comes of it. */
typedef struct {
    double heat[V], later[V], heat_rows[ROWS][V], exact[V], exact_rows[ROWS][V];
    uint32_t nearest[V], faces[CLICKS];
    double weights[CLICKS][3], off[CLICKS], lines[MOST_POINTS], paths[MOST_POINTS], descent[MOST_POINTS];
} day;

static taut_output whole_rows(double (*rows)[V]) {
    return (taut_output){.data = rows, .count = ROWS, .stride = sizeof rows[0]};
}

static taut_status heat_fields(day *it) {
    taut_heat *later = NULL;
    taut_heat_field *field = NULL, *later_field = NULL;
    taut_status status = taut_heat_field_new(heat, &from, NULL, &field);
    if (!status) status = taut_heat_field_distances(field, room(it->heat, V));
    if (!status) status = taut_heat_with_time_step(heat, (taut_time_step){.factor = 3}, NULL, &later);
    if (!status) status = taut_heat_field_new(later, &from, NULL, &later_field);
    if (!status) status = taut_heat_field_distances(later_field, room(it->later, V));
    taut_heat_field_free(later_field);
    taut_heat_field_free(field);
    taut_heat_free(later);
    return status;
}

static taut_status exact_field(day *it) {
    taut_exact_field *field = NULL;
    taut_status status = taut_exact_field_new(exact, &from, &keeping, NULL, &field);
    if (!status) status = taut_exact_field_distances(field, NULL, room(it->exact, V));
    if (!status) status = taut_exact_field_nearest_sources(field, NULL, (taut_output){.data = it->nearest, .count = V});
    taut_exact_field_free(field);
    return status;
}

static taut_status both_rows(day *it) {
    taut_status status = taut_heat_distance_rows(heat, &from, each, 2, NULL, whole_rows(it->heat_rows));
    if (!status) status = taut_exact_distance_rows(exact, &from, each, 3, NULL, whole_rows(it->exact_rows));
    return status;
}

static taut_status clicks(day *it) {
    double points[CLICKS][3];
    for (size_t i = 0; i < CLICKS; i++) {
        for (size_t axis = 0; axis < 3; axis++) points[i][axis] = SIDE / 2.0 * (1 + sin((double)(3 * i + axis)));
    }
    return taut_closest_points(closest, scalars(points[0], CLICKS), NULL, (taut_output){.data = it->faces, .count = CLICKS},
                               room(it->weights[0], CLICKS), room(it->off, CLICKS));
}

/* The positions, and away with the curves. */
static taut_status positions_of(taut_curves *curves, double *out) {
    const taut_status status = taut_curves_positions(curves, room(out, MOST_POINTS / 3));
    taut_curves_free(curves);
    return status;
}

static taut_status curves(day *it) {
    taut_curves *lines = NULL, *paths = NULL, *descent = NULL;
    const double levels[] = {3, 7.5, 12};
    const taut_input distances = scalars(it->exact_rows[0], V);
    taut_status status = taut_exact_field_paths(kept, NULL, NULL, &paths);
    if (!status) status = taut_isolines_new(mesh, distances, scalars(levels, 3), &lines);
    if (!status) status = taut_descent_paths_new(mesh, distances, &from_zero, NULL, NULL, &descent);
    if (!status) status = positions_of(paths, it->paths);
    if (!status) status = positions_of(lines, it->lines);
    if (!status) status = positions_of(descent, it->descent);
    return status;
}

static day *a_day(size_t thread) {
    taut_status (*const parts[])(day *) = {heat_fields, exact_field, both_rows, clicks};
    day *it = calloc(1, sizeof *it);
    taut_status status = TAUT_STATUS_OK;
    for (size_t i = 0; i < 4 && !status; i++) status = parts[(i + thread) % 4](it);
    if (!status) status = curves(it); /* they need the rows */
    CHECK(status == TAUT_STATUS_OK);
    return it;
}

static day *alone;

static bool spend_a_day(size_t thread) {
    day *it = a_day(thread);
    const bool is_right = memcmp(it, alone, sizeof *it) == 0;
    free(it);
    return is_right;
}

static void one_solver(void) {
    mesh = hills(SIDE);
    from = (taut_sources){.struct_size = sizeof from, .vertices = indices(starts, ROWS)};
    CHECK(taut_heat_new(mesh, NULL, NULL, &heat) == TAUT_STATUS_OK);
    CHECK(taut_exact_new(mesh, &exact) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_new(exact, &from, &keeping, NULL, &kept) == TAUT_STATUS_OK);
    CHECK(taut_closest_new(mesh, &closest) == TAUT_STATUS_OK);
    alone = a_day(0);
    CHECK(alone->heat[1] > 0 && alone->exact[1] > 0 && alone->off[0] > 0);
    CHECK(alone->paths[3000] > 0 && alone->lines[1] > 0 && alone->descent[3000] > 0);
    CHECK(on_all_threads(spend_a_day));
    free(alone);
    taut_closest_free(closest);
    taut_exact_field_free(kept);
    taut_exact_free(exact);
    taut_heat_free(heat);
    taut_mesh_free(mesh);
}

/* A failure on each thread, all at the same time. */
static pthread_barrier_t all_have_failed;

static bool fail(size_t thread) {
    const uint32_t beyond[] = {0, 1, 2 + (uint32_t)thread};
    const double points[9] = {0};
    taut_mesh *none = NULL;
    const bool is_refused = taut_mesh_new(scalars(points, thread < 2 ? 0 : 2), indices(beyond, 1), &none) != TAUT_STATUS_OK;
    char message[200];
    sprintf(message, "%.199s", taut_last_error(NULL));
    pthread_barrier_wait(&all_have_failed);
    taut_mesh_read(thread % 2 ? NULL : "/no/such.off", &none);
    const bool is_another = strcmp(message, taut_last_error(NULL)) != 0;
    pthread_barrier_wait(&all_have_failed);
    const taut_reason reason = thread % 2 ? TAUT_REASON_NULL_POINTER : TAUT_REASON_IO;
    return is_refused && is_another && last_is(reason, TAUT_ELEMENT_NONE, 0);
}

static void last_errors(void) {
    CHECK(pthread_barrier_init(&all_have_failed, NULL, THREADS) == 0);
    CHECK(on_all_threads(fail));
    CHECK(pthread_barrier_destroy(&all_have_failed) == 0);
}

/* One control for all calls: limits, callbacks and cancelling from every side while it is in use. */
static taut_control *shared;

static bool meddle(size_t thread) {
    taut_exact_field *field = NULL;
    for (size_t i = 0; i < 50; i++) {
        if (thread % 2) {
            const taut_status status = taut_exact_field_new(handles[EXACT].exact, &from_zero, NULL, shared, &field);
            taut_exact_field_free(field);
            if (status != TAUT_STATUS_OK && status != TAUT_STATUS_CANCELLED) return false;
        } else {
            taut_control_set_time_limit(shared, 1e6);
            taut_control_set_memory_limit(shared, 1u << 30);
            taut_control_set_callback(shared, NULL, NULL);
            if (!(taut_control_progress(shared) >= 0 && taut_control_progress(shared) <= 1)) return false;
            if (i == 40) taut_control_cancel(shared);
        }
    }
    return taut_control_is_cancelled(shared) || thread % 2;
}

static void one_control(void) {
    make_handles();
    CHECK(taut_control_new(&shared) == TAUT_STATUS_OK);
    CHECK(on_all_threads(meddle));
    taut_control_free(shared);
    free_handles();
}

/* No thread of the library outlives a call, so a child process has all that it needs. */
static void after_a_fork(void) {
    make_handles();
    double rows[3][5], again[3][5];
    const taut_output out = {.data = rows, .count = 3, .stride = sizeof rows[0]};
    const taut_output out_again = {.data = again, .count = 3, .stride = sizeof again[0]};
    CHECK(taut_exact_distance_rows(handles[EXACT].exact, &every_source, each, 3, NULL, out) == TAUT_STATUS_OK);
    const pid_t child = fork();
    if (child == 0) {
        taut_exact_distance_rows(handles[EXACT].exact, &every_source, each, 3, NULL, out_again);
        _exit(memcmp(rows, again, sizeof rows) == 0 ? 0 : 1);
    }
    int status = -1;
    CHECK(child > 0 && waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    free_handles();
}

const test tests[] = {
    TEST(every_function),
    TEST(one_solver),
    TEST(last_errors),
    TEST(one_control),
    TEST(after_a_fork),
    {0},
};
