// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/follow_temperature.hpp"

#include "contact/forces/sliding_point.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double air_conductivity = 0.03; // N/(s K), W/(m K), of air at 80 degC, of (3)

/// Something that a face of a node may give heat to.
struct Seen {
  double order = 0.0;       ///< mm, what lies nearer covers what lies further: gap, see add_tools
  double share = 0.0;       ///< of the face, what it would cover alone
  double h = 0.0, flow = 0; ///< conductance per area that it covers, and that times its T_k
};

/// What one face of a node sees: the nearest of it.
struct Face {
  static constexpr int most = 4;
  std::array<Seen, most> seen;
  int count = 0, tools = 0;

  /// Before any ply; of tools that are as near as the nearest, within `same` (mm), their mean.
  void add_tool(const Seen& more, double same) {
    if (count == 0 || more.order < seen[0].order - same) {
      seen[0] = more, count = tools = 1;
    } else if (more.order <= seen[0].order + same) {
      ++tools;
      seen[0].h += (more.h - seen[0].h) / tools;
      seen[0].flow += (more.flow - seen[0].flow) / tools;
    }
  }

  void add(const Seen& more) {
    int i = count < most ? count++ : most;
    for (; i > 0 && more.order < seen[at(i - 1)].order; --i)
      if (i < most) seen[at(i)] = seen[at(i - 1)];
    if (i < most) seen[at(i)] = more;
  }
};

/// Both faces of the nodes of a ply, below [0] and above [1].
struct Faces {
  std::vector<Vec3> normals; ///< mm^2, six times the present area of the nodes
  std::array<std::vector<Face>, 2> of;
  std::vector<double> capacity; ///< C
};

Faces faces_of(const Layup& layup, std::size_t p) {
  const PlyBody& ply = layup.plies[p];
  const Fabric& fabric = ply.membrane.fabric;
  Faces faces;
  faces.normals = normals_at_nodes(ply);
  faces.of.fill(std::vector<Face>(ply.x.size()));
  for (std::size_t n = 0; n < ply.x.size(); ++n) {
    const double now = faces.normals[n].norm() / 6.0, before = ply.membrane.node_area[n];
    faces.capacity.push_back(fabric.surface_density * *fabric.heat_capacity * before /
                             std::max(now, 1e-3 * before));
  }
  return faces;
}

/// Conductance of a face with this gap (mm), (3); no more than touching, no less than to air.
double through_film(double touching, double gap, double air) {
  if (!(touching > 0.0)) return 0.0; // it covers the face, and takes nothing
  const double film = gap > 0.0 ? 1.0 / (1.0 / touching + gap / air_conductivity) : touching;
  return std::max(film, std::min(air, touching));
}

/// Whether something at this gap (mm) covers a face: the film between then conducts more than air
/// that moves.
bool covers(double gap, double air) {
  return !(gap > 0.0) || air_conductivity / gap > air;
}

std::size_t side_of(const Faces& faces, std::int32_t node, const Vec3& direction) {
  return direction.dot(faces.normals[at(node)]) < 0.0 ? 1 : 0; // what pushes down is above
}

/// A tool counts as half the ply's thickness further away than it is: a ply that is as near lies
/// before it, since none lies behind a tool.
void add_tools(const Layup& layup, const std::vector<ToolState>& tools, std::size_t p, double time,
               Faces& faces) {
  const Cooling& cooling = *layup.data.process.cooling;
  const double thickness = layup.plies[p].thickness;
  constexpr double same = 0.1; // of the thickness: two tools touch the face there
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const std::optional<double> celsius = tool_temperature(layup.data, layup.data.tools[t], time);
    if (!celsius) continue; // tools take no heat
    for (const ToolPlyPoint& c : tools[t].contacts[p].points) {
      const double gap = latest_gap(c);
      if (!covers(gap, cooling.to_air)) continue;
      const double h = through_film(cooling.to_tools, gap, cooling.to_air);
      faces.of[side_of(faces, c.node, normal_of(c))][at(c.node)].add_tool(
          {gap + 0.5 * thickness, 1.0, h, h * *celsius}, same * thickness);
    }
  }
}

