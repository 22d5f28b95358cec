// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plyform {

/// Value and slope of a law at one point, and its integral from 0 (the stored energy).
struct LawPoint {
  double value, slope, energy;
};

} // namespace plyform
