// CGAL's geodesic distances, as scripts/bench-peers calls a program: cgal METHOD MESH.off SOURCE DISTANCES
// METHOD is exact, heat (the mesh's own triangles) or intrinsic (heat on the intrinsic Delaunay triangulation).
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace processing = CGAL::Polygon_mesh_processing;

static double cpu() { return double(std::clock()) / CLOCKS_PER_SEC; }

// A line of this process's status, in MB of 10^6 bytes.
static double memory(const std::string &name) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (word == name + ":") {
            double kilobytes = 0;
            status >> kilobytes;
            return kilobytes * 1024 / 1e6;
        }
    return std::numeric_limits<double>::quiet_NaN();
}

struct Soup {
    std::vector<Kernel::Point_3> points;
    std::vector<std::vector<std::size_t>> triangles;

    Mesh mesh() const {
        Mesh mesh;
        processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);
        return mesh;
    }
};

// What a run found and what it took.
struct Run {
    double setup, solve, megabytes;
    std::vector<double> distances;
};

// The mesh is given: its set-up is the preparation of the source.
static Run exact(const Soup &soup, Mesh::Vertex_index source) {
    using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
    const Mesh mesh = soup.mesh();
    const double with_mesh = memory("VmRSS");
    std::ofstream("/proc/self/clear_refs") << 5; // the peak starts anew
    const double start = cpu();
    Paths paths(mesh);
    paths.add_source_point(source); // as a vertex: a point with rounded weights would lie beside it
    const double ready = cpu();
    paths.build_sequence_tree();
    std::vector<double> distances;
    for (const auto v : mesh.vertices()) distances.push_back(paths.shortest_distance_to_source_points(v).first);
    const double end = cpu();
    return {ready - start, end - ready, memory("VmHWM") - with_mesh, distances};
}

// Buffers are given: set-up builds the mesh as well. The solve is the median of five that follow a first one.
template <class Mode> static Run heat(const Soup &soup, Mesh::Vertex_index source) {
    const double with_buffers = memory("VmRSS");
    std::ofstream("/proc/self/clear_refs") << 5;
    const double start = cpu();
    Mesh mesh = soup.mesh();
    const auto distance = mesh.add_property_map<Mesh::Vertex_index, double>("v:distance").first;
    CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<Mesh, Mode> method(mesh);
    const double ready = cpu();
    std::array<double, 6> solves;
    for (double &solve : solves) {
        const double from = cpu();
        method.clear_sources(); // else it would keep the last answer
        method.add_source(source);
        method.estimate_geodesic_distances(distance);
        solve = cpu() - from;
    }
    std::sort(solves.begin() + 1, solves.end());
    return {ready - start, solves[3], memory("VmHWM") - with_buffers, {distance.begin(), distance.end()}};
}

int main(int argc, char **argv) {
    if (argc != 5) return 2;
    const std::string method = argv[1];
    std::ifstream file(argv[2]);
    std::string off;
    std::size_t vertices = 0, faces = 0, edges = 0;
    file >> off >> vertices >> faces >> edges;
    Soup soup;
    for (std::size_t v = 0; v < vertices; v++) {
        double x = 0, y = 0, z = 0;
        file >> x >> y >> z;
        soup.points.emplace_back(x, y, z);
    }
    soup.triangles.assign(faces, std::vector<std::size_t>(3));
    for (auto &triangle : soup.triangles) {
        int corners = 0;
        file >> corners >> triangle[0] >> triangle[1] >> triangle[2];
    }
    // False where a vertex was doubled: then it is no orientable manifold, and CGAL has no answer for it.
    if (!file || !processing::orient_polygon_soup(soup.points, soup.triangles)) return 1;

    const Mesh::Vertex_index source(static_cast<Mesh::size_type>(std::stoul(argv[3])));
    const Run run = method == "exact"  ? exact(soup, source)
                    : method == "heat" ? heat<CGAL::Heat_method_3::Direct>(soup, source)
                                       : heat<CGAL::Heat_method_3::Intrinsic_Delaunay>(soup, source);
    std::cout << run.setup << ' ' << run.solve << ' ' << run.megabytes << '\n';

    std::ofstream out(argv[4]);
    out << std::setprecision(17);
    for (const double d : run.distances) out << d << '\n';
    return out.flush() ? 0 : 1;
}
