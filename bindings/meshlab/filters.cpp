// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// A layer's vertices are read and its quality is written in place. Its triangles are copied, since MeshLab's faces point to
// their vertices. Deleted vertices keep their number, deleted faces are left out.
//
// Points of parameters are in the space of the document, as picked on the screen; distances are in the layer's own
// coordinates, as all of MeshLab's measures.
#include "filters.hpp"

#include <taut.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace taut_meshlab {
namespace {

using taut::Real;
using taut::View;

// ------------------------------------------------------------------------------------------------ The layer as a mesh

MeshModel &current_layer(MeshDocument &document) {
    if (!document.mm()) throw std::runtime_error("there is no layer");
    return *document.mm();
}

/// One field of each vertex; `first` is that of vertex 0.
template <class Scalar>
auto field_of(std::size_t vertex_count, Scalar *first) {
    using Element = std::conditional_t<std::is_const_v<Scalar>, const Real, Real>;
    return View<Element>(first, vertex_count, sizeof(CVertexO));
}
View<const Real> positions(const CMeshO &m) {
    return field_of(m.vert.size(), m.vert.empty() ? nullptr : m.vert[0].P().V());
}
View<Real> quality(CMeshO &m) { return field_of(m.vert.size(), m.vert.empty() ? nullptr : &m.vert[0].Q()); }

taut::Mesh make_mesh(const CMeshO &m) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    triangles.reserve(m.face.size());
    for (const CFaceO &face : m.face) {
        if (face.IsD()) continue;
        auto &corners = triangles.emplace_back();
        for (int i = 0; i < 3; i++) corners[i] = static_cast<std::uint32_t>(vcg::tri::Index(m, face.cV(i)));
    }
    return taut::Mesh(positions(m), triangles);
}

// ------------------------------------------------------------------------------------------------------------ Progress

struct Cancelled : std::runtime_error {
    Cancelled() : std::runtime_error("cancelled") {}
};

/// For one call of the library: tells MeshLab its progress.
taut::Control control(const Run &run, const char *what) {
    return taut::Control([callback = run.callback, what](double progress) {
        if (callback && !callback(static_cast<int>(100 * progress), what)) throw Cancelled();
    });
}

template <class... Numbers>
std::string text(const char *format, Numbers... numbers) {
    char line[256];
    std::snprintf(line, sizeof line, format, numbers...);
    return line;
}

// ------------------------------------------------------------------------------------------------------------- Sources

enum SourceKind { SELECTED_VERTICES, SELECTED_FACES, POINT };

void add_point(const MeshDocument &document, RichParameterList &list, const char *name, const char *label,
               const char *help) {
    const MeshModel *layer = document.mm();
    const bool is_placed = layer && !layer->cm.bbox.IsNull();
    list.addParam(PositionParameter(name, is_placed ? layer->cm.Tr * layer->cm.bbox.Center() : Point3m(0, 0, 0), label,
                                    help));
}

void add_sources(const MeshDocument &document, RichParameterList &list, SourceKind kind) {
    list.addParam(RichEnum("sources", kind, {"Selected vertices", "Centres of selected faces", "Point"}, "Sources",
                           "What distances are measured from; of several places the nearest one counts."));
    add_point(document, list, "sourcePoint", "Source point",
              "Used if Sources is Point: the place of the surface that is nearest to it counts.");
}

/// The place of the surface that is nearest to a point of the document.
taut::ClosestPoints nearest_place(const Run &run, const CMeshO &m, const taut::Mesh &mesh, const char *name) {
    const Point3m point = vcg::Inverse(m.Tr) * run.parameters.getPoint3m(name);
    taut::ClosestPoints place = taut::Closest(mesh).points(View<const Real>(point.V(), 1));
    run.log(text("The nearest place of the surface is %g away", place.distances[0]));
    return place;
}

std::vector<std::uint32_t> selected_vertices(const CMeshO &m) {
    std::vector<std::uint32_t> selected;
    for (std::size_t i = 0; i < m.vert.size(); i++)
        if (!m.vert[i].IsD() && m.vert[i].IsS()) selected.push_back(static_cast<std::uint32_t>(i));
    return selected;
}

