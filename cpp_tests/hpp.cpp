// taut.hpp: every class and function of it, views of all kinds, errors, moves, callbacks and threads. It reads rectangle.off
// in the current folder.
#include "check.hpp"

#include <atomic>
#include <numeric>
#include <thread>
#if __cplusplus >= 202002L
#include <span>
#endif

using taut::Index;
using taut::Real;
using taut::View;
using Input = View<const Real>;
using Indices = View<const Index>;

const double INF = std::numeric_limits<double>::infinity();

// What can be moved and not copied, and what makes a view.
template <class T>
constexpr bool is_handle = !std::is_copy_constructible_v<T> && !std::is_copy_assignable_v<T> &&
                           std::is_nothrow_move_constructible_v<T> && std::is_nothrow_move_assignable_v<T>;
static_assert(is_handle<taut::Mesh> && is_handle<taut::HeatSolver> && is_handle<taut::HeatField> &&
              is_handle<taut::ExactSolver> && is_handle<taut::ExactField> && is_handle<taut::Curves> &&
              is_handle<taut::Closest> && is_handle<taut::MeshReport> && is_handle<taut::SparseDistances> &&
              is_handle<taut::Control>);
template <class From, class To>
constexpr bool converts = std::is_convertible_v<From, To>;
static_assert(converts<std::vector<float>, Input> && converts<const std::vector<double> &, Input>);
static_assert(converts<std::vector<float> &, View<Real>> && converts<double (&)[2][3], View<Real>>);
static_assert(!converts<const std::vector<float> &, View<Real>> && !converts<std::vector<float>, View<Real>>);
static_assert(!converts<std::vector<int>, Input> && !converts<std::vector<float>, Indices>);
static_assert(!converts<std::vector<bool>, Indices> && !converts<std::vector<short>, Indices>);
static_assert(!converts<std::string, Indices> && !converts<bool, Indices> && !converts<double, Indices>);
static_assert(converts<int, Indices> && converts<std::size_t, Indices> && converts<int, Input>);
static_assert(!converts<int, View<Index>> && !converts<const double *, Input>);

// The squares 0 1 2 and 0 2 3 of a rectangle of 3 by 4.
const std::vector<double> CORNERS{0, 0, 0, 3, 0, 0, 3, 4, 0, 0, 4, 0};
const std::vector<std::uint32_t> FACES{0, 1, 2, 0, 2, 3};
const std::vector<double> FROM_0{0, 3, 5, 4};

static std::vector<double> from_0(const Input &positions, const Indices &triangles) {
    return taut::ExactSolver(taut::Mesh(positions, triangles)).field(0).distances();
}

template <class T>
static bool indices_work() {
    const std::vector<T> flat(FACES.begin(), FACES.end());
    const std::array<std::array<T, 3>, 2> rows{{{0, 1, 2}, {0, 2, 3}}};
    const T array[2][3] = {{0, 1, 2}, {0, 2, 3}};
    return from_0(CORNERS, flat) == FROM_0 && from_0(CORNERS, rows) == FROM_0 && from_0(CORNERS, array) == FROM_0;
}

static void views_are_read() {
    CHECK(indices_work<std::uint16_t>() && indices_work<std::uint32_t>() && indices_work<std::uint64_t>());
    CHECK(indices_work<std::int32_t>() && indices_work<std::int64_t>());
    CHECK(indices_work<long>() && indices_work<long long>() && indices_work<unsigned long long>());

    const std::vector<float> single(CORNERS.begin(), CORNERS.end());
    CHECK(from_0(single, FACES) == FROM_0);
    CHECK(from_0({single.data(), 4}, FACES) == FROM_0);
    struct Vertex {
        float normal[3], position[3];
    };
    std::vector<Vertex> vertices;
    for (std::size_t v = 0; v < 4; v++)
        vertices.push_back({{9, 9, 9}, {single[3 * v], single[3 * v + 1], single[3 * v + 2]}});
    CHECK(from_0({vertices[0].position, vertices.size(), sizeof(Vertex)}, FACES) == FROM_0);
    CHECK(from_0(std::vector<Position>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}}, FACES) == FROM_0);
#if __cplusplus >= 202002L
    CHECK(from_0(std::span<const double>(CORNERS), std::span(FACES)) == FROM_0);
    CHECK(from_0(std::span<const double, 12>(CORNERS), FACES) == FROM_0);
