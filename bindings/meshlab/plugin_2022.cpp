// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
#include "plugin_2022.hpp"

using taut_meshlab::Filter;
using taut_meshlab::filters;

TautPlugin::TautPlugin() {
    for (int id = 0; id < static_cast<int>(filters().size()); id++) {
        typeList.push_back(id);
        actionList.push_back(new QAction(filterName(id), this));
    }
}

const Filter &TautPlugin::filter(ActionIDType id) const { return filters().at(static_cast<std::size_t>(id)); }

QString TautPlugin::pluginName() const { return "FilterTaut"; }
QString TautPlugin::vendor() const { return "Taut"; }
QString TautPlugin::filterName(ActionIDType id) const { return filter(id).name; }
QString TautPlugin::pythonFilterName(ActionIDType id) const { return filter(id).python_name; }
QString TautPlugin::filterInfo(ActionIDType id) const { return filter(id).info; }
TautPlugin::FilterClass TautPlugin::getClass(const QAction *action) const {
    return FilterClass(filter(ID(action)).categories);
}
int TautPlugin::getPreConditions(const QAction *action) const { return filter(ID(action)).preconditions; }
int TautPlugin::postCondition(const QAction *action) const { return filter(ID(action)).changes; }

RichParameterList TautPlugin::initParameterList(const QAction *action, const MeshDocument &document) {
    RichParameterList parameters;
    filter(ID(action)).add_parameters(document, parameters);
    return parameters;
}

std::map<std::string, QVariant> TautPlugin::applyFilter(const QAction *action, const RichParameterList &parameters,
                                                        MeshDocument &document, unsigned int &,
                                                        vcg::CallBackPos *callback) {
    taut_meshlab::Run run{document, parameters, callback, [this](const std::string &line) { log(line); }, {}};
    try {
        filter(ID(action)).apply(run);
    } catch (const std::exception &error) {
        throw MLException(error.what());
    }
    std::map<std::string, QVariant> results;
    for (const auto &[name, number] : run.results) results.emplace(name, number);
    return results;
}
