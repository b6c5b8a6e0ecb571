// The heat method against CGAL's Heat_method_3: one source, the same time step, connected surfaces (CGAL gives other
// components a distance too).
#include "peers.hpp"

#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>

using Intrinsic = CGAL::Heat_method_3::Intrinsic_Delaunay_triangulation_3<CgalMesh, Kernel>;

// The mean edge of CGAL's time step, which is its square: each edge counts once. The intrinsic triangulation gives a
// vertex other coordinates in each face, so edges are measured face by face.
template <class Triangulation>
static double mean_edge(const Triangulation &mesh) {
    const auto point = get(boost::vertex_point, mesh);
    double sum = 0;
    for (const auto f : faces(mesh)) {
        auto h = halfedge(f, mesh);
        for (int corner = 0; corner < 3; corner++) {
            const auto next_h = next(h, mesh);
            const double weight = is_border(opposite(next_h, mesh), mesh) ? 1.0 : 0.5;
            sum += weight * std::sqrt(squared_distance(get(point, target(h, mesh)), get(point, target(next_h, mesh))));
            h = next_h;
        }
    }
    return sum / num_edges(mesh);
}

template <class Mode>
static std::vector<double> cgal_distances(const CgalMesh &mesh, std::uint32_t source) {
    CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<CgalMesh, Mode> heat(mesh);
    heat.add_source(CgalMesh::Vertex_index(source));
    CgalMesh copy = mesh;
    const auto distance = copy.add_property_map<CgalMesh::Vertex_index, double>("v:distance", 0).first;
    heat.estimate_geodesic_distances(distance);
    std::vector<double> distances;
    for (const auto v : mesh.vertices()) distances.push_back(distance[v]);
    return distances;
}

static std::vector<double> taut_distances(const Peers &peers, taut_laplacian laplacian, double t, std::uint32_t source) {
    taut_heat_options options = {};
    options.struct_size = sizeof options;
    options.laplacian = laplacian;
    options.time_step.value = t;
    taut_heat *heat = nullptr;
    check(taut_heat_new(peers.taut.get(), &options, nullptr, &heat));
    const Handle<taut_heat> owner(heat, taut_heat_free);
    const taut_sources sources = from_vertex(source);
    std::vector<double> distances(peers.vertex_count());
    check(taut_heat_distances(heat, &sources, nullptr, taut_output{distances.data(), distances.size(), 0, TAUT_TYPE_F64}));
    return distances;
}

// The mean of |a - b| as a share of the largest value of b.
static double mean_difference(const std::vector<double> &a, const std::vector<double> &b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); v++) sum += std::abs(a[v] - b[v]);
    return sum / static_cast<double>(a.size()) / largest(b);
}

static bool agree(const char *name, const Peers &peers) {
    const std::uint32_t source = static_cast<std::uint32_t>(peers.vertex_count() / 3);
    const double e = mean_edge(peers.cgal), intrinsic_e = mean_edge(Intrinsic(peers.cgal));
    const auto exact = exact_distances(peers, source);
    const auto plain = taut_distances(peers, TAUT_LAPLACIAN_PLAIN, e * e, source);
    const auto intrinsic = taut_distances(peers, TAUT_LAPLACIAN_INTRINSIC, intrinsic_e * intrinsic_e, source);
    const auto cgal_plain = cgal_distances<CGAL::Heat_method_3::Direct>(peers.cgal, source);
    const auto cgal_intrinsic = cgal_distances<CGAL::Heat_method_3::Intrinsic_Delaunay>(peers.cgal, source);
    const double plain_gap = mean_difference(plain, cgal_plain);
    const double intrinsic_gap = mean_difference(intrinsic, cgal_intrinsic);
    const double error = mean_difference(intrinsic, exact), cgal_error = mean_difference(cgal_intrinsic, exact);
    std::printf("%-14s to CGAL: plain %.1e, intrinsic %.1e. To exact: plain %.4f (CGAL %.4f), intrinsic %.4f (%.4f)\n",
                name, plain_gap, intrinsic_gap, mean_difference(plain, exact), mean_difference(cgal_plain, exact), error,
                cgal_error);
    return plain_gap <= 1e-4 && intrinsic_gap <= 1e-4 && error <= 1.05 * cgal_error;
}

int main() {
    return for_each_mesh({"elephant", "fandisk", "cow", "pig", "hand", "head", "camel", "knot1", "bull", "dino", "homer",
                          "lion-head"},
                         agree);
}
