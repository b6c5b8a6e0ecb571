/* A program of another project: distances across the unit square, exact and by heat. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <taut.h>

int main(void) {
    double xyz[] = {0, 0, 0,  1, 0, 0,  1, 1, 0,  0, 1, 0}, along[4] = {0}, warm[4] = {0};
    uint32_t corners[] = {0, 1, 3,  1, 2, 3}, vertex = 0;
    taut_sources from = {.struct_size = sizeof from, .vertices = {.data = &vertex, .count = 1}};
    taut_output exact_rows = {.data = along, .count = 4}, heat_rows = {.data = warm, .count = 4};
    taut_mesh *mesh = NULL;
    taut_exact *exact = NULL;
    taut_exact_field *exact_field = NULL;
    taut_heat *heat = NULL;
    taut_heat_field *heat_field = NULL;
    taut_status status = taut_mesh_new((taut_input){.data = xyz, .count = 4},
                                       (taut_input){.data = corners, .count = 2}, &mesh);
    if (!status) status = taut_exact_new(mesh, &exact);
    if (!status) status = taut_exact_field_new(exact, &from, NULL, NULL, &exact_field);
    if (!status) status = taut_exact_field_distances(exact_field, NULL, exact_rows);
    if (!status) status = taut_heat_new(mesh, NULL, NULL, &heat);
    if (!status) status = taut_heat_field_new(heat, &from, NULL, &heat_field);
    if (!status) status = taut_heat_field_distances(heat_field, heat_rows);
    if (status) fprintf(stderr, "%s\n", taut_last_error(NULL));
    printf("taut %s: across the square %g, by heat %g\n", taut_version(), along[2], warm[2]);
    taut_heat_field_free(heat_field);
    taut_heat_free(heat);
    taut_exact_field_free(exact_field);
    taut_exact_free(exact);
    taut_mesh_free(mesh);
    return status || taut_abi() != TAUT_ABI || fabs(along[2] - sqrt(2)) > 1e-15 || fabs(warm[2] - sqrt(2)) > 0.5;
}
