// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// The filters as MeshLab wants them since 2022.02.
#pragma once

#include "filters.hpp"

#include <QObject>

class TautPlugin : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

public:
    TautPlugin();

    QString pluginName() const override;
    QString vendor() const override;
    QString filterName(ActionIDType id) const override;
    QString pythonFilterName(ActionIDType id) const override;
    QString filterInfo(ActionIDType id) const override;
    FilterClass getClass(const QAction *action) const override;
    int getPreConditions(const QAction *action) const override;
    int postCondition(const QAction *action) const override;
    FilterArity filterArity(const QAction *) const override { return SINGLE_MESH; }
    // Every caller takes the one for documents.
    using FilterPlugin::initParameterList;
    RichParameterList initParameterList(const QAction *action, const MeshDocument &document) override;
    std::map<std::string, QVariant> applyFilter(const QAction *action, const RichParameterList &parameters,
                                                MeshDocument &document, unsigned int &post_condition,
                                                vcg::CallBackPos *callback) override;

private:
    const taut_meshlab::Filter &filter(ActionIDType id) const;
};
