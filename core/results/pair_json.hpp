// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of summary.json, and what it has of pairs of bodies.
#pragma once

#include "core/results/summary.hpp"

#include <nlohmann/json.hpp>

namespace plyform {

using Json = nlohmann::ordered_json;

/// The value rounded to nine digits: more than any result is accurate to, and shorter than all
/// seventeen. Values that are not finite are returned unchanged; the library writes null for them.
double rounded(double value);

/// A fraction of the computing time, rounded to four decimals, as it differs from run to run.
double rounded_share(double value);

Json pair_object(const PairReport& pair);

} // namespace plyform
