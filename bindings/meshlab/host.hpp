// Copyright (C) 2026 the authors of Taut. SPDX-License-Identifier: GPL-3.0-or-later (LICENSE says more)
//
// MeshLab's interface for filters under one name: that of 2020.09, or that since 2022.02; CMake tells which.
#pragma once

#if TAUT_MESHLAB_INTERFACE == 2020
#include <common/interfaces.h>
using FilterInterface = MeshFilterInterface;
using PositionParameter = RichPoint3f;
#else
#include <common/plugins/interfaces/filter_plugin.h>
using FilterInterface = FilterPlugin;
using PositionParameter = RichPosition;
#endif
