// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/size_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plyform {
namespace {

constexpr double finest_spacing = 0.5;    // of the smallest size
constexpr double most_points_a_way = 600; // a blank of 1.2 m has 2 mm

/// The part of the grid within `reach` (mm) of a place.
struct Window {
  int first_column, last_column, first_row, last_row;
};

Window window(const SizeGrid& grid, const Vec2& at, double reach) {
  const Vec2 low = (at - grid.origin).array() - reach, high = (at - grid.origin).array() + reach;
  const auto clamped = [&](double place, int count) {
    return std::clamp(static_cast<int>(place), 0, count - 1);
  };
  return {clamped(std::ceil(low.x() / grid.spacing), grid.columns),
          clamped(std::floor(high.x() / grid.spacing), grid.columns),
          clamped(std::ceil(low.y() / grid.spacing), grid.rows),
          clamped(std::floor(high.y() / grid.spacing), grid.rows)};
}

void lower(SizeGrid& grid, const Vec2& at, double reach, double size) {
  const Window w = window(grid, at, reach);
  for (int row = w.first_row; row <= w.last_row; ++row)
    for (int column = w.first_column; column <= w.last_column; ++column) {
      const Vec2 point = grid.origin + grid.spacing * Vec2(column, row);
      double& there = grid.size[grid.index(column, row)];
      if ((point - at).norm() <= reach) there = std::min(there, size);
    }
}

/// Lowers sizes that grow faster than size_growth: two passes over the grid, which take distances
/// along rows, columns and diagonals.
void bound_growth(SizeGrid& grid) {
  const double straight = size_growth * grid.spacing, across = std::numbers::sqrt2 * straight;
  const auto take = [&](double& size, int column, int row, double rise) {
    if (column < 0 || column >= grid.columns || row < 0 || row >= grid.rows) return;
    size = std::min(size, grid.size[grid.index(column, row)] + rise);
  };
  const auto pass = [&](int column, int row, int way) {
    double& size = grid.size[grid.index(column, row)];
    take(size, column - way, row, straight);
    take(size, column, row - way, straight);
    take(size, column - way, row - way, across);
    take(size, column + way, row - way, across);
  };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      pass(column, row, 1);
  for (int row = grid.rows - 1; row >= 0; --row)
    for (int column = grid.columns - 1; column >= 0; --column)
      pass(column, row, -1);
}

SizeGrid empty_grid(const std::vector<Vec2>& nodes, double smallest, double largest) {
  Eigen::AlignedBox2d box;
  for (const Vec2& x : nodes)
    box.extend(x);
  SizeGrid grid;
  grid.origin = box.min();
  grid.spacing = std::max(finest_spacing * smallest, box.sizes().maxCoeff() / most_points_a_way);
  grid.columns = 1 + static_cast<int>(std::ceil(box.sizes().x() / grid.spacing));
  grid.rows = 1 + static_cast<int>(std::ceil(box.sizes().y() / grid.spacing));
  grid.size.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                   largest);
  return grid;
}

} // namespace

SizeGrid size_grid(const PlyFrame& ply, const Ply& place, const AskedSizes& sizes, double largest,
                   double held) {
  const Eigen::Rotation2Dd back(-place.rotation);
  std::vector<Vec2> nodes;
  for (const Vec3& x : ply.x0)
    nodes.emplace_back(back * Vec2(x.head<2>() - place.seed));
  double smallest = largest;
  for (const auto& of_triangle : sizes)
    smallest = std::min(smallest, *std::min_element(of_triangle.begin(), of_triangle.end()));
  SizeGrid grid = empty_grid(nodes, smallest, largest);
  for (std::size_t t = 0; t < sizes.size(); ++t) {
    const Triangle& n = ply.triangles[t];
    const Vec2 &a = nodes[at(n[0])], &b = nodes[at(n[1])], &c = nodes[at(n[2])];
    const Vec2 u = b - a, v = c - a;
    const double reach = held * std::sqrt(std::abs(u.x() * v.y() - u.y() * v.x()));
    for (std::size_t k = 0; k < asked_places.size(); ++k) {
      const auto& w = asked_places[k];
      if (sizes[t][k] < largest)
        lower(grid, w[0] * a + w[1] * b + w[2] * c, reach, asked_share * sizes[t][k]);
    }
  }
  bound_growth(grid);
  return grid;
}

double aligned_size(const SizeGrid& grid, double largest) {
  const double least = *std::min_element(grid.size.begin(), grid.size.end()) / asked_share;
  if (!(least < largest)) return largest;
  return least * std::exp2(0.5 * std::floor(2.0 * std::log2(largest / least)));
}

void set_sizes(Case& data, std::size_t ply, SizeGrid sizes) {
  BlankSpec blank = data.blanks[at(data.plies[ply].blank)];
  blank.element_size = aligned_size(sizes, blank.element_size);
  blank.sizes = std::move(sizes);
  data.plies[ply].blank = static_cast<int>(data.blanks.size());
  data.blanks.push_back(std::move(blank));
}

} // namespace plyform
