/* Every function of taut.h, asked the same questions: what it does with NULL, with views of every kind and of none, with
 * structs of another version, with a control that has ended, and when the library itself fails. */
#if defined(__linux__)
#define _GNU_SOURCE
#endif
#include "functions.h"

#include <errno.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

/* How many tests asked each function, and how often it was called. */
typedef struct {
    size_t tests, calls;
} tally;
static tally *tallies;

static void for_each_function(void (*ask)(call *it)) {
    for (size_t i = 0; i < function_count; i++) {
        static call it;
        const int before = failures;
        prepare(&it, functions + i);
        ask(&it);
        tallies[i].tests += it.times > 0;
        tallies[i].calls += it.times;
        if (failures > before) fprintf(stderr, "in %s\n", functions[i].name);
    }
}

/* A test that asks every function; `it` is a call that will succeed. */
#define ROW(name)                                               \
    static void ask_##name(call *it);                           \
    static void name(void) { for_each_function(ask_##name); }   \
    static void ask_##name(call *it)

/* The call must fail for `why`, with a message that has `mention`, and write nothing. */
static void refuses(call *it, taut_reason why, const char *mention) {
    make(it);
    CHECK(it->status != TAUT_STATUS_OK && last_is(why, TAUT_ELEMENT_NONE, 0));
    CHECK(strstr(taut_last_error(NULL), mention) != NULL);
    CHECK(is_untouched(it));
}

/* The call must fail with nothing written, or succeed. */
static void answers(call *it) {
    make(it);
    CHECK(it->status == TAUT_STATUS_OK || is_untouched(it));
    clear(it);
}

/* What a call that succeeds gives. */
static void give(call *expected, const function *function) {
    prepare(expected, function);
    make(expected);
    CHECK(expected->status == TAUT_STATUS_OK);
}

static bool same(const call *a, const call *b) {
    return a->status == b->status && memcmp(a->outputs, b->outputs, sizeof a->outputs) == 0 &&
           memcmp(a->records, b->records, sizeof a->records) == 0 && memcmp(a->contents, b->contents, sizeof a->contents) == 0;
}

/* A view that the call reads. */
typedef struct {
    shape rows;
    taut_input *view;
} input;

enum { MOST_INPUTS = INPUTS + 8 + 3 };

/* All of them, those in structs included. */
static size_t inputs_of(call *it, input *found) {
    taut_sources *s = &it->sources;
    taut_targets *t = &it->targets;
    const input of_sources[] = {
        {{"sources.vertices", INDEX, 1, 1, NULL}, &s->vertices},
        {{"sources.offsets", REAL, 1, 3, NULL}, &s->offsets},
        {{"sources.faces", INDEX, 1, 1, NULL}, &s->faces},
        {{"sources.barycentrics", REAL, 3, 1, NULL}, &s->barycentrics},
        {{"sources.curve_offsets", INDEX, 1, 2, NULL}, &s->curve_offsets},
        {{"sources.curve_faces", INDEX, 1, 2, NULL}, &s->curve_faces},
        {{"sources.curve_barycentrics", REAL, 3, 2, NULL}, &s->curve_barycentrics},
        {{"sources.curve_closed", INDEX, 1, 1, NULL}, &s->curve_closed},
    };
    const input of_targets[] = {
        {{"targets.vertices", INDEX, 1, 1, NULL}, &t->vertices},
        {{"targets.faces", INDEX, 1, 1, NULL}, &t->faces},
        {{"targets.barycentrics", REAL, 3, 1, NULL}, &t->barycentrics},
    };
    size_t count = 0;
    for (size_t i = 0; i < INPUTS && it->function->inputs[i].name; i++) {
        found[count++] = (input){it->function->inputs[i], it->given.inputs + i};
    }
    for (size_t i = 0; it->given.sources && i < sizeof of_sources / sizeof *of_sources; i++) found[count++] = of_sources[i];
    const bool has_targets = it->given.targets || it->given.exact_options;
    for (size_t i = 0; has_targets && i < sizeof of_targets / sizeof *of_targets; i++) found[count++] = of_targets[i];
    return count;
}

/* For each view that is read: what `ask` asks of it, and then the view is as it was. */
static void for_each_input(call *it, void (*ask)(call *it, const input *in)) {
    input found[MOST_INPUTS];
    const size_t count = inputs_of(it, found);
    for (size_t i = 0; i < count; i++) {
        const taut_input before = *found[i].view;
        ask(it, found + i);
        *found[i].view = before;
    }
}

/* The same for each view that is filled. */
static void for_each_output(call *it, void (*ask)(call *it, const shape *rows, taut_output *out)) {
    for (size_t i = 0; i < OUTPUTS && it->function->outputs[i].name; i++) {
        const taut_output before = it->given.outputs[i];
        ask(it, it->function->outputs + i, it->given.outputs + i);
        it->given.outputs[i] = before;
    }
}

static const taut_type reals[] = {TAUT_TYPE_F32, TAUT_TYPE_F64, 0};
static const taut_type integers[] = {TAUT_TYPE_U16, TAUT_TYPE_U32, TAUT_TYPE_U64, TAUT_TYPE_I32, TAUT_TYPE_I64, 0};

static const taut_type *types_of(element element) { return element == REAL ? reals : integers; }

static size_t size_of(taut_type type) {
    static const size_t sizes[] = {0, 4, 8, 2, 4, 8, 4, 8};
    return sizes[type];
}

/* A number as the bytes of a type, and back. */
static void encode(double number, taut_type type, unsigned char *bytes) {
    const float f32 = (float)number;
    const int64_t i64 = type > TAUT_TYPE_F64 ? (int64_t)number : 0; /* little-endian: its first bytes are the narrow one */
    const void *from = type == TAUT_TYPE_F32 ? (const void *)&f32 : type == TAUT_TYPE_F64 ? (const void *)&number : &i64;
    memcpy(bytes, from, size_of(type));
}

static double decode(const unsigned char *bytes, taut_type type) {
    float f32;
    double f64;
    int64_t i64 = 0;
    if (type == TAUT_TYPE_F32) return memcpy(&f32, bytes, sizeof f32), f32;
    if (type == TAUT_TYPE_F64) return memcpy(&f64, bytes, sizeof f64), f64;
    memcpy(&i64, bytes, size_of(type));
    const int64_t ones = (int64_t)(UINT64_MAX >> (64 - 8 * size_of(type)));
    return i64 == ones ? -1 : (double)i64;
}

ROW(succeeds) {
    make(it);
    CHECK(it->status == TAUT_STATUS_OK);
    CHECK(is_untouched(it) == (!it->function->outputs[0].name && !it->function->records[0]));
}

ROW(null_handles) {
    const arguments before = it->given;
    if (it->function->self) {
        it->given.self.any = NULL;
        refuses(it, TAUT_REASON_NULL_POINTER, "` is NULL");
        it->given = before;
    }
    if (it->function->takes & OTHER_MESH) {
        it->given.mesh = NULL;
        refuses(it, TAUT_REASON_NULL_POINTER, "`mesh` is NULL");
        it->given = before;
    }
    if (it->function->makes) {
        it->given.made = NULL;
        refuses(it, TAUT_REASON_NULL_POINTER, "`out` is NULL");
    }
}

ROW(null_structs) {
    const arguments before = it->given;
    if (it->function->takes & SOURCES) {
        it->given.sources = NULL;
        refuses(it, TAUT_REASON_NULL_POINTER, "`sources` is NULL");
        it->given = before;
    }
    for (size_t i = 0; i < 2 && it->function->records[i]; i++) {
        it->given.records[i] = NULL;
        refuses(it, TAUT_REASON_NULL_POINTER, "` is NULL");
        it->given = before;
    }
    /* These may all be NULL; no targets are all vertices. */
    if (it->function->takes & SOURCES_OR_NULL) it->given.sources = NULL;
    it->given.targets = NULL;
    it->given.heat_options = NULL;
    it->given.exact_options = NULL;
    it->given.control = NULL;
    if (it->function->takes & TARGETS) it->given.outputs[0].count = 5;
    make(it);
    CHECK(it->status == TAUT_STATUS_OK);
}

static void of_no_memory(call *it, const input *in) {
    char mention[64];
    sprintf(mention, "%s.data`", in->rows.name);
    in->view->data = NULL;
    refuses(it, TAUT_REASON_NULL_POINTER, mention);
    in->view->count = 0;
    answers(it);
}

ROW(inputs_of_no_memory) { for_each_input(it, of_no_memory); }

static void without_end(call *it, const input *in) {
    const size_t row = row_bytes(&in->rows), counts[] = {SIZE_MAX, SIZE_MAX / row + 2, PTRDIFF_MAX / row + 1};
    for (size_t i = 0; i < 3; i++) {
        in->view->count = counts[i];
        refuses(it, TAUT_REASON_TOO_MANY_ELEMENTS, in->rows.name);
    }
    in->view->count = 3;
    in->view->stride = SIZE_MAX / 2;
    refuses(it, TAUT_REASON_TOO_MANY_ELEMENTS, in->rows.name);
}

ROW(inputs_without_end) { for_each_input(it, without_end); }

/* Of the other family, and unknown ones. */
static const taut_type *wrong_types(element element) {
    static const taut_type for_reals[] = {TAUT_TYPE_U16, TAUT_TYPE_U32, TAUT_TYPE_U64, TAUT_TYPE_I32, TAUT_TYPE_I64,
                                          TAUT_TYPE_I64 + 1, UINT32_MAX, 0};
    static const taut_type for_integers[] = {TAUT_TYPE_F32, TAUT_TYPE_F64, TAUT_TYPE_I64 + 1, UINT32_MAX, 0};
    return element == REAL ? for_reals : for_integers;
}

static void of_a_wrong_type(call *it, const input *in) {
    char mention[64];
    sprintf(mention, "%s.type`", in->rows.name);
    for (const taut_type *type = wrong_types(in->rows.element); *type; type++) {
        in->view->type = *type;
        refuses(it, TAUT_REASON_BAD_ARGUMENT, mention);
    }
    in->view->type = 0;
    in->view->reserved = 1;
    sprintf(mention, "%s.reserved`", in->rows.name);
    refuses(it, TAUT_REASON_BAD_ARGUMENT, mention);
}

ROW(inputs_of_a_wrong_type) { for_each_input(it, of_a_wrong_type); }

/* Off alignment, with gaps, in every type: the same answer. */
static void in_any_packing(call *it, const input *in) {
    enum { GAP = 5 };
    static call expected;
    unsigned char bytes[1 + 16 * (3 * sizeof(double) + GAP)];
    const size_t width = in->rows.width;
    const double *from_reals = in->view->data;
    const uint32_t *from_integers = in->view->data;
    give(&expected, it->function);
    for (const taut_type *type = types_of(in->rows.element); *type; type++) {
        const size_t stride = width * size_of(*type) + GAP;
        for (size_t i = 0; i < in->view->count * width; i++) {
            const double number = in->rows.element == REAL ? from_reals[i] : from_integers[i];
            encode(number, *type, bytes + 1 + i / width * stride + i % width * size_of(*type));
        }
        *in->view = (taut_input){.data = bytes + 1, .count = in->view->count, .stride = stride, .type = *type};
        make(it);
        CHECK(same(it, &expected));
    }
}

ROW(inputs_in_any_packing) { for_each_input(it, in_any_packing); }

static void too_small(call *it, const shape *rows, taut_output *out) {
    out->count = rows->count - 1;
    refuses(it, TAUT_REASON_BUFFER_TOO_SMALL, rows->name);
    *out = (taut_output){0};
    refuses(it, TAUT_REASON_BUFFER_TOO_SMALL, rows->name);
    out->count = rows->count;
    refuses(it, TAUT_REASON_NULL_POINTER, rows->name);
}

ROW(outputs_too_small) { for_each_output(it, too_small); }

static void that_make_no_sense(call *it, const shape *rows, taut_output *out) {
    const taut_output before = *out;
    char mention[64];
    sprintf(mention, "%s.type`", rows->name);
    for (const taut_type *type = wrong_types(rows->element); *type; type++) {
        out->type = *type;
        refuses(it, TAUT_REASON_BAD_ARGUMENT, mention);
    }
    *out = before;
    out->reserved = 1;
    sprintf(mention, "%s.reserved`", rows->name);
    refuses(it, TAUT_REASON_BAD_ARGUMENT, mention);
    *out = before;
    for (out->stride = 1; out->stride < row_bytes(rows); out->stride++) refuses(it, TAUT_REASON_BAD_ARGUMENT, "overlap");

    const size_t counts[] = {SIZE_MAX, SIZE_MAX / row_bytes(rows) + 2, PTRDIFF_MAX / row_bytes(rows) + 1};
    for (size_t i = 0; i < 3; i++) {
        *out = before;
        out->count = counts[i];
        refuses(it, TAUT_REASON_TOO_MANY_ELEMENTS, rows->name);
    }
    out->count = rows->count < 3 ? 3 : rows->count;
    out->stride = SIZE_MAX / 2;
    refuses(it, TAUT_REASON_TOO_MANY_ELEMENTS, rows->name);
}

ROW(outputs_that_make_no_sense) { for_each_output(it, that_make_no_sense); }

/* Off alignment, with gaps and a row too many, in every type: the same numbers, and all other bytes as they were. */
static void filled_in_any_packing(call *it, const shape *rows, taut_output *out) {
    enum { GAP = 3 };
    static call expected;
    give(&expected, it->function);
    const unsigned char *plain = expected.given.outputs[out - it->given.outputs].data;
    const taut_type of_plain = rows->element == REAL ? TAUT_TYPE_F64 : TAUT_TYPE_U32;
    for (const taut_type *type = types_of(rows->element); *type; type++) {
        const size_t size = size_of(*type), stride = rows->width * size + GAP;
        unsigned char bytes[ROOM];
        memset(bytes, UNTOUCHED, sizeof bytes);
        *out = (taut_output){.data = bytes + 1, .count = rows->count + 1, .stride = stride, .type = *type};
        make(it);
        CHECK(it->status == TAUT_STATUS_OK && bytes[0] == UNTOUCHED);
        for (size_t i = 0; i < rows->count * rows->width; i++) {
            const double number = decode(plain + i * size_of(of_plain), of_plain);
            const double here = decode(bytes + 1 + i / rows->width * stride + i % rows->width * size, *type);
            CHECK(here == (*type == TAUT_TYPE_F32 ? (double)(float)number : number));
        }
        for (size_t i = 0; i < rows->count; i++) CHECK(is_all(bytes + 1 + (i + 1) * stride - GAP, GAP, UNTOUCHED));
        CHECK(is_all(bytes + 1 + rows->count * stride, sizeof bytes - 1 - rows->count * stride, UNTOUCHED));
    }
}

ROW(outputs_in_any_packing) { for_each_output(it, filled_in_any_packing); }

/* An output may lie where an input does: all is read before anything is written. */
static void over_an_input(call *it, const input *in) {
    static call expected;
    give(&expected, it->function);
    for (size_t i = 0; i < OUTPUTS && it->function->outputs[i].name; i++) {
        const taut_input before = *in->view;
        clear(it);
        memcpy(it->outputs[i], before.data, before.count * row_bytes(&in->rows));
        in->view->data = it->outputs[i];
        make(it);
        const size_t filled = it->function->outputs[i].count * row_bytes(it->function->outputs + i);
        CHECK(it->status == TAUT_STATUS_OK && memcmp(it->outputs[i], expected.outputs[i], filled) == 0);
        *in->view = before;
    }
}

ROW(outputs_over_inputs) { for_each_input(it, over_an_input); }

/* A struct that the call reads: of every older size, of newer ones, and of none. */
static void of_any_version(call *it, const void **place, size_t size) {
    static call expected;
    unsigned char bytes[ROOM] = {0};
    const void *before = *place;
    if (!before) return;
    give(&expected, it->function);
    memcpy(bytes, before, size);
    *place = bytes;
    for (size_t stated = sizeof stated; stated <= size; stated += sizeof stated) {
        memcpy(bytes, &stated, sizeof stated);
        answers(it);
    }
    for (size_t stated = 0; stated < sizeof stated; stated++) {
        memcpy(bytes, &stated, sizeof stated);
        refuses(it, TAUT_REASON_BAD_ARGUMENT, "struct_size");
    }
    for (size_t stated = size; stated <= size + 16; stated++) {
        memcpy(bytes, &stated, sizeof stated);
        clear(it);
        make(it);
        CHECK(same(it, &expected));
        if (stated == size) continue;
        clear(it);
        bytes[stated - 1] = 1;
        refuses(it, TAUT_REASON_BAD_ARGUMENT, "does not know");
        bytes[stated - 1] = 0;
    }
    *place = before;
}

ROW(structs_of_any_version) {
    arguments *given = &it->given;
    of_any_version(it, (const void **)&given->sources, sizeof *given->sources);
    of_any_version(it, (const void **)&given->targets, sizeof *given->targets);
    of_any_version(it, (const void **)&given->heat_options, sizeof *given->heat_options);
    of_any_version(it, (const void **)&given->exact_options, sizeof *given->exact_options);
    if (given->exact_options) of_any_version(it, (const void **)&it->exact_options.targets, sizeof(taut_targets));
}

/* A struct that the call fills: only the bytes that it has, and zeroes where nothing is known. */
ROW(records_of_any_version) {
    static call expected;
    if (!it->function->record_has_a_size) return;
    give(&expected, it->function);
    const size_t size = it->function->records[0];
    for (size_t stated = 0; stated <= size + 16; stated++) {
        memset(it->records[0], UNTOUCHED, ROOM);
        memcpy(it->records[0], &stated, sizeof stated);
        if (stated < sizeof stated) {
            refuses(it, TAUT_REASON_BAD_ARGUMENT, "struct_size");
            continue;
        }
        make(it);
        const size_t known = stated < size ? stated : size, head = sizeof stated;
        CHECK(it->status == TAUT_STATUS_OK && memcmp(it->records[0], &stated, head) == 0);
        CHECK(memcmp(it->records[0] + head, expected.records[0] + head, known - head) == 0);
        CHECK(is_all(it->records[0] + known, stated - known, 0));
        CHECK(is_all(it->records[0] + stated, ROOM - stated, UNTOUCHED));
    }
}

static taut_control *new_control(void) {
    taut_control *control = NULL;
    CHECK(taut_control_new(&control) == TAUT_STATUS_OK);
    return control;
}

/* Cancels at its first call, and remembers when that was. */
static int cancel(double progress, void *seen) {
    *(double *)seen = progress;
    return 1;
}

ROW(controls_that_have_ended) {
    if (!(it->function->takes & TAKES_CONTROL)) return;
    taut_control *cancelled = new_control(), *late = new_control(), *cancelling = new_control();
    taut_control_cancel(cancelled);
    it->given.control = cancelled;
    refuses(it, TAUT_REASON_CANCELLED, "cancelled");

    CHECK(taut_control_set_time_limit(late, 1e-9) == TAUT_STATUS_OK);
    it->given.control = late;
    refuses(it, TAUT_REASON_TIME_LIMIT, "time limit");

    double seen = -1;
    CHECK(taut_control_set_callback(cancelling, cancel, &seen) == TAUT_STATUS_OK);
    it->given.control = cancelling;
    make(it);
    CHECK(seen >= 0 && seen <= 1 && taut_control_is_cancelled(cancelling));
    /* Other threads may have done all before the caller's looked; then there is nothing left to cancel. */
    CHECK(it->status == TAUT_STATUS_CANCELLED ? is_untouched(it) : it->status == TAUT_STATUS_OK && seen == 1);
    taut_control_free(cancelled);
    taut_control_free(late);
    taut_control_free(cancelling);
}

/* The clock of this program, the library included. Without one a time limit cannot be kept: a panic in the shipped library,
 * on all threads that look at the time. */
static bool clock_is_broken = false;

int clock_gettime(clockid_t clock, struct timespec *now) {
    if (!__atomic_load_n(&clock_is_broken, __ATOMIC_RELAXED)) return (int)syscall(SYS_clock_gettime, clock, now);
    errno = EINVAL;
    return -1;
}

static void break_clock(bool is_broken) { __atomic_store_n(&clock_is_broken, is_broken, __ATOMIC_RELAXED); }

ROW(panics_stop_at_the_border) {
    static call expected;
    if (!(it->function->takes & TAKES_CONTROL)) return;
    taut_control *control = new_control();
    CHECK(taut_control_set_time_limit(control, 1e9) == TAUT_STATUS_OK);
    it->given.control = control;
    break_clock(true);
    refuses(it, TAUT_REASON_PANIC, "a defect of the library");
    CHECK(it->status == TAUT_STATUS_INTERNAL);
    break_clock(false);

    /* What was in use is as good as before. */
    make(it);
    give(&expected, it->function);
    CHECK(same(it, &expected));
    taut_control_free(control);
}

static void getters_of_null(void) {
    for (const getter *it = getters; it < getters + getter_count; it++) {
        taut_last_error(NULL);
        CHECK(it->tell((handle){NULL}) == it->of_null);
        CHECK(last_is(TAUT_REASON_NULL_POINTER, TAUT_ELEMENT_NONE, 0));
        CHECK(taut_mesh_read(NULL, NULL) == TAUT_STATUS_INVALID_ARGUMENT); /* so that the next one has to say it again */
    }
}

static void frees_of_null(void) {
    for (kind k = MESH; k <= SPARSE; k++) freers[k].free((handle){NULL});
}

static bool is_in_a_table(const char *name) {
    static const char *const others[] = {"taut_abi", "taut_last_error", "taut_status_name", "taut_version"};
    bool found = false;
    for (size_t i = 0; i < function_count; i++) found |= strcmp(name, functions[i].name) == 0;
    for (size_t i = 0; i < getter_count; i++) found |= strcmp(name, getters[i].name) == 0;
    for (kind k = MESH; k <= SPARSE; k++) found |= strcmp(name, freers[k].name) == 0;
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) found |= strcmp(name, others[i]) == 0;
    return found;
}

/* Nothing that the library exports was left out. */
static void every_function_was_asked(void) {
    char name[128];
    FILE *symbols = fopen(TAUT_SYMBOLS, "r");
    CHECK(symbols != NULL);
    while (symbols && fscanf(symbols, "%127s", name) == 1) {
        const bool found = is_in_a_table(name);
        if (!found) fprintf(stderr, "%s is not in functions.c\n", name);
        CHECK(found);
    }
    if (symbols) fclose(symbols);
    for (size_t i = 0; i < function_count; i++) {
        printf("%2zu tests, %3zu calls of %s\n", tallies[i].tests, tallies[i].calls, functions[i].name);
    }
}

static void begin(void) {
    tallies = calloc(function_count, sizeof *tallies);
    make_handles();
}

static void end(void) {
    free_handles();
    free(tallies);
}

const test tests[] = {
    TEST(begin),
    TEST(succeeds),
    TEST(null_handles),
    TEST(null_structs),
    TEST(inputs_of_no_memory),
    TEST(inputs_without_end),
    TEST(inputs_of_a_wrong_type),
    TEST(inputs_in_any_packing),
    TEST(outputs_too_small),
    TEST(outputs_that_make_no_sense),
    TEST(outputs_in_any_packing),
    TEST(outputs_over_inputs),
    TEST(structs_of_any_version),
    TEST(records_of_any_version),
    TEST(controls_that_have_ended),
    TEST(panics_stop_at_the_border),
    TEST(getters_of_null),
    TEST(frees_of_null),
    TEST(every_function_was_asked),
    TEST(end),
    {0},
};
