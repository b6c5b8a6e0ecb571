/* The minimal program: reads a mesh and prints the exact distance of each vertex from one of them.
 *
 *     distance MESH VERTEX
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <taut.h>

int main(int argc, char **argv) {
    if (argc != 3) {
        fprintf(stderr, "usage: distance MESH VERTEX\n");
        return 2;
    }
    int64_t vertex = strtoimax(argv[2], NULL, 10); /* a negative or too large one is an error of the library */
    taut_sources from = {.struct_size = sizeof from, .vertices = {.data = &vertex, .count = 1, .type = TAUT_TYPE_I64}};
    taut_mesh *mesh = NULL;
    taut_exact *exact = NULL;
    taut_exact_field *field = NULL;
    double *distances = NULL;
    size_t count = 0;

    taut_status status = taut_mesh_read(argv[1], &mesh);
    if (!status) status = taut_exact_new(mesh, &exact);
    if (!status) status = taut_exact_field_new(exact, &from, NULL, NULL, &field);
    if (!status) {
        count = taut_mesh_vertex_count(mesh);
        distances = calloc(count, sizeof *distances);
        status = taut_exact_field_distances(field, NULL, (taut_output){.data = distances, .count = count});
    }
    if (status) fprintf(stderr, "distance: %s\n", taut_last_error(NULL));
    for (size_t v = 0; !status && v < count; v++) printf("%.17g\n", distances[v]);

    free(distances);
    taut_exact_field_free(field);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
    return status ? 1 : 0;
}