#endif
    const taut::Mesh empty({}, {});
    CHECK(empty.vertex_count() == 0 && taut::ExactSolver(empty).distance_rows({}).empty());

    const std::vector<double> seven(7);
    CHECK(fails([&] { taut::Mesh(seven, FACES); }, TAUT_REASON_BAD_ARGUMENT));
    CHECK(fails([&] { taut::Mesh(std::vector<std::array<double, 2>>(6), FACES); }, TAUT_REASON_BAD_ARGUMENT));
    CHECK(fails([&] { taut::Mesh(Input(static_cast<double *>(nullptr), 4), FACES); }, TAUT_REASON_NULL_POINTER));
    CHECK(fails([&] { taut::Mesh(5.0, FACES); }, TAUT_REASON_BAD_ARGUMENT));
}

static void views_are_filled() {
    const taut::ExactField field = taut::ExactSolver(taut::Mesh(CORNERS, FACES)).field(0);
    float single[4];
    field.distances(single);
    CHECK(std::vector<double>(single, single + 4) == FROM_0);
    struct Vertex {
        std::int64_t nearest;
        double distance;
        char name;
    };
    std::vector<Vertex> vertices(4, {7, 7, 'v'});
    field.distances({&vertices[0].distance, 4, sizeof(Vertex)});
    field.nearest_sources({}, {&vertices[0].nearest, 4, sizeof(Vertex)});
    for (std::size_t v = 0; v < 4; v++)
        CHECK(vertices[v].distance == FROM_0[v] && vertices[v].nearest == 0 && vertices[v].name == 'v');
#if __cplusplus >= 202002L
    std::vector<double> rows(4);
    field.distances(std::span(rows));
    CHECK(rows == FROM_0);
#endif
    std::vector<double> three(3, -1);
    CHECK(fails([&] { field.distances(three); }, TAUT_REASON_BUFFER_TOO_SMALL));
    CHECK(three == std::vector<double>(3, -1));
}

static void errors_tell_what_failed() {
    CHECK(fails([] { taut::Mesh(CORNERS, std::array{0, 1, 2, 0, 2, 4}); }, TAUT_REASON_INDEX_OUT_OF_RANGE,
                TAUT_ELEMENT_FACE, 1));
    std::vector<double> broken = CORNERS;
    broken[7] = INF;
    CHECK(fails([&] { taut::Mesh(broken, FACES); }, TAUT_REASON_NON_FINITE_COORDINATE, TAUT_ELEMENT_VERTEX, 2));
    const taut::Mesh mesh(CORNERS, FACES);
    const taut::ExactSolver solver(mesh);
    CHECK(fails([&] { solver.field({}); }, TAUT_REASON_NO_SOURCE));
    CHECK(fails([&] { solver.field(std::array{0, 4}); }, TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_SOURCE, 1));
    CHECK(fails([&] { solver.field(-1); }, TAUT_REASON_VERTEX_OUT_OF_RANGE, TAUT_ELEMENT_SOURCE, 0));
    const Indices null(static_cast<int *>(nullptr), 2);
    CHECK(fails([&] { solver.field(null); }, TAUT_REASON_NULL_POINTER));
    const int zero = 0;
    CHECK(fails([&] { solver.field(Indices(&zero, SIZE_MAX / 2)); }, TAUT_REASON_TOO_MANY_ELEMENTS));
    try {
        taut::Mesh::read("/nowhere/mesh.off");
        CHECK(false);
    } catch (const std::runtime_error &error) {
        CHECK(dynamic_cast<const taut::Error &>(error).status() == TAUT_STATUS_IO);
        CHECK(std::string(error.what()) == taut_last_error(nullptr));
    }
}

static void handles_move() {
    taut::Mesh mesh(CORNERS, FACES);
    taut::Mesh other = std::move(mesh);
    CHECK(mesh.get() == nullptr && mesh.vertex_count() == 0 && other.vertex_count() == 4);
    CHECK(fails([&] { taut::ExactSolver solver(mesh); }, TAUT_REASON_NULL_POINTER));
    CHECK(fails([&] { mesh.positions(); }, TAUT_REASON_NULL_POINTER));
    mesh = taut::Mesh(CORNERS, std::array{0, 1, 2});
    std::swap(mesh, other);
    CHECK(mesh.triangle_count() == 2 && other.triangle_count() == 1);
    std::vector<taut::ExactField> fields;
    for (int v = 0; v < 4; v++) fields.push_back(taut::ExactSolver(mesh).field(v));
    CHECK(fields[2].distances() == (std::vector<double>{5, 4, 0, 3}));
    taut::Control control;
    const taut::Control moved = std::move(control);
    CHECK(control.get() == nullptr && !control.is_cancelled() && !moved.is_cancelled());
    CHECK(fails([&] { taut::ExactSolver(mesh).field(0, {}, &control); }, TAUT_REASON_NULL_POINTER));
}