/// By their number among the triangles of make_mesh.
std::vector<std::uint32_t> selected_triangles(const CMeshO &m) {
    std::vector<std::uint32_t> selected;
    std::uint32_t triangle = 0;
    for (const CFaceO &face : m.face) {
        if (face.IsD()) continue;
        if (face.IsS()) selected.push_back(triangle);
        triangle++;
    }
    return selected;
}

taut::Sources sources(const Run &run, const CMeshO &m, const taut::Mesh &mesh) {
    switch (run.parameters.getEnum("sources")) {
    case SELECTED_VERTICES: {
        const auto vertices = selected_vertices(m);
        if (vertices.empty()) throw std::runtime_error("no vertex is selected");
        return vertices;
    }
    case SELECTED_FACES: {
        const auto triangles = selected_triangles(m);
        if (triangles.empty()) throw std::runtime_error("no face is selected");
        const double third = 1.0 / 3.0;
        const std::vector<std::array<double, 3>> centres(triangles.size(), {third, third, third});
        return taut::Sources().with_points(triangles, centres);
    }
    case POINT: {
        const taut::ClosestPoints place = nearest_place(run, m, mesh, "sourcePoint");
        return taut::Sources().with_points(place.faces, place.barycentrics);
    }
    }
    throw std::runtime_error("Sources: there is no such choice");
}

// -------------------------------------------------------------------------------------------------------------- Method

enum Method { EXACT, HEAT };

void add_method(RichParameterList &list) {
    list.addParam(RichEnum("method", EXACT, {"Exact", "Heat"}, "Method",
                           "Exact: the length of the shortest way over the triangles. Heat: an approximation, within a "
                           "percent or two on good meshes, in a time that grows slower with their size."));
    list.addParam(RichEnum("timeStep", 0,
                           {"e² (Eq. 1)", "s (Eq. 2)", "(e² + s) / 2 (Eq. 3)", "1.01204 s - 0.0001 (Eq. 4)",
                            "(e² + 1.01204 s - 0.0001) / 2 (Eq. 5)"},
                           "Heat: time step",
                           "How long heat flows, from the mean e and the standard deviation s of the edge lengths of the "
                           "layer at the size for which the formulas were found."));
    list.addParam(RichFloat("timeFactor", 1, "Heat: times",
                            "Multiplies the time step. More is smoother, less is sharper and in the end noisy."));
    list.addParam(RichEnum("laplacian", 0, {"Intrinsic Delaunay", "Plain cotangents"}, "Heat: Laplacian",
                           "Intrinsic Delaunay: the same surface with better triangles. Plain cotangents: the triangles "
                           "as they are; on obtuse ones tens of percent off."));
    list.addParam(RichFloat("boundary", 0, "Heat: boundary",
                            "From 0, no heat flows over the boundary (Neumann), to 1, it is kept cold (Dirichlet)."));
}

taut::HeatOptions heat_options(const RichParameterList &parameters) {
    using taut::TimeStep;
    const TimeStep formulas[] = {TimeStep::mean_edge(), TimeStep::sigma(), TimeStep::mean_sigma(),
                                 TimeStep::median_fit(), TimeStep::median_mean()};
    const taut_laplacian laplacians[] = {TAUT_LAPLACIAN_INTRINSIC, TAUT_LAPLACIAN_PLAIN};
    const auto formula = static_cast<std::size_t>(parameters.getEnum("timeStep"));
    const auto laplacian = static_cast<std::size_t>(parameters.getEnum("laplacian"));
    if (formula >= std::size(formulas)) throw std::runtime_error("Heat: time step: there is no such choice");
    if (laplacian >= std::size(laplacians)) throw std::runtime_error("Heat: Laplacian: there is no such choice");
    taut::HeatOptions options(formulas[formula].times(parameters.getFloat("timeFactor")));
    options.laplacian = laplacians[laplacian];
    options.boundary = parameters.getFloat("boundary");
    return options;
}

