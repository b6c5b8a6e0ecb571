/* The functions of taut.h as data. */
#include "functions.h"

/* What `given` says where the handle that is made goes; NULL where nothing is said. */
#define MADE(kind) (given->made ? &given->made->kind : NULL)

/* call_x makes the call to taut_x. */
#define CALL(name, ...) \
    static taut_status call_##name(const arguments *given) { return taut_##name(__VA_ARGS__); }

CALL(mesh_new, given->inputs[0], given->inputs[1], MADE(mesh))
CALL(mesh_new_polygons, given->inputs[0], given->inputs[1], given->inputs[2], MADE(mesh))
CALL(mesh_with_positions, given->self.mesh, given->inputs[0], MADE(mesh))
CALL(mesh_positions, given->self.mesh, given->outputs[0])
CALL(mesh_triangles, given->self.mesh, given->outputs[0])
CALL(mesh_ignored_triangles, given->self.mesh, given->outputs[0])
CALL(mesh_point_positions, given->self.mesh, given->inputs[0], given->inputs[1], given->outputs[0])
CALL(mesh_properties, given->self.mesh, given->records[0])
CALL(report_new, given->self.mesh, MADE(report))
CALL(report_list, given->self.report, TAUT_FINDING_UNREFERENCED_VERTICES, given->outputs[0])
CALL(report_boundary_vertices, given->self.report, given->outputs[0])
CALL(report_component, given->self.report, 0, given->records[0])
CALL(report_component_of, given->self.report, given->outputs[0])
CALL(report_angles, given->self.report, given->records[0], given->records[1])
CALL(control_new, MADE(control))
CALL(control_set_time_limit, given->self.control, 1e9)
CALL(control_set_memory_limit, given->self.control, 1u << 30)
CALL(control_set_callback, given->self.control, NULL, NULL)
CALL(control_set_callback_interval, given->self.control, 0.5)
CALL(time_step_value, given->self.mesh, (taut_time_step){.factor = 1}, given->records[0])
CALL(heat_new, given->self.mesh, given->heat_options, given->control, MADE(heat))
CALL(heat_with_time_step, given->self.heat, (taut_time_step){.factor = 2}, given->control, MADE(heat))
CALL(heat_with_mesh, given->self.heat, given->mesh, given->control, MADE(heat))
CALL(heat_report_of, given->self.heat, given->records[0])
CALL(heat_field_new, given->self.heat, given->sources, given->control, MADE(heat_field))
CALL(heat_field_distances, given->self.heat_field, given->outputs[0])
CALL(heat_field_nearest_sources, given->self.heat_field, given->outputs[0])
CALL(heat_residuals_of, given->self.heat, given->sources, given->control, given->records[0])
CALL(heat_distance_rows, given->self.heat, given->sources, given->inputs[0], 2, given->control, given->outputs[0])
CALL(exact_new, given->self.mesh, MADE(exact))
CALL(exact_field_new, given->self.exact, given->sources, given->exact_options, given->control, MADE(exact_field))
CALL(exact_field_distances, given->self.exact_field, given->targets, given->outputs[0])
CALL(exact_field_nearest_sources, given->self.exact_field, given->targets, given->outputs[0])
CALL(exact_field_paths, given->self.exact_field, given->targets, given->control, MADE(curves))
CALL(exact_curve_through, given->self.exact, given->inputs[0], given->inputs[1], given->control, MADE(curves))
CALL(exact_distance_rows, given->self.exact, given->sources, given->inputs[0], 2, given->control, given->outputs[0])
CALL(exact_distances_within, given->self.exact, given->sources, 4, 2, given->control, MADE(sparse))
CALL(exact_farthest_points, given->self.exact, given->sources, 3, given->control, given->outputs[0], given->outputs[1])
CALL(sparse_distances_offsets, given->self.sparse, given->outputs[0])
CALL(sparse_distances_vertices, given->self.sparse, given->outputs[0])
CALL(sparse_distances_values, given->self.sparse, given->outputs[0])
CALL(even_levels, given->self.mesh, given->inputs[0], 2, given->outputs[0], given->records[0])
CALL(spaced_levels, given->self.mesh, given->inputs[0], 1, given->outputs[0], given->records[0])
CALL(isolines_new, given->self.mesh, given->inputs[0], given->inputs[1], MADE(curves))
CALL(descent_paths_new, given->self.mesh, given->inputs[0], given->sources, given->targets, given->control, MADE(curves))
CALL(curves_offsets, given->self.curves, given->outputs[0])
CALL(curves_positions, given->self.curves, given->outputs[0])
CALL(curves_faces, given->self.curves, given->outputs[0])
CALL(curves_barycentrics, given->self.curves, given->outputs[0])
CALL(curves_closed, given->self.curves, given->outputs[0])
CALL(curves_levels, given->self.curves, given->outputs[0])
CALL(curves_sources, given->self.curves, given->outputs[0])
CALL(closest_new, given->self.mesh, MADE(closest))
CALL(closest_points, given->self.closest, given->inputs[0], given->control, given->outputs[0], given->outputs[1],
     given->outputs[2])

