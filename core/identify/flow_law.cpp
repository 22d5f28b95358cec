// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/flow_law.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

constexpr double most_c2 = 1e4, pole = 0.99; // K; of the way from T_0 to where f is infinite

} // namespace

FlowLaw::FlowLaw(FlowForm form, double reference, const std::vector<double>& temperatures)
    : form_(form), reference_(reference), temperatures_(temperatures) {
  std::sort(temperatures_.begin(), temperatures_.end());
  temperatures_.erase(std::unique(temperatures_.begin(), temperatures_.end()), temperatures_.end());
}

Eigen::Index FlowLaw::unknowns() const {
  switch (form_) {
  case FlowForm::none:
    return 0;
  case FlowForm::arrhenius:
    return 1;
  case FlowForm::wlf:
    return 2;
  case FlowForm::table:
    return static_cast<Eigen::Index>(temperatures_.size()) - 1;
  }
  return 0;
}

Eigen::VectorXd FlowLaw::as_arrhenius(double energy) const {
  const double kelvin = reference_ - absolute_zero;
  const auto log_factor = [&](double celsius) {
    return std::log(TemperatureFactor(ArrheniusFactor{energy, reference_}).at(celsius));
  };
  Eigen::VectorXd p(unknowns());
  if (form_ == FlowForm::arrhenius) p << energy;
  if (form_ == FlowForm::wlf)
    p << energy / (gas_constant * kelvin * kelvin * std::log(10.0)), 1.0 / kelvin;
  if (form_ != FlowForm::table) return p;
  Eigen::Index i = 0;
  for (const double celsius : temperatures_)
    if (celsius != reference_) p[i++] = log_factor(celsius);
  return p;
}

bool FlowLaw::allowed(const Eigen::VectorXd& p) const {
  if (!p.allFinite()) return false;
  if (form_ == FlowForm::arrhenius) return p[0] >= 0.0;
  if (form_ != FlowForm::wlf) return true;
  const double coldest = std::max(0.0, reference_ - temperatures_.front());
  return p[0] >= 0.0 && p[1] >= 1.0 / most_c2 && p[1] * coldest <= pole;
}

double FlowLaw::factor(const Eigen::VectorXd& p, double celsius) const {
  const double x = celsius - reference_;
  if (form_ == FlowForm::none || x == 0.0) return 1.0;
  if (form_ == FlowForm::arrhenius)
    return TemperatureFactor(ArrheniusFactor{p[0], reference_}).at(celsius);
  if (form_ == FlowForm::wlf) return std::pow(10.0, -p[0] * x / (1.0 + p[1] * x));
  Eigen::Index i = 0;
  for (const double at : temperatures_) {
    if (at == celsius) return std::exp(p[i]);
    if (at != reference_) ++i;
  }
  return 1.0; // no other temperature is asked for
}

Eigen::VectorXd FlowLaw::numbers(const Eigen::VectorXd& p) const {
  if (form_ == FlowForm::wlf) return Eigen::Vector2d(p[0] / p[1], 1.0 / p[1]);
  if (form_ == FlowForm::table) return p.array().exp();
  return p;
}

Eigen::VectorXd FlowLaw::unknowns_of(const Eigen::VectorXd& numbers) const {
  if (form_ == FlowForm::wlf) return Eigen::Vector2d(numbers[0] / numbers[1], 1.0 / numbers[1]);
  if (form_ == FlowForm::table) return numbers.array().log();
  return numbers;
}

} // namespace plyform
