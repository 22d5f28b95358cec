// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bending.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>

namespace plyform {
namespace {

using Matrix = Eigen::MatrixXd;

/// Neighbours of a triangle: those that share a side.
std::vector<std::array<int, 3>> neighbours_of(const std::vector<Triangle>& triangles) {
  std::map<std::pair<int, int>, int> sides; // side, as walked, to its triangle
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k)
      sides[{triangles[e][k], triangles[e][(k + 1) % 3]}] = static_cast<int>(e);
  std::vector<std::array<int, 3>> found(triangles.size());
  for (std::size_t e = 0; e < triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto it = sides.find({triangles[e][(k + 1) % 3], triangles[e][k]});
      found[e][k] = it == sides.end() ? -1 : it->second;
    }
  return found;
}

/// Adds the triangles around those of `patch`, and their nodes.
void grow(std::vector<int>& patch, std::vector<int>& nodes, const std::vector<Triangle>& triangles,
          const std::vector<std::array<int, 3>>& neighbours) {
  const std::vector<int> inner = patch;
  for (const int e : inner)
    for (const int other : neighbours[static_cast<std::size_t>(e)]) {
      if (other < 0 || std::find(patch.begin(), patch.end(), other) != patch.end()) continue;
      patch.push_back(other);
      for (const int n : triangles[static_cast<std::size_t>(other)])
        if (std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
    }
}

/// 1, r, s, r^2/2, s^2/2, r s at each node, r and s from the middle of the triangle in units of
/// `size`.
Matrix monomials(std::span<const Vec2> x, const std::vector<int>& nodes, const Vec2& middle,
                 double size) {
  Matrix p(static_cast<Eigen::Index>(nodes.size()), 6);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 r = (x[static_cast<std::size_t>(nodes[i])] - middle) / size;
    p.row(static_cast<Eigen::Index>(i)) << 1.0, r.x(), r.y(), 0.5 * r.x() * r.x(),
        0.5 * r.y() * r.y(), r.x() * r.y();
  }
  return p;
}

/// Whether the nodes fix a quadratic well: ratio of singular values.
bool sound(const Eigen::JacobiSVD<Matrix>& svd) {
  constexpr double least = 0.02; // a regular patch has 0.1 to 0.2
  const auto& s = svd.singularValues();
  return s.size() == 6 && s[5] > least * s[0];
}

/// Second derivatives along `a` and `b` from the pseudo-inverse's rows for r^2/2, s^2/2 and r s.
double derivative(const Matrix& inverse, Eigen::Index column, const Vec2& a, const Vec2& b) {
  return a.x() * b.x() * inverse(3, column) + a.y() * b.y() * inverse(4, column) +
         (a.x() * b.y() + a.y() * b.x()) * inverse(5, column);
}

/// Nodes and constants of one patch, added to `bending`.
void fit_patch(Bending& bending, std::span<const Vec2> x, int triangle,
               const std::vector<std::array<int, 3>>& neighbours, const Vec2& warp,
               const Vec2& weft) {
  const Triangle& t = bending.triangles[static_cast<std::size_t>(triangle)];
  std::vector<int> patch{triangle}, nodes{t[0], t[1], t[2]};
  const auto at = [&](int n) -> const Vec2& { return x[static_cast<std::size_t>(n)]; };
  const Vec2 middle = (at(t[0]) + at(t[1]) + at(t[2])) / 3.0;
  const double size = std::sqrt(bending.area[static_cast<std::size_t>(triangle)]);
  Eigen::JacobiSVD<Matrix> svd;
  constexpr int most_rings = 3; // a mesh of a few triangles may fix no quadratic at all
  for (int ring = 0; ring < most_rings; ++ring) {
    grow(patch, nodes, bending.triangles, neighbours);
    svd.compute(monomials(x, nodes, middle, size), Eigen::ComputeThinU | Eigen::ComputeThinV);
    if (sound(svd)) break;
  }
  svd.setThreshold(1e-6); // what the nodes do not fix is taken as flat
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const Matrix inverse = svd.solve(Matrix::Identity(count, count)) / (size * size);
  const std::size_t first = bending.b.size();
  for (Eigen::Index i = 0; i < count; ++i)
    bending.b.push_back({derivative(inverse, i, warp, warp), derivative(inverse, i, weft, weft),
                         derivative(inverse, i, warp, weft)});
  for (std::size_t k = 0; k < 3; ++k) { // no force from a shift, to the last bit
    double sum = 0.0;
    for (std::size_t i = first + 1; i < bending.b.size(); ++i)
      sum += bending.b[i][k];
    bending.b[first][k] = -sum;
  }
  bending.node.insert(bending.node.end(), nodes.begin(), nodes.end());
  bending.begin.push_back(static_cast<std::int32_t>(bending.node.size()));
}

void build_gather(Bending& b, std::size_t nodes) {
  b.gather_begin.assign(nodes + 1, 0);
  for (const std::int32_t n : b.node)
    ++b.gather_begin[static_cast<std::size_t>(n) + 1];
  for (std::size_t n = 0; n < nodes; ++n)
    b.gather_begin[n + 1] += b.gather_begin[n];
  b.gather.resize(b.node.size());
  std::vector<std::int32_t> next(b.gather_begin.begin(), b.gather_begin.end() - 1);
  for (std::size_t i = 0; i < b.node.size(); ++i)
    b.gather[static_cast<std::size_t>(next[static_cast<std::size_t>(b.node[i])]++)] =
        static_cast<std::int32_t>(i);
}

/// Irons' bound with each node's mass shared out evenly among its patches: no patch's largest
/// eigenvalue, at most the trace of M_e^-1 K_e, is exceeded by the mesh.
double bound(const Bending& b, std::span<const double> node_mass) {
  const double coupling = std::abs(b.law.coupling);
  const double d[3] = {b.law.warp.largest_slope() + coupling, b.law.weft.largest_slope() + coupling,
                       b.law.twist};
  double largest = 0.0;
  for (std::size_t e = 0; e < b.triangles.size(); ++e) {
    double trace = 0.0;
    for (auto i = static_cast<std::size_t>(b.begin[e]);
         i < static_cast<std::size_t>(b.begin[e + 1]); ++i) {
      const auto n = static_cast<std::size_t>(b.node[i]);
      const double patches = b.gather_begin[n + 1] - b.gather_begin[n];
      for (std::size_t k = 0; k < 3; ++k)
        trace += b.area[e] * d[k] * b.b[i][k] * b.b[i][k] * patches / node_mass[n];
    }
    largest = std::max(largest, trace);
  }
  return largest;
}

/// Normal and second derivatives of one triangle.
struct PatchShape {
  Vec3 g1, g2, normal;
  double twice_area;
  std::array<Vec3, 3> second; ///< 11, 22, 12, 1/mm
  std::array<double, 3> kappa;
};

PatchShape shape_of(const Bending& b, std::span<const Vec3> x, std::size_t e) {
  const Triangle& t = b.triangles[e];
  const Vec3& x0 = x[static_cast<std::size_t>(t[0])];
  PatchShape s;
  s.g1 = x[static_cast<std::size_t>(t[1])] - x0;
  s.g2 = x[static_cast<std::size_t>(t[2])] - x0;
  s.normal = s.g1.cross(s.g2);
  s.twice_area = s.normal.norm();
  s.normal /= s.twice_area;
  s.second.fill(Vec3::Zero());
  for (auto i = static_cast<std::size_t>(b.begin[e]); i < static_cast<std::size_t>(b.begin[e + 1]);
       ++i) {
    const Vec3 from = x[static_cast<std::size_t>(b.node[i])] - x0; // small numbers: less rounding
    for (std::size_t k = 0; k < 3; ++k)
      s.second[k] += b.b[i][k] * from;
  }
  for (std::size_t k = 0; k < 3; ++k)
    s.kappa[k] = s.normal.dot(s.second[k]); // (K)
  return s;
}

/// (M)
std::array<double, 3> moments(const BendingLaw& law, const std::array<double, 3>& kappa) {
  return {law.warp.at(kappa[0]).value + law.coupling * kappa[1],
          law.weft.at(kappa[1]).value + law.coupling * kappa[0], law.twist * kappa[2]};
}

} // namespace

