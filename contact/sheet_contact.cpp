// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sheet_contact.hpp"

#include "contact/point_triangle.hpp"

#include <limits>
#include <numeric>

namespace plyform {
namespace {

const Vec3& at(std::span<const Vec3> x, int n) {
  return x[static_cast<std::size_t>(n)];
}

bool share_a_node(const Triangle& a, const Triangle& b) {
  for (int i : a)
    for (int j : b)
      if (i == j) return true;
  return false;
}

/// Numbers the connected patches among a node's candidate faces: label[i] = smallest index of its
/// patch.
void label_patches(std::span<const Candidate> group, std::span<const Triangle> triangles,
                   std::vector<int>& label) {
  label.resize(group.size());
  std::iota(label.begin(), label.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < group.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (label[i] == label[j]) continue;
        if (!share_a_node(triangles[static_cast<std::size_t>(group[i].face)],
                          triangles[static_cast<std::size_t>(group[j].face)]))
          continue;
        label[i] = label[j] = std::min(label[i], label[j]);
        changed = true;
      }
  }
}

/// Area that one contact stands for: no more than the smaller of both sheets' node areas, so that
/// a coarse node does not overload the small nodes of a fine sheet. The master's is that at the
/// closest point: where faces meet, rounding says which of them is closest, and must not count.
double contact_area(const SheetState& slave, const SheetState& master, const SheetContactPoint& c,
                    const Triangle& face) {
  double there = 0.0;
  for (std::size_t j = 0; j < 3; ++j)
    there += c.w[j] * master.area[static_cast<std::size_t>(face[j])];
  return std::min(slave.area[static_cast<std::size_t>(c.node)], there);
}

/// Closest point over the faces of one contact. Returns the distance, mm.
double project(const SheetContact& contact, SheetContactPoint& c, const Vec3& p,
               std::span<const Vec3> x, std::span<const Triangle> triangles, int& feature) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = c.first_face; i < c.end_face; ++i) {
    const std::int32_t face = contact.faces[static_cast<std::size_t>(i)];
    const Triangle& t = triangles[static_cast<std::size_t>(face)];
    const ClosestPoint q = closest_point_on_triangle(p, at(x, t[0]), at(x, t[1]), at(x, t[2]));
    if (q.distance2 < best) {
      best = q.distance2;
      c.face = face;
      c.w = q.w;
      feature = q.feature;
    }
  }
  return std::sqrt(best);
}

/// Which side of its face the node is on. Known only above the inside of a face.
int side_of(const Vec3& p, const Triangle& t, std::span<const Vec3> x) {
  const Vec3 normal = (at(x, t[1]) - at(x, t[0])).cross(at(x, t[2]) - at(x, t[0]));
  return normal.dot(p - at(x, t[0])) >= 0.0 ? 1 : -1;
}

/// The old contact of this node whose last face is in the new patch, or null.
const SheetContactPoint* find_old(std::span<const SheetContactPoint> old, std::size_t& begin,
                                  const SheetContactPoint& now,
                                  std::span<const std::int32_t> faces) {
  while (begin < old.size() && old[begin].node < now.node)
    ++begin;
  for (std::size_t i = begin; i < old.size() && old[i].node == now.node; ++i)
    if (std::find(faces.begin() + now.first_face, faces.begin() + now.end_face, old[i].face) !=
        faces.begin() + now.end_face)
      return &old[i];
  return nullptr;
}

} // namespace

void find_sheet_points(SheetContact& contact, std::span<const Candidate> candidates,
                       const SheetState& slave, const SheetState& master,
                       std::span<const Triangle> triangles) {
  const std::vector<SheetContactPoint> old = std::move(contact.points);
  contact.points.clear();
  contact.faces.clear();
  contact.slave_force.assign(slave.x.size(), Vec3::Zero());
  contact.master_force.assign(master.x.size(), Vec3::Zero());
  std::vector<int> label;
  std::vector<char> adopted(old.size(), 0);
  std::size_t next_old = 0;
  for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
    while (end < candidates.size() && candidates[end].node == candidates[begin].node)
      ++end;
    const auto group = candidates.subspan(begin, end - begin);
    label_patches(group, triangles, label);
    for (std::size_t first = 0; first < group.size(); ++first) {
      if (label[first] != static_cast<int>(first)) continue;
      SheetContactPoint c{};
      c.node = group[first].node;
      c.first_face = static_cast<std::int32_t>(contact.faces.size());
      for (std::size_t i = first; i < group.size(); ++i)
        if (label[i] == label[first]) contact.faces.push_back(group[i].face);
      c.end_face = static_cast<std::int32_t>(contact.faces.size());
      const SheetContactPoint* before = find_old(old, next_old, c, contact.faces);
      int feature = 0;
      c.gap =
          project(contact, c, at(slave.x, c.node), master.x, triangles, feature) - contact.distance;
      c.area = contact_area(slave, master, c, triangles[static_cast<std::size_t>(c.face)]);
      if (before) {
        adopted[static_cast<std::size_t>(before - old.data())] = 1;
        c.memory = before->memory;
        c.side = before->side;
        c.area = before->area;
        c.gap = before->gap;
      }
      contact.points.push_back(c);
    }
  }
  for (std::size_t i = 0; i < old.size(); ++i) {
    ContactMemory memory = old[i].memory;
    if (!adopted[i]) release(contact.law, old[i].area, memory, contact.sums);
  }
}