static void meshes() {
    const taut::Mesh mesh = taut::Mesh::read("rectangle.off");
    const std::string content = "OFF 3 1 0\n0 0 0\n3 0 0\n3 4 0\n3 0 1 2\n";
    CHECK(taut::Mesh::read_bytes(content.data(), content.size(), TAUT_FORMAT_OFF).vertex_count() == 3);
    CHECK(fails([&] { taut::Mesh::read_bytes(content.data(), 20, TAUT_FORMAT_OFF); }, TAUT_REASON_TRUNCATED,
                TAUT_ELEMENT_LINE, 3));
    CHECK(mesh.vertex_count() == 4 && mesh.triangle_count() == 2 && mesh.ignored_count() == 0);
    CHECK((mesh.positions() == std::vector<Position>{{0, 0, 0}, {3, 0, 0}, {3, 4, 0}, {0, 4, 0}}));
    CHECK((mesh.triangles() == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}, {1, 2, 3}}));
    std::vector<float> xyz(12);
    std::vector<std::uint16_t> corners(6);
    mesh.positions(xyz);
    mesh.triangles(corners);
    CHECK(std::equal(xyz.begin(), xyz.end(), CORNERS.begin()) && corners == std::vector<std::uint16_t>({0, 1, 3, 1, 2, 3}));

    const taut::Mesh quad = taut::Mesh::polygons(CORNERS, std::array{0, 4}, std::array{0, 1, 2, 3});
    CHECK((quad.triangles() == std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
    CHECK(taut::Mesh(CORNERS, std::array{0, 1, 1, 0, 2, 3}).ignored_triangles() == std::vector<std::uint32_t>{0});
    std::vector<double> twice = CORNERS;
    for (double &x : twice) x *= 2;
    CHECK(taut::ExactSolver(mesh.with_positions(twice)).field(0).distances() == (std::vector<double>{0, 6, 10, 8}));

    const taut::Properties properties = mesh.properties();
    CHECK(properties.vertices == 4 && properties.edges == 5 && properties.faces == 2 && properties.max_edge == 5);
    CHECK(properties.mean_edge == 19.0 / 5);
}

static void time_steps() {
    const taut::Mesh mesh = Hills(6).mesh();
    const taut::Properties of = mesh.properties();
    const double e2 = of.mean_edge * of.mean_edge, s = of.sigma_edge;
    const auto is = [&](const taut::TimeStep &step, double t) { return std::abs(mesh.time_step(step) / t - 1) < 1e-12; };
    CHECK(is({}, e2) && is(taut::TimeStep::mean_edge(), e2));
    CHECK(is(taut::TimeStep::sigma().raw(), s));
    CHECK(is(taut::TimeStep::mean_sigma().raw(), (e2 + s) / 2));
    CHECK(is(taut::TimeStep::median_fit().raw(), 1.01204 * s - 0.0001));
    CHECK(is(taut::TimeStep::median_mean().raw(), (e2 + 1.01204 * s - 0.0001) / 2));
    CHECK(is(taut::TimeStep::sigma(), s / of.paper_scale));
    CHECK(is(taut::TimeStep::mean_edge().times(2).times(3), 6 * e2) && is(taut::TimeStep().times(2), 2 * e2));
    CHECK(is(taut::TimeStep::value(0.25), 0.25) && is(taut::TimeStep::value(0.25).times(2), 0.5));
    for (const double bad : {0.0, -1.0, std::nan("")}) {
        CHECK(fails([&] { taut::TimeStep::value(bad); }, TAUT_REASON_BAD_TIME_STEP));
        CHECK(fails([&] { taut::TimeStep().times(bad); }, TAUT_REASON_BAD_TIME_STEP));
    }
}

static void reports() {
    // Two triangles, a third on their edge, one turned over, one twice, one that repeats an index, one without area.
    const std::vector<Position> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                                          {5, 0, 0}, {6, 0, 0}, {7, 0, 0}, {5, 0, 0}};
    const std::vector<Triangle> triangles{{0, 1, 2}, {0, 3, 2}, {0, 2, 4}, {0, 1, 2}, {1, 1, 2}, {5, 6, 7}};
    const taut::Mesh mesh(positions, triangles);
    const taut::MeshReport report(mesh);
    using Pairs = taut::MeshReport::Pairs;
    using List = taut::MeshReport::Indices;
    const std::vector<taut::Component> parts = report.components();
    CHECK(report.count(TAUT_FINDING_COMPONENTS) == 2 && parts.size() == 2);
    CHECK(parts.size() == 2 && parts[0].first_vertex == 0 && parts[1].first_vertex == 5 && parts[1].faces == 1);
    CHECK(report.component_of() == (List{0, 0, 0, 0, 0, 1, 1, 1, taut::none}));
    CHECK((report.nonmanifold_edges() == Pairs{{0, 2}}));
    const std::vector<taut::BoundaryLoop> chains = report.boundary_loops();
    CHECK(chains.size() == 3 && !chains[0].is_closed && !chains[1].is_closed && chains[2].is_closed);
    CHECK(chains.size() == 3 && chains[2].vertices.size() == 3);
    CHECK((report.duplicate_faces() == Pairs{{3, 0}}));
    CHECK((report.duplicate_vertices() == Pairs{{8, 5}}));
    CHECK(report.repeated_index_faces() == List{4} && report.zero_area_faces() == List{5});
    CHECK(report.unreferenced_vertices() == List{8} && report.nonmanifold_vertices().empty());
    CHECK(report.nonorientable_components().size() == report.count(TAUT_FINDING_NONORIENTABLE_COMPONENTS));

    const taut::MeshReport turned(taut::Mesh(positions, std::vector<Triangle>{{0, 1, 2}, {0, 3, 2}}));
    CHECK((turned.inconsistent_edges() == Pairs{{0, 2}}));
    const std::vector<taut::BoundaryLoop> loops = taut::MeshReport(taut::Mesh(CORNERS, FACES)).boundary_loops();
    CHECK(loops.size() == 1 && loops[0].is_closed && loops[0].vertices.size() == 4);
    const auto [smallest, largest] = taut::MeshReport(taut::Mesh(CORNERS, FACES)).angles();
    CHECK(std::abs(std::tan(smallest.radians) - 0.75) < 1e-12 && std::abs(largest.radians - std::acos(0.0)) < 1e-12);
}

