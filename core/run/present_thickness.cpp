// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/present_thickness.hpp"

#include "base/node_normals.hpp"

#include <algorithm>
#include <array>

namespace plyform {
namespace {

/// Halves of a ply at its nodes, below [0] and above [1]: means of what its contacts there say.
class Halves {
public:
  Halves(const PlyBody& ply) : ply_(ply), normals_(area_normals(ply.x, ply.membrane.triangles)) {
    sum_.fill(std::vector<double>(ply.x.size(), 0.0));
    weight_ = sum_;
  }
  /// direction: in which the contact pushes the node; half: mm.
  void add(std::int32_t node, const Vec3& direction, double weight, double half) {
    const std::size_t side = direction.dot(normals_[at(node)]) < 0.0 ? 1 : 0;
    sum_[side][at(node)] += weight * std::min(half, free(at(node)));
    weight_[side][at(node)] += weight;
  }
  /// mm, of both sides.
  double thickness(std::size_t node) const {
    double sum = 0.0;
    for (std::size_t side = 0; side < 2; ++side) {
      const double weight = weight_[side][node];
      sum += weight > 0.0 ? sum_[side][node] / weight : free(node);
    }
    return sum;
  }

private:
  double free(std::size_t node) const { return 0.5 * ply_.thickness * ply_.thickness_ratio[node]; }

  const PlyBody& ply_;
  std::vector<Vec3> normals_;
  std::array<std::vector<double>, 2> sum_, weight_;
};

/// Adds what a contact of two plies says of `ply`, as slave, master or both. Nodes of both ways are
/// counted: flat triangles bring those of one sheet nearer to the other where those of the other
/// are further away.
void add(const Scene& s, const PlyContact& pass, const PlyBody& ply, Halves& halves) {
  const PlyBody &slave = s.plies[at(pass.slave)], &master = s.plies[at(pass.master)];
  if (&slave != &ply && &master != &ply) return;
  const PlyPlyContact& contact = pass.contact;
  for (const PlyPlyPoint& c : contact.points) {
    const double ratio =
        thickness_ratio_at(contact, c, slave.state(), master.state(), master.membrane.triangles);
    const double h = contact.distance * ratio, distance = latest_gap(c) + h;
    if (distance > 1.5 * h) continue; // of a fold, or nearly apart
    const Vec3 n = contact_normal(c, slave.x, master.x, master.membrane.triangles);
    if (&slave == &ply) halves.add(c.node, n, 1.0, contact.slave_share * distance);
    if (&master != &ply) continue;
    const std::array<double, 3> w = weights_of(c);
    for (std::size_t j = 0; j < 3; ++j)
      halves.add(master.membrane.triangles[at(c.face)][j], -n, w[j],
                 (1.0 - contact.slave_share) * distance);
  }
}

} // namespace

std::vector<double> thickness_between(const Scene& s, int index) {
  const PlyBody& ply = s.plies[at(index)];
  if (!ply.membrane.fabric.compaction) return {};
  Halves halves(ply);
  for (const ToolState& tool : s.tools) {
    const ToolPlyContact& contact = tool.contacts[at(index)];
    for (const ToolPlyPoint& c : contact.points)
      if (c.gap < 0.0)
        halves.add(c.node, normal_of(c), 1.0,
                   c.gap + contact.half_thickness * ply.thickness_ratio[at(c.node)]);
  }
  each_pass(s, [&](const PlyContact& pass) { add(s, pass, ply, halves); });
  std::vector<double> thickness;
  for (std::size_t n = 0; n < ply.x.size(); ++n)
    thickness.push_back(halves.thickness(n));
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
