// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/bending_fit.hpp"

#include "core/ply/curvature_flux.hpp"
#include "core/ply/quadratic_fit.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// The nodes of the triangles around a node, which comes first.
std::vector<int> nodes_around(const UndeformedSheet& sheet, int node) {
  std::vector<int> nodes{node};
  for (const int e : sheet.around[node])
    for (const int other : sheet.triangles[e])
      if (std::find(nodes.begin(), nodes.end(), other) == nodes.end()) nodes.push_back(other);
  return nodes;
}

/// Whether a yarn along `yarn` can be followed through a node: anywhere inside; on the rim only if
/// it lies along it. A yarn that ends at the rim has no moment there, and the curvature of the rim
/// would give even a straight yarn a moment if it is stretched unevenly.
bool follows(const UndeformedSheet& sheet, const std::vector<int>& nodes, const Vec2& yarn) {
  constexpr double same = 0.02; // sine: yarn and rim within 1 degree
  const std::vector<int>& around = sheet.around[nodes[0]];
  for (const int n : nodes) {
    const auto has = [&](int e) {
      const Triangle& t = sheet.triangles[e];
      return std::find(t.begin(), t.end(), n) != t.end();
    };
    if (n == nodes[0] || std::count_if(around.begin(), around.end(), has) != 1) continue;
    const Vec2 side = (sheet.x[n] - sheet.x[nodes[0]]).normalized();
    if (std::abs(side.x() * yarn.y() - side.y() * yarn.x()) >= same) return false;
  }
  return true;
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

/// Appends the constants A_a,i of a stencil with these nodes.
void append_slopes(Bending& b, const UndeformedSheet& sheet, const std::vector<int>& nodes) {
  const auto own = static_cast<std::size_t>(nodes[0]);
  const Vec2 axis2(std::cos(sheet.axes_angle), std::sin(sheet.axes_angle));
  const QuadraticFit fit = fit_quadratic(sheet.x, nodes, sheet.x[own], std::sqrt(sheet.area[own]));
  const std::size_t first = b.a.size();
  for (Eigen::Index i = 0; i < fit.rows.cols(); ++i)
    b.a.push_back({fit.rows(1, i), axis2.x() * fit.rows(1, i) + axis2.y() * fit.rows(2, i)});
  balance(b.a, first);
  const std::vector<int> around = nodes_around(sheet, nodes[0]);
  for (std::size_t a = 0; a < b.law.families.size(); ++a) {
    const FamilyBending& family = b.law.families[a];
    const Vec2 yarn = family.along.x() * Vec2::UnitX() + family.along.y() * axis2;
    b.in_plane[own * b.law.families.size() + a] =
        follows(sheet, around, yarn) ? family.in_plane : 0.0;
  }
}

/// Appends nodes and constants of one node's stencil to `b`.
void append_stencil(Bending& b, const UndeformedSheet& sheet, int node, const CurvatureRow& row) {
  constexpr double rounding = 1e-12; // relative to the largest constant
  std::vector<int> nodes = nodes_around(sheet, node);
  double largest = 0.0;
  for (const auto& [n, h] : row)
    for (const double value : h)
      largest = std::max(largest, std::abs(value));
  for (const auto& [n, h] : row)
    if (std::any_of(h.begin(), h.end(), [&](double v) { return std::abs(v) > rounding * largest; }))
      if (std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
  const Eigen::Matrix3d turn = along_axes(sheet.axes_angle);
  const std::size_t first = b.b.size();
  for (const int n : nodes) {
    const auto at =
        std::find_if(row.begin(), row.end(), [&](const auto& p) { return p.first == n; });
    Eigen::Vector3d h = Eigen::Vector3d::Zero();
    if (at != row.end()) h = turn * Eigen::Vector3d(at->second[0], at->second[1], at->second[2]);
    b.b.push_back({h[0], h[1], h[2]});
  }
  balance(b.b, first);
  if (!b.in_plane.empty()) append_slopes(b, sheet, nodes);
  for (const int e : sheet.around[node]) {
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
                  double axis1, double axis2, const std::vector<SymmetryPlane>& planes) {
  MirroredSheet whole = mirrored_sheet(x, triangles, planes);
  UndeformedSheet sheet{{},
                        whole.triangles,
                        std::vector<std::vector<int>>(whole.x.size()),
                        std::vector<double>(whole.x.size(), 0.0),
                        axis2 - axis1};
  const Vec2 e1(std::cos(axis1), std::sin(axis1)), e2(-e1.y(), e1.x());
  for (const Vec2& p : whole.x)
    sheet.x.emplace_back(p.dot(e1), p.dot(e2));
  b.area.assign(x.size(), 0.0);
  for (std::size_t e = 0; e < whole.triangles.size(); ++e) {
    const Triangle& t = whole.triangles[e];
    const Vec2 g1 = whole.x[t[1]] - whole.x[t[0]];
    const Vec2 g2 = whole.x[t[2]] - whole.x[t[0]];
    for (const int n : t) {
      sheet.around[n].push_back(static_cast<int>(e));
      const double third = (g1.x() * g2.y() - g1.y() * g2.x()) / 6.0;
      sheet.area[n] += third;
      if (e < triangles.size()) b.area[n] += third;
    }
  }
  b.begin = b.fan_begin = {0};
  if (b.law.in_plane()) b.in_plane.assign(x.size() * b.law.families.size(), 0.0);
  const std::vector<CurvatureRow> rows = curvature_rows(sheet, b.law);
  for (std::size_t n = 0; n < x.size(); ++n)
    append_stencil(b, sheet, static_cast<int>(n), rows[n]);
  b.images = std::move(whole.images), b.mirrors = std::move(whole.mirrors);
  b.begin.shrink_to_fit(), b.node.shrink_to_fit(), b.b.shrink_to_fit(), b.a.shrink_to_fit();
  b.fan_begin.shrink_to_fit(), b.fan.shrink_to_fit();
}

} // namespace plyform
