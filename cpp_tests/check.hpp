// What the tests of taut.hpp share: checks that count, and a mesh.
#pragma once

#include <taut.hpp>

#include <cmath>
#include <cstdio>

inline int failures = 0;

#define CHECK(condition)                                                                                              \
    do {                                                                                                              \
        if (condition) break;                                                                                         \
        failures++;                                                                                                   \
        std::printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                                           \
    } while (false)

// Whether `work` throws a taut::Error of this reason that names this element.
template <class Work>
bool fails(const Work &work, taut_reason reason, taut_element element = TAUT_ELEMENT_NONE, std::uint64_t index = 0) {
    try {
        work();
        return false;
    } catch (const taut::Error &error) {
        if (error.reason() == reason && error.element() == element && error.index() == index) return true;
        std::printf("reason %d, element %d, index %d: %s\n", static_cast<int>(error.reason()),
                    static_cast<int>(error.element()), static_cast<int>(error.index()), error.what());
        return false;
    }
}

using Position = std::array<double, 3>;
using Triangle = std::array<int, 3>;

// A hilly square of n x n vertices, one unit apart.
struct Hills {
    explicit Hills(int n) {
        for (int y = 0; y < n; y++)
            for (int x = 0; x < n; x++)
                positions.push_back({double(x), double(y), std::sin(0.9 * x) * std::cos(0.7 * y)});
        for (int y = 1; y < n; y++)
            for (int x = 1; x < n; x++) {
                const int v = y * n + x;
                triangles.push_back({v - n - 1, v - n, v});
                triangles.push_back({v - n - 1, v, v - 1});
            }
    }
    taut::Mesh mesh() const { return {positions, triangles}; }

    std::vector<Position> positions;
    std::vector<Triangle> triangles;
};

// What C tells from one vertex: the distances by heat, then the exact ones.
inline std::vector<double> c_distances(const Hills &hills, std::uint32_t source) {
    const std::size_t count = hills.positions.size();
    const taut_input positions{hills.positions.data(), count, 0, TAUT_TYPE_F64, 0};
    const taut_input triangles{hills.triangles.data(), hills.triangles.size(), 0, TAUT_TYPE_I32, 0};
    taut_sources from = {};
    from.struct_size = sizeof from;
    from.vertices = {&source, 1, 0, TAUT_TYPE_U32, 0};
    std::vector<double> distances(2 * count);
    taut_mesh *mesh = nullptr;
    taut_heat *heat = nullptr;
    taut_heat_field *heat_field = nullptr;
    taut_exact *exact = nullptr;
    taut_exact_field *exact_field = nullptr;
    taut::check(taut_mesh_new(positions, triangles, &mesh));
    taut::check(taut_heat_new(mesh, nullptr, nullptr, &heat));
    taut::check(taut_heat_field_new(heat, &from, nullptr, &heat_field));
    taut::check(taut_heat_field_distances(heat_field, {distances.data(), count, 0, TAUT_TYPE_F64, 0}));
    taut::check(taut_exact_new(mesh, &exact));
    taut::check(taut_exact_field_new(exact, &from, nullptr, nullptr, &exact_field));
    taut::check(taut_exact_field_distances(exact_field, nullptr, {distances.data() + count, count, 0, TAUT_TYPE_F64, 0}));
    taut_exact_field_free(exact_field);
    taut_exact_free(exact);
    taut_heat_field_free(heat_field);
    taut_heat_free(heat);
    taut_mesh_free(mesh);
    return distances;
}

// The same of a mesh that an adapter made.
template <class Source>
std::vector<double> distances(const taut::Mesh &mesh, const Source &source) {
    std::vector<double> distances = taut::HeatSolver(mesh).field(source).distances();
    const std::vector<double> exact = taut::ExactSolver(mesh).field(source).distances();
    distances.insert(distances.end(), exact.begin(), exact.end());
    return distances;
}
