// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/laboratories.hpp"

#include "base/geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace plyform {
namespace {

using Series = std::vector<double>;
constexpr double beyond_end = std::numeric_limits<double>::quiet_NaN();
constexpr double grid_step = 0.5 * degree, rounding = 1e-6 * degree;

std::vector<double> angles_to(double end) {
  std::vector<double> angles;
  for (int i = 0; i * grid_step <= end + rounding; ++i)
    angles.push_back(i * grid_step);
  if (end > angles.back() + rounding) angles.push_back(end);
  return angles;
}

Series torque_of(const LaboratoryCurve& curve, const std::vector<double>& angles) {
  Series torque;
  for (const double angle : angles)
    torque.push_back(angle <= curve.to + rounding ? curve.law.at(angle).value : beyond_end);
  return torque;
}

/// Those of the series that reach a place.
std::vector<const Series*> reaching(const std::vector<Series>& all, std::size_t place) {
  std::vector<const Series*> there;
  for (const Series& series : all)
    if (!std::isnan(series[place])) there.push_back(&series);
  return there;
}

double mean_at(const std::vector<const Series*>& all, std::size_t place) {
  double sum = 0.0;
  for (const Series* series : all)
    sum += (*series)[place];
  return sum / static_cast<double>(all.size());
}

/// Sum of squares about the mean.
double squares_at(const std::vector<const Series*>& all, std::size_t place) {
  const double mean = mean_at(all, place);
  double squares = 0.0;
  for (const Series* series : all)
    squares += ((*series)[place] - mean) * ((*series)[place] - mean);
  return squares;
}

/// Standard deviation, of two or more.
double deviation_at(const std::vector<const Series*>& all, std::size_t place) {
  return std::sqrt(squares_at(all, place) / static_cast<double>(all.size() - 1));
}

/// The mean, which grows as that of those who go on.
Series mean_with_growth(const std::vector<Series>& all, std::size_t places) {
  Series mean;
  for (std::size_t i = 0; i < places; ++i) {
    const auto there = reaching(all, i);
    if (there.empty()) {
      mean.push_back(beyond_end);
    } else if (there.size() == all.size()) {
      mean.push_back(mean_at(there, i));
    } else {
      const double before = mean_at(there, i - 1);
      mean.push_back(before > 0.0 ? mean.back() * mean_at(there, i) / before : mean_at(there, i));
    }
  }
  return mean;
}

/// The deviation, which keeps its share of the mean unless those who go on scatter by more.
Series deviation_with_growth(const std::vector<Series>& all, const Series& mean) {
  Series deviation;
  double share = 0.0;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    const auto there = reaching(all, i);
    const double own = there.size() > 1 && mean_at(there, i) > 0.0
                           ? deviation_at(there, i) / mean_at(there, i)
                           : 0.0;
    share = there.size() == all.size() ? own : std::max(share, own);
    deviation.push_back(share * mean[i]);
  }
  return deviation;
}

/// The curves of each laboratory, in the order of their first ones.
std::vector<std::vector<const LaboratoryCurve*>>
by_laboratory(const std::vector<LaboratoryCurve>& curves) {
  std::vector<std::vector<const LaboratoryCurve*>> groups;
  for (const LaboratoryCurve& curve : curves) {
    const auto group = std::find_if(groups.begin(), groups.end(), [&curve](const auto& g) {
      return g.front()->laboratory == curve.laboratory;
    });
    if (group == groups.end())
      groups.push_back({&curve});
    else
      group->push_back(&curve);
  }
  return groups;
}

/// Pooled over laboratories with several curves, whose series are given.
double within_at(const std::vector<std::vector<Series>>& several, std::size_t place) {
  double squares = 0.0;
  std::size_t freedom = 0;
  for (const std::vector<Series>& curves : several) {
    const auto there = reaching(curves, place);
    if (there.size() < 2) continue;
    squares += squares_at(there, place);
    freedom += there.size() - 1;
  }
  return freedom == 0 ? beyond_end : std::sqrt(squares / static_cast<double>(freedom));
}

/// Place and size of the largest deviation of a table from values, over the larger of these and a
/// tenth of the largest.
std::pair<std::size_t, double> worst_of(const ShearLaw& law, const std::vector<double>& angle,
                                        const Series& torque) {
  std::pair<std::size_t, double> worst{0, 0.0};
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const double size = std::max(torque[i], 0.1 * torque.back());
    const double off = std::abs(law.at(angle[i]).value - torque[i]) / size;
    if (off > worst.second) worst = {i, off};
  }
  return worst;
}

/// A table of few points whose curve follows values that do not fall.
ShearLaw table_through(const std::vector<double>& angle, const Series& torque) {
  constexpr double near = 0.01;
  std::vector<std::size_t> places{0, angle.size() - 1};
  while (true) {
    ShearLaw law;
    for (const std::size_t i : places) {
      law.angle.push_back(angle[i]);
      law.torque.push_back(torque[i]);
    }
    const auto [place, off] = worst_of(law, angle, torque);
    if (!(off > near)) return law;
    places.insert(std::lower_bound(places.begin(), places.end(), place), place);
  }
}

} // namespace

double LaboratoryMean::value_at(const std::vector<double>& values, double at) const {
  const auto above = std::lower_bound(angle.begin() + 1, angle.end() - 1, at) - angle.begin();
  const auto i = static_cast<std::size_t>(above);
  const double share = (at - angle[i - 1]) / (angle[i] - angle[i - 1]);
  if (share <= 0.0) return values[i - 1]; // the next one may be beyond a range
  return share >= 1.0 ? values[i] : (1.0 - share) * values[i - 1] + share * values[i];
}

LaboratoryMean laboratory_mean(const std::vector<LaboratoryCurve>& curves) {
  const auto groups = by_laboratory(curves);
  if (groups.size() < 2) throw std::invalid_argument("there must be two laboratories or more");
  LaboratoryMean result;
  double end = 0.0;
  for (const LaboratoryCurve& curve : curves)
    end = std::max(end, curve.to);
  result.angle = angles_to(end);
  result.common = end;
  const std::size_t places = result.angle.size();
  std::vector<Series> laws;
  std::vector<std::vector<Series>> several;
  for (const auto& group : groups) {
    std::vector<Series> own;
    double to = 0.0;
    for (const LaboratoryCurve* curve : group) {
      own.push_back(torque_of(*curve, result.angle));
      to = std::max(to, curve->to);
    }
    laws.push_back(mean_with_growth(own, places));
    result.laboratories.push_back({group.front()->laboratory, group.size(), to, laws.back()});
    result.common = std::min(result.common, to);
    if (own.size() > 1) several.push_back(std::move(own));
  }
  result.mean = mean_with_growth(laws, places);
  result.between = deviation_with_growth(laws, result.mean);
  for (std::size_t i = 0; i < places; ++i) {
    result.within.push_back(within_at(several, i));
    result.reach.push_back(reaching(laws, i).size());
  }
  return result;
}

DeviatedLaw deviated_law(const LaboratoryMean& mean, double deviations) {
  DeviatedLaw result;
  Series torque;
  for (std::size_t i = 0; i < mean.angle.size(); ++i) {
    const double least = torque.empty() ? 0.0 : torque.back();
    const double wanted = mean.mean[i] + deviations * mean.between[i];
    if (wanted < least) {
      if (!result.cut_from) result.cut_from = mean.angle[i];
      result.cut_to = mean.angle[i];
    }
    torque.push_back(std::max(wanted, least));
  }
  result.law = table_through(mean.angle, torque);
  return result;
}

} // namespace plyform
