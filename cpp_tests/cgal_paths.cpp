// Distances, nearest sources and shortest paths of points inside triangles against CGAL's Surface_mesh_shortest_path, from
// two sources that lie inside triangles too.
#include "peers.hpp"

#include <CGAL/Surface_mesh_shortest_path.h>

#include <array>
#include <iterator>
#include <random>

using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>>;

// Rounding, in shares of the largest distance.
const double TOLERANCE = 1e-12;

const std::size_t SOURCES = 2, TARGETS = 1000;

// Points of the surface, as taut's calls take them.
struct Places {
    std::vector<std::uint32_t> faces;
    std::vector<double> barycentrics;

    std::size_t count() const { return faces.size(); }
    taut_input face_rows() const { return {faces.data(), count(), 0, TAUT_TYPE_U32, 0}; }
    taut_input barycentric_rows() const { return {barycentrics.data(), count(), 0, TAUT_TYPE_F64, 0}; }
};

// Well inside triangles: CGAL would take a source at a vertex for one beside it.
static Places random_places(std::size_t count, std::size_t face_count, std::mt19937 &random) {
    std::uniform_int_distribution<std::size_t> face(0, face_count - 1);
    std::uniform_real_distribution<double> weight(0.1, 1);
    Places places;
    for (std::size_t i = 0; i < count; i++) {
        places.faces.push_back(static_cast<std::uint32_t>(face(random)));
        const double w[] = {weight(random), weight(random), weight(random)};
        for (const double each : w) places.barycentrics.push_back(each / (w[0] + w[1] + w[2]));
    }
    return places;
}

// The same points for CGAL, which may begin a triangle at another corner.
static std::vector<Paths::Face_location> for_cgal(const Peers &peers, const Places &places) {
    std::vector<std::array<std::uint32_t, 3>> triangles(taut_mesh_triangle_count(peers.taut.get()));
    check(taut_mesh_triangles(peers.taut.get(), taut_output{triangles.data(), triangles.size(), 0, TAUT_TYPE_U32, 0}));
    std::vector<Paths::Face_location> locations;
    for (std::size_t i = 0; i < places.count(); i++) {
        const CgalMesh::Face_index face(places.faces[i]);
        const auto &corners = triangles[places.faces[i]];
        Paths::Barycentric_coordinates weights{};
        auto h = peers.cgal.halfedge(face);
        for (std::size_t k = 0; k < 3; k++, h = peers.cgal.next(h)) {
            const auto corner = std::find(corners.begin(), corners.end(), peers.cgal.source(h).idx());
            if (corner == corners.end()) throw std::runtime_error("a face has other corners in CGAL");
            weights[k] = places.barycentrics[3 * i + static_cast<std::size_t>(corner - corners.begin())];
        }
        locations.emplace_back(face, weights);
    }
    return locations;
}

// Of each target: its distance, its nearest source or -1, and its path.
struct Answers {
    std::vector<double> distances;
    std::vector<std::int32_t> nearest;
    std::vector<std::vector<Kernel::Point_3>> paths;
};

static std::vector<std::vector<Kernel::Point_3>> polylines(const taut_curves *curves) {
    std::vector<std::uint32_t> offsets(taut_curves_count(curves) + 1);
    std::vector<double> xyz(3 * taut_curves_point_count(curves));
    check(taut_curves_offsets(curves, taut_output{offsets.data(), offsets.size(), 0, TAUT_TYPE_U32, 0}));
    check(taut_curves_positions(curves, taut_output{xyz.data(), xyz.size() / 3, 0, TAUT_TYPE_F64, 0}));
    std::vector<std::vector<Kernel::Point_3>> lines(offsets.size() - 1);
    for (std::size_t i = 0; i < lines.size(); i++)
        for (std::size_t p = offsets[i]; p < offsets[i + 1]; p++)
            lines[i].emplace_back(xyz[3 * p], xyz[3 * p + 1], xyz[3 * p + 2]);
    return lines;
}

