// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// Runs each filter on meshes in memory, and compares what they hold then with what the library says of plain arrays.
//
//     filters PLUGIN MESH...
#include "../../../cpp_tests/check.hpp"
#include "host.hpp"

#include <QApplication>
#include <tuple>

namespace {

MeshFilterInterface *plugin = nullptr;
std::size_t cancel_at = 0; // which call of the callback cancels, from 1 on; 0 is none
std::vector<int> progress;

bool tell(int percent, const char *) {
    progress.push_back(percent);
    return progress.size() != cancel_at;
}

bool run(MeshDocument &document, const char *name, const Changes &changes = {}) {
    return ::run(plugin, document, name, changes, tell);
}

// -------------------------------------------------------------------------------------------------------------- Meshes

/// Two squares apart, and a vertex at no place that no triangle uses.
Arrays squares() {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    return {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {nan, nan, nan}, {5, 0, 0}, {6, 0, 0}, {6, 1, 0}, {5, 1, 0}},
            {{0, 1, 2}, {0, 2, 3}, {5, 6, 7}, {5, 7, 8}}};
}

/// Whether each vertex has this quality, to the nearest float, or `unreached` in place of inf.
template <class Values>
bool has_quality(const CMeshO &m, const Values &values, float unreached = -1) {
    if (m.vert.size() != values.size()) return false;
    for (std::size_t i = 0; i < values.size(); i++) {
        const float wanted = std::isinf(values[i]) ? unreached : static_cast<float>(values[i]);
        if (!m.vert[i].IsD() && m.vert[i].cQ() != wanted) return false;
    }
    return true;
}

using State = std::vector<std::tuple<float, int, int>>;
State state(const MeshDocument &document) {
    State state{{0, document.size(), document.mm() ? document.mm()->dataMask() : 0}};
    for (const MeshModel *layer : document.meshList)
        for (const CVertexO &v : layer->cm.vert) {
            const vcg::Color4b c = v.cC();
            state.emplace_back(v.cQ(), c[0] | c[1] << 8 | c[2] << 16 | c[3] << 24, v.cFlags());
        }
    return state;
}

/// Whether a filter refuses to run with a message that has `part` in it, and changes nothing.
bool refuses(MeshDocument &document, const char *name, const Changes &changes, const char *part) {
    const State before = state(document);
    if (run(document, name, changes)) return false;
    if (state(document) != before) return false;
    if (plugin->errorMsg().contains(part)) return true;
    std::printf("instead: %s\n", qUtf8Printable(plugin->errorMsg()));
    return false;
}

constexpr const char *distance = "Geodesic distance (Taut)";
constexpr const char *isolines = "Geodesic isolines (Taut)";
constexpr const char *path = "Geodesic shortest path (Taut)";
constexpr const char *cells = "Geodesic Voronoi cells (Taut)";
constexpr int vertices = 0, faces = 1, at_point = 2, exact = 0, heat = 1;

// --------------------------------------------------------------------------------------------------------------- Tests

