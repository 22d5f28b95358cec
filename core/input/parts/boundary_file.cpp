// SPDX-License-Identifier: GPL-3.0-or-later
// Reads boundaries; their kinds are in core/input/keys/boundary_kinds.cpp.
#include "core/input/keys/boundary_kinds.hpp"
#include "core/input/keys/key_member.hpp"
#include "core/input/parts/case_parts.hpp"

#include <algorithm>

namespace plyform {

std::vector<Boundary> read_boundaries(const TableView& root, const std::vector<Ply>& plies,
                                      const std::vector<Tool>& tools, Diagnostics& diagnostics) {
  std::vector<Boundary> boundaries;
  for (const TableView& section : subsections(root, "boundary")) {
    Boundary b;
    read_members(section, b);
    if (given(section, "ply")) {
      const auto it = std::find_if(plies.begin(), plies.end(), [&](const Ply& ply) {
        return ply.name == text(section, "ply");
      });
      if (it != plies.end())
        b.ply = static_cast<int>(it - plies.begin());
      else if (knows_names(root, "ply"))
        value_error(section, "ply", "names no ply of this case", "leave it out to hold all plies",
                    diagnostics);
    }
    const NamedTools named{tools, knows_names(root, "tool")};
    if (given(section, "kind")) b.kind = read_boundary_kind(section, named, diagnostics);
    boundaries.push_back(b);
  }
  return boundaries;
}

} // namespace plyform