static void heat() {
    const Hills hills(12);
    const taut::Mesh mesh = hills.mesh();
    const taut::HeatSolver solver(mesh, taut::TimeStep::mean_edge().times(2));
    CHECK(solver.time_step() == mesh.time_step(taut::TimeStep::mean_edge().times(2)));
    const taut::HeatField field = solver.field(std::array{0, 143});
    const std::vector<double> distances = field.distances();
    CHECK(distances.size() == 144 && distances[0] == 0 && distances[143] == 0 && distances[11] > 8);
    const std::vector<std::uint32_t> nearest = field.nearest_sources();
    CHECK(nearest[1] == 0 && nearest[142] == 1 && field.nonpositive_heat() == 0 && field.restarts() == 0);
    std::vector<float> single(144);
    field.distances(single);
    CHECK(single[11] == static_cast<float>(distances[11]));

    const taut::HeatSolver other = solver.with_time_step(taut::TimeStep::value(0.5));
    CHECK(other.time_step() == 0.5);
    CHECK(other.field(5).distances() == taut::HeatSolver(mesh, taut::TimeStep::value(0.5)).field(5).distances());
    std::vector<Position> twice = hills.positions;
    for (Position &p : twice)
        for (double &x : p) x *= 2;
    const std::vector<double> doubled = solver.with_mesh(mesh.with_positions(twice)).field(std::array{0, 143}).distances();
    for (std::size_t v = 0; v < 144; v++) CHECK(doubled[v] == 2 * distances[v]);

    taut::HeatOptions plain, bounded, shifted, unknown;
    plain.laplacian = TAUT_LAPLACIAN_PLAIN;
    bounded.boundary = 0.5;
    shifted.shift = TAUT_SHIFT_MIN;
    unknown.solver = 77;
    const auto late = taut::Sources(std::array{70, 80}).with_offsets(std::array{0.0, 1.0});
    const auto with = [&](const taut::HeatOptions &options) { return taut::HeatSolver(mesh, options).field(late).distances(); };
    for (const taut::HeatOptions &options : {plain, bounded, shifted}) CHECK(with(options) != with({}));
    CHECK(with({})[80] == 1 && with(shifted)[80] != 1);
    CHECK(fails([&] { with(unknown); }, TAUT_REASON_BAD_ARGUMENT));
    CHECK(taut::HeatSolver(mesh, plain).report().flips == 0 && solver.report().flips > 0);

    std::vector<double> rows = solver.field(3).distances();
    const std::vector<double> second = solver.field(100).distances();
    rows.insert(rows.end(), second.begin(), second.end());
    CHECK(solver.distance_rows(std::array{3, 100}) == rows && solver.distance_rows(std::array{3, 100}, 1) == rows);
    // Rows with a gap between them.
    std::vector<double> wide(2 * 150, -1);
    solver.distance_rows(std::array{3, 100}, {wide.data(), 2, 150 * sizeof(double)}, 2);
    CHECK(std::equal(rows.begin(), rows.begin() + 144, wide.begin()) && wide[144] == -1);
    CHECK(std::equal(rows.begin() + 144, rows.end(), wide.begin() + 150) && wide[299] == -1);
    CHECK(fails([&] { solver.distance_rows(0, rows = std::vector<double>(143)); }, TAUT_REASON_BAD_ARGUMENT));
    // Sets of sources: both together, and the second alone.
    solver.distance_rows(std::array{3, 100, 100}, std::array{0, 2, 3}, rows = std::vector<double>(2 * 144));
    CHECK(std::equal(rows.begin(), rows.begin() + 144, solver.field(std::array{3, 100}).distances().begin()));
    CHECK(std::equal(rows.begin() + 144, rows.end(), second.begin()));
    const taut::HeatResiduals residuals = solver.residuals(3);
    CHECK(residuals.heat < 1e-9 && residuals.poisson < 1e-9 && residuals.heat >= 0);
}

