// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/statistics.hpp"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace plyform {

using Student = boost::math::students_t_distribution<double>;

double student_95(double freedom) {
  return boost::math::quantile(Student(std::max(freedom, 1.0)), 0.975);
}

double student_beyond(double t, double freedom) {
  if (!std::isfinite(t)) return 0.0;
  return 2.0 *
         boost::math::cdf(boost::math::complement(Student(std::max(freedom, 1.0)), std::abs(t)));
}

double fisher_beyond(double f, double above, double below) {
  if (!std::isfinite(f)) return 0.0;
  return boost::math::cdf(boost::math::complement(
      boost::math::fisher_f_distribution<double>(std::max(above, 1.0), std::max(below, 1.0)), f));
}

double chance_of_gain(double squares, double less, double freedom) {
  if (!(less > 0.0)) return squares > 0.0 ? 0.0 : 1.0;
  return student_beyond(std::sqrt(std::max(0.0, squares - less) / (less / freedom)), freedom);
}

double minimum_of(const std::function<double(double)>& f, double least, double most) {
  constexpr int bits = 20;
  std::uintmax_t evaluations = 100;
  return boost::math::tools::brent_find_minima(f, least, most, bits, evaluations).first;
}

Spread spread_of(const std::vector<double>& values) {
  if (values.size() < 2) throw std::invalid_argument("a spread needs two values or more");
  const double n = static_cast<double>(values.size());
  Spread spread;
  for (const double value : values)
    spread.mean += value / n;
  double squares = 0.0;
  for (const double value : values)
    squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / (n - 1.0));
  spread.limits = student_95(n - 1.0) * spread.deviation / std::sqrt(n);
  return spread;
}

std::vector<double> nearest_rising(const std::vector<double>& values) {
  struct Pool {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const double value : values) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      pools[pools.size() - 2].sum += pools.back().sum;
      pools[pools.size() - 2].count += pools.back().count;
      pools.pop_back();
    }
  }
  std::vector<double> rising;
  for (const Pool& pool : pools)
    rising.insert(rising.end(), pool.count, pool.mean());
  return rising;
}

} // namespace plyform