Bending make_bending(std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                     const BendingLaw& law, double warp, double weft,
                     std::span<const double> node_mass) {
  Bending b;
  b.law = law;
  b.triangles = triangles;
  b.begin = {0};
  for (const Triangle& t : triangles) {
    const Vec2 g1 = x[static_cast<std::size_t>(t[1])] - x[static_cast<std::size_t>(t[0])];
    const Vec2 g2 = x[static_cast<std::size_t>(t[2])] - x[static_cast<std::size_t>(t[0])];
    b.area.push_back(0.5 * (g1.x() * g2.y() - g1.y() * g2.x()));
  }
  const auto neighbours = neighbours_of(triangles);
  const Vec2 e1(std::cos(warp), std::sin(warp)), e2(std::cos(weft), std::sin(weft));
  for (std::size_t e = 0; e < triangles.size(); ++e)
    fit_patch(b, x, static_cast<int>(e), neighbours, e1, e2);
  b.force.assign(b.node.size(), Vec3::Zero());
  build_gather(b, x.size());
  b.omega2 = bound(b, node_mass);
  return b;
}

std::array<double, 3> curvatures(const Bending& b, std::span<const Vec3> x, int triangle) {
  return shape_of(b, x, static_cast<std::size_t>(triangle)).kappa;
}

