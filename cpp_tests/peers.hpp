// One mesh in two libraries: OpenMesh reads the file, taut and CGAL get the same vertices under the same numbers.
#pragma once

#include <taut.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Doubles : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using OpenTriMesh = OpenMesh::TriMesh_ArrayKernelT<Doubles>;

inline void check(taut_status status) {
    if (status != TAUT_STATUS_OK) throw std::runtime_error(taut_last_error(nullptr));
}

// A handle of taut's that frees itself.
template <class T>
using Handle = std::unique_ptr<T, void (*)(T *)>;

struct Peers {
    Handle<taut_mesh> taut{nullptr, taut_mesh_free};
    CgalMesh cgal;

    std::size_t vertex_count() const { return cgal.number_of_vertices(); }
};

// Reads data/meshes/NAME.off without the vertices that no face uses, which CGAL's exact code cannot take.
inline Peers read_peers(const std::string &name) {
    OpenTriMesh open;
    if (!OpenMesh::IO::read_mesh(open, "data/meshes/" + name + ".off")) throw std::runtime_error("cannot read " + name);
    open.request_vertex_status();
    open.request_edge_status();
    open.request_face_status();
    open.delete_isolated_vertices();
    open.garbage_collection();

    Peers peers;
    for (const auto v : open.vertices()) {
        const auto &p = open.point(v);
        peers.cgal.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    }
    std::vector<std::int32_t> corners;
    for (const auto f : open.faces()) {
        std::vector<CgalMesh::Vertex_index> face;
        for (const auto v : f.vertices()) {
            corners.push_back(v.idx());
            face.emplace_back(v.idx());
        }
        if (peers.cgal.add_face(face) == CgalMesh::null_face()) throw std::runtime_error(name + " is not manifold");
    }
    const taut_input positions{open.points(), open.n_vertices(), sizeof(OpenMesh::Vec3d), TAUT_TYPE_F64, 0};
    const taut_input triangles{corners.data(), open.n_faces(), 0, TAUT_TYPE_I32, 0};
    taut_mesh *mesh = nullptr;
    check(taut_mesh_new(positions, triangles, &mesh));
    peers.taut.reset(mesh);
    return peers;
}

inline taut_sources from_vertices(const std::vector<std::uint32_t> &vertices) {
    taut_sources sources = {};
    sources.struct_size = sizeof sources;
    sources.vertices = {vertices.data(), vertices.size(), 0, TAUT_TYPE_U32, 0};
    return sources;
}

inline Handle<taut_exact> prepared(const Peers &peers) {
    taut_exact *exact = nullptr;
    check(taut_exact_new(peers.taut.get(), &exact));
    return {exact, taut_exact_free};
}

inline std::vector<double> exact_distances(const Peers &peers, const std::vector<std::uint32_t> &vertices) {
    const taut_sources sources = from_vertices(vertices);
    const Handle<taut_exact> exact = prepared(peers);
    taut_exact_field *field = nullptr;
    check(taut_exact_field_new(exact.get(), &sources, nullptr, nullptr, &field));
    const Handle<taut_exact_field> field_owner(field, taut_exact_field_free);
    std::vector<double> distances(peers.vertex_count());
    check(taut_exact_field_distances(field, nullptr, taut_output{distances.data(), distances.size(), 0, TAUT_TYPE_F64, 0}));
    return distances;
}

// The largest finite distance.
inline double largest(const std::vector<double> &distances) {
    double most = 0;
    for (const double d : distances)
        if (std::isfinite(d)) most = std::max(most, d);
    return most;
}

// Runs `compare` on each mesh; a mesh that throws or returns false fails the test.
template <class Compare>
int for_each_mesh(const std::vector<const char *> &names, Compare compare) {
    int failures = 0;
    for (const char *name : names) {
        try {
            failures += compare(name, read_peers(name)) ? 0 : 1;
        } catch (const std::exception &error) {
            std::printf("%s: %s\n", name, error.what());
            failures++;
        }
        std::fflush(stdout);
    }
    return failures == 0 ? 0 : 1;
}
