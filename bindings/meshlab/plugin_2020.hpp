// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// The filters as MeshLab 2020.09 wants them.
#pragma once

#include "filters.hpp"

#include <QObject>

class TautPlugin : public QObject, public MeshFilterInterface {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

public:
    TautPlugin();

    QString pluginName() const override;
    QString filterName(FilterIDType id) const override;
    QString filterInfo(FilterIDType id) const override;
    FilterClass getClass(QAction *action) override;
    int getPreConditions(QAction *action) const override;
    int postCondition(QAction *action) const override;
    FILTER_ARITY filterArity(QAction *) const override { return SINGLE_MESH; }
    // Every caller takes the one for documents.
    using MeshFilterInterface::initParameterSet;
    void initParameterSet(QAction *action, MeshDocument &document, RichParameterList &parameters) override;
    bool applyFilter(QAction *action, MeshDocument &document, const RichParameterList &parameters,
                     vcg::CallBackPos *callback) override;

private:
    const taut_meshlab::Filter &filter(FilterIDType id) const;
};
