// SPDX-License-Identifier: GPL-3.0-or-later
// What the laws of a fabric leave free, or lock, for the user.
#pragma once

#include "core/model/case.hpp"

namespace plyform {

/// A sentence each. Of a weave with a law of shear, and of a foil, none.
std::vector<std::string> describe_freedoms(const Fabric& fabric);

/// The sentences of the fabrics of a case's plies, each behind the fabric's name.
std::vector<std::string> describe_freedoms(const Case& data);

} // namespace plyform