static void exact() {
    const taut::Mesh mesh = Hills(12).mesh();
    const taut::ExactSolver solver(mesh);
    const taut::Sources ends = std::vector<int>{0, 143}; // a copy
    const int apart[] = {3, 77, 100};
    const taut::Sources outer = Indices(apart, 2, 2 * sizeof(int));
    CHECK(solver.distance_rows(outer) == solver.distance_rows(std::array{3, 100}));
    const taut::ExactField field = solver.field(ends);
    const std::vector<double> distances = field.distances();
    CHECK(field.final_radius() == INF && field.interruption() == TAUT_STATUS_OK && field.windows() > 0);
    CHECK(field.distances(7) == std::vector<double>{distances[7]});
    CHECK(field.distances(std::array{7, 9}) == (std::vector<double>{distances[7], distances[9]}));
    CHECK(field.distances(std::vector<int>()).empty());
    CHECK(field.nearest_sources(std::array{1, 142}) == (std::vector<std::uint32_t>{0, 1}));
    CHECK(field.nearest_sources().size() == 144);

    const std::vector<double> late = solver.field(ends.with_offsets(std::array{0.5, 0.25})).distances();
    CHECK(late[0] == 0.5 && late[143] == 0.25);
    CHECK(solver.field(taut::Sources(0).with_offsets(-1)).distances(0) == std::vector<double>{-1});

    taut::ExactOptions options;
    options.radius = 3;
    const taut::ExactField near = solver.field(0, options);
    CHECK(near.final_radius() >= 3 && near.final_radius() < 30);
    options = {};
    options.targets = std::array{5, 12};
    CHECK(solver.field(0, options).distances(options.targets) == solver.field(0).distances(std::array{5, 12}));
    CHECK(solver.field(0, options).final_radius() < INF);

    std::vector<double> rows = solver.field(3).distances();
    const std::vector<double> second = solver.field(100).distances();
    rows.insert(rows.end(), second.begin(), second.end());
    CHECK(solver.distance_rows(std::array{3, 100}, 2) == rows);
    std::vector<double> both(144);
    solver.distance_rows(std::array{3, 100}, std::array{0, 2}, both);
    CHECK(both == solver.field(std::array{3, 100}).distances());
    const taut::SparseDistances sparse = solver.distances_within(std::array{3, 100}, 2, 1);
    const std::vector<std::uint64_t> offsets = sparse.offsets();
    const std::vector<std::uint32_t> vertices = sparse.vertices();
    const std::vector<double> values = sparse.values();
    CHECK(sparse.row_count() == 2 && offsets.size() == 3 && offsets[2] == sparse.count() && values.size() == sparse.count());
    for (std::size_t row = 0, i = 0; row < 2; row++)
        for (std::size_t v = 0; v < 144; v++) {
            const double d = rows[144 * row + v];
            if (d <= 2) {
                CHECK(i < offsets[row + 1] && vertices[i] == v && values[i] == d);
                i++;
            }
        }

    const taut::FarthestPoints points = solver.farthest_points(0, 3);
    CHECK(points.vertices[0] == 143 && points.distances[0] == solver.field(0).distances()[143]);
    CHECK(taut::ExactSolver(taut::Mesh(CORNERS, FACES)).farthest_points(0, 9).vertices[8] == taut::none);
}

