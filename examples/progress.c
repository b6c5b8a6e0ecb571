/* A long computation with a progress bar, which Ctrl-C ends in good order: prints how far the farthest vertex is.
 *
 *     progress MESH VERTEX
 */
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <taut.h>

static volatile sig_atomic_t is_interrupted = 0;

static void interrupt(int number) {
    (void)number;
    is_interrupted = 1;
}

/* The library calls this now and then, on the thread of main. Any answer but 0 cancels. */
static int show(double progress, void *user) {
    const char bar[] = "########################################";
    int *shown = user, percent = (int)(100 * progress);
    if (percent != *shown) fprintf(stderr, "\r[%-40.*s] %3d %%", percent * 40 / 100, bar, percent);
    *shown = percent;
    return is_interrupted;
}

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: progress MESH VERTEX\n");
        return 2;
    }
    int64_t vertex = strtoimax(argv[2], NULL, 10);
    taut_sources from = {.struct_size = sizeof from, .vertices = {.data = &vertex, .count = 1, .type = TAUT_TYPE_I64}};
    taut_mesh *mesh = NULL;
    taut_exact *exact = NULL;
    taut_exact_field *field = NULL;
    taut_control *control = NULL;
    double *distances = NULL, farthest = 0;
    size_t count = 0;
    int shown = -1;

    taut_status status = taut_mesh_read(argv[1], &mesh);
    if (!status) status = taut_exact_new(mesh, &exact);
    if (!status) status = taut_control_new(&control);
    if (!status) status = taut_control_set_callback(control, show, &shown);
    signal(SIGINT, interrupt);
    if (!status) status = taut_exact_field_new(exact, &from, NULL, control, &field);
    if (shown >= 0) fputc('\n', stderr);
    if (!status) {
        count = taut_mesh_vertex_count(mesh);
        distances = calloc(count, sizeof *distances);
        status = taut_exact_field_distances(field, NULL, (taut_output){.data = distances, .count = count});
    }
    if (status) fprintf(stderr, "progress: %s\n", taut_last_error(NULL));
    for (size_t v = 0; !status && v < count; v++)
        if (isfinite(distances[v]) && distances[v] > farthest) farthest = distances[v];
    if (!status) printf("%.17g\n", farthest);

    free(distances);
    taut_exact_field_free(field);
    taut_control_free(control);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
    return status == TAUT_STATUS_CANCELLED ? 130 : status ? 1 : 0; /* 130 is what shells say of Ctrl-C */
}