static taut_status call_mesh_read(const arguments *given) { return taut_mesh_read(TAUT_RECTANGLE, MADE(mesh)); }

static taut_status call_mesh_read_bytes(const arguments *given) {
    static const char content[] = "OFF\n3 1 0\n0 0 0\n3 0 0\n0 4 0\n3 0 1 2\n";
    return taut_mesh_read_bytes(content, sizeof content - 1, TAUT_FORMAT_OFF, MADE(mesh));
}

static const uint32_t quad_offsets[] = {0, 4}, quad_corners[] = {0, 1, 2, 3}, three_sets[] = {0, 1, 2, 3};
static const double levels[] = {1.5, 0.75}, clicks[] = {0.75, 1, 9, 5, 3, 0};

#define NAMED(name) "taut_" #name, call_##name
#define POSITIONS {"positions", REAL, 3, 5, xyz}
#define VALUES {"values", REAL, 1, 5, along_x}
#define SETS {"set_offsets", INDEX, 1, 4, three_sets}
#define TWO_POINTS {{"faces", INDEX, 1, 2, two_faces}, {"barycentrics", REAL, 3, 2, two_weights}}
#define LEVELS {{"levels", REAL, 1, 2, NULL}}
#define OUT(element, width, count) {{"out", element, width, count, NULL}}

