// Distances, nearest sources and shortest paths of points inside triangles against CGAL's Surface_mesh_shortest_path, from
// two sources that lie inside triangles too.
#include "peers.hpp"

#include <CGAL/Surface_mesh_shortest_path.h>

#include <iterator>
#include <random>

using Paths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, CgalMesh>>;

// Rounding, in shares of the largest distance.
const double TOLERANCE = 1e-12;

const std::size_t SOURCES = 2, TARGETS = 1000;

// Points of the surface: the weights of a triangle begin with the same corner in both libraries, by taut::make_mesh.
struct Places {
    std::vector<std::uint32_t> faces;
    std::vector<Paths::Barycentric_coordinates> barycentrics;

    std::size_t count() const { return faces.size(); }
};

// Well inside triangles: CGAL would take a source at a vertex for one beside it.
static Places random_places(std::size_t count, std::size_t face_count, std::mt19937 &random) {
    std::uniform_int_distribution<std::size_t> face(0, face_count - 1);
    std::uniform_real_distribution<double> weight(0.1, 1);
    Places places;
    for (std::size_t i = 0; i < count; i++) {
        places.faces.push_back(static_cast<std::uint32_t>(face(random)));
        const double w[] = {weight(random), weight(random), weight(random)}, sum = w[0] + w[1] + w[2];
        places.barycentrics.push_back({w[0] / sum, w[1] / sum, w[2] / sum});
    }
    return places;
}

static std::vector<Paths::Face_location> for_cgal(const Places &places) {
    std::vector<Paths::Face_location> locations;
    for (std::size_t i = 0; i < places.count(); i++)
        locations.emplace_back(CgalMesh::Face_index(places.faces[i]), places.barycentrics[i]);
    return locations;
}

// Of each target: its distance, its nearest source or taut::none, and its path.
struct Answers {
    std::vector<double> distances;
    std::vector<std::uint32_t> nearest;
    std::vector<std::vector<Kernel::Point_3>> paths;
};

static std::vector<std::vector<Kernel::Point_3>> polylines(const taut::Curves &curves) {
    const std::vector<std::uint32_t> offsets = curves.offsets();
    const std::vector<std::array<double, 3>> positions = curves.positions();
    std::vector<std::vector<Kernel::Point_3>> lines(curves.count());
    for (std::size_t i = 0; i < lines.size(); i++)
        for (std::size_t p = offsets[i]; p < offsets[i + 1]; p++)
            lines[i].emplace_back(positions[p][0], positions[p][1], positions[p][2]);
    return lines;
}

static Answers our_answers(const Peers &peers, const Places &from, const Places &to) {
    taut::ExactOptions options;
    options.keep_windows = true;
    const taut::Sources sources = taut::Sources().with_points(from.faces, from.barycentrics);
    const taut::Targets targets = taut::Targets().with_points(to.faces, to.barycentrics);
    const taut::ExactField field = taut::ExactSolver(peers.mesh).field(sources, options);
    return {field.distances(targets), field.nearest_sources(targets), polylines(field.paths(targets))};
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
        const auto number = [&] { return std::find_if(from.begin(), from.end(), is_it) - from.begin(); };
        answers.nearest.push_back(is_reached ? static_cast<std::uint32_t>(number()) : taut::none);
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
    const Answers theirs = cgal_answers(peers.cgal, for_cgal(from), for_cgal(to));
    const double relative = difference(ours, theirs) / largest(theirs.distances);
    const auto unreached = std::count(ours.nearest.begin(), ours.nearest.end(), taut::none);
    const auto second = std::count(ours.nearest.begin(), ours.nearest.end(), 1u);
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
