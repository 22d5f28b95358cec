// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/identify/shear_table.hpp"

#include "core/identify/nonnegative.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plyform {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Derivatives of the slopes at the points by the slopes of the chords: MonotoneCurve::slope.
MatrixXd slopes_by_chords(const std::vector<double>& length, const VectorXd& chord) {
  const Index n = chord.size();
  MatrixXd by = MatrixXd::Zero(n + 1, n);
  by(0, 0) = 1.0; // of an odd curve
  if (n == 1) {
    by(1, 0) = 1.0;
    return by;
  }
  const auto h = [&](Index i) { return length[static_cast<std::size_t>(i)]; };
  for (Index i = 1; i < n; ++i) {
    const double w_1 = 2.0 * h(i) + h(i - 1), w_2 = h(i) + 2.0 * h(i - 1);
    const double before = chord[i - 1], after = chord[i];
    const double m = (w_1 + w_2) / (w_1 / before + w_2 / after);
    by(i, i - 1) = m * m * w_1 / ((w_1 + w_2) * before * before);
    by(i, i) = m * m * w_2 / ((w_1 + w_2) * after * after);
  }
  const double h_1 = h(n - 1), h_2 = h(n - 2), s_1 = chord[n - 1], s_2 = chord[n - 2];
  const double m = ((2.0 * h_1 + h_2) * s_1 - h_1 * s_2) / (h_1 + h_2);
  if (m > 3.0 * s_1)
    by(n, n - 1) = 3.0;
  else if (m > 0.0) {
    by(n, n - 1) = (2.0 * h_1 + h_2) / (h_1 + h_2);
    by(n, n - 2) = -h_1 / (h_1 + h_2);
  }
  return by;
}

/// Torques at the knots are sums of increments.
MatrixXd sums(Index n) {
  return MatrixXd(MatrixXd::Ones(n, n).triangularView<Eigen::Lower>());
}

MatrixXd loads_by_torques(const TableBasis& basis, const std::vector<TorqueWeights>& weights,
                          Index knots) {
  MatrixXd a = MatrixXd::Zero(static_cast<Index>(weights.size()), knots);
  for (Index r = 0; r < a.rows(); ++r) {
    const TorqueWeights& w = weights[static_cast<std::size_t>(r)];
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(knots);
    basis.add(w.angle, w.whole, row);
    if (w.half != 0.0) basis.add(0.5 * w.angle, w.half, row);
    a.row(r) = row;
  }
  return a;
}

/// A column for each knot of a piecewise linear law.
MatrixXd loads_of_lines(const std::vector<double>& knots, const TorqueRows& rows) {
  const auto torque = [&](double g, double weight, Eigen::Ref<Eigen::RowVectorXd> row) {
    const auto above = std::lower_bound(knots.begin(), knots.end() - 1, g) - knots.begin();
    const auto i = static_cast<Index>(above);
    const double begin = above == 0 ? 0.0 : knots[static_cast<std::size_t>(above) - 1];
    const double t = (g - begin) / (knots[static_cast<std::size_t>(above)] - begin);
    row[i] += weight * t;
    if (i > 0) row[i - 1] += weight * (1.0 - t);
  };
  MatrixXd a = MatrixXd::Zero(rows.load.size(), static_cast<Index>(knots.size()));
  for (Index r = 0; r < a.rows(); ++r) {
    const TorqueWeights& w = rows.weights[static_cast<std::size_t>(r)];
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(a.cols());
    torque(w.angle, w.whole, row);
    torque(0.5 * w.angle, w.half, row);
    a.row(r) = row;
  }
  return a;
}

struct Fitted {
  TorqueTable table;
  double squares = 0.0; ///< of weighted residuals
};

