/* Meshes from every packing, meshes that are refused, what their reports tell. */
#include "contract.h"

static void empty_mesh(void) {
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){0}, (taut_input){0}, &mesh) == TAUT_STATUS_OK);
    CHECK(mesh != NULL && taut_mesh_vertex_count(mesh) == 0 && taut_mesh_triangle_count(mesh) == 0);
    CHECK(taut_mesh_positions(mesh, (taut_output){0}) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
}

static void bad_meshes(void) {
    taut_mesh *mesh = NULL;
    const uint32_t beyond[] = {0, 1, 3, 1, 2, 5};
    const int64_t negative[] = {0, 1, 3, 1, -2, 3};
    double nan_xyz[15];
    memcpy(nan_xyz, xyz, sizeof xyz);
    nan_xyz[3 * 4] = NAN; /* of the vertex that no triangle uses: fine */

    CHECK_FAILS(taut_mesh_new(positions, (taut_input){.data = beyond, .count = 2}, &mesh),
                TAUT_REASON_INDEX_OUT_OF_RANGE, TAUT_ELEMENT_FACE, 1);
    CHECK_FAILS(taut_mesh_new(positions, (taut_input){.data = negative, .count = 2, .type = TAUT_TYPE_I64}, &mesh),
                TAUT_REASON_INDEX_OUT_OF_RANGE, TAUT_ELEMENT_FACE, 1);
    CHECK(taut_mesh_new((taut_input){.data = nan_xyz, .count = 5}, triangles, &mesh) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
    nan_xyz[3 * 2 + 1] = INFINITY;
    CHECK_FAILS(taut_mesh_new((taut_input){.data = nan_xyz, .count = 5}, triangles, &mesh),
                TAUT_REASON_NON_FINITE_COORDINATE, TAUT_ELEMENT_VERTEX, 2);

    /* Sizes that no memory has, types that are none. */
    taut_input huge = positions;
    huge.stride = SIZE_MAX / 2;
    CHECK(taut_mesh_new(huge, triangles, &mesh) == TAUT_STATUS_TOO_LARGE);
    huge.count = SIZE_MAX;
    huge.stride = 0;
    CHECK(taut_mesh_new(huge, triangles, &mesh) == TAUT_STATUS_TOO_LARGE);
    taut_input bad_type = positions;
    bad_type.type = TAUT_TYPE_U32;
    CHECK_FAILS(taut_mesh_new(bad_type, triangles, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    bad_type = triangles;
    bad_type.type = TAUT_TYPE_F64;
    CHECK_FAILS(taut_mesh_new(positions, bad_type, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    bad_type.type = 4000000000u;
    CHECK_FAILS(taut_mesh_new(positions, bad_type, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(strstr(taut_last_error(NULL), "triangles.type") != NULL);

    CHECK_FAILS(taut_mesh_read(NULL, &mesh), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(taut_mesh_read("/no/such/mesh.off", &mesh) == TAUT_STATUS_IO && mesh == NULL);
    CHECK_FAILS(taut_mesh_read("\xff.off", &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
}

static void ignored_triangles(void) {
    const uint32_t repeated[] = {0, 1, 3, 2, 2, 1, 1, 2, 3};
    taut_mesh *mesh = NULL;
    int64_t ignored[2] = {-7, -7};
    const taut_output out = {.data = ignored, .count = 2, .type = TAUT_TYPE_I64};
    CHECK(taut_mesh_new(positions, (taut_input){.data = repeated, .count = 3}, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_triangle_count(mesh) == 3 && taut_mesh_ignored_count(mesh) == 1);
    CHECK(taut_mesh_ignored_triangles(mesh, out) == TAUT_STATUS_OK);
    CHECK(ignored[0] == 1 && ignored[1] == -7);
    taut_mesh_free(mesh);
}

static bool same_as_rectangle(const taut_mesh *mesh) {
    double p[15] = {0};
    uint32_t t[6] = {0};
    CHECK(taut_mesh_positions(mesh, (taut_output){.data = p, .count = 5}) == TAUT_STATUS_OK);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = t, .count = 2}) == TAUT_STATUS_OK);
    return memcmp(p, xyz, sizeof p) == 0 && memcmp(t, corners, sizeof t) == 0;
}

/* The same mesh from every type, with gaps between rows and off alignment. */
static void every_packing_in(void) {
    enum { GAP = 41 };
    unsigned char p[1 + 5 * GAP], t[1 + 2 * GAP];
    const taut_type scalars[] = {TAUT_TYPE_F32, TAUT_TYPE_F64};
    const taut_type indices[] = {TAUT_TYPE_U16, TAUT_TYPE_U32, TAUT_TYPE_U64, TAUT_TYPE_I32, TAUT_TYPE_I64};
    for (size_t s = 0; s < 2; s++) {
        for (size_t v = 0; v < 5; v++) {
            const double *row = xyz + 3 * v;
            const float single[] = {(float)row[0], (float)row[1], (float)row[2]};
            const void *bytes = scalars[s] == TAUT_TYPE_F32 ? (const void *)single : (const void *)row;
            memcpy(p + 1 + v * GAP, bytes, scalars[s] == TAUT_TYPE_F32 ? sizeof single : 3 * sizeof *row);
        }
        for (size_t i = 0; i < 5; i++) {
            for (size_t f = 0; f < 2; f++) {
                for (size_t k = 0; k < 3; k++) {
                    const uint16_t u16 = (uint16_t)corners[3 * f + k];
                    const uint32_t u32 = u16;
                    const uint64_t u64 = u16;
                    unsigned char *row = t + 1 + f * GAP;
                    switch (indices[i]) {
                    case TAUT_TYPE_U16: memcpy(row + 2 * k, &u16, 2); break;
                    case TAUT_TYPE_U32:
                    case TAUT_TYPE_I32: memcpy(row + 4 * k, &u32, 4); break;
                    default: memcpy(row + 8 * k, &u64, 8);
                    }
                }
            }
            taut_mesh *mesh = NULL;
            CHECK(taut_mesh_new((taut_input){.data = p + 1, .count = 5, .stride = GAP, .type = scalars[s]},
                                (taut_input){.data = t + 1, .count = 2, .stride = GAP, .type = indices[i]},
                                &mesh) == TAUT_STATUS_OK);
            CHECK(same_as_rectangle(mesh));
            taut_mesh_free(mesh);
        }
    }
}

/* Rows that overlap are read as they lie: each begins at the second number of the one before. */
static void rows_that_overlap(void) {
    const double numbers[] = {0, 1, 5, 2, 8}, expected[] = {0, 1, 5, 1, 5, 2, 5, 2, 8};
    const uint32_t circle[] = {0, 1, 2, 0}, fan[] = {0, 1, 2, 1, 2, 0};
    taut_mesh *mesh = NULL;
    double p[9];
    uint32_t t[6];
    CHECK(taut_mesh_new((taut_input){.data = numbers, .count = 3, .stride = sizeof *numbers},
                        (taut_input){.data = circle, .count = 2, .stride = sizeof *circle}, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_positions(mesh, room(p, 3)) == TAUT_STATUS_OK && memcmp(p, expected, sizeof p) == 0);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = t, .count = 2}) == TAUT_STATUS_OK);
    CHECK(memcmp(t, fan, sizeof t) == 0);
    taut_mesh_free(mesh);
}

static void polygons(void) {
    const uint16_t offsets[] = {0, 4}, bad_offsets[] = {0, 5}, small[] = {0, 2, 4};
    const int32_t quad[] = {0, 1, 2, 3};
    const taut_input quads = {.data = quad, .count = 4, .type = TAUT_TYPE_I32};
    taut_mesh *mesh = NULL;
    uint32_t fan[6];
    CHECK(taut_mesh_new_polygons(positions, (taut_input){.data = offsets, .count = 2, .type = TAUT_TYPE_U16}, quads,
                                 &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_triangle_count(mesh) == 2);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = fan, .count = 2}) == TAUT_STATUS_OK);
    CHECK(fan[0] == 0 && fan[1] == 1 && fan[2] == 2 && fan[3] == 0 && fan[4] == 2 && fan[5] == 3);
    taut_mesh_free(mesh);
    CHECK_FAILS(taut_mesh_new_polygons(positions, (taut_input){.data = bad_offsets, .count = 2, .type = TAUT_TYPE_U16},
                                       quads, &mesh), TAUT_REASON_BAD_OFFSETS, TAUT_ELEMENT_FACE, 0);
    CHECK_FAILS(taut_mesh_new_polygons(positions, (taut_input){.data = small, .count = 3, .type = TAUT_TYPE_U16}, quads,
                                       &mesh), TAUT_REASON_FACE_TOO_SMALL, TAUT_ELEMENT_FACE, 0);
    CHECK(taut_mesh_new_polygons(positions, (taut_input){0}, (taut_input){0}, &mesh) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
}

static void meshes_from_memory(void) {
    static const char off[] = "OFF\n3 1 0\n0 0 0\n3 0 0\n0 4 0\n3 0 1 2\n", obj[] = "v 0 0 0\nv 3 0 0\nv 0 4 0\nf 1 2 3\n";
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_read_bytes(off, sizeof off - 1, TAUT_FORMAT_OFF, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_vertex_count(mesh) == 3 && taut_mesh_triangle_count(mesh) == 1);
    taut_mesh_free(mesh);
    CHECK(taut_mesh_read_bytes(obj, sizeof obj - 1, TAUT_FORMAT_OBJ, &mesh) == TAUT_STATUS_OK);
    CHECK(taut_mesh_vertex_count(mesh) == 3 && taut_mesh_triangle_count(mesh) == 1);
    taut_mesh_free(mesh);

    mesh = (taut_mesh *)&failures; /* must be overwritten */
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off - 9, TAUT_FORMAT_OFF, &mesh), TAUT_REASON_TRUNCATED,
                TAUT_ELEMENT_FACE, 0);
    CHECK(mesh == NULL);
    for (taut_format format = TAUT_FORMAT_GLB; format <= TAUT_FORMAT_STL; format++)
        CHECK(taut_mesh_read_bytes(NULL, 0, format, &mesh) == TAUT_STATUS_FORMAT && mesh == NULL);
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off, 0, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off, TAUT_FORMAT_STL + 1, &mesh), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(NULL, 1, TAUT_FORMAT_OFF, &mesh), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(off, SIZE_MAX, TAUT_FORMAT_OFF, &mesh), TAUT_REASON_TOO_MANY_ELEMENTS, 0, 0);
    CHECK_FAILS(taut_mesh_read_bytes(off, sizeof off, TAUT_FORMAT_OFF, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
}

static void indices_that_do_not_fit(void) {
    enum { COUNT = 70000 };
    double *many = calloc(3 * COUNT, sizeof *many);
    const uint32_t large[] = {0, 1, COUNT - 1};
    uint16_t narrow[] = {7, 7, 7};
    int32_t wide[3];
    taut_mesh *mesh = NULL;
    CHECK(taut_mesh_new((taut_input){.data = many, .count = COUNT}, (taut_input){.data = large, .count = 1}, &mesh) ==
          TAUT_STATUS_OK);
    CHECK_FAILS(taut_mesh_triangles(mesh, (taut_output){.data = narrow, .count = 1, .type = TAUT_TYPE_U16}),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(narrow[0] == 7 && narrow[1] == 7 && narrow[2] == 7);
    CHECK(taut_mesh_triangles(mesh, (taut_output){.data = wide, .count = 1, .type = TAUT_TYPE_I32}) == TAUT_STATUS_OK);
    CHECK(wide[0] == 0 && wide[1] == 1 && wide[2] == COUNT - 1);
    taut_mesh_free(mesh);
    free(many);
}

static void positions_of_points(void) {
    taut_mesh *mesh = rectangle();
    const uint32_t beyond[] = {1, 2};
    const int32_t negative[] = {1, -1};
    const double heavy[] = {1, 0, 0, 0, 0.5, 1};
    double at[6] = {-1, -1, -1, -1, -1, -1};
    float strided[8] = {0, 0, 0, 7, 0, 0, 0, 7};
    const taut_output to_strided = {.data = strided, .count = 2, .stride = 16, .type = TAUT_TYPE_F32};
    CHECK_FAILS(taut_mesh_point_positions(NULL, each, each, (taut_output){0}), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(beyond, 2), scalars(two_weights, 2), room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_FACE, 2);
    CHECK_FAILS(taut_mesh_point_positions(mesh, typed_input(negative, 2, TAUT_TYPE_I32), scalars(two_weights, 2),
                                          room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_POINT, 1);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(heavy, 2), room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, TAUT_ELEMENT_POINT, 1);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(two_faces, 1), scalars(two_weights, 2), room(at, 2)),
                TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(two_weights, 2), room(at, 1)),
                TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK(at[0] == -1 && at[3] == -1);
    CHECK(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(two_weights, 2), room(at, 2)) == TAUT_STATUS_OK);
    CHECK(is_at(at, 3, 4) && is_at(at + 3, 2.25, 3));
    CHECK(taut_mesh_point_positions(mesh, indices(two_faces, 2), scalars(two_weights, 2), to_strided) == TAUT_STATUS_OK);
    CHECK(strided[0] == 3 && strided[3] == 7 && strided[4] == 2.25f && strided[7] == 7);
    CHECK(taut_mesh_point_positions(mesh, each, each, (taut_output){0}) == TAUT_STATUS_OK);
    taut_mesh_free(mesh);
}

/* Two triangles that touch in vertex 2, one of them twice; a repeated index; a copy of vertex 0; a loose vertex. */
static taut_report *messy_report(void) {
    const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 2, 0, 1, 2, 0, 0, 0, -0.0, 5, 5, 5};
    const uint32_t faces[] = {0, 1, 2, 2, 3, 4, 1, 0, 2, 5, 5, 1};
    taut_mesh *mesh = NULL;
    taut_report *report = NULL;
    CHECK(taut_mesh_new((taut_input){.data = points, .count = 7}, (taut_input){.data = faces, .count = 4}, &mesh) ==
          TAUT_STATUS_OK);
    CHECK(taut_report_new(mesh, &report) == TAUT_STATUS_OK);
    taut_mesh_free(mesh); /* before the use of what was made from it */
    return report;
}

