// SPDX-License-Identifier: GPL-3.0-or-later
// What temperatures plies, and films between bodies, may come to: known before a run.
#pragma once

#include "core/model/case.hpp"

#include <utility>

namespace plyform {

/// degC, lowest and highest that a ply may come to: as if both of its faces touched the coldest, or
/// the hottest, of all that is there all the time. Nothing: not known.
std::optional<TemperatureRange> reachable_temperatures(const Case& data, const Ply& ply);
/// The same of a body by its number in FrictionTable; of a tool those that it is given.
std::optional<TemperatureRange> reachable_temperatures(const Case& data, int body);

/// Bodies that may slide on each other by a law, by its number: those of each pair.
std::vector<std::pair<int, int>> pairs_of_law(const Case& data, int law);
/// degC, of the film between two bodies: contact/forces/friction_law.hpp.
std::optional<TemperatureRange> film_temperatures(const Case& data, std::pair<int, int> bodies);

} // namespace plyform
