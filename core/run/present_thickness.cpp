// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/present_thickness.hpp"

#include "core/solver/make_contacts.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace plyform {
namespace {

/// Halves of a ply at its nodes, below [0] and above [1]: means of what its contacts there say.
class Halves {
public:
  Halves(const PlyBody& ply) : ply_(ply), normals_(normals_at_nodes(ply)) {
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

/// How half a ply gives way, over its thickness before forming; not at all without a curve.
class GivingHalf {
public:
  explicit GivingHalf(const PlyBody& ply) : half_(0.5 * ply.thickness) {
    const std::optional<Compaction>& c = ply.membrane.fabric.compaction;
    if (!c) return;
    loading_ = curve_of(c->loading);
    if (!c->unloading.thickness.empty()) unloading_ = curve_of(c->unloading);
  }
  /// mm it has lost under a pressure (N/mm^2) after the greatest so far.
  double lost(double pressure, double greatest) const {
    if (!loading_) return 0.0;
    if (!unloading_) return loading_->depth_at(pressure);
    return loading_->depth_at(greatest) -
           (unloading_->depth_at(greatest) - unloading_->depth_at(pressure));
  }
  /// mm that it can lose up to its densest packing.
  double most() const { return loading_ ? loading_->packed() : 0.0; }
  double half() const { return half_; } ///< mm, with nothing on it

private:
  static CompactionCurve curve_of(const ThicknessCurve& curve) {
    const HalfCompaction half = half_of(curve);
    return {&half, nullptr};
  }

  double half_;
  std::optional<CompactionCurve> loading_, unloading_;
};

/// Splits what two plies on each other lose together by (3).
class EqualPressure {
public:
  EqualPressure(const Scene& s, const PlyContact& pass)
      : law_(pass.contact.law), slave_(s.plies[at(pass.slave)]), master_(s.plies[at(pass.master)]),
        slave_share_(pass.contact.slave_share) {}

  /// mm, the slave's part of a depth (mm) of the contact, of one that was `compacted` (mm) deep.
  double of_slave(double depth, double compacted) const {
    if (!(depth > 0.0) || !law_.loading) return slave_share_ * depth;
    const double inside = std::min(depth, law_.packed()), beyond = depth - inside;
    const double pressure = law_.pressure(inside, compacted) / law_.share;
    const double greatest = law_.pressure(std::max(inside, compacted)) / law_.share;
    const double a = slave_.lost(pressure, greatest), b = master_.lost(pressure, greatest);
    const double within = a + b > 0.0 ? inside * a / (a + b) : slave_share_ * inside;
    return within +
           beyond_of_slave(beyond, slave_.most() - within, master_.most() - (inside - within));
  }

private:
  /// What is lost beyond the densest packing of one comes from the other up to its own. room_a,
  /// room_b: mm, of slave and master.
  double beyond_of_slave(double beyond, double room_a, double room_b) const {
    const double a = std::max(room_a, 0.0), b = std::max(room_b, 0.0), room = a + b;
    if (beyond <= room) return room > 0.0 ? beyond * a / room : 0.0;
    return a + (beyond - room) * slave_.half() / (slave_.half() + master_.half());
  }

  const ContactLaw& law_;
  GivingHalf slave_, master_;
  double slave_share_;
};

/// Adds what a contact of two plies says of `ply`, as slave, master or both. Nodes of both ways are
/// counted: flat triangles bring those of one sheet nearer to the other where those of the other
/// are further away.
void add(const Scene& s, const PlyContact& pass, const PlyBody& ply, Halves& halves) {
  const PlyBody &slave = s.plies[at(pass.slave)], &master = s.plies[at(pass.master)];
  if (&slave != &ply && &master != &ply) return;
  const PlyPlyContact& contact = pass.contact;
  const EqualPressure split(s, pass);
  for (const PlyPlyPoint& c : contact.points) {
    const double ratio =
        thickness_ratio_at(contact, c, slave.state(), master.state(), master.membrane.triangles);
    const double h = contact.distance * ratio, distance = latest_gap(c) + h;
    if (distance > 1.5 * h) continue; // of a fold, or nearly apart
    const Vec3 n = contact_normal(c, slave.x, master.x, master.membrane.triangles);
    const double most = contact.compacted.empty() ? 0.0 : contact.compacted[at(c.node)];
    const double lost = split.of_slave(contact.distance - distance / ratio, most);
    const double half = ratio * (contact.slave_share * contact.distance - lost);
    if (&slave == &ply) halves.add(c.node, n, 1.0, half);
    if (&master != &ply) continue;
    const std::array<double, 3> w = weights_of(c);
    for (std::size_t j = 0; j < 3; ++j)
      halves.add(master.membrane.triangles[at(c.face)][j], -n, w[j], distance - half);
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