static void reports(void) {
    taut_report *report = messy_report();
    const size_t counts[] = {0, 1, 0, 1, 0, 1, 0, 0, 1, 1, 1, 2, 0};
    for (uint32_t finding = 0; finding < sizeof counts / sizeof *counts; finding++) {
        CHECK(taut_report_count(report, finding) == counts[finding]);
    }
    CHECK(last_is(TAUT_REASON_BAD_ARGUMENT, 0, 0)); /* kinds 0 and 12 do not exist */
    uint32_t pair[2] = {9, 9}, one = 9, chain[3];
    const taut_output pairs = {.data = pair, .count = 1}, single = {.data = &one, .count = 1};
    CHECK(taut_report_list(report, TAUT_FINDING_DUPLICATE_FACES, pairs) == TAUT_STATUS_OK && pair[0] == 2 && pair[1] == 0);
    CHECK(taut_report_list(report, TAUT_FINDING_DUPLICATE_VERTICES, pairs) == TAUT_STATUS_OK);
    CHECK(pair[0] == 5 && pair[1] == 0);
    CHECK(taut_report_list(report, TAUT_FINDING_NONMANIFOLD_VERTICES, single) == TAUT_STATUS_OK && one == 2);
    CHECK(taut_report_list(report, TAUT_FINDING_REPEATED_INDEX_FACES, single) == TAUT_STATUS_OK && one == 3);
    CHECK(taut_report_list(report, TAUT_FINDING_BOUNDARY_LOOPS, pairs) == TAUT_STATUS_OK && pair[0] == 3 && pair[1] == 1);
    CHECK(taut_report_boundary_vertices(report, (taut_output){.data = chain, .count = 3}) == TAUT_STATUS_OK);
    CHECK(chain[0] + chain[1] + chain[2] == 2 + 3 + 4);
    pair[0] = 9;
    CHECK_FAILS(taut_report_list(report, TAUT_FINDING_UNREFERENCED_VERTICES, single), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_report_boundary_vertices(report, pairs), TAUT_REASON_BUFFER_TOO_SMALL, 0, 0);
    CHECK_FAILS(taut_report_list(report, 12, pairs), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(one == 3 && pair[0] == 9);

    uint64_t component_of[7];
    CHECK(taut_report_component_of(report, (taut_output){.data = component_of, .count = 7, .type = TAUT_TYPE_U64}) ==
          TAUT_STATUS_OK);
    CHECK(component_of[0] == 0 && component_of[4] == 0 && component_of[5] == UINT64_MAX && component_of[6] == UINT64_MAX);

    taut_component part = {.struct_size = sizeof part};
    CHECK(taut_report_component(report, 0, &part) == TAUT_STATUS_OK);
    CHECK(part.vertices == 5 && part.edges == 6 && part.faces == 3 && part.first_vertex == 0);
    CHECK(part.boundary_loops == 1 && part.manifold == 0 && part.orientable == 1 && part.genus == 0);
    part = (taut_component){.struct_size = offsetof(taut_component, faces), .faces = 77}; /* an older caller */
    CHECK(taut_report_component(report, 0, &part) == TAUT_STATUS_OK && part.edges == 6 && part.faces == 77);
    CHECK_FAILS(taut_report_component(report, 1, &part), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK_FAILS(taut_report_component(report, 0, NULL), TAUT_REASON_NULL_POINTER, 0, 0);

    taut_angle smallest, largest;
    CHECK(taut_report_angles(report, &smallest, &largest) == TAUT_STATUS_OK);
    CHECK(fabs(smallest.radians - atan(1)) < 1e-15 && fabs(largest.radians - 2 * atan(1)) < 1e-15);
    CHECK(largest.face == 0 && largest.vertex == 0);
    CHECK_FAILS(taut_report_angles(report, &smallest, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_report_angles(NULL, &smallest, &largest), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(taut_report_count(NULL, 1) == 0 && last_is(TAUT_REASON_NULL_POINTER, 0, 0));
    taut_report_free(report);
    taut_report_free(NULL);
    CHECK_FAILS(taut_report_new(NULL, &report), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(report == NULL);
}

static void properties(void) {
    taut_mesh *mesh = rectangle(), *empty = NULL;
    taut_properties all = {.struct_size = sizeof all};
    CHECK(taut_mesh_properties(mesh, &all) == TAUT_STATUS_OK);
    CHECK(all.vertices == 5 && all.edges == 5 && all.faces == 2);
    CHECK(fabs(all.mean_edge - 3.8) < 1e-14 && all.min_edge == 3 && all.q2 == 4 && all.max_edge == 5);
    CHECK(fabs(all.min_angle - atan(0.75)) < 1e-15 && fabs(all.paper_scale - 24.976 / 5) < 1e-14);
    CHECK_FAILS(taut_mesh_properties(mesh, NULL), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK_FAILS(taut_mesh_properties(NULL, &all), TAUT_REASON_NULL_POINTER, 0, 0);
    CHECK(taut_mesh_new((taut_input){0}, (taut_input){0}, &empty) == TAUT_STATUS_OK);
    CHECK_FAILS(taut_mesh_properties(empty, &all), TAUT_REASON_BAD_ARGUMENT, 0, 0);
    CHECK(all.vertices == 5); /* nothing was written */
    taut_mesh_free(empty);
    taut_mesh_free(mesh);
}

const test tests[] = {
    TEST(empty_mesh),
    TEST(bad_meshes),
    TEST(ignored_triangles),
    TEST(every_packing_in),
    TEST(rows_that_overlap),
    TEST(polygons),
    TEST(meshes_from_memory),
    TEST(indices_that_do_not_fit),
    TEST(positions_of_points),
    TEST(reports),
    TEST(properties),
    {0},
};