void test_distances(const Arrays &arrays) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    const taut::Mesh mesh = arrays.mesh();
    const taut::ExactSolver solver(mesh);
    // Corners of triangles, since unreferenced vertices are no test.
    const std::vector<std::uint32_t> selected{arrays.triangles[0][0], arrays.triangles[arrays.triangles.size() / 2][1]};
    for (const auto v : selected) m.vert[v].SetS();
    std::vector<std::uint32_t> sorted = selected;
    std::sort(sorted.begin(), sorted.end());

    CHECK(run(document, distance));
    CHECK(has_quality(m, solver.field(sorted).distances()));
    CHECK(document.mm()->hasDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR));

    CHECK(run(document, distance, {{"method", choice(heat)}, {"colour", flag(false)}}));
    CHECK(has_quality(m, taut::HeatSolver(mesh).field(sorted).distances()));

    taut::HeatOptions options(taut::TimeStep::mean_sigma().times(0.5));
    options.laplacian = TAUT_LAPLACIAN_PLAIN;
    options.boundary = 0.25;
    const Changes changes{{"method", choice(heat)}, {"timeStep", choice(2)}, {"timeFactor", number(0.5)},
                          {"laplacian", choice(1)}, {"boundary", number(0.25)}};
    CHECK(run(document, distance, changes));
    CHECK(has_quality(m, taut::HeatSolver(mesh, options).field(sorted).distances()));

    const std::uint32_t face = static_cast<std::uint32_t>(arrays.triangles.size() / 3);
    m.face[face].SetS();
    const double third = 1.0 / 3.0;
    const std::vector<double> centre{third, third, third};
    CHECK(run(document, distance, {{"sources", choice(faces)}}));
    CHECK(has_quality(m, solver.field(taut::Sources().with_points(face, centre)).distances()));

    // From a point in the space of the document, where the layer is turned and moved.
    const Point3m p = document.mm()->cm.bbox.max;
    m.Tr.SetRotateDeg(90, Point3m(0, 0, 1));
    const std::vector<float> position{p[0], p[1], p[2]};
    const taut::ClosestPoints place = taut::Closest(mesh).points(position);
    const auto from = taut::Sources().with_points(place.faces, place.barycentrics);
    const std::vector<double> wanted = solver.field(from).distances();
    CHECK(run(document, distance, {{"sources", choice(at_point)}, {"sourcePoint", point(m.Tr * p)}}));
    double worst = 0, most = 0;
    for (std::size_t i = 0; i < wanted.size(); i++) {
        if (!std::isfinite(wanted[i])) continue;
        worst = std::max(worst, std::abs(wanted[i] - m.vert[i].cQ()));
        most = std::max(most, wanted[i]);
    }
    CHECK(worst <= 1e-5 * most); // the turn there and back is rounded
    m.Tr.SetIdentity();
    CHECK(run(document, distance, {{"sources", choice(at_point)}, {"sourcePoint", point(p)}}));
    CHECK(has_quality(m, wanted));
}

void test_cells(const Arrays &arrays) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    std::vector<std::uint32_t> seeds;
    for (std::size_t i = 0; i < arrays.positions.size(); i += 1 + arrays.positions.size() / 10) {
        seeds.push_back(static_cast<std::uint32_t>(i));
        m.vert[i].SetS();
    }
    for (const int method : {exact, heat}) {
        CHECK(run(document, cells, {{"method", choice(method)}}));
        const taut::Mesh mesh = arrays.mesh();
        const auto nearest = method == exact ? taut::ExactSolver(mesh).field(seeds).nearest_sources()
                                             : taut::HeatSolver(mesh).field(seeds).nearest_sources();
        std::vector<float> wanted;
        for (const auto source : nearest) wanted.push_back(source == taut::none ? -1 : float(source));
        CHECK(has_quality(m, wanted));
    }
}

double length(const CMeshO &lines, float quality) {
    double sum = 0;
    for (const CEdgeO &edge : lines.edge)
        if (edge.cV(0)->cQ() == quality) sum += vcg::Distance(edge.cV(0)->cP(), edge.cV(1)->cP());
    return sum;
}

