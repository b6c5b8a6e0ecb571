// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// A host in place of MeshLab 2020.09: loads plug-ins, makes layers of plain arrays, and runs filters on them.
#pragma once

#include <common/interfaces.h>
#include <taut.hpp>

#include <QPluginLoader>
#include <functional>
#include <map>

/// The filters in a plug-in, or a note on the output and nullptr.
inline MeshFilterInterface *load(const char *path) {
    QPluginLoader loader(path);
    auto *plugin = qobject_cast<MeshFilterInterface *>(loader.instance());
    if (!plugin) std::printf("%s\n", qUtf8Printable(loader.errorString()));
    return plugin;
}

/// What is set in a parameter of this name.
using Change = std::function<void(RichParameterList &, const QString &)>;
using Changes = std::map<QString, Change>;
template <class Kind, class T>
Change change(T value) {
    return [value](RichParameterList &list, const QString &name) { list.setValue(name, Kind(value)); };
}
inline Change choice(int i) { return change<EnumValue>(i); }
inline Change number(float x) { return change<FloatValue>(x); }
inline Change count(int n) { return change<IntValue>(n); }
inline Change flag(bool b) { return change<BoolValue>(b); }
inline Change point(const Point3m &p) { return change<Point3fValue>(p); }

/// Runs a filter with its defaults, but for what `changes` says.
inline bool run(MeshFilterInterface *plugin, MeshDocument &document, const char *name, const Changes &changes,
                vcg::CallBackPos *callback) {
    QAction *action = plugin->AC(QString(name));
    RichParameterList list;
    plugin->initParameterSet(action, document, list);
    for (const auto &[parameter, change] : changes) change(list, parameter);
    return plugin->applyFilter(action, document, list, callback);
}

/// Plain arrays, as the filter should see a layer.
struct Arrays {
    std::vector<std::array<float, 3>> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    taut::Mesh mesh() const { return {positions, triangles}; }
};

inline Arrays read(const char *path) {
    const taut::Mesh mesh = taut::Mesh::read(path);
    Arrays arrays;
    for (const auto &p : mesh.positions()) arrays.positions.push_back({float(p[0]), float(p[1]), float(p[2])});
    for (const auto &t : mesh.triangles())
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) arrays.triangles.push_back(t);
    return arrays;
}

inline CMeshO &add(MeshDocument &document, const Arrays &arrays) {
    CMeshO &m = document.addNewMesh("", "surface")->cm;
    vcg::tri::Allocator<CMeshO>::AddVertices(m, arrays.positions.size());
    for (std::size_t i = 0; i < m.vert.size(); i++) {
        const auto &p = arrays.positions[i];
        m.vert[i].P() = Point3m(p[0], p[1], p[2]);
        m.vert[i].Q() = -7;
        m.vert[i].C() = vcg::Color4b(1, 2, 3, 4);
    }
    vcg::tri::Allocator<CMeshO>::AddFaces(m, arrays.triangles.size());
    for (std::size_t f = 0; f < m.face.size(); f++)
        for (int i = 0; i < 3; i++) m.face[f].V(i) = &m.vert[arrays.triangles[f][i]];
    vcg::tri::UpdateBounding<CMeshO>::Box(m);
    return m;
}
