// taut/eigen.hpp: matrices as Eigen and libigl have them, against the C interface, to the bit.
#include "check.hpp"

#include <taut/eigen.hpp>

const Hills HILLS(20);
const int COUNT = 400, SOURCE = 57;

template <class Matrix, class Rows>
static Matrix filled(const Rows &rows) {
    Matrix matrix(static_cast<Eigen::Index>(rows.size()), 3);
    for (Eigen::Index i = 0; i < matrix.rows(); i++)
        for (Eigen::Index k = 0; k < 3; k++)
            matrix(i, k) = static_cast<typename Matrix::Scalar>(rows[std::size_t(i)][std::size_t(k)]);
    return matrix;
}

template <class V, class F>
static bool is_same_mesh() {
    const V v = filled<V>(HILLS.positions);
    const F f = filled<F>(HILLS.triangles);
    Hills same = HILLS; // rounded as V's numbers are
    for (std::size_t i = 0; i < same.positions.size(); i++)
        for (std::size_t k = 0; k < 3; k++) same.positions[i][k] = v(Eigen::Index(i), Eigen::Index(k));
    return distances(taut::make_mesh(v, f), SOURCE) == c_distances(same, SOURCE);
}

template <class T, int Columns, int Order>
using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Columns, Order>;
const int DYNAMIC = Eigen::Dynamic, BY_COLUMNS = Eigen::ColMajor, BY_ROWS = Eigen::RowMajor;

static void meshes() {
    CHECK((is_same_mesh<Eigen::MatrixXd, Eigen::MatrixXi>()));
    CHECK((is_same_mesh<Matrix<double, 3, BY_ROWS>, Matrix<int, 3, BY_ROWS>>()));
    CHECK((is_same_mesh<Matrix<float, DYNAMIC, BY_ROWS>, Matrix<long, DYNAMIC, BY_COLUMNS>>()));
    CHECK((is_same_mesh<Matrix<float, 3, BY_COLUMNS>, Matrix<unsigned, DYNAMIC, BY_ROWS>>()));

    // Parts of wider matrices, and what has yet to be computed.
    const auto v = filled<Matrix<double, DYNAMIC, BY_ROWS>>(HILLS.positions);
    const auto f = filled<Matrix<int, DYNAMIC, BY_ROWS>>(HILLS.triangles);
    Matrix<double, DYNAMIC, BY_ROWS> wide(COUNT, 5);
    wide.setConstant(7);
    wide.middleCols(1, 3) = v;
    const std::vector<double> expected = c_distances(HILLS, SOURCE);
    CHECK(distances(taut::make_mesh(wide.middleCols(1, 3), f), SOURCE) == expected);
    CHECK(distances(taut::make_mesh(v * 1.0, f), SOURCE) == expected);
    CHECK(distances(taut::make_mesh(v, f.array() + 0), SOURCE) == expected);
    CHECK(fails([&] { taut::make_mesh(wide, f); }, TAUT_REASON_BAD_ARGUMENT));
    CHECK(fails([&] { taut::make_mesh(Eigen::MatrixXd(v.leftCols(2)), f); }, TAUT_REASON_BAD_ARGUMENT));
    using Sparse = Eigen::Map<const Matrix<double, DYNAMIC, BY_ROWS>, 0, Eigen::Stride<DYNAMIC, DYNAMIC>>;
    const Sparse second(wide.data(), 2, 3, Eigen::Stride<DYNAMIC, DYNAMIC>(5, 2));
    CHECK(fails([&] { taut::Closest(taut::make_mesh(v, f)).points(second); }, TAUT_REASON_BAD_ARGUMENT));
    CHECK(taut::make_mesh(Eigen::MatrixXd(0, 3), Eigen::MatrixXi(0, 3)).vertex_count() == 0);
}

