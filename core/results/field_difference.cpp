// SPDX-License-Identifier: GPL-3.0-or-later
//   A_t    area of triangle t before forming, mm^2
//   f_t    value of triangle t, degrees
//   f_i    value at node i:   f_i = sum_t A_t f_t / sum_t A_t over the triangles around i      (1)
//   w_i    area of node i:    w_i = 1/3 sum_t A_t over the same                               (2)
//   d_i    difference at node i of the reference, the run's field interpolated there
//   rms^2 = sum_i w_i d_i^2 / sum_i w_i                                                       (3)
#include "core/results/field_difference.hpp"

#include "base/format.hpp"
#include "core/results/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plyform {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Corners of a triangle before forming, from above.
struct Corners {
  Vec2 a, b, c;
};

Corners corners(const PlyFrame& ply, std::size_t t) {
  const Triangle& nodes = ply.triangles[t];
  return {ply.x0[at(nodes[0])].head<2>(), ply.x0[at(nodes[1])].head<2>(),
          ply.x0[at(nodes[2])].head<2>()};
}

double area(const Corners& t) {
  return 0.5 * std::abs(cross(t.b - t.a, t.c - t.a));
}

/// Shares of the corners in a point; all at least 0 inside.
Vec3 shares(const Corners& t, const Vec2& p) {
  const double whole = cross(t.b - t.a, t.c - t.a);
  const double b = cross(p - t.a, t.c - t.a) / whole, c = cross(t.b - t.a, p - t.a) / whole;
  return {1.0 - b - c, b, c};
}

Vec2 nearest_on_side(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 side = b - a;
  return a + std::clamp(side.dot(p - a) / side.squaredNorm(), 0.0, 1.0) * side;
}

/// The place on the triangle's border nearest to a point outside.
Vec2 nearest_on(const Corners& t, const Vec2& p) {
  Vec2 best = nearest_on_side(t.a, t.b, p);
  for (const Vec2& other : {nearest_on_side(t.b, t.c, p), nearest_on_side(t.c, t.a, p)})
    if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
  return best;
}

/// Which triangles may hold a point: squares of a grid with the triangles whose boxes touch them.
class TriangleGrid {
public:
  explicit TriangleGrid(const PlyFrame& ply) : ply_(ply) {
    low_ = high_ = ply.x0.front().head<2>();
    for (const Vec3& x : ply.x0) {
      low_ = low_.cwiseMin(x.head<2>());
      high_ = high_.cwiseMax(x.head<2>());
    }
    const Vec2 size = high_ - low_;
    // About one triangle a cell: long and flat plies get long and flat grids.
    cell_ = std::sqrt(size.x() * size.y() / static_cast<double>(ply.triangles.size()));
    columns_ = static_cast<long>(size.x() / cell_) + 1;
    rows_ = static_cast<long>(size.y() / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
    for (std::size_t t = 0; t < ply.triangles.size(); ++t)
      enter(t);
  }

  /// The triangle with the point, and the shares of its corners there; the nearest place on the ply
  /// if it has none.
  std::size_t find(const Vec2& p, Vec3& share) const {
    constexpr double rounding = 1e-9; // of a triangle: on a side shared by two, either will do
    for (const std::size_t t : cells_[index(column(p.x()), row(p.y()))]) {
      share = shares(corners(ply_, t), p);
      if (share.minCoeff() >= -rounding) return t;
    }
    return nearest(p, share);
  }

private:
  long column(double x) const { return cell_of(x - low_.x(), columns_); }
  long row(double y) const { return cell_of(y - low_.y(), rows_); }
  long cell_of(double from_low, long count) const {
    return static_cast<long>(std::clamp(from_low / cell_, 0.0, static_cast<double>(count - 1)));
  }
  std::size_t index(long i, long j) const { return static_cast<std::size_t>(j * columns_ + i); }

  void enter(std::size_t t) {
    const Corners c = corners(ply_, t);
    const Vec2 low = c.a.cwiseMin(c.b).cwiseMin(c.c), high = c.a.cwiseMax(c.b).cwiseMax(c.c);
    // A hair more, for points on the border that rounding puts beyond it.
    const double more = 1e-6 * cell_;
    for (long j = row(low.y() - more); j <= row(high.y() + more); ++j)
      for (long i = column(low.x() - more); i <= column(high.x() + more); ++i)
        cells_[index(i, j)].push_back(t);
  }

  /// Over all triangles: few points are outside, those between a coarse mesh and a round outline.
  std::size_t nearest(const Vec2& p, Vec3& share) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    Vec2 place = p;
    for (std::size_t t = 0; t < ply_.triangles.size(); ++t) {
      const Vec2 candidate = nearest_on(corners(ply_, t), p);
      const double distance = (candidate - p).squaredNorm();
      if (!(distance < least)) continue;
      least = distance;
      best = t;
      place = candidate;
    }
    share = shares(corners(ply_, best), place);
    return best;
  }