/// At most so many steps from a law that is piecewise linear.
Fitted fit_steps(const std::vector<double>& knots, const TorqueRows& rows, int steps) {
  const auto n = static_cast<Index>(knots.size());
  const MatrixXd sum = sums(n);
  const auto weights_of = [&](const VectorXd& fitted) {
    Eigen::ArrayXd weights = load_weights(fitted, rows.load);
    if (rows.share.size() > 0) weights *= rows.share;
    return weights;
  };
  const auto best = [&](const MatrixXd& by_torque, const Eigen::ArrayXd& weights) {
    return VectorXd(sum *
                    nonnegative_least_squares(weights.matrix().asDiagonal() * (by_torque * sum),
                                              (weights * rows.load.array()).matrix()));
  };
  const auto derivatives = [&](const VectorXd& torque) {
    return loads_by_torques(TableBasis({knots, torque}), rows.weights, n);
  };
  VectorXd v = best(loads_of_lines(knots, rows), weights_of(rows.load));
  MatrixXd a = derivatives(v);
  Eigen::ArrayXd weights = weights_of(a * v);
  double squares = (weights * (rows.load - a * v).array()).square().sum();
  for (int i = 0; i < steps; ++i) {
    const VectorXd wanted = best(a, weights);
    double step = 1.0, less = squares;
    VectorXd next = v;
    MatrixXd there = a;
    for (; step > 1e-3; step *= 0.5) {
      next = v + step * (wanted - v);
      there = derivatives(next);
      less = (weights * (rows.load - there * next).array()).square().sum();
      if (less <= squares) break;
    }
    const bool done = !(less < squares * (1.0 - 1e-10));
    if (less <= squares) {
      v = next;
      a = there;
    }
    weights = weights_of(a * v);
    squares = (weights * (rows.load - a * v).array()).square().sum();
    if (done) break;
  }
  return {{knots, v}, squares};
}

/// Angles of rows at which a knot may be: all where rows are few, else about evenly spaced, denser
/// at the start, where a static torque is overcome.
std::vector<double> places_of(const TorqueRows& rows, double end) {
  constexpr int places = 16;
  constexpr double apart = 0.25 * degree, early[] = {0.5, 1.0, 2.0, 3.0}; // degrees
  std::vector<double> angles;
  for (const TorqueWeights& w : rows.weights)
    if (w.angle > apart) angles.push_back(w.angle);
  std::sort(angles.begin(), angles.end());
  std::vector<double> wanted;
  for (const double angle : early)
    wanted.push_back(angle * degree);
  for (int i = 1; i < places; ++i)
    wanted.push_back(end * i / places);
  std::vector<double> chosen;
  for (const double angle : wanted) {
    const auto above = std::lower_bound(angles.begin(), angles.end(), angle);
    if (above != angles.end()) chosen.push_back(*above);
    if (above != angles.begin()) chosen.push_back(*(above - 1));
  }
  std::sort(chosen.begin(), chosen.end());
  std::vector<double> apart_ones;
  for (const double angle : chosen)
    if (angle < end - apart && (apart_ones.empty() || angle - apart_ones.back() > apart))
      apart_ones.push_back(angle);
  return apart_ones;
}

} // namespace

TableBasis::TableBasis(const TorqueTable& table) : knots_(table.knots) {
  const auto n = static_cast<Index>(knots_.size());
  std::vector<double> length(knots_.size());
  MatrixXd chords = MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    length[k] = knots_[k] - (k == 0 ? 0.0 : knots_[k - 1]);
    chords(i, i) = 1.0 / length[k];
    if (i > 0) chords(i, i - 1) = -1.0 / length[k];
  }
  // Where a chord is level, the derivatives towards one that rises.
  const double tiny = 1e-9 * std::max(1e-300, table.torque.maxCoeff() / knots_.back());
  const VectorXd chord = (chords * table.torque).cwiseMax(tiny);
  value_ = MatrixXd::Zero(n + 1, n);
  value_.bottomRows(n).setIdentity();
  slope_ = slopes_by_chords(length, chord) * chords;
}