/// Computes the field from `from` by the method asked for, and hands it on.
template <class Use>
void with_field(const Run &run, const taut::Mesh &mesh, const taut::Sources &from, const Use &use) {
    switch (run.parameters.getEnum("method")) {
    case EXACT: {
        const auto watch = control(run, "Exact distances");
        return use(taut::ExactSolver(mesh).field(from, {}, &watch));
    }
    case HEAT: {
        const auto watch_set_up = control(run, "Heat method: set-up");
        const taut::HeatSolver solver(mesh, heat_options(run.parameters), &watch_set_up);
        const auto watch = control(run, "Heat method: distances");
        const taut::HeatField field = solver.field(from, &watch);
        if (field.nonpositive_heat() != 0)
            run.log(text("Warning: heat is not positive at %llu vertices, where distances are doubtful",
                         static_cast<unsigned long long>(field.nonpositive_heat())));
        return use(field);
    }
    }
    throw std::runtime_error("Method: there is no such choice");
}

// -------------------------------------------------------------------------------------------------- Quality and colour

const vcg::Color4b grey(160, 160, 160, 255);

/// The range of the qualities, but for those that are inf, and how many these are.
struct Range {
    Scalarm least = 0, greatest = 0;
    std::size_t unreached = 0;
};

Range range_of_quality(const CMeshO &m) {
    Range range;
    bool is_first = true;
    for (const CVertexO &vertex : m.vert) {
        if (vertex.IsD()) continue;
        const Scalarm q = vertex.cQ();
        if (std::isinf(q)) {
            range.unreached++;
            continue;
        }
        range.least = is_first ? q : std::min(range.least, q);
        range.greatest = is_first ? q : std::max(range.greatest, q);
        is_first = false;
    }
    return range;
}

/// MeshLab's ramp over the range, grey where the quality is inf.
void colour_by_quality(CMeshO &m, const Range &range) {
    for (CVertexO &vertex : m.vert) {
        if (std::isinf(vertex.cQ())) vertex.C() = grey;
        else vertex.C().SetColorRamp(range.least, range.greatest, vertex.cQ());
    }
}

void add_distance(const MeshDocument &document, RichParameterList &list) {
    add_sources(document, list, SELECTED_VERTICES);
    add_method(list);
    list.addParam(RichBool("colour", true, "Colour",
                           "Colours the vertices by their distance, from red to blue; what no source reaches is grey."));
    list.addParam(RichFloat("unreached", -1, "Quality if unreached",
                            "The quality of what no source reaches. Beware of inf: MeshLab's own histograms and colours of "
                            "the quality may end the program on it."));
}

void distance(Run &run) {
    MeshModel &layer = current_layer(run.document);
    CMeshO &m = layer.cm;
    const taut::Mesh mesh = make_mesh(m);
    with_field(run, mesh, sources(run, m, mesh), [&](const auto &field) { field.distances(quality(m)); });

    layer.updateDataMask(MeshModel::MM_VERTQUALITY);
    const Range range = range_of_quality(m);
    if (run.parameters.getBool("colour")) {
        layer.updateDataMask(MeshModel::MM_VERTCOLOR);
        colour_by_quality(m, range);
    }
    const Scalarm unreached = run.parameters.getFloat("unreached");
    for (CVertexO &vertex : m.vert)
        if (std::isinf(vertex.cQ())) vertex.Q() = unreached;
    run.log(text("The farthest vertex is at %.9g", static_cast<double>(range.greatest)));
    if (range.unreached != 0)
        run.log(text("No source reaches %zu vertices: their quality is %g", range.unreached,
                     static_cast<double>(unreached)));
    run.results["farthest"] = range.greatest;
    run.results["unreached"] = static_cast<double>(range.unreached);
}

void add_cells(const MeshDocument &document, RichParameterList &list) {
    add_sources(document, list, SELECTED_VERTICES);
    add_method(list);
}

