// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/measured_limits.hpp"

#include "base/format.hpp"

#include <algorithm>

namespace plyform {
namespace {

/// Rubber beyond what its law was measured to.
std::vector<std::string> doubts_of_stretch(const Frame& last, const std::vector<PlyReport>& plies) {
  std::vector<std::string> found;
  for (std::size_t p = 0; p < plies.size(); ++p)
    if (plies[p].beyond_stretch_share.value_or(0.0) > doubtful_stretched_share)
      found.push_back(fmt::format(
          "do not trust {}: it is stretched to {:.3g}, beyond the {:.3g} up to which its law was "
          "measured (stretch_limit), on {:.2g} % of its area; test the rubber further",
          last.plies[p].name, *plies[p].max_stretch, *plies[p].stretch_limit,
          100.0 * *plies[p].beyond_stretch_share));
  return found;
}

/// Warnings about shear faster than its law was measured.
std::vector<std::string> doubts_of_rates(const Frame& last, const std::vector<PlyReport>& plies) {
  std::vector<std::string> found;
  for (std::size_t p = 0; p < plies.size(); ++p)
    if (plies[p].beyond_rate_share.value_or(0.0) > doubtful_rated_share)
      found.push_back(fmt::format(
          "do not trust {}: it was sheared at up to {:.2g} 1/s, beyond the {:.2g} 1/s up to which "
          "its law was measured (measured_rates, or the last rate of its table), on {:.2g} % of "
          "its area; test it faster, or form slower",
          last.plies[p].name, *plies[p].max_shear_rate, *plies[p].measured_shear_rate,
          100.0 * *plies[p].beyond_rate_share));
  return found;
}

} // namespace

std::optional<double> highest_measured_rate(const Fabric& fabric) {
  std::optional<double> highest;
  for (const Crossing& crossing : fabric.crossings) {
    if (!crossing.viscous) continue;
    if (const auto known = crossing.viscous->known_rates())
      highest = std::min(highest.value_or((*known)[1]), (*known)[1]);
  }
  return highest;
}

std::vector<std::string> doubts_of_limits(const Frame& last, const std::vector<PlyReport>& plies) {
  std::vector<std::string> found = doubts_of_stretch(last, plies);
  for (std::string& doubt : doubts_of_rates(last, plies))
    found.push_back(std::move(doubt));
  return found;
}

} // namespace plyform
