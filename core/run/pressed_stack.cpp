// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/pressed_stack.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace plyform {
namespace {

constexpr double pressing = 0.1; // of a tool's force, from which on that is not the cloth's

/// A node, and the side of its ply, 0 below, 1 above, on which a force acts.
struct Side {
  int ply = 0, node = 0, side = 0;
};

/// A force between a tool and a node, or two nodes of plies: of a contact of a face its share.
struct Link {
  Side a, b;
  int tool = -1;          ///< in the place of b
  double force = 0.0;     ///< N, normal
  bool gives_way = false; ///< by a compaction curve, inside it
};

/// Whether a contact of this gap (mm) is within what its fabrics' compaction curves say. ratio: r
/// of contact/forces/contact_law.hpp.
bool inside_curve(const ContactLaw& law, double gap, double ratio) {
  return law.loading && -gap <= law.packed() * ratio;
}

/// Sums on both sides of all nodes, N.
using Sums = std::vector<std::array<std::vector<double>, 2>>;

double& at_side(Sums& sums, const Side& s) {
  return sums[at(s.ply)][at(s.side)][at(s.node)];
}
double at_side(const Sums& sums, const Side& s) {
  return sums[at(s.ply)][at(s.side)][at(s.node)];
}

class Flow {
public:
  explicit Flow(const Scene& s) : scene_(s) {
    for (const PlyBody& ply : s.plies)
      normals_.push_back(normals_at_nodes(ply));
    all_ = zero();
    for (std::size_t t = 0; t < s.tools.size(); ++t)
      add_tool(t);
    each_pass(s, [this](const PlyContact& pass) { add_pair(pass); });
    for (const Link& link : links_) {
      at_side(all_, link.a) += link.force;
      if (link.tool < 0) at_side(all_, link.b) += link.force;
    }
  }

  /// N, from tool t to others whose places are prescribed.
  double through(std::size_t t) const {
    Sums comes = zero();
    for (const Link& link : links_)
      if (link.tool == static_cast<int>(t) && !link.gives_way) at_side(comes, link.a) += link.force;
    double arrived = 0.0;
    for (std::size_t ply = 0; ply < scene_.plies.size(); ++ply) { // no way is longer
      Sums next = zero();
      bool on = false;
      const auto pass = [&](const Side& from, const Link& link, const Side* to) {
        const double force = passed_on(comes, from) * link.force / at_side(all_, from);
        if (!(force > 0.0) || link.gives_way) return;
        if (to)
          at_side(next, *to) += force, on = true;
        else if (link.tool != static_cast<int>(t) && is_placed(at(link.tool)))
          arrived += force;
      };
      for (const Link& link : links_) {
        pass(link.a, link, link.tool < 0 ? &link.b : nullptr);
        if (link.tool < 0) pass(link.b, link, &link.a);
      }
      if (!on) break;
      comes = std::move(next);
    }
    return arrived;
  }

  bool is_placed(std::size_t t) const { return !scene_.tools[t].body.force_controlled; }

private:
  Sums zero() const {
    Sums sums(scene_.plies.size());
    for (std::size_t p = 0; p < sums.size(); ++p)
      sums[p].fill(std::vector<double>(scene_.plies[p].x.size(), 0.0));
    return sums;
  }

  /// N, of what comes on the other side of a node, that arrives on this one.
  double passed_on(const Sums& comes, const Side& here) const {
    const Side other{here.ply, here.node, 1 - here.side};
    const double before = at_side(all_, other), after = at_side(all_, here);
    return before > 0.0 ? std::min(1.0, after / before) * at_side(comes, other) : 0.0;
  }

  /// The side of a node on which a force in this direction acts: upwards from below.
  Side side_of(int ply, int node, const Vec3& direction) const {
    return {ply, node, direction.dot(normals_[at(ply)][at(node)]) < 0.0 ? 1 : 0};
  }

  void add_tool(std::size_t t) {
    for (std::size_t p = 0; p < scene_.plies.size(); ++p) {
      const ToolPlyContact& contact = scene_.tools[t].contacts[p];
      for (const ToolPlyPoint& c : contact.points) {
        if (!(c.memory.normal_force > 0.0)) continue;
        const double ratio = thickness_ratio_at(contact, scene_.plies[p].state(), c.node);
        links_.push_back({side_of(static_cast<int>(p), c.node, normal_of(c)),
                          {},
                          static_cast<int>(t),
                          c.memory.normal_force,
                          inside_curve(contact.law, c.gap, ratio)});
      }
    }
  }

  void add_pair(const PlyContact& pair) {
    const PlyBody &slave = scene_.plies[pair.slave], &master = scene_.plies[pair.master];
    for (const PlyPlyPoint& c : pair.contact.points) {
      if (!(c.memory.normal_force > 0.0)) continue;
      const Vec3 n = contact_normal(c, slave.x, master.x, master.membrane.triangles);
      const Triangle& t = master.membrane.triangles[at(c.face)];
      const std::array<double, 3> w = weights_of(c);
      const bool gives_way =
          inside_curve(pair.contact.law, c.gap,
                       thickness_ratio_at(pair.contact, c, slave.state(), master.state(),
                                          master.membrane.triangles));
      for (std::size_t j = 0; j < 3; ++j)
        if (w[j] > 0.0)
          links_.push_back({side_of(pair.slave, c.node, n), side_of(pair.master, t[j], -n), -1,
                            w[j] * c.memory.normal_force, gives_way});
    }
  }

  const Scene& scene_;
  std::vector<std::vector<Vec3>> normals_;
  std::vector<Link> links_;
  Sums all_;
};

/// Whether two tools with prescribed places touch plies: else nothing can be pressed.
bool may_be_pressed(const Scene& s) {
  const auto touches = [](const ToolState& tool) {
    return !tool.body.force_controlled &&
           std::any_of(tool.contacts.begin(), tool.contacts.end(),
                       [](const ToolPlyContact& c) { return c.sums.touching > 0; });
  };
  return std::count_if(s.tools.begin(), s.tools.end(), touches) > 1;
}

} // namespace

std::vector<double> forces_through_plies(const Scene& s) {
  std::vector<double> through(s.tools.size(), 0.0);
  if (!may_be_pressed(s)) return through;
  const Flow flow(s);
  for (std::size_t t = 0; t < through.size(); ++t)
    if (flow.is_placed(t)) through[t] = flow.through(t);
  return through;
}

void follow_known_forces(const Scene& s, double stroke_mm, double time_s,
                         std::vector<KnownForce>& known) {
  known.resize(s.tools.size());
  const std::vector<double> through = forces_through_plies(s);
  for (std::size_t t = 0; t < known.size(); ++t)
    if (known[t].to_end() && through[t] > pressing * s.tools[t].force.norm())
      known[t] = {stroke_mm, time_s};
}

} // namespace plyform
