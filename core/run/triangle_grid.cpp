// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/run/triangle_grid.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// Whether the way from a to b crosses a triangle (Moeller and Trumbore 1997), or its plane no
/// further (mm) than `margin` from each of its sides.
bool crosses_triangle(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q, const Vec3& r,
                      double margin) {
  const Vec3 way = b - a, u = q - p, v = r - p, n = way.cross(v);
  const double det = u.dot(n);
  if (det == 0.0) return false;
  const Vec3 from = a - p, m = from.cross(u);
  const double s = from.dot(n) / det, t = way.dot(m) / det, along = v.dot(m) / det;
  constexpr double rounding = 1e-9; // of a side, so that ways between two triangles cross one
  if (!(along >= 0.0 && along <= 1.0)) return false;
  if (margin == 0.0) return s >= -rounding && t >= -rounding && s + t <= 1.0 + rounding;
  const double per_height = margin / u.cross(v).norm();
  return s >= -per_height * v.norm() && t >= -per_height * u.norm() &&
         s + t <= 1.0 + per_height * (u - v).norm();
}

} // namespace

TriangleGrid::TriangleGrid(std::span<const Vec3> x, std::span<const Triangle> triangles,
                           double cell, double margin)
    : x_(x), triangles_(triangles), size_(cell), margin_(margin) {
  Box3 box;
  for (const Vec3& p : x)
    box.extend(p);
  const Vec3 around_all = Vec3::Constant(cell + margin);
  low_ = box.min() - around_all, high_ = box.max() + around_all;
  constexpr double most_cells = 1e6; // along a side: numbers stay below 2^63
  size_ = std::max(size_, (high_ - low_).maxCoeff() / most_cells);
  for (std::size_t k = 0; k < 3; ++k)
    counts_[k] = static_cast<std::int64_t>((high_ - low_)[static_cast<int>(k)] / size_) + 1;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    Box3 around;
    for (const std::int32_t n : triangles[t])
      around.extend(x[at(n)]);
    // A point is a quarter of a cell from a sample of its way; corners of what the margin adds to a
    // triangle lie further out, and are left out.
    const Vec3 more = Vec3::Constant(0.25 * size_ + margin);
    const auto first = cell_of(around.min() - more), last = cell_of(around.max() + more);
    for (std::int64_t i = first[0]; i <= last[0]; ++i)
      for (std::int64_t j = first[1]; j <= last[1]; ++j)
        for (std::int64_t k = first[2]; k <= last[2]; ++k)
          entries_.push_back({number_of({i, j, k}), static_cast<std::int32_t>(t)});
  }
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.cell < b.cell; });
}

std::array<std::int64_t, 3> TriangleGrid::cell_of(const Vec3& x) const {
  std::array<std::int64_t, 3> cell{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double place = std::floor((x - low_)[static_cast<int>(k)] / size_);
    cell[k] = std::clamp(static_cast<std::int64_t>(place), std::int64_t{0}, counts_[k] - 1);
  }
  return cell;
}

std::uint64_t TriangleGrid::number_of(const std::array<std::int64_t, 3>& cell) const {
  return static_cast<std::uint64_t>((cell[2] * counts_[1] + cell[1]) * counts_[0] + cell[0]);
}

std::int32_t TriangleGrid::crossed(const Vec3& a, const Vec3& b) const {
  const auto samples = static_cast<std::int64_t>(std::ceil((b - a).norm() / (0.5 * size_)));
  for (std::int64_t i = 0; i <= samples; ++i) {
    const double share = samples == 0 ? 0.0 : static_cast<double>(i) / static_cast<double>(samples);
    const Vec3 x = a + share * (b - a);
    if (((x - low_).array() < 0.0).any() || ((high_ - x).array() < 0.0).any()) continue;
    const std::uint64_t cell = number_of(cell_of(x));
    auto entry = std::lower_bound(entries_.begin(), entries_.end(), cell,
                                  [](const Entry& e, std::uint64_t n) { return e.cell < n; });
    for (; entry != entries_.end() && entry->cell == cell; ++entry) {
      const auto [p, q, r] = triangles_[at(entry->triangle)];
      if (crosses_triangle(a, b, x_[at(p)], x_[at(q)], x_[at(r)], margin_)) return entry->triangle;
    }
  }
  return -1;
}

} // namespace plyform
