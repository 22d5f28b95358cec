// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/forces/ply_ply.hpp"

#include "base/cpu_features.hpp"
#include "contact/forces/sliding_point.hpp"
#include "contact/simd/ply_ply_kernel.hpp"

#include <cstddef>
#include <limits>

namespace plyform {
namespace {

/// Whether one node is a corner of all these faces, which are then connected.
bool share_node(std::span<const Candidate> group, std::span<const Triangle> triangles) {
  const Triangle& t = triangles[group.front().face];
  int a = 1, b = 1, c = 1;
  for (const Candidate& n : group) {
    const auto [u, v, w] = triangles[n.face];
    a &= int(t[0] == u) | int(t[0] == v) | int(t[0] == w);
    b &= int(t[1] == u) | int(t[1] == v) | int(t[1] == w);
    c &= int(t[2] == u) | int(t[2] == v) | int(t[2] == w);
  }
  return (a | b | c) != 0;
}

/// Whether all these faces are connected by shared nodes, found by growing the connected component
/// of one of them. For more than 64 faces false is returned, and label_components decides.
bool one_component(std::span<const Candidate> group, std::span<const Triangle> triangles) {
  if (share_node(group, triangles)) return true;
  constexpr std::size_t most = 64;
  if (group.size() > most) return false;
  std::array<std::int32_t, 3 * most> corners; // of the component
  std::array<const Triangle*, most> outside;
  std::size_t met = 0, left = group.size();
  for (std::size_t i = 0; i < left; ++i)
    outside[i] = &triangles[group[i].face];
  const auto add = [&](const Triangle& t) {
    for (const std::int32_t n : t)
      corners[met++] = n;
  };
  add(*outside[--left]);
  for (std::size_t known = 0; known < met && left > 0; ++known)
    for (std::size_t i = left; i-- > 0;) {
      const Triangle& t = *outside[i];
      if (!(int(t[0] == corners[known]) | int(t[1] == corners[known]) |
            int(t[2] == corners[known])))
        continue;
      add(t);
      outside[i] = outside[--left];
    }
  return left == 0;
}

/// Labels the connected components of a node's candidate faces: label[i] = smallest index in the
/// component of face i.
void label_components(std::span<const Candidate> group, std::span<const Triangle> triangles,
                      std::vector<int>& label) {
  label.assign(group.size(), 0);
  if (one_component(group, triangles)) return;
  std::vector<std::pair<std::int32_t, int>> met; // nodes of the faces so far, and their component
  for (std::size_t i = 0; i < group.size(); ++i) {
    label[i] = static_cast<int>(i);
    const Triangle& t = triangles[group[i].face];
    for (const std::int32_t n : t)
      for (const auto& [node, component] : met)
        if (node == n) label[i] = std::min(label[i], component);
    for (const std::int32_t n : t) {
      const auto known =
          std::find_if(met.begin(), met.end(), [n](const auto& m) { return m.first == n; });
      if (known == met.end()) {
        met.emplace_back(n, label[i]);
      } else if (const int joined = known->second; joined != label[i]) { // joins two components
        for (auto& m : met)
          if (m.second == joined) m.second = label[i];
        for (std::size_t j = 0; j < i; ++j)
          if (label[j] == joined) label[j] = label[i];
      }
    }
  }
}

/// Deactivates a point that does not touch, and resets the side that it is on.
void deactivate(PlyPlyPoint& c) {
  c.gap_when_deactivated = static_cast<float>(c.gap);
  c.gap = std::numeric_limits<double>::infinity();
  c.side = 0;
}

/// A new, open contact point of a node with the faces of these candidates, which are sorted here.
PlyPlyPoint add_faces(PlyPlyContact& contact, std::vector<Candidate>& near,
                      const SurfaceKinematics& slave, const SurfaceKinematics& master,
                      std::span<const Triangle> triangles, double path_length) {
  std::sort(near.begin(), near.end(), [](const Candidate& a, const Candidate& b) {
    return std::pair(a.distance2, a.face) < std::pair(b.distance2, b.face);
  });
  PlyPlyPoint c{};
  c.node = near.front().node;
  c.first_face = static_cast<std::int32_t>(contact.faces.size());
  for (const Candidate& n : near) {
    contact.faces.push_back(n.face);
    contact.face_distance.push_back(rounded_down(std::sqrt(n.distance2)));
  }
  c.end_face = static_cast<std::int32_t>(contact.faces.size());
  const double tied = (1.0 + same_distance) * near.front().distance2;
  const Candidate* first = &near.front();
  for (const Candidate& n : near)
    if (n.distance2 <= tied && n.face < first->face) first = &n;
  c.face = first->face;
  c.w[0] = first->w[1], c.w[1] = first->w[2];
  c.other = distance_of_others(c, triangles.data()->data(), contact.faces.data(),
                               contact.face_distance.data());
  c.gap = std::sqrt(near.front().distance2) -
          contact.distance * thickness_ratio_at(contact, c, slave, master, triangles);
  contact.list.free_until.push_back(path_length + (c.gap - contact.law.sliding_gap));
  deactivate(c);
  return c;
}

/// The old contact point of this node whose last face is among the faces of the new one, or null.
const PlyPlyPoint* find_old(std::span<const PlyPlyPoint> old, std::size_t& begin,
                            const PlyPlyPoint& now, std::span<const std::int32_t> faces) {
  while (begin < old.size() && old[begin].node < now.node)
    ++begin;
  for (std::size_t i = begin; i < old.size() && old[i].node == now.node; ++i)
    if (std::find(faces.begin() + now.first_face, faces.begin() + now.end_face, old[i].face) !=
        faces.begin() + now.end_face)
      return &old[i];
  return nullptr;
}

/// Gives back what a list that has grown holds beyond an eighth more than it needs.
template <class T>
void trim(std::vector<T>& list) {
  if (list.capacity() > list.size() + list.size() / 8) list.shrink_to_fit();
}

} // namespace

double distance_of_others(const PlyPlyPoint& point, const std::int32_t* triangles,
                          const std::int32_t* faces, const float* face_distance) {
  const auto corners = [triangles](std::int32_t face) {
    return triangles + 3 * std::ptrdiff_t(face);
  };
  const std::int32_t* t = corners(point.face);
  for (std::int32_t i = point.first_face; i < point.end_face; ++i) {
    const std::int32_t* u = corners(faces[i]);
    if (std::find_first_of(t, t + 3, u, u + 3) == t + 3) return double{face_distance[i]};
  }
  return std::numeric_limits<double>::max(); // faces that are not listed cannot touch
}

double thickness_ratio_at(const PlyPlyContact& contact, const PlyPlyPoint& point,
                          const SurfaceKinematics& slave, const SurfaceKinematics& master,
                          std::span<const Triangle> triangles) {
  if (!contact.thickness_follows) return 1.0;
  const std::array<double, 3> w = weights_of(point);
  double other = 0.0;
  for (std::size_t j = 0; j < 3; ++j)
    other += w[j] * master.thickness_ratio[static_cast<std::size_t>(triangles[point.face][j])];
  return other + contact.slave_share *
                     (slave.thickness_ratio[static_cast<std::size_t>(point.node)] - other);
}

void find_ply_ply_points(PlyPlyContact& contact, std::span<const Candidate> candidates,
                         const SurfaceKinematics& slave, const SurfaceKinematics& master,
                         std::span<const Triangle> triangles, double path_length) {
  std::vector<PlyPlyPoint> old = std::move(contact.points);
  contact.points.clear();
  contact.points.reserve(old.size() + old.size() / 16);
  if (contact.law.unloading) contact.compacted.resize(slave.x.size(), 0.0);
  contact.faces.clear();
  contact.face_distance.clear();
  clear(contact.list);
  std::vector<int> label;
  std::vector<Candidate> near;
  std::vector<char> adopted(old.size(), 0);
  std::size_t next_old = 0;
  for (std::size_t begin = 0, end = 0; begin < candidates.size(); begin = end) {
    while (end < candidates.size() && candidates[end].node == candidates[begin].node)
      ++end;
    const auto group = candidates.subspan(begin, end - begin);
    label_components(group, triangles, label);
    for (std::size_t first = 0; first < group.size(); ++first) {
      if (label[first] != static_cast<int>(first)) continue;
      near.clear();
      for (std::size_t i = first; i < group.size(); ++i)
        if (label[i] == label[first]) near.push_back(group[i]);
      PlyPlyPoint c = add_faces(contact, near, slave, master, triangles, path_length);
      c.area = contact_area(slave, master, c, triangles[c.face]);
      if (const PlyPlyPoint* before = find_old(old, next_old, c, contact.faces)) {
        adopted[before - old.data()] = 1;
        c.memory = before->memory;
        c.kept = before->kept;
        c.side = before->side;
        c.area = before->area; // its springs store energy
        double& free_until = contact.list.free_until.back();
        if (before->gap < contact.law.sliding_gap)
          c.gap = before->gap, free_until = std::min(free_until, path_length);
      }
      if (contact.law.sliding)
        c.by_angle = by_angle(*contact.law.sliding, c, slave, master, triangles);
      contact.points.push_back(c);
    }
  }
  if (contact.law.has_film()) renew_film_areas(contact, slave, master, triangles);
  trim(contact.points);
  trim(contact.faces), trim(contact.face_distance), trim(contact.list.free_until);
  for (std::size_t i = 0; i < old.size(); ++i)
    if (!adopted[i]) release(contact.law, old[i].area, old[i].memory, contact.sums);
}

namespace {

/// Contact, sheets and motion of one call of the kernel, which its callbacks get as `self`.
struct KernelContext {
  PlyPlyContact& contact;
  const SurfaceKinematics &slave, &master;
  std::span<const Triangle> triangles;
  RelativeMotion moved;
  std::span<Vec3> slave_force, master_force;
};

KernelContext& of(void* self) {
  return *static_cast<KernelContext*>(self);
}

PlyPlyPoint& point_of(KernelContext& k, std::int32_t point) {
  return k.contact.points[point];
}

void open_point(void* self, std::int32_t point, double last_gap) {
  KernelContext& k = of(self);
  PlyPlyPoint& c = point_of(k, point);
  if (c.memory.damping_force != 0.0) // last half step of the trapezoidal rule for its work
    k.contact.sums.damping += 0.5 * c.memory.damping_force * (last_gap - c.gap);
  c.memory.damping_force = 0.0;
  release(k.contact.law, c.area, c.memory, k.contact.sums);
}

void fault_at(void* self, std::int32_t point, double distance) {
  KernelContext& k = of(self);
  const PlyPlyPoint& c = point_of(k, point);
  k.contact.fault = {c.node, c.face, distance};
}

PlyPlyKernelContact kernel_view(KernelContext& k, double dt) {
  PlyPlyContact& c = k.contact;
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(std::int32_t));
  PlyPlyKernelContact view{};
  static_cast<ContactKernelLaw&>(view) = kernel_law(c.law, dt);
  view.points = c.points.data();
  view.active = c.list.active.data();
  view.active_count = static_cast<int>(c.list.active.size());
  view.free_until = c.list.free_until.data();
  view.slave_x = k.slave.x.data()->data();
  view.slave_motion = k.slave.motion.data()->data();
  view.master_x = k.master.x.data()->data();
  view.master_motion = k.master.motion.data()->data();
  view.faces = c.faces.data();
  view.face_distance = c.face_distance.data();
  if (!k.master.fold_bound.empty()) {
    view.fold_bound = k.master.fold_bound.data();
    view.faces_across = k.master.faces_across.data()->data();
  }
  view.max_displacement = k.moved.max_displacement;
  view.path_length = k.moved.path_length;
  view.triangles = k.triangles.data()->data();
  view.slave_force = k.slave_force.data()->data();
  view.master_force = k.master_force.data()->data();
  view.distance = c.distance;
  if (c.thickness_follows) {
    view.slave_ratio = k.slave.thickness_ratio.data();
    view.master_ratio = k.master.thickness_ratio.data();
    view.slave_share = c.slave_share;
  }
  view.compacted = c.compacted.empty() ? nullptr : c.compacted.data();
  view.per_vacuum_gap = c.vacuum_gap > 0.0 ? 1.0 / c.vacuum_gap : 0.0;
  view.slave_area = k.slave.area_now.data(), view.master_area = k.master.area_now.data();
  view.vacuum = c.vacuum, view.vacuum_before = c.vacuum_before;
  if (c.law.by_temperature() && !k.slave.temperature.empty() && !k.master.temperature.empty()) {
    view.slave_celsius = k.slave.temperature.data();
    view.master_celsius = k.master.temperature.data();
  }
  view.self = &k;
  view.open = open_point;
  view.fault = fault_at;
  return view;
}

} // namespace

