/* The functions of taut.h as data, so that one test can ask the same of all of them. */
#ifndef TAUT_FUNCTIONS_H
#define TAUT_FUNCTIONS_H

#include "contract.h"

typedef enum { NOTHING, MESH, CLOSEST, CONTROL, CURVES, EXACT, EXACT_FIELD, HEAT, HEAT_FIELD, REPORT, SPARSE } kind;

/* A handle of any kind. */
typedef union {
    void *any;
    taut_mesh *mesh;
    taut_closest *closest;
    taut_control *control;
    taut_curves *curves;
    taut_exact *exact;
    taut_exact_field *exact_field;
    taut_heat *heat;
    taut_heat_field *heat_field;
    taut_report *report;
    taut_sparse_distances *sparse;
} handle;

typedef enum { REAL, INDEX } element;

/* What the rows of a view are: `count` rows of `width` elements; of an output, as many as are needed. */
typedef struct {
    const char *name;
    element element;
    size_t width, count;
    const void *data; /* of an input: doubles or uint32_t without gaps */
} shape;

enum { INPUTS = 3, OUTPUTS = 3 };

/* What a call is given; a function takes what it has a parameter for. */
typedef struct {
    handle self;           /* its first parameter */
    const taut_mesh *mesh; /* its second, where that is another mesh */
    taut_input inputs[INPUTS];
    const taut_sources *sources;
    const taut_targets *targets;
    const taut_heat_options *heat_options;
    const taut_exact_options *exact_options;
    const taut_control *control;
    taut_output outputs[OUTPUTS];
    void *records[2]; /* structs and numbers that it fills */
    handle *made;
} arguments;

/* What else a function takes. All but SOURCES and OTHER_MESH may be NULL. */
enum {
    SOURCES = 1,
    SOURCES_OR_NULL = 2,
    TARGETS = 4,
    HEAT_OPTIONS = 8,
    EXACT_OPTIONS = 16,
    TAKES_CONTROL = 32,
    OTHER_MESH = 64
};

typedef struct {
    const char *name;
    taut_status (*call)(const arguments *given);
    kind self, makes;
    unsigned takes;
    shape inputs[INPUTS], outputs[OUTPUTS];
    size_t records[2];      /* their sizes */
    bool record_has_a_size; /* the first one starts with struct_size */
} function;

/* Functions that return a status. */
extern const function functions[];
extern const size_t function_count;

/* Functions that tell a value of a handle; 0 of NULL. */
typedef struct {
    const char *name;
    kind self;
    double (*tell)(handle self);
    double of_null;
} getter;
extern const getter getters[];
extern const size_t getter_count;

/* How to free each kind. */
typedef struct {
    const char *name;
    void (*free)(handle it);
} freer;
extern const freer freers[SPARSE + 1];

/* One handle of each kind, all of the rectangle. */
extern handle handles[SPARSE + 1];
void make_handles(void);
void free_handles(void);

/* What a handle tells, as bits; what is not filled is 0. */
enum { MOST_CONTENTS = 64 };
void contents_of(kind kind, handle it, double contents[MOST_CONTENTS]);

/* A vertex, a point and a curve in the rectangle, each with a start distance; a vertex and a point. */
extern const taut_sources every_source;
extern const taut_targets every_target;

/* A call that is being made: what it is given, in memory of its own, and what came of it. */
enum { ROOM = 1024, UNTOUCHED = 0xab };
typedef struct {
    const function *function;
    arguments given;
    taut_sources sources;
    taut_targets targets;
    taut_heat_options heat_options;
    taut_exact_options exact_options;
    unsigned char outputs[OUTPUTS][ROOM], records[2][ROOM];
    handle made;
    taut_status status;
    double contents[MOST_CONTENTS]; /* of what it made */
    size_t times;                   /* how often it was made */
} call;

/* A call of `function` that will succeed, with outputs as large as needed. */
void prepare(call *it, const function *function);

/* Nothing is written yet. */
void clear(call *it);

/* Makes the call, and frees what it makes. */
void make(call *it);

/* All of `count` bytes are `value`. */
bool is_all(const unsigned char *bytes, size_t count, unsigned char value);

/* Nothing was written to outputs and records. */
bool is_untouched(const call *it);

/* Bytes of a row without gaps. */
size_t row_bytes(const shape *rows);

#endif
