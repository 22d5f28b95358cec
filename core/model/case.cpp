// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/model/case.hpp"

namespace plyform {

std::vector<Push> pushes(const Case& data) {
  std::vector<Push> found;
  const double time = (1.0 + data.solver.dwell) * data.solver.duration;
  for (std::size_t p = 0; p < data.plies.size() && !data.gravity.isZero(0.0); ++p)
    found.push_back({p, 0.5 * time * time * data.gravity, "gravity", true});
  return found;
}

} // namespace plyform
