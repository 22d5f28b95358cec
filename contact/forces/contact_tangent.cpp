// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/contact_tangent.hpp"

namespace plyform {
namespace {

/// Sets the normal and tangential stiffness of a contact with this gap (mm) and tributary `area`
/// (mm^2). thickness: r of contact/forces/contact_law.hpp. An open one counts as just touching and
/// stuck: without its friction a stack of soft yarns gains energy when its plies meet.
void set_stiffness(ContactTangent& spring, const ContactLaw& law, double area, double gap,
                   double thickness, const TangentFactors& factors) {
  const ContactRow row = row_of(law, gap, thickness);
  spring.along = area * (factors.stiffness * row.stiffness + factors.damping * row.damping);
  if (law.rubs()) spring.across = area * factors.stiffness * law.tangential();
}

} // namespace

void append_tangents(const ToolPlyContact& contact, const SurfaceKinematics& ply, double margin,
                     const TangentFactors& factors, std::vector<ContactTangent>& springs) {
  for (const ToolPlyPoint& c : contact.points) {
    if (latest_gap(c) > margin + contact.law.sliding_gap) continue;
    ContactTangent spring;
    spring.node = {c.node};
    spring.share = {1.0};
    spring.normal = normal_of(c);
    set_stiffness(spring, contact.law, ply.area[c.node], latest_gap(c),
                  thickness_ratio_at(contact, ply, c.node), factors);
    springs.push_back(spring);
  }
}

void append_tangents(const PlyPlyContact& contact, const SurfaceKinematics& slave,
                     const SurfaceKinematics& master, std::span<const Triangle> triangles,
                     double margin, const TangentFactors& factors,
                     std::vector<ContactTangent>& springs) {
  for (const PlyPlyPoint& c : contact.points) {
    if (latest_gap(c) > margin + contact.law.sliding_gap) continue;
    const Triangle& t = triangles[c.face];
    const std::array<double, 3> w = weights_of(c);
    ContactTangent spring;
    spring.node = {c.node, t[0], t[1], t[2]};
    spring.share = {1.0, -w[0], -w[1], -w[2]};
    spring.nodes = 4;
    spring.normal = contact_normal(c, slave.x, master.x, triangles);
    const double thickness = thickness_ratio_at(contact, c, slave, master, triangles);
    set_stiffness(spring, contact.law, c.area, latest_gap(c), thickness, factors);
    if (spring.across > 0.0)
      spring.couple = {contact.distance * thickness * spring.normal,
                       face_frame(at(master.x, t[0]), at(master.x, t[1]), at(master.x, t[2]))};
    springs.push_back(spring);
  }
}

void append_tangents(const EdgeEdgeContact& contact, const SurfaceKinematics& a,
                     const SurfaceKinematics& b, double margin, const TangentFactors& factors,
                     std::vector<ContactTangent>& springs) {
  for (const EdgePair& pair : contact.pairs) {
    if (!within(contact, pair, margin)) continue;
    ContactTangent spring;
    spring.node = {pair.a.a, pair.a.b, pair.b.a, pair.b.b};
    spring.share = {1.0 - pair.s, pair.s, pair.t - 1.0, -pair.t};
    spring.own = 2;
    spring.nodes = 4;
    spring.normal =
        (at(a.x, pair.a.b) - at(a.x, pair.a.a)).cross(at(b.x, pair.b.b) - at(b.x, pair.b.a));
    spring.normal.normalize();
    set_stiffness(spring, contact.law, pair.area, pair.distance - contact.distance, 1.0, factors);
    spring.across = 0.0; // edge-edge contact has no friction
    springs.push_back(spring);
  }
}

void add_tangent_forces(std::span<const ContactTangent> springs, std::span<const Vec3> own_y,
                        std::span<const Vec3> other_y, std::span<Vec3> own_force,
                        std::span<Vec3> other_force) {
  for (const ContactTangent& s : springs) {
    const auto own = static_cast<std::size_t>(s.own), nodes = static_cast<std::size_t>(s.nodes);
    std::array<Vec3, 4> y;
    Vec3 displacement = Vec3::Zero();
    for (std::size_t i = 0; i < nodes; ++i) {
      y[i] = at(i < own ? own_y : other_y, s.node[i]);
      displacement += s.share[i] * y[i];
    }
    Vec3 slip = displacement;
    if (s.couple) slip -= face_turn(s.couple->face, {y[1], y[2], y[3]}).cross(s.couple->arm);
    slip -= s.normal.dot(slip) * s.normal;
    const Vec3 stuck = s.across * slip;
    const Vec3 force = s.along * s.normal.dot(displacement) * s.normal + stuck;
    for (std::size_t i = 0; i < nodes; ++i)
      (i < own ? own_force : other_force)[s.node[i]] += s.share[i] * force;
    if (!s.couple) continue;
    const auto turning = forces_of_couple(s.couple->face, -s.couple->arm.cross(stuck));
    for (std::size_t j = 0; j < 3; ++j)
      other_force[s.node[j + 1]] += turning[j];
  }
}

} // namespace plyform