const function functions[] = {
    {NAMED(mesh_new), .makes = MESH, .inputs = {POSITIONS, {"triangles", INDEX, 3, 2, corners}}},
    {NAMED(mesh_new_polygons), .makes = MESH,
     .inputs = {POSITIONS, {"offsets", INDEX, 1, 2, quad_offsets}, {"corners", INDEX, 1, 4, quad_corners}}},
    {NAMED(mesh_with_positions), .self = MESH, .makes = MESH, .inputs = {POSITIONS}},
    {NAMED(mesh_read), .makes = MESH},
    {NAMED(mesh_read_bytes), .makes = MESH},
    {NAMED(mesh_positions), .self = MESH, .outputs = OUT(REAL, 3, 5)},
    {NAMED(mesh_triangles), .self = MESH, .outputs = OUT(INDEX, 3, 3)},
    {NAMED(mesh_ignored_triangles), .self = MESH, .outputs = OUT(INDEX, 1, 1)},
    {NAMED(mesh_point_positions), .self = MESH, .inputs = TWO_POINTS, .outputs = OUT(REAL, 3, 2)},
    {NAMED(mesh_properties), .self = MESH, .records = {sizeof(taut_properties)}, .record_has_a_size = true},
    {NAMED(report_new), .self = MESH, .makes = REPORT},
    {NAMED(report_list), .self = REPORT, .outputs = OUT(INDEX, 1, 1)},
    {NAMED(report_boundary_vertices), .self = REPORT, .outputs = OUT(INDEX, 1, 4)},
    {NAMED(report_component), .self = REPORT, .records = {sizeof(taut_component)}, .record_has_a_size = true},
    {NAMED(report_component_of), .self = REPORT, .outputs = OUT(INDEX, 1, 5)},
    {NAMED(report_angles), .self = REPORT, .records = {sizeof(taut_angle), sizeof(taut_angle)}},
    {NAMED(control_new), .makes = CONTROL},
    {NAMED(control_set_time_limit), .self = CONTROL},
    {NAMED(control_set_memory_limit), .self = CONTROL},
    {NAMED(control_set_callback), .self = CONTROL},
    {NAMED(control_set_callback_interval), .self = CONTROL},
    {NAMED(time_step_value), .self = MESH, .records = {sizeof(double)}},
    {NAMED(heat_new), .self = MESH, .makes = HEAT, .takes = TAKES_CONTROL | HEAT_OPTIONS},
    {NAMED(heat_with_time_step), .self = HEAT, .makes = HEAT, .takes = TAKES_CONTROL},
    {NAMED(heat_with_mesh), .self = HEAT, .makes = HEAT, .takes = TAKES_CONTROL | OTHER_MESH},
    {NAMED(heat_report_of), .self = HEAT, .records = {sizeof(taut_heat_report)}, .record_has_a_size = true},
    {NAMED(heat_field_new), .self = HEAT, .makes = HEAT_FIELD, .takes = TAKES_CONTROL | SOURCES},
    {NAMED(heat_field_distances), .self = HEAT_FIELD, .outputs = OUT(REAL, 1, 5)},
    {NAMED(heat_field_nearest_sources), .self = HEAT_FIELD, .outputs = OUT(INDEX, 1, 5)},
    {NAMED(heat_residuals_of), .self = HEAT, .takes = TAKES_CONTROL | SOURCES, .records = {sizeof(taut_heat_residuals)},
     .record_has_a_size = true},
    {NAMED(heat_distance_rows), .self = HEAT, .takes = TAKES_CONTROL | SOURCES, .inputs = {SETS}, .outputs = OUT(REAL, 5, 3)},
    {NAMED(exact_new), .self = MESH, .makes = EXACT},
    {NAMED(exact_field_new), .self = EXACT, .makes = EXACT_FIELD, .takes = TAKES_CONTROL | SOURCES | EXACT_OPTIONS},
    {NAMED(exact_field_distances), .self = EXACT_FIELD, .takes = TARGETS, .outputs = OUT(REAL, 1, 2)},
    {NAMED(exact_field_nearest_sources), .self = EXACT_FIELD, .takes = TARGETS, .outputs = OUT(INDEX, 1, 2)},
    {NAMED(exact_field_paths), .self = EXACT_FIELD, .makes = CURVES, .takes = TAKES_CONTROL | TARGETS},
    {NAMED(exact_curve_through), .self = EXACT, .makes = CURVES, .takes = TAKES_CONTROL, .inputs = TWO_POINTS},
    {NAMED(exact_distance_rows), .self = EXACT, .takes = TAKES_CONTROL | SOURCES, .inputs = {SETS}, .outputs = OUT(REAL, 5, 3)},
    {NAMED(exact_distances_within), .self = EXACT, .makes = SPARSE, .takes = TAKES_CONTROL | SOURCES},
    {NAMED(exact_farthest_points), .self = EXACT, .takes = TAKES_CONTROL | SOURCES,
     .outputs = {{"vertices", INDEX, 1, 3, NULL}, {"distances", REAL, 1, 3, NULL}}},
    {NAMED(sparse_distances_offsets), .self = SPARSE, .outputs = OUT(INDEX, 1, 4)},
    {NAMED(sparse_distances_vertices), .self = SPARSE, .outputs = OUT(INDEX, 1, 8)},
    {NAMED(sparse_distances_values), .self = SPARSE, .outputs = OUT(REAL, 1, 8)},
    {NAMED(even_levels), .self = MESH, .inputs = {VALUES}, .outputs = LEVELS, .records = {sizeof(size_t)}},
    {NAMED(spaced_levels), .self = MESH, .inputs = {VALUES}, .outputs = LEVELS, .records = {sizeof(size_t)}},
    {NAMED(isolines_new), .self = MESH, .makes = CURVES, .inputs = {VALUES, {"levels", REAL, 1, 2, levels}}},
    {NAMED(descent_paths_new), .self = MESH, .makes = CURVES, .takes = TAKES_CONTROL | SOURCES_OR_NULL | TARGETS, .inputs = {VALUES}},
    {NAMED(curves_offsets), .self = CURVES, .outputs = OUT(INDEX, 1, 3)},
    {NAMED(curves_positions), .self = CURVES, .outputs = OUT(REAL, 3, 6)},
    {NAMED(curves_faces), .self = CURVES, .outputs = OUT(INDEX, 1, 6)},
    {NAMED(curves_barycentrics), .self = CURVES, .outputs = OUT(REAL, 3, 6)},
    {NAMED(curves_closed), .self = CURVES, .outputs = OUT(INDEX, 1, 2)},
    {NAMED(curves_levels), .self = CURVES, .outputs = OUT(INDEX, 1, 2)},
    {NAMED(curves_sources), .self = CURVES, .outputs = OUT(INDEX, 1, 2)},
    {NAMED(closest_new), .self = MESH, .makes = CLOSEST},
    {NAMED(closest_points), .self = CLOSEST, .takes = TAKES_CONTROL, .inputs = {{"points", REAL, 3, 2, clicks}},
     .outputs = {{"faces", INDEX, 1, 2, NULL}, {"barycentrics", REAL, 3, 2, NULL}, {"distances", REAL, 1, 2, NULL}}},
};
const size_t function_count = sizeof functions / sizeof *functions;

