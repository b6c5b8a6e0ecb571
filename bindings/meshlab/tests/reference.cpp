// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// What the library says outside of any host: the distances of a mesh file's vertices, as floats in the machine's order.
//
//     reference MESH exact|heat vertices INDEX... | faces INDEX... | point X Y Z
#include <taut.hpp>

#include <cstdio>
#include <cstdlib>

int main(int argc, char **argv) {
    if (argc < 5) return 2;
    const std::string method = argv[2], kind = argv[3];
    std::vector<double> numbers;
    for (int i = 4; i < argc; i++) numbers.push_back(std::atof(argv[i]));
    const std::vector<std::uint32_t> indices(numbers.begin(), numbers.end());
    try {
        const taut::Mesh mesh = taut::Mesh::read(argv[1]);
        taut::Sources sources;
        if (kind == "vertices") sources = indices;
        if (kind == "faces") {
            const double third = 1.0 / 3.0;
            sources = sources.with_points(indices, std::vector<double>(3 * indices.size(), third));
        }
        if (kind == "point") {
            const taut::ClosestPoints place = taut::Closest(mesh).points(numbers);
            sources = sources.with_points(place.faces, place.barycentrics);
        }
        std::vector<float> distances(mesh.vertex_count());
        if (method == "exact") taut::ExactSolver(mesh).field(sources).distances(distances);
        else taut::HeatSolver(mesh).field(sources).distances(distances);
        return std::fwrite(distances.data(), sizeof(float), distances.size(), stdout) == distances.size() ? 0 : 1;
    } catch (const taut::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