void cells(Run &run) {
    MeshModel &layer = current_layer(run.document);
    CMeshO &m = layer.cm;
    const taut::Mesh mesh = make_mesh(m);
    const taut::Sources seeds = sources(run, m, mesh);
    std::vector<std::uint32_t> nearest;
    with_field(run, mesh, seeds, [&](const auto &field) { nearest = field.nearest_sources(); });

    layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
    for (std::size_t i = 0; i < m.vert.size(); i++) {
        const bool is_reached = nearest[i] != taut::none;
        m.vert[i].Q() = is_reached ? static_cast<Scalarm>(nearest[i]) : -1;
        m.vert[i].C() = is_reached ? vcg::Color4b::Scatter(static_cast<int>(seeds.count()), static_cast<int>(nearest[i]))
                                   : grey;
    }
    run.log(text("%zu seeds", seeds.count()));
    run.results["seeds"] = static_cast<double>(seeds.count());
}

// ------------------------------------------------------------------------------------------------------ Lines as layers

/// Adds a layer of edges; the vertices of curve i get the quality qualities[levels[i]].
void add_layer(Run &run, const MeshModel &surface, const taut::Curves &curves, const char *label,
               const std::vector<double> &qualities) {
    const auto offsets = curves.offsets(), closed = curves.closed(), levels = curves.levels();
    // The current layer stays the surface, so that filters can follow each other.
    MeshModel &layer = *run.document.addNewMesh("", label, false);
    CMeshO &m = layer.cm;
    m.Tr = surface.cm.Tr;
    if (curves.point_count() == 0) return;
    vcg::tri::Allocator<CMeshO>::AddVertices(m, curves.point_count());
    curves.positions(field_of(m.vert.size(), m.vert[0].P().V()));

    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t curve = 0; curve < curves.count(); curve++) {
        const std::uint32_t begin = offsets[curve], end = offsets[curve + 1];
        for (std::uint32_t i = begin; i < end; i++) {
            m.vert[i].Q() = static_cast<Scalarm>(qualities[levels[curve]]);
            if (i + 1 < end) edges.push_back({i, i + 1});
        }
        if (closed[curve]) edges.push_back({end - 1, begin});
    }
    auto edge = vcg::tri::Allocator<CMeshO>::AddEdges(m, edges.size());
    for (const auto &[from, to] : edges) {
        edge->V(0) = &m.vert[from];
        edge->V(1) = &m.vert[to];
        ++edge;
    }
    layer.updateDataMask(MeshModel::MM_VERTQUALITY);
    vcg::tri::UpdateBounding<CMeshO>::Box(m);
}

void add_isolines(const MeshDocument &, RichParameterList &list) {
    list.addParam(RichInt("count", 20, "Lines",
                          "How many values have lines, spread evenly between the least and the greatest quality."));
    list.addParam(RichFloat("spacing", 0, "Spacing",
                            "If not 0, lines are at the multiples of this instead, in the unit of the quality."));
    list.addParam(RichBool("skipNegative", true, "Not where negative",
                           "A quality below 0 has no lines: a distance is negative only where no source reaches."));
}

/// The quality of each vertex, or NaN where there shall be no lines.
std::vector<Scalarm> values_of_lines(const Run &run, const CMeshO &m) {
    const bool skips_negative = run.parameters.getBool("skipNegative");
    std::vector<Scalarm> values;
    values.reserve(m.vert.size());
    for (const CVertexO &vertex : m.vert) {
        const bool is_skipped = skips_negative && vertex.cQ() < 0;
        values.push_back(is_skipped ? std::numeric_limits<Scalarm>::quiet_NaN() : vertex.cQ());
    }
    return values;
}

void isolines(Run &run) {
    const MeshModel &surface = current_layer(run.document);
    const CMeshO &m = surface.cm;
    const taut::Mesh mesh = make_mesh(m);
    const int count = run.parameters.getInt("count");
    const double spacing = run.parameters.getFloat("spacing");
    if (count < 0) throw std::runtime_error("Lines: the number is negative");
    const std::vector<Scalarm> values = values_of_lines(run, m);
    const auto levels = spacing != 0 ? taut::spaced_levels(mesh, values, spacing)
                                     : taut::even_levels(mesh, values, static_cast<std::size_t>(count));
    if (levels.empty()) throw std::runtime_error("the quality is constant, or between two lines: there is none to draw");
    const taut::Curves curves = taut::isolines(mesh, values, levels);

    add_layer(run, surface, curves, "Isolines", levels);
    run.log(text("%zu lines at %zu values from %.9g to %.9g", curves.count(), levels.size(), levels.front(),
                 levels.back()));
    run.results["lines"] = static_cast<double>(curves.count());
}