static void results() {
    const taut::Mesh mesh = HILLS.mesh();
    const taut::HeatSolver solver(mesh);
    const taut::HeatField field = solver.field(SOURCE);
    const std::vector<double> distances = field.distances();
    const auto is_it = [&](const auto &d) {
        return std::equal(distances.begin(), distances.end(), d.begin(), d.end(),
                          [](double ours, double theirs) { return ours == theirs; });
    };
    Eigen::VectorXd d(COUNT);
    field.distances(d);
    CHECK(is_it(d));
    Eigen::RowVectorXf single(COUNT);
    field.distances(single);
    CHECK(single[3] == static_cast<float>(distances[3]) && single[COUNT - 1] == static_cast<float>(distances.back()));

    // A column of a matrix by columns, one by rows, which has gaps, every second number, a map.
    Eigen::MatrixXd by_columns = Eigen::MatrixXd::Constant(COUNT, 3, -1);
    field.distances(by_columns.col(1));
    CHECK(is_it(by_columns.col(1)) && (by_columns.col(0).array() == -1).all() && (by_columns.col(2).array() == -1).all());
    Matrix<double, DYNAMIC, BY_ROWS> by_rows = Matrix<double, DYNAMIC, BY_ROWS>::Constant(COUNT, 3, -1);
    field.distances(by_rows.col(1));
    CHECK(is_it(by_rows.col(1)) && (by_rows.col(0).array() == -1).all() && (by_rows.col(2).array() == -1).all());
    Eigen::VectorXd twice = Eigen::VectorXd::Constant(2 * COUNT, -1);
    Eigen::Map<Eigen::VectorXd, 0, Eigen::InnerStride<2>> second(twice.data() + 1, COUNT);
    field.distances(second);
    CHECK(is_it(second) && twice[0] == -1 && twice[2 * COUNT - 2] == -1);

    // A row for each source; the sources as Eigen's integers.
    const Eigen::Vector2i sources(SOURCE, 3);
    Matrix<double, DYNAMIC, BY_ROWS> rows(2, COUNT);
    solver.distance_rows(sources, rows, 1);
    CHECK(is_it(rows.row(0)) && rows(1, 3) == 0);
    for (const int width : {0, 7}) {
        rows.resize(2, width);
        CHECK(fails([&] { solver.distance_rows(sources, rows); }, TAUT_REASON_BAD_ARGUMENT));
    }

    // Values in, positions out.
    const taut::Curves lines = taut::isolines(mesh, d, Eigen::Vector2d(1, 2));
    const Eigen::MatrixXd points = taut::matrix(lines.positions());
    const std::vector<Position> expected = taut::isolines(mesh, distances, std::array{1.0, 2.0}).positions();
    CHECK(points.rows() == Eigen::Index(expected.size()) && points.cols() == 3 && points(5, 2) == expected[5][2]);
    CHECK(taut::matrix(std::vector<Position>()).rows() == 0);
    Matrix<float, 3, BY_ROWS> floats(points.rows(), 3);
    lines.positions(floats);
    CHECK(floats(5, 2) == static_cast<float>(expected[5][2]));
    const taut::Closest closest(mesh);
    const std::vector<Eigen::Vector3f> clicks{{1, 2, 3}, {4, 5, 6}};
    CHECK(closest.points(clicks).faces[0] == closest.points(Eigen::Vector3d(1, 2, 3)).faces[0]);
}

// What could be taken wrongly does not compile.
using Input = taut::View<const taut::Real>;
using Output = taut::View<taut::Real>;
static_assert(!std::is_convertible_v<Eigen::MatrixXd &, Input> && !std::is_convertible_v<Eigen::MatrixXd &, Output>);
static_assert(!std::is_convertible_v<const Eigen::VectorXd &, Output>);
static_assert(!std::is_convertible_v<Eigen::Map<const Eigen::VectorXd>, Output>);
static_assert(!std::is_convertible_v<const Eigen::MatrixXd::ConstColXpr &, Output>);
static_assert(std::is_convertible_v<Eigen::MatrixXd::ColXpr, Output>);
static_assert(std::is_convertible_v<Eigen::Ref<Eigen::VectorXd>, Output>);

int main() {
    meshes();
    results();
    return failures == 0 ? 0 : 1;
}
