// taut with CGAL::Surface_mesh: the exact distance between two vertices, and the shortest path.
//
//     cgal MESH FROM TO
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <taut/cgal.hpp>

#include <cstdio>
#include <string>

using Surface = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

int main(int argc, char **argv) {
    if (argc != 4) {
        std::fprintf(stderr, "usage: cgal MESH FROM TO\n");
        return 2;
    }
    try {
        Surface surface;
        if (!CGAL::IO::read_polygon_mesh(argv[1], surface)) throw std::runtime_error(std::string("cannot read ") + argv[1]);
        const auto vertex = [](const char *number) {
            return Surface::Vertex_index(static_cast<std::uint32_t>(std::stoul(number)));
        };
        const Surface::Vertex_index from = vertex(argv[2]), to = vertex(argv[3]);

        taut::ExactOptions options;
        options.targets = to; // the work stops once this one is final
        const taut::ExactField field = taut::ExactSolver(taut::make_mesh(surface)).field(from, options);
        std::printf("distance %.17g\n", field.distances(to)[0]);
        for (const auto &[x, y, z] : field.paths(to).positions()) std::printf("%g %g %g\n", x, y, z);
    } catch (const std::exception &error) {
        std::fprintf(stderr, "cgal: %s\n", error.what());
        return 1;
    }
}
