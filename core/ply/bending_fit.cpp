// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/bending_fit.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Matrix = Eigen::MatrixXd;

/// The undeformed ply in which all stencils are fitted.
struct Sheet {
  std::span<const Vec2> x;
  const std::vector<Triangle>& triangles;
  std::vector<std::vector<int>> around; ///< triangles of each node
  std::array<Vec2, 2> yarn;             ///< unit vectors along warp and weft
  double fibre_angle;                   ///< rad, from warp to weft
};

/// Weights of each node of a stencil (columns) in the derivatives at its centre: rows d/d1, d/d2,
/// d2/d11, d2/d22, d2/d12, with 1 along the warp, 2 normal to it, lengths in units of `size`.
struct StencilFit {
  Matrix rows;
  std::array<bool, 2> follows_yarn; ///< whether (T) is defined for warp, weft
};

/// Adds the nodes that share a triangle with those of `nodes`.
void grow(std::vector<int>& nodes, const Sheet& sheet) {
  const std::vector<int> inner = nodes;
  for (const int n : inner)
    for (const int e : sheet.around[n])
      for (const int other : sheet.triangles[e])
        if (std::find(nodes.begin(), nodes.end(), other) == nodes.end()) nodes.push_back(other);
}

double across(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Rows 1, r, s, r^2/2, s^2/2, r s of each node, with r and s its coordinates from the centre node
/// in units of `size`, along e1 and normal to it.
Matrix monomials(std::span<const Vec2> x, const std::vector<int>& nodes, double size,
                 const Vec2& e1) {
  Matrix p(static_cast<Eigen::Index>(nodes.size()), 6);
  const Vec2& middle = x[nodes[0]];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec2 d = (x[nodes[i]] - middle) / size;
    const double r = d.dot(e1), s = across(e1, d);
    p.row(static_cast<Eigen::Index>(i)) << 1.0, r, s, 0.5 * r * r, 0.5 * s * s, r * s;
  }
  return p;
}

/// The fit of an inner node; lengths in units of `size`. May extend `nodes`.
StencilFit interior_fit(const Sheet& sheet, std::vector<int>& nodes, double size) {
  constexpr double least_ratio = 0.002; // of singular values; a regular stencil has 0.01 to 0.1
  const auto place = [&](std::size_t i) -> const Vec2& { return sheet.x[nodes[i]]; };
  for (int more = 0;; ++more) {
    // Near nodes get more weight: averages over rows of nodes would let single rows bend
    // alternately without energy; a strip of alternating diagonals sagged by 1.3 to 1.8 times
    // theory without weights.
    Eigen::VectorXd weight = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const Vec2 d = place(i) - place(0);
      const double near = std::min(1.0, size * size / d.squaredNorm());
      weight[static_cast<Eigen::Index>(i)] = near * near * near * near;
    }
    Eigen::JacobiSVD<Matrix> svd(weight.asDiagonal() *
                                     monomials(sheet.x, nodes, size, sheet.yarn[0]),
                                 Eigen::ComputeThinU | Eigen::ComputeThinV);
    const auto& s = svd.singularValues();
    if ((s.size() < 6 || s[5] < least_ratio * s[0]) && more < 2) {
      grow(nodes, sheet);
      continue;
    }
    svd.setThreshold(1e-6); // derivatives that a tiny mesh does not determine become 0
    return {svd.solve(Matrix(weight.asDiagonal())).bottomRows(5), {true, true}};
  }
}

/// The two neighbours of a node along the free edge of the ply, or none for an inner node.
std::vector<int> rim_neighbours(const Sheet& sheet, const std::vector<int>& nodes) {
  const std::vector<int>& around = sheet.around[nodes[0]];
  std::vector<int> rim;
  for (const int n : nodes) {
    const auto has = [&](int e) {
      const Triangle& t = sheet.triangles[e];
      return std::find(t.begin(), t.end(), n) != t.end();
    };
    if (n != nodes[0] && std::count_if(around.begin(), around.end(), has) == 1) rim.push_back(n);
  }
  return rim;
}

