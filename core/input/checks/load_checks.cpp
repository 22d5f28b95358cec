// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/checks/load_checks.hpp"

#include "base/format.hpp"
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

constexpr double sagitta = 0.125, widest_strip = 0.1;

struct Off {
  double distance = 0.0; ///< mm
  Vec2 at = Vec2::Zero();
};

/// The place of the border of `ply` that is furthest from that of `other`, of its corners and the
/// middles of its edges.
Off furthest_off(const FlatPly& ply, const FlatPly& other) {
  Off most;
  const auto look = [&](const Vec2& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : other.border) {
      const Vec2 side = b - a;
      const double along = std::clamp((p - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (p - a - along * side).squaredNorm());
      if (least <= most.distance * most.distance) return;
    }
    most = {std::sqrt(least), p};
  };
  for (const auto& [a, b] : ply.border)
    look(a), look(0.5 * (a + b));
  return most;
}

double longest_side(const FlatPly& ply) {
  double longest = 0.0;
  for (const auto& [a, b] : ply.border)
    longest = std::max(longest, (b - a).norm());
  return longest;
}

} // namespace

void check_loads(const Case& scene, const CaseParts& parts, std::span<const FlatPly> plies,
                 Diagnostics& diagnostics) {
  for (const Enclosure& enclosure : enclosures_of(scene)) {
    const auto lower = static_cast<std::size_t>(enclosure.lower),
               upper = static_cast<std::size_t>(enclosure.upper);
    const FlatPly &a = plies[lower], &b = plies[upper];
    const auto error = [&](const std::string& rule, const std::string& remedy) {
      diagnostics.error(parts.plies[upper].at, parts.plies[upper].item, scene.plies[upper].name,
                        fmt::format("encloses nothing with ply {}, as load.{}.between has it: {}",
                                    scene.plies[lower].name, enclosure.load->entry, rule),
                        remedy);
    };
    const Off here = furthest_off(a, b), there = furthest_off(b, a);
    const Off& most = here.distance > there.distance ? here : there;
    const double allowed = a.half + b.half + sagitta * std::max(longest_side(a), longest_side(b));
    const double width = std::min(a.bounds.sizes().minCoeff(), b.bounds.sizes().minCoeff());
    if (most.distance > allowed)
      error(fmt::format("their borders are {:.4g} mm apart at ({:.4g}, {:.4g}), and it would push "
                        "one more than the other",
                        most.distance, most.at.x(), most.at.y()),
            "give both the same outline in the same place, or each a [[load]] with ply and side");
    else if (std::abs(b.z - a.z) > widest_strip * width)
      error(fmt::format("they lie {:.4g} mm apart, and the strip between their borders is open",
                        std::abs(b.z - a.z)),
            "lay it on the stack (leave out z)");
  }
}

} // namespace plyform
