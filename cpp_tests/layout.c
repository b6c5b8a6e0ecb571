/* The binary layout of every struct, as it is frozen for this interface; compiled as C99, C++11 and C++20. */
#include "taut.h"

/* Fails to compile where `condition` is false. */
#define ASSERT(name, condition) typedef char name[(condition) ? 1 : -1]
#define FIELD(type, field, offset) ASSERT(type##_##field##_offset, offsetof(type, field) == (offset))
#define SIZE(type, size) ASSERT(type##_size, sizeof(type) == (size))

ASSERT(enums_are_32_bits, sizeof(taut_status) == 4 && sizeof(taut_reason) == 4 && sizeof(taut_element) == 4);
ASSERT(types_are_32_bits, sizeof(taut_type) == 4 && sizeof(taut_laplacian) == 4);

#if UINTPTR_MAX == UINT64_MAX
SIZE(taut_input, 32);
FIELD(taut_input, data, 0);
FIELD(taut_input, count, 8);
FIELD(taut_input, stride, 16);
FIELD(taut_input, type, 24);
FIELD(taut_input, reserved, 28);

SIZE(taut_output, 32);
FIELD(taut_output, data, 0);
FIELD(taut_output, count, 8);
FIELD(taut_output, stride, 16);
FIELD(taut_output, type, 24);
FIELD(taut_output, reserved, 28);

SIZE(taut_sources, 264);
FIELD(taut_sources, struct_size, 0);
FIELD(taut_sources, vertices, 8);
FIELD(taut_sources, offsets, 40);
FIELD(taut_sources, faces, 72);
FIELD(taut_sources, barycentrics, 104);
FIELD(taut_sources, curve_offsets, 136);
FIELD(taut_sources, curve_faces, 168);
FIELD(taut_sources, curve_barycentrics, 200);
FIELD(taut_sources, curve_closed, 232);

SIZE(taut_targets, 104);
FIELD(taut_targets, struct_size, 0);
FIELD(taut_targets, vertices, 8);
FIELD(taut_targets, faces, 40);
FIELD(taut_targets, barycentrics, 72);

SIZE(taut_time_step, 24);
FIELD(taut_time_step, formula, 0);
FIELD(taut_time_step, scale, 4);
FIELD(taut_time_step, factor, 8);
FIELD(taut_time_step, value, 16);

SIZE(taut_heat_report, 88);
FIELD(taut_heat_report, struct_size, 0);
FIELD(taut_heat_report, flips, 8);
FIELD(taut_heat_report, doubled_triangles, 16);
FIELD(taut_heat_report, stuck_edges, 24);
FIELD(taut_heat_report, flip_bound_reached, 32);
FIELD(taut_heat_report, mollified, 36);
FIELD(taut_heat_report, delaunay_seconds, 40);
FIELD(taut_heat_report, assembly_seconds, 48);
FIELD(taut_heat_report, order_seconds, 56);
FIELD(taut_heat_report, symbolic_seconds, 64);
FIELD(taut_heat_report, poisson_seconds, 72);
FIELD(taut_heat_report, heat_seconds, 80);

SIZE(taut_heat_residuals, 24);
FIELD(taut_heat_residuals, struct_size, 0);
FIELD(taut_heat_residuals, heat, 8);
FIELD(taut_heat_residuals, poisson, 16);

SIZE(taut_heat_options, 56);
FIELD(taut_heat_options, struct_size, 0);
FIELD(taut_heat_options, time_step, 8);
FIELD(taut_heat_options, boundary, 32);
FIELD(taut_heat_options, laplacian, 40);
FIELD(taut_heat_options, shift, 44);
FIELD(taut_heat_options, solver, 48);
FIELD(taut_heat_options, reserved, 52);

SIZE(taut_exact_options, 32);
FIELD(taut_exact_options, struct_size, 0);
FIELD(taut_exact_options, targets, 8);
FIELD(taut_exact_options, radius, 16);
FIELD(taut_exact_options, allow_partial, 24);
FIELD(taut_exact_options, keep_windows, 28);

SIZE(taut_error, 32);
FIELD(taut_error, struct_size, 0);
FIELD(taut_error, status, 8);
FIELD(taut_error, reason, 12);
FIELD(taut_error, element, 16);
FIELD(taut_error, reserved, 20);
FIELD(taut_error, index, 24);

SIZE(taut_angle, 16);
FIELD(taut_angle, radians, 0);
FIELD(taut_angle, face, 8);
FIELD(taut_angle, vertex, 12);

SIZE(taut_component, 40);
FIELD(taut_component, struct_size, 0);
FIELD(taut_component, vertices, 8);
FIELD(taut_component, edges, 12);
FIELD(taut_component, faces, 16);
FIELD(taut_component, first_vertex, 20);
FIELD(taut_component, boundary_loops, 24);
FIELD(taut_component, manifold, 28);
FIELD(taut_component, orientable, 32);
FIELD(taut_component, genus, 36);

SIZE(taut_properties, 160);
FIELD(taut_properties, struct_size, 0);
FIELD(taut_properties, vertices, 8);
FIELD(taut_properties, edges, 16);
FIELD(taut_properties, faces, 24);
FIELD(taut_properties, mean_edge, 32);
FIELD(taut_properties, variance_edge, 40);
FIELD(taut_properties, sigma_edge, 48);
FIELD(taut_properties, mean_absolute_deviation, 56);
FIELD(taut_properties, median_absolute_deviation, 64);
FIELD(taut_properties, min_edge, 72);
FIELD(taut_properties, max_edge, 80);
FIELD(taut_properties, edge_ratio, 88);
FIELD(taut_properties, q1, 96);
FIELD(taut_properties, q2, 104);
FIELD(taut_properties, q3, 112);
FIELD(taut_properties, quartile_deviation, 120);
FIELD(taut_properties, min_angle, 128);
FIELD(taut_properties, max_angle, 136);
FIELD(taut_properties, anisotropy, 144);
FIELD(taut_properties, paper_scale, 152);
#endif

/* The program that was compiled with this header runs with a library that has the same interface. */
int main(void) {
    return taut_abi() == TAUT_ABI ? 0 : 1;
}
