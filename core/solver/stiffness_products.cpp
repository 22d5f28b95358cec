// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/stiffness_products.hpp"

#include "core/solver/attached_motion.hpp"
#include "core/solver/contact_rows.hpp"
#include "core/solver/force_kinds.hpp"

#include <algorithm>

namespace plyform {

ElementProduct::ElementProduct(const ElementForces&, const Layup& layup,
                               const TangentFactors& factors) {
  for (const PlyBody& ply : layup.plies) {
    std::unique_ptr<YarnStiffness>& yarns = yarns_.emplace_back();
    if (!ply.resting && ply.membrane.fabric.has_yarns())
      yarns = std::make_unique<YarnStiffness>(
          ply.membrane, ply.x, kink_factor(ply.membrane) * factors.stiffness, factors.damping);
  }
}

void ElementProduct::add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const {
  if (yarns_[ply]) yarns_[ply]->add_to(y[ply], f[ply]);
}

void BoundaryProduct::add_between(const PerPly& y, PerPly& f) const {
  add_attachment_forces(boundaries_, layup_, stiffness_, y, f);
}

ToolProduct::ToolProduct(const ToolContacts& contacts, const Layup& layup,
                         const TangentFactors& factors) {
  for (std::size_t p = 0; p < layup.plies.size(); ++p) {
    std::vector<ContactTangent>& on_ply = on_ply_.emplace_back();
    if (layup.plies[p].resting) continue;
    for (const ToolState& tool : contacts.tools)
      append_tangents(tool.contacts[p], layup.plies[p].state(), layup.bound_margin, factors,
                      on_ply);
  }
}

void ToolProduct::add_on_ply(std::size_t ply, const PerPly& y, PerPly& f) const {
  add_tangent_forces(on_ply_[ply], y[ply], y[ply], f[ply], f[ply]);
}

PlyProduct::PlyProduct(const PlyContacts& contacts, const Layup& layup,
                       const TangentFactors& factors) {
  for (const PlyPair& pair : contacts.ply_pairs) {
    Pair to{at(pair.a), at(pair.b), {}, {}, {}, {}};
    const PlyBody &a = layup.plies[to.a], &b = layup.plies[to.b];
    for (const PlyContact& pass : pair.passes) {
      const bool up = pass.slave == pair.a;
      const PlyBody &slave = up ? a : b, &master = up ? b : a;
      append_tangents(pass.contact, slave.state(), master.state(), master.membrane.triangles,
                      layup.bound_margin, factors, up ? to.up : to.down);
    }
    append_tangents(pair.edges.contact, a.state(), b.state(), edge_margin(layup), factors, to.up);
    if (to.up.empty() && to.down.empty()) continue;
    to.force_a.resize(a.x.size());
    to.force_b.resize(b.x.size());
    pairs_.push_back(std::move(to));
  }
}

void PlyProduct::run(int task, const PerPly& y) {
  Pair& pair = pairs_[at(task)];
  std::fill(pair.force_a.begin(), pair.force_a.end(), Vec3::Zero());
  std::fill(pair.force_b.begin(), pair.force_b.end(), Vec3::Zero());
  add_tangent_forces(pair.up, y[pair.a], y[pair.b], pair.force_a, pair.force_b);
  add_tangent_forces(pair.down, y[pair.b], y[pair.a], pair.force_b, pair.force_a);
}

void PlyProduct::gather(std::size_t ply, PerPly& f) const {
  const auto add = [&](const std::vector<Vec3>& force) {
    for (std::size_t n = 0; n < force.size(); ++n)
      f[ply][n] += force[n];
  };
  for (const Pair& pair : pairs_) {
    if (pair.a == ply) add(pair.force_a);
    if (pair.b == ply) add(pair.force_b);
  }
}

} // namespace plyform
