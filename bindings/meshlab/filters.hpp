// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// The filters, for either interface of MeshLab: plugin_2020.cpp and plugin_2022.cpp show them to their host.
#pragma once

#include "host.hpp"

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace taut_meshlab {

/// One run of a filter.
struct Run {
    MeshDocument &document;
    const RichParameterList &parameters;
    /// Is told the progress; false from it cancels.
    vcg::CallBackPos *callback;
    std::function<void(const std::string &)> log;
    /// Numbers for scripts.
    std::map<std::string, double> results;
};

/// What a host wants to know of a filter.
struct Filter {
    QString name;
    /// In pymeshlab.
    QString python_name;
    QString info;
    /// FilterInterface::FilterClass, or-ed.
    int categories;
    /// MeshModel::MeshElement, or-ed: what the layer must have, and what of it is changed.
    int preconditions;
    int changes;
    void (*add_parameters)(const MeshDocument &, RichParameterList &);
    /// Throws what went wrong; then nothing is changed.
    void (*apply)(Run &);
};

const std::vector<Filter> &filters();

} // namespace taut_meshlab