/// What a slave's node sees of a master: what that covers of it, at a gap (mm) across the faces.
struct Covering {
  double share = 0.0, gap = 0.0;
};

/// Of both passes of a pair of plies, at their points.
using PairCovers = std::vector<std::vector<Covering>>;

/// mm^2, present, that a pass takes for covered: at nodes that are whole, and under a rim.
struct CoveredArea {
  double whole = 0.0, rim = 0.0;

  CoveredArea(const PlyContact& pass, const std::vector<Covering>& covers, const Faces& slave) {
    for (std::size_t i = 0; i < covers.size(); ++i) {
      const double area = slave.normals[at(pass.contact.points[i].node)].norm() / 6.0;
      (covers[i].share < 1.0 ? rim : whole) += covers[i].share * area;
    }
  }
};

/// Lets both plies of a pair give heat through the same area, so that none gets lost: that of the
/// pass with less under rims, where shares are approximate, which those of the other are scaled to.
void balance(const PlyPair& pair, const std::vector<Faces>& faces, PairCovers& covers) {
  if (covers.size() != 2) return;
  const CoveredArea a(pair.passes[0], covers[0], faces[at(pair.passes[0].slave)]),
      b(pair.passes[1], covers[1], faces[at(pair.passes[1].slave)]);
  const bool first = a.rim > b.rim; // is scaled
  const CoveredArea &from = first ? a : b, &to = first ? b : a;
  if (!(from.rim > 0.0)) return;
  constexpr double most = 2.0; // beyond it the two passes do not see the same
  const double by = std::clamp((to.whole + to.rim - from.whole) / from.rim, 1.0 / most, most);
  for (Covering& cover : covers[first ? 0 : 1])
    if (cover.share < 1.0) cover.share *= by;
}

/// What lies beside a node, not before it, covers nothing; nor does what is too far.
std::vector<Covering> coverings(const Layup& layup, const PlyContact& pass) {
  const PlyBody &slave = layup.plies[at(pass.slave)], &master = layup.plies[at(pass.master)];
  const std::vector<Triangle>& triangles = master.membrane.triangles;
  const std::vector<Cover> covers_it =
      covers_of(pass.contact, slave.state(), master.state(), triangles);
  std::vector<Covering> found;
  found.reserve(covers_it.size());
  for (std::size_t i = 0; i < covers_it.size(); ++i) {
    const PlyPlyPoint& c = pass.contact.points[i];
    Covering& seen = found.emplace_back(Covering{covers_it[i].share, latest_gap(c)});
    if (const std::optional<double> height = covers_it[i].height) {
      const double h = pass.contact.distance * thickness_ratio_at(pass.contact, c, slave.state(),
                                                                  master.state(), triangles);
      seen.gap = *height - h;
      if (*height < 0.5 * h) seen.share = 0.0;
    }
    if (!covers(seen.gap, layup.data.process.cooling->to_air)) seen.share = 0.0;
  }
  return found;
}

PairCovers covers_of_pair(const Layup& layup, const PlyPair& pair,
                          const std::vector<Faces>& faces) {
  PairCovers found;
  for (const PlyContact& pass : pair.passes)
    found.push_back(coverings(layup, pass));
  balance(pair, faces, found);
  return found;
}

/// What the nodes of a contact's slave see of its master.
void add_ply(const Layup& layup, const PlyContact& pass, const std::vector<Covering>& seen,
             std::vector<Faces>& all) {
  const Cooling& cooling = *layup.data.process.cooling;
  const PlyBody &slave = layup.plies[at(pass.slave)], &master = layup.plies[at(pass.master)];
  Faces& faces = all[at(pass.slave)];
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const PlyPlyPoint& c = pass.contact.points[i];
    const auto [share, gap] = seen[i];
    if (!(share > 0.0)) continue;
    const Triangle& t = master.membrane.triangles[at(c.face)];
    const std::array<double, 3> w = weights_of(c);
    double celsius = 0.0, other = 0.0; // T_b, C_b
    for (std::size_t j = 0; j < 3; ++j) {
      celsius += w[j] * master.temperature[at(t[j])];
      other += w[j] * all[at(pass.master)].capacity[at(t[j])];
    }
    const double own = faces.capacity[at(c.node)], both = own + other;
    const double mean = (own * slave.temperature[at(c.node)] + other * celsius) / both;
    const double h = through_film(cooling.to_plies, gap, cooling.to_air) * both / other;
    const Vec3 normal = contact_normal(c, slave.x, master.x, master.membrane.triangles);
    faces.of[side_of(faces, c.node, normal)][at(c.node)].add({gap, share, h, h * mean});
  }
}

