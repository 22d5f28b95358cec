// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/biaxial_model.hpp"

#include "core/identify/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

namespace plyform {
namespace {

/// Residuals as Eigen's Levenberg-Marquardt wants them.
struct WeightedResiduals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const BiaxialModel* model;
  const Eigen::VectorXd* target;
  const Eigen::ArrayXd* weights;

  int inputs() const { return static_cast<int>(model->numbers()); }
  int values() const { return static_cast<int>(target->size()) + 2 * (model->pieces - 1); }
  int operator()(const Eigen::VectorXd& p, Eigen::VectorXd& residuals) const {
    // Neighbouring slopes go together by so little that rows decide, but for pieces without rows.
    constexpr double together = 0.01;
    residuals.resize(values());
    residuals.head(target->size()) = (*weights * (model->loads(p) - *target).array()).matrix();
    Eigen::Index row = target->size();
    for (int a = 0; a < 2; ++a)
      for (int i = 1; i < model->pieces; ++i, ++row)
        residuals[row] = together * (p[a * model->pieces + i] - p[a * model->pieces + i - 1]);
    return residuals.allFinite() ? 0 : -1;
  }
};

/// 1 / max(fitted, a tenth of the largest of its direction).
Eigen::ArrayXd weights_of(const Eigen::VectorXd& fitted, const Eigen::VectorXd& measured) {
  std::array<double, 2> largest{};
  for (Eigen::Index i = 0; i < measured.size(); ++i)
    largest[static_cast<std::size_t>(i % 2)] =
        std::max(largest[static_cast<std::size_t>(i % 2)], measured[i]);
  Eigen::ArrayXd weights(measured.size());
  for (Eigen::Index i = 0; i < measured.size(); ++i) {
    const double most =
        std::max(largest[static_cast<std::size_t>(i % 2)], 0.01 * std::max(largest[0], largest[1]));
    weights[i] = 1.0 / std::max(fitted[i], load_floor * most);
  }
  return weights;
}

} // namespace

TensionLaw BiaxialModel::yarn(const Eigen::VectorXd& p, std::size_t a) const {
  TensionLaw law;
  const auto first = static_cast<Eigen::Index>(a) * pieces;
  if (pieces == 1) {
    law.stiffness = std::exp(std::clamp(p[first], -50.0, 50.0));
    return law;
  }
  law.strain = law.tension = {0.0};
  const double width = longest[a] / pieces;
  for (Eigen::Index i = 0; i < pieces; ++i) {
    law.strain.push_back(width * static_cast<double>(i + 1));
    law.tension.push_back(law.tension.back() +
                          width * std::exp(std::clamp(p[first + i], -50.0, 50.0)));
  }
  return law;
}

double BiaxialModel::crimp(const Eigen::VectorXd& p, std::size_t a) const {
  return std::min(std::abs(p[2 * pieces + static_cast<Eigen::Index>(a)]), 0.5);
}

CrimpedCell BiaxialModel::cell(const Eigen::VectorXd& p) const {
  return {half_wave, {crimp(p, 0), crimp(p, 1)}};
}

Eigen::VectorXd BiaxialModel::loads(const Eigen::VectorXd& p) const {
  const std::array<TensionLaw, 2> laws{yarn(p, 0), yarn(p, 1)};
  const CrimpedCell crimped = cell(p);
  std::vector<double> all;
  for (std::size_t n = 0; n < curves->size(); ++n) {
    const BiaxialCurve& curve = (*curves)[n];
    std::array<double, 2> zero{};
    for (std::size_t z = 0; z < zeros.size(); ++z)
      if (!zeros[z].file || *zeros[z].file == n)
        zero[zeros[z].direction] += p[2 * pieces + 2 + static_cast<Eigen::Index>(z)];
    for (std::size_t i = 0; i < curve.size(); ++i) {
      std::array<double, 2> strain{};
      for (std::size_t a = 0; a < 2; ++a)
        strain[a] = std::max(curve.strain[a][i] - zero[a], -0.9);
      if (curve.free[0] || curve.free[1]) { // the other yarn takes all height: it is straight
        for (std::size_t a = 0; a < 2; ++a)
          all.push_back(curve.free[a]
                            ? 0.0
                            : laws[a].at((1.0 + strain[a]) / (1.0 + crimped.crimp[a]) - 1.0).value);
        continue;
      }
      const CellAnswer answer = answer_of(crimped, strain, laws[0], laws[1]);
      all.insert(all.end(), answer.pull.begin(), answer.pull.end());
    }
  }
  return vector_of(all);
}