void TableBasis::add(double g, double weight, Eigen::Ref<Eigen::RowVectorXd> row) const {
  if (g >= knots_.back()) {
    const Index last = value_.rows() - 1;
    row += weight * (value_.row(last) + (g - knots_.back()) * slope_.row(last));
    return;
  }
  const auto above = std::upper_bound(knots_.begin(), knots_.end(), g) - knots_.begin();
  const double begin = above == 0 ? 0.0 : knots_[static_cast<std::size_t>(above) - 1];
  const double h = knots_[static_cast<std::size_t>(above)] - begin, t = (g - begin) / h;
  const Index i = above;
  const double rise = t * t * (3.0 - 2.0 * t); // cubic Hermite basis
  row += weight * ((1.0 - rise) * value_.row(i) + rise * value_.row(i + 1) +
                   h * t * (1.0 - t) * (1.0 - t) * slope_.row(i) -
                   h * t * t * (1.0 - t) * slope_.row(i + 1));
}

TableLaw linear_table(const TorqueTable& table, const ShearTest& test, const Fabric& fabric,
                      double factor) {
  const auto n = static_cast<Index>(table.knots.size());
  const MatrixXd sum = sums(n);
  std::vector<Index> rising;
  double before = 0.0;
  for (Index i = 0; i < n; ++i) {
    if (table.torque[i] - before > 1e-9 * table.torque[n - 1]) rising.push_back(i);
    before = table.torque[i];
  }
  TableLaw linear;
  linear.torque = sum(Eigen::all, rising);
  const TableBasis basis(table);
  linear.law.loads = [=, torque = linear.torque](const VectorXd& x) {
    std::vector<TorqueWeights> weights;
    const double end = 0.999 * locking_extension(test); // trial values may be beyond
    for (const double extension : x) {
      weights.push_back(torque_weights(test, fabric, std::clamp(extension, 0.0, end)));
      weights.back().whole *= factor;
      weights.back().half *= factor;
    }
    return MatrixXd(loads_by_torques(basis, weights, n) * torque);
  };
  const std::vector<double> angles = probe_angles(table.knots.back());
  MatrixXd probes = MatrixXd::Zero(static_cast<Index>(angles.size()), n);
  for (Index r = 0; r < probes.rows(); ++r) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n);
    basis.add(angles[static_cast<std::size_t>(r)], 1.0, row);
    probes.row(r) = row;
  }
  linear.law.probes = probes * linear.torque;
  return linear;
}

TorqueRows torque_rows(const LoadRows& rows, const ShearTest& test, const Fabric& fabric,
                       double factor) {
  TorqueRows all{{}, rows.y, rows.weights};
  for (const double extension : rows.x) {
    all.weights.push_back(torque_weights(test, fabric, extension));
    all.weights.back().whole *= factor;
    all.weights.back().half *= factor;
  }
  return all;
}

TorqueTable fit_table(const std::vector<double>& knots, const TorqueRows& rows) {
  constexpr int steps = 50;
  return fit_steps(knots, rows, steps).table;
}

std::vector<std::vector<double>> grow_knots(const TorqueRows& rows, double end, int most) {
  constexpr int steps = 3;
  const std::vector<double> places = places_of(rows, end);
  std::vector<std::vector<double>> grown{{end}};
  while (static_cast<int>(grown.size()) < most) {
    const std::vector<double>& before = grown.back();
    std::vector<double> best;
    double least = std::numeric_limits<double>::infinity();
    for (const double place : places) {
      if (std::binary_search(before.begin(), before.end(), place)) continue;
      std::vector<double> knots = before;
      knots.insert(std::lower_bound(knots.begin(), knots.end(), place), place);
      const double squares = fit_steps(knots, rows, steps).squares;
      if (squares >= least) continue;
      least = squares;
      best = knots;
    }
    if (best.empty()) break;
    grown.push_back(best);
  }
  return grown;
}

} // namespace plyform
