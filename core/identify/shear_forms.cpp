// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/shear_forms.hpp"

#include "base/format.hpp"
#include "core/identify/shear_table.hpp"

#include <algorithm>
#include <cmath>

namespace plyform {
namespace {

/// s of the static torque.
double overcome(double t) {
  return t < 1.0 ? 0.5 * t * (3.0 - t * t) : 1.0;
}

/// Sets k1 to 0 if it is negative by rounding only (the law begins with a higher power).
void clear_rounding(ShearLaw& law, double to) {
  if (law.k[0] < 0.0 && -law.k[0] * to < 1e-9 * law.at(to).value) law.k[0] = 0.0;
}

double squares_of(const LinearFit& fit, const LoadRows& rows) {
  return (fit.weights * (rows.y - fit.fitted).array()).square().sum();
}

/// A further column, of the static torque, after those of a polynomial.
LinearLaw with_static(const ShearBasis& basis, double angle) {
  const LinearLaw plain = linear_shear(basis);
  LinearLaw law;
  law.loads = [=](const Eigen::VectorXd& x) {
    const Eigen::MatrixXd a = plain.loads(x);
    Eigen::MatrixXd both(a.rows(), a.cols() + 1);
    const double end = 0.999 * locking_extension(basis.test);
    for (Eigen::Index r = 0; r < a.rows(); ++r) {
      const TorqueWeights w = torque_weights(basis.test, basis.fabric, std::clamp(x[r], 0.0, end));
      both.row(r) << a.row(r), basis.factor * (w.whole * overcome(w.angle / angle) +
                                               w.half * overcome(0.5 * w.angle / angle));
    }
    return both;
  };
  const std::vector<double> places = probe_angles(basis.scale);
  law.probes.resize(plain.probes.rows(), plain.probes.cols() + 1);
  for (Eigen::Index r = 0; r < law.probes.rows(); ++r)
    law.probes.row(r) << plain.probes.row(r), overcome(places[static_cast<std::size_t>(r)] / angle);
  return law;
}

/// A table whose curve passes the law of a static torque and a polynomial to 0.1 % from `angle` on:
/// points are added where it is furthest off.
ShearLaw table_of(double torque, double angle, const ShearLaw& polynomial, double end) {
  constexpr int places = 400, most = 60;
  constexpr double close = 1e-3;
  const auto value = [&](double g) {
    return torque * overcome(g / angle) + polynomial.at(g).value;
  };
  ShearLaw law;
  law.angle = {0.0, 0.5 * angle, angle, 0.5 * (angle + end), end};
  for (int points = 0; points < most; ++points) {
    law.torque.clear();
    for (const double g : law.angle)
      law.torque.push_back(value(g));
    double furthest = 0.0, at = 0.0;
    for (int i = 1; i < places; ++i) {
      const double g = angle + (end - angle) * i / places;
      const double off = std::abs(law.at(g).value / value(g) - 1.0);
      if (!(off > furthest)) continue;
      furthest = off;
      at = g;
    }
    if (furthest <= close) break;
    const auto above = std::upper_bound(law.angle.begin(), law.angle.end(), at);
    const double middle = 0.5 * (*(above - 1) + *above); // of the piece: pieces stay alike
    law.angle.insert(above, middle);
  }
  return law;
}

void solve_polynomial(ShearSolution& s, const ShearBasis& basis, const LoadRows& rows) {
  s.law = linear_shear(basis);
  s.fit = fit_linear(s.law.loads(rows.x), rows.y, rows.weights);
  s.polynomial = unscaled(s.fit.k, basis.scale);
  ShearLaw& law = s.fabric.crossings[0].shear;
  law = {};
  law.k = s.polynomial;
  clear_rounding(law, basis.scale);
  s.polynomial = law.k;
}

void solve_static(ShearSolution& s, const ShearBasis& basis, const LoadRows& rows) {
  const double first = rows.x.size() > 0 ? shear_angle(basis.test, rows.x.minCoeff()) : 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (const double degrees : {4.0, 3.0, 2.0, 1.5, 1.0, 0.7, 0.5}) {
    const double angle = degrees * degree;
    const bool last = degrees == 0.5;
    if ((angle > 0.25 * basis.scale && !(last && s.fit.k.size() == 0)) ||
        (first > angle && s.fit.k.size() > 0))
      continue;
    const LinearLaw law = with_static(basis, angle);
    const LinearFit fit = fit_linear(law.loads(rows.x), rows.y, rows.weights);
    const double squares = squares_of(fit, rows);
    if (s.fit.k.size() > 0 && !(squares < 0.999 * least)) continue;
    least = squares;
    s.law = law;
    s.fit = fit;
    s.static_angle = angle;
  }
  const Eigen::Index n = s.fit.k.size() - 1;
  s.static_torque = s.fit.k[n];
  s.polynomial = unscaled(s.fit.k.head(n), basis.scale);
  ShearLaw polynomial;
  polynomial.k = s.polynomial;
  s.fabric.crossings[0].shear = table_of(s.static_torque, s.static_angle, polynomial, basis.scale);
}

void solve_table(ShearSolution& s, const ShearBasis& basis, const LoadRows& rows,
                 const std::vector<double>& knots) {
  const TorqueRows torques = torque_rows(rows, basis.test, basis.fabric, basis.factor);
  const TorqueTable table = fit_table(
      knots.empty() ? grow_knots(torques, basis.scale, s.form.size).back() : knots, torques);
  s.form.size = static_cast<int>(table.knots.size());
  const TableLaw linear = linear_table(table, basis.test, basis.fabric, basis.factor);
  s.law = linear.law;
  s.at_points = linear.torque;
  s.fit = fit_linear(s.law.loads(rows.x), rows.y, rows.weights);
  ShearLaw& law = s.fabric.crossings[0].shear;
  law = {};
  law.angle = {0.0};
  law.torque = {0.0};
  law.angle.insert(law.angle.end(), table.knots.begin(), table.knots.end());
  law.torque.insert(law.torque.end(), table.torque.begin(), table.torque.end());
}

} // namespace

std::string ShearForm::name() const {
  switch (kind) {
  case ShearFormKind::polynomial:
    return fmt::format("polynomial of {}", size);
  case ShearFormKind::with_static:
    return fmt::format("static torque and polynomial of {}", size);
  default:
    return fmt::format("table of {} points", size);
  }
}

std::vector<double> ShearSolution::numbers() const {
  if (form.kind == ShearFormKind::table) return {shear().torque.begin() + 1, shear().torque.end()};
  std::vector<double> all = polynomial;
  if (form.kind == ShearFormKind::with_static) all.push_back(static_torque);
  return all;
}

ShearSolution solve_shear(const ShearForm& form, const LoadRows& rows, double end,
                          const ShearTest& test, const Fabric& fabric,
                          const std::vector<double>& knots) {
  ShearSolution s;
  s.form = form;
  s.scale = end;
  s.fabric = fabric;
  constexpr int repetitions =
      20; // the share goes by the root of k1: each takes a tenth of the rest
  for (int i = 0; i < repetitions; ++i) {
    const double before = s.share.mean();
    const ShearBasis basis{test, fabric, form.size, end, 1.0 + before};
    if (form.kind == ShearFormKind::polynomial)
      solve_polynomial(s, basis, rows);
    else if (form.kind == ShearFormKind::with_static)
      solve_static(s, basis, rows);
    else
      solve_table(s, basis, rows, knots);
    s.share = in_plane_bending_share(test, s.fabric);
    if (std::abs(s.share.mean() - before) <= 1e-9) break;
  }
  s.squares = squares_of(s.fit, rows);
  return s;
}

std::vector<double> knots_to(const std::vector<double>& knots, double end) {
  std::vector<double> own;
  for (const double knot : knots)
    if (knot < end * (1.0 - 1e-9)) own.push_back(knot);
  if (!knots.empty()) own.push_back(end);
  return own;
}

std::vector<double> fitted_loads(const ShearSolution& s, const ShearTest& test,
                                 const Eigen::VectorXd& extension) {
  std::vector<double> loads;
  for (const double x : extension)
    loads.push_back((1.0 + s.share.mean()) * test_load(test, s.fabric, x));
  return loads;
}

double invalid_at(const ShearLaw& law, double from, double to) {
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double g = from + (to - from) * i / steps;
    const LawPoint p = law.at(g);
    const double rounding = law.tabulated() ? 1e-9 * law.torque.back() : 0.0;
    if (!(p.value >= -rounding && p.slope >= -rounding)) return g;
  }
  return 2.0 * to;
}

} // namespace plyform
