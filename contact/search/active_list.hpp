// SPDX-License-Identifier: GPL-3.0-or-later
// Which of the pairs that a contact search has listed may touch by now. A pair rests, and costs
// nothing, until the bodies have gone far enough to close its gap.
//
// The path of a body is the sum over the steps of the furthest that any of its nodes went in one;
// that of a pair of bodies the sum of both. A pair with a gap g when the path was s cannot touch
// before it is s + g, wherever they went meanwhile.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace plyform {

struct NearList {
  std::vector<double> wake;       ///< mm, one a pair: the path before which it cannot touch
  std::vector<std::int32_t> near; ///< pairs that may touch
  double until = -1.0;            ///< mm, path at which the list is due again
  double last_path = 0.0;         ///< mm, path of the step before
  double ahead = 0.0;             ///< mm, path of two steps like the last one
};

/// Forgets all pairs: a search begins.
inline void clear(NearList& list) {
  list.wake.clear();
  list.near.clear();
  list.until = -1.0;
}

/// Lists the pairs that may touch now that the path is `path` (mm). rest(i) is
/// called for each that was listed and no longer is. The list runs ahead a little, so that it is
/// not made anew at every step, and not for long, so that those that have opened come to rest.
/// Called at every step; returns whether the list is a new one.
template <class Rest>
bool renew(NearList& list, double path, const Rest& rest) {
  constexpr double kept = 0.05, longest = 0.2; // mm
  // two steps before it may touch: how fast a pair closes is known by then
  list.ahead = 2.0 * std::max(path - list.last_path, 0.0);
  list.last_path = path;
  if (path < list.until) return false;
  const double now = path + kept + list.ahead;
  for (const std::int32_t i : list.near)
    if (list.wake[static_cast<std::size_t>(i)] > now) rest(i);
  list.near.clear();
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < list.wake.size(); ++i)
    if (list.wake[i] > now)
      next = std::min(next, list.wake[i]);
    else
      list.near.push_back(static_cast<std::int32_t>(i));
  next = std::max(next - list.ahead, path);
  list.until = list.near.empty() ? next : std::min(next, path + longest);
  return true;
}

} // namespace plyform