void bending_forces(Bending& b, std::span<const Vec3> x, int begin, int end) {
  for (auto e = static_cast<std::size_t>(begin); e < static_cast<std::size_t>(end); ++e) {
    const PatchShape s = shape_of(b, x, e);
    const std::array<double, 3> m = moments(b.law, s.kappa);
    const Vec3 h = m[0] * s.second[0] + m[1] * s.second[1] + m[2] * s.second[2];
    const Vec3 along = (h - h.dot(s.normal) * s.normal) / s.twice_area; // h_t / |g1 x g2|
    const Vec3 turn1 = s.g2.cross(along), turn2 = along.cross(s.g1);    // dn/dx . h_t
    const auto first = static_cast<std::size_t>(b.begin[e]);
    for (std::size_t i = first; i < static_cast<std::size_t>(b.begin[e + 1]); ++i)
      b.force[i] =
          -b.area[e] * (m[0] * b.b[i][0] + m[1] * b.b[i][1] + m[2] * b.b[i][2]) * s.normal; // (F)
    b.force[first] += b.area[e] * (turn1 + turn2);
    b.force[first + 1] -= b.area[e] * turn1;
    b.force[first + 2] -= b.area[e] * turn2;
  }
}

Vec3 bending_force(const Bending& b, int node) {
  Vec3 f = Vec3::Zero();
  const auto n = static_cast<std::size_t>(node);
  for (auto i = static_cast<std::size_t>(b.gather_begin[n]);
       i < static_cast<std::size_t>(b.gather_begin[n + 1]); ++i)
    f += b.force[static_cast<std::size_t>(b.gather[i])];
  return f;
}

double bending_energy(const Bending& b, std::span<const Vec3> x) {
  double sum = 0.0;
  for (std::size_t e = 0; e < b.triangles.size(); ++e) {
    const std::array<double, 3> k = shape_of(b, x, e).kappa;
    sum += b.area[e] * (b.law.warp.at(k[0]).energy + b.law.weft.at(k[1]).energy +
                        b.law.coupling * k[0] * k[1] + 0.5 * b.law.twist * k[2] * k[2]); // (E)
  }
  return sum;
}

} // namespace plyform
