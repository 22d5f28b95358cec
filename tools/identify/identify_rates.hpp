// SPDX-License-Identifier: GPL-3.0-or-later
// plyform identify of what depends on rates: shear at several speeds, relaxation, pull-out.
#pragma once

#include "tools/identify/identify.hpp"
#include "tools/identify/identify_parts.hpp"

namespace plyform {

/// Whether curves of a shear test have speeds.
bool is_rated(const IdentifyArguments& arguments);
/// Checks options of these tests, one number a curve among them.
void check_rated(const IdentifyArguments& arguments, Diagnostics& diagnostics);

/// Reports errors and returns nothing where the fit does.
std::optional<Identified> identify_rated_curves(const IdentifyArguments& arguments,
                                                const FabricReading& base, const ShearTest& test,
                                                const std::vector<Curve>& curves,
                                                const FitOptions& options,
                                                Diagnostics& diagnostics);
std::optional<Identified> identify_relaxation_curve(const IdentifyArguments& arguments,
                                                    const FabricReading& base, const Curve& curve,
                                                    Diagnostics& diagnostics);
/// Time (s) and load (N).
CurveColumns relaxation_columns();

/// Of a test that is of no fabric: its output is the [friction.NAME] of a case.
Identification identify_pull_out_curves(const IdentifyArguments& arguments);

} // namespace plyform
