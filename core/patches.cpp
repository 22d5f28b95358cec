// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/patches.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace plyform {
namespace {

/// A side shared by two triangles.
struct SharedSide {
  double length2;
  std::int32_t a, b; ///< triangles, a < b
};

std::vector<SharedSide> shared_sides(const BlankMesh& mesh) {
  struct Side {
    std::int32_t low, high, triangle;
  };
  std::vector<Side> sides;
  for (std::size_t e = 0; e < mesh.triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t i = mesh.triangles[e][k], j = mesh.triangles[e][(k + 1) % 3];
      sides.push_back({std::min(i, j), std::max(i, j), static_cast<std::int32_t>(e)});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  std::vector<SharedSide> shared;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    if (sides[i].low != sides[i - 1].low || sides[i].high != sides[i - 1].high) continue;
    const Vec2 d = mesh.x[static_cast<std::size_t>(sides[i].high)] -
                   mesh.x[static_cast<std::size_t>(sides[i].low)];
    shared.push_back({d.squaredNorm(), sides[i - 1].triangle, sides[i].triangle});
  }
  // Longest first. Lengths that agree to rounding count as equal, or a uniform mesh would be paired
  // at random.
  std::stable_sort(shared.begin(), shared.end(), [](const SharedSide& s, const SharedSide& t) {
    return static_cast<float>(s.length2) > static_cast<float>(t.length2);
  });
  return shared;
}

} // namespace

Patches single_patches(std::size_t triangles) {
  Patches p;
  p.triangles.resize(triangles);
  std::iota(p.triangles.begin(), p.triangles.end(), 0);
  p.begin.resize(triangles + 1);
  std::iota(p.begin.begin(), p.begin.end(), 0);
  return p;
}

Patches pair_patches(const BlankMesh& mesh) {
  const std::vector<SharedSide> sides = shared_sides(mesh);
  std::vector<std::vector<std::int32_t>> patches;
  std::vector<std::int32_t> patch_of(mesh.triangles.size(), -1);
  const auto patch = [&](std::int32_t e) -> std::int32_t& {
    return patch_of[static_cast<std::size_t>(e)];
  };
  for (const SharedSide& s : sides)
    if (patch(s.a) < 0 && patch(s.b) < 0) {
      patch(s.a) = patch(s.b) = static_cast<std::int32_t>(patches.size());
      patches.push_back({s.a, s.b});
    }
  for (const SharedSide& s : sides) {
    if ((patch(s.a) < 0) == (patch(s.b) < 0)) continue;
    const std::int32_t alone = patch(s.a) < 0 ? s.a : s.b, host = patch(s.a) < 0 ? s.b : s.a;
    auto& members = patches[static_cast<std::size_t>(patch(host))];
    if (members.size() >= most_in_patch) continue;
    members.push_back(alone);
    patch(alone) = patch(host);
  }
  for (std::size_t e = 0; e < patch_of.size(); ++e)
    if (patch_of[e] < 0) patches.push_back({static_cast<std::int32_t>(e)});
  for (auto& members : patches)
    std::sort(members.begin(), members.end());
  std::sort(patches.begin(), patches.end());
  Patches result;
  result.begin.push_back(0);
  for (const auto& members : patches) {
    result.triangles.insert(result.triangles.end(), members.begin(), members.end());
    result.begin.push_back(static_cast<std::int32_t>(result.triangles.size()));
  }
  return result;
}

} // namespace plyform
