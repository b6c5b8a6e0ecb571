// One mesh in two libraries: OpenMesh reads the file, taut and CGAL get the same vertices under the same numbers.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <taut/cgal.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
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

struct Peers {
    std::size_t vertex_count() const { return mesh.vertex_count(); }

    CgalMesh cgal;
    taut::Mesh mesh = taut::make_mesh(cgal);
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

    CgalMesh cgal;
    for (const auto v : open.vertices()) {
        const auto &p = open.point(v);
        cgal.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
    }
    for (const auto f : open.faces()) {
        std::vector<CgalMesh::Vertex_index> face;
        for (const auto v : f.vertices()) face.emplace_back(v.idx());
        if (cgal.add_face(face) == CgalMesh::null_face()) throw std::runtime_error(name + " is not manifold");
    }
    return {std::move(cgal)};
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
