// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// Our distances beside those of MeshLab's own geodesic filter, in one run on one mesh: mean and largest errors in percent of
// the largest distance, against the library's in double, and the milliseconds of processor time from call to return.
//
//     peer OUR_PLUGIN THEIR_PLUGIN MESH
#include "host.hpp"

#include <QApplication>
#include <cmath>
#include <cstdio>
#include <ctime>

namespace {

struct Result {
    double mean_error, largest_error; // in percent of the largest distance
};

double milliseconds() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Result measure(const char *title, MeshFilterInterface *plugin, const char *name, const Changes &changes, const Arrays &arrays,
               std::uint32_t source, const std::vector<double> &wanted) {
    MeshDocument document;
    CMeshO &m = add(document, arrays);
    // As MeshLab does before a filter; not timed.
    document.mm()->updateDataMask(plugin->getRequirements(plugin->AC(QString(name))));
    m.vert[source].SetS();
    const double start = milliseconds();
    if (!run(plugin, document, name, changes, nullptr)) std::exit(1);
    const double taken = milliseconds() - start;
    Result result{0, 0};
    double largest = 0;
    std::size_t reached = 0;
    for (std::size_t v = 0; v < wanted.size(); v++) {
        if (std::isinf(wanted[v])) continue;
        const double error = std::abs(m.vert[v].cQ() - wanted[v]);
        largest = std::max(largest, wanted[v]);
        result.mean_error += error;
        result.largest_error = std::max(result.largest_error, error);
        reached++;
    }
    result.mean_error *= 100 / largest / static_cast<double>(reached);
    result.largest_error *= 100 / largest;
    std::printf("%-22s mean error %8.1e %%, largest %8.1e %%, %5.0f ms\n", title, result.mean_error,
                result.largest_error, taken);
    return result;
}

} // namespace

int main(int argc, char **argv) {
    const QApplication application(argc, argv);
    if (argc != 4) return 2;
    MeshFilterInterface *ours = load(argv[1]), *theirs = load(argv[2]);
    if (!ours || !theirs) return 1;
    const Arrays arrays = read(argv[3]);
    const std::uint32_t source = arrays.triangles[0][0];
    const double start = milliseconds();
    const std::vector<double> wanted = taut::ExactSolver(arrays.mesh()).field(source).distances();
    std::printf("%s: %zu triangles\n%-60s %5.0f ms\n", argv[3], arrays.triangles.size(), "exact, the library alone",
                milliseconds() - start);

    const auto distance = "Geodesic distance (Taut)";
    const Result exact = measure("exact", ours, distance, {}, arrays, source, wanted);
    const Result heat = measure("heat", ours, distance, {{"method", choice(1)}}, arrays, source, wanted);
    const Changes everywhere{{"maxDistance", change<AbsPercValue>(1e30f)}};
    const Result peer = measure("MeshLab's own", theirs, "Colorize by geodesic distance from the selected points",
                                everywhere, arrays, source, wanted);
    // Exact but for the rounding to floats; the peer is a witness that the distances are of the right mesh and source.
    const bool is_fine = exact.largest_error < 1e-5 && heat.mean_error < 5 && peer.mean_error < 5 &&
                         exact.mean_error < peer.mean_error;
    return is_fine ? 0 : 1;
}
