// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/bending.hpp"

#include "core/gather.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Matrix = Eigen::MatrixXd;

/// Adds the nodes that share a triangle with those of `nodes`.
void grow(std::vector<int>& nodes, const std::vector<Triangle>& triangles,
          const std::vector<std::vector<int>>& around) {
  const std::vector<int> inner = nodes;
  for (const int n : inner)
    for (const int e : around[static_cast<std::size_t>(n)])
      for (const int other : triangles[static_cast<std::size_t>(e)])
        if (std::find(nodes.begin(), nodes.end(), other) == nodes.end()) nodes.push_back(other);
}

/// 1, r, s, r^2/2, s^2/2, r s at each node, r and s from the patch's own node in units of `size`,
/// along e1 and at right angles to it.
Matrix monomials(std::span<const Vec2> x, const std::vector<int>& nodes, double size,
                 const Vec2& e1) {
  Matrix p(static_cast<Eigen::Index>(nodes.size()), 6);
  const Vec2& middle = x[static_cast<std::size_t>(nodes[0])];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 d = (x[static_cast<std::size_t>(nodes[i])] - middle) / size;
    const double r = d.dot(e1), s = e1.x() * d.y() - e1.y() * d.x();
    p.row(static_cast<Eigen::Index>(i)) << 1.0, r, s, 0.5 * r * r, 0.5 * s * s, r * s;
  }
  return p;
}

/// Second derivatives (11, 22, 12 along e1 and across) per value at each node, in units of size^2.
Matrix interior_fit(std::span<const Vec2> x, std::vector<int>& nodes, double size, const Vec2& e1,
                    const std::vector<Triangle>& triangles,
                    const std::vector<std::vector<int>>& around) {
  constexpr double sound = 0.002; // ratio of singular values; a regular patch has 0.01 to 0.1
  for (int more = 0;; ++more) {
    // Nearer nodes decide: averages over rows of nodes would let the rows bend in turns, and a
    // strip of alternating diagonals sagged by 1.3 to 1.8 times theory without weights.
    Eigen::VectorXd weight = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const Vec2 d = x[static_cast<std::size_t>(nodes[i])] - x[static_cast<std::size_t>(nodes[0])];
      const double near = std::min(1.0, size * size / d.squaredNorm());
      weight[static_cast<Eigen::Index>(i)] = near * near * near * near;
    }
    Eigen::JacobiSVD<Matrix> svd(weight.asDiagonal() * monomials(x, nodes, size, e1),
                                 Eigen::ComputeThinU | Eigen::ComputeThinV);
    const auto& s = svd.singularValues();
    if ((s.size() < 6 || s[5] < sound * s[0]) && more < 2) {
      grow(nodes, triangles, around);
      continue;
    }
    svd.setThreshold(1e-6); // what the nodes of a tiny mesh do not fix is taken as flat
    return svd.solve(Matrix(weight.asDiagonal())).bottomRows(3);
  }
}

/// The two neighbours of a node along the rim, or none for an inner node.
std::vector<int> rim_neighbours(int node, const std::vector<int>& nodes,
                                const std::vector<Triangle>& triangles,
                                const std::vector<int>& around) {
  std::vector<int> rim;
  for (const int n : nodes) {
    const auto has = [&](int e) {
      const Triangle& t = triangles[static_cast<std::size_t>(e)];
      return std::find(t.begin(), t.end(), n) != t.end();
    };
    if (n != node && std::count_if(around.begin(), around.end(), has) == 1) rim.push_back(n);
  }
  return rim;
}

