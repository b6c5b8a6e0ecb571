// taut/cgal.hpp: surface meshes of CGAL against the C interface, to the bit; removed elements, polygons, property maps.
#include "check.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <taut/cgal.hpp>

template <class Kernel>
using Surface = CGAL::Surface_mesh<typename Kernel::Point_3>;
using Doubles = CGAL::Simple_cartesian<double>;
using Vertex = Surface<Doubles>::Vertex_index;
using Face = Surface<Doubles>::Face_index;

const Hills HILLS(20);
const std::uint32_t SOURCE = 57;

template <class Kernel>
static Surface<Kernel> surface_of(const Hills &hills) {
    Surface<Kernel> surface;
    for (const Position &p : hills.positions) surface.add_vertex(typename Kernel::Point_3(p[0], p[1], p[2]));
    for (const Triangle &t : hills.triangles)
        surface.add_face(Vertex(std::uint32_t(t[0])), Vertex(std::uint32_t(t[1])), Vertex(std::uint32_t(t[2])));
    return surface;
}

// As CGAL orders the corners, from source(halfedge(f)).
template <class S>
static Hills as_stored(const S &surface) {
    Hills hills = HILLS;
    hills.triangles.clear();
    for (const Face f : surface.faces()) {
        const auto h = surface.halfedge(f);
        hills.triangles.push_back(
            {int(surface.source(h)), int(surface.target(h)), int(surface.target(surface.next(h)))});
    }
    return hills;
}

template <class Kernel>
static void same_mesh() {
    const Surface<Kernel> surface = surface_of<Kernel>(HILLS);
    CHECK(distances(taut::make_mesh(surface), Vertex(SOURCE)) == c_distances(as_stored(surface), SOURCE));
}

static void removed_elements() {
    Surface<Doubles> surface = surface_of<Doubles>(HILLS);
    CGAL::Euler::remove_face(surface.halfedge(Face(4)), surface);
    CGAL::Euler::remove_face(surface.halfedge(Face(100)), surface);
    CGAL::Euler::remove_center_vertex(surface.halfedge(Vertex(210)), surface); // leaves a hexagon
    CHECK(surface.has_garbage() && surface.is_removed(Vertex(210)));
    const taut::Mesh ours = taut::make_mesh(surface);
    const std::vector<Face> faces = taut::triangle_faces(surface);
    const auto triangles = ours.triangles();
    CHECK(ours.vertex_count() == 400 && triangles.size() == HILLS.triangles.size() - 4 && faces.size() == triangles.size());
    Hills same = HILLS;
    same.triangles.clear();
    for (std::size_t i = 0; i < triangles.size(); i++) {
        same.triangles.push_back({int(triangles[i][0]), int(triangles[i][1]), int(triangles[i][2])});
        CHECK(!surface.is_removed(faces[i]));
        for (const std::uint32_t corner : triangles[i]) {
            bool is_there = false;
            for (const Vertex v : surface.vertices_around_face(surface.halfedge(faces[i]))) is_there |= v == Vertex(corner);
            CHECK(is_there);
        }
    }
    CHECK(distances(ours, Vertex(SOURCE)) == c_distances(same, SOURCE));
    CHECK(std::isinf(taut::ExactSolver(ours).field(Vertex(SOURCE)).distances()[210]));
    CHECK(taut::make_mesh(Surface<Doubles>()).vertex_count() == 0);
}

static void property_maps() {
    Surface<Doubles> surface = surface_of<Doubles>(HILLS);
    const taut::Mesh ours = taut::make_mesh(surface);
    const taut::ExactField field = taut::ExactSolver(ours).field(std::vector<Vertex>{Vertex(57), Vertex(3)});
    const std::vector<double> expected = taut::ExactSolver(ours).field(std::array{57, 3}).distances();
    const std::vector<std::uint32_t> nearest = field.nearest_sources();

    const auto d = surface.add_property_map<Vertex, double>("v:distance", -1).first;
    auto single = surface.add_property_map<Vertex, float>("v:single", -1).first;
    auto number = surface.add_property_map<Vertex, int>("v:nearest", -1).first;
    field.distances(d);
    field.distances(single);
    field.nearest_sources({}, number);
    for (const Vertex v : surface.vertices())
        CHECK(d[v] == expected[v] && single[v] == float(expected[v]) && number[v] == int(nearest[v]));
    CHECK(taut::isolines(ours, d, 2).positions() == taut::isolines(ours, expected, 2).positions());

    using Faces = Surface<Doubles>::Property_map<Face, double>;
    static_assert(!std::is_convertible_v<Faces &, taut::View<taut::Real>>);
    static_assert(!std::is_convertible_v<Face, taut::View<const taut::Index>>);
}

int main() {
    same_mesh<Doubles>();
    same_mesh<CGAL::Exact_predicates_exact_constructions_kernel>();
    removed_elements();
    property_maps();
    return failures == 0 ? 0 : 1;
}