void sheet_forces(SheetContact& contact, const SheetState& slave, const SheetState& master,
                  std::span<const Triangle> triangles, double dt) {
  if (contact.points.empty()) return;
  ContactSums& sums = contact.sums;
  const double k = contact.law.stiffness, h = contact.distance;
  sums.elastic = sums.penetration = 0.0;
  sums.touching = 0;
  std::fill(contact.slave_force.begin(), contact.slave_force.end(), Vec3::Zero());
  std::fill(contact.master_force.begin(), contact.master_force.end(), Vec3::Zero());
  for (SheetContactPoint& c : contact.points) {
    const Vec3& p = at(slave.x, c.node);
    int feature = 0;
    const double d = project(contact, c, p, master.x, triangles, feature);
    const double last_gap = c.gap, depth = h - d;
    c.gap = -depth;
    const Triangle& t = triangles[static_cast<std::size_t>(c.face)];
    const int side = feature == 0 ? side_of(p, t, master.x) : 0;
    if ((c.side * side < 0 && d < h) || d < 0.5 * h) contact.fault = {c.node, c.face, d};
    c.side = side; // forgotten on edges: a node may slide round the rim to the other side
    if (!(depth > 0.0)) {
      sums.damping +=
          0.5 * c.memory.damping_force * (last_gap - c.gap); // the trapezoid's last half
      c.memory.damping_force = 0.0;
      release(contact.law, c.area, c.memory, sums);
      continue;
    }
    const double dp = last_gap - c.gap;
    c.normal = (p - c.w[0] * at(master.x, t[0]) - c.w[1] * at(master.x, t[1]) -
                c.w[2] * at(master.x, t[2])) /
               d;
    const NormalForce normal =
        normal_force(contact.law, c.area, depth, depth + std::min(last_gap, 0.0), dt);
    sums.damping += 0.5 * (normal.damping + c.memory.damping_force) * dp;
    c.memory.damping_force = normal.damping;
    c.memory.normal_force = normal.total;
    const Vec3 motion = at(slave.motion, c.node) - c.w[0] * at(master.motion, t[0]) -
                        c.w[1] * at(master.motion, t[1]) - c.w[2] * at(master.motion, t[2]);
    const Vec3 f = normal.total * c.normal + friction_force(contact.law, c.area, normal.total,
                                                            c.normal, motion, c.memory, sums);
    contact.slave_force[static_cast<std::size_t>(c.node)] += f;
    for (std::size_t j = 0; j < 3; ++j)
      contact.master_force[static_cast<std::size_t>(t[j])] -= c.w[j] * f;
    sums.elastic += 0.5 * c.area * k * (depth * depth + c.memory.s.squaredNorm());
    sums.penetration = std::max(sums.penetration, depth);
    ++sums.touching;
  }
  sums.deepest = std::max(sums.deepest, sums.penetration);
}

void add_sheet_stiffness(const SheetContact& contact, std::span<const Triangle> triangles,
                         std::span<double> slave_rows, std::span<double> master_rows) {
  // The constraint's vector is G = (1, -w): row i has |G_i| sum_j |G_j| = 2 |G_i|.
  for (const SheetContactPoint& c : contact.points) {
    const double row = 2.0 * c.area * contact.law.stiffness;
    slave_rows[static_cast<std::size_t>(c.node)] += row;
    const Triangle& t = triangles[static_cast<std::size_t>(c.face)];
    for (std::size_t j = 0; j < 3; ++j)
      master_rows[static_cast<std::size_t>(t[j])] += c.w[j] * row;
  }
}

} // namespace plyform