#define TELL(name, kind) \
    static double tell_##name(handle self) { return (double)taut_##name(self.kind); }
TELL(mesh_vertex_count, mesh)
TELL(mesh_triangle_count, mesh)
TELL(mesh_ignored_count, mesh)
TELL(curves_count, curves)
TELL(curves_point_count, curves)
TELL(control_is_cancelled, control)
TELL(control_progress, control)
TELL(heat_time_step, heat)
TELL(heat_field_restarts, heat_field)
TELL(heat_field_nonpositive_heat, heat_field)
TELL(exact_field_final_radius, exact_field)
TELL(exact_field_windows, exact_field)
TELL(sparse_distances_row_count, sparse)
TELL(sparse_distances_count, sparse)

static double tell_report_count(handle self) {
    return (double)taut_report_count(self.report, TAUT_FINDING_UNREFERENCED_VERTICES);
}

static double tell_exact_field_interruption(handle self) { return taut_exact_field_interruption(self.exact_field, NULL); }

static double tell_control_cancel(handle self) { return taut_control_cancel(self.control), 0; }

#define TOLD(name) "taut_" #name
const getter getters[] = {
    {TOLD(mesh_vertex_count), MESH, tell_mesh_vertex_count, 0},
    {TOLD(mesh_triangle_count), MESH, tell_mesh_triangle_count, 0},
    {TOLD(mesh_ignored_count), MESH, tell_mesh_ignored_count, 0},
    {TOLD(report_count), REPORT, tell_report_count, 0},
    {TOLD(curves_count), CURVES, tell_curves_count, 0},
    {TOLD(curves_point_count), CURVES, tell_curves_point_count, 0},
    {TOLD(control_is_cancelled), CONTROL, tell_control_is_cancelled, 0},
    {TOLD(control_progress), CONTROL, tell_control_progress, 0},
    {TOLD(control_cancel), CONTROL, tell_control_cancel, 0},
    {TOLD(heat_time_step), HEAT, tell_heat_time_step, 0},
    {TOLD(heat_field_restarts), HEAT_FIELD, tell_heat_field_restarts, 0},
    {TOLD(heat_field_nonpositive_heat), HEAT_FIELD, tell_heat_field_nonpositive_heat, 0},
    {TOLD(exact_field_final_radius), EXACT_FIELD, tell_exact_field_final_radius, 0},
    {TOLD(exact_field_windows), EXACT_FIELD, tell_exact_field_windows, 0},
    {TOLD(exact_field_interruption), EXACT_FIELD, tell_exact_field_interruption, TAUT_STATUS_INVALID_ARGUMENT},
    {TOLD(sparse_distances_row_count), SPARSE, tell_sparse_distances_row_count, 0},
    {TOLD(sparse_distances_count), SPARSE, tell_sparse_distances_count, 0},
};
const size_t getter_count = sizeof getters / sizeof *getters;

#define FREE(name, kind) \
    static void free_##kind(handle it) { taut_##name##_free(it.kind); }
FREE(mesh, mesh)
FREE(closest, closest)
FREE(control, control)
FREE(curves, curves)
FREE(exact, exact)
FREE(exact_field, exact_field)
FREE(heat, heat)
FREE(heat_field, heat_field)
FREE(report, report)
FREE(sparse_distances, sparse)