/// Conductance of a face and that times temperature, by what covers it.
struct Conductance {
  double h = 0.0, flow = 0.0;
};

/// Things within half a thickness (mm) of each other lie side by side and share the face; those
/// behind have what the nearer ones leave of it, if they reach further; and the air the rest.
Conductance conductance_of(const Face& face, double thickness, double air, double surroundings) {
  Conductance sum;
  double covered = 0.0, before = 0.0, layer = 0.0; // before: what nearer layers cover
  for (int i = 0; i < face.count; ++i) {
    const Seen& thing = face.seen[at(i)];
    if (i == 0 || thing.order > layer + 0.5 * thickness) before = covered, layer = thing.order;
    const double left = before > 0.0 ? thing.share - before : thing.share;
    const double part = covered > 0.0 ? std::clamp(left, 0.0, std::max(1.0 - covered, 0.0)) : left;
    sum.h += part * thing.h, sum.flow += part * thing.flow;
    covered += part;
  }
  const double rest = std::max(1.0 - covered, 0.0);
  return {sum.h + rest * air, sum.flow + rest * air * surroundings};
}

/// (2) of the nodes of a ply over dt (s, of the process).
std::vector<double> cooled(const PlyBody& ply, const Faces& faces, double air, double surroundings,
                           double dt) {
  std::vector<double> celsius = ply.temperature;
  for (std::size_t n = 0; n < celsius.size(); ++n) {
    double h = 0.0, flow = 0.0;
    for (const std::vector<Face>& side : faces.of) {
      const Conductance face = conductance_of(side[n], ply.thickness, air, surroundings);
      h += face.h, flow += face.flow;
    }
    if (!(h > 0.0)) continue;
    const double target = flow / h, left = std::exp(-dt * h / faces.capacity[n]);
    celsius[n] = target + (celsius[n] - target) * left;
  }
  return celsius;
}

/// degC, mean of the nodes of a triangle.
double temperature_of(const PlyBody& ply, std::size_t triangle) {
  double celsius = 0.0;
  for (const std::int32_t node : ply.membrane.triangles[triangle])
    celsius += ply.temperature[at(node)] / 3.0;
  return celsius;
}

/// A law's factors of triangles, in the kernel's order.
void find_factors(const PlyBody& ply, const TemperatureFactor& law, PackedStates& factors) {
  if (factors.empty()) return;
  std::vector<double> of;
  of.reserve(ply.membrane.triangles.size());
  for (std::size_t e = 0; e < ply.membrane.triangles.size(); ++e)
    of.push_back(law.at(temperature_of(ply, e)));
  pack(*ply.simd, ply.membrane, of, factors);
}

/// A law's factors of strain groups, at the means of their area, in the kernel's order.
void find_factors_of_groups(const PlyBody& ply, const TemperatureFactor& law,
                            PackedStates& factors) {
  if (factors.empty()) return;
  const Membrane& m = ply.membrane;
  for (std::size_t i = 0; i < ply.simd->groups.size(); ++i) {
    const std::int32_t group = ply.simd->groups[i];
    if (group < 0) continue;
    double area = 0.0, celsius = 0.0;
    for (std::size_t e = at(m.group_begin[at(group)]); e < at(m.group_begin[at(group) + 1]); ++e)
      area += m.area[e], celsius += m.area[e] * temperature_of(ply, e);
    factors[i / simd_width].of[i % simd_width] = law.at(celsius / area);
  }
}

/// What the temperatures of a time (s) make of laws.
void find_all_factors(PlyBody& ply, double time) {
  if (ply.flow_time == time) return;
  const TemperatureFactor& flow = ply.membrane.fabric.flow;
  find_factors(ply, flow, ply.flow_factors);
  find_factors_of_groups(ply, flow, ply.time_factors);
  find_factors(ply, ply.membrane.fabric.shear_over_temperature, ply.shear_factors);
  if (!ply.node_flow_factors.empty()) {
    std::vector<double> of;
    of.reserve(ply.temperature.size());
    for (const double celsius : ply.temperature)
      of.push_back(flow.at(celsius));
    pack(*ply.bending, of, ply.node_flow_factors);
  }
  ply.flow_time = time;
}

