// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/contact_rows.hpp"

namespace plyform {
namespace {

/// Calls visit(contact) for the contacts of a pair, of nodes and edges.
template <class SomePair, class Visit>
void visit_contacts(SomePair& pair, const Visit& visit) {
  for (auto& pass : pair.passes)
    visit(pass.contact);
  visit(pair.edges.contact);
}

void renew_rows(const Layup& layup, PlyPair& pair) {
  const PlyBody &a = layup.plies[at(pair.a)], &b = layup.plies[at(pair.b)];
  pair.rows_a.clear(), pair.rows_b.clear();
  const auto begin = [&] {
    pair.rows_a.resize(a.x.size());
    pair.rows_b.resize(b.x.size());
  };
  for (const PlyContact& pass : pair.passes) {
    if (pass.contact.points.empty()) continue;
    begin();
    const bool up = pass.slave == pair.a;
    const PlyBody &slave = up ? a : b, &master = up ? b : a;
    add_ply_ply_stiffness(pass.contact, slave.state(), master.state(), master.membrane.triangles,
                          layup.bound_margin, up ? pair.rows_a : pair.rows_b,
                          up ? pair.rows_b : pair.rows_a);
  }
  if (!pair.edges.contact.groups.empty()) {
    begin();
    add_edge_stiffness(pair.edges.contact, edge_margin(layup), pair.rows_a, pair.rows_b);
  }
  visit_contacts(pair, [](auto& contact) {
    contact.renew_depth = depth_ahead(contact.law, contact.sums.penetration);
  });
}

bool has_deepened(const PlyPair& pair) {
  bool deepened = false;
  visit_contacts(pair, [&](const auto& contact) {
    deepened = deepened || contact.sums.penetration > contact.renew_depth;
  });
  return deepened;
}

/// Renews the rows of the pairs for which due(pair) holds.
template <class Due>
void renew_rows_if(const Layup& layup, std::vector<PlyPair>& pairs, ThreadPool& pool,
                   const Due& due) {
  pool.run(static_cast<int>(pairs.size()), [&](int i) {
    PlyPair& pair = pairs[at(i)];
    if (due(pair)) renew_rows(layup, pair);
  });
}

} // namespace

void renew_rows(const Layup& layup, std::vector<PlyPair>& pairs, ThreadPool& pool) {
  renew_rows_if(layup, pairs, pool, [](const PlyPair&) { return true; });
}

void renew_deepened_rows(const Layup& layup, std::vector<PlyPair>& pairs, ThreadPool& pool) {
  renew_rows_if(layup, pairs, pool, has_deepened);
}

ContactRows contact_rows(const Scene& s, ThreadPool& pool) {
  ContactRows c(s.plies.size());
  pool.run(static_cast<int>(c.size()), [&](int p) {
    std::vector<ContactRow>& rows = c[at(p)];
    rows.resize(s.plies[at(p)].x.size());
    each_kind<InOrder::summed>(s, [&](const auto& kind) { kind.add_rows(s, at(p), rows); });
  });
  return c;
}

} // namespace plyform