void test_isolines(const Arrays &arrays) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    m.Tr.SetTranslate(Point3m(1, 2, 3));
    m.vert[arrays.triangles[0][0]].SetS();
    CHECK(run(document, distance));
    std::vector<float> quality; // inf in place of -1
    for (const CVertexO &v : m.vert) quality.push_back(v.cQ() < 0 ? std::numeric_limits<float>::infinity() : v.cQ());

    CHECK(run(document, isolines, {{"count", count(5)}}));
    CHECK(document.size() == 2 && document.mm()->label() == "surface");
    const CMeshO &lines = document.meshList[1]->cm;
    CHECK(lines.Tr == m.Tr);

    const taut::Mesh mesh = arrays.mesh();
    const auto levels = taut::even_levels(mesh, quality, 5);
    const taut::Curves curves = taut::isolines(mesh, quality, levels);
    const auto points = curves.positions();
    const auto offsets = curves.offsets(), closed = curves.closed(), level = curves.levels();
    CHECK(lines.vert.size() == points.size() && !points.empty());
    std::map<std::uint32_t, double> lengths;
    std::size_t edges = 0;
    for (std::size_t c = 0; c < curves.count(); c++) {
        const std::size_t size = offsets[c + 1] - offsets[c], pieces = closed[c] ? size : size - 1;
        for (std::size_t i = 0; i < pieces; i++) {
            const auto &a = points[offsets[c] + i], &b = points[offsets[c] + (i + 1) % size];
            lengths[level[c]] += std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
        }
        edges += pieces;
    }
    CHECK(lines.edge.size() == edges && static_cast<std::size_t>(lines.en) == edges);
    for (const auto &[i, wanted] : lengths)
        CHECK(std::abs(length(lines, static_cast<float>(levels[i])) - wanted) <= 1e-4 * wanted);

    const float spacing = static_cast<float>(levels[0] / 2);
    CHECK(run(document, isolines, {{"spacing", number(spacing)}}));
    const auto spaced = taut::spaced_levels(mesh, quality, spacing);
    const auto expected = taut::isolines(mesh, quality, spaced);
    CHECK(document.size() == 3 && document.meshList[2]->cm.vert.size() == expected.point_count());
}

void test_path(const Arrays &arrays) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    const taut::Mesh mesh = arrays.mesh();
    const std::uint32_t start = arrays.triangles[0][0];
    const auto field = taut::ExactSolver(mesh).field(start);
    const auto distances = field.distances();
    // The farthest that is reached.
    std::uint32_t end = start;
    for (std::uint32_t v = 0; v < distances.size(); v++)
        if (std::isfinite(distances[v]) && distances[v] > distances[end]) end = v;
    m.vert[start].SetS();
    CHECK(run(document, path, {{"sources", choice(vertices)}, {"targetPoint", point(m.vert[end].P())}}));
    CHECK(document.size() == 2);
    const CMeshO &line = document.meshList[1]->cm;
    const double bound = 1e-4 * distances[end];
    CHECK(std::abs(length(line, 0) - distances[end]) <= bound);
    CHECK(line.edge.size() + 1 == line.vert.size());
    CHECK(vcg::Distance(line.vert.front().cP(), m.vert[end].cP()) <= bound);
    CHECK(vcg::Distance(line.vert.back().cP(), m.vert[start].cP()) <= bound);

    CHECK(run(document, path, {{"sourcePoint", point(m.vert[start].P())}, {"targetPoint", point(m.vert[end].P())}}));
    CHECK(document.size() == 3 && std::abs(length(document.meshList[2]->cm, 0) - distances[end]) <= bound);
}

/// MeshLab leaves deleted elements where they are until a layer is saved.
void test_deleted(const Arrays &arrays) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    Arrays left;
    left.positions = arrays.positions;
    for (std::size_t f = 0; f < m.face.size(); f++) {
        if (f % 5 == 3) vcg::tri::Allocator<CMeshO>::DeleteFace(m, m.face[f]);
        else left.triangles.push_back(arrays.triangles[f]);
    }
    std::vector<bool> is_used(m.vert.size());
    for (const auto &t : left.triangles)
        for (const auto v : t) is_used[v] = true;
    for (std::size_t v = 0; v < m.vert.size(); v++) {
        if (is_used[v]) continue;
        m.vert[v].SetS();
        m.vert[v].P()[0] = std::numeric_limits<float>::quiet_NaN();
        vcg::tri::Allocator<CMeshO>::DeleteVertex(m, m.vert[v]);
    }
    const std::uint32_t triangle = static_cast<std::uint32_t>(left.triangles.size() - 1);
    m.face.back().IsD() ? m.face[m.face.size() - 2].SetS() : m.face.back().SetS();
    const double third = 1.0 / 3.0;
    const std::vector<double> centre{third, third, third};
    const taut::Mesh mesh = left.mesh();
    CHECK(run(document, distance, {{"sources", choice(faces)}}));
    CHECK(has_quality(m, taut::ExactSolver(mesh).field(taut::Sources().with_points(triangle, centre)).distances()));
    CHECK(refuses(document, distance, {}, "no vertex is selected")); // the deleted ones do not count

    const std::uint32_t start = left.triangles[0][0];
    m.vert[start].SetS();
    CHECK(run(document, distance));
    CHECK(has_quality(m, taut::ExactSolver(mesh).field(start).distances()));
    CHECK(run(document, isolines));
}

