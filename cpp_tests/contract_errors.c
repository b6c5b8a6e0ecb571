/* Versions, names and the last error. */
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

const test tests[] = {
    TEST(before_any_failure),
    TEST(versions_and_names),
    TEST(errors_stay_until_the_next),
    {0},
};
