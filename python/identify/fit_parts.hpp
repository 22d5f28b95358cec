// SPDX-License-Identifier: GPL-3.0-or-later
// What python/identify/bind_fit.cpp and python/identify/bind_bending.cpp share.
#pragma once

#include "core/identify/fit_quality.hpp"
#include "core/input/parts/fabric_file.hpp"
#include "python/bindings.hpp"

namespace plyform {

/// An array of `values` / unit.
py::array array_of(std::vector<double> values, double unit = 1.0);

/// rows, rms, largest and largest_at, which is over `unit`.
py::dict quality_of(const FitQuality& quality, double unit);

/// compliance, zero, toe, slip and doubtful, as the program's options.
void put_corrections(const py::dict& given, FitOptions& options);

/// What is needed of a fabric besides its densities.
struct FabricNeeds {
  bool shear_law = false, right_angle = false;
};

/// Raises plyform.CaseError for mistakes in the file and for what it misses.
Fabric fabric_for_fit(const std::filesystem::path& file, FabricNeeds needs);

void bind_bending(py::module_& m); ///< python/identify/bind_bending.cpp

} // namespace plyform