static Answers our_answers(const Peers &peers, const Places &from, const Places &to) {
    const Handle<taut_exact> exact = prepared(peers);
    taut_sources sources = {};
    sources.struct_size = sizeof sources;
    sources.faces = from.face_rows();
    sources.barycentrics = from.barycentric_rows();
    taut_exact_options options = {};
    options.struct_size = sizeof options;
    options.keep_windows = 1;
    taut_exact_field *field = nullptr;
    check(taut_exact_field_new(exact.get(), &sources, &options, nullptr, &field));
    const Handle<taut_exact_field> field_owner(field, taut_exact_field_free);

    Answers answers{std::vector<double>(to.count()), std::vector<std::int32_t>(to.count()), {}};
    taut_targets targets = {};
    targets.struct_size = sizeof targets;
    targets.faces = to.face_rows();
    targets.barycentrics = to.barycentric_rows();
    check(taut_exact_field_distances(field, &targets,
                                     taut_output{answers.distances.data(), to.count(), 0, TAUT_TYPE_F64, 0}));
    check(taut_exact_field_nearest_sources(field, &targets,
                                           taut_output{answers.nearest.data(), to.count(), 0, TAUT_TYPE_I32, 0}));
    taut_curves *curves = nullptr;
    check(taut_exact_field_paths(field, &targets, nullptr, &curves));
    const Handle<taut_curves> curves_owner(curves, taut_curves_free);
    answers.paths = polylines(curves);
    return answers;
}

// CGAL's path of a target that no source reaches is left empty, as ours is.
static Answers cgal_answers(const CgalMesh &mesh, const std::vector<Paths::Face_location> &from,
                            const std::vector<Paths::Face_location> &to) {
    Paths solver(mesh);
    for (const auto &source : from) solver.add_source_point(source.first, source.second);
    solver.build_sequence_tree();
    Answers answers;
    for (const auto &target : to) {
        const auto [distance, source] = solver.shortest_distance_to_source_points(target.first, target.second);
        const bool is_reached = distance >= 0;
        answers.distances.push_back(is_reached ? distance : std::numeric_limits<double>::infinity());
        // The sources lie in different triangles, by which CGAL's are told apart: it does not number them.
        const auto is_it = [&](const Paths::Face_location &place) { return place.first == source->first; };
        const auto number = is_reached ? std::find_if(from.begin(), from.end(), is_it) - from.begin() : -1;
        answers.nearest.push_back(static_cast<std::int32_t>(number));
        answers.paths.emplace_back();
        if (is_reached)
            solver.shortest_path_points_to_source_points(target.first, target.second,
                                                         std::back_inserter(answers.paths.back()));
    }
    return answers;
}

static double distance(const Kernel::Point_3 &p, const Kernel::Point_3 &q) {
    return std::sqrt(CGAL::squared_distance(p, q));
}

static double length(const std::vector<Kernel::Point_3> &path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.size(); i++) sum += distance(path[i - 1], path[i]);
    return sum;
}

// How far our answers are from CGAL's, and our paths from their own distances; +inf where they differ in kind.
static double difference(const Answers &ours, const Answers &theirs) {
    double worst = 0;
    for (std::size_t i = 0; i < ours.distances.size(); i++) {
        const auto &our_path = ours.paths[i], &their_path = theirs.paths[i];
        if (ours.nearest[i] != theirs.nearest[i] || our_path.empty() != their_path.empty() ||
            std::isfinite(ours.distances[i]) == our_path.empty())
            return std::numeric_limits<double>::infinity();
        if (our_path.empty()) continue;
        worst = std::max({worst, std::abs(ours.distances[i] - theirs.distances[i]),
                          std::abs(ours.distances[i] - length(our_path)),
                          distance(our_path.front(), their_path.front()),
                          distance(our_path.back(), their_path.back())});
    }
    return worst;
}

static bool agree(const char *name, const Peers &peers) {
    std::mt19937 random(1);
    const Places from = random_places(SOURCES, peers.cgal.number_of_faces(), random);
    const Places to = random_places(TARGETS, peers.cgal.number_of_faces(), random);
    const Answers ours = our_answers(peers, from, to);
    const Answers theirs = cgal_answers(peers.cgal, for_cgal(peers, from), for_cgal(peers, to));
    const double relative = difference(ours, theirs) / largest(theirs.distances);
    const auto unreached = std::count(ours.nearest.begin(), ours.nearest.end(), -1);
    const auto second = std::count(ours.nearest.begin(), ours.nearest.end(), 1);
    std::printf("%-18s %zu points, %td nearest to the second source, %td unreached, differ by %.1e of the largest\n", name,
                to.count(), second, unreached, relative);
    return relative <= TOLERANCE;
}

int main() {
    return for_each_mesh({"elephant", "fandisk", "cow", "hand", "head", "camel", "knot1", "mushroom", "dino", "homer",
                          "triceratops", "rotor", "anchor", "blobby_3cc", "mask_cone", "elephant-with-holes",
                          "lion-head"},
                         agree);
}
