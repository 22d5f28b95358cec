// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/follow_temperature.hpp"

#include "base/node_normals.hpp"

#include <cmath>

namespace plyform {
namespace {

constexpr double air_conductivity = 0.03; // N/(s K), W/(m K), of air at 80 degC, of (3)

/// What one face of a node gives its heat to: sums over what is there.
struct Face {
  double conductance = 0.0, flow = 0.0; ///< h, h T
  int count = 0;

  void add(double h, double celsius) { conductance += h, flow += h * celsius, ++count; }
};

/// Both faces of the nodes of a ply, below [0] and above [1].
struct Faces {
  std::vector<Vec3> normals; ///< mm^2, six times the present area of the nodes
  std::array<std::vector<Face>, 2> of;
  std::vector<double> capacity; ///< C
};

Faces faces_of(const Scene& s, std::size_t p) {
  const PlyBody& ply = s.plies[p];
  const Fabric& fabric = ply.membrane.fabric;
  Faces faces;
  faces.normals = area_normals(ply.x, ply.membrane.triangles);
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

void add_tools(const Scene& s, std::size_t p, double time, Faces& faces) {
  const Cooling& cooling = *s.data.process.cooling;
  for (std::size_t t = 0; t < s.tools.size(); ++t) {
    const std::optional<double> celsius = tool_temperature(s.data, s.data.tools[t], time);
    if (!celsius) continue; // tools take no heat
    for (const ToolPlyPoint& c : s.tools[t].contacts[p].points) {
      const double gap = latest_gap(c);
      if (!covers(gap, cooling.to_air)) continue;
      faces.of[side_of(faces, c.node, normal_of(c))][at(c.node)].add(
          through_film(cooling.to_tools, gap, cooling.to_air), *celsius);
    }
  }
}

void add_plies(const Scene& s, std::vector<Faces>& all) {
  const Cooling& cooling = *s.data.process.cooling;
  each_pass(s, [&](const PlyContact& pass) {
    const PlyBody &slave = s.plies[at(pass.slave)], &master = s.plies[at(pass.master)];
    Faces& faces = all[at(pass.slave)];
    for (const PlyPlyPoint& c : pass.contact.points) {
      const double gap = latest_gap(c);
      if (!covers(gap, cooling.to_air)) continue;
      const Triangle& t = master.membrane.triangles[at(c.face)];
      const std::array<double, 3> w = weights_of(c);
      double celsius = 0.0, other = 0.0; // T_b, C_b
      for (std::size_t j = 0; j < 3; ++j) {
        celsius += w[j] * master.temperature[at(t[j])];
        other += w[j] * all[at(pass.master)].capacity[at(t[j])];
      }
      const double own = faces.capacity[at(c.node)], both = own + other;
      const double mean = (own * slave.temperature[at(c.node)] + other * celsius) / both;
      const Vec3 normal = contact_normal(c, slave.x, master.x, master.membrane.triangles);
      faces.of[side_of(faces, c.node, normal)][at(c.node)].add(
          through_film(cooling.to_plies, gap, cooling.to_air) * both / other, mean);
    }
  });
}

/// (2) of the nodes of a ply over dt (s, of the process).
std::vector<double> cooled(const PlyBody& ply, const Faces& faces, double air, double surroundings,
                           double dt) {
  std::vector<double> celsius = ply.temperature;
  for (std::size_t n = 0; n < celsius.size(); ++n) {
    double h = 0.0, flow = 0.0;
    for (const std::vector<Face>& side : faces.of) {
      const Face& face = side[n];
      const double share = face.count > 0 ? 1.0 / face.count : 0.0;
      h += face.count > 0 ? share * face.conductance : air;
      flow += face.count > 0 ? share * face.flow : air * surroundings;
    }
    if (!(h > 0.0)) continue;
    const double target = flow / h, left = std::exp(-dt * h / faces.capacity[n]);
    celsius[n] = target + (celsius[n] - target) * left;
  }
  return celsius;
}

/// A law's factors of triangles, at the mean temperature of their nodes, in the kernel's order.
void find_factors(const PlyBody& ply, const TemperatureFactor& law, PackedStates& factors) {
  if (factors.empty()) return;
  std::vector<double> of;
  of.reserve(ply.membrane.triangles.size());
  for (const Triangle& t : ply.membrane.triangles) {
    double celsius = 0.0;
    for (const std::int32_t node : t)
      celsius += ply.temperature[at(node)] / 3.0;
    of.push_back(law.at(celsius));
  }
  pack(*ply.simd, ply.membrane, of, factors);
}

/// What the temperatures of a time (s) make of viscosities and of elastic shear.
void find_all_factors(PlyBody& ply, double time) {
  if (ply.flow_time == time) return;
  const TemperatureFactor& flow = ply.membrane.fabric.flow;
  find_factors(ply, flow, ply.flow_factors);
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
  if (!shear.empty()) ply.shear_heat += heat_of_shear(ply, shear);
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
    add_tools(s, at(p), middle, faces[at(p)]);
  });
  add_plies(s, faces);
  const double surroundings = temperature_at(cooling.surroundings, middle);
  pool.run(static_cast<int>(s.plies.size()), [&](int p) {
    celsius[at(p)] = cooled(s.plies[at(p)], faces[at(p)], cooling.to_air, surroundings, dt);
  });
  return celsius;
}

void update_temperatures(Scene& s, ThreadPool& pool) {
  if (s.data.process.cooling && s.step % temperatures_every == 0) {
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