void test_parts() {
    MeshDocument document;
    CMeshO &m = add(document, squares());
    m.vert[0].SetS();
    CHECK(run(document, distance));
    const float inf = std::numeric_limits<float>::infinity();
    const float diagonal = std::sqrt(2.0f);
    CHECK(has_quality(m, std::vector<float>{0, 1, diagonal, 1, inf, inf, inf, inf, inf}));
    CHECK(m.vert[0].C() == vcg::Color4b(vcg::Color4b::Red) && m.vert[2].C() == vcg::Color4b(vcg::Color4b::Blue));
    CHECK(m.vert[5].C() == vcg::Color4b(160, 160, 160, 255) && m.vert[4].C() == m.vert[5].C());

    CHECK(run(document, distance, {{"unreached", number(inf)}}));
    CHECK(m.vert[5].Q() == inf && m.vert[5].C() == vcg::Color4b(160, 160, 160, 255));
    CHECK(run(document, isolines, {{"spacing", number(0.5)}}));
    const CMeshO &lines = document.meshList[1]->cm;
    CHECK(lines.vert.size() == 6 && lines.edge.size() == 4); // 0.5 and 1, each over two triangles
    for (const CVertexO &v : lines.vert) CHECK(v.cQ() == 0.5f || v.cQ() == 1.0f);

    // A quality that is no distance.
    for (const int v : {0, 1, 2, 3}) m.vert[v].Q() = m.vert[v].P()[0] - 0.75f;
    CHECK(run(document, isolines, {{"spacing", number(0.5)}, {"skipNegative", flag(false)}}));
    CHECK(document.meshList[2]->cm.edge.size() == 4); // -0.5 and 0
    CHECK(refuses(document, isolines, {{"spacing", number(0.5)}}, "none to draw"));

    CHECK(run(document, cells));
    CHECK(has_quality(m, std::vector<float>{0, 0, 0, 0, -1, -1, -1, -1, -1}));

    m.vert[0].ClearS();
    m.vert[4].SetS(); // a source without triangles
    CHECK(run(document, distance));
    CHECK(has_quality(m, std::vector<float>{inf, inf, inf, inf, 0, inf, inf, inf, inf}));
}

