/* Each kind of mistake that the sanitizers and valgrind are there to find, made on purpose: that they find it proves that
 * they look. */
#include "taut.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static taut_mesh *triangle(void) {
    const double xyz[] = {0, 0, 0, 3, 0, 0, 0, 4, 0};
    const uint32_t corners[] = {0, 1, 2};
    taut_mesh *mesh = NULL;
    taut_mesh_new((taut_input){.data = xyz, .count = 3}, (taut_input){.data = corners, .count = 1}, &mesh);
    return mesh;
}

/* The library is told of room for three rows where there are two: it is the library that writes beyond. */
static void overflow(void) {
    taut_mesh *mesh = triangle();
    double *two_rows = malloc(6 * sizeof *two_rows);
    taut_mesh_positions(mesh, (taut_output){.data = two_rows, .count = 3});
    free(two_rows);
    taut_mesh_free(mesh);
}

static void use_after_free(void) {
    taut_mesh *mesh = triangle();
    taut_mesh_free(mesh);
    printf("%zu vertices\n", taut_mesh_vertex_count(mesh));
}

/* A mesh that nobody frees; the pointer to it is overwritten. */
static void leak(void) {
    taut_mesh *volatile mesh = triangle();
    mesh = NULL;
    (void)mesh;
}

static void undefined(void) {
    volatile int bits = 40;
    printf("%d\n", 1 << bits);
}

/* One buffer, filled by two threads. */
static double shared[9];

static void *fill(void *mesh) {
    taut_mesh_positions(mesh, (taut_output){.data = shared, .count = 3});
    for (int i = 0; i < 1000; i++) shared[i % 9] += 1;
    return NULL;
}

static void race(void) {
    taut_mesh *mesh = triangle();
    pthread_t other;
    pthread_create(&other, NULL, fill, mesh);
    fill(mesh);
    pthread_join(other, NULL);
    taut_mesh_free(mesh);
}

int main(int count, char **arguments) {
    const char *which = count == 2 ? arguments[1] : "";
    if (!strcmp(which, "overflow")) overflow();
    if (!strcmp(which, "use_after_free")) use_after_free();
    if (!strcmp(which, "leak")) leak();
    if (!strcmp(which, "undefined")) undefined();
    if (!strcmp(which, "race")) race();
    return 0;
}
