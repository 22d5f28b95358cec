// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/results/broken_stitches.hpp"

#include "core/results/statistics.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace plyform {
namespace {

/// Patches of triangles as a forest of parents: union by smaller number.
class Patches {
public:
  explicit Patches(std::size_t triangles) : parent_(triangles) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t t) {
    while (parent_[t] != t)
      t = parent_[t] = parent_[parent_[t]];
    return t;
  }
  void join(std::size_t a, std::size_t b) {
    const auto [less, more] = std::minmax({of(a), of(b)}); // by value
    parent_[more] = less;
  }

private:
  std::vector<std::size_t> parent_;
};

/// Patches of the broken triangles that share sides.
Patches patches_of(const PlyFrame& ply, const std::vector<double>& broken) {
  Patches patches(ply.triangles.size());
  std::map<std::pair<int, int>, std::size_t> behind; // side: a broken triangle that has it
  for (std::size_t t = 0; t < ply.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3 && broken[t] > 0.0; ++k) {
      const std::pair<int, int> side =
          std::minmax({ply.triangles[t][k], ply.triangles[t][(k + 1) % 3]});
      const auto [at_side, first] = behind.emplace(side, t);
      if (!first) patches.join(t, at_side->second);
    }
  return patches;
}

/// Finds the largest patch.
void add_patch(const PlyFrame& ply, const std::vector<double>& broken,
               const std::vector<double>& areas, BrokenStitches& found) {
  Patches patches = patches_of(ply, broken);
  std::vector<double> area(areas.size(), 0.0);
  std::vector<Vec3> moment(areas.size(), Vec3::Zero());
  for (std::size_t t = 0; t < areas.size(); ++t) {
    if (!(broken[t] > 0.0)) continue;
    const std::size_t patch = patches.of(t);
    area[patch] += areas[t];
    for (const int n : ply.triangles[t])
      moment[patch] += areas[t] / 3.0 * ply.x[at(n)];
  }
  const auto largest = std::max_element(area.begin(), area.end());
  if (largest == area.end() || !(*largest > 0.0)) return;
  found.patch_area = *largest;
  found.patch_at = moment[static_cast<std::size_t>(largest - area.begin())] / *largest;
}

} // namespace

std::vector<BrokenStitches> broken_stitches(const PlyFrame& ply) {
  std::vector<BrokenStitches> all;
  const std::vector<double> areas =
      ply.stitches.empty() ? std::vector<double>{} : areas_before(ply);
  for (const StitchFrame& stitch : ply.stitches) {
    BrokenStitches& found = all.emplace_back();
    found.name = stitch.name;
    found.share = area_share_above(stitch.broken, 0.5, areas);
    for (std::size_t t = 0; t < areas.size(); ++t)
      found.area += stitch.broken[t] > 0.0 ? areas[t] : 0.0;
    add_patch(ply, stitch.broken, areas, found);
  }
  return all;
}

double broken_share(const PlyFrame& ply) {
  if (ply.stitches.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> areas = areas_before(ply);
  double most = 0.0;
  for (const StitchFrame& stitch : ply.stitches)
    most = std::max(most, area_share_above(stitch.broken, 0.5, areas));
  return most;
}

} // namespace plyform
