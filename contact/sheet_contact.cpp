// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/sheet_contact.hpp"

#include "contact/face_turn.hpp"
#include "contact/point_triangle.hpp"

#include <limits>
#include <numeric>

namespace plyform {
namespace {

/// Where faces meet they are as close as each other; the friction's couple goes to one of them, and
/// it must not be rounding that says which.
constexpr double tie = 1e-10; // of the square of the distance

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

/// What is closest to a node.
struct Closest {
  double distance; ///< mm
  int feature;     ///< of the face, see ClosestPoint
};

/// Closest point over the faces of one contact, of those that can be closer than the best one.
Closest project(const SheetContact& contact, SheetContactPoint& c, const Vec3& p,
                std::span<const Vec3> x, std::span<const Triangle> triangles, double way) {
  double best2 = std::numeric_limits<double>::max(), limit = best2;
  Closest found{0.0, 0};
  for (auto i = static_cast<std::size_t>(c.first_face); i < static_cast<std::size_t>(c.end_face);
       ++i) {
    if (contact.face_distance[i] > limit) break; // they are in ascending order
    const std::int32_t face = contact.faces[i];
    const Triangle& t = triangles[static_cast<std::size_t>(face)];
    const ClosestPoint q = closest_point_on_triangle(p, at(x, t[0]), at(x, t[1]), at(x, t[2]));
    const bool tied = std::abs(q.distance2 - best2) <= tie * best2;
    if (tied ? face < c.stand : q.distance2 < best2) c.stand = face;
    if (q.distance2 < best2) {
      best2 = q.distance2;
      limit = std::sqrt(best2) + way;
      c.face = face;
      c.w = q.w;
      found.feature = q.feature;
    }
  }
  found.distance = std::sqrt(best2);
  return found;
}

/// Which side of its face the node is on. Known only above the inside of a face.
int side_of(const Vec3& p, const Triangle& t, std::span<const Vec3> x) {
  const Vec3 normal = (at(x, t[1]) - at(x, t[0])).cross(at(x, t[2]) - at(x, t[0]));
  return normal.dot(p - at(x, t[0])) >= 0.0 ? 1 : -1;
}

/// A candidate face and the closest point on it when the search is done.
struct NearFace {
  std::int32_t face;
  double distance; ///< mm
  std::array<double, 3> w;
};

NearFace measure(const Candidate& c, std::span<const Vec3> slave_x, std::span<const Vec3> x,
                 std::span<const Triangle> triangles) {
  const Triangle& t = triangles[static_cast<std::size_t>(c.face)];
  const ClosestPoint q =
      closest_point_on_triangle(at(slave_x, c.node), at(x, t[0]), at(x, t[1]), at(x, t[2]));
  return {c.face, std::sqrt(q.distance2), q.w};
}

/// A contact of `node` with these faces, not touched yet.
SheetContactPoint add_faces(SheetContact& contact, std::int32_t node, std::vector<NearFace>& near) {
  std::sort(near.begin(), near.end(), [](const NearFace& a, const NearFace& b) {
    return std::pair(a.distance, a.face) < std::pair(b.distance, b.face);
  });
  SheetContactPoint c{};
  c.node = node;
  c.first_face = static_cast<std::int32_t>(contact.faces.size());
  for (const NearFace& n : near) {
    contact.faces.push_back(n.face);
    contact.face_distance.push_back(n.distance);
  }
  c.end_face = static_cast<std::int32_t>(contact.faces.size());
  c.face = c.stand = near.front().face;
  for (const NearFace& n : near)
    if (n.distance <= (1.0 + tie) * near.front().distance) c.stand = std::min(c.stand, n.face);
  c.w = near.front().w;
  c.slack = near.front().distance - contact.distance;
  c.gap = std::numeric_limits<double>::infinity();
  return c;
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
  contact.face_distance.clear();
  contact.slave_force.assign(slave.x.size(), Vec3::Zero());
  contact.master_force.assign(master.x.size(), Vec3::Zero());
  std::vector<int> label;
  std::vector<NearFace> near;
  std::vector<char> adopted(old.size(), 0);
  std::size_t next_old = 0;
  for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
    while (end < candidates.size() && candidates[end].node == candidates[begin].node)
      ++end;
    const auto group = candidates.subspan(begin, end - begin);
    label_patches(group, triangles, label);
    for (std::size_t first = 0; first < group.size(); ++first) {
      if (label[first] != static_cast<int>(first)) continue;
      near.clear();
      for (std::size_t i = first; i < group.size(); ++i)
        if (label[i] == label[first])
          near.push_back(measure(group[i], slave.x, master.x, triangles));
      SheetContactPoint c = add_faces(contact, group[first].node, near);
      c.area = contact_area(slave, master, c, triangles[static_cast<std::size_t>(c.face)]);
      if (const SheetContactPoint* before = find_old(old, next_old, c, contact.faces)) {
        adopted[static_cast<std::size_t>(before - old.data())] = 1;
        c.memory = before->memory;
        c.side = before->side;
        c.area = before->area;
        if (before->gap < 0.0) c.gap = before->gap, c.slack = std::min(c.slack, 0.0);
      }
      contact.points.push_back(c);
    }
  }
  for (std::size_t i = 0; i < old.size(); ++i) {
    ContactMemory memory = old[i].memory;
    if (!adopted[i]) release(contact.law, old[i].area, memory, contact.sums);
  }
}

namespace {

/// Adds a touching contact's forces on its node, its face t and the face that the arm stands on,
/// which is t or meets it at the closest point: (S), (N), (T), (M). last_gap: mm, of
/// the step before; infinite if unknown.
void add_forces(SheetContact& contact, SheetContactPoint& c, const SheetState& slave,
                const SheetState& master, const Triangle& t, const Triangle& stand, double last_gap,
                double dt) {
  ContactSums& sums = contact.sums;
  const std::array<Vec3, 3> x = {at(master.x, t[0]), at(master.x, t[1]), at(master.x, t[2])};
  const std::array<Vec3, 3> u = {at(master.motion, t[0]), at(master.motion, t[1]),
                                 at(master.motion, t[2])};
  const auto relative = [&c](const Vec3& of_node, const std::array<Vec3, 3>& of_face) -> Vec3 {
    return of_node - c.w[0] * of_face[0] - c.w[1] * of_face[1] - c.w[2] * of_face[2];
  };
  const Vec3 arm = relative(at(slave.x, c.node), x), motion = relative(at(slave.motion, c.node), u);
  const double depth = -c.gap;
  c.normal = arm / (contact.distance - depth);
  const double dp = std::isinf(last_gap) ? -c.normal.dot(motion) : last_gap - c.gap;
  const NormalForce normal =
      normal_force(contact.law, c.area, depth, depth + std::min(last_gap, 0.0), dt);
  sums.damping += 0.5 * (normal.damping + c.memory.damping_force) * dp;
  c.memory.damping_force = normal.damping;
  c.memory.normal_force = normal.total;
  Vec3 f = normal.total * c.normal;
  if (contact.law.friction > 0.0) {
    const FaceFrame frame =
        face_frame(at(master.x, stand[0]), at(master.x, stand[1]), at(master.x, stand[2]));
    const Vec3 turn = face_turn(frame, {at(master.motion, stand[0]), at(master.motion, stand[1]),
                                        at(master.motion, stand[2])});
    const Vec3 slip = motion - turn.cross(arm); // (P)
    c.memory.s += turn.cross(c.memory.s);
    const Vec3 tangential =
        friction_force(contact.law, c.area, normal.total, c.normal, slip, c.memory, sums);
    f += tangential;
    const std::array<Vec3, 3> couple = forces_of_couple(frame, -arm.cross(tangential)); // (M)
    for (std::size_t j = 0; j < 3; ++j)
      contact.master_force[static_cast<std::size_t>(stand[j])] += couple[j];
  }
  contact.slave_force[static_cast<std::size_t>(c.node)] += f;
  for (std::size_t j = 0; j < 3; ++j)
    contact.master_force[static_cast<std::size_t>(t[j])] -= c.w[j] * f;
  sums.elastic += spring_energy(contact.law, c.area, depth, c.memory);
  sums.penetration = std::max(sums.penetration, depth);
  ++sums.touching;
}

} // namespace

void sheet_forces(SheetContact& contact, const SheetState& slave, const SheetState& master,
                  std::span<const Triangle> triangles, double dt, double way) {
  if (contact.points.empty()) return;
  const Stopwatch watch(contact.time.forces);
  ContactSums& sums = contact.sums;
  const double h = contact.distance;
  sums.elastic = sums.penetration = 0.0;
  sums.touching = 0;
  std::fill(contact.slave_force.begin(), contact.slave_force.end(), Vec3::Zero());
  std::fill(contact.master_force.begin(), contact.master_force.end(), Vec3::Zero());
  for (SheetContactPoint& c : contact.points) {
    if (c.slack > way) continue;
    const Vec3& p = at(slave.x, c.node);
    const Closest closest = project(contact, c, p, master.x, triangles, way);
    const double d = closest.distance;
    const double last_gap = c.gap;
    c.gap = d - h;
    const Triangle& t = triangles[static_cast<std::size_t>(c.face)];
    const int side = closest.feature == 0 ? side_of(p, t, master.x) : 0;
    if ((c.side * side < 0 && d < h) || d < 0.5 * h) contact.fault = {c.node, c.face, d};
    c.side = side; // forgotten on edges: a node may slide round the rim to the other side
    if (!(c.gap < 0.0)) {
      if (c.memory.damping_force != 0.0) // the trapezoid's last half
        sums.damping += 0.5 * c.memory.damping_force * (last_gap - c.gap);
      c.memory.damping_force = 0.0;
      release(contact.law, c.area, c.memory, sums);
      continue;
    }
    add_forces(contact, c, slave, master, t, triangles[static_cast<std::size_t>(c.stand)], last_gap,
               dt);
  }
  sums.deepest = std::max(sums.deepest, sums.penetration);
}

void add_sheet_stiffness(const SheetContact& contact, const SheetState& master,
                         std::span<const Triangle> triangles, double margin,
                         std::span<double> slave_rows, std::span<double> master_rows) {
  // Normal: k G G^T with G = (1, -w), whose row i is |G_i| sum_j |G_j| = 2 |G_i|. Friction, with
  // half of k, along the face the same, and across it the couple's g_j = d |gradient_j|: with
  // G = G_w + G_g, G G^T <= 2 G_w G_w^T + 2 G_g G_g^T.
  for (const SheetContactPoint& c : contact.points) {
    if (std::min(c.gap, c.slack) > margin) continue;
    const Triangle& t = triangles[static_cast<std::size_t>(c.face)];
    const double normal = 2.0 * c.area * contact.law.stiffness;
    slave_rows[static_cast<std::size_t>(c.node)] += normal;
    if (contact.law.friction > 0.0) {
      std::array<double, 3> couple{};
      const Triangle& stand = triangles[static_cast<std::size_t>(c.stand)];
      const FaceFrame f =
          face_frame(at(master.x, stand[0]), at(master.x, stand[1]), at(master.x, stand[2]));
      double sum = 0.0;
      for (std::size_t j = 0; j < 3; ++j)
        sum += couple[j] = contact.distance * f.gradient[j].norm();
      for (std::size_t j = 0; j < 3; ++j)
        master_rows[static_cast<std::size_t>(stand[j])] +=
            2.0 * c.area * contact.law.tangential() * sum * couple[j];
    }
    for (std::size_t j = 0; j < 3; ++j)
      master_rows[static_cast<std::size_t>(t[j])] += c.w[j] * normal;
  }
}

} // namespace plyform