/// On the rim only the curvature along it is known; across it the moment of a free edge is zero, so
/// that it takes no part in the energy. At corners there is none.
Matrix rim_fit(std::span<const Vec2> x, const std::vector<int>& nodes, double size, const Vec2& e1,
               const std::vector<int>& rim) {
  Matrix fit = Matrix::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  if (rim.size() != 2) return fit;
  const Vec2& middle = x[static_cast<std::size_t>(nodes[0])];
  const Vec2 a = x[static_cast<std::size_t>(rim[0])] - middle;
  const Vec2 b = x[static_cast<std::size_t>(rim[1])] - middle;
  constexpr double straight = 0.9; // cosine: the rim turns by less than 26 degrees here
  if (a.dot(b) > -straight * a.norm() * b.norm()) return fit;
  const Vec2 along = (b - a).normalized();
  Eigen::JacobiSVD<Matrix> svd(monomials(x, nodes, size, along).leftCols(4),
                               Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const Matrix curvature = svd.solve(Matrix::Identity(count, count)).bottomRows(1);
  const double c = along.dot(e1), s = e1.x() * along.y() - e1.y() * along.x();
  fit << c * c * curvature, s * s * curvature, c * s * curvature;
  return fit;
}

/// Nodes and constants of one node's patch, added to `bending`.
void fit_patch(Bending& bending, std::span<const Vec2> x, int node,
               const std::vector<Triangle>& triangles, const std::vector<std::vector<int>>& around,
               const Vec2& warp, double fibre_angle) {
  std::vector<int> nodes{node};
  const auto own = static_cast<std::size_t>(node);
  const double size = std::sqrt(bending.area[own]);
  grow(nodes, triangles, around);
  const std::vector<int> rim = rim_neighbours(node, nodes, triangles, around[own]);
  const Matrix fit = (rim.empty() ? interior_fit(x, nodes, size, warp, triangles, around)
                                  : rim_fit(x, nodes, size, warp, rim)) /
                     (size * size);
  for (const int e : around[own]) {
    Triangle places;
    for (std::size_t k = 0; k < 3; ++k)
      places[k] = static_cast<std::int32_t>(
          std::find(nodes.begin(), nodes.end(), triangles[static_cast<std::size_t>(e)][k]) -
          nodes.begin());
    bending.fan.push_back(places);
  }
  bending.fan_begin.push_back(static_cast<std::int32_t>(bending.fan.size()));
  const double c = std::cos(fibre_angle), s = std::sin(fibre_angle);
  const std::size_t first = bending.b.size();
  for (Eigen::Index i = 0; i < fit.cols(); ++i)
    bending.b.push_back({fit(0, i), c * c * fit(0, i) + s * s * fit(1, i) + 2.0 * c * s * fit(2, i),
                         c * fit(0, i) + s * fit(2, i)});
  for (std::size_t k = 0; k < 3; ++k) { // no force from a shift, to the last bit
    double sum = 0.0;
    for (std::size_t i = first + 1; i < bending.b.size(); ++i)
      sum += bending.b[i][k];
    bending.b[first][k] = -sum;
  }
  bending.node.insert(bending.node.end(), nodes.begin(), nodes.end());
  bending.begin.push_back(static_cast<std::int32_t>(bending.node.size()));
}

/// Irons' bound with each node's mass shared out evenly among its patches: the mesh does
/// not exceed the largest eigenvalue of any patch, at most the trace of M_e^-1 K_e.
double bound(const Bending& b, std::span<const double> node_mass) {
  const double coupling = std::abs(b.law.coupling);
  const double d[3] = {b.law.warp.largest_slope() + coupling, b.law.weft.largest_slope() + coupling,
                       b.law.twist};
  double largest = 0.0;
  for (std::size_t e = 0; e < b.area.size(); ++e) {
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

/// Normal and second derivatives at one node.
struct PatchShape {
  Vec3 normal;
  double size;                ///< |N|
  std::array<Vec3, 3> second; ///< 11, 22, 12, 1/mm
  std::array<double, 3> kappa;
};

PatchShape shape_of(const Bending& b, std::span<const Vec3> x, std::size_t patch) {
  const auto first = static_cast<std::size_t>(b.begin[patch]);
  const auto at = [&](std::size_t place) -> const Vec3& {
    return x[static_cast<std::size_t>(b.node[first + place])];
  };
  PatchShape s;
  s.normal.setZero();
  for (auto i = static_cast<std::size_t>(b.fan_begin[patch]);
       i < static_cast<std::size_t>(b.fan_begin[patch + 1]); ++i) {
    const auto& [p, q, r] = b.fan[i];
    const Vec3& x0 = at(static_cast<std::size_t>(p));
    s.normal += (at(static_cast<std::size_t>(q)) - x0).cross(at(static_cast<std::size_t>(r)) - x0);
  }
  s.size = s.normal.norm();
  s.normal /= s.size;
  s.second.fill(Vec3::Zero());
  for (std::size_t i = first; i < static_cast<std::size_t>(b.begin[patch + 1]); ++i) {
    const Vec3 from = at(i - first) - at(0); // small numbers: less rounding
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
  b.begin = b.fan_begin = {0};
  b.area.assign(x.size(), 0.0);
  std::vector<std::vector<int>> around(x.size());
  for (std::size_t e = 0; e < triangles.size(); ++e) {
    const Triangle& t = triangles[e];
    const Vec2 g1 = x[static_cast<std::size_t>(t[1])] - x[static_cast<std::size_t>(t[0])];
    const Vec2 g2 = x[static_cast<std::size_t>(t[2])] - x[static_cast<std::size_t>(t[0])];
    for (const int n : t) {
      around[static_cast<std::size_t>(n)].push_back(static_cast<int>(e));
      b.area[static_cast<std::size_t>(n)] += (g1.x() * g2.y() - g1.y() * g2.x()) / 6.0;
    }
  }
  const Vec2 e1(std::cos(warp), std::sin(warp));
  for (std::size_t n = 0; n < x.size(); ++n)
    fit_patch(b, x, static_cast<int>(n), triangles, around, e1, weft - warp);
  b.force.assign(b.node.size(), Vec3::Zero());
  Gather gather = make_gather(b.node, x.size());
  b.gather_begin = std::move(gather.begin);
  b.gather = std::move(gather.gather);
  b.omega2 = bound(b, node_mass);
  return b;
}

std::array<double, 3> curvatures(const Bending& b, std::span<const Vec3> x, int node) {
  return shape_of(b, x, static_cast<std::size_t>(node)).kappa;
}

void bending_forces(Bending& b, std::span<const Vec3> x, int begin, int end) {
  for (auto n = static_cast<std::size_t>(begin); n < static_cast<std::size_t>(end); ++n) {
    const PatchShape s = shape_of(b, x, n);
    const std::array<double, 3> m = moments(b.law, s.kappa);
    const auto first = static_cast<std::size_t>(b.begin[n]);
    for (std::size_t i = first; i < static_cast<std::size_t>(b.begin[n + 1]); ++i)
      b.force[i] =
          -b.area[n] * (m[0] * b.b[i][0] + m[1] * b.b[i][1] + m[2] * b.b[i][2]) * s.normal; // (F)
    const Vec3 h = m[0] * s.second[0] + m[1] * s.second[1] + m[2] * s.second[2];
    const Vec3 along = (b.area[n] / s.size) * (h - h.dot(s.normal) * s.normal); // A0 h_t / |N|
    for (auto i = static_cast<std::size_t>(b.fan_begin[n]);
         i < static_cast<std::size_t>(b.fan_begin[n + 1]); ++i) {
      std::array<std::size_t, 3> place;
      for (std::size_t k = 0; k < 3; ++k)
        place[k] = first + static_cast<std::size_t>(b.fan[i][k]);
      const auto at = [&](std::size_t k) -> const Vec3& {
        return x[static_cast<std::size_t>(b.node[place[k]])];
      };
      const Vec3 turn1 = (at(2) - at(0)).cross(along), turn2 = along.cross(at(1) - at(0));
      b.force[place[0]] += turn1 + turn2;
      b.force[place[1]] -= turn1;
      b.force[place[2]] -= turn2;
    }
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
  for (std::size_t n = 0; n < b.area.size(); ++n) {
    const std::array<double, 3> k = shape_of(b, x, n).kappa;
    sum += b.area[n] * (b.law.warp.at(k[0]).energy + b.law.weft.at(k[1]).energy +
                        b.law.coupling * k[0] * k[1] + 0.5 * b.law.twist * k[2] * k[2]); // (E)
  }
  return sum;
}

} // namespace plyform
