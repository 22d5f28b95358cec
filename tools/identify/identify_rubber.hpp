// SPDX-License-Identifier: GPL-3.0-or-later
// plyform identify uniaxial and equibiaxial: laws of sheets of rubber.
#pragma once

#include "tools/identify/identify_parts.hpp"

namespace plyform {

/// uniaxial, equibiaxial
bool is_rubber_test(const std::string& test);
/// Reads the sheet of rubber whose law may be missing; its errors are added to `diagnostics`.
FabricReading rubber_of(const std::string& file, Diagnostics& diagnostics);
std::optional<Identified>
identify_rubber_curves(const IdentifyArguments& arguments, const Fabric& fabric,
                       const std::vector<Curve>& curves, const std::vector<Curve>& others,
                       const FitOptions& options, Diagnostics& diagnostics);

} // namespace plyform
