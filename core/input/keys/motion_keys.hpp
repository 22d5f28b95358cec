// SPDX-License-Identifier: GPL-3.0-or-later
// Directions and programmes, as keys of tools, boundaries and loads give them.
#pragma once

#include "core/input/keys/schema_check.hpp"
#include "core/model/case.hpp"

namespace plyform {

/// A direction of the section as a unit vector; reports an error for the zero vector.
Vec3 read_direction(const TableView& section, const std::string& key, Diagnostics& diagnostics);

/// The stages of a programme of the section; reports those that are not in order of time. `largest`
/// becomes the largest value, if that is larger.
std::vector<Stage> read_programme(const TableView& section, const std::string& key, double& largest,
                                  Diagnostics& diagnostics);

} // namespace plyform
