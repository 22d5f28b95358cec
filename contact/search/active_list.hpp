// SPDX-License-Identifier: GPL-3.0-or-later
// The active ones among the pairs that a contact search has listed: those that may touch. A pair is
// inactive, and costs nothing, until the bodies have moved far enough to close its gap.
//
// The path length of a body is the sum over the steps of the largest displacement of any of its
// nodes in a step; that of a pair of bodies the sum of both. A pair with a gap g when the path
// length was s cannot touch before it is s + g, wherever the bodies went meanwhile.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace plyform {

struct ActiveList {
  std::vector<double> free_until;   ///< mm, per pair: path length before which it cannot touch
  std::vector<std::int32_t> active; ///< pairs that may touch
  double until = -1.0;              ///< mm, path length at which the list is updated next
  double last_path = 0.0;           ///< mm, path length at the step before
  double ahead = 0.0;               ///< mm, path length of two steps like the last one
};

/// All that lives from step to step, for checkpoints (base/archive.hpp); so below.
template <class F>
void each_member(ActiveList& list, F&& f) {
  auto& [free_until, active, until, last_path, ahead] = list;
  f("free_until", free_until);
  f("active", active);
  f("until", until);
  f("last_path", last_path);
  f("ahead", ahead);
}

/// Removes all pairs, before a search lists them anew.
inline void clear(ActiveList& list) {
  list.free_until.clear();
  list.active.clear();
  list.until = -1.0;
}

/// For bodies whose path length is all that is known of their gaps.
struct NoRoom {
  double operator()(std::int32_t) const { return -std::numeric_limits<double>::infinity(); }
};

/// Activates the pairs that may touch at this path length (mm) and calls deactivate(i) for each
/// pair that was active and no longer is. room(i): a lower bound of the pair's gap, mm, where the
/// path length no longer tells. To be called at every step; returns whether it updated the list. An
/// update serves for `kept` of path length, so that most steps need none, and while any pair is
/// active for no more than `longest`, so that pairs that have opened become inactive. thickness:
/// mm, of what touches, which both follow.
template <class Room, class Deactivate>
bool update(ActiveList& list, double path_length, double thickness, const Room& room,
            const Deactivate& deactivate) {
  constexpr double tried = 0.6; // mm, the thickness for which the two were found by trying
  const double kept = 0.05 * (thickness / tried), longest = 0.2 * (thickness / tried); // mm
  // A pair is activated two steps before it may touch, so that its closing speed is known by then.
  list.ahead = 2.0 * std::max(path_length - list.last_path, 0.0);
  list.last_path = path_length;
  if (path_length < list.until) return false;
  const double now = path_length + kept + list.ahead;
  if constexpr (!std::is_same_v<Room, NoRoom>)
    for (std::size_t i = 0; i < list.free_until.size(); ++i)
      if (double& free = list.free_until[i]; !(free > now))
        free = std::max(free, path_length + room(static_cast<std::int32_t>(i)));
  for (const std::int32_t i : list.active)
    if (list.free_until[i] > now) deactivate(i);
  list.active.clear();
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < list.free_until.size(); ++i)
    if (list.free_until[i] > now)
      next = std::min(next, list.free_until[i]);
    else
      list.active.push_back(static_cast<std::int32_t>(i));
  next = std::max(next - list.ahead, path_length);
  list.until = list.active.empty() ? next : std::min(next, path_length + longest);
  return true;
}

} // namespace plyform