Eigen::VectorXd BiaxialModel::measured() const {
  std::vector<double> all;
  for (const BiaxialCurve& curve : *curves)
    for (std::size_t i = 0; i < curve.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a)
        all.push_back(curve.free[a] ? 0.0 : curve.load[a][i]);
  return vector_of(all);
}

double BiaxialSolution::limits(Eigen::Index i) const {
  return student_95(freedom) * std::sqrt(std::max(0.0, covariance(i, i)));
}

BiaxialSolution solve_biaxial(const BiaxialModel& model, const Eigen::VectorXd& start) {
  BiaxialSolution s;
  s.p = start;
  const Eigen::VectorXd target = model.measured();
  s.fitted = target;
  Eigen::ArrayXd weights;
  WeightedResiduals residuals{&model, &target, &weights};
  using Differentiated = Eigen::NumericalDiff<WeightedResiduals, Eigen::Central>;
  constexpr double step = 1e-12; // its root is the share of a number that it is moved by
  for (int round = 0; round < 3; ++round) {
    weights = weights_of(s.fitted, target);
    Differentiated function(residuals, step);
    Eigen::LevenbergMarquardt<Differentiated> search(function);
    search.parameters.maxfev = 400;
    search.parameters.xtol = search.parameters.ftol = 1e-10;
    search.minimize(s.p);
    s.fitted = model.loads(s.p);
  }
  residuals(s.p, s.residuals);
  Eigen::MatrixXd jacobian(s.residuals.size(), model.numbers());
  s.residuals.conservativeResize(target.size());
  s.squares = s.residuals.squaredNorm();
  s.freedom = freedom_of(s.residuals, model.numbers(), freedom_of_limits);
  Differentiated(residuals, step).df(s.p, jacobian);
  const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
  // What the rows do not show has no limits: a floor far below what they can show.
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt();
  Eigen::MatrixXd scaled =
      scale.cwiseInverse().asDiagonal() * normal * scale.cwiseInverse().asDiagonal();
  scaled.diagonal().array() += 1e-13;
  s.covariance = scale.cwiseInverse().asDiagonal() * scaled.inverse() *
                 scale.cwiseInverse().asDiagonal() * (s.squares / s.freedom);
  return s;
}

BiaxialSolution solve_biaxial(const BiaxialModel& model) {
  std::array<double, 2> stiffness{1.0, 1.0};
  for (const BiaxialCurve& curve : *model.curves)
    for (std::size_t a = 0; a < 2; ++a)
      for (std::size_t i = 0; i < curve.size(); ++i)
        if (!curve.free[a] && curve.strain[a][i] > 0.0)
          stiffness[a] = std::max(stiffness[a], curve.load[a][i] / curve.strain[a][i]);
  BiaxialSolution best;
  bool any = false;
  for (const double first : {0.001, 0.006, 0.03})
    for (const double second : {0.001, 0.006, 0.03}) {
      Eigen::VectorXd start = Eigen::VectorXd::Zero(model.numbers());
      for (std::size_t a = 0; a < 2; ++a)
        start.segment(static_cast<Eigen::Index>(a) * model.pieces, model.pieces)
            .setConstant(std::log(1.5 * stiffness[a]));
      start[2 * model.pieces] = first, start[2 * model.pieces + 1] = second;
      const BiaxialSolution here = solve_biaxial(model, start);
      if (!any || here.squares < best.squares) best = here;
      any = true;
    }
  return best;
}

Eigen::VectorXd start_from(const BiaxialModel& model, const BiaxialModel& less,
                           const Eigen::VectorXd& p) {
  Eigen::VectorXd start = Eigen::VectorXd::Zero(model.numbers());
  for (int a = 0; a < 2; ++a)
    for (int i = 0; i < model.pieces; ++i)
      start[a * model.pieces + i] = p[a * less.pieces + std::min(i, less.pieces - 1)];
  start.segment(2 * model.pieces, 2) = p.segment(2 * less.pieces, 2);
  const auto known = static_cast<Eigen::Index>(less.zeros.size());
  start.segment(2 * model.pieces + 2, known) = p.tail(known);
  return start;
}

} // namespace plyform