const freer freers[SPARSE + 1] = {
    [MESH] = {"taut_mesh_free", free_mesh},
    [CLOSEST] = {"taut_closest_free", free_closest},
    [CONTROL] = {"taut_control_free", free_control},
    [CURVES] = {"taut_curves_free", free_curves},
    [EXACT] = {"taut_exact_free", free_exact},
    [EXACT_FIELD] = {"taut_exact_field_free", free_exact_field},
    [HEAT] = {"taut_heat_free", free_heat},
    [HEAT_FIELD] = {"taut_heat_field_free", free_heat_field},
    [REPORT] = {"taut_report_free", free_report},
    [SPARSE] = {"taut_sparse_distances_free", free_sparse},
};

static const double offsets[] = {0, 0.5, 1}, middle[] = {0.25, 0.5, 0.25}, curve_weights[] = {0, 1, 0, 0.25, 0.5, 0.25};
static const uint32_t two = 2, one = 1, curve_ends[] = {0, 2}, curve_faces[] = {1, 1};

const taut_sources every_source = {.struct_size = sizeof every_source,
                                   .vertices = {.data = &zero, .count = 1},
                                   .offsets = {.data = offsets, .count = 3},
                                   .faces = {.data = &face_zero, .count = 1},
                                   .barycentrics = {.data = inside, .count = 1},
                                   .curve_offsets = {.data = curve_ends, .count = 2},
                                   .curve_faces = {.data = curve_faces, .count = 2},
                                   .curve_barycentrics = {.data = curve_weights, .count = 2},
                                   .curve_closed = {.data = &zero, .count = 1}};
const taut_targets every_target = {.struct_size = sizeof every_target,
                                   .vertices = {.data = &two, .count = 1},
                                   .faces = {.data = &one, .count = 1},
                                   .barycentrics = {.data = middle, .count = 1}};

handle handles[SPARSE + 1];

void make_handles(void) {
    /* The third triangle repeats an index, so that one is ignored. */
    const uint32_t repeated[] = {0, 1, 3, 1, 2, 3, 2, 2, 1};
    handle *h = handles;
    CHECK(taut_mesh_new(positions, indices(repeated, 3), &h[MESH].mesh) == TAUT_STATUS_OK);
    CHECK(taut_closest_new(h[MESH].mesh, &h[CLOSEST].closest) == TAUT_STATUS_OK);
    CHECK(taut_control_new(&h[CONTROL].control) == TAUT_STATUS_OK);
    h[CURVES].curves = two_lines();
    CHECK(taut_exact_new(h[MESH].mesh, &h[EXACT].exact) == TAUT_STATUS_OK);
    CHECK(taut_exact_field_new(h[EXACT].exact, &every_source, &keeping, NULL, &h[EXACT_FIELD].exact_field) == 0);
    CHECK(taut_heat_new(h[MESH].mesh, NULL, NULL, &h[HEAT].heat) == TAUT_STATUS_OK);
    CHECK(taut_heat_field_new(h[HEAT].heat, &every_source, NULL, &h[HEAT_FIELD].heat_field) == TAUT_STATUS_OK);
    CHECK(taut_report_new(h[MESH].mesh, &h[REPORT].report) == TAUT_STATUS_OK);
    CHECK(taut_exact_distances_within(h[EXACT].exact, &every_source, 4, 1, NULL, &h[SPARSE].sparse) == TAUT_STATUS_OK);
}

void free_handles(void) {
    for (kind k = MESH; k <= SPARSE; k++) freers[k].free(handles[k]);
}