void ply_ply_forces(PlyPlyContact& contact, const SurfaceKinematics& slave,
                    const SurfaceKinematics& master, std::span<const Triangle> triangles, double dt,
                    const RelativeMotion& moved, std::span<Vec3> slave_force,
                    std::span<Vec3> master_force) {
  const Stopwatch watch(contact.time.forces);
  update(contact.list, moved.path_length, contact.distance, NoRoom{},
         [&contact](std::int32_t i) { deactivate(contact.points[i]); });
  clear_present(contact.sums);
  if (contact.list.active.empty()) return;
  KernelContext side{contact, slave, master, triangles, moved, slave_force, master_force};
  const auto run = fastest(ply_ply_kernel_generic, ply_ply_kernel_avx2, ply_ply_kernel_avx512);
  PlyPlyKernelContact view = kernel_view(side, dt);
  std::optional<SlidingCall> call;
  if (contact.law.sliding) call.emplace(contact.law, dt);
  ask(view, call);
  const PlyPlyKernelTotals added = run(view);
  ContactTotals& sums = contact.sums;
  sums.elastic = added.elastic;
  sums.friction += added.friction;
  sums.damping += added.damping;
  sums.compaction += added.compaction;
  sums.vacuum += added.vacuum;
  sums.penetration = added.penetration;
  sums.slip = std::max(sums.slip, added.slip);
  sums.touching = added.touching;
  sums.step_ratio = added.step_ratio;
  sums.deepest = std::max(sums.deepest, sums.penetration);
  if (call) sums.sliding.add(call->seen);
}