/// N mm, what shear stores more than before, at the present shape.
double heat_of_shear(const PlyBody& ply, const PackedStates& before) {
  PackedStates change = ply.shear_factors;
  for (std::size_t i = 0; i < change.size(); ++i)
    for (std::size_t lane = 0; lane < simd_width; ++lane)
      change[i].of[lane] -= before[i].of[lane];
  double sum = 0.0;
  for (std::size_t b = 0; b < ply.simd->blocks.size(); ++b)
    sum +=
        simd_shear_energy(*ply.simd, ply.membrane, ply.x, static_cast<int>(b), ply.yarns, change);
  return sum;
}

/// Gives a ply its temperatures of a time (s), and counts what that does to the energy of shear.
void set_temperatures(PlyBody& ply, std::vector<double> celsius, double before, double time) {
  find_all_factors(ply, before); // after a checkpoint, or going back, they are not known
  const PackedStates shear = ply.shear_factors;
  ply.temperature = std::move(celsius);
  find_all_factors(ply, time);
  if (!shear.empty()) ply.law_work += heat_of_shear(ply, shear);
}

/// Whether temperatures are to be renewed: now and then, and before any could have changed much.
bool is_due(const Layup& layup) {
  if (layup.step % temperatures_every == 0) return true;
  const Cooling& cooling = *layup.data.process.cooling;
  const double h = std::max({cooling.to_tools, cooling.to_plies, cooling.to_air});
  const double dt = (layup.time - layup.cooled_until) * layup.data.process_time();
  return std::any_of(layup.plies.begin(), layup.plies.end(), [&](const PlyBody& ply) {
    const Fabric& fabric = ply.membrane.fabric;
    return dt * h > longest_update * fabric.surface_density * *fabric.heat_capacity;
  });
}

} // namespace

std::vector<std::vector<double>> present_temperatures(const Scene& s, ThreadPool& pool) {
  std::vector<std::vector<double>> celsius;
  for (const PlyBody& ply : s.plies)
    celsius.push_back(ply.temperature);
  if (!s.data.process.cooling || !(s.time > s.cooled_until)) return celsius;
  const Cooling& cooling = *s.data.process.cooling;
  const double clock = s.data.process_time(), dt = (s.time - s.cooled_until) * clock;
  const double middle = s.cooled_until * clock + 0.5 * dt;
  std::vector<Faces> faces(s.plies.size());
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    faces[at(p)] = faces_of(s, at(p));
    add_tools(s, s.tools, at(p), middle, faces[at(p)]);
  });
  std::vector<PairCovers> covers(s.ply_pairs.size());
  pool.run(static_cast<int>(covers.size()),
           [&](int i) { covers[at(i)] = covers_of_pair(s, s.ply_pairs[at(i)], faces); });
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    for (std::size_t i = 0; i < covers.size(); ++i)
      for (std::size_t k = 0; k < covers[i].size(); ++k)
        if (const PlyContact& pass = s.ply_pairs[i].passes[k]; pass.slave == p)
          add_ply(s, pass, covers[i][k], faces);
  });
  const double surroundings = temperature_at(cooling.surroundings, middle);
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    celsius[at(p)] = cooled(s.plies[at(p)], faces[at(p)], cooling.to_air, surroundings, dt);
  });
  return celsius;
}

void update_temperatures(Scene& s, ThreadPool& pool) {
  if (s.data.process.cooling && is_due(s)) {
    std::vector<std::vector<double>> celsius = present_temperatures(s, pool);
    pool.run(static_cast<int>(s.plies.size()), [&](int p) {
      set_temperatures(s.plies[at(p)], std::move(celsius[at(p)]), s.cooled_until, s.time);
    });
    s.cooled_until = s.time;
  }
  for (PlyBody& ply : s.plies)
    find_all_factors(ply, s.cooled_until);
}

} // namespace plyform