void contents_of(kind kind, handle it, double contents[MOST_CONTENTS]) {
    const taut_output out = {.data = contents, .count = MOST_CONTENTS}, rows = {.data = contents, .count = MOST_CONTENTS / 3};
    const taut_output numbers = {.data = contents, .count = MOST_CONTENTS, .type = TAUT_TYPE_U64};
    taut_exact_field *exact_field = NULL;
    taut_heat_field *heat_field = NULL;
    memset(contents, 0, MOST_CONTENTS * sizeof *contents);
    switch (kind) {
    case MESH: CHECK(taut_mesh_positions(it.mesh, rows) == TAUT_STATUS_OK); break;
    case CLOSEST:
        CHECK(taut_closest_points(it.closest, scalars(clicks, 2), NULL, typed(contents + 2, 2, TAUT_TYPE_U64), room(contents + 4, 2),
                                  room(contents, 2)) == TAUT_STATUS_OK);
        break;
    case CURVES: CHECK(taut_curves_positions(it.curves, rows) == TAUT_STATUS_OK); break;
    case EXACT:
        CHECK(taut_exact_field_new(it.exact, &every_source, NULL, NULL, &exact_field) == TAUT_STATUS_OK);
        CHECK(taut_exact_field_distances(exact_field, NULL, out) == TAUT_STATUS_OK);
        taut_exact_field_free(exact_field);
        break;
    case EXACT_FIELD: CHECK(taut_exact_field_distances(it.exact_field, NULL, out) == TAUT_STATUS_OK); break;
    case HEAT:
        CHECK(taut_heat_field_new(it.heat, &every_source, NULL, &heat_field) == TAUT_STATUS_OK);
        CHECK(taut_heat_field_distances(heat_field, out) == TAUT_STATUS_OK);
        taut_heat_field_free(heat_field);
        break;
    case HEAT_FIELD: CHECK(taut_heat_field_distances(it.heat_field, out) == TAUT_STATUS_OK); break;
    case REPORT: CHECK(taut_report_component_of(it.report, numbers) == TAUT_STATUS_OK); break;
    case SPARSE: CHECK(taut_sparse_distances_values(it.sparse, out) == TAUT_STATUS_OK); break;
    case CONTROL:
    case NOTHING: break;
    }
}

size_t row_bytes(const shape *rows) { return rows->width * (rows->element == REAL ? sizeof(double) : sizeof(uint32_t)); }

void clear(call *it) {
    memset(it->outputs, UNTOUCHED, sizeof it->outputs);
    memset(it->records, UNTOUCHED, sizeof it->records);
    if (it->function->record_has_a_size) memcpy(it->records[0], &it->function->records[0], sizeof(size_t));
}

void prepare(call *it, const function *function) {
    memset(it, 0, sizeof *it);
    it->function = function;
    clear(it);
    it->sources = every_source;
    it->targets = every_target;
    it->heat_options = (taut_heat_options){.struct_size = sizeof it->heat_options, .boundary = 0.5};
    it->exact_options = keeping;
    it->exact_options.targets = &it->targets;
    const unsigned takes = function->takes;
    arguments *given = &it->given;
    given->self = handles[function->self];
    if (takes & OTHER_MESH) given->mesh = handles[MESH].mesh;
    if (takes & (SOURCES | SOURCES_OR_NULL)) given->sources = &it->sources;
    if (takes & TARGETS) given->targets = &it->targets;
    if (takes & HEAT_OPTIONS) given->heat_options = &it->heat_options;
    if (takes & EXACT_OPTIONS) given->exact_options = &it->exact_options;
    if (takes & TAKES_CONTROL) given->control = handles[CONTROL].control;
    for (size_t i = 0; i < INPUTS; i++) {
        given->inputs[i] = (taut_input){.data = function->inputs[i].data, .count = function->inputs[i].count};
    }
    for (size_t i = 0; i < OUTPUTS; i++) {
        if (function->outputs[i].name) given->outputs[i] = (taut_output){.data = it->outputs[i], .count = function->outputs[i].count};
    }
    for (size_t i = 0; i < 2; i++) {
        if (function->records[i]) given->records[i] = it->records[i];
    }
    if (function->makes) given->made = &it->made;
}

void make(call *it) {
    const kind makes = it->function->makes;
    it->times++;
    it->made.any = it; /* must be overwritten */
    it->status = it->function->call(&it->given);
    if (it->given.made) CHECK((it->made.any == NULL) == (it->status != TAUT_STATUS_OK) && it->made.any != it);
    if (it->status != TAUT_STATUS_OK || !makes) return;
    contents_of(makes, it->made, it->contents);
    freers[makes].free(it->made);
}

bool is_all(const unsigned char *bytes, size_t count, unsigned char value) {
    for (size_t i = 0; i < count; i++) {
        if (bytes[i] != value) return false;
    }
    return true;
}

bool is_untouched(const call *it) {
    const size_t size = it->function->record_has_a_size ? sizeof(size_t) : 0; /* the caller's own */
    return is_all(it->outputs[0], sizeof it->outputs, UNTOUCHED) && is_all(it->records[0] + size, ROOM - size, UNTOUCHED) &&
           is_all(it->records[1], ROOM, UNTOUCHED);
}
