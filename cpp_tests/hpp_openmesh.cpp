// taut/openmesh.hpp: meshes of OpenMesh against the C interface, to the bit; deleted elements, polygons, properties.
#include "check.hpp"

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <taut/openmesh.hpp>

struct Doubles : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
};
using TriMesh = OpenMesh::TriMesh_ArrayKernelT<Doubles>;
using FloatMesh = OpenMesh::TriMesh_ArrayKernelT<>;
using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<Doubles>;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

const Hills HILLS(20);
const std::uint32_t SOURCE = 57;

template <class M>
static M open(const Hills &hills) {
    M mesh;
    using Point = typename M::Point;
    using Scalar = typename OpenMesh::vector_traits<Point>::value_type;
    for (const Position &p : hills.positions) mesh.add_vertex(Point(Scalar(p[0]), Scalar(p[1]), Scalar(p[2])));
    for (const Triangle &t : hills.triangles) mesh.add_face(VertexHandle(t[0]), VertexHandle(t[1]), VertexHandle(t[2]));
    return mesh;
}

// As OpenMesh orders the corners, which each mesh is free to turn.
template <class M>
static Hills as_stored(const M &mesh) {
    Hills hills(0);
    for (const auto v : mesh.all_vertices()) {
        const auto p = mesh.point(v);
        hills.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
    }
    for (const auto f : mesh.faces()) {
        Triangle triangle{};
        int k = 0;
        for (const auto v : f.vertices()) triangle[std::size_t(k++)] = v.idx();
        hills.triangles.push_back(triangle);
    }
    return hills;
}

template <class M>
static void same_mesh() {
    const M mesh = open<M>(HILLS);
    CHECK(distances(taut::make_mesh(mesh), VertexHandle(int(SOURCE))) == c_distances(as_stored(mesh), SOURCE));
}

// Three faces and a corner of the square are deleted and not collected.
static void deleted_elements() {
    TriMesh mesh = open<TriMesh>(HILLS);
    mesh.request_vertex_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    mesh.delete_face(FaceHandle(4));
    mesh.delete_face(FaceHandle(100));
    mesh.delete_vertex(VertexHandle(19));
    const taut::Mesh ours = taut::make_mesh(mesh);
    CHECK(ours.vertex_count() == 400 && ours.triangle_count() < HILLS.triangles.size() - 2);
    CHECK(distances(ours, VertexHandle(int(SOURCE))) == c_distances(as_stored(mesh), SOURCE));
    CHECK(std::isinf(taut::ExactSolver(ours).field(VertexHandle(int(SOURCE))).distances()[19]));

    const std::vector<FaceHandle> faces = taut::triangle_faces(mesh);
    const auto triangles = ours.triangles();
    CHECK(faces.size() == triangles.size());
    for (std::size_t i = 0; i < faces.size(); i++) {
        CHECK(!mesh.status(faces[i]).deleted());
        std::array<std::uint32_t, 3> corners{};
        std::size_t k = 0;
        for (const auto v : mesh.fv_range(faces[i])) corners[k++] = std::uint32_t(v.idx());
        CHECK(corners == triangles[i]);
    }
}

static void polygons() {
    PolyMesh mesh;
    for (const auto &[x, y] : std::vector<std::pair<double, double>>{{0, 0}, {3, 0}, {3, 4}, {0, 4}, {5, 2}})
        mesh.add_vertex(OpenMesh::Vec3d(x, y, 0));
    const auto handles = [](std::initializer_list<int> indices) {
        std::vector<VertexHandle> corners;
        for (const int i : indices) corners.emplace_back(i);
        return corners;
    };
    mesh.add_face(handles({0, 1, 2, 3}));
    mesh.add_face(handles({1, 4, 2}));
    const taut::Mesh ours = taut::make_mesh(mesh);
    CHECK(ours.triangle_count() == 3);
    CHECK((taut::triangle_faces(mesh) == std::vector<FaceHandle>{FaceHandle(0), FaceHandle(0), FaceHandle(1)}));
    CHECK((taut::ExactSolver(ours).field(VertexHandle(0)).distances(3) == std::vector<double>{4}));
    CHECK(std::abs(taut::ExactSolver(ours).field(VertexHandle(0)).distances(4)[0] - std::sqrt(29)) < 1e-14);
    CHECK(taut::make_mesh(PolyMesh()).vertex_count() == 0);
}

static void properties() {
    TriMesh mesh = open<TriMesh>(HILLS);
    const taut::Mesh ours = taut::make_mesh(mesh);
    const taut::HeatSolver solver(ours);
    const std::vector<VertexHandle> sources{VertexHandle(57), VertexHandle(3)};
    const taut::HeatField field = solver.field(sources);
    const std::vector<double> expected = solver.field(std::array{57, 3}).distances();
    const std::vector<std::uint32_t> nearest = field.nearest_sources();

    OpenMesh::VProp<double> d(mesh, "distance");
    OpenMesh::VProp<float> single(mesh, "single");
    OpenMesh::VProp<int> number(mesh, "nearest");
    field.distances(d);
    field.distances(single);
    field.nearest_sources(number);
    for (const auto v : mesh.vertices()) {
        const std::size_t i = std::size_t(v.idx());
        CHECK(d[v] == expected[i] && single[v] == float(expected[i]) && number[v] == int(nearest[i]));
    }
    OpenMesh::VPropHandleT<double> handle;
    mesh.add_property(handle);
    field.distances(mesh.property(handle));
    CHECK(mesh.property(handle).data_vector() == expected);

    // Read: values of isolines, handles that know their mesh, points.
    const auto &const_d = d;
    const TriMesh &const_mesh = mesh;
    CHECK(taut::isolines(ours, const_d, 2).positions() == taut::isolines(ours, expected, 2).positions());
    CHECK(taut::isolines(ours, const_mesh.property(handle), 2).count() == taut::isolines(ours, expected, 2).count());
    for (const auto v : mesh.vertices())
        if (v.idx() == 57) CHECK(solver.field(v).distances()[57] == 0);
    const std::vector<OpenMesh::SmartVertexHandle> smart = mesh.vertices().to_vector();
    CHECK(taut::Targets(smart).count() == 400 && taut::ExactSolver(ours).field(0).distances(smart).size() == 400);
    CHECK(taut::Closest(ours).points(std::vector<OpenMesh::Vec3f>(2, {1, 2, 3})).faces.size() == 2);

    static_assert(!std::is_convertible_v<const OpenMesh::VProp<double> &, taut::View<taut::Real>>);
    static_assert(!std::is_convertible_v<OpenMesh::FProp<double> &, taut::View<taut::Real>>);
    static_assert(!std::is_convertible_v<OpenMesh::VProp<bool> &, taut::View<taut::Index>>);
    static_assert(!std::is_convertible_v<FaceHandle, taut::View<const taut::Index>>);
}

int main() {
    same_mesh<TriMesh>();
    same_mesh<FloatMesh>();
    same_mesh<PolyMesh>();
    deleted_elements();
    polygons();
    properties();
    return failures == 0 ? 0 : 1;
}
