// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/sliding_point.hpp"

#include "contact/simd/ply_ply_kernel.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Tributary area of a contact: the smaller of both sheets' nodal areas, so that a node of a coarse
/// sheet does not overload the small nodes of a fine one. The master's is interpolated at the
/// closest point, so that it does not depend on which of two equally close faces is taken.
double contact_area(const SurfaceKinematics& slave, const SurfaceKinematics& master,
                    const PlyPlyPoint& c, const Triangle& face) {
  const std::array<double, 3> w = weights_of(c);
  double master_area = 0.0;
  for (std::size_t j = 0; j < 3; ++j)
    master_area += w[j] * master.area[face[j]];
  return std::min(slave.area[c.node], master_area);
}

/// The area on which a film acts at a node: all of the node's own, which add up to that of its
/// sheet whatever the other's mesh, up to where a much finer one would be overloaded; at the
/// other's rim as of contact_area.
double film_area(const SurfaceKinematics& slave, const SurfaceKinematics& master,
                 const PlyPlyPoint& c, const Triangle& face) {
  constexpr double on_edge = 0.05, finer = 4.0; // of an element; -
  const double shared = contact_area(slave, master, c, face);
  if (master.faces_across.empty()) return shared;
  const std::array<double, 3> w = weights_of(c);
  for (std::size_t j = 0; j < 3; ++j)
    if (w[j] < on_edge && master.faces_across[static_cast<std::size_t>(c.face)][j] == no_face)
      return shared;
  return std::min(slave.area[c.node], finer * shared);
}

} // namespace

double area_of(const ContactLaw& law, const SurfaceKinematics& slave,
               const SurfaceKinematics& master, const PlyPlyPoint& c, const Triangle& face) {
  return law.has_film() ? film_area(slave, master, c, face) : contact_area(slave, master, c, face);
}

void keep_area(const PlyPlyPoint& before, const ContactLaw& law, PlyPlyPoint& c) {
  if (law.has_film() && c.area > 0.0)
    s_of(c.memory) *= before.area / c.area;
  else
    c.area = before.area;
}

double by_angle(const FrictionLaw& law, const PlyPlyPoint& point, const SurfaceKinematics& slave,
                const SurfaceKinematics& master, std::span<const Triangle> triangles) {
  if (slave.fibres.empty() || master.fibres.empty()) return 1.0;
  const std::array<double, 3> w = weights_of(point);
  const Triangle& t = triangles[static_cast<std::size_t>(point.face)];
  Vec3 other = Vec3::Zero();
  for (std::size_t j = 0; j < 3; ++j)
    other += w[j] * at(master.fibres, t[j]);
  const Vec3& own = at(slave.fibres, point.node);
  const double size = own.norm() * other.norm();
  if (!(size > 0.0)) return 1.0;
  return law.by_angle(std::acos(std::min(std::abs(own.dot(other)) / size, 1.0)));
}

} // namespace plyform