void add_path(const MeshDocument &document, RichParameterList &list) {
    add_sources(document, list, POINT);
    add_point(document, list, "targetPoint", "Target point",
              "Where the path leads: the place of the surface that is nearest to it counts.");
}

void path(Run &run) {
    const MeshModel &surface = current_layer(run.document);
    const CMeshO &m = surface.cm;
    const taut::Mesh mesh = make_mesh(m);
    const taut::Sources from = sources(run, m, mesh);
    const taut::ClosestPoints end = nearest_place(run, m, mesh, "targetPoint");
    taut::ExactOptions options;
    options.targets = taut::Targets().with_points(end.faces, end.barycentrics);
    options.keep_windows = true;
    const auto watch = control(run, "Shortest path");
    const taut::ExactField field = taut::ExactSolver(mesh).field(from, options, &watch);
    const double length = field.distances(options.targets)[0];
    if (std::isinf(length)) throw std::runtime_error("no way leads from one to the other: they are on separate parts");
    const taut::Curves curves = field.paths(options.targets);

    add_layer(run, surface, curves, "Shortest path", {0});
    run.log(text("The shortest path is %.9g long", length));
    run.results["length"] = length;
}

} // namespace

const std::vector<Filter> &filters() {
    const int colouring = FilterInterface::Quality | FilterInterface::VertexColoring;
    const int lines = FilterInterface::Measure | FilterInterface::Layer;
    static const std::vector<Filter> all{
        {"Geodesic distance (Taut)", "taut_distance",
         "Stores in the quality of each vertex its <b>geodesic distance</b>, that is the length of the shortest way over the "
         "surface, from the selected vertices, the centres of the selected faces, or a point. Any triangles will do: holes, "
         "several components, edges of many faces.<br>"
         "What no source reaches gets the quality -1, unless you ask for another.<br>"
         "See: <br/><i>J. Mitchell, D. Mount, C. Papadimitriou</i><br/><b>\"The Discrete Geodesic Problem\"</b><br/>"
         "SIAM Journal on Computing, 1987<br/>"
         "<i>K. Crane, C. Weischedel, M. Wardetzky</i><br/><b>\"Geodesics in Heat\"</b><br/>ACM Transactions on Graphics, "
         "2013",
         colouring, MeshModel::MM_FACENUMBER, MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR, add_distance, distance},
        {"Geodesic isolines (Taut)", "taut_isolines",
         "Draws the lines along which the <b>quality</b> of the vertices takes given values, as a new layer of edges: "
         "isolines of distances, or of any other quality. Their vertices have the value as their quality.",
         lines, MeshModel::MM_FACENUMBER | MeshModel::MM_VERTQUALITY, MeshModel::MM_NONE, add_isolines, isolines},
        {"Geodesic shortest path (Taut)", "taut_shortest_path",
         "Draws the <b>shortest path</b> over the surface to a point from another point, or from the nearest of the selected "
         "vertices or centres of selected faces, as a new layer of edges, and tells its length. The path is exact.<br>"
         "See: <br/><i>J. Mitchell, D. Mount, C. Papadimitriou</i><br/><b>\"The Discrete Geodesic Problem\"</b><br/>"
         "SIAM Journal on Computing, 1987",
         lines, MeshModel::MM_FACENUMBER, MeshModel::MM_NONE, add_path, path},
        {"Geodesic Voronoi cells (Taut)", "taut_voronoi_cells",
         "Colours each vertex by the nearest of the selected vertices or centres of selected faces, along the surface, and "
         "stores in its quality which one that is: seeds count from 0 in the order of the vertices or faces. What no seed "
         "reaches is grey and gets the quality -1.",
         colouring, MeshModel::MM_FACENUMBER, MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR, add_cells, cells},
    };
    return all;
}

} // namespace taut_meshlab
