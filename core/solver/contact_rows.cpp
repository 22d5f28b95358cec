// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/contact_rows.hpp"

#include "core/solver/attached_motion.hpp"

namespace plyform {
namespace {

/// Calls visit(contact) for the contacts of a pair, of nodes and edges.
template <class SomeScene, class Visit>
void visit_contacts(SomeScene& s, const PlyPair& pair, const Visit& visit) {
  for (const int i : pair.contacts)
    visit(s.ply_contacts[i].contact);
  for (const int i : pair.edges)
    visit(s.edge_contacts[i].contact);
}

void renew_rows(Scene& s, PlyPair& pair) {
  const PlyBody &a = s.plies[pair.a], &b = s.plies[pair.b];
  pair.rows_a.clear(), pair.rows_b.clear();
  const auto begin = [&] {
    pair.rows_a.resize(a.x.size());
    pair.rows_b.resize(b.x.size());
  };
  for (const int i : pair.contacts) {
    const PlyContact& c = s.ply_contacts[i];
    if (c.contact.points.empty()) continue;
    begin();
    const bool up = c.slave == pair.a;
    const PlyBody& master = up ? b : a;
    add_ply_ply_stiffness(c.contact, master.state(), master.membrane.triangles, s.bound_margin,
                          up ? pair.rows_a : pair.rows_b, up ? pair.rows_b : pair.rows_a);
  }
  for (const int i : pair.edges) {
    const EdgeEdgeContact& contact = s.edge_contacts[i].contact;
    if (contact.groups.empty()) continue;
    begin();
    add_edge_stiffness(contact, edge_margin(s), pair.rows_a, pair.rows_b);
  }
  visit_contacts(s, pair, [](auto& contact) {
    contact.renew_depth = depth_ahead(contact.law, contact.sums.penetration);
  });
}

bool has_deepened(const Scene& s, const PlyPair& pair) {
  bool deepened = false;
  visit_contacts(s, pair, [&](const auto& contact) {
    deepened = deepened || contact.sums.penetration > contact.renew_depth;
  });
  return deepened;
}

/// Renews the rows of the pairs for which due(pair) holds.
template <class Due>
void renew_rows_if(Scene& s, ThreadPool& pool, const Due& due) {
  pool.run(static_cast<int>(s.ply_pairs.size()), [&](int i) {
    PlyPair& pair = s.ply_pairs[static_cast<std::size_t>(i)];
    if (due(pair)) renew_rows(s, pair);
  });
}

void add(const std::vector<ContactRow>& rows, std::vector<ContactRow>& to) {
  for (std::size_t n = 0; n < rows.size(); ++n)
    to[n] += rows[n];
}

} // namespace

void renew_rows(Scene& s, ThreadPool& pool) {
  renew_rows_if(s, pool, [](const PlyPair&) { return true; });
}

void renew_deepened_rows(Scene& s, ThreadPool& pool) {
  renew_rows_if(s, pool, [&s](const PlyPair& pair) { return has_deepened(s, pair); });
}

ContactRows contact_rows(const Scene& s, ThreadPool& pool) {
  ContactRows c(s.plies.size());
  pool.run(static_cast<int>(c.size()), [&](int i) {
    const auto p = static_cast<std::size_t>(i);
    const PlyBody& ply = s.plies[p];
    std::vector<ContactRow>& rows = c[p];
    rows.resize(ply.x.size());
    for (const ToolState& tool : s.tools)
      add_tool_ply_stiffness(tool.contacts[p], ply.membrane.node_area, s.bound_margin, rows);
    for (const PlyPair& pair : s.ply_pairs) {
      if (pair.a == i) add(pair.rows_a, rows);
      if (pair.b == i) add(pair.rows_b, rows);
    }
  });
  add_attachment_stiffness(s, c);
  return c;
}

} // namespace plyform
