// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/draws.hpp"

#include "core/model/boundary.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Of what a boundary moves; of a frame the diagonal along which it is pulled.
Vec3 direction_of(const Boundary& boundary) {
  const auto direction = [](const auto& kind) -> Vec3 {
    if constexpr (requires { kind.direction; }) return kind.direction;
    if constexpr (requires { kind.hinges; }) {
      const Vec2 diagonal = (kind.hinges[2] - kind.hinges[0]).normalized();
      return {diagonal.x(), diagonal.y(), 0.0};
    }
    return Vec3::Zero();
  };
  return std::visit(direction, boundary.kind);
}

} // namespace

std::vector<Vec3> draws_on(const Case& data, std::size_t tool) {
  const bool driven = std::any_of(data.tools.begin(), data.tools.end(),
                                  [](const Tool& t) { return t.motion == Motion::driven; });
  const auto motion = [&](const Tool& t) {
    if (t.motion == Motion::driven) return Vec3(t.direction);
    return t.motion == Motion::force && !driven ? Vec3(t.direction) : Vec3(Vec3::Zero());
  };
  std::vector<Vec3> ways;
  const Vec3 own = motion(data.tools[tool]);
  for (std::size_t t = 0; t < data.tools.size(); ++t)
    if (t != tool) ways.push_back(motion(data.tools[t]) - own);
  ways.push_back(data.gravity);
  for (const Boundary& boundary : data.boundaries) {
    if (stroke_of(boundary) != 0.0 || force_of(boundary) != 0.0)
      ways.push_back(direction_of(boundary) - own);
    if (place_of(boundary)) ways.push_back(-own); // held while the tool comes
  }
  std::erase_if(ways, [](const Vec3& way) { return way.norm() < 1e-9; });
  for (Vec3& way : ways)
    way.normalize();
  return ways;
}

bool draws_over(const std::vector<Vec3>& draws, const Vec3& normal) {
  constexpr double against = 0.1; // cosine from which a place faces a direction
  return std::any_of(draws.begin(), draws.end(),
                     [&](const Vec3& way) { return way.dot(normal) < -against; });
}

} // namespace plyform
