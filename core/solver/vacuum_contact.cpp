// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/solver/vacuum_contact.hpp"

#include "core/model/motion.hpp"

#include <algorithm>
#include <utility>

namespace plyform {
namespace {

bool presses(const Enclosure& e) {
  return e.load->side == PlyFace::below; // it pushes the lower one upwards
}

bool is_between(const Enclosure& e, int a, int b) {
  return std::minmax(e.lower, e.upper) == std::minmax(a, b);
}

/// N/mm^2 at time t, s.
double vacuum_at(const Case& data, const Enclosure& e, double t) {
  return presses(e) ? programme_value(e.load->stages(), t, data.solver.duration) : 0.0;
}

/// mm, between the faces at a point, where it was last seen to be closest.
double gap_at(const PlyPlyContact& contact, const PlyPlyPoint& point, const PlyBody& slave,
              const PlyBody& master) {
  const std::vector<Triangle>& triangles = master.membrane.triangles;
  const Triangle& t = triangles[at(point.face)];
  const std::array<double, 3> w = weights_of(point);
  Vec3 arm = slave.x[at(point.node)];
  for (std::size_t j = 0; j < 3; ++j)
    arm -= w[j] * master.x[at(t[j])];
  return arm.norm() - contact.distance * thickness_ratio_at(contact, point, slave.state(),
                                                            master.state(), triangles);
}

void renew_area(PlyBody& ply) {
  ply.area_now.assign(ply.x.size(), 0.0);
  for (const auto& [a, b, c] : ply.membrane.triangles) {
    const double third =
        (ply.x[at(b)] - ply.x[at(a)]).cross(ply.x[at(c)] - ply.x[at(a)]).norm() / 6.0;
    for (const int n : {a, b, c})
      ply.area_now[at(n)] += third;
  }
}

/// q: N/mm^2 now. up: the slave is the lower one, so that the air pushes it upwards.
void bear(PlyPlyContact& contact, double q, bool up, PlyBody& slave, const PlyBody& master) {
  contact.vacuum_before = std::exchange(contact.vacuum, q);
  for (const PlyPlyPoint& point : contact.points) {
    const double open = gap_at(contact, point, slave, master) / contact.vacuum_gap;
    const double borne = q * std::clamp(2.0 - open, 0.0, 1.0);
    double& load = slave.borne_load[at(point.node)]; // of a node's points the closest
    load = up ? std::max(load, borne) : std::min(load, -borne);
  }
}

} // namespace

double largest_vacuum(const Case& data, int a, int b) {
  double most = 0.0;
  for (const Enclosure& e : enclosures_of(data))
    if (presses(e) && is_between(e, a, b)) most += e.load->pressure;
  return most;
}

void bear_vacuums(Layup& layup, std::vector<PlyPair>& pairs) {
  const std::vector<Enclosure> enclosures = enclosures_of(layup.data);
  if (enclosures.empty()) return;
  for (const Enclosure& e : enclosures)
    for (const int p : {e.lower, e.upper}) {
      layup.plies[at(p)].borne_load.assign(layup.plies[at(p)].x.size(), 0.0);
      renew_area(layup.plies[at(p)]);
    }
  for (PlyPair& pair : pairs) {
    if (pair.passes[0].contact.vacuum_gap <= 0.0) continue;
    double q = 0.0;
    for (const Enclosure& e : enclosures)
      if (is_between(e, pair.a, pair.b)) q += vacuum_at(layup.data, e, layup.time);
    for (PlyContact& pass : pair.passes)
      bear(pass.contact, q, pass.slave == pair.a, layup.plies[at(pass.slave)],
           layup.plies[at(pass.master)]);
  }
}

void note_vacuum_stiffness(const std::vector<PlyPair>& pairs, std::vector<PlyBody>& plies) {
  for (const PlyPair& pair : pairs)
    if (const PlyPlyContact& contact = pair.passes[0].contact; contact.vacuum_gap > 0.0)
      for (const int p : {pair.a, pair.b})
        plies[at(p)].vacuum_stiffness += 2.0 * contact.law.stiffness; // of both passes
}

} // namespace plyform
