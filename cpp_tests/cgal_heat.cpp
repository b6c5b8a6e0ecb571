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

static std::vector<double> taut_distances(const Peers &peers, taut_laplacian laplacian, double t,
                                          std::uint32_t source) {
    taut::HeatOptions options(taut::TimeStep::value(t));
    options.laplacian = laplacian;
    return taut::HeatSolver(peers.mesh, options).field(source).distances();
}

// The mean of |a - b| as a share of the largest value of b.
static double mean_difference(const std::vector<double> &a, const std::vector<double> &b) {
    double sum = 0;
    for (std::size_t v = 0; v < a.size(); v++) sum += std::abs(a[v] - b[v]);
    return sum / static_cast<double>(a.size()) / largest(b);
}

// CGAL adds 1e-8 per corner to the diagonal of its Laplacian, to make it regular. That moves the distances by 1e-6 of
// the largest on 500 vertices and by 7e-5 on 10,000. With 1e-13 in its place both agreed to 1e-9, but for fandisk on
// intrinsic Delaunay (1.5e-5), where cocircular corners allow several triangulations.
const double TOLERANCE = 2e-4;

// The method's own error on these coarse meshes, as a share of the largest distance: 3.2e-2 at most was measured.
const double HEAT_ERROR = 4e-2;

template <class Mode>
static bool agree(const char *name, const Peers &peers, taut_laplacian laplacian, double e) {
    const std::uint32_t source = static_cast<std::uint32_t>(peers.vertex_count() / 3);
    const auto exact = taut::ExactSolver(peers.mesh).field(source).distances();
    const auto theirs = cgal_distances<Mode>(peers.cgal, source);
    const auto ours = taut_distances(peers, laplacian, e * e, source);
    const double gap = mean_difference(ours, theirs), error = mean_difference(ours, exact);
    const char *which = laplacian == TAUT_LAPLACIAN_PLAIN ? "plain    " : "intrinsic";
    std::printf("%-10s %s: to CGAL %.1e, to exact %.4f (CGAL %.4f)\n", name, which, gap, error,
                mean_difference(theirs, exact));
    return gap <= TOLERANCE && error <= HEAT_ERROR;
}

static bool plain_agrees(const char *name, const Peers &peers) {
    return agree<CGAL::Heat_method_3::Direct>(name, peers, TAUT_LAPLACIAN_PLAIN, mean_edge(peers.cgal));
}

static bool intrinsic_agrees(const char *name, const Peers &peers) {
    const double e = mean_edge(Intrinsic(peers.cgal));
    return agree<CGAL::Heat_method_3::Intrinsic_Delaunay>(name, peers, TAUT_LAPLACIAN_INTRINSIC, e);
}

int main() {
    // On plain cotangents the heat turns negative where obtuse triangles are many. CGAL then takes its absolute value,
    // which the method does not say, so the two differ on the other meshes: by 0.18 of the largest distance on cow,
    // where they agreed to 1e-10 once CGAL was made to leave the sign alone.
    const std::vector<const char *> well_shaped = {"elephant", "fandisk", "pig", "hand", "head", "knot1"};
    const std::vector<const char *> all = {"elephant", "fandisk", "pig",  "hand", "head",  "knot1",
                                           "cow",      "camel",   "bull", "dino", "homer", "lion-head"};
    const int plain = for_each_mesh(well_shaped, plain_agrees), intrinsic = for_each_mesh(all, intrinsic_agrees);
    return plain | intrinsic;
}
