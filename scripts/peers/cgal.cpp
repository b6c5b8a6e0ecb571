// CGAL's exact geodesic distances, as scripts/bench-peers calls a program: cgal MESH.off SOURCE DISTANCES
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;
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

int main(int argc, char **argv) {
    if (argc != 4) return 2;
    std::ifstream file(argv[1]);
    std::string off;
    std::size_t vertices = 0, faces = 0, edges = 0;
    file >> off >> vertices >> faces >> edges;
    std::vector<Kernel::Point_3> points;
    for (std::size_t v = 0; v < vertices; v++) {
        double x = 0, y = 0, z = 0;
        file >> x >> y >> z;
        points.emplace_back(x, y, z);
    }
    std::vector<std::vector<std::size_t>> triangles(faces, std::vector<std::size_t>(3));
    for (auto &triangle : triangles) {
        int corners = 0;
        file >> corners >> triangle[0] >> triangle[1] >> triangle[2];
    }
    // False where a vertex was doubled: then it is no orientable manifold, and CGAL has no answer for it.
    if (!file || !processing::orient_polygon_soup(points, triangles)) return 1;
    Mesh mesh;
    processing::polygon_soup_to_polygon_mesh(points, triangles, mesh);

    const double with_mesh = memory("VmRSS");
    std::ofstream("/proc/self/clear_refs") << 5; // the peak starts anew
    const double start = cpu();
    Paths paths(mesh);
    // As a vertex: a point with rounded weights would lie beside it.
    paths.add_source_point(Mesh::Vertex_index(static_cast<Mesh::size_type>(std::stoul(argv[2]))));
    const double ready = cpu();
    paths.build_sequence_tree();
    std::vector<double> distances;
    for (const auto v : mesh.vertices()) distances.push_back(paths.shortest_distance_to_source_points(v).first);
    const double end = cpu();
    std::cout << ready - start << ' ' << end - ready << ' ' << memory("VmHWM") - with_mesh << '\n';

    std::ofstream out(argv[3]);
    out << std::setprecision(17);
    for (const double d : distances) out << d << '\n';
    return out.flush() ? 0 : 1;
}