/// The fit of a node on the free edge. Only derivatives along the edge are determined; across it
/// the moment is zero, so that it adds nothing to the energy. (T) is defined only for a yarn along
/// the edge: a yarn that ends at the edge has no moment there, and the curvature of the edge would
/// give even a straight yarn a moment if it is stretched unevenly. At corners the fit is zero.
StencilFit rim_fit(const Sheet& sheet, const std::vector<int>& nodes, double size,
                   const std::vector<int>& rim) {
  StencilFit fit{Matrix::Zero(5, static_cast<Eigen::Index>(nodes.size())), {false, false}};
  if (rim.size() != 2) return fit;
  const Vec2& middle = sheet.x[nodes[0]];
  const Vec2 a = sheet.x[rim[0]] - middle;
  const Vec2 b = sheet.x[rim[1]] - middle;
  constexpr double straight = 0.9; // cosine: the edge turns by less than 26 degrees at this node
  if (a.dot(b) > -straight * a.norm() * b.norm()) return fit;
  const Vec2 along = (b - a).normalized();
  Eigen::JacobiSVD<Matrix> svd(monomials(sheet.x, nodes, size, along).leftCols(4),
                               Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto count = static_cast<Eigen::Index>(nodes.size());
  const Matrix all = svd.solve(Matrix::Identity(count, count));
  const Matrix slope = all.row(1), curvature = all.bottomRows(1);
  const double c = along.dot(sheet.yarn[0]), s = across(sheet.yarn[0], along);
  fit.rows << c * slope, s * slope, c * c * curvature, s * s * curvature, c * s * curvature;
  constexpr double same = 0.02; // sine: yarn and edge within 1 degree
  for (std::size_t k = 0; k < 2; ++k)
    fit.follows_yarn[k] = std::abs(across(along, sheet.yarn[k])) < same;
  return fit;
}

/// Sets the constants of the centre node to minus the sum of the others, so that a rigid
/// translation gives exactly zero force.
template <std::size_t size>
void balance(std::vector<std::array<double, size>>& constants, std::size_t first) {
  for (std::size_t k = 0; k < size; ++k) {
    double sum = 0.0;
    for (std::size_t i = first + 1; i < constants.size(); ++i)
      sum += constants[i][k];
    constants[first][k] = -sum;
  }
}

/// Appends a fit, as derivatives along the yarns in mm, to the constants of `b`.
void append_constants(Bending& b, const Sheet& sheet, const StencilFit& fit, double size) {
  const double c = std::cos(sheet.fibre_angle), s = std::sin(sheet.fibre_angle);
  const Matrix second = fit.rows.bottomRows(3) / (size * size);
  const std::size_t first = b.b.size();
  for (Eigen::Index i = 0; i < second.cols(); ++i) {
    const double b11 = second(0, i), b22 = second(1, i), b12 = second(2, i);
    b.b.push_back({b11, c * c * b11 + s * s * b22 + 2.0 * c * s * b12, c * b11 + s * b12});
  }
  balance(b.b, first);
  if (b.in_plane.empty()) return;
  for (Eigen::Index i = 0; i < fit.rows.cols(); ++i) {
    const double a1 = fit.rows(0, i) / size, a2 = fit.rows(1, i) / size;
    b.a.push_back({a1, c * a1 + s * a2});
  }
  balance(b.a, first);
}

/// Appends nodes and constants of one node's stencil to `b`.
void fit_stencil(Bending& b, const Sheet& sheet, int node) {
  std::vector<int> nodes{node};
  const auto own = static_cast<std::size_t>(node);
  const double size = std::sqrt(b.area[own]);
  grow(nodes, sheet);
  const std::vector<int> rim = rim_neighbours(sheet, nodes);
  const StencilFit fit =
      rim.empty() ? interior_fit(sheet, nodes, size) : rim_fit(sheet, nodes, size, rim);
  append_constants(b, sheet, fit, size);
  if (!b.in_plane.empty())
    for (std::size_t k = 0; k < 2; ++k)
      b.in_plane[own][k] = fit.follows_yarn[k] ? b.law.in_plane[k] : 0.0;
  for (const int e : sheet.around[own]) {
    Triangle places;
    for (std::size_t k = 0; k < 3; ++k)
      places[k] = static_cast<std::int32_t>(
          std::find(nodes.begin(), nodes.end(), sheet.triangles[e][k]) - nodes.begin());
    b.fan.push_back(places);
  }
  b.fan_begin.push_back(static_cast<std::int32_t>(b.fan.size()));
  b.node.insert(b.node.end(), nodes.begin(), nodes.end());
  b.begin.push_back(static_cast<std::int32_t>(b.node.size()));
}

} // namespace

void fit_stencils(Bending& b, std::span<const Vec2> x, const std::vector<Triangle>& triangles,
                  double warp, double weft) {
  Sheet sheet{x,
              triangles,
              std::vector<std::vector<int>>(x.size()),
              {Vec2(std::cos(warp), std::sin(warp)), Vec2(std::cos(weft), std::sin(weft))},
              weft - warp};
  b.begin = b.fan_begin = {0};
  b.area.assign(x.size(), 0.0);
  if (b.law.in_plane[0] > 0.0 || b.law.in_plane[1] > 0.0) b.in_plane.assign(x.size(), {0.0, 0.0});
  for (std::size_t e = 0; e < triangles.size(); ++e) {
    const Triangle& t = triangles[e];
    const Vec2 g1 = x[t[1]] - x[t[0]];
    const Vec2 g2 = x[t[2]] - x[t[0]];
    for (const int n : t) {
      sheet.around[n].push_back(static_cast<int>(e));
      b.area[n] += across(g1, g2) / 6.0;
    }
  }
  for (std::size_t n = 0; n < x.size(); ++n)
    fit_stencil(b, sheet, static_cast<int>(n));
  b.begin.shrink_to_fit(), b.node.shrink_to_fit(), b.b.shrink_to_fit(), b.a.shrink_to_fit();
  b.fan_begin.shrink_to_fit(), b.fan.shrink_to_fit();
}

} // namespace plyform
