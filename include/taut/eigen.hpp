/*
 * taut for Eigen (tested with 3.4), and so for libigl: V with n rows of three coordinates, F with m rows of three vertices,
 * in either order of storage and any numbers that taut takes.
 *
 *     taut::Mesh mesh = taut::make_mesh(V, F);
 *     Eigen::VectorXd d(V.rows());
 *     taut::HeatSolver(mesh).field(0).distances(d);     // or distances(D.col(3))
 *     Eigen::MatrixXd path = taut::matrix(field.paths(5).positions());
 *
 * Where a taut::View is asked for, a vector is an element a row, with any stride, and a matrix stored by rows is its rows. A
 * matrix stored by columns cannot be viewed, as the numbers of a row are apart; make_mesh and matrix copy.
 */
#ifndef TAUT_EIGEN_HPP
#define TAUT_EIGEN_HPP

#include <taut.hpp>

#include <Eigen/Core>

namespace taut {
namespace detail {

template <class Derived>
std::true_type is_eigen(const Eigen::DenseBase<Derived> *);
std::false_type is_eigen(const void *);

/// Whether the rows of an Eigen type lie in memory, each without gaps.
template <class T>
constexpr bool has_eigen_rows() {
    if constexpr (decltype(is_eigen(static_cast<const T *>(nullptr)))::value)
        return (T::Flags & Eigen::DirectAccessBit) != 0 && (T::IsVectorAtCompileTime || T::IsRowMajor);
    else
        return false;
}

} // namespace detail

/// Vectors and points of a fixed size, as in a std::vector of Eigen::Vector3d.
template <class T, int R, int C, int Options>
struct Row<Eigen::Matrix<T, R, C, Options>, std::enable_if_t<(R == 1 && C > 0) || (C == 1 && R > 0)>> {
    using Scalar = T;
    static constexpr std::size_t width = std::size_t{R} * std::size_t{C};
    static const T *data(const Eigen::Matrix<T, R, C, Options> &row) noexcept { return row.data(); }
};

/// Vectors, matrices stored by rows, and what refers to a part of one.
template <class C>
struct RowsOf<C, std::enable_if_t<detail::has_eigen_rows<std::remove_const_t<C>>()>> {
    using Plain = std::remove_const_t<C>;
    // A block or a map is a reference: that it is const itself does not make const what it refers to.
    static constexpr bool is_reference = !std::is_base_of_v<Eigen::PlainObjectBase<Plain>, Plain>;
    static constexpr bool is_writable = (Plain::Flags & Eigen::LvalueBit) != 0 && (is_reference || !std::is_const_v<C>);
    using Scalar = std::conditional_t<is_writable, typename Plain::Scalar, const typename Plain::Scalar>;

    static Rows<Scalar> rows(C &matrix) {
        Scalar *data = const_cast<Scalar *>(matrix.data());
        const auto bytes = [](Eigen::Index stride) { return static_cast<std::size_t>(stride) * sizeof(Scalar); };
        if constexpr (Plain::IsVectorAtCompileTime)
            return {data, static_cast<std::size_t>(matrix.size()), bytes(matrix.innerStride()), 1};
        if (matrix.innerStride() != 1) detail::bad_argument(TAUT_REASON_BAD_ARGUMENT, "the rows of the matrix have gaps");
        return {data, static_cast<std::size_t>(matrix.rows()), bytes(matrix.outerStride()),
                static_cast<std::size_t>(matrix.cols())};
    }
};

namespace detail {

/// A matrix whose rows can be viewed: itself, or a copy.
template <class Derived>
decltype(auto) by_rows(const Eigen::DenseBase<Derived> &matrix) {
    using Copy = Eigen::Matrix<typename Derived::Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    if constexpr (has_eigen_rows<Derived>() && Derived::IsRowMajor) return (matrix.derived());
    else return Copy(matrix.derived());
}

} // namespace detail

/// The mesh of libigl's V and F. C: taut_mesh_new.
template <class V, class F>
Mesh make_mesh(const Eigen::DenseBase<V> &positions, const Eigen::DenseBase<F> &triangles) {
    return Mesh(detail::by_rows(positions), detail::by_rows(triangles));
}

/// Rows as a matrix stored by columns, as libigl has them.
template <class T, std::size_t N>
Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> matrix(const std::vector<std::array<T, N>> &rows) {
    using ByRows = Eigen::Matrix<T, Eigen::Dynamic, static_cast<int>(N), Eigen::RowMajor>;
    const T *data = rows.empty() ? nullptr : rows.front().data();
    return Eigen::Map<const ByRows>(data, static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(N));
}

} // namespace taut

#endif // TAUT_EIGEN_HPP