  const PlyFrame& ply_;
  Vec2 low_, high_;
  double cell_ = 1.0;
  long columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
};

/// (2)
std::vector<double> node_areas(const PlyFrame& ply) {
  std::vector<double> areas(ply.x0.size(), 0.0);
  for (std::size_t t = 0; t < ply.triangles.size(); ++t)
    for (const std::int32_t node : ply.triangles[t])
      areas[at(node)] += area(corners(ply, t)) / 3.0;
  return areas;
}

} // namespace

namespace {

/// Throws std::invalid_argument, which lists the names, if the ply has no such field.
const std::vector<double>& values_of(const PlyFrame& ply, const std::string& field) {
  if (const std::vector<double>* values = triangle_values(ply, field)) return *values;
  std::string names;
  for (const Column& column : columns_of(ply))
    if (triangle_values(ply, column.name)) names += (names.empty() ? "" : ", ") + column.name;
  throw std::invalid_argument(
      fmt::format("{} is no field of triangles; there are {} (ply {})", field, names, ply.name));
}

} // namespace

std::vector<double> nodal_means(const PlyFrame& ply, const std::vector<double>& values) {
  std::vector<double> sums(ply.x0.size(), 0.0), areas(ply.x0.size(), 0.0);
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    const double weight = area(corners(ply, t));
    for (const std::int32_t node : ply.triangles[t]) {
      sums[at(node)] += weight * values[t];
      areas[at(node)] += weight;
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    sums[i] /= areas[i]; // (1)
  return sums;
}

std::vector<double> interpolate(const PlyFrame& ply, const std::vector<double>& nodal,
                                const std::vector<Vec3>& points) {
  if (ply.triangles.empty()) throw std::runtime_error("ply " + ply.name + " has no triangles");
  const TriangleGrid grid(ply);
  std::vector<double> values;
  values.reserve(points.size());
  Vec3 share = Vec3::Zero();
  for (const Vec3& point : points) {
    const Triangle& t = ply.triangles[grid.find(point.head<2>(), share)];
    values.push_back(share[0] * nodal[at(t[0])] + share[1] * nodal[at(t[1])] +
                     share[2] * nodal[at(t[2])]);
  }
  return values;
}

FieldDifference field_difference(const Frame& run, const Frame& reference,
                                 const std::string& field) {
  if (run.plies.size() != reference.plies.size())
    throw std::runtime_error(fmt::format("a run of {} plies cannot be compared with one of {}",
                                         run.plies.size(), reference.plies.size()));
  FieldDifference result;
  std::vector<double> d, w;
  for (std::size_t p = 0; p < run.plies.size(); ++p) {
    const PlyFrame &ply = run.plies[p], &other = reference.plies[p];
    const std::vector<double> wanted = nodal_means(other, values_of(other, field));
    std::vector<double> found = interpolate(ply, nodal_means(ply, values_of(ply, field)), other.x0);
    const std::vector<double> areas = node_areas(other);
    for (std::size_t i = 0; i < wanted.size(); ++i)
      found[i] -= wanted[i];
    d.insert(d.end(), found.begin(), found.end());
    w.insert(w.end(), areas.begin(), areas.end());
    result.at_nodes.push_back(std::move(found));
  }
  double area = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    area += w[i];
    sum += w[i] * std::abs(d[i]);
  }
  result.error = {root_mean_square(d, w), percentile(d, w, 0.99), largest_magnitude(d),
                  percentile(d, w, 0.95), area > 0.0 ? sum / area : 0.0}; // (3)
  return result;
}

Frame only_ply(const Frame& frame, std::size_t ply) {
  Frame one;
  one.plies = {frame.plies[ply]};
  return one;
}

FieldError shear_error(const Frame& run, const Frame& reference) {
  return field_difference(run, reference, "shear_angle_deg").error;
}

} // namespace plyform
