// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/group_difference.hpp"

#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace plyform {
namespace {

struct LogGroup {
  double mean = 0.0, squares = 0.0, number = 0.0;
};

LogGroup logarithms_of(const std::vector<double>& values) {
  LogGroup group;
  group.number = static_cast<double>(values.size());
  for (const double value : values) {
    if (!(value > 0.0)) throw std::invalid_argument("values of two groups must be above 0");
    group.mean += std::log(value) / group.number;
  }
  for (const double value : values)
    group.squares += (std::log(value) - group.mean) * (std::log(value) - group.mean);
  return group;
}

} // namespace

bool GroupDifference::differs() const {
  return chance < rare && std::abs(ratio - 1.0) > noticed;
}

GroupDifference difference_of(const std::vector<double>& first, const std::vector<double>& second,
                              const OwnLimits& limits) {
  if (first.empty() || second.empty()) throw std::invalid_argument("a group has no specimen");
  const LogGroup a = logarithms_of(first), b = logarithms_of(second);
  constexpr double many = 1000.0; // limits of one specimen have their own Student's t in them
  double freedom = a.number + b.number - 2.0, error = 0.0;
  GroupDifference result;
  result.between_specimens = freedom > 0.0;
  if (result.between_specimens) {
    error = std::sqrt((a.squares + b.squares) / freedom * (1.0 / a.number + 1.0 / b.number));
  } else {
    freedom = many;
    error =
        std::hypot(limits.first, limits.second, GroupDifference::usual_scatter) / student_95(many);
  }
  const double difference = b.mean - a.mean;
  result.ratio = std::exp(difference);
  result.least = std::exp(difference - student_95(freedom) * error);
  result.most = std::exp(difference + student_95(freedom) * error);
  const bool none = difference == 0.0;
  result.chance = none ? 1.0 : student_beyond(difference / error, freedom);
  return result;
}

bool LawDifference::differs() const {
  return std::any_of(at.begin(), at.end(), [](const GroupDifference& d) { return d.differs(); });
}

LawDifference difference_of(const std::vector<double>& places,
                            const std::vector<std::vector<double>>& first,
                            const std::vector<std::vector<double>>& second,
                            const OwnLimits& limits) {
  LawDifference result;
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto at_place = [&](const std::vector<std::vector<double>>& all) {
      std::vector<double> values;
      for (const std::vector<double>& specimen : all)
        values.push_back(specimen.at(p));
      return values;
    };
    const std::vector<double> a = at_place(first), b = at_place(second);
    const auto positive = [](double value) { return value > 0.0; };
    if (!std::all_of(a.begin(), a.end(), positive) || !std::all_of(b.begin(), b.end(), positive))
      continue;
    result.places.push_back(places[p]);
    result.at.push_back(difference_of(a, b, limits));
    const GroupDifference &here = result.at.back(), &best = result.at[result.clearest];
    const bool further = std::abs(std::log(here.ratio)) > std::abs(std::log(best.ratio));
    if (here.differs() ? !best.differs() || further : !best.differs() && here.chance < best.chance)
      result.clearest = result.at.size() - 1;
  }
  return result;
}

} // namespace plyform
