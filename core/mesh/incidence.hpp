// SPDX-License-Identifier: GPL-3.0-or-later
// Inverse of a node numbering: for each node the entries of an array of contributions that belong
// to it, so that one thread sums them in a fixed order.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plyform {

/// Entries of node n: gather[begin[n] .. begin[n + 1]), ascending.
struct Gather {
  std::vector<std::int32_t> begin, gather;
};

/// node_of: the node, in [0, nodes), that each entry contributes to.
inline Gather make_gather(std::span<const std::int32_t> node_of, std::size_t nodes) {
  Gather g;
  g.begin.assign(nodes + 1, 0);
  for (const std::int32_t n : node_of)
    ++g.begin[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 0; n < nodes; ++n)
    g.begin[n + 1] += g.begin[n];
  g.gather.resize(node_of.size());
  std::vector<std::int32_t> next(g.begin.begin(), g.begin.end() - 1);
  for (std::size_t i = 0; i < node_of.size(); ++i)
    g.gather[next[static_cast<std::size_t>(node_of[i])]++] = static_cast<std::int32_t>(i);
  return g;
}

} // namespace plyform
