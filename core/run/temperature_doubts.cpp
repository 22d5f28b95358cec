// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/temperature_doubts.hpp"

#include "base/format.hpp"

#include <algorithm>

namespace plyform {

std::vector<std::string> doubts_of_temperature(const Scene& s, const Frame& last) {
  std::vector<std::string> found;
  for (std::size_t p = 0; p < last.plies.size(); ++p) {
    const Fabric& fabric = s.plies[p].membrane.fabric;
    const std::vector<double>& celsius = last.plies[p].temperature;
    if (celsius.empty()) continue;
    const auto [least, most] = std::minmax_element(celsius.begin(), celsius.end());
    for (const LawOverTemperature& law : laws_over_temperature(fabric)) {
      const TemperatureRange known = law.factor.range();
      if (!law.factor.depends() || (known.holds(*least) && known.holds(*most))) continue;
      found.push_back(fmt::format(
          "do not trust how {} resists where it is colder or hotter than its {} is known for: it "
          "is at {:.4g} to {:.4g} degC, the law of fabric {} goes from {}, and stays there as at "
          "its "
          "end; measure it further",
          last.plies[p].name, law.of, *least, *most, fabric.name, known.text()));
    }
  }
  return found;
}

} // namespace plyform
