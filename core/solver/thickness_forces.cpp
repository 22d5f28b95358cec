// SPDX-License-Identifier: GPL-3.0-or-later
// What pressed plies feel in their plane as a kind of force. A ply is as thick as its cloth
// (core/ply/thickness.hpp): pressed, it would rather be larger and thinner. With the derivative
// of the energy of its contacts by the ratio of thickness r_n of a node,
//
//   G_n = sum N d / r dr/dr_n                        (R) of contact/forces/contact_law.hpp    (G)
//
// the nodes of a triangle get
//
//   f = - W dr_e/dx,  W = 1/3 A0_e sum_n G_n / A0_n           (V) of core/ply/thickness.hpp    (F)
//
// so that the work of all contacts is what they store, lose and take, and none comes out of nothing
// when a ply is sheared between closed tools: pressed cloth resists shear. Forces and moments of a
// triangle cancel.
#include "core/solver/follow_thickness.hpp"
#include "core/solver/scene.hpp"

namespace plyform {
namespace {

/// Adds (G) of the contacts of a tool.
void add_squeeze(const ToolPlyContact& contact, PlyBody& ply) {
  if (!contact.thickness_follows) return;
  for (const std::int32_t i : contact.list.active) {
    const ToolPlyPoint& c = contact.points[at(i)];
    if (!(c.memory.normal_force > 0.0)) continue;
    const double ratio = ply.thickness_ratio[at(c.node)];
    ply.squeeze[at(c.node)] += c.memory.normal_force * (c.gap / ratio + contact.half_thickness);
  }
}

/// Adds (G) of the contacts of two plies to those nodes of `ply` that are slaves, masters or both.
void add_squeeze(const PlyPlyContact& contact, const PlyBody& slave, const PlyBody& master,
                 PlyBody& ply) {
  if (!contact.thickness_follows) return;
  const SurfaceKinematics own = slave.state(), other = master.state();
  for (const std::int32_t i : contact.list.active) {
    const PlyPlyPoint& c = contact.points[at(i)];
    if (!(c.memory.normal_force > 0.0)) continue;
    const double ratio = thickness_ratio_at(contact, c, own, other, master.membrane.triangles);
    const double all = c.memory.normal_force * (c.gap / ratio + contact.distance);
    if (&slave == &ply) ply.squeeze[at(c.node)] += contact.slave_share * all;
    if (&master != &ply) continue;
    const std::array<double, 3> w = weights_of(c);
    for (std::size_t j = 0; j < 3; ++j)
      ply.squeeze[at(master.membrane.triangles[at(c.face)][j])] +=
          (1.0 - contact.slave_share) * w[j] * all;
  }
}

bool is_pressed(const std::vector<ToolState>& tools, const std::vector<PlyPair>& pairs,
                std::size_t p) {
  for (const ToolState& t : tools)
    if (t.contacts[p].sums.touching > 0) return true;
  for (const PlyPair& pair : pairs)
    if ((at(pair.a) == p || at(pair.b) == p) && pair.loaded) return true;
  return false;
}

/// (G) of each node over 3 A0; 0 where the thickness is at its bounds.
void find_squeeze(Scene& s, std::size_t p) {
  PlyBody& ply = s.plies[p];
  ply.squeeze.assign(ply.x.size(), 0.0);
  for (const ToolState& t : s.tools)
    if (t.contacts[p].sums.touching > 0) add_squeeze(t.contacts[p], ply);
  for (const PlyPair& pair : s.ply_pairs) {
    if ((at(pair.a) != p && at(pair.b) != p) || !pair.loaded) continue;
    for (const PlyContact& pass : pair.passes)
      if (pass.contact.sums.touching > 0)
        add_squeeze(pass.contact, s.plies[at(pass.slave)], s.plies[at(pass.master)], ply);
  }
  for (std::size_t n = 0; n < ply.squeeze.size(); ++n) {
    const double r = ply.thickness_ratio[n];
    const bool follows = r > ply.thickness_law.least && r < thickest_ratio;
    ply.squeeze[n] *= follows ? 1.0 / (3.0 * ply.membrane.node_area[n]) : 0.0;
  }
}

/// (F).
void find_thickness_force(PlyBody& ply) {
  ply.thickness_force.assign(ply.x.size(), Vec3::Zero());
  const Membrane& m = ply.membrane;
  for (std::size_t e = 0; e < m.triangles.size(); ++e) {
    const Triangle& t = m.triangles[e];
    const double w =
        m.area[e] * (ply.squeeze[at(t[0])] + ply.squeeze[at(t[1])] + ply.squeeze[at(t[2])]);
    if (!(w > 0.0)) continue;
    const ElementThickness thickness = element_thickness(ply.thickness_law, m, ply.x, e);
    const Vec3 at_b = -w * thickness.by_b, at_c = -w * thickness.by_c;
    ply.thickness_force[at(t[0])] -= at_b + at_c;
    ply.thickness_force[at(t[1])] += at_b;
    ply.thickness_force[at(t[2])] += at_c;
  }
}

} // namespace

void ThicknessForces::finish(Scene& s, ThreadPool& pool) {
  if (!s.any_thickness_acts) return;
  pool.run(static_cast<int>(s.plies.size()), [&s](int p) {
    PlyBody& ply = s.plies[at(p)];
    ply.pressed = ply.thickness_acts && !ply.resting && is_pressed(s.tools, s.ply_pairs, at(p));
    if (!ply.pressed) return;
    find_squeeze(s, at(p));
    find_thickness_force(ply);
  });
}

void ThicknessForces::list_arrays(Layup& layup) {
  for (PlyBody& ply : layup.plies)
    if (ply.pressed) ply.nodal_forces.push_back(&ply.thickness_force);
}

} // namespace plyform
