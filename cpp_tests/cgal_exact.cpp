// Exact distances against CGAL's Surface_mesh_shortest_path, at every vertex: closed and open surfaces, several
// components, scans and mechanical parts. Many at once against one at a time.
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

// Whether rows, dense and within a radius, are the distances of one source at a time, to the bit.
static bool rows_agree(const Peers &peers) {
    const std::size_t n = peers.vertex_count();
    const std::vector<std::size_t> vertices{n / 3, 0, n - 1};
    const taut::ExactSolver solver(peers.mesh);
    const std::vector<double> rows = solver.distance_rows(vertices, 2);
    const double radius = largest(rows) / 3;
    const taut::SparseDistances near = solver.distances_within(vertices, radius, 2);

    std::vector<std::uint64_t> offsets{0};
    std::vector<std::uint32_t> near_vertices;
    std::vector<double> near_distances, expected_rows;
    for (const std::size_t vertex : vertices) {
        const std::vector<double> row = solver.field(vertex).distances();
        expected_rows.insert(expected_rows.end(), row.begin(), row.end());
        for (std::size_t v = 0; v < n; v++) {
            if (row[v] > radius) continue;
            near_vertices.push_back(static_cast<std::uint32_t>(v));
            near_distances.push_back(row[v]);
        }
        offsets.push_back(near_vertices.size());
    }
    return rows == expected_rows && near.offsets() == offsets && near.vertices() == near_vertices &&
           near.values() == near_distances;
}

// Whether each farthest point is the vertex with the largest distance from all before it.
static bool farthest_points_agree(const Peers &peers) {
    const taut::ExactSolver solver(peers.mesh);
    const auto [samples, distances] = solver.farthest_points(0, 6);
    std::vector<std::uint32_t> taken{0};
    for (std::size_t i = 0; i < samples.size(); i++) {
        const std::vector<double> all = solver.field(taken).distances();
        const double most = *std::max_element(all.begin(), all.end());
        for (const double d : {distances[i], all[samples[i]]})
            if (!(d == most || std::abs(d - most) <= 1e-14 * most)) return false;
        taken.push_back(samples[i]);
    }
    return true;
}

static bool agree(const char *name, const Peers &peers) {
    const std::uint32_t source = static_cast<std::uint32_t>(peers.vertex_count() / 3);
    const std::vector<double> ours = taut::ExactSolver(peers.mesh).field(source).distances();
    const std::vector<double> theirs = cgal_distances(peers.cgal, source);
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
    return relative <= TOLERANCE && rows_agree(peers) && farthest_points_agree(peers);
}

int main() {
    return for_each_mesh({"elephant", "fandisk", "cow", "pig", "hand", "head", "camel", "knot1", "mushroom", "bull",
                          "dino", "homer", "triceratops", "rotor", "anchor", "spool", "blobby_3cc", "mask_cone",
                          "elephant-with-holes", "lion-head"},
                         agree);
}
