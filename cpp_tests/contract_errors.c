/* Versions, names, the last error; structs that were never set. */
#include "contract.h"

/* Must run first: nothing has failed yet. */
static void before_any_failure(void) {
    taut_error error;
    memset(&error, 0xff, sizeof error);
    error.struct_size = sizeof error;
    CHECK(strcmp(taut_last_error(&error), "") == 0);
    CHECK(error.status == TAUT_STATUS_OK && error.reason == 0 && error.element == 0 && error.index == 0);
}

static void versions_and_names(void) {
    char version[32];
    sprintf(version, "%d.%d.%d", TAUT_VERSION_MAJOR, TAUT_VERSION_MINOR, TAUT_VERSION_PATCH);
    CHECK(strcmp(taut_version(), version) == 0);
    CHECK(taut_abi() == TAUT_ABI);
    CHECK(strcmp(taut_status_name(TAUT_STATUS_INVALID_MESH), "invalid mesh") == 0);
    for (int32_t status = TAUT_STATUS_OK; status <= TAUT_STATUS_LIMIT_REACHED; status++)
        CHECK(strcmp(taut_status_name(status), "unknown") != 0);
    CHECK(strcmp(taut_status_name(-1), "unknown") == 0);
    CHECK(strcmp(taut_status_name(TAUT_STATUS_LIMIT_REACHED + 1), "unknown") == 0);
}

static void errors_stay_until_the_next(void) {
    taut_mesh *mesh = rectangle();
    CHECK(taut_mesh_new(positions, triangles, NULL) == TAUT_STATUS_INVALID_ARGUMENT);
    CHECK(strstr(taut_last_error(NULL), "`out` is NULL") != NULL);
    CHECK(taut_mesh_vertex_count(mesh) == 5); /* a success */
    CHECK(last_is(TAUT_REASON_NULL_POINTER, TAUT_ELEMENT_NONE, 0));
    taut_mesh_free(mesh);

    /* A caller with an older struct, which ends after `reason`; and one with a newer struct. */
    struct {
        taut_error error;
        uint64_t newer;
    } detail;
    memset(&detail, 0xff, sizeof detail);
    detail.error.struct_size = offsetof(taut_error, element);
    taut_last_error(&detail.error);
    CHECK(detail.error.struct_size == offsetof(taut_error, element));
    CHECK(detail.error.status == TAUT_STATUS_INVALID_ARGUMENT && detail.error.reason == TAUT_REASON_NULL_POINTER);
    CHECK(detail.error.element == -1 && detail.newer == UINT64_MAX);
    detail.error.struct_size = sizeof detail;
    taut_last_error(&detail.error);
    CHECK(detail.error.element == TAUT_ELEMENT_NONE && detail.newer == 0);
}

/* A size that was never set is found, in structs that are read and in those that are filled. */
static void sizes_that_were_never_set(void) {
    taut_mesh *mesh = rectangle();
    taut_exact *exact = exact_rectangle();
    taut_exact_field *field = NULL;
    const size_t sizes[] = {0, sizeof(size_t) - 1, 4097, SIZE_MAX / 2, SIZE_MAX};
    for (size_t i = 0; i < 5; i++) {
        taut_sources from = from_zero;
        from.struct_size = sizes[i];
        CHECK_FAILS(taut_exact_field_new(exact, &from, NULL, NULL, &field), TAUT_REASON_BAD_ARGUMENT, 0, 0);
        CHECK(strstr(taut_last_error(NULL), "sources.struct_size") != NULL);
        taut_properties properties = {.mean_edge = -1};
        properties.struct_size = sizes[i];
        CHECK_FAILS(taut_mesh_properties(mesh, &properties), TAUT_REASON_BAD_ARGUMENT, 0, 0);
        CHECK(properties.struct_size == sizes[i] && properties.mean_edge == -1);
        taut_error error = {.struct_size = sizes[i], .reason = -1};
        taut_last_error(&error); /* which tells no one */
        CHECK(error.reason == -1);
    }
    taut_exact_free(exact);
    taut_mesh_free(mesh);
}

static void what_is_reserved_is_zero(void) {
    taut_mesh *mesh = NULL;
    double d[15] = {-1};
    taut_input in = positions;
    taut_output out = room(d, 5);
    in.reserved = 1;
    CHECK_FAILS(taut_mesh_new(in, triangles, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "positions.reserved") != NULL);
    mesh = rectangle();
    out.reserved = 1;
    CHECK_FAILS(taut_mesh_positions(mesh, out), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(d[0] == -1);
    taut_mesh_free(mesh);
}

const test tests[] = {
    TEST(before_any_failure),
    TEST(versions_and_names),
    TEST(errors_stay_until_the_next),
    TEST(sizes_that_were_never_set),
    TEST(what_is_reserved_is_zero),
    {0},
};
