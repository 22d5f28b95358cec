// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of a viscosity over temperature that tests at several temperatures are fitted with:
// Arrhenius, Williams-Landel-Ferry and a table, of core/model/temperature.hpp.
//
// Unknowns p, chosen so that ln f is nearly linear in them (x = T - T_0, K):
//
//   Arrhenius  ln f = p_1 (1/T_K - 1/T_0K) / R
//   WLF        ln f = -ln 10 p_1 x / (1 + p_2 x),  p_1 = C_1 / C_2, p_2 = 1 / C_2
//   table      ln f = p_i at each temperature but T_0
//
// WLF with C_2 = T_0K is Arrhenius: of both, chance can be asked for what the second unknown gains.
#pragma once

#include "core/model/temperature.hpp"

#include <Eigen/Dense>
#include <vector>

namespace plyform {

enum class FlowForm { none, arrhenius, wlf, table };

class FlowLaw {
public:
  FlowLaw() = default;
  /// temperatures: degC, of the tests; reference: one of them.
  FlowLaw(FlowForm form, double reference, const std::vector<double>& temperatures);

  FlowForm form() const { return form_; }
  Eigen::Index unknowns() const;
  /// p of what Arrhenius' law has with this energy (J/mol).
  Eigen::VectorXd as_arrhenius(double energy) const;
  /// Whether p is one that the form may have.
  bool allowed(const Eigen::VectorXd& p) const;
  double factor(const Eigen::VectorXd& p, double celsius) const;

  /// E (J/mol); C_1, C_2 (-, K); f at each temperature but T_0.
  Eigen::VectorXd numbers(const Eigen::VectorXd& p) const;
  Eigen::VectorXd unknowns_of(const Eigen::VectorXd& numbers) const;
  /// degC, of the tests, ascending, each once.
  const std::vector<double>& temperatures() const { return temperatures_; }
  double reference() const { return reference_; }

private:
  FlowForm form_ = FlowForm::none;
  double reference_ = 0.0;
  std::vector<double> temperatures_;
};

} // namespace plyform
