// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
#include "plugin_2020.hpp"

using taut_meshlab::Filter;
using taut_meshlab::filters;

TautPlugin::TautPlugin() {
    for (int id = 0; id < static_cast<int>(filters().size()); id++) {
        typeList << id;
        actionList << new QAction(filterName(id), this);
    }
}

const Filter &TautPlugin::filter(FilterIDType id) const { return filters().at(static_cast<std::size_t>(id)); }

QString TautPlugin::pluginName() const { return "FilterTaut"; }
QString TautPlugin::filterName(FilterIDType id) const { return filter(id).name; }
QString TautPlugin::filterInfo(FilterIDType id) const { return filter(id).info; }
TautPlugin::FilterClass TautPlugin::getClass(QAction *action) { return FilterClass(filter(ID(action)).categories); }
int TautPlugin::getPreConditions(QAction *action) const { return filter(ID(action)).preconditions; }
int TautPlugin::postCondition(QAction *action) const { return filter(ID(action)).changes; }

void TautPlugin::initParameterSet(QAction *action, MeshDocument &document, RichParameterList &parameters) {
    filter(ID(action)).add_parameters(document, parameters);
}

bool TautPlugin::applyFilter(QAction *action, MeshDocument &document, const RichParameterList &parameters,
                             vcg::CallBackPos *callback) {
    const auto log = [this](const std::string &line) { Log(line); };
    try {
        taut_meshlab::Run run{document, parameters, callback, log, {}};
        filter(ID(action)).apply(run);
        return true;
    } catch (const std::exception &error) {
        errorMessage = error.what();
        log(error.what()); // all that meshlabserver shows
        return false;
    }
}

MESHLAB_PLUGIN_NAME_EXPORTER(TautPlugin)
