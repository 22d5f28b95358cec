// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/contact_rows.hpp"

#include "core/solver/attached_motion.hpp"

namespace plyform {
namespace {

/// Row sums of the contacts between two plies, per node of each.
struct PairRows {
  std::vector<ContactRow> a, b;
};

PairRows rows_of(const Scene& s, const PlyPair& pair) {
  const PlyState &a = s.plies[pair.a], &b = s.plies[pair.b];
  PairRows rows;
  const auto begin = [&] {
    rows.a.resize(a.x.size());
    rows.b.resize(b.x.size());
  };
  for (const int i : pair.contacts) {
    const PlyContact& c = s.ply_contacts[i];
    if (c.contact.points.empty()) continue;
    begin();
    const bool up = c.slave == pair.a;
    const PlyState& master = up ? b : a;
    add_ply_ply_stiffness(c.contact, master.state(), master.membrane.triangles, bound_margin,
                          up ? rows.a : rows.b, up ? rows.b : rows.a);
  }
  for (const int i : pair.edges) {
    const EdgeEdgeContact& contact = s.edge_contacts[i].contact;
    if (contact.groups.empty()) continue;
    begin();
    add_edge_stiffness(contact, edge_margin, rows.a, rows.b);
  }
  return rows;
}

void add(const std::vector<ContactRow>& rows, std::vector<ContactRow>& to) {
  for (std::size_t n = 0; n < rows.size(); ++n)
    to[n] += rows[n];
}

} // namespace

ContactRows contact_rows(const Scene& s, ThreadPool& pool) {
  std::vector<PairRows> of_pair(s.ply_pairs.size());
  pool.run(static_cast<int>(of_pair.size()), [&](int i) {
    const auto pair = static_cast<std::size_t>(i);
    of_pair[pair] = rows_of(s, s.ply_pairs[pair]);
  });
  ContactRows c(s.plies.size());
  pool.run(static_cast<int>(c.size()), [&](int i) {
    const auto p = static_cast<std::size_t>(i);
    const PlyState& ply = s.plies[p];
    std::vector<ContactRow>& rows = c[p];
    rows.resize(ply.x.size());
    for (const ToolState& tool : s.tools)
      add_tool_ply_stiffness(tool.contacts[p], ply.membrane.node_area, bound_margin, rows);
    for (std::size_t k = 0; k < of_pair.size(); ++k) {
      if (s.ply_pairs[k].a == i) add(of_pair[k].a, rows);
      if (s.ply_pairs[k].b == i) add(of_pair[k].b, rows);
    }
  });
  add_attachment_stiffness(s, c);
  return c;
}

} // namespace plyform