Vec3 contact_normal(const PlyPlyPoint& point, std::span<const Vec3> slave,
                    std::span<const Vec3> master, std::span<const Triangle> triangles) {
  const Triangle& t = triangles[point.face];
  const std::array<double, 3> w = weights_of(point);
  return (at(slave, point.node) -
          (w[0] * at(master, t[0]) + w[1] * at(master, t[1]) + w[2] * at(master, t[2])))
      .normalized();
}

void add_ply_ply_stiffness(const PlyPlyContact& contact, const SurfaceKinematics& slave,
                           const SurfaceKinematics& master, std::span<const Triangle> triangles,
                           double margin, std::span<ContactRow> slave_rows,
                           std::span<ContactRow> master_rows) {
  // Normal stiffness: k G G^T with G = (1, -w), whose row i has the absolute sum
  // |G_i| sum_j |G_j| = 2 |G_i|. Tangential stiffness k_t = k / 2: G = G_w + G_g, with G_w = (1,
  // -w) and the couple's G_g of entries h |gradient_j|, the side opposite to corner j over twice
  // the area; as G G^T <= 2 G_w G_w^T + 2 G_g G_g^T, its G_w part is bounded by the normal one and
  // the G_g part is added here.
  for (const PlyPlyPoint& c : contact.points) {
    if (latest_gap(c) > margin + contact.law.sliding_gap) continue;
    const Triangle& t = triangles[c.face];
    const double thickness = thickness_ratio_at(contact, c, slave, master, triangles);
    const ContactRow normal = 2.0 * c.area * row_of(contact.law, latest_gap(c), thickness);
    slave_rows[c.node] += normal;
    if (contact.law.rubs()) {
      const Vec3 &p = at(master.x, t[0]), &q = at(master.x, t[1]), &r = at(master.x, t[2]);
      const std::array<double, 3> side{(r - q).norm(), (p - r).norm(), (q - p).norm()};
      const double per_side2 =
          std::pow(contact.distance * thickness, 2) / (q - p).cross(r - p).squaredNorm();
      const double each =
          2.0 * c.area * contact.law.tangential() * per_side2 * (side[0] + side[1] + side[2]);
      for (std::size_t j = 0; j < 3; ++j)
        master_rows[t[j]].stiffness += each * side[j];
    }
    const std::array<double, 3> w = weights_of(c);
    for (std::size_t j = 0; j < 3; ++j)
      master_rows[t[j]] += w[j] * normal;
  }
}

} // namespace plyform