static void curves_and_points() {
    const taut::Mesh mesh = Hills(12).mesh();
    const taut::Closest closest(mesh);
    const taut::ClosestPoints found = closest.points(std::vector<Position>{{2.3, 3.1, 5}, {8.2, 7.7, -5}});
    CHECK(found.faces.size() == 2 && found.distances[0] > 3);
    CHECK(closest.points(std::array{2.3, 3.1, 5.0}).faces[0] == found.faces[0]);

    const taut::Sources click = taut::Sources().with_points(found.faces, found.barycentrics);
    CHECK(click.count() == 2 && taut::Sources(5).with_points(found.faces, found.barycentrics).count() == 3);
    taut::ExactOptions options;
    options.keep_windows = true;
    const taut::ExactField field = taut::ExactSolver(mesh).field(click, options);
    CHECK(field.distances(taut::Targets().with_points(found.faces, found.barycentrics)) == std::vector<double>(2, 0));
    const taut::Targets mixed = taut::Targets(0).with_points(found.faces, found.barycentrics);
    CHECK(field.distances(mixed).size() == 3 && field.nearest_sources(mixed)[2] == 1);

    const taut::Curves paths = field.paths(std::array{0, 143});
    const std::vector<std::uint32_t> offsets = paths.offsets();
    const std::vector<Position> line = paths.positions();
    CHECK(paths.count() == 2 && offsets.size() == 3 && offsets[2] == paths.point_count() && line.size() == offsets[2]);
    double length = 0;
    for (std::size_t i = 1; i < offsets[1]; i++)
        length += std::hypot(line[i][0] - line[i - 1][0], line[i][1] - line[i - 1][1], line[i][2] - line[i - 1][2]);
    CHECK(std::abs(length / field.distances()[0] - 1) < 1e-12);
    CHECK(field.paths().count() == 144 && paths.closed() == std::vector<std::uint32_t>(2, 0));

    const std::vector<double> distances = field.distances();
    const taut::Curves lines = taut::isolines(mesh, distances, std::array{1.0, 2.0});
    CHECK(lines.count() >= 2 && lines.levels().back() == 1 && taut::isolines(mesh, distances, 1).count() > 0);
    const taut::Curves down = taut::descent_paths(mesh, distances, click, 17);
    CHECK(down.count() == 1 && taut::descent_paths(mesh, distances).count() == 144);
    CHECK(paths.sources() == field.nearest_sources(std::array{0, 143}));

    // Levels: evenly spread, and multiples of a number.
    const double farthest = *std::max_element(distances.begin(), distances.end());
    const std::vector<double> even = taut::even_levels(mesh, distances, 3);
    CHECK(even.size() == 3 && std::abs(even[1] / farthest - 0.5) < 1e-12);
    const std::vector<double> spaced = taut::spaced_levels(mesh, distances, 2);
    CHECK(spaced.size() > 2 && spaced[0] == 2 && spaced[1] == 4 && spaced.back() < farthest);
    CHECK(fails([&] { taut::even_levels(mesh, distances, TAUT_MAX_LEVELS + 1); }, TAUT_REASON_BAD_ARGUMENT));

    // A curve through two places is the path between them, and a source.
    const taut::Targets places = taut::Targets().with_points(std::vector<std::uint32_t>{17, 60}, std::vector<double>(6, 1.0 / 3));
    const std::vector<std::uint32_t> triangles{17, 60};
    const std::vector<double> middles(6, 1.0 / 3);
    const taut::Curves through = taut::ExactSolver(mesh).curve_through(triangles, middles);
    CHECK(through.count() == 1);
    CHECK(through.positions().front() == mesh.point_positions(triangles, middles).front());
    taut::ExactOptions anywhere;
    anywhere.keep_windows = true;
    const taut::Sources curve = taut::Sources().with_curves(through);
    CHECK(taut::ExactSolver(mesh).field(curve, anywhere).distances(places)[1] < 1e-12);

    // The isoline at 1 as sources: its own distance is 0.
    const taut::Curves one = taut::isolines(mesh, distances, 1);
    const auto ends = one.offsets(), faces = one.faces(), closed = one.closed();
    const auto barycentrics = one.barycentrics();
    const taut::Sources rings = taut::Sources().with_curves(ends, faces, barycentrics, closed);
    CHECK(rings.count() == one.count());
    const std::vector<double> away = taut::HeatSolver(mesh).field(rings).distances();
    CHECK(away.size() == 144 && taut::ExactSolver(mesh).field(rings).distances()[143] > 1);
    CHECK(taut::HeatSolver(mesh).field(taut::Sources().with_curves(one)).distances() == away);

    // Two sides of the rectangle, and closed its diagonal too, from which the fourth corner is 12 / 5 away.
    const taut::ExactSolver rectangle(taut::Mesh(CORNERS, FACES));
    const std::array<Position, 3> corners{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const auto sides = taut::Sources().with_curves(std::array{0, 3}, std::array{0, 0, 0}, corners);
    const auto triangle = taut::Sources().with_curves(std::array{0, 3}, std::array{0, 0, 0}, corners, 1);
    CHECK(rectangle.field(sides).distances()[3] == 3);
    CHECK(std::abs(rectangle.field(triangle).distances()[3] - 2.4) < 1e-14);
}

// Long enough that the library looks at the control several times.
static const taut::ExactSolver &long_work() {
    static const taut::ExactSolver solver(Hills(80).mesh());
    return solver;
}

static taut_status status_of(const taut::Control &control) {
    try {
        long_work().field(0, {}, &control);
        return TAUT_STATUS_OK;
    } catch (const taut::Error &error) {
        return error.status();
    }
}

static void controls() {
    int calls = 0;
    double last = 0;
    const taut::Control watch([&](double progress) {
        CHECK(progress >= last && progress <= 1);
        last = progress;
        calls++;
    });
    CHECK(status_of(watch) == TAUT_STATUS_OK && calls > 2 && watch.progress() == last);

    taut::Control *self = nullptr;
    taut::Control stop([&](double) { self->cancel(); });
    self = &stop;
    CHECK(status_of(stop) == TAUT_STATUS_CANCELLED && stop.is_cancelled());

    taut::Control slow;
    slow.set_time_limit(std::chrono::nanoseconds(1));
    CHECK(status_of(slow) == TAUT_STATUS_LIMIT_REACHED);
    CHECK(fails([&] { slow.set_time_limit(std::chrono::seconds(-1)); }, TAUT_REASON_BAD_ARGUMENT));
    taut::Control small;
    small.set_memory_limit(1);
    CHECK(fails([&] { long_work().field(0, {}, &small); }, TAUT_REASON_MEMORY_LIMIT));
    taut::ExactOptions options;
    options.allow_partial = true;
    CHECK(long_work().field(0, options, &small).interruption() == TAUT_STATUS_LIMIT_REACHED);

    // From another thread, once the work has begun.
    std::atomic<bool> has_begun{false};
    taut::Control control([&](double) {
        has_begun = true;
        while (!self->is_cancelled()) std::this_thread::yield();
    });
    self = &control;
    std::thread other([&] {
        while (!has_begun) std::this_thread::yield();
        control.cancel();
    });
    CHECK(status_of(control) == TAUT_STATUS_CANCELLED);
    other.join();
}

struct Stopped {
    int call;
};

// What the callback throws comes out of `work`, once, and of every kind of call.
template <class Work>
static bool rethrows(const Work &work) {
    int calls = 0;
    taut::Control control([&](double) { throw Stopped{++calls}; });
    taut::Control moved = std::move(control);
    bool is_rethrown = false;
    try {
        work(&moved);
    } catch (const Stopped &stopped) {
        is_rethrown = stopped.call == 1;
    }
    // Later calls find a cancelled control, and do not bring the exception again.
    const bool is_cancelled = fails([&] { work(&moved); }, TAUT_REASON_CANCELLED);
    return is_rethrown && is_cancelled && calls == 1;
}

static void exceptions_of_callbacks() {
    const taut::Mesh mesh = Hills(12).mesh();
    const taut::HeatSolver heat(mesh);
    const taut::ExactSolver exact(mesh);
    const taut::ExactField field = exact.field(0);
    using Control = const taut::Control *;
    CHECK(rethrows([&](Control c) { taut::HeatSolver solver(mesh, {}, c); }));
    CHECK(rethrows([&](Control c) { heat.with_time_step({}, c); }));
    CHECK(rethrows([&](Control c) { heat.with_mesh(mesh, c); }));
    CHECK(rethrows([&](Control c) { heat.field(0, c); }));
    CHECK(rethrows([&](Control c) { heat.distance_rows(0, 1, c); }));
    CHECK(rethrows([&](Control c) { exact.field(0, {}, c); }));
    CHECK(rethrows([&](Control c) { exact.distance_rows(0, 1, c); }));
    CHECK(rethrows([&](Control c) { exact.distances_within(0, 5, 1, c); }));
    CHECK(rethrows([&](Control c) { exact.farthest_points(0, 2, c); }));
    CHECK(rethrows([&](Control c) { field.paths({}, c); }));

    // Also where the call succeeds with a part.
    taut::ExactOptions options;
    options.allow_partial = true;
    taut::Control control([](double) { throw Stopped{1}; });
    bool is_rethrown = false;
    try {
        exact.field(0, options, &control);
    } catch (const Stopped &) {
        is_rethrown = true;
    }
    CHECK(is_rethrown && exact.field(0, options, &control).interruption() == TAUT_STATUS_CANCELLED);
}

// What the callback threw on one thread waits for it, whoever else uses the control. The call is C's, which rethrows
// nothing itself.
static void exceptions_stay_on_their_thread() {
    const taut::Control control([](double) { throw Stopped{1}; });
    const taut::Sources sources(0);
    const taut_sources from = sources.c();
    taut_exact_field *field = nullptr;
    CHECK(taut_exact_field_new(long_work().get(), &from, nullptr, control.get(), &field) != TAUT_STATUS_OK);
    bool is_thrown_elsewhere = false;
    taut_status elsewhere = TAUT_STATUS_OK;
    std::thread other([&] {
        try {
            elsewhere = status_of(control);
        } catch (const Stopped &) {
            is_thrown_elsewhere = true;
        }
    });
    other.join();
    CHECK(!is_thrown_elsewhere && elsewhere == TAUT_STATUS_CANCELLED);
    bool is_thrown_here = false;
    try {
        control.rethrow();
    } catch (const Stopped &) {
        is_thrown_here = true;
    }
    CHECK(is_thrown_here);
}

// One solver on eight threads.
static void threads_share_handles() {
    const taut::Mesh mesh = Hills(30).mesh();
    const taut::HeatSolver solver(mesh);
    std::vector<std::vector<double>> results(8);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < 8; i++) threads.emplace_back([&, i] { results[i] = solver.field(7).distances(); });
    for (std::thread &thread : threads) thread.join();
    for (const auto &result : results) CHECK(result == results[0]);
}

int main() {
    const auto [major, minor, patch] = std::array{TAUT_VERSION_MAJOR, TAUT_VERSION_MINOR, TAUT_VERSION_PATCH};
    CHECK(taut::version() == std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch));
    CHECK(taut::abi() == TAUT_ABI && taut::status_name(TAUT_STATUS_IO) == std::string(taut_status_name(3)));
    views_are_read();
    views_are_filled();
    errors_tell_what_failed();
    handles_move();
    meshes();
    time_steps();
    reports();
    heat();
    exact();
    curves_and_points();
    controls();
    exceptions_of_callbacks();
    exceptions_stay_on_their_thread();
    threads_share_handles();
    return failures == 0 ? 0 : 1;
}