void test_refusals() {
    MeshDocument document;
    CHECK(refuses(document, distance, {}, "there is no layer"));
    CHECK(refuses(document, isolines, {}, "there is no layer"));
    CMeshO &empty = add(document, {});
    CHECK(refuses(document, distance, {}, "no vertex is selected"));
    CHECK(refuses(document, distance, {{"sources", choice(faces)}}, "no face is selected"));
    CHECK(refuses(document, distance, {{"sources", choice(at_point)}}, "no triangles"));
    CHECK(refuses(document, isolines, {}, "constant"));
    CHECK(empty.vert.empty());

    CMeshO &m = add(document, squares());
    for (const char *name : {distance, cells}) {
        CHECK(refuses(document, name, {}, "no vertex is selected"));
        CHECK(refuses(document, name, {{"sources", choice(faces)}}, "no face is selected"));
        CHECK(refuses(document, name, {{"sources", choice(3)}}, "Sources: there is no such choice"));
        m.vert[0].SetS();
        CHECK(refuses(document, name, {{"method", choice(2)}}, "Method: there is no such choice"));
        for (const float factor : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()})
            CHECK(refuses(document, name, {{"method", choice(heat)}, {"timeFactor", number(factor)}}, "not positive"));
        CHECK(refuses(document, name, {{"method", choice(heat)}, {"timeStep", choice(5)}}, "time step: there is no"));
        CHECK(refuses(document, name, {{"method", choice(heat)}, {"laplacian", choice(-1)}}, "Laplacian: there is no"));
        CHECK(refuses(document, name, {{"method", choice(heat)}, {"boundary", number(2)}}, "boundary"));
        m.vert[0].ClearS();
    }
    const Point3m nowhere(0, std::numeric_limits<float>::quiet_NaN(), 0);
    CHECK(refuses(document, distance, {{"sources", choice(at_point)}, {"sourcePoint", point(nowhere)}}, "not finite"));
    const Changes apart{{"sourcePoint", point(Point3m(0, 0, 0))}, {"targetPoint", point(Point3m(6, 1, 0))}};
    CHECK(refuses(document, path, apart, "separate parts"));
    CHECK(refuses(document, isolines, {}, "constant"));
    CHECK(refuses(document, isolines, {{"count", count(-1)}}, "negative"));
    m.vert[2].Q() = 3;
    m.vert[3].Q() = 2;
    m.vert[0].Q() = 1;
    CHECK(refuses(document, isolines, {{"spacing", number(-1)}}, "spacing"));
    CHECK(refuses(document, isolines, {{"spacing", number(1e-9f)}}, "spacing"));
    CHECK(refuses(document, isolines, {{"count", count(1000000)}}, "levels are more than"));

    m.vert[0].SetS();
    m.vert[7].P()[2] = std::numeric_limits<float>::quiet_NaN();
    CHECK(refuses(document, distance, {}, "vertex 7"));
}

void test_cancel(const Arrays &arrays) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    m.vert[arrays.triangles[0][0]].SetS();
    const Changes near{{"sources", choice(vertices)}, {"targetPoint", point(m.face[0].P(1))}};
    const std::vector<std::pair<const char *, Changes>> work{
        {distance, {{"method", choice(exact)}}}, {distance, {{"method", choice(heat)}}}, {cells, {}}, {path, near}};
    for (const auto &[name, changes] : work) {
        MeshDocument fresh;
        add(fresh, arrays).vert[arrays.triangles[0][0]].SetS();
        progress.clear();
        CHECK(run(fresh, name, changes));
        const std::size_t calls = progress.size();
        CHECK(calls > 0);
        for (const int percent : progress) CHECK(percent >= 0 && percent <= 100);
        for (const std::size_t call : {std::size_t(1), 1 + calls / 2, calls}) {
            progress.clear();
            cancel_at = call;
            CHECK(refuses(document, name, changes, "cancelled"));
            CHECK(progress.size() == call); // it was asked no more
        }
        cancel_at = 0;
    }
}

} // namespace

int main(int argc, char **argv) {
    const QApplication application(argc, argv);
    if (argc < 3) return 2;
    plugin = load(argv[1]);
    if (!plugin) return 1;
    CHECK(plugin->actions().size() == 4);
    test_parts();
    test_refusals();
    for (int i = 2; i < argc; i++) {
        const Arrays arrays = read(argv[i]);
        const int before = failures;
        test_distances(arrays);
        test_cells(arrays);
        test_isolines(arrays);
        test_path(arrays);
        test_deleted(arrays);
        test_cancel(arrays);
        std::printf("%s: %zu vertices, %zu triangles, %s\n", argv[i], arrays.positions.size(), arrays.triangles.size(),
                    failures == before ? "fine" : "failed");
    }
    return failures == 0 ? 0 : 1;
}
