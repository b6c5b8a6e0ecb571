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
    const std::vector<std::uint32_t> vertices{static_cast<std::uint32_t>(n / 3), 0, static_cast<std::uint32_t>(n - 1)};
    const taut_sources sources = from_vertices(vertices);
    const Handle<taut_exact> exact = prepared(peers);
    std::vector<double> rows(vertices.size() * n);
    check(taut_exact_distance_rows(exact.get(), &sources, taut_input{}, 2, nullptr,
                                   taut_output{rows.data(), vertices.size(), 0, TAUT_TYPE_F64, 0}));
    const double radius = largest(rows) / 3;
    taut_sparse_distances *sparse = nullptr;
    check(taut_exact_distances_within(exact.get(), &sources, radius, 2, nullptr, &sparse));
    const Handle<taut_sparse_distances> sparse_owner(sparse, taut_sparse_distances_free);
    std::vector<std::uint64_t> offsets(vertices.size() + 1), expected_offsets{0};
    std::vector<std::uint32_t> near(taut_sparse_distances_count(sparse)), expected_near;
    std::vector<double> distances(near.size()), expected_distances, expected_rows;
    check(taut_sparse_distances_offsets(sparse, taut_output{offsets.data(), offsets.size(), 0, TAUT_TYPE_U64, 0}));
    check(taut_sparse_distances_vertices(sparse, taut_output{near.data(), near.size(), 0, TAUT_TYPE_U32, 0}));
    check(taut_sparse_distances_values(sparse, taut_output{distances.data(), near.size(), 0, TAUT_TYPE_F64, 0}));

    for (const std::uint32_t vertex : vertices) {
        const std::vector<double> row = exact_distances(peers, {vertex});
        expected_rows.insert(expected_rows.end(), row.begin(), row.end());
        for (std::size_t v = 0; v < n; v++) {
            if (row[v] > radius) continue;
            expected_near.push_back(static_cast<std::uint32_t>(v));
            expected_distances.push_back(row[v]);
        }
        expected_offsets.push_back(expected_near.size());
    }
    return rows == expected_rows && offsets == expected_offsets && near == expected_near &&
           distances == expected_distances;
}

// Whether each farthest point is the vertex with the largest distance from all before it.
static bool farthest_points_agree(const Peers &peers) {
    const std::size_t COUNT = 6;
    std::vector<std::uint32_t> taken{0}, samples(COUNT);
    std::vector<double> distances(COUNT);
    const taut_sources first = from_vertices(taken);
    check(taut_exact_farthest_points(prepared(peers).get(), &first, COUNT, nullptr,
                                     taut_output{samples.data(), COUNT, 0, TAUT_TYPE_U32, 0},
                                     taut_output{distances.data(), COUNT, 0, TAUT_TYPE_F64, 0}));
    for (std::size_t i = 0; i < COUNT; i++) {
        const std::vector<double> all = exact_distances(peers, taken);
        const double most = *std::max_element(all.begin(), all.end());
        for (const double d : {distances[i], all[samples[i]]})
            if (!(d == most || std::abs(d - most) <= 1e-14 * most)) return false;
        taken.push_back(samples[i]);
    }
    return true;
}

static bool agree(const char *name, const Peers &peers) {
    const std::uint32_t source = static_cast<std::uint32_t>(peers.vertex_count() / 3);
    const std::vector<double> ours = exact_distances(peers, {source}), theirs = cgal_distances(peers.cgal, source);
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
