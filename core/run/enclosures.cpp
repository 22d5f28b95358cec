// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/enclosures.hpp"

#include "base/format.hpp"
#include "base/node_normals.hpp"
#include "core/model/motion.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double deepest_dent = 0.25; // of the thickness: less is the depth of contact

// Of the push on one sheet: `check` lets borders differ by what meshes need, some hundredths.
constexpr double left_over = 0.05;

struct Face {
  Vec3 vector = Vec3::Zero(); ///< mm^2, its vector area
  Vec3 moment = Vec3::Zero(); ///< mm^3, the sum of r x dA
  double area = 0.0;          ///< mm^2
};

/// origin: mm, from which moments are taken.
Face face_of(const PlyBody& ply, const Vec3& origin) {
  Face face;
  for (const auto& [a, b, c] : ply.membrane.triangles) {
    const Vec3 &u = ply.x[at(a)], &v = ply.x[at(b)], &w = ply.x[at(c)];
    const Vec3 one = 0.5 * (v - u).cross(w - u);
    face.vector += one, face.area += one.norm();
    face.moment += ((u + v + w) / 3.0 - origin).cross(one);
  }
  return face;
}

bool holds(const Boundary& boundary, const Enclosure& e) {
  return boundary.is<SymmetryPlane>() &&
         (boundary.ply < 0 || boundary.ply == e.lower || boundary.ply == e.upper);
}

/// mm^2, over which the load pushes, or by half of a length of the sheet turns, without what
/// symmetry planes bear.
double unborne(const Case& data, const Enclosure& e, const Face& here, const Face& there) {
  Vec3 push = here.vector - there.vector;
  double turn = 2.0 * (here.moment - there.moment).norm() / std::sqrt(here.area);
  for (const Boundary& boundary : data.boundaries) {
    if (!holds(boundary, e)) continue;
    const Vec2 across = boundary.as<SymmetryPlane>().normal;
    const Vec3 normal(across.x(), across.y(), 0.0);
    push -= push.dot(normal) * normal;
    turn = 0.0; // planes bear most of it
  }
  return std::max(push.norm(), turn);
}

std::string doubt_of_borders(const Scene& s, const Enclosure& e) {
  const PlyBody &one = s.plies[at(e.lower)], &other = s.plies[at(e.upper)];
  const Vec3 middle = one.x.front();
  const Face here = face_of(one, middle), there = face_of(other, middle);
  const double net = unborne(s.data, e, here, there);
  if (net <= left_over * std::min(here.area, there.area)) return {};
  return fmt::format(
      "do not trust where {0} and {1} lie: their borders have parted, so that they "
      "enclose nothing, and the load between them pushes or turns them with {2:.3g} N "
      "that it cannot have; hold both borders in the same place",
      one.name, other.name, std::abs(e.load->pressure) * net);
}

/// The means of values over the nodes around each.
template <class T>
std::vector<T> means_around(const std::vector<Triangle>& triangles, const std::vector<T>& values,
                            T zero) {
  std::vector<T> sums(values.size(), zero);
  std::vector<int> counts(values.size(), 0);
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      for (const std::size_t j : {(i + 1) % 3, (i + 2) % 3})
        sums[at(t[i])] += values[at(t[j])], ++counts[at(t[i])];
  for (std::size_t n = 0; n < sums.size(); ++n)
    sums[n] /= std::max(counts[n], 1);
  return sums;
}

/// Of each node, whether it and those around it are inside the sheet: a clamp bends what is not.
std::vector<char> inner_nodes(const PlyBody& ply) {
  const std::vector<Triangle>& triangles = ply.membrane.triangles;
  std::vector<char> on_rim(ply.x.size(), 0), inner(ply.x.size(), 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t i = 0; i < 3; ++i)
      if (ply.edges.faces_across[t][i] == no_face)
        on_rim[at(triangles[t][(i + 1) % 3])] = on_rim[at(triangles[t][(i + 2) % 3])] = 1;
  for (const Triangle& t : triangles)
    if (std::any_of(t.begin(), t.end(), [&](int n) { return on_rim[at(n)]; }))
      for (const int n : t)
        inner[at(n)] = 0;
  return inner;
}

/// mm, by which each node stands out.
std::vector<double> dents_of(const PlyBody& ply) {
  const std::vector<Triangle>& triangles = ply.membrane.triangles;
  const std::vector<Vec3> normals = mean_normals(ply.x, triangles);
  const std::vector<Vec3> middles = means_around(triangles, ply.x, Vec3(Vec3::Zero()));
  std::vector<double> dents(ply.x.size());
  for (std::size_t n = 0; n < dents.size(); ++n)
    dents[n] = (ply.x[n] - middles[n]).dot(normals[n]);
  const std::vector<double> bent = means_around(triangles, dents, 0.0);
  for (std::size_t n = 0; n < dents.size(); ++n)
    dents[n] = std::abs(dents[n] - bent[n]);
  return dents;
}

/// mm over the thickness, of the nodes of one ply that another of a pair presses.
double deepest_dent_of(const Scene& s, int ply, int by) {
  const std::vector<double> dents = dents_of(s.plies[at(ply)]);
  const std::vector<char> inner = inner_nodes(s.plies[at(ply)]);
  double most = 0.0;
  for (const PlyPair& pair : s.ply_pairs)
    for (const PlyContact& pass : pair.passes) {
      if (pass.slave != ply || pass.master != by) continue;
      for (const PlyPlyPoint& point : pass.contact.points)
        if (latest_gap(point) < 0.0 && inner[at(point.node)])
          most = std::max(most, dents[at(point.node)]);
    }
  return most / s.plies[at(ply)].thickness;
}

std::string doubt_of_dents(const Scene& s, const Enclosure& e) {
  const PlyBody &one = s.plies[at(e.lower)], &other = s.plies[at(e.upper)];
  if (s.data.plies[at(e.lower)].blank == s.data.plies[at(e.upper)].blank) return {};
  const double most =
      std::max(deepest_dent_of(s, e.lower, e.upper), deepest_dent_of(s, e.upper, e.lower));
  if (most <= deepest_dent) return {};
  return fmt::format("do not trust the shape of {0} and {1} where they touch each other: single "
                     "nodes stand out by {2:.2g} of the thickness, as the load between them "
                     "presses sheets of different meshes unevenly; give both the same blank",
                     one.name, other.name, most);
}

} // namespace

std::vector<std::string> doubts_of_enclosures(const Scene& s) {
  std::vector<std::string> found;
  for (const Enclosure& enclosure : enclosures_of(s.data))
    for (auto* doubt : {&doubt_of_borders, &doubt_of_dents})
      if (std::string words = doubt(s, enclosure); !words.empty())
        found.push_back(std::move(words));
  return found;
}

} // namespace plyform
