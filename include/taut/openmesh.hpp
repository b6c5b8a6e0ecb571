/*
 * taut for OpenMesh (tested with 9.0): meshes of triangles or polygons, of any traits.
 *
 *     taut::Mesh mesh = taut::make_mesh(open);
 *     OpenMesh::VProp<double> d(open, "distance");
 *     taut::HeatSolver(mesh).field(open.vertex_handle(0)).distances(d);
 *
 * Vertex v of the mesh is VertexHandle(v). Deleted elements need no garbage collection: faces that are deleted are left out,
 * and vertices that are keep their number, without faces. Where a taut::View is asked for, vertex handles (alone or in a
 * container) are indices, and a property of the vertices is a row for each, be it a PropertyManager or
 * `open.property(handle)`.
 */
#ifndef TAUT_OPENMESH_HPP
#define TAUT_OPENMESH_HPP

#include <taut.hpp>

#include <OpenMesh/Core/Mesh/PolyMeshT.hh>
#include <OpenMesh/Core/Utils/PropertyManager.hh>

namespace taut {

/// A vertex handle is its index.
template <class T>
struct Row<T, std::enable_if_t<std::is_base_of_v<OpenMesh::VertexHandle, T>>> {
    using Scalar = int;
    static constexpr std::size_t width = 1;
    static_assert(std::is_standard_layout_v<OpenMesh::VertexHandle> && sizeof(OpenMesh::VertexHandle) == sizeof(int));
    static const int *data(const T &handle) noexcept {
        return reinterpret_cast<const int *>(&static_cast<const OpenMesh::VertexHandle &>(handle));
    }
};

/// A point or another vector.
template <class T, int N>
struct Row<OpenMesh::VectorT<T, N>> {
    using Scalar = T;
    static constexpr std::size_t width = std::size_t{N};
    static const T *data(const OpenMesh::VectorT<T, N> &row) noexcept { return row.data(); }
};

namespace detail {

template <class Property>
struct PropertyRows {
    static auto rows(Property &property) {
        return RowsOf<std::remove_reference_t<decltype(property.data_vector())>>::rows(property.data_vector());
    }
};

template <class Manager, class T>
struct ManagerRows {
    using Element = std::remove_reference_t<decltype(std::declval<Manager &>()[OpenMesh::VertexHandle(0)])>;
    using Scalar = std::conditional_t<std::is_const_v<Element>, const RowScalar<T>, RowScalar<T>>;
    static Rows<Scalar> rows(Manager &property) {
        const std::size_t count = property.template getMesh<OpenMesh::PolyConnectivity>().n_vertices();
        Scalar *data = count == 0 ? nullptr : const_cast<Scalar *>(Row<T>::data(property[OpenMesh::VertexHandle(0)]));
        return {data, count, sizeof(T), Row<T>::width};
    }
};

} // namespace detail

/// What `open.property(handle)` gives.
template <class T>
struct RowsOf<OpenMesh::PropertyT<T>, std::void_t<detail::RowScalar<T>>>
    : detail::PropertyRows<OpenMesh::PropertyT<T>> {};
template <class T>
struct RowsOf<const OpenMesh::PropertyT<T>, std::void_t<detail::RowScalar<T>>>
    : detail::PropertyRows<const OpenMesh::PropertyT<T>> {};

/// A property of the vertices.
template <class T, class M>
struct RowsOf<OpenMesh::PropertyManager<OpenMesh::VPropHandleT<T>, M>, std::void_t<detail::RowScalar<T>>>
    : detail::ManagerRows<OpenMesh::PropertyManager<OpenMesh::VPropHandleT<T>, M>, T> {};
template <class T, class M>
struct RowsOf<const OpenMesh::PropertyManager<OpenMesh::VPropHandleT<T>, M>, std::void_t<detail::RowScalar<T>>>
    : detail::ManagerRows<const OpenMesh::PropertyManager<OpenMesh::VPropHandleT<T>, M>, T> {};

namespace detail {

/// Calls `visit` with each face that is not deleted.
template <class Kernel, class Visit>
void for_each_face(const OpenMesh::PolyMeshT<Kernel> &open, const Visit &visit) {
    for (std::size_t i = 0; i < open.n_faces(); i++) {
        const OpenMesh::FaceHandle face(static_cast<int>(i));
        if (!open.has_face_status() || !open.status(face).deleted()) visit(face);
    }
}

} // namespace detail

/// The mesh of an OpenMesh; polygons become fans of triangles. Coordinates are read in place. C: taut_mesh_new_polygons.
template <class Kernel>
Mesh make_mesh(const OpenMesh::PolyMeshT<Kernel> &open) {
    using Point = typename OpenMesh::PolyMeshT<Kernel>::Point;
    using Scalar = typename OpenMesh::vector_traits<Point>::value_type;
    std::vector<std::size_t> offsets{0};
    std::vector<int> corners;
    detail::for_each_face(open, [&](OpenMesh::FaceHandle face) {
        for (const auto v : open.fv_range(face)) corners.push_back(v.idx());
        offsets.push_back(corners.size());
    });
    const std::size_t count = open.n_vertices();
    const Scalar *positions = count == 0 ? nullptr : &open.points()[0][0];
    return Mesh::polygons(View<const Real>(positions, count, sizeof(Point)), offsets, corners);
}

/// The face of each triangle of make_mesh, for what names triangles: points, paths, isolines.
template <class Kernel>
std::vector<OpenMesh::FaceHandle> triangle_faces(const OpenMesh::PolyMeshT<Kernel> &open) {
    std::vector<OpenMesh::FaceHandle> faces;
    detail::for_each_face(open, [&](OpenMesh::FaceHandle face) { faces.insert(faces.end(), open.valence(face) - 2, face); });
    return faces;
}

} // namespace taut

#endif // TAUT_OPENMESH_HPP
