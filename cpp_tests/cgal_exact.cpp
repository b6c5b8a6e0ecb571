// Exact distances against CGAL's Surface_mesh_shortest_path, at every vertex: closed and open surfaces, several
// components, scans and mechanical parts.
#include "peers.hpp"

#include <CGAL/Surface_mesh_shortest_path.h>

using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>>;

// Rounding: both are right to about 1e-15 of the largest distance on ordinary meshes.
const double TOLERANCE = 1e-12;

// CGAL's distances. The source is given as a vertex, since a point with rounded weights would lie beside it.
static std::vector<double> cgal_distances(const CgalMesh &mesh, std::uint32_t source) {
    Paths paths(mesh);
    paths.add_source_point(CgalMesh::Vertex_index(source));
    paths.build_sequence_tree();
    std::vector<double> distances;
    for (const auto v : mesh.vertices()) {
        const double d = paths.shortest_distance_to_source_points(v).first;
        distances.push_back(d < 0 ? std::numeric_limits<double>::infinity() : d); // -1: no source reaches it
    }
    return distances;
}

static bool agree(const char *name, const Peers &peers) {
    const std::uint32_t source = static_cast<std::uint32_t>(peers.vertex_count() / 3);
    const std::vector<double> ours = exact_distances(peers, source), theirs = cgal_distances(peers.cgal, source);
    double worst = 0;
    std::size_t unreached = 0;
    for (std::size_t v = 0; v < ours.size(); v++) {
        if (std::isinf(ours[v]) != std::isinf(theirs[v])) worst = std::numeric_limits<double>::infinity();
        else if (std::isinf(ours[v])) unreached++;
        else worst = std::max(worst, std::abs(ours[v] - theirs[v]));
    }
    const double relative = worst / largest(theirs);
    std::printf("%-18s %6zu vertices, %5zu unreached, differ by %.1e of the largest\n", name, ours.size(), unreached,
                relative);
    return relative <= TOLERANCE;
}

int main() {
    return for_each_mesh({"elephant", "fandisk", "cow", "pig", "hand", "head", "camel", "knot1", "mushroom", "bull",
                          "dino", "homer", "triceratops", "rotor", "anchor", "spool", "blobby_3cc", "mask_cone",
                          "elephant-with-holes", "lion-head"},
                         agree);
}
