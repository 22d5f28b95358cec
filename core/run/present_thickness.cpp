// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/present_thickness.hpp"

#include "base/node_normals.hpp"

#include <algorithm>
#include <array>

namespace plyform {
namespace {

/// Halves of a ply at its nodes, below [0] and above [1].
struct Halves {
  std::vector<Vec3> normals;
  std::array<std::vector<double>, 2> half; ///< mm

  /// direction: that in which the contact pushes the node.
  void limit(int node, const Vec3& direction, double to) {
    double& now = half[direction.dot(normals[at(node)]) < 0.0 ? 1 : 0][at(node)];
    now = std::min(now, to);
  }
};

} // namespace

std::vector<double> thickness_between(const Scene& s, int index) {
  const PlyBody& ply = s.plies[at(index)];
  if (!ply.membrane.fabric.compaction) return {};
  Halves halves{area_normals(ply.x, ply.membrane.triangles), {}};
  for (const double r : ply.thickness_ratio)
    for (std::vector<double>& half : halves.half)
      half.push_back(0.5 * ply.thickness * r);
  for (const ToolState& tool : s.tools) {
    const ToolPlyContact& contact = tool.contacts[at(index)];
    for (const ToolPlyPoint& c : contact.points)
      if (c.gap < 0.0)
        halves.limit(c.node, normal_of(c),
                     c.gap + contact.half_thickness * ply.thickness_ratio[at(c.node)]);
  }
  each_pass(s, [&](const PlyContact& pass) {
    if (pass.slave != index) return;
    const PlyBody& master = s.plies[at(pass.master)];
    for (const PlyPlyPoint& c : pass.contact.points) {
      if (!(c.gap < 0.0)) continue;
      const double ratio = thickness_ratio_at(pass.contact, c, ply.state(), master.state(),
                                              master.membrane.triangles);
      const double distance = c.gap + pass.contact.distance * ratio;
      halves.limit(c.node, contact_normal(c, ply.x, master.x, master.membrane.triangles),
                   pass.contact.slave_share * distance);
    }
  });
  std::vector<double> thickness;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    thickness.push_back(halves.half[0][n] + halves.half[1][n]);
  return thickness;
}

void add_present_thickness(const Scene& s, int index, const std::vector<double>& area_ratios,
                           std::vector<double>& thickness, std::vector<double>& fibre_volume) {
  const PlyBody& ply = s.plies[at(index)];
  const Fabric& fabric = ply.membrane.fabric;
  const std::vector<double> at_nodes = thickness_between(s, index);
  for (std::size_t e = 0; e < thickness.size(); ++e) {
    const Triangle& t = ply.membrane.triangles[e];
    if (!at_nodes.empty())
      thickness[e] = (at_nodes[at(t[0])] + at_nodes[at(t[1])] + at_nodes[at(t[2])]) / 3.0;
    if (fabric.fibre_density)
      fibre_volume.push_back(fabric.surface_density / *fabric.fibre_density /
                             (area_ratios[e] * thickness[e]));
  }
}

} // namespace plyform
