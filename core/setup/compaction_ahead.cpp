// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/compaction_ahead.hpp"

#include "base/text.hpp"
#include "core/run/moulds.hpp"
#include "core/run/output_state.hpp"

#include <set>

namespace plyform {
namespace {

/// Names of plies, and of their fabrics, once each.
struct Named {
  std::vector<std::string> plies;
  std::set<std::string> fabrics;

  void add(const PlyBody& ply) {
    plies.push_back(ply.name);
    fabrics.insert(ply.membrane.fabric.name);
  }
  std::string all_fabrics() const {
    return joined(std::vector<std::string>(fabrics.begin(), fabrics.end()));
  }
};

} // namespace

void describe_compaction(const Scene& s, ThreadPool& pool, Lines& lines) {
  Named soft, hard;
  for (const PlyBody& ply : s.plies)
    (ply.membrane.fabric.compaction ? soft : hard).add(ply);
  if (soft.plies.empty() || hard.plies.empty()) return;
  if (!moulds_of(s, tool_surfaces(s, pool)).any) return;
  say(lines,
      "    warning: the mould closes on plies {}, whose fabric has a compaction, and on {}, whose "
      "fabric has none: the latter stay as thick as they are, and all that the mould takes goes to "
      "the others, whose fibre volume comes out too high, as do forces; give {} a compaction, or "
      "the mould the room for it",
      joined(soft.plies), joined(hard.plies), hard.all_fabrics());
}

} // namespace plyform
