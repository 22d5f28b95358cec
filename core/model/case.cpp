// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/case.hpp"

namespace plyform {

void keep_plies(Case& data, const std::vector<char>& keep) {
  std::vector<Ply> kept;
  std::vector<int> number(data.plies.size(), -1);
  for (std::size_t p = 0; p < data.plies.size(); ++p) {
    if (!keep[p]) continue;
    number[p] = static_cast<int>(kept.size());
    kept.push_back(data.plies[p]);
  }
  data.plies = std::move(kept);
  for (Boundary& b : data.boundaries)
    if (b.ply >= 0) b.ply = number[static_cast<std::size_t>(b.ply)];
}

std::vector<Push> pushes(const Case& data) {
  std::vector<Push> found;
  const double time = (1.0 + data.solver.dwell) * data.solver.duration;
  for (std::size_t p = 0; p < data.plies.size() && !data.gravity.isZero(0.0); ++p)
    found.push_back({p, 0.5 * time * time * data.gravity, "gravity", true});
  return found;
}

} // namespace plyform
