// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ply/curvature_flux.hpp"

#include "core/ply/quadratic_fit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

using Three = std::array<double, 3>;

double cross_of(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A side n to m of a triangle to its left, and the triangle to its right, or -1 on the rim.
struct Side {
  int n, m, left, right;
};

/// The sides of a mesh, and the triangles across the three of each triangle (-1: none).
struct Sides {
  std::vector<Side> all;
  std::vector<Triangle> across;
};

Sides find_sides(const UndeformedSheet& sheet) {
  Sides s;
  s.across.assign(sheet.triangles.size(), {-1, -1, -1});
  for (std::size_t e = 0; e < sheet.triangles.size(); ++e)
    for (std::size_t k = 0; k < 3; ++k) {
      const int n = sheet.triangles[e][k], m = sheet.triangles[e][(k + 1) % 3];
      for (const int other : sheet.around[n])
        for (std::size_t j = 0; j < 3; ++j)
          if (sheet.triangles[other][j] == m && sheet.triangles[other][(j + 1) % 3] == n)
            s.across[e][k] = other;
      if (s.across[e][k] < static_cast<int>(e)) // once, from the later of two triangles
        s.all.push_back({n, m, static_cast<int>(e), s.across[e][k]});
    }
  return s;
}

void add(CurvatureRow& row, int node, const Three& weights, double factor) {
  auto at = std::find_if(row.begin(), row.end(), [&](const auto& p) { return p.first == node; });
  if (at == row.end()) at = row.insert(row.end(), {node, Three{}});
  for (std::size_t k = 0; k < 3; ++k)
    at->second[k] += factor * weights[k];
}

Three product(const Vec2& gradient, const Vec2& normal) {
  return {gradient.x() * normal.x(), gradient.y() * normal.y(),
          0.5 * (gradient.x() * normal.y() + gradient.y() * normal.x())};
}

/// The flux through a part of the boundary of a cell: weights of nodes, and C, columns by H_11,
/// H_22, H_12.
struct Flux {
  CurvatureRow row;
  Eigen::Matrix3d excess = Eigen::Matrix3d::Zero();
};

/// Adds a straight piece in a triangle with its middle `at` and its normal as long as it is.
/// origin: of the quadratics.
void add_piece(Flux& f, const UndeformedSheet& sheet, int triangle, const Vec2& at,
               const Vec2& normal, const Vec2& origin) {
  const Triangle& t = sheet.triangles[triangle];
  const Vec2 p = at - origin;
  const std::array<Vec2, 3> true_gradient{Vec2(p.x(), 0.0), Vec2(0.0, p.y()), Vec2(p.y(), p.x())};
  std::array<Vec2, 3> linear{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
  const double twice = cross_of(sheet.x[t[1]] - sheet.x[t[0]], sheet.x[t[2]] - sheet.x[t[0]]);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 opposite = sheet.x[t[(k + 2) % 3]] - sheet.x[t[(k + 1) % 3]];
    const Vec2 shape = Vec2(-opposite.y(), opposite.x()) / twice; // gradient of the hat function
    add(f.row, t[k], product(shape, normal), 1.0);
    const Vec2 c = sheet.x[t[k]] - origin;
    linear[0] += 0.5 * c.x() * c.x() * shape;
    linear[1] += 0.5 * c.y() * c.y() * shape;
    linear[2] += c.x() * c.y() * shape;
  }
  for (std::size_t q = 0; q < 3; ++q) {
    const Three more = product(true_gradient[q] - linear[q], normal);
    for (std::size_t k = 0; k < 3; ++k)
      f.excess(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(q)) += more[k];
  }
}

/// Triangles next to a side, and those across their sides, layer by layer.
std::vector<int> grown(const Sides& sides, std::vector<int> triangles) {
  const std::vector<int> inner = triangles;
  for (const int e : inner)
    for (const int other : sides.across[e])
      if (other >= 0 && std::find(triangles.begin(), triangles.end(), other) == triangles.end())
        triangles.push_back(other);
  return triangles;
}

/// Second derivatives of the quadratic nearest to the nodes of the patch around a side.
CurvatureRow patch_curvature(const UndeformedSheet& sheet, const Sides& sides, const Side& side) {
  std::vector<int> patch{side.left};
  if (side.right >= 0) patch.push_back(side.right);
  const Vec2 middle = 0.5 * (sheet.x[side.n] + sheet.x[side.m]);
  const double size = (sheet.x[side.m] - sheet.x[side.n]).norm();
  constexpr int most_layers = 4; // any mesh of some triangles determines a quadratic by then
  for (int layer = 1;; ++layer) {
    patch = grown(sides, std::move(patch));
    std::vector<int> nodes;
    for (const int e : patch)
      for (const int n : sheet.triangles[e])
        if (std::find(nodes.begin(), nodes.end(), n) == nodes.end()) nodes.push_back(n);
    const QuadraticFit fit = fit_quadratic(sheet.x, nodes, middle, size);
    if (!fit.determined && layer < most_layers) continue;
    CurvatureRow row;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      row.push_back({nodes[i], {fit.rows(3, c), fit.rows(4, c), fit.rows(5, c)}});
    }
    return row;
  }
}

