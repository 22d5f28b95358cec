// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/keys/motion_keys.hpp"

#include "base/format.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {

Vec3 read_direction(const TableView& tool, const std::string& key, Diagnostics& diagnostics) {
  const Vec3 v = vector3(tool, key);
  const double length = v.norm();
  if (length > 0.0 && std::isfinite(length)) return v / length;
  value_error(tool, key, length > 0.0 ? "is too long" : "must not be the zero vector",
              "give a vector that points the way", diagnostics);
  return Vec3::UnitZ();
}

std::vector<Stage> read_programme(const TableView& section, const std::string& key, double& largest,
                                  Diagnostics& diagnostics) {
  std::vector<Stage> stages;
  for (const Vec2& row : pairs(section, key)) {
    if (!stages.empty() && row.x() <= stages.back().share) {
      value_error(section, key,
                  fmt::format("has stage {} at share {:g} after one at {:g}", stages.size() + 1,
                              row.x(), stages.back().share),
                  "give the stages in order of time", diagnostics);
      break;
    }
    stages.push_back({row.x(), row.y()});
    largest = std::max(largest, row.y());
  }
  return stages;
}

} // namespace plyform
