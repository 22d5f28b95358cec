// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/input/case_sketch.hpp"

#include <algorithm>

namespace plyform {

std::vector<std::string> CaseSketch::mistaken_keys(const std::string& part) const {
  std::vector<std::string> keys;
  for (std::size_t end = 0; end < part.size() && keys.empty();) { // what is above it too
    end = std::min(part.find('.', end + 1), part.size());
    if (mistaken.contains(part.substr(0, end))) keys.emplace_back();
  }
  const std::string inside = part + ".";
  for (auto it = mistaken.lower_bound(inside); it != mistaken.end() && it->starts_with(inside);
       ++it) {
    const std::string rest = it->substr(inside.size());
    std::string key = rest.substr(0, rest.find('.'));
    if (keys.empty() || keys.back() != key) keys.push_back(std::move(key));
  }
  return keys;
}

} // namespace plyform