/// Adds C : H_patch to the fluxes through one side where they need it.
void add_excess(std::span<Flux> fluxes, const UndeformedSheet& sheet, const Sides& sides,
                const Side& side) {
  constexpr double rounding = 1e-9; // relative to the square of the side's length
  const double least = rounding * (sheet.x[side.m] - sheet.x[side.n]).squaredNorm();
  const auto is_small = [&](const Flux& f) { return f.excess.cwiseAbs().maxCoeff() <= least; };
  if (std::all_of(fluxes.begin(), fluxes.end(), is_small)) return;
  const CurvatureRow patch = patch_curvature(sheet, sides, side);
  for (Flux& f : fluxes)
    for (const auto& [node, h] : patch) {
      const Eigen::Vector3d more = f.excess * Eigen::Vector3d(h[0], h[1], h[2]);
      add(f.row, node, {more[0], more[1], more[2]}, 1.0);
    }
}

void add_to(CurvatureRow& row, const Flux& flux, double factor) {
  for (const auto& [node, weights] : flux.row)
    add(row, node, weights, factor);
}

/// Adds the flux through the side between the cells of two nodes, or out of both on the rim.
void add_side(std::vector<CurvatureRow>& rows, const UndeformedSheet& sheet, const Sides& sides,
              const Side& side) {
  const Vec2 &a = sheet.x[side.n], &b = sheet.x[side.m];
  const Vec2 middle = 0.5 * (a + b), along = b - a;
  std::array<Flux, 3> flux; // between the cells; out of that of n, out of that of m
  for (const int e : {side.left, side.right})
    if (e >= 0) {
      const Triangle& t = sheet.triangles[e];
      const Vec2 centroid = (sheet.x[t[0]] + sheet.x[t[1]] + sheet.x[t[2]]) / 3.0;
      Vec2 normal(centroid.y() - middle.y(), middle.x() - centroid.x());
      if (e == side.right) normal = -normal;
      add_piece(flux[0], sheet, e, 0.5 * (middle + centroid), normal, middle);
    }
  std::size_t count = 1;
  if (side.right < 0) {
    const Vec2 out = 0.5 * Vec2(along.y(), -along.x());
    add_piece(flux[1], sheet, side.left, middle - 0.25 * along, out, middle);
    add_piece(flux[2], sheet, side.left, middle + 0.25 * along, out, middle);
    count = 3;
  }
  add_excess(std::span(flux).first(count), sheet, sides, side);
  add_to(rows[side.n], flux[0], 1.0 / sheet.area[side.n]);
  add_to(rows[side.m], flux[0], -1.0 / sheet.area[side.m]);
  add_to(rows[side.n], flux[1], 1.0 / sheet.area[side.n]);
  add_to(rows[side.m], flux[2], 1.0 / sheet.area[side.m]);
}

/// Stiffness (N mm) of the law at no curvature against those in the sheet's axes.
Eigen::Matrix3d stiffness_of(const BendingLaw& law, double axes_angle) {
  const Eigen::Matrix3d turn = along_axes(axes_angle);
  const Eigen::Matrix3d d = turn.transpose() * law.stiffness_at_rest() * turn;
  // A millionth of the stiffness of a plate beside it: where the law has none, nothing is added.
  constexpr double share = 1e-6;
  const double largest = d.cwiseAbs().maxCoeff();
  const double more = largest > 0.0 ? share * largest : 1.0;
  return d + Eigen::Vector3d(more, more, 2.0 * more).asDiagonal().toDenseMatrix();
}

/// (R) of a node with these normals of the rim beside it.
void release(CurvatureRow& row, std::vector<Vec2> normals, const Eigen::Matrix3d& stiffness) {
  constexpr double straight = 0.9; // cosine: the rim turns by less than 26 degrees at this node
  if (normals.size() == 2 && normals[0].dot(normals[1]) > straight)
    normals = {(normals[0] + normals[1]).normalized()};
  Eigen::Matrix3d to = Eigen::Matrix3d::Zero();
  if (normals.size() <= 2) { // with three, where parts meet in a node, nothing is left
    Eigen::MatrixXd free(3, static_cast<Eigen::Index>(normals.size()));
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Vec2& n = normals[i];
      free.col(static_cast<Eigen::Index>(i)) << n.x() * n.x(), n.y() * n.y(), n.x() * n.y();
    }
    const Eigen::MatrixXd s = free.transpose() * stiffness;
    to = Eigen::Matrix3d::Identity() -
         free * (s * free).completeOrthogonalDecomposition().pseudoInverse() * s;
  }
  for (auto& [node, h] : row) {
    const Eigen::Vector3d turned = to * Eigen::Vector3d(h[0], h[1], h[2]);
    h = {turned[0], turned[1], turned[2]};
  }
}

} // namespace

Eigen::Matrix3d along_axes(double axes_angle) {
  const double c = std::cos(axes_angle), s = std::sin(axes_angle);
  Eigen::Matrix3d turn;
  turn << 1.0, 0.0, 0.0, c * c, s * s, 2.0 * c * s, c, 0.0, s;
  return turn;
}

std::vector<CurvatureRow> curvature_rows(const UndeformedSheet& sheet, const BendingLaw& law) {
  std::vector<CurvatureRow> rows(sheet.x.size());
  std::vector<std::vector<Vec2>> normals(sheet.x.size());
  const Sides sides = find_sides(sheet);
  for (const Side& side : sides.all) {
    add_side(rows, sheet, sides, side);
    if (side.right >= 0) continue;
    const Vec2 along = sheet.x[side.m] - sheet.x[side.n];
    for (const int n : {side.n, side.m})
      normals[n].push_back(Vec2(along.y(), -along.x()).normalized());
  }
  const Eigen::Matrix3d stiffness = stiffness_of(law, sheet.axes_angle);
  for (std::size_t n = 0; n < rows.size(); ++n)
    if (!normals[n].empty()) release(rows[n], normals[n], stiffness);
  return rows;
}

} // namespace plyform
