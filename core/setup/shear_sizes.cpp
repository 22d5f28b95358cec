// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/setup/shear_sizes.hpp"

#include "core/results/field_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

// The error that is aimed at over what kinks leave with elements as small as they may get: nearer
// to that all elements would become as small.
constexpr double over_kinks = 1.5;

Vec2 side(const PlyFrame& ply, std::size_t t, std::size_t to) {
  const Triangle& n = ply.triangles[t];
  return (ply.x0[at(n[to])] - ply.x0[at(n[0])]).head<2>();
}

double twice_area(const PlyFrame& ply, std::size_t t) {
  const Vec2 u = side(ply, t, 1), v = side(ply, t, 2);
  return u.x() * v.y() - u.y() * v.x();
}

/// Gradient of a field of nodes in each triangle, before forming: its x and y parts, per mm.
std::array<std::vector<double>, 2> gradients(const PlyFrame& ply,
                                             const std::vector<double>& nodal) {
  std::array<std::vector<double>, 2> g;
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    const Triangle& n = ply.triangles[t];
    const Vec2 u = side(ply, t, 1), v = side(ply, t, 2);
    const double du = nodal[at(n[1])] - nodal[at(n[0])], dv = nodal[at(n[2])] - nodal[at(n[0])];
    g[0].push_back((du * v.y() - dv * u.y()) / twice_area(ply, t));
    g[1].push_back((dv * u.x() - du * v.x()) / twice_area(ply, t));
  }
  return g;
}

/// A triangle of the scout in (2).
struct Estimate {
  double size, error, area; ///< mm, degrees, mm^2
  double lowered;           ///< mm, what is asked for already
  double least;             ///< mm: for the sake of shear no less
};

/// h' of (2), mm.
double size_of(const Estimate& e, double mu) {
  const double size = e.error > 0.0 ? e.size * std::cbrt(mu / e.error) : e.lowered;
  return std::min(e.lowered, std::max(size, e.least));
}

/// The root mean square error of all with this mu, degrees.
double error_of(const std::vector<Estimate>& all, double mu) {
  double sum = 0.0, area = 0.0;
  for (const Estimate& e : all) {
    const double share = size_of(e, mu) / e.size, left = e.error * share * share;
    sum += e.area * left * left;
    area += e.area;
  }
  return area > 0.0 ? std::sqrt(sum / area) : 0.0;
}

/// The largest mu, degrees, whose error is `wanted` at most; 0 if none is.
double find_mu(const std::vector<Estimate>& all, double wanted) {
  double low = 0.0, high = 0.0;
  for (const Estimate& e : all)
    high = std::max(high, e.error * std::pow(e.lowered / e.size, 3.0));
  if (error_of(all, high) <= wanted) return high;
  constexpr int halvings = 40; // beyond what sizes are kept to
  for (int i = 0; i < halvings; ++i) {
    const double between = 0.5 * (low + high);
    (error_of(all, between) <= wanted ? low : high) = between;
  }
  return low;
}

double smallest_of(const std::vector<AskedSizes>& sizes) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const AskedSizes& of_ply : sizes)
    for (const auto& places : of_ply)
      smallest = std::min(smallest, *std::min_element(places.begin(), places.end()));
  return smallest;
}

} // namespace

double square_side(const PlyFrame& ply, std::size_t t) {
  return std::sqrt(std::abs(twice_area(ply, t)));
}

std::vector<double> shear_error_estimates(const PlyFrame& ply) {
  const auto g = gradients(ply, nodal_means(ply, ply.shear_deg));
  const std::array recovered{nodal_means(ply, g[0]), nodal_means(ply, g[1])};
  std::vector<double> estimates;
  for (std::size_t t = 0; t < ply.triangles.size(); ++t) {
    const Triangle& n = ply.triangles[t];
    double sum = 0.0; // of squares at the middles of sides, which integrates them exactly
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 2; ++i) {
        const double there = 0.5 * (recovered[i][at(n[k])] + recovered[i][at(n[(k + 1) % 3])]);
        sum += (there - g[i][t]) * (there - g[i][t]) / 3.0;
      }
    estimates.push_back(std::sqrt(std::abs(twice_area(ply, t)) * sum));
  }
  return estimates;
}

void lower_to_shear(const Frame& last, double error, double finest,
                    std::vector<AskedSizes>& sizes) {
  std::vector<Estimate> all;
  double smallest = smallest_of(sizes), coarsest = 0.0;
  for (const PlyFrame& ply : last.plies)
    for (std::size_t t = 0; t < ply.triangles.size(); ++t)
      coarsest = std::max(coarsest, square_side(ply, t));
  smallest = std::min(smallest, finest * coarsest);
  for (std::size_t p = 0; p < last.plies.size(); ++p) {
    const std::vector<double> errors = shear_error_estimates(last.plies[p]);
    for (std::size_t t = 0; t < errors.size(); ++t) {
      const double own = square_side(last.plies[p], t);
      all.push_back({own, errors[t], 0.5 * own * own,
                     *std::max_element(sizes[p][t].begin(), sizes[p][t].end()),
                     std::max(finest * own, smallest)});
    }
  }
  const double kinks = error_of(all, 0.0);
  const double mu = find_mu(all, std::max(error, over_kinks * kinks));
  std::size_t i = 0;
  for (AskedSizes& of_ply : sizes)
    for (auto& places : of_ply) {
      const double size = size_of(all[i++], mu);
      for (double& place : places)
        place = std::min(place, size);
    }
}

} // namespace plyform
