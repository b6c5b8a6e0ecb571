/* What the contract tests share: checks, small meshes, views. Each contract_*.c is a program; contract.c is its main. */
#ifndef TAUT_CONTRACT_H
#define TAUT_CONTRACT_H

#include "taut.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The tests of a program, in a table that ends with an empty row. */
typedef struct {
    const char *name;
    void (*run)(void);
} test;
extern const test tests[];
#define TEST(function) {#function, function}

/* How many checks have failed. */
extern int failures;

#define CHECK(condition)                                                                                          \
    do {                                                                                                          \
        if (!(condition)) {                                                                                       \
            fprintf(stderr, "%s:%d: %s [%s]\n", __FILE__, __LINE__, #condition, taut_last_error(NULL));           \
            failures++;                                                                                           \
        }                                                                                                         \
    } while (0)

/* A call that must fail for `why`, about element `kind` number `which`. */
#define CHECK_FAILS(call, why, kind, which) CHECK((call) != TAUT_STATUS_OK && last_is(why, kind, which))
bool last_is(taut_reason reason, taut_element element, uint64_t index);

/* A rectangle of 3 by 4, diagonal 5, and a vertex that no triangle uses. */
extern const double xyz[15];
extern const uint32_t corners[6];
extern const taut_input positions, triangles;
taut_mesh *rectangle(void);
taut_exact *exact_rectangle(void);

/* Of each vertex, its distance along x; none for the last. */
extern const double along_x[5];
extern const taut_input values;
/* Isolines of these, at x = 1.5 and x = 0.75, each over both triangles. */
taut_curves *two_lines(void);

extern const uint32_t zero;
/* Each source makes a set of its own. */
extern const taut_input each;
extern const taut_sources from_zero;
bool is_rectangle_field(const double *d);

/* The distances in the rectangle, of a field that is forgotten at once. */
taut_status field_of(const taut_exact *exact, const taut_sources *sources, double *d);
taut_status heat_distances(const taut_heat *heat, const taut_sources *from, double *d);

/* A field in the rectangle. */
taut_exact_field *field_with(const taut_sources *sources, const taut_exact_options *options);
extern const taut_exact_options keeping;

/* At (0.75, 1) in the first triangle: 1.25 from vertex 0 and 3.75 from vertex 2. */
extern const uint32_t face_zero;
extern const double inside[3];
/* At vertex 2, and at (2.25, 3): both in the second triangle. */
extern const uint32_t two_faces[2];
extern const double two_weights[6];

/* Targets in a call. */
#define VERTICES(v) (&(const taut_targets){.struct_size = sizeof(taut_targets), .vertices = (v)})
#define POINTS(f, b) (&(const taut_targets){.struct_size = sizeof(taut_targets), .faces = (f), .barycentrics = (b)})

/* Hills of `squares` by `squares`; of SQUARES, the exact method works for a while, which in valgrind takes fewer. */
#ifndef TAUT_SQUARES
#define TAUT_SQUARES 300
#endif
enum { SQUARES = TAUT_SQUARES, HILL_VERTICES = (SQUARES + 1) * (SQUARES + 1) };
taut_mesh *hills(uint32_t squares);

/* What a callback has seen. */
typedef struct {
    int calls;
    int cancel_at; /* 0: never */
    pthread_t thread;
    bool on_one_thread;
    double progress;
} witness;
int watch(double progress, void *user);

/* Copies out what the curves have, at most four curves of six points together. */
typedef struct {
    uint32_t offsets[5], faces[6], closed[4], levels[4];
    double positions[18];
} drawing;
drawing drawn(taut_curves *curves);
bool is_at(const double *position, double x, double y);

/* Views without gaps. */
static inline taut_input scalars(const double *data, size_t count) { return (taut_input){.data = data, .count = count}; }

static inline taut_input indices(const uint32_t *data, size_t count) { return (taut_input){.data = data, .count = count}; }

static inline taut_input typed_input(const void *data, size_t count, taut_type type) {
    return (taut_input){.data = data, .count = count, .type = type};
}

static inline taut_output room(double *data, size_t count) { return (taut_output){.data = data, .count = count}; }

static inline taut_output typed(void *data, size_t count, taut_type type) {
    return (taut_output){.data = data, .count = count, .type = type};
}

#endif
