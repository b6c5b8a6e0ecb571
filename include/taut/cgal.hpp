/*
 * taut for CGAL::Surface_mesh (tested with CGAL 5.5): faces of any size, points of any kernel.
 *
 *     taut::Mesh mesh = taut::make_mesh(surface);
 *     auto d = surface.add_property_map<Surface::Vertex_index, double>("v:distance").first;
 *     taut::ExactSolver(mesh).field(Surface::Vertex_index(0)).distances(d);
 *
 * Vertex v of the mesh is Vertex_index(v). Removed elements need no garbage collection: faces that are removed are left out,
 * and vertices that are keep their number, without faces. Where a taut::View is asked for, vertex indices (alone or in a
 * container) are indices, and a property map of the vertices is a row for each.
 *
 * The corners of a face begin with source(halfedge(f)), so that on triangles the weights of a point are the barycentric
 * coordinates that CGAL's Face_location has.
 */
#ifndef TAUT_CGAL_HPP
#define TAUT_CGAL_HPP

#include <taut.hpp>

#include <CGAL/Surface_mesh.h>
#include <CGAL/number_utils.h>

namespace taut {

/// A vertex index is its number.
template <>
struct Row<CGAL::SM_Vertex_index> {
    using Scalar = CGAL::SM_Vertex_index::size_type;
    static constexpr std::size_t width = 1;
    static_assert(std::is_standard_layout_v<CGAL::SM_Vertex_index> && sizeof(CGAL::SM_Vertex_index) == sizeof(Scalar));
    static const Scalar *data(const CGAL::SM_Vertex_index &vertex) noexcept {
        return reinterpret_cast<const Scalar *>(&vertex);
    }
};

/// A property map of the vertices. It is a reference: that it is const itself does not make its values const.
template <class C>
struct RowsOf<C, std::enable_if_t<std::is_same_v<typename C::key_type, CGAL::SM_Vertex_index> &&
                                  std::is_same_v<typename C::reference, typename C::value_type &>>> {
    using Value = typename C::value_type;
    using Scalar = typename Row<Value>::Scalar;
    static Rows<Scalar> rows(const C &map) {
        const std::size_t count = static_cast<std::size_t>(map.end() - map.begin());
        Scalar *data = count == 0 ? nullptr : const_cast<Scalar *>(Row<Value>::data(map[CGAL::SM_Vertex_index(0)]));
        return {data, count, sizeof(Value), Row<Value>::width};
    }
};

/// The mesh of a surface mesh; polygons become fans of triangles. Coordinates are rounded to double.
/// C: taut_mesh_new_polygons.
template <class Point>
Mesh make_mesh(const CGAL::Surface_mesh<Point> &surface) {
    using Surface = CGAL::Surface_mesh<Point>;
    std::vector<std::array<double, 3>> positions;
    for (typename Surface::size_type v = 0; v < surface.num_vertices(); v++) { // removed ones too
        const Point &p = surface.point(typename Surface::Vertex_index(v));
        positions.push_back({CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
    }
    std::vector<std::size_t> offsets{0};
    std::vector<typename Surface::Vertex_index> corners;
    for (const auto f : surface.faces()) {
        const auto first = surface.halfedge(f);
        auto h = first;
        do {
            corners.push_back(surface.source(h));
            h = surface.next(h);
        } while (h != first);
        offsets.push_back(corners.size());
    }
    return Mesh::polygons(positions, offsets, corners);
}

/// The face of each triangle of make_mesh, for what names triangles: points, paths, isolines.
template <class Point>
std::vector<typename CGAL::Surface_mesh<Point>::Face_index> triangle_faces(const CGAL::Surface_mesh<Point> &surface) {
    std::vector<typename CGAL::Surface_mesh<Point>::Face_index> faces;
    for (const auto f : surface.faces()) faces.insert(faces.end(), surface.degree(f) - 2, f);
    return faces;
}

} // namespace taut

#endif // TAUT_CGAL_HPP
